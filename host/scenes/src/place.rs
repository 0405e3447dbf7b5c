//! The scene at a time, in the same order every frame.

use lightbvh::light::{EmissiveTriangle, TWO_SIDED};
use lightbvh_kernels::shading::textures::Corner;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use super::animate::Pose;
use super::camera::view_of_node;
use super::flush::rounded;
use super::frame::{FRAMES_PER_SECOND, Frame, MeshRange, NO_CORNER};
use super::lamps;
use super::model::{Material, SceneData, emits};
use super::scene::Scene;
use super::transform::mirrors;

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
            corners: [const { Vec::new() }; 2],
            textures: self.texture_words(),
            materials: data.materials.iter().map(Material::surface).collect(),
            camera: view_of_node(&pose.unscaled(data.cameras[0].node), data.cameras[0].yfov),
            background: data.background,
        };
        place_meshes(data, &pose, &mut out);
        lamps::place(data, &pose, &mut out);
        if !out.textures.is_empty() {
            // Lamps have no textures.
            out.corners[0].resize(out.triangles.len(), NO_CORNER);
        }
        out
    }
}

/// Appends the triangles of every node, in the order node, primitive, triangle.
fn place_meshes(data: &SceneData, pose: &Pose, out: &mut Frame) {
    for (index, node) in data.nodes.iter().enumerate() {
        let Some(mesh) = node.mesh.map(|mesh| &data.meshes[mesh as usize]) else {
            continue;
        };
        for primitive in &mesh.primitives {
            let material = &data.materials[primitive.material as usize];
            let flags = if material.double_sided { TWO_SIDED } else { 0 };
            let mesh_light = out.mesh_lights.len() as u32;
            let first = out.emissive.len() as u32;
            let mirrored = mirrors(&pose.world[index]);
            let points = pose.points(index, primitive).map(|p| rounded(p.into()));
            let points: Vec<[f32; 3]> = points.collect();
            let has_textures = !out.textures.is_empty();
            // Textures without coordinates are not shown.
            let own = material.textures.as_ref().filter(|textures| textures.is_seen());
            let lies = own
                .is_some_and(|textures| primitive.coordinates.is_some() || textures.all().next().is_none());

            for (triangle, &[a, b, c]) in primitive.triangles.iter().enumerate() {
                // A mirrored instance would show its back; swapping two vertices keeps the front in front.
                let [b, c] = if mirrored { [c, b] } else { [b, c] };
                let p = [a, b, c].map(|vertex| points[vertex as usize]);
                let uv = primitive.coordinates.as_ref().filter(|_| has_textures);
                let corner = Corner {
                    uv: uv.map_or([[0.0; 2]; 3], |uv| [a, b, c].map(|vertex| uv[vertex as usize])),
                    material: if lies { primitive.material } else { NONE },
                };
                let radiance = primitive.triangle_radiance(triangle, material.radiance);
                let light = if emits(radiance) {
                    out.emissive.push(EmissiveTriangle {
                        p,
                        radiance,
                        mesh: mesh_light,
                        flags,
                    });
                    if has_textures {
                        out.corners[1].push(corner);
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
                if has_textures {
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
