//! Refit: new bounds on an unchanged topology, bottom-up (paper section 3.4).
//!
//! Every function takes the nodes as they are and returns one node anew, so that the CPU and the kernels run the same
//! body and each node is written by one invocation. The order of passes: [`leaves`] over all nodes of the bottom
//! levels; [`level`] from the deepest level to the roots; [`root`] for each bottom level; [`mesh_leaves`] over all nodes of
//! the top level; [`level`] again over the top level. Children are merged in slot order, so no order of execution shows in the bits.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::bounds::LightBounds;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::tree::MeshLeaf;

/// Node `index` with the bounds of its triangle children taken from the triangles.
#[must_use]
pub fn leaves<N: LightNode<W>, const W: usize>(nodes: &[N], triangles: &[EmissiveTriangle], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::LIGHT && link < triangles.len() as u32 {
            node.set_bounds(slot, &LightBounds::of_triangle(&triangles[link as usize]));
        }
    }
    node
}

/// Node `index` with the bounds of its inner children merged from the children's own children.
#[must_use]
pub fn level<N: LightNode<W>, const W: usize>(nodes: &[N], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::INNER && link < nodes.len() as u32 {
            let merged = nodes[link as usize].merged();
            node.set_bounds(slot, &merged);
        }
    }
    node
}

/// Bounds of the bottom level whose root is node `root`, in its own space; kept apart from the nodes so that instances need
/// not merge them anew.
#[must_use]
pub fn root<N: LightNode<W>, const W: usize>(nodes: &[N], root: u32) -> BlasRoot {
    let node = if root < nodes.len() as u32 { root } else { 0 };
    BlasRoot::new(root, &nodes[node as usize].merged())
}

/// Top-level node `index` with the bounds of its mesh children taken from their bottom levels' roots.
#[must_use]
pub fn mesh_leaves<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    nodes: &[N],
    meshes: &[L],
    roots: &[BlasRoot],
    index: u32,
) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::MESH && link < meshes.len() as u32 {
            let blas = meshes[link as usize].blas();
            if blas < roots.len() as u32 {
                let bounds = meshes[link as usize].to_world(&roots[blas as usize].bounds());
                node.set_bounds(slot, &bounds);
            }
        }
    }
    node
}

/// The root of a bottom level and its bounds in the bottom level's space; plain words.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BlasRoot {
    /// Node index of the root.
    pub node: u32,
    /// Least corner of the box.
    pub min: [f32; 3],
    /// Greatest corner of the box.
    pub max: [f32; 3],
    /// Axis of the normals' cone.
    pub axis: [f32; 3],
    /// cos θ_o.
    pub cos_theta_o: f32,
    /// cos θ_e.
    pub cos_theta_e: f32,
    /// Φ, W.
    pub phi: f32,
}

const _: () = assert!(size_of::<BlasRoot>() == 52);

impl BlasRoot {
    /// The root `node` with `bounds`.
    #[inline]
    #[must_use]
    pub fn new(node: u32, bounds: &LightBounds) -> Self {
        Self {
            node,
            min: [bounds.min.x, bounds.min.y, bounds.min.z],
            max: [bounds.max.x, bounds.max.y, bounds.max.z],
            axis: [bounds.axis.x, bounds.axis.y, bounds.axis.z],
            cos_theta_o: bounds.cos_theta_o,
            cos_theta_e: bounds.cos_theta_e,
            phi: bounds.phi,
        }
    }

    /// The bounds.
    #[inline]
    #[must_use]
    pub fn bounds(&self) -> LightBounds {
        LightBounds {
            min: Vec3::new(self.min[0], self.min[1], self.min[2]),
            max: Vec3::new(self.max[0], self.max[1], self.max[2]),
            axis: Vec3::new(self.axis[0], self.axis[1], self.axis[2]),
            cos_theta_o: self.cos_theta_o,
            cos_theta_e: self.cos_theta_e,
            phi: self.phi,
        }
    }
}
