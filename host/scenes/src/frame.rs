//! One frame of a scene: world-space triangles and lights, in the same order every frame.

use std::sync::Arc;

use lightbvh::light::infinite::DistantLight;
use lightbvh::light::{AnyLight, EmissiveTriangle, MIN_COORDINATE, TWO_SIDED};
use lightbvh_kernels::shading::material::Material as SurfaceMaterial;
use lightbvh_kernels::shading::skin::Corner;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use crate::{RayBvh, View};

use super::analytic::AnalyticKind;
use super::animate::Pose;
use super::camera::view_of_node;
use super::deform::Placed;
use super::flush::flush;
use super::framing;
use super::lamps;
use super::model::{Scene, SceneData};
use super::scene_light::SceneLight;
use super::skin_words::SkinArrays;
use super::sky::Sky;
use super::transform::unit_or;

/// The paper animates its scenes at a simulated 25 frames per second (section 4.1).
pub const FRAMES_PER_SECOND: u32 = 25;

/// A mesh light: one instance of one emissive primitive, its triangles contiguous.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshRange {
    /// Index of the first triangle in [`Frame::emissive`].
    pub first: u32,
    /// Number of triangles, above zero.
    pub count: u32,
    /// Node and mesh, for messages.
    pub name: String,
}

/// A scene at one time. Lengths and order are the same in every frame of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Every triangle, emissive or not, but for those of clear glass.
    pub triangles: Vec<SurfaceTriangle>,
    /// Triangles with radiance above zero, those of zero area included.
    pub emissive: Vec<EmissiveTriangle>,
    /// Ranges of `emissive`, in order, without gaps.
    pub mesh_lights: Vec<MeshRange>,
    /// Lights by formula, numbered after those, and each a mesh light of its own after [`mesh_lights`](Self::mesh_lights).
    pub others: Vec<AnyLight>,
    /// What is beyond all surfaces, but for the background.
    pub sky: Sky,
    /// Triangles of clear glass, which passes over all kinds of light know, and no others.
    pub clear: Vec<SurfaceTriangle>,
    /// Where `triangles`, then those of `clear`, then `emissive` lie on textures; empty where nothing is painted.
    pub corners: [Vec<Corner>; 3],
    /// [`SkinArrays::words`](super::SkinArrays); empty where nothing is painted.
    pub paint: Arc<Vec<u32>>,
    /// By [`SurfaceTriangle::material`]; the last one of lights by formula, where there are any.
    pub materials: Vec<SurfaceMaterial>,
    /// Where the frame is seen from.
    pub camera: View,
    /// Radiance of rays that leave the scene, W/(m² sr).
    pub background: [f32; 3],
}

impl Scene {
    /// The scene at `frame` / [`FRAMES_PER_SECOND`] seconds.
    pub fn frame(&self, frame: u32) -> Frame {
        let data = self.data();
        let pose = Pose::at(data, f64::from(frame) / f64::from(FRAMES_PER_SECOND));
        let mut out = Frame {
            triangles: Vec::with_capacity(self.counts.triangles),
            emissive: Vec::with_capacity(self.counts.emissive),
            mesh_lights: Vec::with_capacity(self.counts.mesh_lights),
            others: Vec::with_capacity(self.counts.analytic),
            sky: Sky::new(data.environment.clone(), suns(data, &pose)),
            clear: Vec::new(),
            corners: [const { Vec::new() }; 3],
            paint: self.paint_words(),
            materials: data.materials.iter().map(super::Material::surface).collect(),
            // Until the frame's triangles are there to look at.
            camera: View::default(),
            background: data.background,
        };
        place_meshes(data, &pose, &mut out);
        lamps::place(data, &pose, &mut out);
        if !out.paint.is_empty() {
            // Lamps are not painted, but for profiles.
            out.corners[0].resize(out.triangles.len(), UNPAINTED);
            if !data.profiles.is_empty() {
                let trees = data.analytic.iter().filter(|own| own.light().is_some());
                let first = data.materials.len() as u32;
                out.corners[2].extend(trees.map(|own| match own.kind {
                    AnalyticKind::Profile { profile, .. } => Corner {
                        uv: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
                        material: first + profile,
                    },
                    _ => UNPAINTED,
                }));
            }
        }
        out.camera = match data.cameras.first() {
            Some(camera) => view_of_node(&pose.unscaled(data, camera.node), camera.yfov),
            // The same in every frame.
            None => match self.default_camera.get() {
                Some(camera) => *camera,
                None if frame > 0 => self.frame(0).camera,
                None => *self.default_camera.get_or_init(|| framed(&out)),
            },
        };
        out
    }
}

/// Where a frame is seen from that has no camera: all of its glass where there is nothing else to look at.
fn framed(frame: &Frame) -> View {
    if !frame.triangles.is_empty() {
        return framing::view(frame);
    }
    let clear = Frame {
        triangles: frame.clear.clone(),
        ..frame.clone()
    };
    framing::view(&clear)
}

