extern crate std;

use alloc::vec::Vec;

use super::{REST, Search};
use crate::bvh::top::rebuild::PART;
use crate::bvh::{Edit, InstanceId, RebuildParams, Swap};
use crate::kit::Random;
use crate::node::{Node, kind};
use crate::{EmissiveTriangle, LightBvh, Rebuilder, RebuilderParams, ShadingPoint, Transform};

mod motion;

/// 2000 small lamps over 100 x 4 x 100 m, and where they are.
pub(in crate::bvh::top) fn lamps(
    random: &mut Random,
    radiance: impl Fn(usize) -> f32,
) -> (LightBvh, Vec<InstanceId>, Vec<[f32; 3]>) {
    let mut scene = LightBvh::default();
    let lamp = EmissiveTriangle {
        p: [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mesh = scene.add_mesh(alloc::vec![lamp]).expect("a lamp");
    let place = |_| {
        let at = random.vector() * 100.0;
        [at.x, 0.04 * at.y, at.z]
    };
    let places: Vec<_> = (0..2000).map(place).collect();
    let add = places.iter().enumerate().map(|(k, &at)| Edit::AddInstance {
        mesh,
        transform: Transform::at(at),
        radiance: radiance(k),
    });
    let ids = scene.apply(add.collect()).expect("instances").instances;
    scene.refit();
    (scene, ids, places)
}

/// A frame: `edits`, and whether something that was built came in.
fn frame(scene: &mut LightBvh, rebuilder: &mut Rebuilder, edits: Vec<Edit>) -> bool {
    let start = rebuilder.begin_frame(scene).expect("no panic");
    scene.apply(edits).expect("edits");
    scene.refit();
    rebuilder.end_frame(scene);
    start.swapped
}

fn deterministic() -> Rebuilder {
    Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    })
}

/// Second moment of irradiance over the square of its mean, at some points below, over all lamps.
fn second_moment(scene: &LightBvh, points: &[[f32; 3]]) -> f64 {
    let of_point = |&p: &[f32; 3]| {
        let point = ShadingPoint {
            p,
            n: [0.0, 1.0, 0.0],
        };
        let (mut mean, mut square) = (0.0, 0.0);
        for index in 0..scene.instances().len() as u32 {
            let Some(id) = scene.instance_id(index) else {
                continue;
            };
            let light = scene.lights_of(id).expect("an instance").start;
            let lamp = scene.triangle(light, index).expect("a light");
            let to: [f64; 3] = core::array::from_fn(|k| f64::from(lamp.p[0][k]) - f64::from(p[k]));
            let squared: f64 = to.iter().map(|x| x * x).sum();
            let flux = f64::from(lamp.radiance[0]) * to[1] * to[1] / (squared * squared);
            let pmf = f64::from(scene.pmf(&point, light, index));
            mean += flux;
            square += flux * flux / pmf;
        }
        (square / (mean * mean)).ln()
    };
    (points.iter().map(of_point).sum::<f64>() / points.len() as f64).exp()
}

/// Lamps that are 1000 times as bright as the others leave them. What is lost is measured by flux, which is theirs; points
/// among those that stayed get most of their light from these. They get a tree once all is at rest.
#[test]
fn dim_lamps_that_bright_ones_left_get_a_tree() {
    for seed in [1, 2, 3, 4, 5, 6, 7, 8] {
        let random = &mut Random(seed);
        let (mut scene, ids, mut places) = lamps(random, |k| if k % 4 == 3 { 1000.0 } else { 1.0 });
        let mut rebuilder = deterministic();
        for _ in 0..60 {
            let mut edits = Vec::new();
            for (&instance, at) in ids.iter().zip(&mut places).skip(3).step_by(4) {
                at[0] += 5.0;
                edits.push(Edit::SetTransform {
                    instance,
                    transform: Transform::at(*at),
                });
            }
            frame(&mut scene, &mut rebuilder, edits);
        }
        for _ in 0..40 {
            frame(&mut scene, &mut rebuilder, Vec::new());
        }
        let mut new = scene.clone();
        let built = new.rebuild(&RebuildParams::eager()).run();
        new.install(built).expect("its own");
        new.refit();
        let points: Vec<_> = (0..8)
            .map(|_| (random.vector() * 100.0).to_array())
            .map(|[x, y, z]| [x, -1.0 - 0.03 * y, z])
            .collect();
        let [found, least] = [&scene, &new].map(|scene| second_moment(scene, &points));
        assert!(found < 1.4 * least, "seed {seed}: {found} of {least}");
    }
}

/// Where everything moves as one nothing is lost, and nothing is built. At rest each node is tried once; then the rebuilder is
/// at rest too.
#[test]
fn what_came_to_rest_is_tried_once() {
    let (mut scene, ids, places) = lamps(&mut Random(1), |_| 1.0);
    let mut rebuilder = deterministic();
    let moved = |by: f32| {
        let edit = |(&instance, at): (&InstanceId, &[f32; 3])| Edit::SetTransform {
            instance,
            transform: Transform::at([at[0] + by, at[1], at[2]]),
        };
        ids.iter().zip(&places).map(edit).collect()
    };
    for k in 0..2 * REST {
        assert!(!frame(&mut scene, &mut rebuilder, moved(k as f32)), "frame {k}");
    }
    let mut tried = 0;
    for k in 0..100 {
        let was_busy = rebuilder.is_busy();
        let came = frame(&mut scene, &mut rebuilder, Vec::new());
        tried += u32::from(rebuilder.is_busy() && (came || !was_busy));
        assert!(k >= REST - 2 || tried == 0, "frame {k}");
    }
    assert!((1..=8).contains(&tried) && !rebuilder.is_busy(), "{tried}");
    // One lamp that flickers is nothing to build for.
    for k in 0..100 {
        let edits = match k % (2 * REST) {
            0 => alloc::vec![Edit::SetRadiance {
                instance: ids[0],
                radiance: 1.0 + k as f32 / 400.0,
            }],
            _ => Vec::new(),
        };
        frame(&mut scene, &mut rebuilder, edits);
        assert!(!rebuilder.is_busy(), "frame {k}");
    }
}

