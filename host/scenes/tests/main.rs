//! What files hold, and what a scene is made of them.

mod built_in;
mod files;
mod gltf;
mod hostile;
mod lights;
mod packed;
mod surfaces;
