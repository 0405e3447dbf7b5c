//! Plans of what a frame copies, and what is missing in one.

use super::*;

/// Refits on the CPU between a plan and those who follow it, or before the plan, or none: all the same.
#[test]
fn refits_at_any_time_leave_a_plan_whole() {
    let mut scene = Bvh::<MomentNode<4>, (), 4>::default();
    let (mut devices, mut ids) = (<[Device; 2]>::default(), Default::default());
    edit(&mut scene, &mut ids, 0);
    let mut random = 1_u32;
    let mut next = |below: u32| {
        random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (random >> 16) % below
    };
    for frame in 0..400 {
        // Frames 0 to 99 are those of mirrors that follow without any plan.
        let plans = frame >= 100;
        for _ in 0..next(3) {
            for _ in 0..next(2) {
                edit(&mut scene, &mut ids, next(30));
            }
            for _ in 0..next(3) {
                scene.refit();
            }
        }
        if plans {
            scene.plan();
        } else {
            scene.refit();
        }
        for device in &mut devices {
            for _ in 0..next(3) {
                scene.refit();
            }
            if next(4) > 0 {
                device.follow(&scene);
                let mut twin = scene.clone();
                twin.refit();
                device.assert_is(&twin, frame);
            }
        }
    }
}

/// The copy that a rebuild takes has the CPU's roots, which only a device has refitted since.
#[test]
fn a_rebuild_swapped_in_reaches_a_device_that_alone_refits() {
    let mut scene = Bvh::<MomentNode<8>, (), 8>::default();
    // So many that a change is told by its path, not by all nodes.
    let meshes: Vec<_> = (0..100)
        .map(|seed| scene.add_mesh(mesh(3, seed)).expect("a mesh"))
        .collect();
    let places = meshes.iter().zip(0u8..).map(|(&mesh, k)| Edit::AddInstance {
        mesh,
        transform: Transform::at([f32::from(k % 10), f32::from(k / 10), 0.0]),
        radiance: 1.0,
    });
    let ids = scene.apply(places.collect()).expect("places").instances;
    scene.refit();
    let mut device = Device::default();
    scene.plan();
    device.follow(&scene);
    for frame in 0..20 {
        scene
            .set_triangles(meshes[frame as usize * 3], mesh(3, 200 + frame))
            .expect("as many");
        scene.plan();
        device.follow(&scene);
        let rebuild = scene.rebuild(&RebuildParams::eager());
        // Before the copy, and after it.
        let moved = Transform::at([frame as f32, 20.0, 0.0]);
        scene.set_transform(ids[frame as usize], moved).expect("there");
        if frame % 2 == 1 {
            scene.plan();
            device.follow(&scene);
        }
        scene.install(rebuild.run()).expect("its own");
        scene.plan();
        device.follow(&scene);
        let mut twin = scene.clone();
        twin.refit();
        device.assert_is(&twin, frame);
    }
}

/// Trails of two words each: where a mesh takes another's place, both words are copied.
#[test]
fn wide_trails_are_copied_whole() {
    let mut scene = Bvh::<CompactNode<2>, (), 2>::default();
    // Each half as large as the next: a deep tree.
    let deep = (-58..38).map(|e| {
        let size = lightbvh::exact::pow2(e);
        EmissiveTriangle {
            p: [
                [size, 0.0, 0.0],
                [size * 1.01, 0.0, 0.0],
                [size, 0.0, size * 0.01],
            ],
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        }
    });
    scene.add_mesh(deep.collect()).expect("a mesh");
    let mut last = scene.add_mesh(mesh(40, 0)).expect("a mesh");
    assert_eq!(scene.tree().trail_words, 2);
    let mut device = Device::default();
    scene.refit();
    scene.plan();
    device.follow(&scene);
    for turn in 0..4_u32 {
        // In the place of the one that goes.
        scene.remove_mesh(last).expect("not in use");
        last = scene.add_mesh(mesh(40, turn + 1)).expect("a mesh");
        scene.refit();
        scene.plan();
        assert!(device.follow(&scene).resizes.is_empty());
        device.assert_is(&scene, turn);
    }
}

