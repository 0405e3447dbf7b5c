//! The light BVH over an image of its scene: the moments of its nodes as ellipses, and how deep lights lie.

use glam::{DMat2, DMat3, DVec2, DVec3, Vec3};
use lightbvh::device::trail::leaf_parts;
use lightbvh::node::kind;
use lightbvh::refit::Instance;
use lightbvh::{LightMoments, LightNode, LightTree};
use lightbvh_kernels::shading::camera::Camera;
use serde::Serialize;

/// Ellipses of a cut: those of the greatest flux, where there are more.
const MOST: usize = 300;
/// Standard deviations that an ellipse reaches to: as far as an even distribution on a disc has any.
const DEVIATIONS: f64 = 2.0;
/// Distance along the view, in metres, below which nothing is drawn.
const NEAR: f64 = 0.05;

/// A tree as it is drawn.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Drawn {
    pub picture: String,
    pub width: u32,
    pub height: u32,
    /// Cuts through the tree: the children of nodes at each depth, and the lights above.
    pub cuts: Vec<Cut>,
    /// Lights by the number of nodes on the path to them, from 1 on.
    pub lights_by_depth: Vec<u32>,
    /// Their share of the flux, without regard to where it goes.
    pub flux_by_depth: Vec<f64>,
    pub nodes: usize,
}

#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Cut {
    /// How many sets of lights it has, seen or not.
    pub sets: usize,
    pub ellipses: Vec<Ellipse>,
}

/// In pixels of the picture, from its upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Ellipse {
    pub x: f32,
    pub y: f32,
    pub rx: f32,
    pub ry: f32,
    /// Of the first axis, degrees, clockwise on the screen.
    pub turn: f32,
    /// Share of all flux.
    pub share: f32,
    /// `light`, `mesh` (an instance) or `node`.
    pub kind: &'static str,
}

/// A child of a node, in the world.
struct Set {
    phi: f64,
    c: DVec3,
    covariance: DMat3,
    kind: u32,
}

/// The cuts and depths of `tree`, seen by `camera` on a picture of `size`.
pub(super) fn drawn<N, I, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    camera: &Camera,
    size: (u32, u32),
    picture: String,
) -> Drawn
where
    N: LightNode<W, Summary = LightMoments>,
{
    let (mut cuts, mut above) = (Vec::new(), Vec::new());
    let (mut lights_by_depth, mut flux_by_depth) = (Vec::new(), Vec::new());
    let mut nodes = vec![(tree.root, None)];
    let mut count = 0;
    while !nodes.is_empty() {
        count += nodes.len();
        let (mut below, mut sets) = (Vec::new(), Vec::new());
        let (mut lights, mut flux) = (0, 0.0);
        for (index, instance) in nodes {
            let nodes = if instance.is_some() { tree.nodes } else { tree.top };
            let node = &nodes[index as usize];
            for slot in 0..W {
                let (of, link) = (node.kind(slot), node.link(slot));
                match of {
                    kind::EMPTY => continue,
                    kind::INNER => below.push((link, instance)),
                    kind::MESH => {
                        let (instance, part) = leaf_parts(link);
                        let instance = &tree.instances[instance as usize];
                        let root = match part {
                            0 => instance.root,
                            _ => tree.nodes[instance.root as usize].link(part as usize - 1),
                        };
                        below.push((root, Some(instance)));
                    }
                    _ => {}
                }
                let set = Set::new(&node.summary(slot), instance, of);
                if of == kind::LIGHT {
                    lights += 1;
                    flux += set.phi;
                }
                sets.push(set);
            }
        }
        lights_by_depth.push(lights);
        flux_by_depth.push(flux);
        cuts.push(cut(above.iter().chain(&sets), camera, size));
        above.extend(sets.into_iter().filter(|set| set.kind == kind::LIGHT));
        nodes = below;
    }
    let all: f64 = flux_by_depth.iter().sum();
    Drawn {
        picture,
        width: size.0,
        height: size.1,
        cuts,
        lights_by_depth,
        flux_by_depth: flux_by_depth
            .into_iter()
            .map(|flux| flux / all.max(f64::MIN_POSITIVE))
            .collect(),
        nodes: count,
    }
}

