//! Nodes that know beams, against an exhaustive oracle: no light that reaches a point is told not to, at any scale, through
//! instances; and points next to a cone stop choosing its spot.

use crate::kit::Random;
use glam::Vec3;
use lightbvh::device::trail::leaf_parts;
use lightbvh::exact::hash;
use lightbvh::importance::Space;
use lightbvh::light::{AnyLight, Light, PointLight, SpotLight};
use lightbvh::node::{MomentNode, Node, SpotMomentNode, kind};
use lightbvh::refit::world_light;
use lightbvh::{BuildParams, Bvh, ImportanceModel, Lights, Moments, ShadingPoint, Transform};

type Tree = Bvh<(SpotMomentNode<8, AnyLight>, Moments)>;

type Plain = Bvh<(MomentNode<8, AnyLight>, Moments)>;

/// Spots of a quarter of a degree to nearly 90° within `reach`. In one of two sets all are of about the same direction: they
/// keep to a beam at all levels. In one of two all have a range of that order.
fn spots(random: &mut Random, count: u32, reach: f32) -> Vec<AnyLight> {
    let (shared, apart) = (random.unit_vector(), [1, 4][random.below(2) as usize]);
    let have_ranges = random.below(2) as f32;
    let spot = |_| {
        let axis = if random.below(apart) == 0 {
            let off = random.within(0.1);
            let v: [f32; 3] = core::array::from_fn(|k| shared[k] + off[k]);
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            v.map(|x| x / length)
        } else {
            random.unit_vector()
        };
        let outer = (90.0_f32 * 0.0028_f32.powf(random.unit())).to_radians().cos();
        let inner = outer + (1.0 - outer) * random.unit() * random.below(2) as f32;
        SpotLight {
            p: random.within(reach),
            intensity: [10.0_f32.powf(3.0 * random.signed()); 3],
            range: have_ranges * reach * 10.0_f32.powf(random.signed()),
            axis,
            cos_inner: inner.min(1.0),
            cos_outer: outer.min(1.0 - 1.0e-5),
            mesh: 0,
        }
        .into()
    };
    (0..count).map(spot).collect()
}

/// Shines down from `p`, to `angle` from its axis.
fn down(p: [f32; 3], intensity: f32, angle: f32) -> AnyLight {
    let cosine = angle.to_radians().cos();
    SpotLight {
        p,
        intensity: [intensity; 3],
        range: 0.0,
        axis: [0.0, 0.0, -1.0],
        cos_inner: cosine,
        cos_outer: cosine,
        mesh: 0,
    }
    .into()
}

fn bulb(p: [f32; 3], intensity: f32) -> AnyLight {
    PointLight {
        p,
        intensity: [intensity; 3],
        range: 0.0,
        mesh: 0,
    }
    .into()
}

fn floor(x: f32, y: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, y, 0.0],
        n: [0.0, 0.0, 1.0],
    }
}

/// A light, and the least factor that a beam puts on a weight on the path to it.
struct Told {
    light: u32,
    instance: u32,
    least: f32,
}

/// All lights, with what the beams on their paths say.
fn told(bvh: &Tree, point: &ShadingPoint) -> Vec<Told> {
    let tree = bvh.tree();
    let mut found = Vec::new();
    // Node, instance above it, factor so far.
    let mut open = vec![(tree.root, u32::MAX, 1.0_f32)];
    while let Some((index, above, least)) = open.pop() {
        let own = tree.instances.get(above as usize);
        let (node, local, space) = match own {
            Some(own) => (&tree.nodes[index as usize], own.to_local(point), own.space()),
            None => (&tree.top[index as usize], *point, Space::WORLD),
        };
        let with = <Moments>::weights_in(node, &local, space);
        let without = <Moments>::weights_in(node, &local, Space { slack: -1.0, ..space });
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
                    let own = &tree.instances[instance as usize];
                    let child = |slot| {
                        let root = &tree.nodes[own.root as usize];
                        (root.kind(slot), root.link(slot))
                    };
                    // The whole, a part of it, or one light.
                    let (to, link) = match part {
                        0 if own.root == u32::MAX => (kind::LIGHT, own.first_light),
                        0 => (kind::INNER, own.root),
                        _ => child(part as usize - 1),
                    };
                    match to {
                        kind::LIGHT => found.push(Told {
                            light: own.light_of(link),
                            instance,
                            least,
                        }),
                        _ => open.push((link, instance, least)),
                    }
                }
                _ => found.push(Told {
                    light: own.map_or(link, |own| own.light_of(link)),
                    instance: above,
                    least,
                }),
            }
        }
    }
    found
}

