//! A build that panics or is dropped costs nothing but itself.

use super::*;

#[test]
fn a_panic_is_reported_once_and_the_next_build_is_sound() {
    const TEST: usize = 3;
    for swap in [Swap::Deterministic, Swap::WhenReady] {
        slowed::spare();
        let random = &mut Random::new(30);
        let (mut scene, mut model, mesh) = town::<TEST>(random, 30);
        let mut rebuilder = Rebuilder::new(params(1, swap));
        // Builds of the top level and of the mesh, in turn.
        for _ in 0..4 {
            shuffle(random, &mut scene, &mut model, mesh);
            let before = scene.to_words();
            slowed::set::<TEST>(Pace::Panic);
            rebuilder.end_frame(&scene);
            let error = loop {
                match rebuilder.begin_frame(&mut scene) {
                    Err(error) => break error,
                    Ok(start) => assert!(!start.swapped && start.meshes == 0),
                }
            };
            let RebuildError::Panicked { message } = &error else {
                panic!("{error}");
            };
            assert_eq!(message, "told to panic");
            assert!(error.to_string().contains("told to panic"));
            assert!(!rebuilder.is_busy());
            let start = rebuilder.begin_frame(&mut scene).expect("reported once");
            assert!(!start.swapped && start.meshes == 0);
            scene.refit();
            assert!(scene.to_words() == before, "the trees are as they were");
        }
        slowed::set::<TEST>(Pace::Full);
        come_to_rest(&mut rebuilder, &mut scene);
        assert!(scene.to_words() == rebuilt(&scene));
        check_pmfs(&scene, &model, random);
    }
}

#[test]
fn dropped_while_it_builds_it_ends() {
    const TEST: usize = 4;
    let (done, ended) = mpsc::channel();
    let dropping = thread::spawn(move || {
        slowed::spare();
        let (mut scene, ..) = town::<TEST>(&mut Random::new(40), 30);
        // Never used; idle after a build; in the middle of one.
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

/// Frames that a rebuilder does not see lose no light.
#[test]
fn two_rebuilders_of_one_scene_lose_no_light() {
    const TEST: usize = 2;
    let random = &mut Random::new(60);
    let (mut scene, mut model, _) = town::<TEST>(random, 10);
    let mut rebuilders = [1, 2].map(|after| Rebuilder::new(params(after, Swap::Deterministic)));
    for _ in 0..80 {
        let takes_part = [0; 2].map(|_| random.below(3) > 0);
        for (own, _) in rebuilders.iter_mut().zip(takes_part).filter(|(_, part)| *part) {
            own.begin_frame(&mut scene).expect("no panic");
        }
        edits(random, &mut model, &mut scene, REACH);
        scene.refit();
        check_pmfs(&scene, &model, random);
        for (own, _) in rebuilders.iter_mut().zip(takes_part).filter(|(_, part)| *part) {
            own.end_frame(&scene);
        }
    }
}
