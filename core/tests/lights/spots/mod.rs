//! Nodes that know beams, against an exhaustive oracle: no light that reaches a point is told not to, at any scale, through
//! instances, edits, rebuilds and files; what is chosen has the probability that is told; and points beside a cone stop
//! choosing its spot.

mod beams;
mod choice;
mod kept;

use crate::kit::Random;
use glam::Vec3;
use lightbvh::light::{AnyLight, DiscLight, Light, PointLight, SphereLight, SpotLight};
use lightbvh::node::{Lit, MomentNode, Node, SpotMomentNode, kind};
use lightbvh::refit::world_light;
use lightbvh::trail::leaf_parts;
use lightbvh::{Bvh, EmissiveTriangle, ImportanceModel, Moments, ShadingPoint, Transform};

type Tree<L> = Bvh<Lit<SpotMomentNode<8>, L>, Moments, 8>;

type Plain<L> = Bvh<Lit<MomentNode<8>, L>, Moments, 8>;

impl Random {
    fn point(&mut self, p: [f32; 3]) -> ShadingPoint {
        let n = if self.below(3) == 0 {
            [0.0; 3]
        } else {
            self.unit_vector()
        };
        ShadingPoint { p, n }
    }
}

/// A spot of a quarter of a degree to nearly 90° within `reach`; one in so many `apart` is of the direction `shared`, about.
fn spot(random: &mut Random, reach: f32, shared: [f32; 3], apart: u32) -> SpotLight {
    let axis = if random.below(apart) == 0 {
        let off = random.vector(0.1);
        let v: [f32; 3] = core::array::from_fn(|k| shared[k] + off[k]);
        let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
        v.map(|x| x / length)
    } else {
        random.unit_vector()
    };
    let outer = (90.0_f32 * 0.0028_f32.powf(random.unit())).to_radians().cos();
    let inner = outer + (1.0 - outer) * random.unit() * random.below(2) as f32;
    let level = 10.0_f32.powf(3.0 * random.signed());
    SpotLight {
        p: random.vector(reach),
        intensity: [level; 3],
        range: 0.0,
        axis,
        cos_inner: inner.min(1.0),
        cos_outer: outer.min(1.0 - 1.0e-5),
        mesh: 0,
    }
}

fn spots(random: &mut Random, count: u32, reach: f32) -> Vec<SpotLight> {
    // Those that all shine the same way keep to a beam at all levels.
    let (shared, apart) = (random.unit_vector(), [1, 4][random.below(2) as usize]);
    (0..count).map(|_| spot(random, reach, shared, apart)).collect()
}

/// Of any kind but a spot.
fn other(random: &mut Random) -> AnyLight {
    let at = random.vector(5.0);
    let emission = [10.0_f32.powf(2.0 * random.signed()); 3];
    let edge = |k: usize, random: &mut Random| {
        let mut e = [0.0; 3];
        e[k] = 0.05 + random.unit();
        e
    };
    match random.below(4) {
        0 => PointLight {
            p: at,
            intensity: emission,
            range: 0.0,
            mesh: 0,
        }
        .into(),
        1 => SphereLight {
            p: at,
            radius: 0.01 + random.unit(),
            radiance: emission,
            mesh: 0,
        }
        .into(),
        2 => {
            let half = [edge(0, random), edge(1, random)];
            DiscLight {
                p: at,
                half,
                radiance: emission,
                mesh: 0,
                flags: random.below(2),
            }
            .into()
        }
        _ => EmissiveTriangle {
            p: [
                at,
                core::array::from_fn(|k| at[k] + random.signed()),
                core::array::from_fn(|k| at[k] + random.signed()),
            ],
            radiance: emission,
            mesh: 0,
            flags: random.below(2),
        }
        .into(),
    }
}

/// A rotation, an even scale, maybe mirrored.
fn even(random: &mut Random, reach: f32, scale: f32) -> Transform {
    let a = random.unit_vector();
    let b = random.unit_vector();
    let across: [f32; 3] = {
        let d: f32 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
        let v: [f32; 3] = core::array::from_fn(|k| b[k] - a[k] * d);
        let length = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1.0e-3);
        v.map(|x| x / length)
    };
    let third = [
        a[1] * across[2] - a[2] * across[1],
        a[2] * across[0] - a[0] * across[2],
        a[0] * across[1] - a[1] * across[0],
    ];
    let s = scale * 4.0_f32.powf(random.signed());
    let sign = if random.below(2) == 0 { -s } else { s };
    Transform {
        columns: [a.map(|x| x * s), across.map(|x| x * s), third.map(|x| x * sign)],
        translation: random.vector(reach),
    }
}

