//! No subnormal number comes up in a tree: the processor's own flush-to-zero mode changes no word of refits, samples, pmfs and
//! points on lights. Devices that flush then agree with those that do not.
#![cfg(target_arch = "x86_64")]

use bytemuck::{Pod, cast_slice};
use glam::Vec3;
use lightbvh::importance::{
    DefaultImportance, Flux, Glossy, ImportanceModel, Leveled, Linked, LinkedPoint, RaySegment, Subtended,
    Transmissive, TransmissivePoint,
};
use lightbvh::light::{AnyLight, Light, LinkedAny, LinkedTriangle};
use lightbvh::moments::LightMoments;
use lightbvh::node::{
    CompactNode, LinkedMomentNode, LinkedSpotMomentNode, Lit, MomentLayout, MomentNode, Node, SpotMomentNode,
    TwoSidedMomentNode,
};
use lightbvh::point::Receiver;
use lightbvh::refit::{self, LIMITED_ROWS, PLAIN_ROWS, assembled, bottom_child, top_child};
use lightbvh::summary::Summary;
use lightbvh::{Bvh, Defensive, Eq4, FluxOverDistance, GlossyPoint, Moments, Random64, ShadingPoint, exact};
use lightbvh_peers::{Falcor, Pbrt};
use lightbvh_tests::generate::{Random, log_uniform};
use lightbvh_tests::scenes;

/// Default of the control and status register: every exception masked, round to nearest.
const IEEE: u32 = 0x1f80;
/// The same, subnormal results flushed to zero (bit 15) and subnormal operands read as zero (bit 6).
const FLUSHING: u32 = 0x9fc0;
/// Of each layout; `SCENES` in the environment asks for another number.
const SCENES: u32 = 2000;

/// What `compute` returns in each of the two modes.
pub fn in_both<T>(compute: impl Fn() -> T) -> [T; 2] {
    [IEEE, FLUSHING].map(|mode| {
        // SAFETY: loads the register from a live u32; the mode before is back before anything else of this thread runs.
        unsafe { core::arch::asm!("ldmxcsr [{}]", in(reg) &mode) }
        let result = std::hint::black_box(&compute)();
        // SAFETY: as above.
        unsafe { core::arch::asm!("ldmxcsr [{}]", in(reg) &IEEE) }
        result
    })
}

fn words<T: Pod>(values: &[T]) -> Vec<u32> {
    cast_slice(values).to_vec()
}

/// All nodes and roots, computed anew in the order of the passes, child by child.
#[inline(never)]
fn refitted<N: Node<W>, const W: usize, const ROWS: usize>(bvh: &Bvh<N, (), W>) -> (Vec<u32>, Vec<u32>) {
    let (plan, triangles, instances) = (bvh.plan_of_everything(), bvh.triangles(), bvh.tree().instances);
    let (mut nodes, mut roots) = ([bvh.nodes(), bvh.top_nodes()].concat(), bvh.roots().to_vec());
    let first = bvh.nodes().len() as u32;
    let mut children = [[[0; W]; ROWS]];
    for &index in plan.bottom.nodes() {
        for slot in 0..W {
            bottom_child::<N, W>(&nodes, triangles, index, slot).put(&mut children, 0, slot);
        }
        nodes[index as usize] = assembled(&nodes, index, &children, 0);
    }
    for &index in &plan.roots {
        roots[index as usize] = refit::root(&nodes, roots[index as usize].node);
    }
    for &index in plan.top.nodes() {
        let index = first + index;
        for slot in 0..W {
            top_child::<N, W>(&nodes, first, instances, &roots, index, slot).put(&mut children, 0, slot);
        }
        nodes[index as usize] = assembled(&nodes, index, &children, 0);
    }
    (words(&nodes), words(&roots))
}

