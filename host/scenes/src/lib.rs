//! Scenes: triangles, emissive materials, node animation and a camera, turned into world-space triangles per frame.
//!
//! ```text
//! Scene::open("street" | "path.glb")      load.rs: a built-in name, or a file of glTF 2.0 or OBJ
//!   └─ Scene (checked)                    scene.rs around model.rs: nodes, meshes, materials, animations; check.rs: what is refused
//!        ├─ Scene::frame(n) -> Frame      place.rs: triangles, emissive triangles, mesh lights, camera at n / 25 s
//!        └─ Scene::to_glb()               glb_out.rs: any scene as .glb
//! ```
//!
//! Three built-ins stand for the test scenes of the two-level light BVH paper, which cannot be shipped: `street`
//! for Bistro Exterior (a long street along which lights are carried), `square` for Emerald Square (wide, thousands
//! of small lights), `carousel` for Measure One (tens of thousands of emissive triangles, most of them moving).
//!
//! Conventions are those of glTF 2.0: metres, +Y up, right-handed, cameras look along -Z, the front of a triangle is
//! its counter-clockwise side. All trigonometry goes through the `libm` crate and all hierarchies are multiplied in
//! `f64`, so that a scene has the same words on every machine.
// With fewer formats some helpers have no user.
#![cfg_attr(not(feature = "formats"), allow(dead_code, unused_imports, unused_variables))]
#![forbid(unsafe_code)]

mod analytic;
mod animate;
mod builder;
mod camera;
mod check;
mod error;
mod files;
mod flush;
mod frame;
mod glb_out;
mod glow;
mod gltf_in;
mod instances;
mod lamps;
mod lit_by;
mod load;
mod model;
mod notes;
#[cfg(feature = "formats")]
mod obj_in;
mod pictures;
mod place;
mod random;
mod ray_bvh;
mod scene;
mod scene_light;
mod shapes;
mod shown;
mod srgb;
mod texture_words;
mod textures;
mod track;
mod transform;

mod carousel;
mod square;
mod stage;
mod street;
pub mod vector;

pub use analytic::{AnalyticKind, AnalyticLight};
pub use camera::View;
pub use check::MAX_TRIANGLES;
pub use error::SceneError;
pub use files::Limits;
pub use frame::{FRAMES_PER_SECOND, Frame, MeshRange};
pub use instances::Instances;
pub use load::{BUILT_IN, STAGE};
pub use model::{
    Animation, Camera, Channel, Interpolation, Material, Mesh, Node, Primitive, Property, SceneData,
};
pub use ray_bvh::{RayBvh, RayBvhError};
pub use scene::Scene;
pub use scene_light::SceneLight;
pub use texture_words::TextureArrays;
pub use textures::{IN_PLACE, MAX_SIDE, MaterialTextures, Picture, Texture, Wrap};
pub use transform::Transform;