/// What a tree says of a light at a point.
struct Told {
    light: u32,
    instance: u32,
    /// The least factor that a beam puts on a weight on the path to it.
    least: f32,
}

/// All lights, with what the beams on their paths say.
fn told<L: Light, I: ImportanceModel<Lit<SpotMomentNode<8>, L>, 8>>(
    bvh: &Bvh<Lit<SpotMomentNode<8>, L>, I, 8>,
    point: &ShadingPoint,
) -> Vec<Told> {
    let tree = bvh.tree();
    let mut found = Vec::new();
    // Node, instance above it, factor so far.
    let mut open = vec![(tree.root, u32::MAX, 1.0_f32)];
    while let Some((index, above, least)) = open.pop() {
        let (node, local, slack) = match tree.instances.get(above as usize) {
            Some(own) => (&tree.nodes[index as usize], own.to_local(point), own.slack()),
            None => (&tree.top[index as usize], *point, 0.0),
        };
        let with = I::weights_in(node, &local, slack);
        let without = I::weights_in(node, &local, -1.0);
        for slot in 0..8 {
            let (to, link) = (node.kind(slot), node.link(slot));
            if to == kind::EMPTY || without[slot] == 0.0 {
                continue;
            }
            assert!(with[slot] > 0.0);
            let least = least.min(with[slot] / without[slot]);
            match to {
                kind::INNER => open.push((link, above, least)),
                kind::MESH => {
                    let (instance, part) = leaf_parts(link);
                    let root = tree.instances[instance as usize].root;
                    let below = match part {
                        0 => root,
                        _ => tree.nodes[root as usize].link(part as usize - 1),
                    };
                    open.push((below, instance, least));
                }
                _ => {
                    let own = tree.instances.get(above as usize);
                    found.push(Told {
                        light: own.map_or(link, |own| own.light_of(link)),
                        instance: above,
                        least,
                    });
                }
            }
        }
    }
    found
}

/// What the light sends to `p`, as the sum of its channels.
fn sent<L: Light>(light: &L, p: [f32; 3]) -> f32 {
    light.point_for(Vec3::from(p), [0.5; 2]).radiance.iter().sum()
}

#[derive(Debug, Default)]
struct Seen {
    lit: u32,
    wrong: u32,
    outside: u32,
    dark: u32,
}

/// Points in, at the edge of and beside the cones of lights of `bvh`, at any distance: no light that shines there is told not to.
fn check_beams(bvh: &Tree<AnyLight>, scale: f32, random: &mut Random, points: u32, seen: &mut Seen) {
    let world: Vec<AnyLight> = bvh.world_lights().into_iter().collect();
    for _ in 0..points {
        let about = world[random.below(world.len() as u32) as usize];
        let p = match SpotLight::try_from(about) {
            Ok(spot) if random.below(4) > 0 => {
                let angle = spot.cos_outer.acos() * [0.5, 0.99, 0.999, 1.1][random.below(4) as usize];
                let turn = random.unit_vector();
                let d: f32 = turn.iter().zip(&spot.axis).map(|(x, y)| x * y).sum();
                let v: [f32; 3] = core::array::from_fn(|k| turn[k] - spot.axis[k] * d);
                let length = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1.0e-3);
                let far = scale * 100.0_f32.powf(random.signed());
                core::array::from_fn(|k| {
                    spot.p[k] + far * (spot.axis[k] * angle.cos() + v[k] / length * angle.sin())
                })
            }
            _ => random.vector(2.0 * scale),
        };
        let point = random.point(p);
        for own in told(bvh, &point) {
            let light = world_light(bvh.triangles(), bvh.instances(), own.light, own.instance);
            if sent(&light, point.p) > 0.0 {
                seen.lit += 1;
                if own.least < 0.99 {
                    seen.wrong += 1;
                    println!("{point:?} {light:?} {}", own.least);
                }
            } else {
                seen.dark += 1;
                seen.outside += u32::from(own.least < 0.99);
            }
        }
    }
}

fn any(spots: Vec<SpotLight>) -> Vec<AnyLight> {
    spots.into_iter().map(AnyLight::from).collect()
}
