#![doc = include_str!("../README.md")]
#![warn(unsafe_op_in_unsafe_fn)]

mod edit;
mod error;
mod handle;
mod held;
mod identity;
mod ids;
mod query;
mod raw;
mod rebuilder;

pub use edit::{
    CTransform, lightbvh_add_instance, lightbvh_add_instances, lightbvh_add_mesh, lightbvh_rebuild,
    lightbvh_refit, lightbvh_remove_instance, lightbvh_remove_mesh, lightbvh_set_radiance,
    lightbvh_set_transform, lightbvh_set_triangle_range, lightbvh_set_triangles,
};
pub use error::{Status, lightbvh_last_error};
pub use handle::{Handle, lightbvh_create, lightbvh_free};
pub use held::Held;
pub use identity::{CRange, lightbvh_forget_removed_lights, lightbvh_removed_lights};
pub use ids::{CInstance, CMesh};
pub use query::{
    lightbvh_light_count, lightbvh_lights_of, lightbvh_pmf, lightbvh_point_of, lightbvh_sample_batch,
    lightbvh_sample_light, lightbvh_triangle_of,
};
pub use rebuilder::{
    CFrameStart, CRebuilder, lightbvh_begin_frame, lightbvh_end_frame, lightbvh_rebuilder_create,
    lightbvh_rebuilder_free,
};
