//! What is read goes on as what was written; what was not written is refused.

extern crate std;

mod hostile;

use crate::model::Model;
use std::string::ToString;

use crate::build::BuildParams;
use crate::bvh::{Bvh, EditReason, RebuilderParams, Swap, follow};
use crate::exact::pow2;
use crate::importance::{Eq4, ImportanceModel, Moments};
use crate::kit::Random;
use crate::kit::scenes::{edits, lamps, sound, sound_samples};
use crate::node::{CompactNode, MomentNode, TwoSidedMomentNode};
use crate::tree::INVALID;
use crate::{EmissiveTriangle, Lights, Rebuilder};

/// Lights of several mesh lights.
fn lights(seed: u32, count: u32) -> Lights {
    let mut lights: std::vec::Vec<EmissiveTriangle> = lamps(&mut Random(seed), count);
    (0..)
        .zip(&mut lights)
        .for_each(|(k, own)| own.mesh = k * 7 / count);
    Lights::new(lights).expect("within the domain")
}

/// Samples with pmfs, and all that later edits depend on; the nodes' words are those of a refit, as `validate` finds.
fn alike<M: Model<W, Light = EmissiveTriangle>, const W: usize>(a: &Bvh<M, W>, b: &Bvh<M, W>)
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    let of = |bvh: &Bvh<_, W>| {
        let view = bvh.view();
        (
            view.validate(),
            view.depth(),
            view.light_end(),
            view.removed_lights().to_vec(),
        )
    };
    assert_eq!(of(a), of(b));
    assert_eq!(sound_samples(a), sound_samples(b));
    assert!(a.to_words() == b.to_words());
}

fn read<M: Model<W, Light = EmissiveTriangle>, const W: usize>(bvh: &Bvh<M, W>) -> Bvh<M, W> {
    Bvh::from_words(&bvh.to_words()).unwrap_or_else(|error| panic!("{error}"))
}

/// Random edits of a BVH and of one that was read from its words, each with a rebuilder, while meshes are changed, built and
/// waiting.
fn goes_on<M: Model<W, Light = EmissiveTriangle>, const W: usize>(seed: u32, params: BuildParams)
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    let random = &mut Random(seed);
    let rebuilder = || {
        Rebuilder::new(RebuilderParams {
            after: 2,
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        })
    };
    let mut first = Bvh::<M, W>::new(params);
    let mut again = read(&first);
    let mut rebuilders = [rebuilder(), rebuilder()];
    let mut swapped = 0;
    for frame in 0..60 {
        let (at, count) = (random.clone(), 1 + random.below(12));
        let takes = random.below(6) == 0;
        for (bvh, rebuilder) in [&mut first, &mut again].into_iter().zip(&mut rebuilders) {
            let start = rebuilder.begin_frame(bvh).expect("no panic");
            swapped += start.meshes + u32::from(start.swapped);
            // A refused batch changes nothing.
            let _ = bvh.apply(edits(&mut at.clone(), bvh, count, 100));
            (0..u32::from(takes)).for_each(|_| _ = bvh.take_removed_lights());
        }
        if frame % 5 == 0 {
            // Not refitted yet; the one that is read is.
            sound(&read(&again));
        }
        for (bvh, rebuilder) in [&mut first, &mut again].into_iter().zip(&mut rebuilders) {
            bvh.refit();
            if frame % 7 == 6 {
                bvh.rebuild();
            }
            rebuilder.end_frame(bvh);
        }
        alike(&first, &again);
        *random = Random(seed + 100 * frame);
        if random.below(4) == 0 {
            again = read(&again);
            alike(&first, &again);
            rebuilders = [rebuilder(), rebuilder()];
        }
    }
    assert!(first.view().light_count() > 100 && swapped > 10, "{swapped}");
}

