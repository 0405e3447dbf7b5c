//! One level and two, edits, trees built in the background, opened meshes.

use super::*;
use lightbvh::bvh::{RebuilderParams, StaticMeshBvh, Swap};
use lightbvh::exact::hash;
use lightbvh::light::LinkedTriangle;
use lightbvh::node::Lit;
use lightbvh::tree::OPENED;
use lightbvh::{BuildParams, Bvh, Lights, MomentNode, Moments, Rebuilder, Transform};

fn one_level<L: Shines>(light: fn(&mut Random) -> L) {
    let random = &mut Random(1);
    let mut seen = Seen::default();
    for count in [1, 2, 3, 7, 8, 9, 40, 200, 2000] {
        for buckets in [2, 16] {
            let params = BuildParams {
                buckets,
                ..BuildParams::default()
            };
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
        bvh.rebuild();
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
    let place = bvh.tree().links.places[large_one.index() as usize];
    assert!(place != u32::MAX && place & OPENED != 0, "nothing is tested");
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
        assert_eq!(without.sample(&receiver, number), bvh.sample(&receiver, number));
    }
    assert!(seen.partial > 10, "{seen:?}");
}
