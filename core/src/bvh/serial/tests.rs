//! What is read goes on as what was written; what was not written is refused.

extern crate std;

mod edits;
mod hostile;

use self::edits::{Random, lights, points};
use super::ReadError;
use super::header::layout;
use crate::build::BuildParams;
use crate::bvh::{Bvh, RebuildParams};
use crate::importance::{Eq4, ImportanceModel, Moments};
use crate::node::{CompactNode, FullMomentNode, FullNode, LeanMomentNode, LightNode, MomentNode, Node};
use crate::tree::INVALID;

/// Samples and pmfs of both.
fn alike<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(a: &Bvh<N, I, W>, b: &Bvh<N, I, W>) {
    assert_eq!(a.validate(), b.validate());
    assert_eq!((a.depth(), a.light_end()), (b.depth(), b.light_end()));
    assert_eq!(a.removed_lights(), b.removed_lights());
    for (i, point) in (0..).zip(points()) {
        let random: u32 = crate::exact::hash(i);
        let [x, y] = [a.sample(&point, random), b.sample(&point, random)];
        assert_eq!(
            (x.light, x.instance, x.pmf.to_bits()),
            (y.light, y.instance, y.pmf.to_bits())
        );
        let [x, y] = [a, b].map(|bvh| bvh.pmf(&point, y.light, y.instance).to_bits());
        assert_eq!(x, y);
    }
    // All that later edits depend on; the nodes' words are those of a refit, as `validate` finds.
    assert!(a.to_words() == b.to_words());
}

fn read<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>) -> Bvh<N, I, W> {
    Bvh::from_words(&bvh.to_words()).unwrap_or_else(|error| panic!("{error}"))
}

/// Random edits, refits and rebuilds of a BVH, read again now and then, by the side of one that never is.
fn goes_on<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(seed: u32, params: BuildParams) {
    let random = &mut Random(seed);
    let mut first = Bvh::<N, I, W>::new(params);
    let mut again = read(&first);
    for frame in 0..40 {
        let edits = edits::batch(random, &first);
        let renamed = edits
            .iter()
            .map(|edit| edits::renamed(edit, &first, &again))
            .collect();
        assert_eq!(first.apply(edits).is_ok(), again.apply(renamed).is_ok());
        let is_read = random.below(4) == 0;
        if is_read {
            // Not refitted yet: what is read is.
            again = read(&again);
        }
        if random.below(6) == 0 {
            assert_eq!(first.take_removed_lights(), again.take_removed_lights());
        }
        first.refit();
        again.refit();
        if is_read {
            // Changes are counted by refits.
            for number in 0..first.top.nodes.len() {
                let changes = first.top.changes[number];
                again.top.changes[number] = changes;
                let at = |has: bool| if has { again.epoch } else { 0 };
                again.top.moved[number] = at(first.top.moved[number] > 0);
                again.top.seen[number] = at(first.top.seen[number] > first.top.tried[number]);
                again.top.tried[number] = 0;
            }
        }
        alike(&first, &again);
        if random.below(2) == 0 {
            again = read(&again);
            alike(&first, &again);
        }
        if random.below(3) == 0 {
            let params = RebuildParams {
                top: if random.below(3) > 0 { 1.0 } else { f64::INFINITY },
                drift: 1.01,
            };
            for bvh in [&mut first, &mut again] {
                let rebuilt = bvh.rebuild(&params).run();
                bvh.install(rebuilt).expect("its own");
            }
        }
        if frame == 20 {
            assert_ne!(first.light_count(), 0);
        }
    }
}

/// What was read goes on as what was written, each with a rebuilder that begins there: at rest, and in motion. Few and many
/// instances changed in the frames before.
#[cfg(feature = "std")]
#[test]
fn rebuilders_go_on_alike() {
    use crate::bvh::{RebuilderParams, Swap};
    use crate::exact::{hash, unit_f32};
    use crate::{Edit, LightBvh, Rebuilder, Transform};

    let draw = |a: u32, b: u32| unit_f32(hash(hash(a) ^ b));
    let at = |i: u32, frame: u32| {
        let moved = |k: u32| draw(i, k) * 100.0 + draw(i, 10 * frame + k);
        Transform::at([moved(1), 0.05 * moved(2), moved(3)])
    };
    let mut swapped = 0;
    for (count, moves, eager, moves_on) in [
        (3000, 60, false, false),
        (3000, 60, true, false),
        (3000, 150, false, true),
        (600, 12, false, false),
        (600, 12, true, true),
    ] {
        let mut first = LightBvh::default();
        let mesh = first
            .add_mesh(std::vec![crate::kit::line(0, 1.0)])
            .expect("a mesh");
        let add = |i: u32| Edit::AddInstance {
            mesh,
            transform: at(i, 0),
            radiance: 1.0,
        };
        first.apply((0..count).map(add).collect()).expect("instances");
        first.refit();
        let step = |bvh: &mut LightBvh, frame: u32| {
            let moved = (0..moves).map(|k| {
                let i = hash(frame * moves + k) % count;
                let instance = bvh.instance_id(i).expect("there");
                Edit::SetTransform {
                    instance,
                    transform: at(i, frame),
                }
            });
            bvh.apply(moved.collect()).expect("moved");
            bvh.refit();
        };
        for frame in 1..8 {
            step(&mut first, frame);
        }
        let mut again = read(&first);
        let rebuild = match eager {
            true => RebuildParams::eager(),
            false => RebuildParams::default(),
        };
        let params = RebuilderParams {
            swap: Swap::Deterministic,
            rebuild,
            ..RebuilderParams::default()
        };
        let mut rebuilders = [Rebuilder::new(params), Rebuilder::new(params)];
        for frame in 8..60 {
            for (bvh, rebuilder) in [&mut first, &mut again].into_iter().zip(&mut rebuilders) {
                let start = rebuilder.begin_frame(bvh).expect("no panic");
                swapped += u32::from(start.swapped);
                if moves_on {
                    step(bvh, frame);
                } else {
                    bvh.refit();
                }
                rebuilder.end_frame(bvh);
            }
            if frame % 4 == 0 {
                assert!(
                    first.to_words() == again.to_words(),
                    "{count} {moves} {eager} in frame {frame}"
                );
            }
        }
    }
    assert!(swapped > 20, "{swapped}: little is tested");
}

