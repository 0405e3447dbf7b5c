//! Light linking against an exhaustive oracle: a light has a probability just where it has flux and a bit in common with the receiver,
//! through edits, refits, rebuilds and files.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use lightbvh::bvh::{RebuildParams, RebuilderParams, StaticMeshBvh, Swap};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::{AnyLight, Light, LinkedAny, LinkedTriangle, PointLight, SphereLight};
use lightbvh::node::{LinkedMomentNode, Lit, Node, PackedMomentNode};
use lightbvh::tree::LightTree;
use lightbvh::{
    BuildParams, Bvh, Edit, EmissiveTriangle, Flux, Glossy, GlossyPoint, ImportanceModel, Lights, MomentNode,
    Moments, Random64, Rebuilder, Receiver, SampledLight, ShadingPoint, Transform, TwoSidedMomentNode,
};

type Layout<L> = Lit<LinkedMomentNode<8>, L>;
type Tree<L> = Bvh<Layout<L>, Linked<Moments>, 8>;

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

    /// Of few bits, so that some receivers have few lights; none for one in eight, all for one in eight.
    fn mask(&mut self) -> u32 {
        match self.below(8) {
            0 => 0,
            1 => u32::MAX,
            2 => 1 << 31,
            _ => 1 << self.below(12),
        }
    }

    fn receiver(&mut self, reach: f32) -> LinkedPoint<ShadingPoint> {
        let n = if self.below(3) == 0 {
            [0.0; 3]
        } else {
            self.unit_vector()
        };
        LinkedPoint {
            point: ShadingPoint {
                p: self.vector(reach),
                n,
            },
            mask: match self.below(6) {
                0 => self.word(),
                _ => self.mask(),
            },
        }
    }

    /// None in one of eight, else over six orders of magnitude: what is left may be far dimmer than what is masked out.
    fn radiance(&mut self) -> [f32; 3] {
        let level = 10.0_f32.powf(3.0 * self.signed());
        let dark = self.below(8) == 0;
        core::array::from_fn(|_| if dark { 0.0 } else { level * (0.1 + self.unit()) })
    }
}

fn triangle(random: &mut Random) -> LinkedTriangle {
    let at = random.vector(5.0);
    let mut p = [at; 3];
    // One in sixteen has no area.
    if random.below(16) > 0 {
        for vertex in &mut p[1..] {
            let edge = random.vector(0.3);
            *vertex = core::array::from_fn(|k| at[k] + edge[k]);
        }
    }
    LinkedTriangle {
        light: EmissiveTriangle {
            p,
            radiance: random.radiance(),
            mesh: 0,
            flags: random.below(2),
        },
        mask: random.mask(),
    }
}

fn any(random: &mut Random) -> LinkedAny {
    let light: AnyLight = match random.below(3) {
        0 => PointLight {
            p: random.vector(5.0),
            intensity: random.radiance(),
            range: 0.0,
            mesh: 0,
        }
        .into(),
        1 => SphereLight {
            p: random.vector(5.0),
            radius: 0.01 + random.unit(),
            radiance: random.radiance(),
            mesh: 0,
        }
        .into(),
        _ => triangle(random).light.into(),
    };
    LinkedAny {
        light,
        mask: random.mask(),
    }
}

fn place(random: &mut Random) -> Transform {
    let turn = random.unit() * core::f32::consts::TAU;
    let (s, c) = (turn.sin(), turn.cos());
    let mut columns = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]];
    for column in &mut columns {
        let scale = 0.25 + 2.0 * random.unit();
        *column = column.map(|x| x * scale);
    }
    Transform {
        columns,
        translation: random.vector(30.0),
    }
}

/// Flux of a light of a mesh, by what it is made of.
trait Shines: Light {
    fn shines(&self) -> bool;
    fn bits(&self) -> u32;
}

fn shines(radiance: [f32; 3], p: [[f32; 3]; 3]) -> bool {
    let edge = |k: usize| -> [f64; 3] { core::array::from_fn(|i| f64::from(p[k][i]) - f64::from(p[0][i])) };
    let (a, b) = (edge(1), edge(2));
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    radiance.iter().any(|&x| x > 0.0) && cross.iter().any(|&x| x != 0.0)
}

