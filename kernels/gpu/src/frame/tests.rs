//! Copies and regions of a frame. `tests/tests/device_words.rs` compares what devices then hold, frame after frame.

use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightNode, MomentNode, Transform};

use super::*;

type Tree = Bvh<MomentNode<8>, (), 8>;

fn lamp(x: f32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.1]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

/// Twenty instances of each of two meshes, refitted.
pub(crate) fn scene<N: LightNode<W>, const W: usize>() -> (Bvh<N, (), W>, Vec<InstanceId>) {
    let mut scene = Bvh::default();
    let mut all = Vec::new();
    for count in [3_u16, 300] {
        let lamps = (0..count).map(|k| lamp(f32::from(k)));
        let mesh = scene.add_mesh(lamps.collect()).expect("a mesh");
        for k in 0..20_u8 {
            let at = Transform::at([0.0, f32::from(k), f32::from(count)]);
            all.push(scene.add_instance(mesh, at).expect("an instance"));
        }
    }
    scene.refit();
    (scene, all)
}

/// Checks that the regions out of a staging buffer are the copies: one after another there, a list for each buffer.
fn check_regions(frame: &Frame, scene: &Tree) {
    let start = 12;
    let all = frame.regions(start);
    let mut from = start;
    let mut copies = frame.copies.iter();
    for (number, (buffer, regions)) in all.iter().enumerate() {
        for region in regions {
            let copy = copies.next().expect("a copy for each region");
            let bytes = copy.source(scene).len() as u64;
            assert_eq!(
                (copy.buffer, copy.bytes.start, bytes),
                (*buffer, region.to, region.bytes)
            );
            assert_eq!(region.from, from);
            let words = region.run().map(|words| u64::from(words) * 4);
            assert_eq!(words, [region.from, region.to, region.bytes]);
            from += bytes;
        }
        let is_same = |(other, _): &(Buffer, Vec<Region>)| other == buffer;
        assert!(!regions.is_empty() && !all[number + 1..].iter().any(is_same));
    }
    assert!(copies.next().is_none());
    assert_eq!(from, start + frame.staged_bytes());
}

#[test]
fn first_frame_copies_everything_and_still_one_nothing() {
    let (mut scene, all): (Tree, _) = scene();
    let mut mirror = Mirror::default();
    let first = mirror.frame(&scene);
    check_regions(&first, &scene);
    assert_eq!(first.resizes.len(), Buffer::ALL.len());
    for &(buffer, bytes) in &first.resizes {
        let own = first.copies.iter().filter(|copy| copy.buffer == buffer);
        let copied: u64 = own.map(|copy| copy.bytes.end - copy.bytes.start).sum();
        assert_eq!(copied, bytes, "{buffer:?}");
    }
    scene.apply(vec![]).expect("nothing");
    scene.refit();
    let still = mirror.frame(&scene);
    assert!(still.copies.is_empty() && still.resizes.is_empty() && still.refit.dispatches.is_empty());

    let moved = [0, 2].map(|k: usize| Edit::SetTransform {
        instance: all[k],
        transform: Transform::at([0.001, k as f32, 3.0]),
    });
    scene.apply(moved.to_vec()).expect("moved");
    scene.refit();
    let frame = mirror.frame(&scene);
    check_regions(&frame, &scene);
    let instances = frame
        .copies
        .iter()
        .filter(|copy| copy.buffer == Buffer::Instances);
    assert_eq!(instances.count(), 2);
    assert!(frame.resizes.is_empty() && !frame.refit.dispatches.is_empty());
}