impl Frame {
    /// What is painted on the triangles that `rays` are of: those of glass after the others.
    pub fn skin(&self, rays: &RayBvh) -> SkinArrays {
        if self.paint.is_empty() {
            return SkinArrays::default();
        }
        let [opaque, clear, lights] = &self.corners;
        let of = |&source: &u32| {
            let source = source as usize;
            let own = opaque
                .get(source)
                .or_else(|| clear.get(source.wrapping_sub(opaque.len())));
            own.copied().unwrap_or(UNPAINTED)
        };
        SkinArrays {
            corners: rays
                .sources()
                .iter()
                .map(of)
                .chain(lights.iter().copied())
                .collect(),
            words: Arc::clone(&self.paint),
        }
    }

    /// All lights that the type holds, in the order in which they are numbered.
    pub fn lights<L: SceneLight>(&self) -> Vec<L> {
        let triangles = self.emissive.iter().map(|&triangle| L::from(triangle));
        triangles
            .chain(self.others.iter().filter_map(|&light| L::of_kind(light)))
            .collect()
    }
}

/// The suns of a scene, which shine along their nodes' -Z.
fn suns(data: &SceneData, pose: &Pose) -> Vec<DistantLight> {
    let suns = data
        .analytic
        .iter()
        .filter(|light| light.kind == AnalyticKind::Directional);
    suns.map(|sun| DistantLight {
        direction: unit_or(pose.place_of(data, sun).matrix3.z_axis.into(), [0.0, 1.0, 0.0]).map(|x| x as f32),
        irradiance: sun.emission(),
    })
    .collect()
}

/// Where nothing is painted.
const UNPAINTED: Corner = Corner {
    uv: [[0.0; 2]; 3],
    material: NONE,
};

/// Appends the triangles of every node, in the order node, primitive, triangle.
pub(super) fn place_meshes(data: &SceneData, pose: &Pose, out: &mut Frame) {
    for (index, node) in data.nodes.iter().enumerate() {
        let Some(mesh) = node.mesh.map(|mesh| &data.meshes[mesh as usize]) else {
            continue;
        };
        for primitive in &mesh.primitives {
            let material = &data.materials[primitive.material as usize];
            let flags = if material.double_sided { TWO_SIDED } else { 0 };
            let mesh_light = out.mesh_lights.len() as u32;
            let first = out.emissive.len() as u32;
            let Placed { points, mirrored } = pose.placed(data, index, primitive);
            let points: Vec<[f32; 3]> = points.into_iter().map(rounded).collect();
            let is_painted = !out.paint.is_empty();
            // Textures without coordinates are not shown.
            let own = material.paint.as_ref().filter(|paint| paint.is_seen());
            let lies =
                own.is_some_and(|paint| primitive.coordinates.is_some() || paint.textures().next().is_none());

            for (triangle, &[a, b, c]) in primitive.triangles.iter().enumerate() {
                // A mirrored instance would show its back; swapping two vertices keeps the front in front.
                let [b, c] = if mirrored { [c, b] } else { [b, c] };
                let p = [a, b, c].map(|vertex| points[vertex as usize]);
                let uv = primitive.coordinates.as_ref().filter(|_| is_painted);
                let corner = Corner {
                    uv: uv.map_or([[0.0; 2]; 3], |uv| [a, b, c].map(|vertex| uv[vertex as usize])),
                    material: if lies { primitive.material } else { NONE },
                };
                if !primitive.is_shown(triangle, material) {
                    if lies {
                        out.clear.push(SurfaceTriangle {
                            p,
                            material: primitive.material,
                            light: NONE,
                            instance: NONE,
                        });
                        out.corners[1].push(corner);
                    }
                    continue;
                }
                let radiance = primitive.triangle_radiance(triangle, material.radiance);
                let light = if emits(radiance) {
                    out.emissive.push(EmissiveTriangle {
                        p,
                        radiance,
                        mesh: mesh_light,
                        flags,
                    });
                    if is_painted {
                        out.corners[2].push(corner);
                    }
                    out.emissive.len() as u32 - 1
                } else {
                    NONE
                };
                out.triangles.push(SurfaceTriangle {
                    p,
                    material: primitive.material,
                    light,
                    instance: mesh_light,
                });
                if is_painted {
                    out.corners[0].push(corner);
                }
            }

            let count = out.emissive.len() as u32 - first;
            if count > 0 {
                out.mesh_lights.push(MeshRange {
                    first,
                    count,
                    name: format!("{}/{}", node.name, mesh.name),
                });
            }
        }
    }
}

/// Whether any channel is above zero.
pub(super) fn emits(radiance: [f32; 3]) -> bool {
    radiance.iter().any(|&channel| channel > 0.0)
}

/// Rounds once, from `f64`.
pub(super) fn rounded(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| flush(x as f32, MIN_COORDINATE))
}