impl Shines for LinkedTriangle {
    fn shines(&self) -> bool {
        shines(self.light.radiance, self.light.p)
    }

    fn bits(&self) -> u32 {
        self.mask
    }
}

impl Shines for LinkedAny {
    fn shines(&self) -> bool {
        match EmissiveTriangle::try_from(self.light) {
            Ok(own) => shines(own.radiance, own.p),
            Err(other) => other.emission().iter().any(|&x| x > 0.0),
        }
    }

    fn bits(&self) -> u32 {
        self.mask
    }
}

/// A light's number, its instance, and whether the scene, by what it was given, has flux of it.
struct Known {
    light: u32,
    instance: u32,
    shines: bool,
    mask: u32,
}

fn known<L: Shines>(bvh: &Tree<L>) -> Vec<Known> {
    let mut all = Vec::new();
    if bvh.is_single_level() {
        let triangles = bvh.triangles();
        all.extend((0..).zip(triangles).map(|(light, own)| Known {
            light,
            instance: u32::MAX,
            shines: own.shines(),
            mask: own.bits(),
        }));
        return all;
    }
    for index in 0..bvh.instances().len() as u32 {
        let Some(id) = bvh.instance_id(index) else {
            continue;
        };
        let lights = bvh.lights_of(id).expect("of an instance");
        let mesh = bvh.mesh_of(id).expect("of an instance");
        let own = bvh.mesh_triangles(mesh).expect("of a mesh");
        let on = bvh.instances()[index as usize].radiance > 0.0;
        all.extend(lights.zip(own).map(|(light, own)| Known {
            light,
            instance: index,
            shines: on && own.shines(),
            mask: own.bits(),
        }));
    }
    all
}

/// What was seen, so that no case is missing.
#[derive(Debug, Default)]
struct Seen {
    receivers: u32,
    without: u32,
    partial: u32,
    of_one: u32,
}

fn check<N: Node<8>, I, P: Receiver>(
    tree: &LightTree<'_, N, I, 8>,
    known: &[Known],
    receiver: &LinkedPoint<P>,
    random: &mut Random,
    seen: &mut Seen,
) where
    I: ImportanceModel<N, 8, LinkedPoint<P>>,
{
    let (mut sum, mut allowed, mut shining) = (0.0, 0, 0);
    let mut pmfs = Vec::with_capacity(known.len());
    for own in known {
        let pmf = tree.pmf_for(receiver, own.light, own.instance);
        let is_allowed = own.shines && own.mask & receiver.mask != 0;
        assert_eq!(
            pmf > 0.0,
            is_allowed,
            "light {} of {}: pmf {pmf}, mask {:#x} & {:#x}",
            own.light,
            own.instance,
            own.mask,
            receiver.mask
        );
        if !is_allowed {
            assert_eq!(pmf.to_bits(), 0, "exactly none");
        }
        sum += f64::from(pmf);
        allowed += u32::from(is_allowed);
        shining += u32::from(own.shines);
        pmfs.push(pmf);
    }
    seen.receivers += 1;
    seen.without += u32::from(allowed == 0);
    seen.partial += u32::from(0 < allowed && allowed < shining);
    seen.of_one += u32::from(allowed == 1);
    let expected = if allowed > 0 { 1.0 } else { 0.0 };
    assert!((sum - expected).abs() < 1e-5, "pmfs sum to {sum}");
    let right = |sampled: &SampledLight| {
        if allowed == 0 {
            assert_eq!(*sampled, SampledLight::NONE);
            return;
        }
        let at = known.iter().position(|own| {
            own.light == sampled.light && (own.instance == sampled.instance || own.instance == u32::MAX)
        });
        let at = at.expect("a light of the scene");
        assert!(known[at].shines && known[at].mask & receiver.mask != 0);
        assert_eq!(sampled.pmf.to_bits(), pmfs[at].to_bits());
    };
    for _ in 0..24 {
        let number = Random64 {
            high: random.word(),
            low: random.word(),
        };
        let sampled = tree.sample_for(receiver, number);
        right(&sampled);
        let many = tree.sample_many_for::<LinkedPoint<P>, 5>(receiver, number);
        for (k, one) in (0..).zip(&many) {
            assert_eq!(*one, tree.sample_for(receiver, number.spaced(k, 5)));
        }
        let mut batch = [SampledLight::NONE; 2];
        tree.sample_batch_for(&[*receiver; 2], &[number; 2], &mut batch);
        assert_eq!(batch, [sampled; 2]);
    }
    for number in [0, u32::MAX] {
        right(&tree.sample_for(
            receiver,
            Random64 {
                high: number,
                low: number,
            },
        ));
    }
}

