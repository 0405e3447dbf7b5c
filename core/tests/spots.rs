//! Nodes that know beams, against an exhaustive oracle: no light that reaches a point is told not to, at any scale, through instances,
//! edits, rebuilds and files; what is chosen has the probability that is told; and points beside a cone stop choosing its spot.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use glam::Vec3;
use lightbvh::bvh::{RebuildParams, RebuilderParams, Swap};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::{AnyLight, DiscLight, Light, LinkedAny, PointLight, SphereLight, SpotLight};
use lightbvh::node::{LinkedSpotMomentNode, Lit, MomentNode, Node, SpotMomentNode, kind};
use lightbvh::refit::world_light;
use lightbvh::{
    BuildParams, Bvh, EmissiveTriangle, ImportanceModel, Instance, Lights, Moments, Rebuilder, ShadingPoint,
    Transform,
};

type Tree<L> = Bvh<Lit<SpotMomentNode<8>, L>, Moments, 8>;
type Plain<L> = Bvh<Lit<MomentNode<8>, L>, Moments, 8>;

struct Random(u32);

impl Random {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        hash(self.0)
    }

    fn below(&mut self, count: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(count)) >> 32) as u32
    }

    fn unit(&mut self) -> f32 {
        unit_f32(self.word())
    }

    fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    fn vector(&mut self, scale: f32) -> [f32; 3] {
        core::array::from_fn(|_| self.signed() * scale)
    }

    fn unit_vector(&mut self) -> [f32; 3] {
        loop {
            let v = self.vector(1.0);
            let squared: f32 = v.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&squared) {
                return v.map(|x| x / squared.sqrt());
            }
        }
    }

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
    // Node, leaf of the top level, factor so far.
    let mut open = vec![(tree.root, u32::MAX, 1.0_f32)];
    while let Some((index, leaf, least)) = open.pop() {
        let node = &tree.nodes[index as usize];
        let (local, slack) = match tree.instances.get(leaf as usize) {
            Some(instance) => (instance.to_local(point), instance.slack()),
            None => (*point, 0.0),
        };
        let with = I::weights_in(node, &local, slack);
        let without = I::weights_in(node, &local, -1.0);
        for slot in 0..8 {
            let to = node.kind(slot);
            if to == kind::EMPTY || without[slot] == 0.0 {
                continue;
            }
            assert!(with[slot] > 0.0);
            let least = least.min(with[slot] / without[slot]);
            match to {
                kind::INNER => open.push((node.link(slot), leaf, least)),
                kind::MESH => {
                    let instance = &tree.instances[node.link(slot) as usize];
                    open.push((instance.root, node.link(slot), least));
                }
                _ => {
                    let own = owner(tree.instances, leaf);
                    let light = match tree.instances.get(own as usize) {
                        Some(instance) => instance.light_of(node.link(slot)),
                        None => node.link(slot),
                    };
                    found.push(Told {
                        light,
                        instance: own,
                        least,
                    });
                }
            }
        }
    }
    found
}

