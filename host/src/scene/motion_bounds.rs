//! Bounds of a scene over all its frames: where instances can get and what they can emit.

use lightbvh::light::MAX_COORDINATE;

use super::animate::world_transforms;
use super::error::SceneError;
use super::model::{Interpolation, Mesh, Property, SceneData};
use super::transform::Transform;
use crate::vector::{dot, normal};

/// Bound of the scene's total flux, W: leaves room below `f32::MAX` (about 2^128) for sums and products.
const MAX_FLUX: f64 = (1_u128 << 100) as f64;

/// Refuses scenes that could leave the coordinate range, or emit beyond `f32`, in any frame.
///
/// `data` must have passed all other checks.
pub(super) fn check(data: &SceneData) -> Result<(), SceneError> {
    let out_of_range = |element: String, value: f64, expected: &str| SceneError::Invalid {
        scene: data.name.clone(),
        problem: format!("{element} is {value}, expected {expected}"),
    };
    let motion = Motion::of(data);
    let extent: Vec<f64> = data.meshes.iter().map(mesh_extent).collect();
    let flux: Vec<f64> = data.meshes.iter().map(|mesh| mesh_flux(data, mesh)).collect();

    // A point at distance r from a node's origin stays within `offset + stretch * r` of the world's origin.
    let mut bounds: Vec<(f64, f64)> = Vec::with_capacity(data.nodes.len());
    let mut total_flux = 0.0;
    for (n, node) in data.nodes.iter().enumerate() {
        let (offset, stretch) = node.parent.map_or((0.0, 1.0), |parent| bounds[parent as usize]);
        let (offset, stretch) = (offset + stretch * motion.offset[n], stretch * motion.stretch[n]);
        bounds.push((offset, stretch));
        let reach = offset + stretch * node.mesh.map_or(0.0, |mesh| extent[mesh as usize]);
        // NaN, from infinity times zero, is refused too.
        if reach.is_nan() || reach > f64::from(MAX_COORDINATE) {
            let element = format!("farthest point that node {n} `{}` can reach", node.name);
            return Err(out_of_range(
                element,
                reach,
                "within 2^40 metres of the origin in every frame",
            ));
        }
        total_flux += node
            .mesh
            .map_or(0.0, |mesh| stretch * stretch * flux[mesh as usize]);
    }
    if total_flux.is_nan() || total_flux > MAX_FLUX {
        let element = String::from("bound of the total flux in watts");
        return Err(out_of_range(
            element,
            total_flux,
            "at most 2^100; lower the emissive strength or the scale",
        ));
    }
    Ok(())
}

/// World-space bounds of the triangles at frame 0, of a scene that passed [`check`]; vertices of none do not count. The origin
/// where there is no triangle.
pub(super) fn bounds(data: &SceneData) -> ([f64; 3], [f64; 3]) {
    let world = world_transforms(data, 0.0);
    let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (node, to_world) in data.nodes.iter().zip(&world) {
        let Some(mesh) = node.mesh else { continue };
        let corners = data.meshes[mesh as usize]
            .primitives
            .iter()
            .flat_map(|primitive| {
                let vertices = primitive.triangles.as_flattened().iter();
                vertices.map(|&vertex| primitive.positions[vertex as usize])
            });
        for position in corners {
            let p = to_world.point(position.map(f64::from));
            for axis in 0..3 {
                min[axis] = min[axis].min(p[axis]);
                max[axis] = max[axis].max(p[axis]);
            }
        }
    }
    if min[0] <= max[0] {
        (min, max)
    } else {
        ([0.0; 3], [0.0; 3])
    }
}

/// Largest distance of a vertex from the mesh's origin.
fn mesh_extent(mesh: &Mesh) -> f64 {
    let points = mesh.primitives.iter().flat_map(|primitive| &primitive.positions);
    points.map(length).fold(0.0, f64::max)
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

/// Upper bounds per node of the translation's length and of the linear part's growth, over all keys.
struct Motion {
    offset: Vec<f64>,
    stretch: Vec<f64>,
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
        for channel in data.animations.iter().flat_map(|animation| &animation.channels) {
            let bound = match channel.property {
                Property::Translation => &mut offset[channel.node as usize],
                Property::Scale => &mut stretch[channel.node as usize],
                Property::Rotation => continue,
            };
            let peak = channel
                .values
                .iter()
                .map(|&[x, y, z, _]| length(&[x, y, z]))
                .fold(0.0, f64::max);
            // Hermite weights: the values' lie in [0, 1], the tangents' within 4/27 of the span; see `animate`.
            let factor = match channel.interpolation {
                Interpolation::CubicSpline => 2.0 + 0.3 * longest_span(&channel.times),
                Interpolation::Step | Interpolation::Linear => 1.0,
            };
            *bound = bound.max(factor * peak);
        }
        Self { offset, stretch }
    }
}

fn longest_span(times: &[f32]) -> f64 {
    times
        .windows(2)
        .map(|pair| f64::from(pair[1]) - f64::from(pair[0]))
        .fold(0.0, f64::max)
}

fn length(v: &[f32; 3]) -> f64 {
    v.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt()
}

fn largest(v: &[f32]) -> f64 {
    v.iter().map(|&x| f64::from(x).abs()).fold(0.0, f64::max)
}