fn check_all<L: Shines>(bvh: &Tree<L>, receivers: u32, random: &mut Random, seen: &mut Seen) {
    bvh.validate().expect("nodes are what refit makes");
    let known = known(bvh);
    for _ in 0..receivers {
        let receiver = random.receiver(if bvh.is_single_level() { 6.0 } else { 32.0 });
        check(&bvh.tree(), &known, &receiver, random, seen);
    }
    // Some light at hand, so that a receiver inside a bright, masked one is among them.
    let near = random.below(known.len().max(1) as u32) as usize;
    if let Some(own) = known.get(near) {
        if let Some(light) = bvh.triangle(own.light, own.instance) {
            let receiver = LinkedPoint {
                point: ShadingPoint {
                    p: light.centroid(),
                    n: [0.0, 1.0, 0.0],
                },
                mask: !own.mask,
            };
            check(&bvh.tree(), &known, &receiver, random, seen);
            check(&bvh.by::<Linked<Flux>>(), &known, &receiver, random, seen);
            check(
                &bvh.by::<Linked<Leveled<Moments, 9>>>(),
                &known,
                &receiver,
                random,
                seen,
            );
            let glossy = LinkedPoint {
                point: GlossyPoint {
                    point: receiver.point,
                    mirror: [0.0, 1.0, 0.0],
                    diffuse: 0.0,
                    specular: 1.0,
                    exponent: 65_536.0,
                },
                mask: random.word(),
            };
            check(
                &bvh.by::<Linked<Glossy<Moments>>>(),
                &known,
                &glossy,
                random,
                seen,
            );
        }
    }
}

fn lights<L>(count: u32, random: &mut Random, light: fn(&mut Random) -> L) -> Vec<L> {
    (0..count).map(|_| light(random)).collect()
}

fn one_level<L: Shines>(light: fn(&mut Random) -> L) {
    let random = &mut Random(1);
    let mut seen = Seen::default();
    for count in [1, 2, 3, 7, 8, 9, 40, 200, 2000] {
        for params in [BuildParams::FAST, BuildParams::default()] {
            let all = Lights::new(lights(count, random, light)).expect("in the domain");
            let mut bvh = Tree::<L>::single_level(&all, &params);
            let receivers = if count < 1000 { 24 } else { 6 };
            check_all(&bvh, receivers, random, &mut seen);
            // New masks alone, and of some lights alone.
            let mesh = bvh.mesh_id(0).expect("one mesh");
            let new = lights(count, random, light);
            bvh.set_triangles(mesh, new).expect("as many");
            bvh.refit();
            check_all(&bvh, receivers / 2, random, &mut seen);
            let first = random.below(count);
            let some = lights(1 + random.below(count - first), random, light);
            bvh.set_triangle_range(mesh, first, some).expect("in the mesh");
            bvh.refit();
            check_all(&bvh, receivers / 2, random, &mut seen);
        }
    }
    assert!(
        seen.without > 50 && seen.partial > 200 && seen.of_one > 20,
        "{seen:?}"
    );
}

#[test]
fn one_level_of_triangles() {
    one_level(triangle);
}

#[test]
fn one_level_of_any_lights() {
    one_level(any);
}

