//! What edits leave of a tree: its variance after many, without any rebuild, against that of a tree built over what is there then.

use lightbvh::bvh::RebuildParams;
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{INVALID, ShadingPoint};
use rayon::prelude::*;
use serde::Serialize;

use super::scene::Scene;
use crate::backend::Bvh;
use crate::cli::bench::trade::diffuse;

/// Instances of the scene, and points where variance is taken.
const INSTANCES: u32 = 10_000;
const POINTS: u32 = 400;

/// The variance of one light sample, over the square of the mean, of unshadowed diffuse light.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Quality {
    pub instances: u32,
    /// Additions, removals and moves to anywhere and nearby, in no order, each a batch and a refit of its own.
    pub edits: u32,
    /// Mean over the points, of the tree that was edited, and of one built over the same.
    pub edited: f64,
    pub fresh: f64,
    /// The same for the median of the points' ratios.
    pub median_ratio: f64,
    /// Their geometric mean. The means' own would be that of the few points that lie beside a light, whose variances are those
    /// of chance.
    pub ratio: f64,
    /// Of nine in ten, and of the worst point.
    pub ninth_ratio: f64,
    pub most_ratio: f64,
}

/// Makes so many edits and compares.
pub(super) fn measure(edits: u32) -> Quality {
    let mut scene = Scene::of_instances(INSTANCES);
    for _ in 0..edits {
        match scene.below(4) {
            0 => {
                // One comes where one goes, so that there are as many in the end.
                let gone = scene.one_less();
                scene.bvh.remove_instance(gone).expect("it is there");
                scene.bvh.take_removed_lights();
                scene.bvh.refit();
                let edit = scene.new_instance();
                let added = scene.bvh.apply(vec![edit]).expect("within the domain");
                scene.instances.extend(added.instances);
            }
            1 => {
                let (instance, transform) = (scene.some(), scene.anywhere());
                scene
                    .bvh
                    .set_transform(instance, transform)
                    .expect("within the domain");
            }
            _ => {
                let instance = scene.some();
                let transform = scene.near(instance);
                scene
                    .bvh
                    .set_transform(instance, transform)
                    .expect("within the domain");
            }
        }
        scene.bvh.refit();
    }
    let side = scene.side;
    let edited = variances(&scene.bvh, side);
    let fresh = variances(&anew(&scene.bvh), side);
    let mut ratios: Vec<f64> = edited.iter().zip(&fresh).map(|(a, b)| a / b).collect();
    ratios.sort_by(f64::total_cmp);
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len().max(1) as f64;
    Quality {
        instances: INSTANCES,
        edits,
        edited: mean(&edited),
        fresh: mean(&fresh),
        median_ratio: ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN),
        ratio: mean(&ratios.iter().map(|ratio| ratio.ln()).collect::<Vec<_>>()).exp(),
        ninth_ratio: ratios.get(ratios.len() * 9 / 10).copied().unwrap_or(f64::NAN),
        most_ratio: ratios.last().copied().unwrap_or(f64::NAN),
    }
}

/// The same, its top level built over the instances as they are.
fn anew(bvh: &Bvh) -> Bvh {
    let mut bvh = bvh.clone();
    let top = RebuildParams {
        top: 1.0,
        drift: f64::INFINITY,
    };
    let built = bvh.rebuild(&top).run();
    bvh.install(built).expect("its own");
    bvh.refit();
    bvh
}

/// At each point that some light reaches.
fn variances(bvh: &Bvh, side: f32) -> Vec<f64> {
    let lights = bvh.world_lights();
    let all = (0..POINTS).into_par_iter().map(|i| {
        let draw = |k: u32| unit_f32(hash(hash(i ^ 0x0bad_cafe).wrapping_add(k)));
        let up = if i % 2 == 0 { 1.0 } else { -1.0 };
        let point = ShadingPoint {
            p: std::array::from_fn(|k| side * draw(k as u32)),
            n: [0.0, up, 0.0],
        };
        let (mut mean, mut square) = (0.0, 0.0);
        for (light, triangle) in (0..).zip(&lights).filter(|(_, light)| light.mesh != INVALID) {
            let received = diffuse(triangle, &point);
            if received > 0.0 {
                mean += received;
                square += received * received / f64::from(bvh.pmf(&point, light, triangle.mesh));
            }
        }
        (mean > 0.0).then(|| square / (mean * mean) - 1.0)
    });
    all.flatten().collect()
}
