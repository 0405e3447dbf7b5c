//! All kinds in one room: samplers agree, a rectangle is its mesh, methods take them.

use super::*;

/// The images of all samplers agree, of direct light and of paths.
#[test]
fn samplers_agree_on_every_kind() {
    agree(&open_room());
}

/// A rectangle by formula and by two triangles: the same image within its noise, directly and by paths, where rays meet both.
#[test]
fn a_rectangle_is_its_mesh() {
    let lamp = down([0.3, 2.0, -0.2]);
    let formula = {
        let mut data = room().into_data();
        data.analytic.clear();
        data.nodes.push(node(lamp, None));
        data.analytic.push(AnalyticLight {
            name: String::from("rectangle"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::Rectangle { half: [0.5, 0.5] },
            color: [1.0; 3],
            intensity: 5.0,
            range: None,
        });
        Scene::new(data).expect("sound")
    };
    let mesh = {
        let mut data = room().into_data();
        data.analytic.clear();
        data.materials.push(Material {
            // As lamps by formula reflect.
            base_color: [0.2; 3],
            metallic: 0.0,
            radiance: [5.0; 3],
            ..Material::default()
        });
        // A square whose front is up, turned upside down.
        data.meshes.push(sheet(1.0, 3));
        data.nodes.push(node(
            Transform::Trs {
                translation: [0.3, 2.0, -0.2],
                rotation: [1.0, 0.0, 0.0, 0.0],
                scale: [1.0; 3],
            },
            Some(3),
        ));
        Scene::new(data).expect("sound")
    };
    let settings = RenderSettings {
        width: 48,
        height: 36,
        samples: 256,
        ..SETTINGS
    };
    let params = settings.params([0.0; 3]);
    for (integrator, sampler) in [
        (Integrator::Direct, Sampler::SingleLevel),
        (Integrator::Path { bounces: 2 }, Sampler::SingleLevel),
    ] {
        let [a, b] = [&formula, &mesh].map(|scene| {
            let arrays = arrays(scene, &settings);
            let bvh: Bvh<Kinds, WIDTH> = build(&arrays.lights, sampler, &BuildParams::default());
            let mut cpu = CpuBackend::<Kinds, WIDTH>::new(bvh);
            cpu.render(&arrays, &params, sampler, integrator)
                .expect("an image")
                .value
        });
        // The lamp itself is seen alike; its surface's own reflection is black by formula to a gloss of 4 % and not by mesh.
        let differences: Vec<[f32; 3]> = a
            .iter()
            .zip(&b)
            .map(|(a, b)| [0, 1, 2].map(|c| a[c] - b[c]))
            .collect();
        let ((difference, error), (whole, _)) = (mean(&differences), mean(&a));
        assert!(
            difference.abs() <= 5.0 * error + 2e-3 * whole,
            "{integrator:?}: {difference} ± {error} of {whole}"
        );
        assert!(error < 0.01 * whole, "too noisy to tell: {error} of {whole}");
    }
}

/// The instances that a light BVH follows are the lights of the frame, to rounding.
#[test]
fn instances_stand_where_the_frame_has_its_lamps() {
    let scene = room();
    let (lights, _) = Instances::<AnyLight>::new::<lightbvh_kernels::bvh::AnyNode, (), WIDTH>(
        &scene,
        0,
        BuildParams::default(),
    )
    .expect("sound");
    let expected: Vec<AnyLight> = scene.frame(0).lights();
    let found = lights.world_lights();
    assert_eq!(expected.len(), found.len());
    for (e, f) in expected.iter().zip(&found).skip(2) {
        assert_eq!(e, f);
    }
}

/// Every method but those by the paper's importance renders such a scene.
#[test]
fn methods_take_every_kind() {
    let scene = room();
    let settings = RenderSettings {
        width: 24,
        height: 18,
        samples: 8,
        ..SETTINGS
    };
    let arrays = arrays(&scene, &settings);
    let step = Step {
        scene: &scene,
        frame: 0,
        lights: &arrays.lights,
    };
    for method in Method::ALL {
        match method.recipe().runner(&step, Target::Cpu) {
            Ok(mut runner) => {
                let image = runner.image(&step, &arrays, &settings).expect("an image").value;
                assert!(mean(&image).0 > 0.0, "{method:?}");
            }
            Err(error) => {
                assert!(error.to_string().contains("emissive triangles alone"), "{error}");
                assert_eq!(method.recipe().importance, Importance::Eq4, "{method:?}");
            }
        }
    }
}