/// The instance that a leaf of the top level is, or is a part of.
fn owner(instances: &[Instance], leaf: u32) -> u32 {
    match instances.get(leaf as usize) {
        Some(instance) if instance.is_part() => instance.part,
        _ => leaf,
    }
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

#[test]
fn no_light_that_reaches_a_point_is_told_not_to() {
    let mut seen = Seen::default();
    for seed in 0..40 {
        let random = &mut Random(1000 * seed + 3);
        let scale = 10.0_f32.powi(seed as i32 % 8 - 3);
        let mut bvh = Tree::<AnyLight>::default();
        for _ in 0..1 + random.below(6) {
            let count = [1, 3, 12, 90][random.below(4) as usize];
            let reach = scale * 0.01_f32.powf(random.unit());
            let mut own = any(spots(random, count, reach));
            if random.below(3) == 0 {
                own.push(other(random));
            }
            let mesh = bvh.add_mesh(own).expect("in the domain");
            for _ in 0..=random.below(4) {
                let place = even(random, 2.0 * scale, 1.0);
                bvh.add_instance(mesh, place).expect("in the domain");
            }
        }
        bvh.refit();
        check_beams(&bvh, scale, random, 300, &mut seen);
    }
    println!("{seen:?}");
    assert!(seen.lit > 20_000 && seen.dark > 100_000, "{seen:?}");
    assert_eq!(seen.wrong, 0, "{seen:?}");
    assert!(seen.outside > seen.dark / 100 * 98, "beams say little: {seen:?}");
}

/// Among meshes of one spot each, turned by their instances, a point beside the cones of most chooses those that light it: by the beams of the top level.
#[test]
fn the_top_level_chooses_by_cones() {
    let random = &mut Random(37);
    let mut bvh = Tree::<AnyLight>::default();
    for _ in 0..300 {
        let spot = SpotLight {
            p: random.vector(0.5),
            axis: [0.0, 0.0, 1.0],
            intensity: [1.0; 3],
            range: 0.0,
            cos_inner: 0.97,
            cos_outer: 0.96,
            mesh: 0,
        };
        let mesh = bvh.add_mesh(any([spot].to_vec())).expect("in the domain");
        let [x, y, _] = random.vector(8.0);
        // Half a turn about x: they shine down.
        let place = Transform {
            columns: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]],
            translation: [x, y, 3.0],
        };
        bvh.add_instance(mesh, place).expect("in the domain");
    }
    bvh.refit();
    let (mut lit, mut total, mut points) = (0.0, 0.0, 0);
    while points < 200 {
        let [x, y, _] = random.vector(6.0);
        let point = ShadingPoint {
            p: [x, y, 0.0],
            n: [0.0, 0.0, 1.0],
        };
        let all = told(&bvh, &point);
        let is_lit = |own: &Told| {
            let light = world_light(bvh.triangles(), bvh.instances(), own.light, own.instance);
            sent(&light, point.p) > 0.0
        };
        if !all.iter().any(is_lit) {
            continue;
        }
        points += 1;
        for own in &all {
            let pmf = f64::from(bvh.pmf(&point, own.light, own.instance));
            total += pmf;
            lit += if is_lit(own) { pmf } else { 0.0 };
        }
    }
    println!("{lit} of {total}");
    // 0.45; without cones at the top level, or with cones that do not turn, 0.10.
    assert!(
        (total / 200.0 - 1.0).abs() < 1.0e-4 && lit > 0.35 * total,
        "{lit} of {total}"
    );
}

/// Far from the world's origin coordinates are rounded by more than a narrow cone is wide near its lamp: a point in it is in it still.
#[test]
fn far_from_the_origin_no_light_is_told_not_to_reach_a_point() {
    for (far, least) in [(100.0_f32, 0.99), (1.0e4, 0.97), (3.0e5, 0.8)] {
        let random = &mut Random(77);
        let mut seen = Seen::default();
        for turn in 0..30 {
            let mut bvh = Tree::<AnyLight>::default();
            let about = random.vector(far);
            // By instances of any scale, or in a mesh that stands there itself.
            let scale = [1.0, 0.02, 50.0][turn % 3];
            for _ in 0..1 + random.below(6) {
                let count = [1, 1, 3, 12][random.below(4) as usize];
                let mut own = spots(random, count, 0.3 / scale);
                if turn % 2 == 1 {
                    own.iter_mut()
                        .for_each(|spot| (0..3).for_each(|k| spot.p[k] += about[k]));
                    let mesh = bvh.add_mesh(any(own)).expect("in the domain");
                    bvh.add_instance(mesh, Transform::IDENTITY)
                        .expect("in the domain");
                    continue;
                }
                let mesh = bvh.add_mesh(any(own)).expect("in the domain");
                for _ in 0..=random.below(4) {
                    let mut place = even(random, 4.0, scale);
                    (0..3).for_each(|k| place.translation[k] += about[k]);
                    bvh.add_instance(mesh, place).expect("in the domain");
                }
            }
            bvh.refit();
            check_beams(&bvh, 1.0, random, 300, &mut seen);
        }
        println!("{far}: {seen:?}");
        assert!(seen.lit > 5_000 && seen.dark > 50_000, "{far}: {seen:?}");
        assert_eq!(seen.wrong, 0, "{far}: {seen:?}");
        let share = f64::from(seen.outside) / f64::from(seen.dark);
        assert!(share > least, "{far}: beams say little: {share}");
    }
}

/// Spots that stand apart and shine the same way in cones as narrow as may be: the apex of what holds them lies farther behind than a node can say, or nearly so.
#[test]
fn wide_sets_of_narrow_cones_leave_no_light_out() {
    let random = &mut Random(41);
    let mut seen = Seen::default();
    for _ in 0..40 {
        let axis = random.unit_vector();
        let angle = (0.25_f32 * 20.0_f32.powf(random.unit())).to_radians();
        let own = (0..12 + random.below(40)).map(|_| SpotLight {
            p: random.vector(1.0),
            axis,
            intensity: [1.0; 3],
            range: 0.0,
            cos_inner: angle.cos(),
            cos_outer: angle.cos().min(1.0 - 2.0_f32.powi(-20)),
            mesh: 0,
        });
        let mut bvh = Tree::<AnyLight>::default();
        let mesh = bvh.add_mesh(any(own.collect())).expect("in the domain");
        bvh.add_instance(mesh, even(random, 3.0, 1.0))
            .expect("in the domain");
        bvh.refit();
        check_beams(&bvh, 3.0, random, 200, &mut seen);
    }
    println!("{seen:?}");
    assert!(seen.lit > 5_000 && seen.dark > 50_000, "{seen:?}");
    assert_eq!(seen.wrong, 0, "{seen:?}");
}

