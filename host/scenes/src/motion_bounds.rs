//! Bounds of a scene over all its frames: where instances can get and what they can emit.

use std::collections::BTreeMap;

use lightbvh::light::MAX_COORDINATE;

use super::check::Check;
use super::deform::{Skin, affine, deforms, is_skinned};
use super::error::SceneError;
use super::model::{Interpolation, Mesh, Primitive, Property, SceneData};
use super::transform::Transform;
use crate::vector::{dot, normal};

/// Bound of the scene's total flux, W: leaves room below `f32::MAX` (about 2^128) for sums and products.
const MAX_FLUX: f64 = (1_u128 << 100) as f64;

/// Refuses scenes that could leave the coordinate range, or emit beyond `f32`, in any frame.
///
/// `data` must have passed all other checks.
pub(super) fn check(data: &SceneData) -> Result<(), SceneError> {
    let check = Check { scene: &data.name };
    let farthest = f64::from(MAX_COORDINATE);
    let motion = Motion::of(data);
    let extent: Vec<f64> = data.meshes.iter().map(mesh_extent).collect();
    let flux: Vec<f64> = data.meshes.iter().map(|mesh| mesh_flux(data, mesh)).collect();

    // A point at distance r from a node's origin stays within `offset + stretch * r` of the world's origin.
    let mut bounds: Vec<(f64, f64)> = Vec::with_capacity(data.nodes.len());
    for (n, node) in data.nodes.iter().enumerate() {
        let (offset, stretch) = node.parent.map_or((0.0, 1.0), |parent| bounds[parent as usize]);
        bounds.push((offset + stretch * motion.offset[n], stretch * motion.stretch[n]));
    }
    // The same for all joints of a skin, from the mesh's origin.
    let skins: Vec<(f64, f64)> = data.skins.iter().map(|skin| skin_bound(skin, &bounds)).collect();

    let mut total_flux = 0.0;
    for (n, node) in data.nodes.iter().enumerate() {
        let mesh = node.mesh.map(|mesh| mesh as usize);
        let primitives = mesh.map_or(&[][..], |mesh| &data.meshes[mesh].primitives);
        let (offset, stretch) = bounds[n];
        let mut reach = offset + stretch * mesh.map_or(0.0, |mesh| extent[mesh]);
        total_flux += mesh.map_or(0.0, |mesh| stretch * stretch * flux[mesh]);
        for primitive in primitives.iter().filter(|primitive| deforms(data, n, primitive)) {
            let (offset, stretch) = match node.skin {
                Some(skin) if is_skinned(data, n, primitive) => skins[skin as usize],
                _ => bounds[n],
            };
            let distance = morphed_extent(primitive, |target| motion.weight(data, n, target));
            let within = offset + stretch * distance;
            reach = reach.max(within);
            // No triangle in a ball is larger than twice the square of its radius.
            total_flux += 2.0 * within * within * radiance_sum(data, primitive);
        }
        // NaN, from infinity times zero, is refused too.
        let element = || format!("farthest point that node {n} `{}` can reach", node.name);
        let expected = "expected one within 2^40 metres of the origin in every frame";
        check.within(element, &[reach], 0.0..=farthest, expected)?;
        // A light BVH takes no such transform, however small what it places.
        if mesh.is_some() {
            let element = || format!("bound of the scale of node {n} `{}`", node.name);
            let expected = "expected at most 2^40; scale the mesh instead";
            check.within(element, &[stretch], 0.0..=farthest, expected)?;
        }
    }
    for (index, light) in data.analytic.iter().enumerate() {
        let Some(extent) = light.kind.extent() else {
            continue;
        };
        let (offset, stretch) = bounds[light.node as usize];
        let (name, node) = (&light.name, &data.nodes[light.node as usize].name);
        let element = || {
            let on = light.node;
            format!("bound of the size of light {index} `{name}` on node {on} `{node}`")
        };
        let expected = "expected at most 2^40 metres, its scale at most 2^40; lower the node's scale";
        check.within(
            element,
            &[stretch, offset + stretch * extent],
            0.0..=farthest,
            expected,
        )?;
    }
    let element = || String::from("bound of the total flux in watts");
    let expected = "expected at most 2^100; lower the emissive strength or the scale";
    check.within(element, &[total_flux], 0.0..=MAX_FLUX, expected)
}

/// Largest distance of a vertex from the mesh's origin.
fn mesh_extent(mesh: &Mesh) -> f64 {
    let points = mesh.primitives.iter().flat_map(|primitive| &primitive.positions);
    points.map(|p| length(p)).fold(0.0, f64::max)
}

/// Upper bound of the flux of one unscaled instance: pi times area times radiance, both sides, all channels.
fn mesh_flux(data: &SceneData, mesh: &Mesh) -> f64 {
    let mut flux = 0.0;
    for primitive in &mesh.primitives {
        let of_material = data.materials[primitive.material as usize].radiance;
        for (index, triangle) in primitive.triangles.iter().enumerate() {
            let radiance = primitive.triangle_radiance(index, of_material).map(f64::from);
            let normal = normal(triangle.map(|vertex| primitive.positions[vertex as usize]));
            let area = 0.5 * dot(normal, normal).sqrt();
            flux += 2.0 * std::f64::consts::PI * area * radiance.iter().sum::<f64>();
        }
    }
    flux
}