#[test]
fn trees_of_all_layouts_go_on() {
    for (seed, params) in (0..).zip([BuildParams::BALANCED, BuildParams::paper(crate::Heuristic::Saoh)]) {
        goes_on::<(MomentNode<8>, Moments), 8>(seed, params);
        goes_on::<(CompactNode<4>, Eq4), 4>(10 + seed, params);
    }
    goes_on::<(MomentNode<16>, Moments), 16>(20, BuildParams::BALANCED);
    goes_on::<(TwoSidedMomentNode<8>, Moments), 8>(21, BuildParams::BALANCED);
    goes_on::<(CompactNode<2>, Eq4), 2>(23, BuildParams::BALANCED);
}

/// Trees deep enough for two words of trail, and large enough for several threads.
#[test]
fn deep_trees_are_read() {
    let params = BuildParams {
        buckets: 2,
        ..BuildParams::paper(crate::Heuristic::Sah)
    };
    // Each at half the distance of the one before.
    let light = |k: i32| {
        let (x, size) = (pow2(38 - k), pow2((35 - k).max(-40)));
        crate::kit::triangle([[x, 0.0, 0.0], [x, size, 0.0], [x, 0.0, size]])
    };
    let lamps = Lights::new((0..90).map(light).collect()).expect("within the domain");
    let bvh = Bvh::<(CompactNode<2>, Eq4), 2>::single_level(&lamps, &params);
    assert_eq!(bvh.tree().trail_words, 2);
    alike(&bvh, &read(&bvh));
    let mut bvh = Bvh::<(CompactNode<2>, Eq4), 2>::two_level(&lights(3, 5000), &BuildParams::BALANCED);
    let mut again = read(&bvh);
    alike(&bvh, &again);
    for bvh in [&mut bvh, &mut again] {
        follow(bvh, &lights(2, 5000)).expect("as many");
    }
    alike(&bvh, &again);
}

#[test]
fn ids_are_given_by_index() {
    let bvh = Bvh::<(MomentNode<8>, Moments)>::two_level(&lights(1, 20), &BuildParams::BALANCED);
    let again = read(&bvh);
    let (old, new) = (
        bvh.view().instance_id(0).expect("one"),
        again.view().instance_id(0).expect("one"),
    );
    assert_ne!(old, new);
    assert_eq!(
        (again.view().lights_of(old), again.view().lights_of(new)),
        (None, bvh.view().lights_of(old))
    );
    let (old, new) = (
        bvh.view().mesh_id(1).expect("two"),
        again.view().mesh_id(1).expect("two"),
    );
    assert_eq!((old.index(), new.index()), (1, 1));
    assert_ne!(old, new);
    assert_eq!(
        (again.view().mesh_id(99), again.view().instance_id(INVALID)),
        (None, None)
    );
}

#[test]
fn read_bvh_follows_as_many_lights() {
    let mut bvh = read(&Bvh::<(MomentNode<8>, Moments)>::two_level(
        &lights(1, 20),
        &BuildParams::BALANCED,
    ));
    let before = bvh.to_words();
    let error = follow(&mut bvh, &lights(1, 21)).expect_err("another number");
    let (expected, found) = (2, 3);
    assert_eq!(error.mesh, 6);
    assert_eq!(error.reason, EditReason::Count { expected, found });
    assert!(bvh.to_words() == before);
    follow(&mut bvh, &lights(2, 20)).expect("as many");
    sound(&bvh);
}

#[test]
fn another_type_is_refused() {
    let words = Bvh::<(MomentNode<8>, Moments)>::default().to_words();
    let two_sided = Bvh::<(TwoSidedMomentNode<8>, Moments)>::from_words(&words);
    let error = two_sided.expect_err("another layout").to_string();
    assert!(
        error.contains("\"two-sided moments\" over lights of kind \"emissive triangle\""),
        "{error}"
    );
    let wide = Bvh::<(MomentNode<16>, Moments), 16>::from_words(&words);
    let error = wide.expect_err("another width").to_string();
    assert!(error.contains("nodes of 8 children, expected 16"), "{error}");
}
