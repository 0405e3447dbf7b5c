//! Bounds of several children, field by field, and the shared functions over them lane by lane.
//!
//! Each function is a loop without calls, memory of unknown place or early exits: what the compiler's vectoriser asks for.
//! They are kept from being inlined, for the same reason.

use glam::Vec3;

use crate::bounds::LightBounds;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::refit::BlasRoot;
use crate::tree::MeshLeaf;

/// Bounds of `W` children.
#[derive(Clone, Copy)]
pub(super) struct Lanes<const W: usize> {
    min: [[f32; W]; 3],
    max: [[f32; W]; 3],
    axis: [[f32; W]; 3],
    cos_theta_o: [f32; W],
    cos_theta_e: [f32; W],
    phi: [f32; W],
}

impl<const W: usize> Lanes<W> {
    const ZERO: Self = Self {
        min: [[0.0; W]; 3],
        max: [[0.0; W]; 3],
        axis: [[0.0; W]; 3],
        cos_theta_o: [0.0; W],
        cos_theta_e: [0.0; W],
        phi: [0.0; W],
    };

    #[inline(always)]
    fn get(&self, lane: usize) -> LightBounds {
        let vector = |v: &[[f32; W]; 3]| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
        LightBounds {
            min: vector(&self.min),
            max: vector(&self.max),
            axis: vector(&self.axis),
            cos_theta_o: self.cos_theta_o[lane],
            cos_theta_e: self.cos_theta_e[lane],
            phi: self.phi[lane],
        }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, bounds: &LightBounds) {
        let put = |to: &mut [[f32; W]; 3], from: Vec3| {
            to[0][lane] = from.x;
            to[1][lane] = from.y;
            to[2][lane] = from.z;
        };
        put(&mut self.min, bounds.min);
        put(&mut self.max, bounds.max);
        put(&mut self.axis, bounds.axis);
        self.cos_theta_o[lane] = bounds.cos_theta_o;
        self.cos_theta_e[lane] = bounds.cos_theta_e;
        self.phi[lane] = bounds.phi;
    }

    /// [`LightBounds::of_triangle`].
    #[inline(always)]
    pub fn of_triangles(triangles: &[EmissiveTriangle; W]) -> Self {
        let mut lanes = Self::ZERO;
        lanes.set_triangles(triangles);
        lanes
    }

    #[inline(never)]
    fn set_triangles(&mut self, triangles: &[EmissiveTriangle; W]) {
        for lane in 0..W {
            self.set(lane, &LightBounds::of_triangle(&triangles[lane]));
        }
    }

    /// [`MeshLeaf::to_world`] of each root's bounds.
    #[inline(always)]
    pub fn in_world<L: MeshLeaf>(meshes: &[L; W], roots: &[BlasRoot; W]) -> Self {
        let mut lanes = Self::ZERO;
        lanes.set_in_world(meshes, roots);
        lanes
    }

    #[inline(never)]
    fn set_in_world<L: MeshLeaf>(&mut self, meshes: &[L; W], roots: &[BlasRoot; W]) {
        for lane in 0..W {
            self.set(lane, &meshes[lane].to_world(&roots[lane].bounds()));
        }
    }

    /// [`LightNode::merged`].
    #[inline(always)]
    pub fn merged<N: LightNode<W>>(nodes: &[N; W]) -> Self {
        let (mut merged, mut slots) = (Self::ZERO, Self::ZERO);
        merged.unpack(nodes, 0);
        // Merged with nothing, what has no flux is nothing too, whatever its box.
        for lane in 0..W {
            let first = merged.get(lane);
            let kept = if first.phi == 0.0 {
                LightBounds::EMPTY
            } else {
                first
            };
            merged.set(lane, &kept);
        }
        for slot in 1..W {
            slots.unpack(nodes, slot);
            merged.merge(&slots);
        }
        merged
    }

    /// Child `slot` of each node; without flux where there is none.
    #[inline(never)]
    fn unpack<N: LightNode<W>>(&mut self, nodes: &[N; W], slot: usize) {
        if slot < W {
            for lane in 0..W {
                let bounds = nodes[lane].bounds(slot);
                let none = nodes[lane].kind(slot) == kind::EMPTY;
                let phi = if none { 0.0 } else { bounds.phi };
                self.set(lane, &LightBounds { phi, ..bounds });
            }
        }
    }

    /// [`LightBounds::merge`] of each with each of `others`.
    #[inline(never)]
    fn merge(&mut self, others: &Self) {
        let mut cones = 0;
        for lane in 0..W {
            cones |= u32::from(self.get(lane).merges_cones(&others.get(lane)));
        }
        let mut around = *self;
        // High up in a tree cones are spheres, and none is to be computed.
        if cones != 0 {
            around.smallest_around(others);
        }
        for lane in 0..W {
            let merged = self
                .get(lane)
                .merge_around(&others.get(lane), around.get(lane).cone());
            self.set(lane, &merged);
        }
    }

    /// [`Cone::smallest_around`](crate::cone::Cone) of each with each of `others`; only axis and cos θ_o change.
    #[inline(never)]
    fn smallest_around(&mut self, others: &Self) {
        for lane in 0..W {
            let cone = self.get(lane).cone().smallest_around(others.get(lane).cone());
            self.axis[0][lane] = cone.axis.x;
            self.axis[1][lane] = cone.axis.y;
            self.axis[2][lane] = cone.axis.z;
            self.cos_theta_o[lane] = cone.cos_theta_o;
        }
    }

    /// [`LightNode::set_bounds`] of each slot.
    #[inline(never)]
    pub fn pack<N: LightNode<W>>(&self, node: &mut N) {
        for lane in 0..W {
            node.set_bounds(lane, &self.get(lane));
        }
    }
}
