//! A rebuild that panics or is dropped costs nothing but itself.

use super::*;

#[test]
fn a_panic_is_told_once_and_the_next_rebuild_is_sound() {
    const TEST: usize = 3;
    for swap in [Swap::Deterministic, Swap::WhenReady] {
        slowed::spare();
        let random = &mut Random::new(30);
        let (mut scene, model) = town::<TEST>(random, 30);
        let mut rebuilder = Rebuilder::new(params(1, swap));
        let before = words(&scene, &ids(&model), 0);
        for _ in 0..3 {
            slowed::set::<TEST>(Pace::Panic);
            rebuilder.end_frame(&scene);
            let error = loop {
                match rebuilder.begin_frame(&mut scene) {
                    Err(error) => break error,
                    Ok(start) => assert!(!start.swapped),
                }
            };
            let RebuildError::Panicked { message } = &error else {
                panic!("{error}");
            };
            assert_eq!(message, "told to panic");
            assert!(error.to_string().contains("told to panic"));
            assert!(!rebuilder.is_busy());
            assert!(!rebuilder.begin_frame(&mut scene).expect("told once").swapped);
            scene.refit();
            assert!(before == words(&scene, &ids(&model), 0), "the tree is as it was");
        }
        // Nothing changed, but what failed is still to be built.
        slowed::set::<TEST>(Pace::Full);
        rebuilder.end_frame(&scene);
        until_swapped(&mut rebuilder, &mut scene);
        scene.refit();
        check_pmfs(&scene, &model, random);
    }
}

#[test]
fn dropped_while_it_builds_it_ends() {
    const TEST: usize = 4;
    let (done, ended) = mpsc::channel();
    let dropping = thread::spawn(move || {
        slowed::spare();
        let (mut scene, _) = town::<TEST>(&mut Random::new(40), 30);
        // Never used; idle after a rebuild; in the middle of one.
        drop(Rebuilder::<Slowed<TEST>, 4>::new(RebuilderParams::default()));
        let mut idle = Rebuilder::new(params(1, Swap::Deterministic));
        idle.end_frame(&scene);
        idle.begin_frame(&mut scene).expect("no panic");
        drop(idle);
        let mut busy = Rebuilder::new(params(1, Swap::Deterministic));
        slowed::set::<TEST>(Pace::Held);
        busy.end_frame(&scene);
        slowed::wait_until_held::<TEST>();
        let release = thread::spawn(|| {
            thread::sleep(Duration::from_millis(30));
            slowed::set::<TEST>(Pace::Full);
        });
        drop(busy);
        release.join().expect("released");
        done.send(()).expect("someone listens");
    });
    ended
        .recv_timeout(Duration::from_secs(60))
        .expect("dropping ends");
    dropping.join().expect("no panic");
}

/// Large for the bytes that a frame may copy: its tree is built by a thread of its own and put in place piece by piece.
#[test]
fn a_panic_over_a_large_mesh_costs_nothing_but_itself() {
    const TEST: usize = 7;
    slowed::spare();
    let random = &mut Random::new(70);
    let (mut scene, mut model) = town::<TEST>(random, 5);
    let mut triangles = generate::small_triangles(300, 300, 2.0, 0.2, false, random.bits());
    let mesh = add(random, &mut scene, &mut model, triangles.clone(), 3);
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, random.below(i as u32 + 1) as usize);
    }
    model.meshes.insert(mesh, triangles.clone());
    scene
        .apply(vec![Edit::SetTriangles { mesh, triangles }])
        .expect("as many");
    scene.refit();
    let due = scene.due(&RebuildParams {
        top: f64::INFINITY,
        ..EAGER
    });
    assert!(
        due.len() == 1 && due[0].mesh == Some(mesh) && due[0].drift > 1.1,
        "{due:?}"
    );
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        rebuild: RebuildParams {
            top: f64::INFINITY,
            ..EAGER
        },
        bytes: 0,
        ..params(1, Swap::Deterministic)
    });
    let before = words(&scene, &ids(&model), 0);
    slowed::set::<TEST>(Pace::Panic);
    let mut frames = 0;
    let error = loop {
        match rebuilder.begin_frame(&mut scene) {
            Err(error) => break error,
            Ok(start) => assert!(start.adopted == 0 && frames < 100),
        }
        scene.refit();
        valid(&scene, &model);
        rebuilder.end_frame(&scene);
        frames += 1;
    };
    assert!(error.to_string().contains("told to panic"));
    assert!(!rebuilder.is_busy());
    scene.refit();
    assert_eq!(before.pmfs, words(&scene, &ids(&model), 0).pmfs);
    // What failed is still to be built.
    slowed::set::<TEST>(Pace::Full);
    let mut edited = 0;
    loop {
        rebuilder.end_frame(&scene);
        let start = rebuilder.begin_frame(&mut scene).expect("no panic");
        if start.adopted > 0 {
            break;
        }
        edited += 1;
        assert!(edited < 100);
        if edited % 3 == 0 {
            let first = random.below(300);
            let some = vec![model.meshes[&mesh][299 - first as usize]];
            model.meshes.get_mut(&mesh).expect("it is there")[first as usize] = some[0];
            scene.set_triangle_range(mesh, first, some).expect("its own");
        }
        scene.refit();
        check_pmfs(&scene, &model, random);
    }
    scene.refit();
    check_pmfs(&scene, &model, random);
    let due = scene.due(&RebuildParams::default());
    assert!(due.iter().all(|due| due.mesh.is_none()), "{due:?}");
}