/// What the light sends to `p`, as the sum of its channels.
fn sent(light: &AnyLight, p: [f32; 3]) -> f32 {
    light.point_for(Vec3::from(p), [0.5; 2]).radiance.iter().sum()
}

fn light_of(bvh: &Tree, own: &Told) -> AnyLight {
    world_light(bvh.view().lights(), bvh.tree().instances, own.light, own.instance)
}

fn sends(bvh: &Tree, own: &Told, p: [f32; 3]) -> bool {
    sent(&light_of(bvh, own), p) > 0.0
}

/// The least that a beam may leave of the weight of a light that reaches `p`: nearly all of it, or of one that fades by its range
/// the square of a fourth of what the range leaves of its light.
fn left(bvh: &Tree, own: &Told, p: [f32; 3]) -> f32 {
    let light = light_of(bvh, own);
    match SpotLight::try_from(light) {
        Ok(spot) if spot.range > 0.0 => {
            let whole = SpotLight { range: 0.0, ..spot };
            let left = 0.25 * sent(&light, p) / sent(&whole.into(), p);
            (0.99 * left * left).max(1.0e-5)
        }
        _ => 0.99,
    }
}

#[derive(Debug, Default)]
struct Seen {
    lit: u32,
    wrong: u32,
    outside: u32,
    dark: u32,
}

impl Seen {
    /// Points in, at the edge of and next to the cones and the ranges of lights of `bvh`, at any distance: no light that shines there is
    /// told not to.
    fn check(&mut self, bvh: &Tree, scale: f32, random: &mut Random, points: u32) {
        let world = bvh.view().world_lights();
        for _ in 0..points {
            let about = world[random.below(world.len() as u32) as usize];
            let mut point = random.point(2.0 * scale);
            if let (Ok(spot), true) = (SpotLight::try_from(about), random.below(4) > 0) {
                let angle = spot.cos_outer.acos() * [0.5, 0.99, 0.999, 1.1][random.below(4) as usize];
                let v = random.across(spot.axis);
                let far = match random.below(2) {
                    0 if spot.range > 0.0 => spot.range * [0.5, 0.98, 0.9999, 1.1][random.below(4) as usize],
                    _ => scale * 100.0_f32.powf(random.signed()),
                };
                point.p = core::array::from_fn(|k| {
                    spot.p[k] + far * (spot.axis[k] * angle.cos() + v[k] * angle.sin())
                });
            }
            for own in told(bvh, &point) {
                let is_outside = own.least < 0.99;
                if sends(bvh, &own, point.p) {
                    self.lit += 1;
                    self.wrong += u32::from(own.least < left(bvh, &own, point.p));
                } else {
                    self.dark += 1;
                    self.outside += u32::from(is_outside);
                }
            }
        }
    }

    /// That enough was seen, and at least the share `least` of what does not arrive is told not to.
    fn is_sound(&self, least: f64) {
        assert!(self.lit > 5_000 && self.dark > 50_000, "{self:?}");
        assert_eq!(self.wrong, 0, "{self:?}");
        assert!(f64::from(self.outside) > least * f64::from(self.dark), "{self:?}");
    }
}

fn put(bvh: &mut Tree, own: Vec<AnyLight>, place: Transform) {
    let mesh = bvh.add_mesh(own).expect("in the domain");
    bvh.add_instance(mesh, place).expect("in the domain");
}

