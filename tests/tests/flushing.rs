//! No subnormal number comes up in a tree: the processor's own flush-to-zero mode changes no word of refits, samples, pmfs and
//! points on lights. Devices that flush then agree with those that do not.
#![cfg(target_arch = "x86_64")]

use bytemuck::{Pod, cast_slice};
use lightbvh::bvh::Cursor;
use lightbvh::device::point::Receiver;
use lightbvh::importance::{
    Cell, DefaultImportance, Flux, Glossy, ImportanceModel, Leveled, Linked, LinkedPoint, RaySegment,
    Subtended, Transmissive, TransmissivePoint,
};
use lightbvh::light::{AnyLight, Light};
use lightbvh::node::{
    CompactNode, LinkedSpotMomentNode, MomentNode, Node, SpotMomentNode, TwoSidedMomentNode,
};
use lightbvh::refit::{LIMITED_ROWS, PLAIN_ROWS, assembled, bottom_child, top_child};
use lightbvh::{Bvh, Defensive, Eq4, FluxOverDistance, GlossyPoint, Moments, Random64, ShadingPoint, exact};
use lightbvh_peers::{Falcor, Pbrt};
use lightbvh_tests::generate::Random;
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

/// Refits all nodes child by child, in the order of the passes.
#[inline(never)]
fn refitted<N: Node<W>, const W: usize, const ROWS: usize>(bvh: &Bvh<(N, ()), W>) -> Vec<u32> {
    let (plan, view) = (Cursor::default().plan(bvh), bvh.view());
    let (triangles, instances) = (view.lights(), view.instances());
    let mut nodes = [view.nodes(), view.top_nodes()].concat();
    let first = view.nodes().len() as u32;
    let mut children = [[[0; W]; ROWS]];
    for &index in plan.bottom.nodes() {
        for slot in 0..W {
            bottom_child::<N, W>(&nodes, triangles, index, slot).put(&mut children, 0, slot);
        }
        nodes[index as usize] = assembled(&nodes, index, &children, 0);
    }
    for &index in plan.top.nodes() {
        let index = first + index;
        for slot in 0..W {
            top_child::<N, W>(&nodes, first, triangles, instances, index, slot).put(&mut children, 0, slot);
        }
        nodes[index as usize] = assembled(&nodes, index, &children, 0);
    }
    words(&nodes)
}