#[test]
fn ranges_that_touch_are_one() {
    assert_eq!(
        joined(vec![8..12, 0..4, 4..8, 20..24, 22..30], 28),
        [0..12, 20..28]
    );
    assert_eq!(joined(vec![4..4, 40..50], 28), []);
}

/// What a caller may get wrong costs copies, never a word: a plan left out, taken twice or too early, another light BVH.
#[test]
fn a_plan_that_does_not_say_all_is_not_trusted() {
    let lamp = |x: f32| EmissiveTriangle {
        p: [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    };
    type Scene = Bvh<MomentNode<8>, (), 8>;
    let mut scene = Scene::default();
    let mesh = scene.add_mesh(vec![lamp(0.0), lamp(3.0)]).expect("a mesh");
    let place = |k: u16| Transform::at([f32::from(k % 7), f32::from(k), 0.0]);
    for k in 0..20 {
        scene.add_instance(mesh, place(k)).expect("a place");
    }
    let mut device = Device::default();
    let everything = |scene: &Scene| -> u64 {
        let bytes = |buffer: Buffer| buffer.bytes(scene).len() as u64;
        Buffer::ALL.into_iter().map(bytes).sum()
    };
    let copied = |frame: &Frame| {
        frame
            .copies
            .iter()
            .map(|copy| copy.bytes.end - copy.bytes.start)
            .sum::<u64>()
    };
    // Sizes are told once, here and after each case.
    let frame = device.follow(&scene);
    assert_eq!((copied(&frame), frame.resizes.len()), (everything(&scene), 5));
    // By index: a clone and a read one have ids of their own.
    fn shine(scene: &mut Scene, index: u32, radiance: f32) {
        let id = scene.instance_id(index).expect("in use");
        scene.set_radiance(id, radiance).expect("its own");
    }
    type Case = (&'static str, fn(&mut Scene));
    let cases: [Case; 7] = [
        ("an edit alone", |_| {}),
        ("no plan", |scene| scene.refit()),
        ("a plan left out", |scene| {
            scene.plan();
            shine(scene, 3, 2.0);
            scene.plan();
        }),
        ("an edit after the plan", |scene| {
            scene.plan();
            shine(scene, 4, 3.0);
        }),
        ("a swap after the plan", |scene| {
            let rebuilt = scene.rebuild(&RebuildParams::eager()).run();
            scene.plan();
            scene.install(rebuilt).expect("its own");
        }),
        ("a clone", |scene| {
            scene.plan();
            *scene = scene.clone();
        }),
        ("one that was read", |scene| {
            scene.refit();
            *scene = Scene::from_words(&scene.to_words()).expect("its own words");
        }),
    ];
    for (k, (what, case)) in (1_u8..).zip(cases) {
        shine(&mut scene, u32::from(k), 0.5);
        case(&mut scene);
        let frame = device.follow(&scene);
        assert_eq!(copied(&frame), everything(&scene), "{what}");
        assert!(frame.resizes.is_empty(), "{what}");
        let mut refitted = scene.clone();
        refitted.refit();
        device.assert_is(&refitted, what);
        // The next plan may say some of it again; what follows is small: as bright as that, an instance stays where it is.
        scene.plan();
        device.follow(&scene);
        shine(&mut scene, 15, 1.0 + f32::from(k) / 8.0);
        scene.plan();
        let frame = device.follow(&scene);
        assert!(copied(&frame) < everything(&scene) / 4, "{what}, the frame after");
        assert_eq!(
            device.follow(&scene),
            Frame::default(),
            "{what}, the same plan again"
        );
        let mut refitted = scene.clone();
        refitted.refit();
        device.assert_is(&refitted, what);
    }
}
