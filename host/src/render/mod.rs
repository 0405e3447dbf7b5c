//! What rendering needs on the host, whichever processor renders: the ray BVH, the camera, the power table, the loop
//! over pixels on the CPU, and images with their files.

mod camera;
mod cpu;
mod film;
mod output;
mod power;
mod ray_bvh;
mod tone;

pub use camera::{View, camera};
pub use cpu::{render, render_path};
pub(crate) use film::write_image;
pub use film::{Film, FilmError, MAX_AUTO_EXPOSURE};
pub use output::write_whole;
pub use power::{PowerError, power_thresholds, triangle_flux};
pub use ray_bvh::{RayBvh, RayBvhError};
