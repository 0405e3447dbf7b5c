//! Meshes that bend: morph targets and skins, and where their vertices are at a time.

use glam::DAffine3;

use super::animate::Pose;
use super::model::{Influence, Primitive, SceneData};
use super::transform::{affine, mirrors};

/// Whether the vertices of `primitive` on node `node` do not simply follow the node.
pub(super) fn deforms(data: &SceneData, node: usize, primitive: &Primitive) -> bool {
    !primitive.targets.is_empty() || is_skinned(data, node, primitive)
}

/// Whether joints move the vertices.
pub(super) fn is_skinned(data: &SceneData, node: usize, primitive: &Primitive) -> bool {
    data.nodes[node].skin.is_some() && !primitive.influences.is_empty()
}

/// The vertices of a primitive in the world.
pub(super) struct Placed {
    pub points: Vec<[f64; 3]>,
    /// Whether fronts are backs: a mirrored instance would show its back.
    pub mirrored: bool,
}

impl Pose {
    /// Where the vertices of `primitive` on node `node` are.
    pub fn placed(&self, data: &SceneData, node: usize, primitive: &Primitive) -> Placed {
        let local = self.morphed(data, node, primitive);
        let skin = data.nodes[node].skin.filter(|_| !primitive.influences.is_empty());
        let Some(skin) = skin else {
            let to_world = &self.world[node];
            return Placed {
                points: local.into_iter().map(|p| moved(to_world, p)).collect(),
                mirrored: mirrors(to_world),
            };
        };
        let skin = &data.skins[skin as usize];
        let joints: Vec<DAffine3> = skin
            .joints
            .iter()
            .zip(&skin.inverse_bind)
            .map(|(&joint, bind)| self.world[joint as usize] * affine(bind))
            .collect();
        let first = primitive.influences.first().and_then(|set| set.first());
        let leader = first.map_or(0, |influence| influence.joints[0]);
        Placed {
            points: (0..local.len())
                .map(|vertex| skinned(&joints, primitive, vertex, local[vertex]))
                .collect(),
            mirrored: mirrors(&joints[usize::from(leader)]),
        }
    }

    /// The vertices in the mesh's space, moved by its targets (glTF 2.0, section 3.7.2.2).
    pub fn morphed(&self, data: &SceneData, node: usize, primitive: &Primitive) -> Vec<[f64; 3]> {
        let mut points: Vec<[f64; 3]> = primitive.positions.iter().map(|p| p.map(f64::from)).collect();
        for (target, &weight) in primitive.targets.iter().zip(self.weights(data, node).iter()) {
            if weight == 0.0 {
                continue;
            }
            for (point, moved) in points.iter_mut().zip(target) {
                for axis in 0..3 {
                    point[axis] += weight * f64::from(moved[axis]);
                }
            }
        }
        points
    }
}

fn moved(map: &DAffine3, p: [f64; 3]) -> [f64; 3] {
    map.transform_point3(p.into()).into()
}

/// The mean of where its joints take a vertex.
fn skinned(joints: &[DAffine3], primitive: &Primitive, vertex: usize, p: [f64; 3]) -> [f64; 3] {
    let (mut sum, mut shares) = ([0.0; 3], 0.0);
    for Influence { joints: of, weights } in primitive.influences.iter().map(|set| set[vertex]) {
        for (joint, weight) in of.into_iter().zip(weights) {
            if weight > 0.0 {
                let moved = moved(&joints[usize::from(joint)], p);
                let share = f64::from(weight);
                shares += share;
                sum = [0, 1, 2].map(|axis| sum[axis] + share * moved[axis]);
            }
        }
    }
    if shares > 0.0 {
        sum.map(|x| x / shares)
    } else {
        let first = primitive.influences[0][vertex].joints[0];
        moved(&joints[usize::from(first)], p)
    }
}
