//! What files hold, and what a scene is made of them.

mod bend;
mod built_in;
mod files;
mod gltf;
mod hostile;
mod packed;
mod surfaces;
