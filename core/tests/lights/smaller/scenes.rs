//! Random scenes of lights, the same in any light BVH.

use lightbvh::exact::{self, pow2};
use lightbvh::{BuildParams, Bvh, Edit, EmissiveTriangle, InstanceId, LightNode, ShadingPoint, Transform};

use crate::kit::Random;

/// Triangles of sizes and fluxes far apart, some without area or radiance, in a cube of 2 `size`; `flags` as given.
pub fn mesh(random: &mut Random, size: f32, count: u32, flags: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let at = random.vector(size);
        let edge = size * pow2(-(random.below(20) as i32));
        let vertex = |random: &mut Random| {
            let away = random.vector(edge);
            [0, 1, 2].map(|k| at[k] + away[k])
        };
        let b = vertex(random);
        let c = if random.below(12) == 0 { b } else { vertex(random) };
        let radiance = match random.below(8) {
            0 => 0.0,
            _ => pow2(random.below(70) as i32 - 35),
        };
        // So thin that no normal is known of it: as good as two-sided.
        let needle = flags != 0 && random.below(10) == 0;
        EmissiveTriangle {
            p: if needle { thin(edge) } else { [at, b, c] },
            radiance: [radiance; 3],
            mesh: 0,
            flags: if needle { 0 } else { flags },
        }
    };
    (0..count).map(triangle).collect()
}

/// A cross product of 2^-70 of the longer edge squared.
fn thin(edge: f32) -> [[f32; 3]; 3] {
    [[0.0; 3], [edge, 0.0, 0.0], [0.0, edge * pow2(-70), 0.0]]
}

pub fn transform(random: &mut Random, size: f32) -> Transform {
    let columns = match random.below(3) {
        0 => Transform::IDENTITY.columns,
        // Any map, flat ones too.
        1 => [0; 3].map(|_| random.vector(2.0)),
        _ => [random.vector(1.0), [0.0; 3], random.vector(1.0)],
    };
    Transform {
        columns,
        translation: random.vector(4.0 * size),
    }
}

/// The same meshes, instances and moves in any light BVH.
pub fn scene<N: LightNode<W>, I, const W: usize>(seed: u32, flags: u32, params: BuildParams) -> Bvh<N, I, W> {
    let random = &mut Random(seed.wrapping_mul(7919));
    let size = pow2(random.below(60) as i32 - 30);
    let mut bvh = Bvh::new(params);
    let mut instances: Vec<InstanceId> = Vec::new();
    for _ in 0..1 + random.below(3) {
        let count = 1 + random.below(60);
        let own = bvh
            .add_mesh(mesh(random, size, count, flags))
            .expect("within the domain");
        for _ in 0..1 + random.below(4) {
            let edit = Edit::AddInstance {
                mesh: own,
                transform: transform(random, size),
                radiance: [1.0, 0.25, 0.0][random.below(3) as usize],
            };
            instances.extend(bvh.apply(vec![edit]).expect("an instance").instances);
        }
    }
    bvh.refit();
    // Refits, and a top level that edits have patched.
    for id in instances {
        if random.below(3) == 0 {
            bvh.set_transform(id, transform(random, size))
                .expect("within the domain");
        }
    }
    bvh.refit();
    bvh
}

pub fn points(seed: u32, lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random(seed.wrapping_mul(104_729));
    let point = |_| {
        let near = lights[random.below(lights.len() as u32) as usize].p[0];
        let size = near.into_iter().map(exact::abs).fold(pow2(-30), exact::max);
        let away = random.vector(size);
        let n = match random.below(4) {
            0 => [0.0; 3],
            _ => {
                let v = random.vector(1.0);
                let length = exact::sqrt(v.iter().map(|x| x * x).sum::<f32>());
                v.map(|x| x / length)
            }
        };
        let p = [0, 1, 2].map(|k| near[k] + away[k]);
        ShadingPoint { p, n }.checked().expect("a shading point")
    };
    (0..24).map(point).collect()
}