#[test]
fn lit_points_keep_weight() {
    let mut seen = Seen::default();
    for seed in 0..40 {
        let random = &mut Random(1000 * seed + 3);
        let scale = 10.0_f32.powi(seed as i32 % 8 - 3);
        let mut bvh = Tree::default();
        for _ in 0..1 + random.below(6) {
            let count = [1, 3, 12, 90][random.below(4) as usize];
            let reach = scale * 0.01_f32.powf(random.unit());
            let mut own = spots(random, count, reach);
            if random.below(3) == 0 {
                let kind = random.below(5);
                own.push(random.light(kind));
            }
            let mesh = bvh.add_mesh(own).expect("in the domain");
            for _ in 0..=random.below(4) {
                let place = random.similarity(2.0 * scale, 1.0);
                bvh.add_instance(mesh, place).expect("in the domain");
            }
        }
        bvh.refit();
        seen.check(&bvh, scale, random, 300);
    }
    seen.is_sound(0.98);
}

/// Far from the world's origin coordinates are rounded by more than a narrow cone is wide near its lamp: a point in it is in it
/// still.
#[test]
fn far_from_the_origin_no_light_is_told_not_to_reach_a_point() {
    for (far, least) in [(100.0_f32, 0.99), (1.0e4, 0.97), (3.0e5, 0.8)] {
        let random = &mut Random(77);
        let mut seen = Seen::default();
        for turn in 0..30 {
            let mut bvh = Tree::default();
            let about = random.within(far);
            // By instances of any scale, or in a mesh that stands there itself.
            let scale = [1.0, 0.02, 50.0][turn % 3];
            for _ in 0..1 + random.below(6) {
                let count = [1, 1, 3, 12][random.below(4) as usize];
                let mut own = spots(random, count, 0.3 / scale);
                if turn % 2 == 1 {
                    for light in &mut own {
                        let mut spot = SpotLight::try_from(*light).expect("a spot");
                        (0..3).for_each(|k| spot.p[k] += about[k]);
                        *light = spot.into();
                    }
                    put(&mut bvh, own, Transform::IDENTITY);
                    continue;
                }
                let mesh = bvh.add_mesh(own).expect("in the domain");
                for _ in 0..=random.below(4) {
                    let mut place = random.similarity(4.0, scale);
                    (0..3).for_each(|k| place.translation[k] += about[k]);
                    bvh.add_instance(mesh, place).expect("in the domain");
                }
            }
            bvh.refit();
            seen.check(&bvh, 1.0, random, 300);
        }
        seen.is_sound(least);
    }
}

/// Spots that stand apart and shine the same way in cones as narrow as may be: the apex of what holds them lies farther behind
/// than a node can say, or nearly so.
#[test]
fn wide_sets_of_narrow_cones_leave_no_light_out() {
    let random = &mut Random(41);
    let mut seen = Seen::default();
    for _ in 0..40 {
        let axis = random.unit_vector();
        let angle = (0.25_f32 * 20.0_f32.powf(random.unit())).to_radians();
        let own = (0..12 + random.below(40)).map(|_| SpotLight {
            p: random.within(1.0),
            axis,
            intensity: [1.0; 3],
            range: 0.0,
            cos_inner: angle.cos(),
            cos_outer: angle.cos().min(1.0 - 2.0_f32.powi(-20)),
            mesh: 0,
        });
        let mut bvh = Tree::default();
        let own = own.map(AnyLight::from).collect();
        put(&mut bvh, own, random.similarity(3.0, 1.0));
        bvh.refit();
        seen.check(&bvh, 3.0, random, 200);
    }
    seen.is_sound(0.0);
}

