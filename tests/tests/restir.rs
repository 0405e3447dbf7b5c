//! ReSTIR on the CPU and on every device: equal words, frame after frame.

use std::sync::Arc;

use bytemuck::cast_slice;
use lightbvh::{BuildParams, LightBvh, Lights};
use lightbvh_host::backend::{
    Backend, Bvh, Combination, CpuBackend, DeviceBackend, LightRemap, PIXEL_RECORD, RESERVOIR_RECORD, Restir,
    RestirFrame, RestirOptions, SURFACE_RECORD, Sampler, SceneArrays,
};
use lightbvh_host::render::RayBvh;
use lightbvh_host::scene::Scene;
use lightbvh_host::vulkan::{Device, Options};
use lightbvh_host::words::compare_words;
use lightbvh_host::workload::arrays_at;
use lightbvh_kernels::bvh::Standard;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::restir::combine::Combine;
use lightbvh_kernels::shading::restir::shade::shade;
use lightbvh_kernels::shading::restir::spatial::spatial;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::temporal::{Before, temporal};
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};
use lightbvh_kernels::shading::trace::NONE;
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::generate::Random;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 22;
const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];

/// A frame, its light BVH, and what became of the lights of the frame before.
struct Shot {
    arrays: Arc<SceneArrays>,
    bvh: Bvh,
    remap: Option<LightRemap>,
}

impl Shot {
    fn new(arrays: SceneArrays, remap: Option<LightRemap>) -> Self {
        let bvh = LightBvh::two_level(&arrays.lights, &BuildParams::default());
        Self {
            arrays: Arc::new(arrays),
            bvh,
            remap,
        }
    }

    /// Renders it as the next frame of `restir`.
    fn render(&self, restir: &mut Restir, width: u32, seed: u32) -> Vec<[f32; 3]> {
        let frame = self.frame(width, HEIGHT, seed);
        self.cpu().restir(restir, &frame).expect("a frame").value
    }

    fn cpu(&self) -> CpuBackend {
        CpuBackend::new(self.bvh.clone())
    }

    fn frame(&self, width: u32, height: u32, seed: u32) -> RestirFrame<'_> {
        RestirFrame {
            scene: &self.arrays,
            width,
            height,
            seed,
            jitter: seed / 100,
            background: BACKGROUND,
            remap: self.remap.as_ref(),
        }
    }
}

/// Twelve frames of a scene in which lights, things and the camera move.
fn animation(name: &str, stride: u32) -> Vec<Shot> {
    let scene = Scene::open(name).expect("a built-in scene");
    (0..12)
        .map(|n| {
            let mut arrays = arrays_at(&scene, n * stride, WIDTH, HEIGHT).expect("a frame");
            for axis in 0..3 {
                arrays.camera.origin[axis] += 0.03 * n as f32;
            }
            Shot::new(arrays, None)
        })
        .collect()
}

fn assert_equal(what: &str, record: &lightbvh_host::words::Record, cpu: &[u32], device: &[u32]) {
    let found = compare_words(record, cpu, device).expect("words of the same records");
    assert_eq!(found.different, 0, "{what}: {:?}", found.first);
    assert!(found.compared > 0);
}

/// Renders all shots on both and compares pixels, G-buffers and reservoirs.
fn compare(device: &Device, what: &str, options: RestirOptions, shots: &[Shot], size: (u32, u32)) {
    let mut cpu = Restir::new(options);
    let mut other = Restir::new(options);
    let pixels = u64::from(size.0) * u64::from(size.1);
    for (number, shot) in (0..).zip(shots) {
        let what = format!("{} {what} {options:?} frame {number}", device.name());
        let frame = shot.frame(size.0, size.1, 77 + 31 * number);
        let expected = shot.cpu().restir(&mut cpu, &frame);
        let expected = expected.expect("a frame on the CPU").value;
        let mut backend = DeviceBackend::<Standard, 8>::new(device, &shot.bvh).expect("an upload");
        let found = backend.restir(&mut other, &frame);
        let found = found.expect("a frame on the device").value;
        assert!(
            expected.iter().flatten().all(|x| x.is_finite() && *x >= 0.0),
            "{what}"
        );
        assert_equal(&what, &PIXEL_RECORD, cast_slice(&expected), cast_slice(&found));
        let (surfaces, reservoirs) = cpu.state().expect("a state");
        let (device_surfaces, device_reservoirs) = other.state().expect("a state");
        assert_equal(
            &what,
            &SURFACE_RECORD,
            cast_slice(&surfaces),
            cast_slice(&device_surfaces),
        );
        assert_equal(
            &what,
            &RESERVOIR_RECORD,
            cast_slice(&reservoirs),
            cast_slice(&device_reservoirs),
        );
        assert_eq!(cpu.shadow_rays(), other.shadow_rays(), "{what}");
        assert!(cpu.shadow_rays() > 0 || pixels == 1, "{what}: no light anywhere");
        assert!(
            cpu.shadow_rays() <= pixels * u64::from(options.most_shadow_rays()),
            "{what}"
        );
    }
}

