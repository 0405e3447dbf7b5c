//! Trees that many instances follow.

extern crate std;

use std::vec::Vec;

use super::HANDED;
use crate::bvh::stage::tests::lamps;
use crate::bvh::{RebuildParams, RebuilderParams, Swap};
use crate::kit::Random;
use crate::rebuilder::Rebuilder;
use crate::{Edit, LightBvh, MeshId, MomentNode, ShadingPoint, Transform};

type Own = Rebuilder<MomentNode<8>, 8>;

const COUNT: u32 = 1500;

/// Instances of a mesh that has lost its order, the first `opened` of them so large that they are opened.
fn scene(opened: u32) -> (LightBvh, MeshId, Own) {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lamps(1)[..400].to_vec()).expect("a mesh");
    let random = &mut Random(5);
    let add = (0..COUNT).map(|k| {
        let size = if k < opened { 8.0 } else { 0.1 };
        let mut transform = Transform::at((random.vector() * 400.0).to_array());
        (0..3).for_each(|axis| transform.columns[axis][axis] = size);
        Edit::AddInstance {
            mesh,
            transform,
            radiance: if k < opened { 1.0 } else { 0.01 },
        }
    });
    let add = add.collect();
    bvh.apply(add).expect("instances");
    bvh.set_triangles(mesh, lamps(2)[..400].to_vec())
        .expect("as many");
    bvh.refit();
    assert_eq!(bvh.of_mesh(0).opened, opened);
    (bvh, mesh, rebuilder())
}

fn rebuilder() -> Own {
    Rebuilder::new(RebuilderParams {
        swap: Swap::Deterministic,
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..RebuildParams::default()
        },
        ..RebuilderParams::default()
    })
}

fn frame(bvh: &mut LightBvh, own: &mut Own, edits: Vec<Edit>) -> u32 {
    let start = own.begin_frame(bvh).expect("no panic");
    bvh.apply(edits).expect("sound edits");
    bvh.refit();
    own.end_frame(bvh);
    start.adopted
}

/// Frames until a tree is in place that instances are still to follow.
fn until_adopted(bvh: &mut LightBvh, own: &mut Own) {
    let frames = (0..200).find(|_| frame(bvh, own, Vec::new()) > 0);
    assert!(frames.is_some() && bvh.handing_over() == 1);
}

fn left(bvh: &LightBvh) -> u32 {
    bvh.of_mesh(0).outgoing.map_or(0, |outgoing| outgoing.left)
}

/// Every light has the probability by which it is drawn, and all of them have one.
fn is_sound(bvh: &LightBvh) {
    bvh.validate().expect("valid");
    let lit = ShadingPoint {
        p: [1.0, 2.0, 3.0],
        n: [0.0; 3],
    };
    let mut sum = 0.0;
    for id in (0..COUNT).filter_map(|k| bvh.instance_id(k)) {
        for light in 0..400 {
            let pmf = bvh.pmf_of(&lit, id, light).expect("a light");
            assert!(pmf > 0.0);
            sum += f64::from(pmf);
        }
    }
    assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    for k in 0..64 {
        let sampled = bvh.sample(&lit, crate::exact::hash(k));
        let again = bvh.pmf(&lit, sampled.light, sampled.instance);
        assert_eq!(sampled.pmf.to_bits(), again.to_bits());
    }
}

/// A frame writes the words of so many instances and no more, and once all follow nothing is left of the old tree.
#[test]
fn a_few_instances_follow_in_each_frame() {
    for opened in [0, 40] {
        let (mut bvh, _, mut own) = scene(opened);
        until_adopted(&mut bvh, &mut own);
        let (old, new) = (
            bvh.of_mesh(0).outgoing.expect("some are left").blas,
            bvh.meshes[0].blas,
        );
        // The frame in which much of it changed last is known of the new one too.
        let stirred = bvh.blases[old as usize].stirred;
        assert!(stirred > 0 && bvh.of_mesh(0).stirred == stirred);
        let mut frames = 0;
        while left(&bvh) > 0 {
            let before = left(&bvh);
            own.begin_frame(&mut bvh).expect("no panic");
            let marked = bvh.changes.new.instances.len();
            // A subtree at most beyond.
            assert!((1..=HANDED + 64).contains(&marked), "{marked}");
            assert!(left(&bvh) < before);
            bvh.refit();
            assert!(bvh.work().top.nodes().len() <= (HANDED + 64) * bvh.top.depth() as usize);
            // Those of instances that hang together are few.
            assert!(opened > 0 || bvh.work().top.nodes().len() < HANDED);
            own.end_frame(&bvh);
            is_sound(&bvh);
            frames += 1;
        }
        assert!(
            frames + 1 >= (COUNT + 8 * opened) / (HANDED as u32 + 64),
            "{frames}"
        );
        assert!(bvh.blases[old as usize].nodes.is_empty());
        assert_eq!(bvh.of_mesh(0).opened, opened);
        assert!(
            bvh.instances
                .iter()
                .take(COUNT as usize)
                .all(|own| own.blas == new)
        );
        // What it stood in is free for the next one.
        assert_eq!(bvh.blas_ranges.take(1), old..old + 1);
    }
}

