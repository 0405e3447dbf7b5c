//! Textures of surfaces: pictures against an oracle, known answers of each texture, and every device against the CPU,
//! word for word.

mod cut;
mod glow;
mod surfaces;

pub use glow::textured_room;

use std::f64::consts::PI;
use std::sync::Arc;

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_host::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler};
use lightbvh_host::scene::{
    AnalyticKind, AnalyticLight, Camera, IN_PLACE, Instances, Material, MaterialTextures, Mesh, Node,
    Picture, Primitive, Scene, SceneData, Texture, Transform, Wrap,
};
use lightbvh_host::workload::{build, render_params};
use lightbvh_kernels::bvh::{AnyKind, WIDTH};
use lightbvh_kernels::shading::picture::{HEADER_WORDS, Picture as Words, PictureWords, SRGB_WORDS};

use crate::kinds_render::{arrays, at, mean, node, room};

/// What a textured floor reflects of the light that falls on it: its diffuse part, and at most this of gloss.
const GLOSS: f64 = 0.04 * 7.0 / 8.0;

const PLAIN: MaterialTextures = MaterialTextures::PLAIN;

const fn lying(picture: u32) -> Texture {
    Texture {
        picture,
        is_nearest: true,
        wrap: [Wrap::Clamp; 2],
        transform: IN_PLACE,
    }
}

fn picture(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Picture {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Picture {
        width,
        height,
        texels: Arc::new(texels.flat_map(|(x, y)| texel(x, y)).collect()),
    }
}

fn textured(textures: MaterialTextures) -> Material {
    Material {
        base_color: [0.5; 3],
        radiance: textures.radiance,
        double_sided: true,
        textures: Some(textures),
        ..Material::default()
    }
}

/// A square in the plane y = 0 with its front up, whose texture coordinates go from 0 to 1 along x and z.
pub fn sheet(side: f32, material: u32) -> Mesh {
    let s = side / 2.0;
    Mesh {
        name: String::from("sheet"),
        primitives: vec![Primitive {
            positions: vec![[-s, 0.0, -s], [-s, 0.0, s], [s, 0.0, s], [s, 0.0, -s]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material,
            coordinates: Some(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]),
            ..Primitive::default()
        }],
    }
}

/// A floor that reflects half of all light diffusely, seen from straight above from height `eye`, `aim` metres from the origin
/// along x.
fn floor(textures: MaterialTextures, pictures: Vec<Picture>, [aim, eye]: [f32; 2]) -> SceneData {
    let above = Transform::Matrix([
        [1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0],
        [aim, eye, 0.0],
    ]);
    SceneData {
        name: String::from("textured floor"),
        nodes: vec![node(at([0.0; 3]), Some(0)), node(above, None)],
        meshes: vec![sheet(40.0, 0)],
        materials: vec![textured(textures)],
        pictures,
        cameras: vec![Camera { node: 1, yfov: 1e-4 }],
        ..SceneData::default()
    }
}

pub fn add(data: &mut SceneData, transform: Transform, kind: AnalyticKind, intensity: f32) {
    data.nodes.push(node(transform, None));
    data.analytic.push(AnalyticLight {
        name: String::from("lamp"),
        node: data.nodes.len() as u32 - 1,
        kind,
        color: [1.0; 3],
        intensity,
        range: None,
    });
}

/// Every way to render the scene: the mean of each channel, and its standard error.
fn images(scene: &Scene) -> Vec<(String, [f64; 3], [f64; 3])> {
    let base = render_params((32, 32), 64, 5, [0.0; 3]);
    let arrays = arrays(scene, &base);
    let mut found = Vec::new();
    for sampler in Sampler::ALL {
        let bvh: Bvh<AnyKind, WIDTH> = match sampler {
            Sampler::TwoLevel => Instances::new(scene, 0, BuildParams::default()).expect("sound").0,
            _ => build(&arrays.lights, sampler, &BuildParams::default()),
        };
        let mut cpu = CpuBackend::<AnyKind, WIDTH>::new(bvh);
        for (integrator, candidates) in [
            (Integrator::Direct, 1),
            (Integrator::Direct, 4),
            (Integrator::Path { bounces: 1 }, 1),
        ] {
            let params = lightbvh_kernels::render::RenderParams { candidates, ..base };
            let image = cpu
                .render(&arrays, &params, sampler, integrator)
                .expect("an image");
            // Of each channel alone.
            let of = |k: usize| mean(&image.value.iter().map(|p| [p[k]; 3]).collect::<Vec<_>>());
            let (means, errors) = ([0, 1, 2].map(|k| of(k).0), [0, 1, 2].map(|k| of(k).1));
            let what = format!("{} {integrator:?} {candidates}", sampler.name());
            found.push((what, means, errors));
        }
    }
    found
}

/// A floor that reflects half of all light, seen from above.
pub fn plain_floor(place: [f32; 2]) -> SceneData {
    let mut data = floor(PLAIN, Vec::new(), place);
    data.materials[0] = Material {
        textures: None,
        metallic: 0.0,
        roughness: 1.0,
        ..data.materials[0].clone()
    };
    data
}

/// That each way to render finds `light`, up to a `share` of it, reflected by this albedo and no more gloss than there may be, in each
/// channel; `light` is irradiance.
pub fn reflects(data: SceneData, light: [f64; 3], albedo: [f64; 3], share: f64) {
    let scene = Scene::new(data).expect("a sound scene");
    for (what, means, errors) in images(&scene) {
        for k in 0..3 {
            let error = errors[k];
            let low = 0.96 * albedo[k] * light[k] / PI;
            let high = low + GLOSS * light[k] / PI;
            let slack = 5.0 * error + share * high + 1e-6;
            assert!(
                means[k] > low - slack && means[k] < high + slack,
                "{what}: channel {k} is {} ± {error}, expected {low} to {high}",
                means[k]
            );
        }
    }
}
