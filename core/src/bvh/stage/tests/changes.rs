//! Meshes that change while their trees are built and put in place.

use super::*;

/// A mesh that is deformed in every frame gets its tree in a frame whose sweep covers it.
#[test]
fn what_changes_as_a_whole_is_swept_once() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
        let mut all = lamps(2);
        for lamp in &mut all {
            lamp.p = lamp.p.map(|[x, y, z]| [x, y, z + 0.01 * frame as f32]);
        }
        bvh.set_triangles(mesh, all).expect("as many");
        bvh.refit();
        assert!(bvh.work().trees.len() == 1);
    });
    assert!(frames < 100, "{frames}");
    assert!(drift(&bvh, mesh) < 1.01, "{}", drift(&bvh, mesh));
}

/// A mesh that rests after that gets its nodes computed piece by piece.
#[test]
fn what_changed_as_a_whole_and_rests_is_swept_in_pieces() {
    let (mut bvh, mesh, mut rebuilder) = scene();
    let mut computed = 0;
    until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
        computed = bvh
            .work()
            .bottom
            .nodes()
            .len()
            .max(if frame > 50 { computed } else { 0 });
        if frame == 50 {
            bvh.set_triangles(mesh, lamps(4)).expect("as many");
        }
        if frame == 120 {
            bvh.set_triangle_range(mesh, 40, lamps(5)[..3].to_vec())
                .expect("its own");
        }
    });
    // It was built for other triangles, so it is exact and not good: it is due at once.
    assert!(drift(&bvh, mesh) > 1.5);
    let due = bvh.due(&RebuildParams::default());
    assert_eq!(due.first().and_then(|due| due.mesh), Some(mesh));
    rebuilder.end_frame(&bvh);
    assert!(rebuilder.is_busy());
    until_adopted(&mut bvh, &mut rebuilder, |_, _| ());
    assert_eq!(drift(&bvh, mesh), 1.0);
}

/// However many triangles change from frame to frame.
#[test]
fn what_changes_in_part_does_not_put_it_off() {
    for count in [1, 30, 150, 200] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            let first = hash(frame) % (COUNT - count);
            let mut some = lamps(2)[first as usize..(first + count) as usize].to_vec();
            for lamp in &mut some {
                lamp.radiance = [hash(frame + 7) as f32 * 1e-9; 3];
            }
            bvh.set_triangle_range(mesh, first, some).expect("its own");
            // Those of the frame, and twice as many of those before.
            let written: usize = bvh
                .changes
                .new
                .written_nodes
                .iter()
                .map(ExactSizeIterator::len)
                .sum();
            assert!(written <= 80 + 3 * count as usize * 8, "{count}: {written}");
        });
        assert!(frames < 200, "{count}: {frames}");
    }
}

/// Single triangles at random places, each with a path of its own, that change in every frame put it off by little, however
/// many they are: those of a frame are computed beside what the bytes are for.
#[test]
fn what_changes_at_random_places_does_not_put_it_off() {
    let frames = [0, 1, 20, 80, 200].map(|count| {
        let (mut bvh, mesh, mut rebuilder) = scene();
        until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            let edits = (0..count).map(|k| {
                let first = hash(frame * 1000 + k) % COUNT;
                let mut one = lamps(2)[first as usize];
                one.radiance = [1.0 + hash(frame + k) as f32 * 1e-10; 3];
                Edit::SetTriangleRange {
                    mesh,
                    first,
                    triangles: std::vec![one],
                }
            });
            bvh.apply(edits.collect()).expect("its own");
        })
    });
    let most = frames.iter().max().expect("some");
    assert!(2 * most <= 3 * frames[0], "{frames:?}");
}

/// Parts of it that change again and again, each time more than are left when the next change comes, put it off for a while only.
#[test]
fn what_changes_in_parts_now_and_then_does_not_put_it_off() {
    for (every, share) in [(20, 20), (7, 40), (3, 17)] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let count = COUNT / share;
        let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            if frame % every == 0 {
                let first = frame / every * count % (COUNT - count);
                let mut some = lamps(2)[first as usize..(first + count) as usize].to_vec();
                for lamp in &mut some {
                    lamp.radiance = [1.0 + hash(frame) as f32 * 1e-10; 3];
                }
                bvh.set_triangle_range(mesh, first, some).expect("its own");
            }
        });
        assert!(frames < 400, "{every}: {frames}");
        assert!(drift(&bvh, mesh) < 1.01, "{}", drift(&bvh, mesh));
    }
}

/// A mesh that goes on losing its order while its tree is built comes to rest once it rests: nothing stays due.
#[test]
fn what_changed_while_it_was_built_is_built_again() {
    for (seed, moving) in [(3, 20), (80, 20), (157, 40), (234, 40)] {
        let random = &mut Random(seed);
        let mut bvh = LightBvh::default();
        let mesh = bvh.add_mesh(lamps(seed)).expect("a mesh");
        let small = bvh.add_mesh(lamps(5)[..1].to_vec()).expect("a mesh");
        for (mesh, x) in [(mesh, 0.0), (small, 50.0)] {
            bvh.add_instance(mesh, Transform::at([x; 3])).expect("one");
        }
        bvh.refit();
        let mut rebuilder = Own::new(RebuilderParams {
            swap: Swap::Deterministic,
            ..RebuilderParams::default()
        });
        let mut came = 0;
        for frame in 0..moving + 200 {
            let start = rebuilder.begin_frame(&mut bvh).expect("no panic");
            came += start.adopted + start.parts;
            if frame < moving {
                let first = (random.unit() * 2700.0) as u32;
                let other = lamps(seed + 1000 + frame)[..300].to_vec();
                bvh.set_triangle_range(mesh, first, other).expect("its own");
            }
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        assert!(came > 0);
        assert_eq!(bvh.due(&RebuildParams::default()), []);
        assert!(!rebuilder.is_busy());
    }
}

/// Whichever triangle changes meanwhile, the first and the last too.
#[test]
fn what_changes_at_either_end_reaches_the_new_tree() {
    for first in [0, COUNT - 1] {
        let (mut bvh, mesh, mut rebuilder) = scene();
        let mut one = lamps(2)[first as usize];
        until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
            one.radiance = [1.0 + 0.1 * frame as f32; 3];
            bvh.set_triangle_range(mesh, first, std::vec![one])
                .expect("its own");
        });
        let id = bvh.instance_id(2).expect("there");
        let light = bvh.lights_of(id).expect("there").start + first;
        let found = bvh.triangle(light, id.index()).expect("there");
        assert_eq!(found.radiance, one.radiance, "triangle {first}");
    }
}

/// A file of a frame in which another mesh came and went can be read: the place behind all, which the stage keeps, is nobody's.
#[test]
fn a_mesh_that_came_and_went_meanwhile_leaves_nothing() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(lamps(1)).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    let mut rebuilder = Own::new(RebuilderParams {
        swap: Swap::Deterministic,
        bytes: BYTES,
        ..RebuilderParams::default()
    });
    bvh.set_triangles(mesh, lamps(2)).expect("as many");
    bvh.refit();
    rebuilder.end_frame(&bvh);
    let frames = until_adopted(&mut bvh, &mut rebuilder, |bvh, frame| {
        let guest = bvh.add_mesh(lamps(3)[..3].to_vec()).expect("a mesh");
        bvh.remove_mesh(guest).expect("not used");
        bvh.refit();
        let words = bvh.to_words();
        let again = LightBvh::from_words(&words).unwrap_or_else(|error| panic!("{frame}: {error}"));
        assert!(again.to_words() == words, "{frame}");
    });
    assert!(frames > 20, "{frames}");
}
