//! Functions that change a light BVH.

use std::ptr::null;
use std::slice::from_ref;

use lightbvh::bvh::EditReason;
use lightbvh::tree::Model;
use lightbvh::{Bvh, Edit, Transform};

use crate::error::{Fault, Status};
use crate::held::{Handle, functions};
use crate::ids::CId;
use crate::light::{CLight, FromC, all_from_c};
use crate::raw;
use crate::scene::by_model;

/// `lightbvh_transform`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CTransform {
    pub columns: [[f32; 3]; 3],
    pub translation: [f32; 3],
}

impl From<CTransform> for Transform {
    fn from(c: CTransform) -> Self {
        let CTransform {
            columns: [a, b, c],
            translation,
        } = c;
        Self::from_cols([a, b, c, translation])
    }
}

/// `lightbvh_edit_kind`.
pub mod edit_kind {
    pub const ADD_MESH: u32 = 1;
    pub const ADD_INSTANCE: u32 = 2;
    pub const ADD_LIGHT: u32 = 3;
    pub const SET_LIGHT: u32 = 4;
    pub const SET_TRANSFORM: u32 = 5;
    pub const SET_RADIANCE: u32 = 6;
    pub const SET_MASK: u32 = 7;
    pub const SET_LIGHTS: u32 = 8;
    pub const REMOVE: u32 = 9;
}
use edit_kind as kind;

/// `lightbvh_edit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CEdit {
    pub kind: u32,
    pub first: u32,
    pub id: CId,
    pub lights: *const CLight,
    pub count: usize,
    pub transform: CTransform,
    pub radiance: [f32; 3],
    pub mask: u32,
}

impl Default for CEdit {
    /// No edit: the identity, a factor of 1, all masks.
    fn default() -> Self {
        Self {
            kind: 0,
            first: 0,
            id: CId::default(),
            lights: null(),
            count: 0,
            transform: CTransform {
                columns: Transform::IDENTITY.columns,
                translation: [0.0; 3],
            },
            radiance: [1.0; 3],
            mask: u32::MAX,
        }
    }
}

/// The edit that one of C says.
///
/// # Safety
/// `lights` is null, not aligned, or points to `count` of them; to one where the kind takes one.
#[rustfmt::skip]
unsafe fn from_c<M: Model<8, Light: FromC>>(bvh: &Bvh<M>, edit: &CEdit) -> Result<Edit<M::Light>, Fault> {
    let CEdit { first, id, lights, count, radiance, mask, .. } = *edit;
    let transform = edit.transform.into();
    // SAFETY: the caller's promise.
    let light = || M::Light::from_c(unsafe { raw::shared(lights, "light") }?);
    // SAFETY: the caller's promise.
    let all = || all_from_c(unsafe { raw::at_most(lights, count, "lights") }?);
    Ok(match edit.kind {
        kind::ADD_MESH => Edit::AddMesh { lights: all()? },
        kind::ADD_INSTANCE => Edit::AddInstance { mesh: id.mesh()?, transform, radiance, mask },
        kind::ADD_LIGHT => Edit::AddLight { light: light()?, mask },
        kind::SET_LIGHT => Edit::SetLight { instance: id.instance()?, light: light()? },
        kind::SET_TRANSFORM => Edit::SetTransform { instance: id.instance()?, transform },
        kind::SET_RADIANCE => Edit::SetRadiance { instance: id.instance()?, radiance },
        kind::SET_MASK => Edit::SetMask { instance: id.instance()?, mask },
        kind::SET_LIGHTS => {
            let mesh = id.mesh()?;
            // Before they are read: a wrong count is one of memory that the caller has not.
            let own = bvh.view().mesh_lights(mesh).map(<[_]>::len);
            if let Some(lights) = own.filter(|&own| own.saturating_sub(first as usize) < count) {
                return Err(EditReason::Range { first, count, lights }.into());
            }
            Edit::SetLightRange { mesh, first, lights: all()? }
        }
        kind::REMOVE if id.is_mesh() => Edit::RemoveMesh(id.mesh()?),
        kind::REMOVE => Edit::RemoveInstance(id.instance()?),
        unknown => {
            let message = format!("kind {unknown} of an edit, expected one of lightbvh_edit_kind");
            return Err(Fault::new(Status::BadTag, message));
        }
    })
}

/// Applies edits, all or none. Returns the id that each made, or which one is refused.
///
/// # Safety
/// As [`from_c`], for each.
unsafe fn apply<M: Model<8, Light: FromC>>(
    bvh: &mut Bvh<M>,
    edits: &[CEdit],
) -> Result<Vec<CId>, (usize, Fault)> {
    let mut own = Vec::with_capacity(edits.len());
    for (index, edit) in edits.iter().enumerate() {
        // SAFETY: the caller's promise.
        own.push(unsafe { from_c(bvh, edit) }.map_err(|fault| (index, fault))?);
    }
    let added = bvh
        .apply(own)
        .map_err(|error| (error.edit, error.reason.into()))?;
    let mut meshes = added.meshes.into_iter().map(CId::from);
    let mut instances = added.instances.into_iter().map(CId::from);
    let made = edits.iter().map(|edit| match edit.kind {
        kind::ADD_MESH => meshes.next(),
        kind::ADD_INSTANCE | kind::ADD_LIGHT => instances.next(),
        _ => None,
    });
    Ok(made.map(Option::unwrap_or_default).collect())
}

