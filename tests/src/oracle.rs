//! Oracles in f64, independent of the arithmetic under test: angles, cones, sums and orders, triangles.

use glam::DVec3;
use lightbvh::device::cone::Cone;
use lightbvh::device::trail::leaf_parts;
use lightbvh::node::kind;
use lightbvh::tree::Model;
use lightbvh::{
    BuildParams, Bvh, EmissiveTriangle, ImportanceModel, LightBounds, LightNode, LightTree, Lights,
    ShadingPoint,
};
pub use lightbvh_fuzz::input::{pmf_of, sum_is_one};

/// A vector of the crate in f64.
#[must_use]
pub fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}

/// A triangle in f64.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Vertices, metres.
    pub p: [DVec3; 3],
    /// (p1 − p0) × (p2 − p0), twice the area long.
    pub normal: DVec3,
    /// By how much rounding of the edges is enlarged in the direction of the normal: |e1| |e2| / |e1 × e2|.
    pub condition: f64,
}

impl Triangle {
    /// The triangle of a light.
    #[must_use]
    pub fn new(light: &EmissiveTriangle) -> Self {
        let p = light.p.map(vector);
        let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
        let normal = e1.cross(e2);
        Self {
            p,
            normal,
            condition: e1.length() * e2.length() / normal.length(),
        }
    }

    /// Area, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        0.5 * self.normal.length()
    }
}

/// The angle between two vectors of any length, precise at every angle.
#[must_use]
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    a.cross(b).length().atan2(a.dot(b))
}

/// The half-angle of a cone, whole sphere from −1 on.
#[must_use]
pub fn half_angle(cos_theta_o: f32) -> f64 {
    f64::from(cos_theta_o).clamp(-1.0, 1.0).acos()
}

/// By how much (rad) the cone `inner` reaches out of the cone `outer`; 0 if not at all.
#[must_use]
pub fn cone_excess(outer: (DVec3, f32), inner: (DVec3, f32)) -> f64 {
    let reach = angle(outer.0, inner.0) + half_angle(inner.1);
    let reach = reach.min(std::f64::consts::PI);
    (reach - half_angle(outer.1)).max(0.0)
}

/// A BVH over `lights`, in two levels or in one.
#[must_use]
pub fn built<N: LightNode<W>, const W: usize>(
    lights: &Lights,
    params: &BuildParams,
    two: bool,
) -> Bvh<(N, ()), W> {
    if two {
        Bvh::two_level(lights, params)
    } else {
        Bvh::single_level(lights, params)
    }
}

/// Probability of every light at `point`.
pub fn all_pmfs<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<impl Model<W, Node = N, Light = EmissiveTriangle>, W>,
    lights: &Lights,
    point: &ShadingPoint,
) -> Vec<f32> {
    (0..lights.all().len() as u32)
        .map(|i| pmf_of::<_, I, _>(bvh, lights, point, i))
        .collect()
}

/// The leaves of a tree in the order of its slots: (triangle, instance), without an instance in a single-level tree.
#[must_use]
pub fn leaves<N: LightNode<W>, I, const W: usize>(tree: &LightTree<'_, N, I, W>) -> Vec<(u32, Option<u32>)> {
    let (mut found, mut stack) = (Vec::new(), vec![(tree.root, None)]);
    while let Some((index, instance)) = stack.pop() {
        if index & LEAF != 0 {
            found.push((index & !LEAF, instance));
            continue;
        }
        let nodes = if instance.is_none() { tree.top } else { tree.nodes };
        let node = &nodes[index as usize];
        // The last slot first, so that the first is on top of the stack.
        for slot in (0..W).rev() {
            let link = node.link(slot);
            match node.kind(slot) {
                kind::INNER => stack.push((link, instance)),
                kind::MESH => {
                    let (instance, part) = leaf_parts(link);
                    let root = tree.instances[instance as usize].root;
                    let child = |slot| {
                        let root = &tree.nodes[root as usize];
                        let of_light = if root.kind(slot) == kind::LIGHT { LEAF } else { 0 };
                        root.link(slot) | of_light
                    };
                    let below = match part {
                        0 => root,
                        _ => child(part as usize - 1),
                    };
                    stack.push((below, Some(instance)));
                }
                kind::LIGHT => stack.push((link | LEAF, instance)),
                _ => {}
            }
        }
    }
    found
}

/// Marks a triangle's index among those of nodes.
const LEAF: u32 = 1 << 31;

/// What f64 itself may be off in an angle, rad: acos and atan2 of numbers that are exact.
const ANGLE_ERROR: f64 = 1e-12;

/// Asserts that a cone lies within another.
///
/// # Panics
/// If it does not.
pub fn assert_cone_contains(outer: Cone, inner: Cone, what: &str) {
    let pair = |cone: Cone| (cone.axis.as_dvec3(), cone.cos_theta_o);
    let excess = cone_excess(pair(outer), pair(inner));
    assert!(
        excess <= ANGLE_ERROR,
        "{what}: {inner:?} reaches {excess:e} rad out of {outer:?}"
    );
}

/// Whether a box lies within another.
#[must_use]
pub fn box_contains(outer: &LightBounds, inner: &LightBounds) -> bool {
    outer.min.cmple(inner.min).all() && inner.max.cmple(outer.max).all()
}