/// Largest distance of a vertex from the mesh's origin, each target as far as `weight` says.
fn morphed_extent(primitive: &Primitive, weight: impl Fn(usize) -> f64) -> f64 {
    let mut far: Vec<f64> = primitive.positions.iter().map(|p| length(p)).collect();
    for (t, target) in primitive.targets.iter().enumerate() {
        let weight = weight(t);
        for (far, moved) in far.iter_mut().zip(target) {
            *far += weight * length(moved);
        }
    }
    far.into_iter().fold(0.0, f64::max)
}

/// How far the joints of a skin can take a point: see [`check`].
fn skin_bound(skin: &Skin, nodes: &[(f64, f64)]) -> (f64, f64) {
    let mut bound = (0.0_f64, 0.0_f64);
    for (&joint, bind) in skin.joints.iter().zip(&skin.inverse_bind) {
        let bind = affine(bind);
        let moved = bind.columns[3].iter().map(|x| x * x).sum::<f64>().sqrt();
        let (offset, stretch) = nodes[joint as usize];
        // `max` leaves NaN out, which an infinite product of zero is; infinity is refused as well.
        let far = [offset + stretch * moved, stretch * bind.stretch()]
            .map(|x| if x.is_nan() { f64::INFINITY } else { x });
        bound = (bound.0.max(far[0]), bound.1.max(far[1]));
    }
    bound
}

/// Sum of the radiance of all triangles, both sides, all channels, times pi.
fn radiance_sum(data: &SceneData, primitive: &Primitive) -> f64 {
    let of_material = data.materials[primitive.material as usize].radiance;
    let triangles = 0..primitive.triangles.len();
    let radiance = triangles.flat_map(|t| primitive.triangle_radiance(t, of_material));
    2.0 * std::f64::consts::PI * radiance.map(f64::from).sum::<f64>()
}

/// Upper bounds per node of the translation's length and of the linear part's growth, over all keys.
struct Motion {
    offset: Vec<f64>,
    stretch: Vec<f64>,
    /// Of the weights' sizes, of nodes where they are animated.
    weights: BTreeMap<usize, Vec<f64>>,
}

impl Motion {
    fn of(data: &SceneData) -> Self {
        let mut offset = Vec::with_capacity(data.nodes.len());
        let mut stretch = Vec::with_capacity(data.nodes.len());
        for node in &data.nodes {
            let affine = node.transform.affine();
            offset.push(affine.columns[3].iter().map(|x| x * x).sum::<f64>().sqrt());
            stretch.push(match node.transform {
                Transform::Trs { scale, .. } => largest(&scale),
                Transform::Matrix(_) => affine.stretch(),
            });
        }
        let mut weights: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
        for channel in data.animations.iter().flat_map(|animation| &animation.channels) {
            let node = channel.node as usize;
            let factor = spline_factor(channel.interpolation, &channel.times);
            let rows = channel.values.chunks_exact(channel.property.numbers());
            let bound = match channel.property {
                Property::Translation => &mut offset[node],
                Property::Scale => &mut stretch[node],
                Property::Rotation => continue,
                Property::Weights(targets) => {
                    let peaks = weights.entry(node).or_default();
                    peaks.resize(peaks.len().max(targets as usize), 0.0);
                    for row in rows {
                        for (peak, &weight) in peaks.iter_mut().zip(row) {
                            *peak = peak.max(factor * f64::from(weight).abs());
                        }
                    }
                    continue;
                }
            };
            *bound = bound.max(factor * rows.map(length).fold(0.0, f64::max));
        }
        Self {
            offset,
            stretch,
            weights,
        }
    }

    /// Upper bound of the size of a target's weight.
    fn weight(&self, data: &SceneData, node: usize, target: usize) -> f64 {
        let still = data.nodes[node].weights.get(target);
        let moving = self.weights.get(&node).and_then(|peaks| peaks.get(target));
        still
            .map_or(0.0, |&w| f64::from(w).abs())
            .max(moving.copied().unwrap_or(0.0))
    }
}

/// How much further than its keys' values an interpolation gets.
fn spline_factor(interpolation: Interpolation, times: &[f32]) -> f64 {
    match interpolation {
        // Hermite weights: the values' lie in [0, 1], the tangents' within 4/27 of the span; see `animate`.
        Interpolation::CubicSpline => {
            let spans = times
                .windows(2)
                .map(|pair| f64::from(pair[1]) - f64::from(pair[0]));
            2.0 + 0.3 * spans.fold(0.0, f64::max)
        }
        Interpolation::Step | Interpolation::Linear => 1.0,
    }
}

fn length(v: &[f32]) -> f64 {
    v.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt()
}

fn largest(v: &[f32]) -> f64 {
    v.iter().map(|&x| f64::from(x).abs()).fold(0.0, f64::max)
}