/// What changes the lights of a mesh refits all of its instances, so all follow; an instance that is moved follows alone.
#[test]
fn what_is_edited_follows() {
    let (mut bvh, mesh, mut own) = scene(3);
    until_adopted(&mut bvh, &mut own);
    let before = left(&bvh);
    let last = bvh.instance_id(COUNT - 1).expect("there");
    let (transform, radiance) = (Transform::at([1.0, 2.0, 3.0]), 2.0);
    bvh.apply(
        [Edit::SetTransform {
            instance: last,
            transform,
        }]
        .to_vec(),
    )
    .expect("there");
    assert_eq!(left(&bvh), before - 1);
    let other = bvh.instance_id(COUNT - 2).expect("there");
    bvh.apply(
        [Edit::SetRadiance {
            instance: other,
            radiance,
        }]
        .to_vec(),
    )
    .expect("there");
    assert_eq!(left(&bvh), before - 2);
    bvh.remove_instance(bvh.instance_id(COUNT - 3).expect("there"))
        .expect("there");
    assert_eq!(left(&bvh), before - 3);
    let at = Edit::AddInstance {
        mesh,
        transform,
        radiance,
    };
    bvh.apply([at].to_vec()).expect("added");
    assert_eq!(left(&bvh), before - 3);
    bvh.refit();
    is_sound(&bvh);
    bvh.set_triangle_range(mesh, 7, lamps(4)[..1].to_vec())
        .expect("in the mesh");
    assert_eq!((left(&bvh), bvh.handing_over()), (0, 0));
    bvh.refit();
    is_sound(&bvh);

    // All of them go, and the mesh.
    let (mut bvh, mesh, mut own) = scene(3);
    until_adopted(&mut bvh, &mut own);
    for k in 0..COUNT {
        bvh.remove_instance(bvh.instance_id(k).expect("there"))
            .expect("there");
    }
    assert_eq!(bvh.handing_over(), 0);
    bvh.remove_mesh(mesh).expect("unused");
    bvh.refit();
    assert_eq!(bvh.validate().expect("valid").blases, 0);
}

/// Another rebuilder goes on, that of a copy and that of what was read from a file too: word for word.
#[test]
fn another_rebuilder_goes_on_word_for_word() {
    for opened in [0, 40] {
        let (mut bvh, _, mut own) = scene(opened);
        until_adopted(&mut bvh, &mut own);
        frame(&mut bvh, &mut own, Vec::new());
        let words = bvh.to_words();
        let mut others = [bvh.clone(), LightBvh::from_words(&words).expect("sound words")];
        assert!(others[1].to_words() == words);
        let mut builders = [rebuilder(), rebuilder()];
        let mut own = rebuilder();
        for k in 0..20 {
            let edit = |bvh: &LightBvh| {
                let instance = bvh.instance_id(crate::exact::hash(k) % COUNT).expect("there");
                [Edit::SetRadiance {
                    instance,
                    radiance: 0.5,
                }]
                .to_vec()
            };
            let edits = edit(&bvh);
            frame(&mut bvh, &mut own, edits);
            for (other, own) in others.iter_mut().zip(&mut builders) {
                let edits = edit(other);
                frame(other, own, edits);
                assert!(other.to_words() == bvh.to_words(), "{opened} {k}");
            }
        }
        assert_eq!(left(&bvh), 0);
        is_sound(&bvh);
    }
}

/// Words that contradict each other about who follows what.
#[test]
fn wrong_words_are_refused() {
    let (mut bvh, _, mut own) = scene(0);
    until_adopted(&mut bvh, &mut own);
    let words = bvh.to_words();
    let outgoing = bvh.of_mesh(0).outgoing.expect("some are left");
    let old = &bvh.blases[outgoing.blas as usize];
    let flags = (0..words.len())
        .find(|&at| words[at] == old.unsettled | 1 << 30)
        .expect("there");
    // It is the mesh's, or both are of before.
    for wrong in [old.unsettled, 1 << 31] {
        let mut other = words.clone();
        other[flags] = wrong;
        assert!(LightBvh::from_words(&other).is_err());
    }
    // Nobody follows it.
    let mut other = words.clone();
    other
        .iter_mut()
        .filter(|word| **word >> 16 == 1 << 15)
        .for_each(|word| *word &= !(1 << 31));
    assert!(LightBvh::from_words(&other).is_err());
}

/// A frame that refits all instances of a mesh has all of them follow its tree: their leaves are computed anyway.
#[test]
fn where_a_mesh_is_to_be_refitted_all_follow_at_once() {
    let (mut bvh, mesh, mut own) = scene(0);
    for frame in 0..200 {
        let mut one = lamps(2)[0];
        one.radiance = [1.0 + 0.01 * frame as f32; 3];
        bvh.set_triangle_range(mesh, 0, std::vec![one]).expect("its own");
        let start = own.begin_frame(&mut bvh).expect("no panic");
        bvh.refit();
        own.end_frame(&bvh);
        if start.adopted > 0 {
            assert_eq!(bvh.handing_over(), 0);
            let new = bvh.meshes[0].blas;
            assert!(bvh.instances[..COUNT as usize].iter().all(|own| own.blas == new));
            is_sound(&bvh);
            return;
        }
    }
    panic!("no tree came");
}