fn cut<'a>(sets: impl Iterator<Item = &'a Set>, camera: &Camera, size: (u32, u32)) -> Cut {
    let mut sets: Vec<&Set> = sets.filter(|set| set.phi > 0.0).collect();
    sets.sort_by(|a, b| b.phi.total_cmp(&a.phi));
    let all: f64 = sets.iter().map(|set| set.phi).sum();
    Cut {
        sets: sets.len(),
        ellipses: sets
            .iter()
            .filter_map(|set| set.seen(camera, size, all))
            .take(MOST)
            .collect(),
    }
}

impl Set {
    /// A node's summary of a child, carried from the space of its mesh to the world.
    fn new(moments: &LightMoments, instance: Option<&Instance>, kind: u32) -> Self {
        let wide = |v: Vec3| v.as_dvec3();
        let [across, along] = [moments.across, moments.along].map(|d| f64::from(d).powi(2));
        let n = wide(moments.m).normalize_or_zero();
        let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        let covariance = DMat3::IDENTITY * across + outer * (along - across);
        match instance {
            None => Self {
                phi: f64::from(moments.phi),
                c: wide(moments.c),
                covariance,
                kind,
            },
            Some(instance) => {
                let [x, y, z] = instance.columns.map(|column| wide(Vec3::from_array(column)));
                let map = DMat3::from_cols(x, y, z);
                Self {
                    phi: f64::from(moments.phi) * f64::from(instance.flux),
                    c: map * wide(moments.c) + wide(Vec3::from_array(instance.translation)),
                    covariance: map * covariance * map.transpose(),
                    kind,
                }
            }
        }
    }

    /// The outline of the ellipsoid under the perspective's derivative at its centre; nothing behind the camera or beside the
    /// image.
    fn seen(&self, camera: &Camera, (width, height): (u32, u32), all: f64) -> Option<Ellipse> {
        let [origin, right, up, forward] =
            [camera.origin, camera.right, camera.up, camera.forward].map(|v| Vec3::from_array(v).as_dvec3());
        let to = self.c - origin;
        let z = to.dot(forward);
        if z < NEAR {
            return None;
        }
        let half = DVec2::new(f64::from(width), f64::from(height)) * 0.5;
        let per = [right / right.length_squared(), -up / up.length_squared()];
        let at = DVec2::new(to.dot(per[0]), to.dot(per[1])) / z;
        // The derivative of the place on the picture by the point, a row each.
        let rows = [
            (per[0] - forward * at.x) * (half.x / z),
            (per[1] - forward * at.y) * (half.y / z),
        ];
        let of = |a: usize, b: usize| rows[a].dot(self.covariance * rows[b]);
        let (axes, turn) = axes(DMat2::from_cols_array(&[of(0, 0), of(0, 1), of(1, 0), of(1, 1)]));
        let place = half + at * half;
        let reach = axes.x * DEVIATIONS;
        let inside = |v: f64, length: f64| v > -reach && v < length + reach;
        (inside(place.x, 2.0 * half.x) && inside(place.y, 2.0 * half.y)).then(|| Ellipse {
            x: place.x as f32,
            y: place.y as f32,
            rx: reach as f32,
            ry: (axes.y * DEVIATIONS) as f32,
            turn: turn.to_degrees() as f32,
            share: (self.phi / all) as f32,
            kind: match self.kind {
                kind::LIGHT => "light",
                kind::MESH => "mesh",
                _ => "node",
            },
        })
    }
}