/// A node of one spot knows its cone, wherever in its space the spot stands.
#[test]
fn spots_alone_in_their_meshes_keep_their_cones() {
    for away in [0.0_f32, 1.0, 300.0] {
        let random = &mut Random(31);
        let own: Vec<SpotLight> = (0..60)
            .map(|_| {
                let [x, y, z] = random.vector(6.0);
                SpotLight {
                    p: [x + away, y, z + 3.0],
                    axis: [0.0, 0.0, -1.0],
                    intensity: [1.0; 3],
                    range: 0.0,
                    cos_inner: 0.996,
                    cos_outer: 0.995,
                    mesh: 0,
                }
            })
            .collect();
        let mut bvh = Tree::<AnyLight>::default();
        for spot in &own {
            let mesh = bvh.add_mesh(any([*spot].to_vec())).expect("in the domain");
            bvh.add_instance(mesh, Transform::IDENTITY)
                .expect("in the domain");
        }
        bvh.refit();
        let (mut dark, mut outside) = (0, 0);
        for _ in 0..200 {
            let [x, y, _] = random.vector(7.0);
            let p = [x + away, y, -2.0];
            for found in told(
                &bvh,
                &ShadingPoint {
                    p,
                    n: [0.0, 0.0, 1.0],
                },
            ) {
                let light = world_light(bvh.triangles(), bvh.instances(), found.light, found.instance);
                let is_lit = sent(&light, p) > 0.0;
                assert!(!is_lit || found.least >= 0.99);
                dark += u32::from(!is_lit);
                outside += u32::from(!is_lit && found.least < 0.99);
            }
        }
        // All but those at the very edge.
        assert!(
            dark > 9000 && outside * 100 >= dark * 99,
            "{away}: {outside} of {dark}"
        );
    }
}

/// Sum of squares of what a sample gives over the square of what all lights give: 1 is perfect.
fn second_moment<L: Light>(lights: &[L], point: &ShadingPoint, pmf: impl Fn(usize) -> f32) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (k, light) in lights.iter().enumerate() {
        let at = light.point_for(Vec3::from(point.p), [0.5; 2]);
        let d: [f64; 3] = core::array::from_fn(|k| f64::from(at.p[k]) - f64::from(point.p[k]));
        let squared: f64 = d.iter().map(|x| x * x).sum();
        let cosine = d.iter().zip(point.n).map(|(x, n)| x * f64::from(n)).sum::<f64>() / squared.sqrt();
        let f = f64::from(at.radiance[0]) * cosine.max(0.0) / squared;
        sum += f;
        if f > 0.0 {
            squares += f * f / f64::from(pmf(k));
        }
    }
    squares / (sum * sum)
}

/// A room with bulbs and a bright narrow spot: beside its cone the bulbs are chosen.
#[test]
fn points_beside_a_cone_choose_what_lights_them() {
    let random = &mut Random(12);
    for angle in [5.0_f32, 15.0, 30.0, 60.0] {
        let mut own: Vec<AnyLight> = (0..8)
            .map(|_| {
                PointLight {
                    p: [4.0 * random.signed(), 4.0 * random.signed(), 3.0],
                    intensity: [1.0; 3],
                    range: 0.0,
                    mesh: 0,
                }
                .into()
            })
            .collect();
        own.push(
            SpotLight {
                p: [0.0, 0.0, 3.5],
                intensity: [2000.0; 3],
                range: 0.0,
                axis: [0.0, 0.0, -1.0],
                cos_inner: angle.to_radians().cos(),
                cos_outer: angle.to_radians().cos(),
                mesh: 0,
            }
            .into(),
        );
        let lights = Lights::new(own.clone()).expect("in the domain");
        let with = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
        let without = Plain::<AnyLight>::single_level(&lights, &BuildParams::default());
        let (mut beside, mut within) = ([0.0, 0.0, 0.0_f64], [0.0, 0.0, 0.0_f64]);
        for _ in 0..400 {
            let p = [5.0 * random.signed(), 5.0 * random.signed(), 0.0];
            let point = ShadingPoint {
                p,
                n: [0.0, 0.0, 1.0],
            };
            let is_within = sent(&own[8], p) > 0.0;
            let sums = if is_within { &mut within } else { &mut beside };
            sums[0] += second_moment(&own, &point, |k| with.pmf(&point, k as u32, u32::MAX)).ln();
            sums[1] += second_moment(&own, &point, |k| without.pmf(&point, k as u32, u32::MAX)).ln();
            sums[2] += 1.0;
        }
        let mean = |sums: [f64; 3]| [(sums[0] / sums[2]).exp(), (sums[1] / sums[2]).exp(), sums[2]];
        println!("{angle}°: beside {:?}, within {:?}", mean(beside), mean(within));
        let [found, was, count] = mean(beside);
        assert!(count > 10.0);
        assert!(found < 2.0, "{angle}: {found}, without {was}");
        let [found, was, count] = mean(within);
        assert!(
            count < 1.0 || found < 1.01 * was,
            "{angle}: {found}, without {was}"
        );
    }
}