const SOURCES: [Sampler; 2] = [Sampler::Power, Sampler::TwoLevel];
const COMBINATIONS: [Combination; 2] = [Combination::Unbiased, Combination::Biased];

fn small(source: Sampler, combination: Combination) -> RestirOptions {
    RestirOptions {
        candidates: 5,
        radius: 6,
        ..RestirOptions::new(source, combination)
    }
}

#[test]
fn cpu_and_devices_agree_over_animated_frames() {
    let street = animation("street", 7);
    let carousel = animation("carousel", 1);
    on_each_device(Options::default(), |device| {
        for source in SOURCES {
            for combination in COMBINATIONS {
                let options = small(source, combination);
                compare(device, "street", options, &street, (WIDTH, HEIGHT));
                compare(device, "carousel", options, &carousel[..4], (WIDTH, HEIGHT));
            }
        }
    });
}

/// The lights of `arrays` in the order of `kept`, whole scene with it.
fn reordered(arrays: &SceneArrays, kept: &[u32]) -> SceneArrays {
    let all = arrays.lights.triangles();
    let mut triangles: Vec<_> = kept.iter().map(|&i| all[i as usize]).collect();
    // Mesh lights are contiguous: each triangle is one of its own here.
    for (mesh, triangle) in (0..).zip(&mut triangles) {
        triangle.mesh = mesh;
    }
    let mut rays: RayBvh = arrays.rays.clone();
    for block in &mut rays.blocks {
        for (light, instance) in block.light.iter_mut().zip(&mut block.instance) {
            let now = kept.iter().position(|i| i == light);
            *light = now.map_or(NONE, |i| i as u32);
            *instance = *light;
        }
    }
    let lights = Lights::new(triangles).expect("lights");
    SceneArrays::new(rays, arrays.materials.clone(), lights, arrays.camera)
}

#[test]
fn lights_that_come_go_and_change_their_index_are_followed() {
    let scene = Scene::open("street").expect("a built-in scene");
    let arrays = arrays_at(&scene, 0, WIDTH, HEIGHT).expect("a frame");
    let count = arrays.lights.triangles().len() as u32;
    let all: Vec<u32> = (0..count).collect();
    let backwards: Vec<u32> = (0..count).rev().collect();
    let half: Vec<u32> = (0..count).filter(|i| i % 2 == 0).collect();
    let orders = [&all, &backwards, &half, &all, &backwards];
    let mut shots = Vec::new();
    let mut before: Option<&Vec<u32>> = None;
    for kept in orders {
        let remap = before.map(|before| {
            // Each light is an instance of its own.
            let now = |i: &u32| kept.iter().position(|k| k == i).map_or(NONE, |k| k as u32);
            let names = (0..).zip(before).map(|(then, i)| ([then; 2], [now(i); 2]));
            LightRemap::new(before.len(), kept.len(), names)
        });
        shots.push(Shot::new(reordered(&arrays, kept), remap));
        before = Some(kept);
    }
    on_each_device(Options::default(), |device| {
        for combination in COMBINATIONS {
            for source in SOURCES {
                compare(
                    device,
                    "remapped",
                    small(source, combination),
                    &shots,
                    (WIDTH, HEIGHT),
                );
            }
        }
    });

    // On the CPU: a light that only changed its index keeps its history, and one that is gone loses it.
    let options = RestirOptions {
        spatial_passes: 0,
        ..small(Sampler::Power, Combination::Unbiased)
    };
    let render = |shots: &[Shot]| {
        let mut cpu = Restir::new(options);
        for (number, shot) in (0..).zip(shots) {
            shot.render(&mut cpu, WIDTH, number);
        }
        cpu.state().expect("a state").1
    };
    let counts =
        |reservoirs: &[PixelReservoir]| -> u32 { reservoirs.iter().map(|pixel| pixel.reservoir.count).sum() };
    let one = counts(&render(&shots[..1]));
    assert!(
        counts(&render(&shots[..2])) > one + one / 2,
        "the history was lost"
    );
    let lost = [
        Shot::new(reordered(&arrays, &all), None),
        Shot::new(reordered(&arrays, &half), None),
    ];
    assert_eq!(counts(&render(&lost)), counts(&render(&lost[1..])));
}