/// What a scene that was written still has to try is tried after it was read.
#[test]
fn a_scene_that_was_read_is_mended_too() {
    let (mut scene, ids, places) = lamps(&mut Random(1), |_| 1.0);
    let mut rebuilder = deterministic();
    for by in [1.0, 2.0] {
        let edit = |(&instance, at): (&InstanceId, &[f32; 3])| Edit::SetTransform {
            instance,
            transform: Transform::at([at[0] + by, at[1], at[2]]),
        };
        frame(
            &mut scene,
            &mut rebuilder,
            ids.iter().zip(&places).map(edit).collect(),
        );
    }
    let mut read = LightBvh::from_words(&scene.to_words()).expect("its own");
    let mut rebuilder = deterministic();
    let mut tried = 0;
    for _ in 0..100 {
        frame(&mut read, &mut rebuilder, Vec::new());
        tried += u32::from(rebuilder.is_busy());
    }
    assert!(tried > 0 && !rebuilder.is_busy(), "{tried}");
}

/// What is taken away is a change as well: bright lamps among dim ones that were shuffled since.
#[test]
fn what_bright_ones_left_by_going_gets_a_tree() {
    let random = &mut Random(3);
    let (mut scene, ids, _) = lamps(random, |k| if k % 4 == 3 { 1000.0 } else { 1.0 });
    let mut rebuilder = deterministic();
    let shuffle = ids.iter().enumerate().filter(|(k, _)| k % 4 != 3);
    let shuffle = shuffle.map(|(_, &instance)| {
        let at = random.vector() * 100.0;
        Edit::SetTransform {
            instance,
            transform: Transform::at([at.x, 0.04 * at.y, at.z]),
        }
    });
    frame(&mut scene, &mut rebuilder, shuffle.collect());
    for _ in 0..40 {
        frame(&mut scene, &mut rebuilder, Vec::new());
    }
    assert!(!rebuilder.is_busy());
    let gone = ids.iter().skip(3).step_by(4).map(|&id| Edit::RemoveInstance(id));
    frame(&mut scene, &mut rebuilder, gone.collect());
    let mut tried = 0;
    for _ in 0..60 {
        frame(&mut scene, &mut rebuilder, Vec::new());
        tried += u32::from(rebuilder.is_busy());
    }
    assert!(tried > 0 && !rebuilder.is_busy(), "{tried}");
}

/// After a scene was read, what comes to rest is tried once as in any other.
#[test]
fn a_scene_that_was_read_comes_to_rest() {
    let (scene, ..) = lamps(&mut Random(1), |_| 1.0);
    let mut read = LightBvh::from_words(&scene.to_words()).expect("its own");
    let mut rebuilder = deterministic();
    for k in 0..20 {
        let instance = read.instance_id(0).expect("there");
        let transform = Transform::at([k as f32, 1.0, 0.0]);
        frame(
            &mut read,
            &mut rebuilder,
            alloc::vec![Edit::SetTransform { instance, transform }],
        );
    }
    let mut swaps = 0;
    for k in 0..200 {
        let swapped = frame(&mut read, &mut rebuilder, Vec::new());
        swaps += u32::from(swapped && k >= 100);
    }
    assert_eq!(swaps, 0);
}

/// The root, above parts, and a part.
pub(in crate::bvh::top) fn above_and_part(scene: &LightBvh) -> [u32; 2] {
    let mut part = scene.top.root;
    while scene.top.counts[scene.top.number(part) as usize] > PART {
        let own = &scene.nodes[part as usize];
        let slots = (0..8).filter(|&slot| own.kind(slot) == kind::INNER);
        part = slots
            .map(|slot| own.link(slot))
            .max_by_key(|&child| scene.top.counts[scene.top.number(child) as usize])
            .expect("a node below");
    }
    [scene.top.root, part]
}

/// A node is tried at rest once one in eight of its instances changed; above parts it then comes in whatever it costs, a part
/// where it costs no more than what is there. Before it rests it is not.
#[test]
fn one_in_eight_that_changed_is_tried_at_rest() {
    let (mut scene, ..) = lamps(&mut Random(1), |_| 1.0);
    let now = scene.now();
    for (node, pays) in above_and_part(&scene).into_iter().zip([f64::INFINITY, 1.0]) {
        let number = scene.top.number(node) as usize;
        let least = scene.top.counts[number].div_ceil(8);
        for (changes, frames, is_tried) in [
            (least - 1, REST, false),
            (least, REST - 2, false),
            (least, REST, true),
        ] {
            (scene.top.changes[number], scene.top.moved[number]) = (changes, now.epoch);
            scene.top.tried[number] = now.epoch - 1;
            let mut search = Search::default();
            for _ in 0..frames {
                search.note_frame(now);
            }
            let mut found = Vec::new();
            while !search.is_done() && found.is_empty() {
                found = scene.copy_worn_parts(1.1, 0, &mut search);
            }
            assert_eq!(!found.is_empty(), is_tried, "{changes} after {frames}");
            assert!(
                found
                    .iter()
                    .all(|copy| copy.pays == pays && copy.root == Some(scene.part(node)))
            );
        }
        scene.top.changes[number] = 0;
    }
}