/// One of each level, refitted by new triangles after it was read.
fn follows<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(params: BuildParams) {
    for single in [false, true] {
        let build = |lights: &_| {
            if single {
                Bvh::<N, I, W>::single_level(lights, &params)
            } else {
                Bvh::two_level(lights, &params)
            }
        };
        let mut first = build(&lights(1, 200));
        let mut again = read(&first);
        assert_eq!(again.is_single_level(), single);
        for _ in 0..2 {
            alike(&first, &again);
            for bvh in [&mut first, &mut again] {
                bvh.follow(&lights(2, 200)).expect("as many");
            }
        }
    }
}

#[test]
fn trees_of_all_layouts_go_on() {
    for (seed, params) in (0..).zip([
        BuildParams::BALANCED,
        BuildParams::BEST,
        BuildParams::FAST,
        BuildParams::paper(crate::Heuristic::Saoh),
    ]) {
        goes_on::<MomentNode<8>, Moments, 8>(seed, params);
        goes_on::<CompactNode<4>, Eq4, 4>(10 + seed, params);
    }
    goes_on::<MomentNode<16>, Moments, 16>(20, BuildParams::BALANCED);
    goes_on::<LeanMomentNode<8>, Moments, 8>(21, BuildParams::BALANCED);
    goes_on::<FullMomentNode<8>, Moments, 8>(22, BuildParams::BALANCED);
    goes_on::<FullNode<2>, Eq4, 2>(23, BuildParams::BALANCED);
}

#[test]
fn lights_that_stand_in_the_world_are_followed() {
    let params = BuildParams::BALANCED;
    follows::<MomentNode<8>, Moments, 8>(params);
    follows::<MomentNode<16>, Moments, 16>(params);
    follows::<LeanMomentNode<8>, Moments, 8>(params);
    follows::<FullMomentNode<8>, Moments, 8>(params);
    follows::<CompactNode<4>, Eq4, 4>(params);
    follows::<FullNode<4>, Eq4, 4>(params);
}

/// Trees deep enough for two words of trail, and large enough for several threads.
#[test]
fn deep_trees_are_read() {
    let params = BuildParams {
        buckets: 2,
        ..BuildParams::paper(crate::Heuristic::Sah)
    };
    let bvh = Bvh::<CompactNode<2>, Eq4, 2>::single_level(&edits::shrinking(90), &params);
    assert_eq!(bvh.tree().trail_words, 2);
    alike(&bvh, &read(&bvh));
    let bvh = Bvh::<CompactNode<2>, Eq4, 2>::two_level(&lights(3, 5000), &BuildParams::FAST);
    alike(&bvh, &read(&bvh));
}

#[test]
fn ids_are_given_by_index() {
    let bvh = Bvh::<MomentNode<8>, Moments, 8>::two_level(&lights(1, 20), &BuildParams::BALANCED);
    let again = read(&bvh);
    let (old, new) = (
        bvh.instance_id(0).expect("one"),
        again.instance_id(0).expect("one"),
    );
    assert_ne!(old, new);
    assert_eq!(
        (again.lights_of(old), again.lights_of(new)),
        (None, bvh.lights_of(old))
    );
    let (old, new) = (bvh.mesh_id(1).expect("two"), again.mesh_id(1).expect("two"));
    assert_eq!((old.index(), new.index()), (1, 1));
    assert_ne!(old, new);
    assert_eq!((again.mesh_id(99), again.instance_id(INVALID)), (None, None));
}

#[test]
fn another_type_is_refused() {
    let words = Bvh::<MomentNode<8>, Moments, 8>::default().to_words();
    let lean = Bvh::<LeanMomentNode<8>, Moments, 8>::from_words(&words);
    assert_eq!(
        lean.err(),
        Some(ReadError::Layout {
            expected: "lean moments",
            lights: "emissive triangle",
        })
    );
    let wide = Bvh::<MomentNode<16>, Moments, 16>::from_words(&words);
    assert_eq!(
        wide.err(),
        Some(ReadError::Width {
            expected: 16,
            found: 8
        })
    );
    let mut names = [
        <MomentNode<8> as Node<8>>::NAME,
        <LeanMomentNode<8> as Node<8>>::NAME,
        <FullMomentNode<8> as Node<8>>::NAME,
        <CompactNode<4> as Node<4>>::NAME,
        <FullNode<4> as Node<4>>::NAME,
    ]
    .map(layout);
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
}

/// The words per light, as `docs/format.md` has them.
#[test]
fn words_are_fewer_than_those_of_the_arrays() {
    let bvh = Bvh::<MomentNode<8>, Moments, 8>::single_level(&lights(1, 4000), &BuildParams::BALANCED);
    let arrays = bvh.bytes() + size_of_val(bvh.triangles()) + size_of_val(bvh.roots());
    let words = bvh.to_words();
    std::println!("{} words, {} in the arrays", words.len(), arrays / 4);
    assert!(words.len() * 10 < arrays / 4 * 7);
}
