//! Inputs of the image: a room with a box in it, lit by three meshes of small lights.

use lightbvh::TreeWords;
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights};
use lightbvh_host::render::{RayBvh, View, camera};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use super::super::Table;
use super::array;
use crate::generate::Random;

/// Columns and rows.
const SIZE: u32 = 64;

/// The image.
pub fn image() -> (&'static str, Vec<Table>) {
    let random = &mut Random::new(0x6b6e_6f09);
    let mut surfaces = Vec::new();
    let mut quad = |corner: [f32; 3], u: [f32; 3], v: [f32; 3], material: u32| {
        let at = |s: f32, t: f32| std::array::from_fn(|k| corner[k] + s * u[k] + t * v[k]);
        for p in [
            [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)],
            [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        ] {
            surfaces.push(SurfaceTriangle {
                p,
                material,
                light: NONE,
                instance: NONE,
            });
        }
    };
    // Floor, back, left; a box that throws shadows.
    quad([-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0], 0);
    quad([-4.0, 0.0, -4.0], [8.0, 0.0, 0.0], [0.0, 5.0, 0.0], 1);
    quad([-4.0, 0.0, 4.0], [0.0, 0.0, -8.0], [0.0, 5.0, 0.0], 2);
    quad([-0.8, 0.0, 0.8], [1.6, 0.0, 0.0], [0.0, 1.5, 0.0], 2);
    quad([0.8, 0.0, 0.8], [0.0, 0.0, -1.6], [0.0, 1.5, 0.0], 2);
    quad([-0.8, 1.5, 0.8], [1.6, 0.0, 0.0], [0.0, 0.0, -1.6], 3);
    let triangles: Vec<EmissiveTriangle> = (0..24)
        .map(|i| {
            let mesh = i / 8;
            let center = [[-2.0, 3.5, 0.0], [2.5, 3.0, -2.0], [1.5, 0.6, 2.0]][mesh as usize];
            let mut vertex = || center.map(|c: f32| c + random.between(-0.4, 0.4));
            let p = [vertex(), vertex(), vertex()];
            let radiance = [[20.0, 16.0, 9.0], [6.0, 9.0, 22.0], [12.0, 3.0, 2.0]][mesh as usize];
            EmissiveTriangle {
                p,
                radiance,
                mesh,
                flags: u32::from(i % 3 == 0),
            }
        })
        .collect();
    let lights = Lights::new(triangles).expect("within the domain");
    surfaces.extend(
        lights
            .triangles()
            .iter()
            .enumerate()
            .map(|(i, light)| SurfaceTriangle {
                p: light.p,
                material: 0,
                light: i as u32,
                instance: light.mesh,
            }),
    );
    let rays = RayBvh::build(&surfaces).expect("within the domain");
    let material = |albedo, specular, exponent_log2| Material {
        albedo,
        specular,
        exponent_log2,
    };
    let materials = [
        material([0.7, 0.7, 0.65], 0.0, 0),
        material([0.3, 0.5, 0.7], 0.1, 4),
        material([0.7, 0.25, 0.2], 0.04, 2),
        material([0.1, 0.1, 0.1], 0.8, 10),
    ];
    let view = View {
        eye: [0.5, 2.2, 6.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.98, -0.2],
        forward: [0.0, -0.2, -0.98],
        yfov: 0.9,
    };
    let bvh = LightBvh::two_level(&lights, &BuildParams::default());
    let tree = bvh.tree();
    let params = RenderParams {
        width: SIZE,
        height: SIZE,
        samples: 2,
        first: 0,
        all: 0,
        candidates: 1,
        scattered: 0,
        part: 0,
        parts: 1,
        seed: 1,
        jitter: 7,
        background: [0.02, 0.03, 0.05],
    };
    let push = TreeWords::of(&tree);
    let mut pixels = Table::new(
        "pixels",
        "pixel by pixel from the upper left: radiance, linear RGB",
        0,
        3,
        &[],
    );
    pixels.words = vec![0; (SIZE * SIZE * 3) as usize];
    let tables = vec![
        array(
            "params",
            "width height samples candidates scattered seed part parts jitter background[3]",
            &[params],
        ),
        array(
            "tree",
            "root node, words per trail, instances in use, triangles of a single level, depth",
            &[push],
        ),
        array(
            "camera",
            "origin[3] right[3] up[3] forward[3]",
            &[camera(&view, SIZE, SIZE)],
        ),
        array("materials", "albedo[3] specular exponent_log2", &materials),
        array(
            "ray_nodes",
            "min[3][8] max[3][8] children[8]: 16 block + count, 16 node",
            &rays.nodes,
        ),
        array(
            "surfaces",
            "p[3][3][4] material[4] light[4] instance[4]: four triangles each",
            &rays.blocks,
        ),
        array(
            "triangles",
            "p0[3] p1[3] p2[3] radiance[3] mesh flags",
            lights.triangles(),
        ),
        array(
            "nodes",
            "of the default layout, refitted; see tree_two_levels.txt",
            tree.nodes,
        ),
        array(
            "instances",
            "leaves of the top level; see tree_instances.txt",
            tree.instances,
        ),
        array(
            "trails",
            "bit trails of the triangles, low word first",
            tree.trails,
        ),
        pixels,
    ];
    (
        "A 64x64 image: direct light of two samples per pixel, pass `render_bvh`.",
        tables,
    )
}
