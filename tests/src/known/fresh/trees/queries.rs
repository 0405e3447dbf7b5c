//! What is asked of a tree: points, random numbers, lights.

use lightbvh::{INVALID, Node, Random64, ShadingPoint, Summary, exact};
use lightbvh_kernels::bvh::TriangleChoice;
use lightbvh_kernels::query::Query;

use crate::generate::{Random, log_uniform};
use crate::known::tree::{Tree, light_of};

/// Random numbers at each point.
const NUMBERS: usize = 5;

/// Numbers at the ends of their range, of its halves, and of the share of uniform choice.
const ENDS: [u32; 8] = [
    0,
    1,
    u32::MAX,
    u32::MAX - 1,
    1 << 31,
    (1 << 31) - 1,
    1 << 26,
    (1 << 26) - 1,
];

/// Points around the lights and at the ends of the domain; of each the numbers that choose lights, and lights to evaluate.
pub(super) fn ask<C: TriangleChoice<W>, const W: usize>(tree: &mut Tree<C::Node, W>, random: &mut Random) {
    let (nodes, _) = tree.refitted();
    let all = nodes[tree.push.root as usize].merged().bounds();
    let size = (all.max - all.min)
        .max_element()
        .min(exact::pow2(39))
        .max(exact::pow2(-60));
    let mut points = Vec::new();
    for i in 0..36 {
        let p: [f32; 3] = match i {
            0 => [0.0; 3],
            1 => [exact::pow2(40), -exact::pow2(40), exact::pow2(40)],
            2 => [exact::pow2(-100), 0.0, 0.0],
            // On a vertex of a light of the top level's space, near it, and at the middle of everything.
            3 => [all.min.x, all.min.y, all.min.z],
            4 => ((all.min + all.max) * 0.5).to_array(),
            5..=9 => {
                let triangle = tree.triangles[random.below(tree.triangles.len() as u32) as usize];
                let by = log_uniform(random, -40, 0);
                let d = random.direction();
                std::array::from_fn(|k| triangle.p[i % 3][k] + d[k] * by)
            }
            // At a light's own distance, among the lights, and at every distance from the middle.
            10..=24 => {
                let triangle = tree.triangles[random.below(tree.triangles.len() as u32) as usize];
                let edge = (0..3)
                    .map(|k| (triangle.p[1][k] - triangle.p[0][k]).abs())
                    .fold(exact::pow2(-60), f32::max);
                let by = edge * log_uniform(random, -2, 3);
                let d = random.direction();
                std::array::from_fn(|k| triangle.p[0][k] + d[k] * by)
            }
            25..=30 => std::array::from_fn(|k| {
                let (low, high) = (all.min[k], all.max[k]);
                low + (high - low) * random.between(-0.2, 1.2)
            }),
            _ => {
                let by = size * log_uniform(random, -30, 3);
                random.direction().map(|d| d * by)
            }
        };
        let far = exact::pow2(40);
        let n = match i % 7 {
            0 => [0.0; 3],
            1 => [0.0, -1.0, 0.0],
            _ => random.direction(),
        };
        points.push(ShadingPoint {
            p: p.map(|x| x.clamp(-far, far)),
            n,
        });
    }
    for &point in &points {
        for k in 0..NUMBERS {
            let number = if k < 2 {
                ENDS[random.below(ENDS.len() as u32) as usize]
            } else {
                random.bits()
            };
            let number = Random64::from(number);
            tree.samples.push(Query {
                point,
                words: [number.high, number.low],
            });
        }
    }
    let (sampled, _) = tree.queried::<C>(&nodes);
    let lights = tree.meshes_of_lights.len() as u32;
    for (i, (query, sampled)) in tree.samples.iter().zip(&sampled).enumerate() {
        // Every light that was drawn, but for repetitions, and others.
        let other = random.below(lights);
        let light = if i % 3 == 2 {
            other
        } else {
            light_of(sampled).unwrap_or(other)
        };
        let mesh = tree.meshes_of_lights[light as usize];
        let asked = Query {
            words: [light, if tree.push.live > 0 { mesh } else { INVALID }],
            ..*query
        };
        if !tree.pmfs.contains(&asked) {
            tree.pmfs.push(asked);
        }
    }
}