/// In its cone a spot counts as what it is there: as bright as a bulb that sends as much, at its side or among spots around it.
#[test]
fn points_in_a_cone_see_how_bright_it_is() {
    for angle in [2.0_f32, 10.0, 25.0, 50.0] {
        let cosine = angle.to_radians().cos();
        let spot = |x: f32| -> AnyLight {
            SpotLight {
                p: [x, 0.0, 4.0],
                intensity: [5.0; 3],
                range: 0.0,
                axis: [0.0, 0.0, -1.0],
                cos_inner: cosine,
                cos_outer: cosine,
                mesh: 0,
            }
            .into()
        };
        let bulb = |x: f32| -> AnyLight {
            PointLight {
                p: [x, 0.0, 4.0],
                intensity: [5.0; 3],
                range: 0.0,
                mesh: 0,
            }
            .into()
        };
        // The spot at 2 m to one side of the point below, the bulb at 2 m to the other.
        let share = |own: Vec<AnyLight>, x: f32| {
            let lights = Lights::new(own).expect("in the domain");
            let bvh = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
            let point = ShadingPoint {
                p: [x, 0.0, 0.0],
                n: [0.0, 0.0, 1.0],
            };
            f64::from(bvh.pmf(&point, 0, u32::MAX))
        };
        let alone = share(vec![spot(0.0), bulb(0.01)], 0.0);
        println!("{angle}°: {alone}");
        assert!((0.33..0.67).contains(&alone), "{angle}: {alone}");
        // Beneath a row of spots a point is in one cone of many: they count for no more than a few bulbs.
        let row: Vec<AnyLight> = core::iter::once(bulb(0.0))
            .chain((0..64).map(|k| spot(10.0 + k as f32)))
            .collect();
        if angle < 5.0 {
            let lone = share(row, 41.5);
            println!("row: {lone}");
            // 0.012; without the depth of the set 0.0005.
            assert!(lone > 0.005, "{lone}");
        }
    }
}