#[test]
fn dispatches_in_parts_are_whole_and_corners_of_the_options_agree() {
    let scene = Scene::open("street").expect("a built-in scene");
    let shots: Vec<Shot> = [0, 3]
        .map(|n| Shot::new(arrays_at(&scene, n, WIDTH, HEIGHT).expect("a frame"), None))
        .into();
    let usual = small(Sampler::Power, Combination::Unbiased);
    on_each_device(Options::default(), |device| {
        // 2560 pixels of 1000 candidates are more than one dispatch takes. (lavapipe ends the loops of an invocation after
        // 65,535 iterations in all, silently: 32 per candidate go into the search by power.)
        let many = RestirOptions {
            candidates: 1000,
            ..usual
        };
        compare(device, "many candidates", many, &shots[..1], (64, 40));
        for options in [
            RestirOptions {
                candidates: 1,
                ..usual
            },
            RestirOptions { history: 0, ..usual },
            RestirOptions {
                history: u32::MAX,
                ..usual
            },
            RestirOptions {
                spatial_passes: 0,
                ..usual
            },
            RestirOptions {
                spatial_passes: 3,
                radius: 0,
                ..usual
            },
            RestirOptions {
                neighbors: 0,
                ..usual
            },
            RestirOptions {
                radius: 1 << 20,
                neighbors: 40,
                ..usual
            },
        ] {
            compare(device, "corners", options, &shots, (WIDTH, HEIGHT));
            compare(device, "one pixel", options, &shots, (1, 1));
        }
    });
}

#[test]
fn a_history_that_cannot_be_used_is_dropped() {
    let scene = Scene::open("street").expect("a built-in scene");
    let shot = Shot::new(arrays_at(&scene, 0, WIDTH, HEIGHT).expect("a frame"), None);
    let options = small(Sampler::TwoLevel, Combination::Unbiased);
    let first = |shot: &Shot, width| shot.render(&mut Restir::new(options), width, 9);
    let mut repainted = (*shot.arrays).clone();
    repainted.materials[0].albedo[0] *= 0.5;
    let repainted = Shot::new(repainted, None);
    for (next, width) in [(&shot, WIDTH / 2), (&repainted, WIDTH)] {
        let mut cpu = Restir::new(options);
        shot.render(&mut cpu, WIDTH, 1);
        let after = next.render(&mut cpu, width, 9);
        assert!(after == first(next, width));
    }
    let mut cpu = Restir::new(options);
    shot.render(&mut cpu, WIDTH, 1);
    let continued = shot.render(&mut cpu, WIDTH, 9);
    assert!(continued != first(&shot, WIDTH), "the history is not used");
    cpu.reset();
    let after_reset = shot.render(&mut cpu, WIDTH, 9);
    assert!(after_reset == first(&shot, WIDTH));
}

/// Whatever words are in the buffers, every step ends and reads within them.
#[test]
fn hostile_words_end_in_bounded_steps() {
    let scene = Scene::open("street").expect("a built-in scene");
    let arrays = arrays_at(&scene, 0, WIDTH, HEIGHT).expect("a frame");
    let view = arrays.view();
    let random = &mut Random::new(3);
    for round in 0..200 {
        let mut word = || match random.below(4) {
            0 => random.bits(),
            1 => random.below(2000),
            2 => random.between(-50.0, 50.0).to_bits(),
            _ => [0, u32::MAX, 0x7f80_0000, 0x7fc0_0000, 1, 0x8000_0000][random.below(6) as usize],
        };
        let surfaces: Vec<Surface> = (0..64)
            .map(|_| bytemuck::cast::<[u32; 14], Surface>(std::array::from_fn(|_| word())))
            .collect();
        let reservoirs: Vec<PixelReservoir> = (0..64)
            .map(|_| bytemuck::cast::<[u32; 7], PixelReservoir>(std::array::from_fn(|_| word())))
            .collect();
        let camera: Camera = bytemuck::cast::<[u32; 12], Camera>(std::array::from_fn(|_| word()));
        let map: Vec<[u32; 2]> = (0..8).map(|_| [word(), word()]).collect();
        let params = RestirParams {
            width: [0, 8, 16_777_216][round % 3],
            height: [8, 0, 64][round % 3],
            seed: word(),
            jitter: word(),
            background: [0.0; 3],
            candidates: 3,
            history: word(),
            neighbors: 5,
            radius: word(),
            spatial_pass: word(),
            remapped: word(),
            drops_occluded: word(),
        };
        let combine = Combine {
            is_unbiased: true,
            surfaces: view.surfaces,
            emitters: view.emitters,
        };
        let before = Before {
            camera: &camera,
            gbuffer: &surfaces[..32],
            reservoirs: &reservoirs[..40],
            to_current: &map,
        };
        for index in 0..surfaces.len() as u32 {
            let (surface, current) = (surfaces[index as usize], reservoirs[index as usize]);
            let merged = temporal(
                &combine,
                view.materials,
                &view.emitters,
                &before,
                &map,
                &params,
                &surface,
                current,
                index,
            );
            let spread = spatial(
                &combine,
                view.materials,
                &view.emitters,
                &surfaces,
                &reservoirs,
                &params,
                index,
            );
            for last in [merged, spread] {
                let (_, kept) = shade(&view, &params, &surface, &last, index);
                assert_eq!(kept.reservoir.sample.light, last.reservoir.sample.light);
            }
        }
    }
}
