//! Functions that change a light BVH.

use lightbvh::bvh::{EditError, EditReason};
use lightbvh::{Edit, EmissiveTriangle, LightBvh, Transform};

use crate::error::{Fault, Status};
use crate::held::Handle;
use crate::ids::{CInstance, CMesh};
use crate::raw;

/// `lightbvh_transform`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CTransform {
    columns: [[f32; 3]; 3],
    translation: [f32; 3],
}

impl From<CTransform> for Transform {
    fn from(c: CTransform) -> Self {
        Self {
            columns: c.columns,
            translation: c.translation,
        }
    }
}

fn refused(reason: EditReason) -> Fault {
    Fault::new(Status::Refused, reason)
}

/// Applies an edit by itself.
fn change(bvh: &mut LightBvh, edit: Edit) -> Result<(), Fault> {
    bvh.apply(vec![edit])
        .map(|_| ())
        .map_err(|error| refused(error.reason))
}

/// A new mesh.
///
/// # Safety
/// The pointers are null or as `lightbvh.h` says: `bvh` is a light BVH that nobody else uses meanwhile, `triangles` points to
/// `count` of them, `mesh` to memory of one. The same holds for the functions below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_add_mesh(
    bvh: *mut Handle,
    triangles: *const EmissiveTriangle,
    count: usize,
    mesh: *mut CMesh,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::change(bvh, |bvh| {
            let triangles = raw::at_most_lights(triangles, count, "triangles")?;
            let mesh = raw::place(mesh, "mesh")?;
            mesh.write(bvh.add_mesh(triangles.to_vec()).map_err(refused)?.into());
            Ok(())
        })
    }
}

/// A mesh put into the world at `count` places, all or none.
///
/// # Safety
/// As [`lightbvh_add_mesh`], with `count` transforms and instances.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_add_instances(
    bvh: *mut Handle,
    mesh: CMesh,
    transforms: *const CTransform,
    radiance: *const [f32; 3],
    count: usize,
    instances: *mut CInstance,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::change(bvh, |bvh| {
            let transforms = raw::at_most_lights(transforms, count, "transforms")?;
            let instances = raw::places(instances, count, "instances")?;
            let mesh = mesh.id()?;
            let radiance = *raw::shared(radiance, "radiance")?;
            let add = |&transform: &CTransform| Edit::AddInstance {
                mesh,
                transform: transform.into(),
                radiance,
                mask: u32::MAX,
            };
            let bad = |EditError { edit, reason, .. }| {
                Fault::new(Status::Refused, format!("instance {edit}: {reason}"))
            };
            let added = bvh.apply(transforms.iter().map(add).collect()).map_err(bad)?;
            for (place, instance) in instances.iter_mut().zip(added.instances) {
                place.write(instance.into());
            }
            Ok(())
        })
    }
}

/// An instance moved.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_set_transform(
    bvh: *mut Handle,
    instance: CInstance,
    transform: *const CTransform,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::change(bvh, |bvh| {
            let transform = *raw::shared(transform, "transform")?;
            bvh.set_transform(instance.id()?, transform.into())
                .map_err(refused)
        })
    }
}

/// An instance made brighter, dimmed, coloured, or turned off.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_set_radiance(
    bvh: *mut Handle,
    instance: CInstance,
    radiance: *const [f32; 3],
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        Handle::change(bvh, |bvh| {
            let radiance = *raw::shared(radiance, "radiance")?;
            bvh.set_radiance(instance.id()?, radiance).map_err(refused)
        })
    }
}

/// New vertices or radiance of some triangles of a mesh.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_set_triangle_range(
    bvh: *mut Handle,
    mesh: CMesh,
    first: u32,
    triangles: *const EmissiveTriangle,
    count: usize,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::change(bvh, |bvh| {
            let mesh = mesh.id()?;
            // Before they are read: a wrong count is one of memory that the caller has not.
            let own = bvh.view().mesh_lights(mesh).map(<[_]>::len);
            if let Some(lights) = own.filter(|&own| own.saturating_sub(first as usize) < count) {
                return Err(refused(EditReason::Range { first, count, lights }));
            }
            let lights = raw::at_most_lights(triangles, count, "triangles")?;
            let lights = lights.to_vec();
            change(bvh, Edit::SetLightRange { mesh, first, lights })
        })
    }
}

/// An instance taken out of the world.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_remove_instance(bvh: *mut Handle, instance: CInstance) -> Status {
    // SAFETY: the caller's promise.
    unsafe { Handle::change(bvh, |bvh| bvh.remove(instance.id()?).map_err(refused)) }
}

/// A mesh without instances removed.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_remove_mesh(bvh: *mut Handle, mesh: CMesh) -> Status {
    // SAFETY: the caller's promise.
    unsafe { Handle::change(bvh, |bvh| change(bvh, Edit::RemoveMesh(mesh.id()?))) }
}

/// Computes the nodes that edits touched.
///
/// # Safety
/// As [`lightbvh_add_mesh`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_refit(bvh: *mut Handle) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        Handle::change(bvh, |bvh| {
            bvh.refit();
            Ok(())
        })
    }
}

/// From now on new lights may get those numbers.
///
/// # Safety
/// `bvh` is null or a light BVH that nobody else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_forget_removed_lights(bvh: *mut Handle) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        Handle::change(bvh, |bvh| {
            bvh.take_removed_lights();
            Ok(())
        })
    }
}