/// What a query answers: the sample, the pmf of another light, the light itself, a point on it, what that sends.
#[inline(never)]
fn answers<N, I, P, const W: usize>(
    bvh: &Bvh<N, (), W>,
    receiver: &P,
    at: &ShadingPoint,
    numbers: [u32; 4],
) -> Vec<u32>
where
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver,
{
    let tree = bvh.by::<I>();
    let [high, low, third, fourth] = numbers;
    let sample = tree.sample(receiver, Random64 { high, low });
    let mut all = words(&[sample]);
    if let Some(id) = bvh.instances().len().checked_sub(1) {
        let instance = third % (id as u32 + 1);
        let of = &bvh.instances()[instance as usize];
        all.push(
            tree.pmf(receiver, of.first + fourth % of.count.max(1), instance)
                .to_bits(),
        );
    }
    if let Some(light) = bvh.triangle(sample.light, sample.instance) {
        all.extend(words(&[light]));
        let (u, v) = (exact::unit_f32(third), exact::unit_f32(fourth));
        for uv in [[u, v], [u, u], [1.0 - u, u], [f32::MIN_POSITIVE, v]] {
            let on = light.point_for(at.position(), uv);
            all.extend(words(&[on]));
            all.extend(on.irradiance(at).map(f32::to_bits));
        }
    }
    all
}

/// The parts of one scene that differ.
type Differing = Vec<String>;

fn note(differing: &mut Differing, what: &str, [plain, flushed]: &[Vec<u32>; 2]) {
    if let Some(k) = (0..plain.len().max(flushed.len())).find(|&k| plain.get(k) != flushed.get(k)) {
        let word = |of: &[u32]| {
            of.get(k)
                .map(|&word| (format!("{word:08x}"), f32::from_bits(word)))
        };
        differing.push(format!(
            "{what}: word {k}: {:?}, flushed {:?}",
            word(plain),
            word(flushed)
        ));
    }
}

/// Refits and queries of [`SCENES`] scenes.
fn check<N, const W: usize, const ROWS: usize>(
    queries: impl Fn(&Bvh<N, (), W>, &mut Random, &[f32], &mut Differing),
) where
    N: Node<W>,
    N::Light: scenes::Any,
{
    let mut failed = 0;
    let scenes = std::env::var("SCENES").map_or(SCENES, |s| s.parse().expect("a number"));
    for seed in 0..scenes {
        let random = &mut Random::new(seed);
        let (bvh, sizes) = scenes::scene::<N, W>(random);
        let mut differing = Differing::new();
        let [plain, flushed] = in_both(|| refitted::<N, W, ROWS>(&bvh));
        // What the passes compute is what the tree holds.
        let held = [bvh.nodes(), bvh.top_nodes()].concat();
        assert_eq!(plain, (words(&held), words(bvh.roots())), "scene {seed}");
        note(&mut differing, "roots", &[plain.1, flushed.1]);
        note(&mut differing, "nodes", &[plain.0, flushed.0]);
        for _ in 0..8 {
            queries(&bvh, random, &sizes, &mut differing);
        }
        failed += usize::from(!differing.is_empty());
        for what in &differing {
            println!("{} of {}, scene {seed}: {what}", N::NAME, N::Light::NAME);
        }
    }
    assert_eq!(failed, 0, "scenes of {} of {}", N::NAME, N::Light::NAME);
}

/// One query of importance `I`.
fn ask<N, I, P, const W: usize>(
    bvh: &Bvh<N, (), W>,
    receiver: &P,
    at: &ShadingPoint,
    random: &mut Random,
    differing: &mut Differing,
) where
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver + core::fmt::Debug,
{
    let numbers = [0; 4].map(|_| random.bits());
    let both = in_both(|| answers::<N, I, P, W>(bvh, receiver, at, numbers));
    note(
        differing,
        &format!("{} for {receiver:?}", core::any::type_name::<I>()),
        &both,
    );
}

/// Queries of a list of importances that take points.
macro_rules! points {
    ($node:ty, $width:literal, $($importance:ty),+) => {
        |bvh: &Bvh<$node, (), $width>, random: &mut Random, sizes: &[f32], differing: &mut Differing| {
            $(
                let point = scenes::point(random, sizes);
                ask::<$node, $importance, ShadingPoint, $width>(bvh, &point, &point, random, differing);
            )+
        }
    };
}

/// A receiver at `point` that mirrors somewhere.
fn glossy(random: &mut Random, point: ShadingPoint) -> GlossyPoint {
    let receiver = GlossyPoint {
        point,
        mirror: scenes::normal(random),
        diffuse: 0.5,
        specular: 0.3,
        exponent: exact::pow2(random.below(17) as i32),
    };
    receiver.checked().expect("a receiver in the domain")
}