/// Probabilities sum to one, and a sample has the one that is told.
fn check_pmf(bvh: &Tree<AnyLight>, random: &mut Random, points: u32) {
    let tree = bvh.tree();
    for _ in 0..points {
        let p = random.vector(8.0);
        let point = random.point(p);
        let all = told(bvh, &point);
        let sum: f64 = all
            .iter()
            .map(|own| f64::from(tree.pmf_for(&point, own.light, own.instance)))
            .sum();
        assert!((sum - 1.0).abs() < 1.0e-5, "{sum}");
        for _ in 0..20 {
            let sampled = bvh.sample(&point, random.word());
            let pmf = tree.pmf_for(&point, sampled.light, sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
            assert!(pmf > 0.0);
        }
    }
}

#[test]
fn edits_and_rebuilds_keep_beams_and_probabilities() {
    for opens in [false, true] {
        let random = &mut Random(71 + u32::from(opens));
        let mut bvh = Tree::<AnyLight>::new(BuildParams {
            opens,
            ..BuildParams::default()
        });
        let mut ids = Vec::new();
        let mut meshes = Vec::new();
        for _ in 0..60 {
            let count = [1, 2, 30][random.below(3) as usize];
            let mut own = any(spots(random, count, 0.5));
            if random.below(2) == 0 {
                own.push(other(random));
            }
            meshes.push((
                bvh.add_mesh(own.clone()).expect("in the domain"),
                own.len() as u32,
            ));
        }
        for k in 0..2500 {
            let (mesh, _) = meshes[k % meshes.len()];
            ids.push(
                bvh.add_instance(mesh, even(random, 60.0, 1.0))
                    .expect("in the domain"),
            );
        }
        bvh.refit();
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            rebuild: RebuildParams::eager(),
            ..RebuilderParams::default()
        });
        for frame in 0..40 {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            for _ in 0..30 {
                let at = random.below(ids.len() as u32) as usize;
                match random.below(4) {
                    0 => {
                        bvh.remove_instance(ids.swap_remove(at)).expect("it is there");
                        let (mesh, _) = meshes[random.below(60) as usize];
                        ids.push(
                            bvh.add_instance(mesh, even(random, 60.0, 1.0))
                                .expect("in the domain"),
                        );
                    }
                    1 => bvh
                        .set_radiance(ids[at], random.below(3) as f32)
                        .expect("a factor"),
                    _ => bvh
                        .set_transform(ids[at], even(random, 60.0, 1.0))
                        .expect("in the domain"),
                }
            }
            let (mesh, count) = meshes[random.below(60) as usize];
            let first = random.below(count);
            let some = 1 + random.below(count - first);
            let own = any(spots(random, some, 0.5));
            bvh.set_triangle_range(mesh, first, own).expect("in the mesh");
            bvh.refit();
            rebuilder.end_frame(&bvh);
            bvh.validate().expect("nodes are what refit makes");
            if frame % 10 == 9 {
                check_pmf(&bvh, random, 2);
            }
        }
        let words = bvh.to_words();
        let read = Tree::<AnyLight>::from_words(&words).expect("what was written");
        assert!(read.to_words() == words);
        check_pmf(&read, random, 2);
    }
}

/// Without spots, all bits are those of the layout without beams.
#[test]
fn other_lights_are_what_they_were() {
    let random = &mut Random(5);
    let own: Vec<AnyLight> = (0..300).map(|_| other(random)).collect();
    let lights = Lights::new(own).expect("in the domain");
    let with = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
    let without = Plain::<AnyLight>::single_level(&lights, &BuildParams::default());
    for k in 0..4000_u32 {
        let p = random.vector(8.0);
        let point = random.point(p);
        assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
    }
}

/// A map that is no similarity changes angles: beams do not count there, and probabilities are those without.
#[test]
fn uneven_maps_leave_beams_out() {
    let random = &mut Random(15);
    let mut with = Tree::<AnyLight>::default();
    let mut without = Plain::<AnyLight>::default();
    for _ in 0..12 {
        let own = any(spots(random, 5, 1.0));
        let mut place = even(random, 5.0, 1.0);
        place.columns[1] = place.columns[1].map(|x| x * 1.01);
        let mesh = with.add_mesh(own.clone()).expect("in the domain");
        with.add_instance(mesh, place).expect("in the domain");
        let mesh = without.add_mesh(own).expect("in the domain");
        without.add_instance(mesh, place).expect("in the domain");
    }
    with.refit();
    without.refit();
    for k in 0..4000_u32 {
        let p = random.vector(8.0);
        let point = random.point(p);
        assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
    }
    assert!(
        with.instances()
            .iter()
            .filter(|own| own.count > 0)
            .all(|own| !own.is_even())
    );
}

/// Masks and beams together: a light has a probability just where it has a bit in common.
#[test]
fn masks_stand_beside_beams() {
    type Both = Bvh<Lit<LinkedSpotMomentNode<8>, LinkedAny>, Linked<Leveled<Moments, 9>>, 8>;
    let random = &mut Random(25);
    let own: Vec<LinkedAny> = any(spots(random, 200, 4.0))
        .into_iter()
        .map(|light| LinkedAny {
            light,
            mask: 1 << random.below(8),
        })
        .collect();
    let bvh = Both::single_level(
        &Lights::new(own.clone()).expect("in the domain"),
        &BuildParams::default(),
    );
    for _ in 0..200 {
        let p = random.vector(8.0);
        let receiver = LinkedPoint {
            point: random.point(p),
            mask: random.below(256),
        };
        let mut sum = 0.0;
        for (k, own) in own.iter().enumerate() {
            let pmf = bvh.tree().pmf_for(&receiver, k as u32, u32::MAX);
            assert_eq!(pmf > 0.0, own.mask & receiver.mask != 0);
            sum += f64::from(pmf);
        }
        let expected = f64::from(u8::from(receiver.mask != 0));
        assert!((sum - expected).abs() < 1.0e-5, "{sum} for {:#x}", receiver.mask);
    }
}
