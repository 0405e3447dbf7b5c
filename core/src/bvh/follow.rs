//! A light BVH that was built over [`Lights`] follows them.

use alloc::vec::Vec;
use core::fmt;

use super::Bvh;
use super::edit::EditReason;
use crate::lights::Lights;
use crate::model::Model;
use crate::transform::reach_of;

/// Moves or changes all lights of a BVH built over [`Lights`], and refits it: the lights of mesh `k` are those of
/// mesh light `k`, or all of them in a single-level BVH.
///
/// # Errors
/// [`FollowError`] naming the mesh light whose number of lights is another (0 where there is no such), or that would be
/// out of range where an instance has moved it meanwhile; the BVH is as before then.
pub fn follow<M: Model<W>, const W: usize>(
    bvh: &mut Bvh<M, W>,
    lights: &Lights<M::Light>,
) -> Result<(), FollowError> {
    let given = match bvh.single {
        true => alloc::vec![0..lights.all().len()],
        false => (0..lights.mesh_count()).map(|mesh| lights.mesh(mesh)).collect(),
    };
    let mut changes = Vec::new();
    for index in 0..given.len().max(bvh.meshes.len()) {
        let wrong = |reason| FollowError { mesh: index, reason };
        let range = given.get(index).cloned().unwrap_or(0..0);
        // A removed mesh has none.
        let expected = bvh.meshes.get(index).map_or(0, |mesh| mesh.lights.len());
        let found = range.len();
        if expected != found {
            return Err(wrong(EditReason::Count { expected, found }));
        }
        let lights = &lights.all()[range];
        let reach = reach_of(lights);
        for &user in bvh.meshes.get(index).map_or(&[][..], |mesh| &mesh.users) {
            let transform = &bvh.placed[user as usize].transform;
            let checked = transform.check(reach);
            checked.map_err(|reason| wrong(EditReason::Transform(reason)))?;
        }
        if found > 0 {
            changes.push((index as u32, lights, reach));
        }
    }
    for (mesh, lights, reach) in changes {
        bvh.meshes[mesh as usize].reach = reach;
        bvh.write_lights(mesh, 0, lights);
    }
    bvh.refit();
    Ok(())
}

/// Why a light BVH cannot follow [`Lights`]: they are not those that it was built over.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowError {
    /// Index of the mesh light; 0 in a single-level BVH.
    pub mesh: usize,
    /// What is wrong with it.
    pub reason: EditReason,
}

impl fmt::Display for FollowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reason {
            EditReason::Count { expected, found } => write!(
                f,
                "mesh light {}: {found} lights, expected {expected}; these are not the lights that the light BVH was built over: \
                 rebuild it",
                self.mesh
            ),
            ref reason => write!(f, "mesh light {}: {reason}", self.mesh),
        }
    }
}

impl core::error::Error for FollowError {}
