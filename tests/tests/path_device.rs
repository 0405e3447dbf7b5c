//! Images of paths, on every device of the machine against the CPU, word for word.

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use lightbvh_host::backend::{Backend, Bvh, CpuBackend, DeviceBackend, Integrator, PIXEL_RECORD, Sampler};
use lightbvh_host::scene::Scene;
use lightbvh_host::vulkan::Options;
use lightbvh_host::words::compare_words;
use lightbvh_host::workload::{RenderSettings, arrays_at, build};
use lightbvh_kernels::bvh::{Paper, Standard, TriangleChoice, WIDTH};
use lightbvh_tests::devices::on_each_device;

fn same_words<C: TriangleChoice<W>, const W: usize>() {
    let scene = Scene::open("carousel").expect("a built-in scene");
    let settings = RenderSettings {
        frame: 30,
        width: 40,
        height: 25,
        samples: 2,
        seed: 7,
    };
    let arrays = arrays_at(&scene, settings.frame, settings.width, settings.height).expect("a frame");
    let params = settings.params([0.2, 0.3, 0.4]);
    on_each_device(Options::default(), |device| {
        for sampler in Sampler::ALL {
            let bvh: Bvh<C, W> = build(&arrays.lights, sampler, &BuildParams::default());
            let mut cpu = CpuBackend::<C, W>::new(bvh.clone());
            let mut other = DeviceBackend::<C, W>::new(device, &bvh).expect("a backend");
            for bounces in [0, 1, 7] {
                let expected = cpu
                    .render(&arrays, &params, sampler, Integrator::Path { bounces })
                    .expect("an image")
                    .value;
                let found = other
                    .render(&arrays, &params, sampler, Integrator::Path { bounces })
                    .expect("an image")
                    .value;
                let comparison = compare_words(&PIXEL_RECORD, cast_slice(&expected), cast_slice(&found))
                    .expect("images of one size");
                assert!(
                    comparison.different == 0,
                    "{}, {} by {}, {bounces} bounces: {} words differ, first {}",
                    device.name(),
                    C::NAME,
                    sampler.name(),
                    comparison.different,
                    comparison.first.expect("a difference")
                );
                let lit = expected.iter().filter(|p| p.iter().any(|&c| c > 0.0)).count();
                assert!(
                    lit > expected.len() / 2,
                    "{}: {lit} pixels are lit",
                    sampler.name()
                );
            }
        }
    });
}

#[test]
fn paths_have_the_same_words_on_every_device() {
    same_words::<Standard, WIDTH>();
    same_words::<Paper, 4>();
}
