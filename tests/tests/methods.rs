//! The methods of the comparison: what they are equal to.

use lightbvh::{BuildParams, Heuristic};
use lightbvh_host::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler};
use lightbvh_host::method::{Method, Step, Target};
use lightbvh_host::scene::Scene;
use lightbvh_host::workload::{arrays_at, build, lights_at, render_params};
use lightbvh_kernels::bvh::Paper;

const LAST: u32 = 12;
const SIZE: (u32, u32) = (48, 27);

/// The image of the last frame by `method`, brought to it over all frames.
fn image(scene: &Scene, method: Method) -> Vec<[f32; 3]> {
    let lights = lights_at(scene, 0).expect("lights");
    let first = Step::new(scene, 0, &lights);
    let mut runner = method.recipe().runner(&first, Target::Cpu).expect("a runner");
    for frame in 1..=LAST {
        let lights = lights_at(scene, frame).expect("lights");
        let step = Step::new(scene, frame, &lights);
        let times = runner.advance(&step).expect("an update");
        if matches!(method, Method::SingleLevelRebuilt | Method::Power) {
            assert_eq!(times.wait, times.rebuild, "nothing is built beside the frame");
        }
    }
    let arrays = arrays_at(scene, LAST, SIZE.0, SIZE.1).expect("a frame");
    let step = Step::new(scene, LAST, &arrays.lights);
    let params = render_params(SIZE, 2, 5, scene.data().background);
    runner.image(&step, &arrays, &params).expect("an image").value
}

#[test]
fn a_rebuilt_tree_is_a_new_tree_and_a_refitted_one_is_not() {
    let scene = Scene::open("street").expect("a scene");
    let arrays = arrays_at(&scene, LAST, SIZE.0, SIZE.1).expect("a frame");
    let params = BuildParams::paper(Heuristic::Saoh);
    let bvh: Bvh<Paper, 4> = build(&arrays.lights, Sampler::SingleLevel, &params);
    let mut cpu = CpuBackend::<Paper, 4>::new(bvh);
    let params = render_params(SIZE, 2, 5, scene.data().background);
    let new = cpu
        .render(&arrays, &params, Sampler::SingleLevel, Integrator::Direct)
        .expect("an image")
        .value;
    assert!(image(&scene, Method::SingleLevelRebuilt) == new);
    assert!(image(&scene, Method::SingleLevelRefit) != new);
}