/// One edit, and where its id goes, if it makes one.
///
/// # Safety
/// As [`from_c`]; the handle and the place are null, not aligned, or as `lightbvh.h` says.
unsafe fn one(bvh: *mut Handle, id: Option<*mut CId>, edit: CEdit) -> Result<(), Fault> {
    // SAFETY: the caller's promise.
    let place = id.map(|id| unsafe { raw::place(id, "id") }).transpose()?;
    // SAFETY: the caller's promise.
    let made = unsafe {
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh => apply(bvh, &[edit])).map_err(|(_, fault)| fault)
        })
    }?;
    if let Some(place) = place {
        place.write(made[0]);
    }
    Ok(())
}

/// An edit of a kind; other fields are those of the default.
macro_rules! edit {
    ($kind:ident $(, $field:ident $(: $value:expr)?)*) => {
        CEdit { kind: kind::$kind, $($field $(: $value)?,)* ..CEdit::default() }
    };
}

functions! {
    /// A batch of edits, all or none.
    fn lightbvh_apply(bvh: *mut Handle, edits: *const CEdit, count: usize, ids: *mut CId, failed: *mut usize) {
        let edits = raw::at_most(edits, count, "edits")?;
        let (ids, failed) = (raw::places_if_any(ids, count, "ids")?, raw::places_if_any(failed, 1, "failed")?);
        let made = Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh => apply(bvh, edits)).map_err(|(index, fault)| {
                failed.iter_mut().for_each(|place| _ = place.write(index));
                fault.at("edit", index)
            })
        })?;
        ids.iter_mut().zip(made).for_each(|(place, id)| _ = place.write(id));
        Ok(())
    }

    /// A batch of edits, each that is sound.
    fn lightbvh_apply_each(bvh: *mut Handle, edits: *const CEdit, count: usize, ids: *mut CId, statuses: *mut Status) {
        let edits = raw::at_most(edits, count, "edits")?;
        let ids = raw::places_if_any(ids, count, "ids")?;
        let statuses = raw::places_if_any(statuses, count, "statuses")?;
        Handle::change(bvh, "bvh", |scene| {
            let mut result = Ok(());
            for (index, edit) in edits.iter().enumerate() {
                let (mut id, mut status) = (CId::default(), Status::Ok);
                match by_model!(&mut *scene, bvh => apply(bvh, from_ref(edit))) {
                    Ok(made) => id = made[0],
                    Err((_, fault)) => {
                        status = fault.status;
                        result = result.and(Err(fault.at("edit", index)));
                    }
                }
                ids.get_mut(index).map(|place| place.write(id));
                statuses.get_mut(index).map(|place| place.write(status));
            }
            result
        })
    }

    /// A new mesh.
    fn lightbvh_add_mesh(bvh: *mut Handle, lights: *const CLight, count: usize, id: *mut CId) {
        one(bvh, Some(id), edit!(ADD_MESH, lights, count))
    }

    /// A mesh put into the world.
    fn lightbvh_add_instance(bvh: *mut Handle, mesh: CId, transform: CTransform, instance: *mut CId) {
        one(bvh, Some(instance), edit!(ADD_INSTANCE, id: mesh, transform))
    }

    /// A light by itself.
    fn lightbvh_add_light(bvh: *mut Handle, light: *const CLight, instance: *mut CId) {
        one(bvh, Some(instance), edit!(ADD_LIGHT, lights: light))
    }

    /// A light by itself made another one.
    fn lightbvh_set_light(bvh: *mut Handle, id: CId, light: *const CLight) {
        one(bvh, None, edit!(SET_LIGHT, id, lights: light))
    }

    /// An instance moved.
    fn lightbvh_set_transform(bvh: *mut Handle, id: CId, transform: CTransform) {
        one(bvh, None, edit!(SET_TRANSFORM, id, transform))
    }

    /// An instance made brighter, dimmed, coloured, or turned off.
    fn lightbvh_set_radiance(bvh: *mut Handle, id: CId, red: f32, green: f32, blue: f32) {
        one(bvh, None, edit!(SET_RADIANCE, id, radiance: [red, green, blue]))
    }

    /// An instance made to light other receivers.
    fn lightbvh_set_mask(bvh: *mut Handle, id: CId, mask: u32) {
        one(bvh, None, edit!(SET_MASK, id, mask))
    }

    /// Some lights of a mesh made others.
    fn lightbvh_set_lights(bvh: *mut Handle, mesh: CId, first: u32, lights: *const CLight, count: usize) {
        one(bvh, None, edit!(SET_LIGHTS, id: mesh, first, lights, count))
    }

    /// An instance, a light by itself, or a mesh without instances removed.
    fn lightbvh_remove(bvh: *mut Handle, id: CId) {
        one(bvh, None, edit!(REMOVE, id))
    }

    /// Computes the nodes that edits touched.
    fn lightbvh_refit(bvh: *mut Handle) {
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh => bvh.refit());
            Ok(())
        })
    }

    /// Refits, and builds all trees again that changed.
    fn lightbvh_rebuild(bvh: *mut Handle) {
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh => bvh.rebuild());
            Ok(())
        })
    }

    /// From now on new lights may get those numbers.
    fn lightbvh_forget_removed_lights(bvh: *mut Handle) {
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh => _ = bvh.take_removed_lights());
            Ok(())
        })
    }
}