fn two_levels<L: Shines>(light: fn(&mut Random) -> L) {
    let mut seen = Seen::default();
    for seed in 0..4 {
        let random = &mut Random(1000 * seed + 7);
        let mut bvh = Tree::<L>::default();
        let mut ids = Vec::new();
        for _ in 0..2 + random.below(6) {
            let count = if seed == 3 { 300 } else { 1 + random.below(40) };
            let mesh = bvh.add_mesh(lights(count, random, light)).expect("in the domain");
            for _ in 0..=random.below(8) {
                ids.push(bvh.add_instance(mesh, place(random)).expect("in the domain"));
            }
        }
        bvh.refit();
        check_all(&bvh, 8, random, &mut seen);
        let mut rebuilder = Rebuilder::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        for frame in 0..30 {
            rebuilder.begin_frame(&mut bvh).expect("no panic");
            let at = random.below(ids.len() as u32) as usize;
            let mesh = bvh.mesh_of(ids[at]).expect("a mesh");
            let count = bvh.mesh_triangles(mesh).expect("a mesh").len() as u32;
            match random.below(7) {
                0 => bvh.set_transform(ids[at], place(random)).expect("in the domain"),
                1 => bvh
                    .set_radiance(ids[at], [0.0, 1.0, 40.0][random.below(3) as usize])
                    .expect("a factor"),
                2 => bvh
                    .set_triangles(mesh, lights(count, random, light))
                    .expect("as many"),
                3 | 4 => {
                    let first = random.below(count);
                    let some = lights(1 + random.below(count - first), random, light);
                    bvh.set_triangle_range(mesh, first, some).expect("in the mesh");
                }
                5 if ids.len() > 2 => {
                    bvh.remove_instance(ids.swap_remove(at)).expect("it is there");
                }
                _ => ids.push(bvh.add_instance(mesh, place(random)).expect("in the domain")),
            }
            bvh.refit();
            rebuilder.end_frame(&bvh);
            if frame % 3 == 0 {
                check_all(&bvh, 3, random, &mut seen);
            }
        }
        // All built anew.
        let rebuilt = bvh.rebuild(&RebuildParams::eager()).run();
        bvh.install(rebuilt).expect("of this one");
        bvh.refit();
        check_all(&bvh, 6, random, &mut seen);
        // Through a file, to the words.
        let words = bvh.to_words();
        let read = Tree::<L>::from_words(&words).expect("what was written");
        assert!(read.to_words() == words);
        assert_eq!(read.world_lights(), bvh.world_lights());
        check_all(&read, 4, random, &mut seen);
        assert!(Bvh::<Lit<MomentNode<8>, L>, Moments, 8>::from_words(&words).is_err());
    }
    assert!(seen.without > 30 && seen.partial > 100, "{seen:?}");
}

#[test]
fn two_levels_of_triangles() {
    two_levels(triangle);
}

#[test]
fn two_levels_of_any_lights() {
    two_levels(any);
}

/// So many instances that the top level is rebuilt part by part, beside the frames, and keeps subtrees.
#[test]
fn parts_of_large_top_levels() {
    let random = &mut Random(31);
    let mut bvh = Tree::<LinkedTriangle>::default();
    let meshes: Vec<_> = (0..40)
        .map(|_| bvh.add_mesh(lights(2, random, triangle)).expect("in the domain"))
        .collect();
    let wide_place = |random: &mut Random| Transform {
        translation: random.vector(500.0),
        ..place(random)
    };
    let edits = (0..3000).map(|k| Edit::AddInstance {
        mesh: meshes[k % 40],
        transform: wide_place(random),
        radiance: 1.0,
    });
    let edits = edits.collect();
    let ids = bvh.apply(edits).expect("in the domain").instances;
    bvh.refit();
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let mut seen = Seen::default();
    for frame in 0..60 {
        rebuilder.begin_frame(&mut bvh).expect("no panic");
        for _ in 0..40 {
            let id = ids[random.below(3000) as usize];
            bvh.set_transform(id, wide_place(random)).expect("in the domain");
        }
        let mesh = meshes[random.below(40) as usize];
        bvh.set_triangles(mesh, lights(2, random, triangle))
            .expect("as many");
        bvh.refit();
        rebuilder.end_frame(&bvh);
        bvh.validate().expect("nodes are what refit makes");
        if frame % 20 == 19 {
            check_all(&bvh, 2, random, &mut seen);
        }
    }
    assert!(seen.partial > 3, "{seen:?}");
}

