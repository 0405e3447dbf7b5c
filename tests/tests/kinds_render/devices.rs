//! The same words on every device.

use super::*;

#[test]
fn every_kind_and_texture_have_the_same_words_on_every_device() {
    // Devices compile the kernels once for both, which takes longer than all the rest.
    on_each_device(Options::default(), |device| {
        for scene in [room(), textured_room()] {
            same_on(device, &scene);
        }
    });
}

/// That a device has the CPU's words of a scene, by every sampler, directly, of several candidates, and by paths.
fn same_on(device: &Device, scene: &Scene) {
    let params = render_params((40, 25), 2, 5, [0.2, 0.3, 0.4]);
    let arrays = arrays(scene, &params);
    let (two_level, _) = Instances::<AnyLight>::new(scene, 0, BuildParams::default()).expect("sound");
    for sampler in Sampler::ALL {
        let bvh: Bvh<AnyKind, WIDTH> = match sampler {
            Sampler::TwoLevel => two_level.clone(),
            _ => build(&arrays.lights, sampler, &BuildParams::default()),
        };
        let mut cpu = CpuBackend::<AnyKind, WIDTH>::new(bvh.clone());
        let mut other = DeviceBackend::<AnyKind, WIDTH>::new(device, &bvh).expect("a backend");
        let direct = [1, 6].map(|candidates| (Integrator::Direct, candidates));
        let paths = [1, 4].map(|bounces| (Integrator::Path { bounces }, 1));
        for (integrator, candidates) in direct.into_iter().chain(paths) {
            let params = RenderParams { candidates, ..params };
            let what = format!(
                "{} by {}, {integrator:?}, {candidates}",
                device.name(),
                sampler.name()
            );
            let expected = cpu
                .render(&arrays, &params, sampler, integrator)
                .expect("an image")
                .value;
            let found = other
                .render(&arrays, &params, sampler, integrator)
                .expect("an image")
                .value;
            same(&expected, &found, &what);
        }
    }
}

fn same(expected: &[[f32; 3]], found: &[[f32; 3]], what: &str) {
    let comparison =
        compare_words(&PIXEL_RECORD, cast_slice(expected), cast_slice(found)).expect("images of one size");
    assert!(
        comparison.different == 0,
        "{what}: {} words differ, first {}",
        comparison.different,
        comparison.first.expect("a difference")
    );
    let lit = expected.iter().filter(|p| p.iter().any(|&c| c > 0.0)).count();
    assert!(lit > expected.len() / 2, "{what}: {lit} pixels are lit");
}