/// Standard deviations along the axes of a symmetric matrix, the greater first, and the angle of that one.
fn axes(covariance: DMat2) -> (DVec2, f64) {
    let (a, b, c) = (covariance.x_axis.x, covariance.x_axis.y, covariance.y_axis.y);
    let (mean, apart) = (0.5 * (a + c), (0.25 * (a - c).powi(2) + b * b).sqrt());
    let axes = DVec2::new(mean + apart, (mean - apart).max(0.0));
    (
        DVec2::new(axes.x.sqrt(), axes.y.sqrt()),
        0.5 * (2.0 * b).atan2(a - c),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::importance::DefaultImportance;
    use lightbvh::{BuildParams, Bvh, MomentNode};

    use crate::backend::nodes_in_use;
    use crate::scene::Scene;
    use crate::workload::{arrays_at, lights_at};

    fn street() -> Drawn {
        let scene = Scene::open("street").expect("a built-in scene");
        let lights = lights_at(&scene, 0).expect("lights");
        let arrays = arrays_at(&scene, 0, 160, 90).expect("a scene");
        let bvh: Bvh<MomentNode<8>, DefaultImportance, 8> = Bvh::two_level(&lights, &BuildParams::default());
        let drawn = drawn(&bvh.tree(), &arrays.camera, (160, 90), String::new());
        assert_eq!(
            drawn.lights_by_depth.iter().sum::<u32>() as usize,
            lights.triangles().len()
        );
        assert_eq!(drawn.nodes, nodes_in_use(&bvh).len());
        drawn
    }

    #[test]
    fn cuts_grow_to_all_lights() {
        let drawn = street();
        assert!(drawn.cuts.windows(2).all(|pair| pair[0].sets <= pair[1].sets));
        let last = drawn.cuts.last().expect("a cut");
        assert_eq!(last.sets as u32, drawn.lights_by_depth.iter().sum::<u32>());
        assert!((drawn.flux_by_depth.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        for cut in &drawn.cuts {
            assert!(!cut.ellipses.is_empty() && cut.ellipses.len() <= MOST);
            assert!(
                cut.ellipses
                    .iter()
                    .all(|e| e.rx >= e.ry && e.rx.is_finite() && e.share > 0.0)
            );
        }
    }

    #[test]
    fn an_ellipsoid_ahead_is_where_and_as_large_as_it_looks() {
        let camera = Camera {
            origin: [1.0, 2.0, 3.0],
            right: [2.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            forward: [0.0, 0.0, -1.0],
        };
        // Ten metres ahead, a quarter of the half image to the right, half of it up: 0.5 m by 0.25 m deviation.
        let set = Set {
            phi: 1.0,
            c: DVec3::new(1.0 + 5.0, 2.0 + 5.0, 3.0 - 10.0),
            covariance: DMat3::from_diagonal(DVec3::new(0.25, 0.0625, 0.0)),
            kind: kind::LIGHT,
        };
        let seen = set.seen(&camera, (400, 200), 4.0).expect("ahead");
        let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-3, "{a} is not {b}");
        near(seen.x, 200.0 + 50.0);
        near(seen.y, 100.0 - 50.0);
        // Half an image is 20 m wide and 10 m high there: 10 pixels for a metre.
        near(seen.rx, 2.0 * 5.0);
        near(seen.ry, 2.0 * 2.5);
        near(seen.turn, 0.0);
        near(seen.share, 0.25);
        let behind = Set {
            c: DVec3::new(1.0, 2.0, 13.0),
            ..set
        };
        assert_eq!(behind.seen(&camera, (400, 200), 4.0), None);
    }

    #[test]
    fn axes_of_a_turned_ellipse() {
        let (axes, turn) = axes(DMat2::from_cols_array(&[2.5, 1.5, 1.5, 2.5]));
        assert!((axes - DVec2::new(2.0, 1.0)).length() < 1e-12);
        assert!((turn.to_degrees() - 45.0).abs() < 1e-9);
    }
}