/// Without spots, and under a map that is no similarity, which changes angles, samples are those of the layout without beams.
#[test]
fn where_no_beam_counts_samples_are_those_without() {
    let random = &mut Random(15);
    for has_spots in [false, true] {
        let mut with = Tree::default();
        let mut without = Plain::default();
        for _ in 0..12 {
            let mut place = random.similarity(5.0, 1.0);
            let own = if has_spots {
                place.columns[1] = place.columns[1].map(|x| x * 1.01);
                spots(random, 5, 1.0)
            } else {
                (0..25).map(|k| random.light(k % 5)).collect()
            };
            let mesh = without.add_mesh(own.clone()).expect("in the domain");
            without.add_instance(mesh, place).expect("in the domain");
            put(&mut with, own, place);
        }
        with.refit();
        without.refit();
        for k in 0..4000_u32 {
            let point = random.point(8.0);
            assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
        }
        let mut placed = with.view().instances().iter().filter(|own| own.count > 0);
        assert!(placed.all(|own| own.is_even() != has_spots));
    }
}

/// In its cone a spot counts as what it is there: as bright as a bulb that sends as much, at its side or among spots around it.
#[test]
fn points_in_a_cone_see_how_bright_it_is() {
    let share = |own: Vec<AnyLight>, x: f32| {
        let lights = Lights::new(own).expect("in the domain");
        let bvh = Tree::single_level(&lights, &BuildParams::default());
        bvh.tree().pmf(&floor(x, 0.0), 0, u32::MAX)
    };
    let spot = |x: f32, angle: f32| down([x, 0.0, 4.0], 5.0, angle);
    for angle in [2.0_f32, 10.0, 25.0, 50.0] {
        let alone = share(vec![spot(0.0, angle), bulb([0.01, 0.0, 4.0], 5.0)], 0.0);
        assert!((0.33..0.67).contains(&alone), "{angle}: {alone}");
    }
    // Beneath a row of spots a point is in one cone of many: they count for no more than a few bulbs.
    let mut row = vec![bulb([0.0, 0.0, 4.0], 5.0)];
    row.extend((0..64).map(|k| spot(10.0 + k as f32, 2.0)));
    let lone = share(row, 41.5);
    // 0.012; without the depth of the set 0.0005.
    assert!(lone > 0.005, "{lone}");
}

/// Sum of squares of what a sample gives over the square of what all lights give: 1 is perfect.
fn second_moment(lights: &[AnyLight], point: &ShadingPoint, pmf: impl Fn(u32) -> f32) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (k, light) in (0..).zip(lights) {
        let f = f64::from(light.point_for(Vec3::from(point.p), [0.5; 2]).irradiance(point)[0]);
        sum += f;
        squares += if f > 0.0 { f * f / f64::from(pmf(k)) } else { 0.0 };
    }
    squares / (sum * sum)
}

/// Points and spots that end after 15 and 25 metres, spread over a field of 200 metres: few samples go to lights that do not
/// arrive, and variance is less.
#[test]
fn points_out_of_range_are_seldom_chosen() {
    let random = &mut Random(61);
    let own: Vec<AnyLight> = (0..2000)
        .map(|k| {
            let p = [
                100.0 * random.signed(),
                100.0 * random.signed(),
                3.0 + 3.0 * random.unit(),
            ];
            let range = [15.0, 25.0][k % 2];
            match k % 4 {
                0 | 1 => PointLight {
                    range,
                    ..PointLight::try_from(bulb(p, 1.0)).expect("a point")
                }
                .into(),
                _ => SpotLight {
                    range,
                    ..SpotLight::try_from(down(p, 2.0, 50.0)).expect("a spot")
                }
                .into(),
            }
        })
        .collect();
    let lights = Lights::new(own.clone()).expect("in the domain");
    let with = Tree::single_level(&lights, &BuildParams::default());
    let without = Plain::single_level(&lights, &BuildParams::default());
    let points = 200.0;
    let (mut lost, mut lost_without) = (0.0, 0.0);
    let (mut second, mut second_without) = (0.0, 0.0);
    for _ in 0..200 {
        let point = floor(100.0 * random.signed(), 100.0 * random.signed());
        second += second_moment(&own, &point, |k| with.tree().pmf(&point, k, u32::MAX));
        second_without += second_moment(&own, &point, |k| without.tree().pmf(&point, k, u32::MAX));
        let dark = (0..).zip(&own).filter(|(_, light)| sent(light, point.p) == 0.0);
        for (k, _) in dark {
            lost += f64::from(with.tree().pmf(&point, k, u32::MAX));
            lost_without += f64::from(without.tree().pmf(&point, k, u32::MAX));
        }
    }
    let found = [lost, lost_without, second, second_without].map(|sum| sum / points);
    assert!(found[0] < 0.08 && found[1] > 0.3, "{found:?}");
    assert!(found[2] - 1.0 < 0.5 * (found[3] - 1.0), "{found:?}");
}