#[test]
fn triangles_by_moments() {
    check::<MomentNode<8>, 8, PLAIN_ROWS>(|bvh, random, sizes, differing| {
        points!(MomentNode<8>, 8, DefaultImportance, FluxOverDistance, Flux)(bvh, random, sizes, differing);
        let point = scenes::point(random, sizes);
        ask::<_, Glossy<Moments>, _, 8>(bvh, &glossy(random, point), &point, random, differing);
        let receiver = TransmissivePoint {
            point,
            front: 0.5,
            back: random.between(0.1, 1.0),
        };
        ask::<_, Defensive<Transmissive<Moments>, 6>, _, 8>(bvh, &receiver, &point, random, differing);
        let to = scenes::point(random, sizes).p;
        let receiver = RaySegment { from: point.p, to };
        ask::<_, Defensive<Subtended<Moments>, 6>, _, 8>(bvh, &receiver, &point, random, differing);
    });
}

#[test]
fn triangles_by_other_layouts_of_moments() {
    check::<TwoSidedMomentNode<8>, 8, PLAIN_ROWS>(points!(TwoSidedMomentNode<8>, 8, Moments));
}

#[test]
fn triangles_by_bounds() {
    check::<CompactNode<4>, 4, PLAIN_ROWS>(|bvh, random, sizes, differing| {
        points!(CompactNode<4>, 4, Eq4, Pbrt, Falcor, FluxOverDistance)(bvh, random, sizes, differing);
        let (from, to) = (scenes::point(random, sizes), scenes::point(random, sizes));
        let receiver = RaySegment {
            from: from.p,
            to: to.p,
        };
        ask::<_, Subtended<Eq4>, _, 4>(bvh, &receiver, &from, random, differing);
        ask::<_, Glossy<Eq4>, _, 4>(bvh, &glossy(random, from), &from, random, differing);
    });
}

#[test]
fn lights_of_every_kind() {
    type Beams = Lit<SpotMomentNode<8>, AnyLight>;
    check::<Beams, 8, LIMITED_ROWS>(points!(Beams, 8, DefaultImportance));
    type Plain = Lit<MomentNode<8>, AnyLight>;
    check::<Plain, 8, PLAIN_ROWS>(points!(Plain, 8, DefaultImportance));
    type Bounds = Lit<CompactNode<4>, AnyLight>;
    check::<Bounds, 4, PLAIN_ROWS>(points!(Bounds, 4, Eq4, Falcor));
}

/// A query of a tree with masks.
fn ask_masked<N: MomentLayout<8>>(
    bvh: &Bvh<N, (), 8>,
    random: &mut Random,
    sizes: &[f32],
    differing: &mut Differing,
) {
    let point = scenes::point(random, sizes);
    let mask = 1 + random.below(15);
    ask::<_, Linked<Leveled<Moments, 9>>, _, 8>(bvh, &LinkedPoint { point, mask }, &point, random, differing);
}

#[test]
fn lights_with_masks() {
    check::<Lit<LinkedMomentNode<8>, LinkedTriangle>, 8, LIMITED_ROWS>(ask_masked);
    check::<Lit<LinkedSpotMomentNode<8>, LinkedAny>, 8, LIMITED_ROWS>(ask_masked);
}

/// Moments themselves, of sets nearer to each other and smaller than lights of the domain are.
#[test]
fn merges() {
    let random = &mut Random::new(1);
    let length = |random: &mut Random| match random.below(4) {
        0 => 0.0,
        1 => log_uniform(random, -120, -60),
        _ => log_uniform(random, -110, -95),
    };
    for round in 0..20_000 {
        let place = |random: &mut Random| [length(random), -length(random)][random.below(2) as usize];
        let near = [0; 3].map(|_| place(random));
        let sets = [0; 8].map(|_| {
            let c = near.map(|x| match random.below(3) {
                0 => x,
                // A few units of the last place away.
                1 if x != 0.0 => f32::from_bits(x.to_bits() ^ random.below(4)),
                _ => place(random),
            });
            let direction = Vec3::from(random.direction());
            LightMoments {
                phi: random.below(4) as f32 * log_uniform(random, -30, 10),
                c: Vec3::from(c),
                across: length(random),
                along: length(random),
                m: direction * random.unit(),
                h: Vec3::new(length(random), length(random), length(random)),
            }
        });
        let [plain, flushed] = in_both(|| LightMoments::merge(&sets).to_words().map(f32::to_bits));
        assert_eq!(plain, flushed, "round {round}: {sets:?}");
    }
}
