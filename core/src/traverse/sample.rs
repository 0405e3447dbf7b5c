//! The two questions that a renderer asks of a light BVH.

use super::dead::{Dead, adopted, heir};
use super::descend::{Guide, Start, descend};
use crate::importance::ImportanceModel;
use crate::node::LightNode;
use crate::point::ShadingPoint;
use crate::trail::Path;
use crate::tree::{INVALID, LightTree, MeshLeaf};

/// A light and the probability with which it was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledLight {
    /// Index of the emissive triangle; [`INVALID`] when no light can contribute at the point.
    pub light: u32,
    /// Probability of this light at this point, in (0, 1]; 0 with [`INVALID`].
    pub pmf: f32,
}

impl SampledLight {
    /// No light can contribute.
    pub const NONE: Self = Self {
        light: INVALID,
        pmf: 0.0,
    };
}

/// Chooses one light for `point` by `random`, any 32 uniform bits (paper section 3.6).
///
/// A light is returned whenever one has importance at the point; see the [module](super) for dead branches. The pmf is
/// to the bit the one that [`pmf`] gives for the light.
#[must_use]
pub fn sample<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    random: u32,
) -> SampledLight {
    let guide = Guide {
        path: Path::default(),
        random,
    };
    let mut d = descend::<N, I, L, false, W>(tree, point, &guide, &Start::root(tree));
    let mut dead = Dead::UNKNOWN;
    if d.light == INVALID {
        let (found, known, start) = heir::<N, I, L, W>(tree, point, &d);
        dead = known;
        if found.light != INVALID {
            let path = tree.path_of(found.light, found.mesh);
            d = descend::<N, I, L, true, W>(tree, point, &Guide { path, random }, &start);
        }
    }
    if d.light == INVALID {
        SampledLight::NONE
    } else {
        SampledLight {
            light: d.light,
            pmf: d.pmf + adopted::<N, I, L, W>(tree, point, &d, &dead),
        }
    }
}

/// The probability with which [`sample`] returns triangle `light` of mesh light `mesh` ([`INVALID`] in a single-level
/// tree) at `point`: 0 if it has no importance there, or if there is no such light.
#[must_use]
pub fn pmf<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    light: u32,
    mesh: u32,
) -> f32 {
    let path = tree.path_of(light, mesh);
    let d = descend::<N, I, L, true, W>(tree, point, &Guide { path, random: 0 }, &Start::root(tree));
    if d.light == light && light != INVALID {
        d.pmf + adopted::<N, I, L, W>(tree, point, &d, &Dead::UNKNOWN)
    } else {
        0.0
    }
}