/// What a query answers: the sample, the pmf of another light, the light itself, a point on it, what that sends.
#[inline(never)]
fn answers<N, I, P, const W: usize>(
    bvh: &Bvh<(N, ()), W>,
    receiver: &P,
    at: &ShadingPoint,
    numbers: [u32; 4],
) -> Vec<u32>
where
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver,
{
    let tree = bvh.tree().by::<I>();
    let [high, low, third, fourth] = numbers;
    let sample = tree.sample(receiver, Random64 { high, low });
    let mut all = words(&[sample]);
    if let Some(id) = bvh.view().instances().len().checked_sub(1) {
        let instance = third % (id as u32 + 1);
        let of = &bvh.view().instances()[instance as usize];
        all.push(
            tree.pmf(receiver, of.first + fourth % of.count.max(1), instance)
                .to_bits(),
        );
    }
    if let Some(light) = bvh.view().light(sample.light, sample.instance) {
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

#[track_caller]
fn same(what: &str, [plain, flushed]: &[Vec<u32>; 2]) {
    assert_eq!(plain.len(), flushed.len(), "{what}");
    for (k, (plain, flushed)) in plain.iter().zip(flushed).enumerate() {
        assert_eq!(plain, flushed, "{what}: word {k}, {:e}", f32::from_bits(*plain));
    }
}

/// Refits and queries of [`SCENES`] scenes.
fn check<N, const W: usize, const ROWS: usize>(queries: impl Fn(&Bvh<(N, ()), W>, &mut Random, &[f32]))
where
    N: Node<W>,
    N::Light: scenes::Any,
{
    let scenes = std::env::var("SCENES").map_or(SCENES, |s| s.parse().expect("a number"));
    for seed in 0..scenes {
        let random = &mut Random::new(seed);
        let (bvh, sizes) = scenes::scene::<N, W>(random);
        let [plain, flushed] = in_both(|| refitted::<N, W, ROWS>(&bvh));
        // What the passes compute is what the tree holds.
        let held = [bvh.view().nodes(), bvh.view().top_nodes()].concat();
        assert_eq!(plain, words(&held), "scene {seed}");
        same("nodes", &[plain, flushed]);
        for _ in 0..8 {
            queries(&bvh, random, &sizes);
        }
    }
}

/// One query of importance `I`.
fn ask<N, I, P, const W: usize>(bvh: &Bvh<(N, ()), W>, receiver: &P, at: &ShadingPoint, random: &mut Random)
where
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver + core::fmt::Debug,
{
    let numbers = [0; 4].map(|_| random.bits());
    let both = in_both(|| answers::<N, I, P, W>(bvh, receiver, at, numbers));
    same(
        &format!("{} for {receiver:?}", core::any::type_name::<I>()),
        &both,
    );
}

/// Queries of a list of importances that take points.
macro_rules! points {
    ($node:ty, $width:literal, $($importance:ty),+) => {
        |bvh: &Bvh<($node, ()), $width>, random: &mut Random, sizes: &[f32]| {
            $(
                let point = scenes::point(random, sizes);
                ask::<$node, $importance, ShadingPoint, $width>(bvh, &point, &point, random);
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
    check::<MomentNode<8>, 8, PLAIN_ROWS>(|bvh, random, sizes| {
        points!(MomentNode<8>, 8, DefaultImportance, FluxOverDistance, Flux)(bvh, random, sizes);
        let point = scenes::point(random, sizes);
        ask::<_, Glossy<Moments>, _, 8>(bvh, &glossy(random, point), &point, random);
        let receiver = TransmissivePoint {
            point,
            front: 0.5,
            back: random.between(0.1, 1.0),
        };
        ask::<_, Defensive<Transmissive<Moments>, 6>, _, 8>(bvh, &receiver, &point, random);
        let to = scenes::point(random, sizes).p;
        let receiver = RaySegment { from: point.p, to };
        ask::<_, Defensive<Subtended, 6>, _, 8>(bvh, &receiver, &point, random);
        let cell = Cell {
            n: point.n.map(|x| x * random.between(0.0, 1.0)),
            ..Cell::volume(point.p, to)
        };
        let cell = cell.checked().expect("a receiver in the domain");
        ask::<_, DefaultImportance, _, 8>(bvh, &cell, &point, random);
    });
}

#[test]
fn triangles_by_other_layouts_of_moments() {
    check::<TwoSidedMomentNode<8>, 8, PLAIN_ROWS>(points!(TwoSidedMomentNode<8>, 8, Moments));
}

#[test]
fn triangles_by_bounds() {
    check::<CompactNode<4>, 4, PLAIN_ROWS>(|bvh, random, sizes| {
        points!(CompactNode<4>, 4, Eq4, Pbrt, Falcor, FluxOverDistance)(bvh, random, sizes);
        let point = scenes::point(random, sizes);
        ask::<_, Glossy<Eq4>, _, 4>(bvh, &glossy(random, point), &point, random);
    });
}

#[test]
fn lights_of_every_kind() {
    type Beams = SpotMomentNode<8, AnyLight>;
    check::<Beams, 8, LIMITED_ROWS>(points!(Beams, 8, DefaultImportance));
    type Plain = MomentNode<8, AnyLight>;
    check::<Plain, 8, PLAIN_ROWS>(points!(Plain, 8, DefaultImportance));
    type Bounds = CompactNode<4, AnyLight>;
    check::<Bounds, 4, PLAIN_ROWS>(points!(Bounds, 4, Eq4, Falcor));
}

#[test]
fn lights_with_masks() {
    type Masked = LinkedSpotMomentNode<8, AnyLight>;
    check::<Masked, 8, LIMITED_ROWS>(|bvh, random, sizes| {
        let point = scenes::point(random, sizes);
        let mask = 1 + random.below(15);
        ask::<_, Linked<Leveled<Moments, 9>>, _, 8>(bvh, &LinkedPoint { point, mask }, &point, random);
    });
}
