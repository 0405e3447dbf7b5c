//! What rendering needs on the host, whichever processor renders: the ray BVH, the camera, the power table, the loop
//! over pixels on the CPU, and images with their files.

mod camera;
mod cpu;
mod film;
mod output;
mod power;
mod tone;

pub use camera::camera;
pub use cpu::{render, render_path};
pub use film::{Film, FilmError, MAX_AUTO_EXPOSURE};
pub use lightbvh_scenes::{RayBvh, RayBvhError, View};
pub use output::{real_path, uninterrupted, write_whole};
pub use power::power_thresholds;