/// A large mesh among small ones is opened: parts of it are leaves of the top level.
#[test]
fn opened_meshes() {
    let random = &mut Random(77);
    let mut bvh = Tree::<LinkedTriangle>::new(BuildParams {
        opens: true,
        ..BuildParams::default()
    });
    let mut large = lights(1500, random, triangle);
    // Masks by place, so that parts differ.
    for own in &mut large {
        own.mask = 1 << ((own.light.p[0][0] + 5.0) as u32);
    }
    let mesh = bvh.add_mesh(large.clone()).expect("in the domain");
    let large_one = bvh
        .add_instance(mesh, Transform::IDENTITY)
        .expect("in the domain");
    for _ in 0..20 {
        let small = bvh.add_mesh(lights(3, random, triangle)).expect("in the domain");
        bvh.add_instance(small, place(random)).expect("in the domain");
    }
    bvh.refit();
    let rebuilt = bvh.rebuild(&RebuildParams::eager()).run();
    bvh.install(rebuilt).expect("of this one");
    bvh.refit();
    let is_opened = bvh.instances()[large_one.index() as usize].part != u32::MAX;
    assert!(is_opened, "nothing is tested");
    let mut seen = Seen::default();
    check_all(&bvh, 10, random, &mut seen);
    for own in &mut large {
        own.mask = own.mask.rotate_left(7);
    }
    bvh.set_triangles(mesh, large).expect("as many");
    bvh.refit();
    check_all(&bvh, 10, random, &mut seen);
    // Without triangles, nodes alone know the masks.
    let all = known(&bvh);
    let mut fixed: StaticMeshBvh<_, _, 8> = bvh.clone().into_static_meshes();
    fixed.refit();
    for _ in 0..4 {
        let receiver = random.receiver(6.0);
        check(&fixed.tree(), &all, &receiver, random, &mut seen);
    }
    let fixed = bvh.clone().into_static();
    let receiver = random.receiver(6.0);
    check(&fixed.tree(), &all, &receiver, random, &mut seen);
    // Without trails samples are the same.
    let without = bvh.clone().without_trails();
    for k in 0..200_u32 {
        let receiver = random.receiver(6.0);
        let number = hash(k);
        assert_eq!(
            without.sample_for(&receiver, number),
            bvh.sample_for(&receiver, number)
        );
    }
    assert!(seen.partial > 10, "{seen:?}");
}

/// Frequencies against probabilities: χ² of the lights with at least 8 expected samples, the others together.
#[test]
fn frequencies_are_the_probabilities() {
    const SAMPLES: u32 = 200_000;
    let random = &mut Random(5);
    let mut bvh = Tree::<LinkedTriangle>::default();
    for _ in 0..5 {
        let mesh = bvh.add_mesh(lights(40, random, triangle)).expect("in the domain");
        for _ in 0..3 {
            bvh.add_instance(mesh, place(random)).expect("in the domain");
        }
    }
    bvh.refit();
    let all = known(&bvh);
    for mask in [u32::MAX, 1 << 4, 0b11 << 6, 1 << 31] {
        let mut receiver = random.receiver(30.0);
        receiver.mask = mask;
        let mut counts = vec![0_u32; all.len()];
        for _ in 0..SAMPLES {
            let number = Random64 {
                high: random.word(),
                low: random.word(),
            };
            let sampled = bvh.sample_for(&receiver, number);
            let at = all
                .iter()
                .position(|own| own.light == sampled.light && own.instance == sampled.instance);
            counts[at.expect("a light")] += 1;
        }
        let (mut chi, mut degrees) = (0.0, -1.0);
        let mut rest = [0.0; 2];
        let mut add = |expected: f64, found: f64| {
            chi += (found - expected).powi(2) / expected;
            degrees += 1.0;
        };
        for (own, &count) in all.iter().zip(&counts) {
            let expected =
                f64::from(bvh.tree().pmf_for(&receiver, own.light, own.instance)) * f64::from(SAMPLES);
            if expected >= 8.0 {
                add(expected, f64::from(count));
            } else {
                rest[0] += expected;
                rest[1] += f64::from(count);
            }
        }
        if rest[0] >= 8.0 {
            add(rest[0], rest[1]);
        }
        // Wilson & Hilferty: the cube root is nearly normal. Five of its deviations.
        let z = ((chi / degrees).cbrt() - (1.0 - 2.0 / (9.0 * degrees))) / (2.0 / (9.0 * degrees)).sqrt();
        println!("mask {mask:#x}: chi-squared {chi:.1} of {degrees} degrees, z {z:.2}");
        assert!(degrees > 3.0, "few lights: {degrees}");
        assert!(z < 5.0, "{chi} of {degrees}");
    }
}