/// A car looks along x or against it: two headlights and two tail lights.
fn car() -> Vec<AnyLight> {
    let lamp = |y: f32, is_head: bool| match is_head {
        true => SpotLight {
            axis: [1.0, 0.0, 0.0],
            ..SpotLight::try_from(down([2.2, y, 0.7], 2000.0, 30.0)).expect("a spot")
        }
        .into(),
        false => bulb([-2.2, y, 0.8], 5.0),
    };
    [(-0.7, true), (0.7, true), (-0.7, false), (0.7, false)]
        .map(|(y, is_head)| lamp(y, is_head))
        .to_vec()
}

/// Mean second moment of a sample among cars that are instances of a mesh each, at points on the road.
fn second_of_cars(
    meshes: &[Vec<AnyLight>],
    shares: &[f32],
    places: &[Transform],
    points: &[ShadingPoint],
) -> f64 {
    let trees = meshes.iter().map(|own| {
        let mut bvh = Tree::default();
        let mesh = bvh.add_mesh(own.clone()).expect("in the domain");
        let ids: Vec<_> = places
            .iter()
            .map(|place| bvh.add_instance(mesh, *place).expect("in the domain"))
            .collect();
        bvh.refit();
        bvh.view().validate().expect("a sound tree");
        (bvh, ids)
    });
    let trees: Vec<_> = trees.collect();
    let mut lights = Vec::new();
    let mut names = Vec::new();
    for (tree, (bvh, ids)) in trees.iter().enumerate() {
        for id in ids {
            for (part, number) in bvh.view().lights_of(*id).expect("an instance").enumerate() {
                lights.push(bvh.view().light(number, id.index()).expect("a light"));
                names.push((tree, *id, part as u32));
            }
        }
    }
    let second = |point: &ShadingPoint| {
        second_moment(&lights, point, |k| {
            let (tree, id, part) = names[k as usize];
            shares[tree] * trees[tree].0.pmf(point, id, part).expect("a light")
        })
    };
    points.iter().map(second).sum::<f64>() / points.len() as f64
}

/// Headlights and tail lights in one mesh: no worse than a light BVH of each, half of the samples to either.
#[test]
fn cars_with_headlights_in_one_mesh_cost_no_more_than_two_trees() {
    let mut ratios = Vec::new();
    for seed in 0..4 {
        let random = &mut Random(91 + 1000 * seed);
        let place = |random: &mut Random| {
            let forward = [1.0, -1.0][random.below(2) as usize];
            Transform {
                columns: [[forward, 0.0, 0.0], [0.0, forward, 0.0], [0.0, 0.0, 1.0]],
                translation: [
                    200.0 * random.signed(),
                    80.0 * random.below(5) as f32 - 3.0 * forward,
                    0.0,
                ],
            }
        };
        let places: Vec<_> = (0..300).map(|_| place(random)).collect();
        let points: Vec<_> = (0..300)
            .map(|_| {
                floor(
                    200.0 * random.signed(),
                    80.0 * random.below(5) as f32 + 8.0 * random.signed(),
                )
            })
            .collect();
        let (heads, tails) = (car()[..2].to_vec(), car()[2..].to_vec());
        let whole = second_of_cars(&[car()], &[1.0], &places, &points);
        let split = second_of_cars(&[heads, tails], &[0.5; 2], &places, &points);
        ratios.push((whole - 1.0) / (split - 1.0));
    }
    assert!(ratios.iter().all(|&ratio| ratio < 1.3), "{ratios:?}");
}