/// With every bit in common, light and probability are those of the importance, to the bit; and other importances do not see masks.
#[test]
fn masks_that_allow_all_change_nothing() {
    let random = &mut Random(9);
    let own = lights(700, random, triangle);
    let plain = Lights::new(own.iter().map(|own| own.light).collect()).expect("in the domain");
    let masked = Lights::new(
        own.iter()
            .map(|own| LinkedTriangle::from(own.light))
            .collect::<Vec<_>>(),
    );
    let plain: Bvh<MomentNode<8>, Moments, 8> = Bvh::single_level(&plain, &BuildParams::default());
    let masked =
        Tree::<LinkedTriangle>::single_level(&masked.expect("in the domain"), &BuildParams::default());
    // The words of a node but for the last row are those without masks.
    let row = size_of::<[u32; 8]>();
    assert_eq!(plain.nodes().len(), masked.nodes().len());
    for (a, b) in plain.nodes().iter().zip(masked.nodes()) {
        assert_eq!(
            bytemuck::bytes_of(a),
            &bytemuck::bytes_of(b)[..size_of_val(b) - row]
        );
    }
    for k in 0..3000 {
        let mut receiver = random.receiver(6.0);
        receiver.mask |= 1 << (k % 32);
        let number = random.word();
        let sampled = plain.sample(&receiver.point, number);
        assert_eq!(sampled, masked.sample_for(&receiver, number));
        assert_eq!(sampled, masked.by::<Moments>().sample(&receiver.point, number));
        assert_eq!(
            plain.pmf(&receiver.point, k % 700, 0).to_bits(),
            masked.tree().pmf_for(&receiver, k % 700, 0).to_bits()
        );
    }
}

/// A least share of each child is a least probability of each light, of those that are allowed.
#[test]
fn least_shares_bound_probabilities() {
    const LEAST: f64 = 1.0 / 512.0;
    let random = &mut Random(12);
    let all = Lights::new(lights(600, random, triangle)).expect("in the domain");
    let bvh = Tree::<LinkedTriangle>::single_level(&all, &BuildParams::default());
    // What is raised adds to the sum; shares are whole numbers of 2^21 at least.
    let of_node = LEAST / (1.0 + 8.0 * LEAST) - 2f64.powi(-20);
    let bound = of_node.powi(bvh.depth() as i32);
    let mut below = 0;
    for _ in 0..40 {
        let receiver = random.receiver(6.0);
        for light in 0..600 {
            let plain = bvh.tree().pmf_for(&receiver, light, 0);
            let tree = bvh.by::<Linked<Leveled<Moments, 9>>>();
            let pmf = f64::from(tree.pmf_for(&receiver, light, 0));
            assert_eq!(plain > 0.0, pmf > 0.0);
            assert!(pmf == 0.0 || pmf >= bound, "{pmf} of {bound}");
            below += u32::from(plain > 0.0 && f64::from(plain) < bound);
        }
    }
    assert!(below > 0, "nothing is tested");
}

/// What is not used costs nothing.
#[test]
fn nodes_without_masks_are_what_they_were() {
    const _: () = assert!(size_of::<MomentNode<8>>() == 8 * 24);
    const _: () = assert!(size_of::<TwoSidedMomentNode<8>>() == 8 * 20);
    const _: () = assert!(size_of::<LinkedMomentNode<8>>() == 8 * 28);
    const _: () = assert!(size_of::<Lit<LinkedMomentNode<8>, LinkedTriangle>>() == 8 * 28);
    fn has_masks<const ROWS: usize>() -> bool {
        <PackedMomentNode<8, ROWS> as Node<8>>::HAS_MASKS
    }
    assert_eq!(
        [has_masks::<5>(), has_masks::<6>(), has_masks::<7>()],
        [false, false, true]
    );
    assert_eq!(MomentNode::<8>::EMPTY.mask(3), u32::MAX);
    assert_eq!(LinkedMomentNode::<8>::EMPTY.merged_mask(), 0);
}
