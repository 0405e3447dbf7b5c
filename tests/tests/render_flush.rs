//! No subnormal number comes up while rendering: the processor's own flush-to-zero mode changes no word. Devices that
//! flush then agree with those that do not.
#![cfg(target_arch = "x86_64")]

use lightbvh::light::{AnyLight, Light};
use lightbvh::{EmissiveTriangle, exact};
use lightbvh_host::render::{RayBvh, View, camera, power_thresholds};
use lightbvh_kernels::render::{RenderParams, path_pixel, render_pixel};
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::emitters::listed;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::Scene;
use lightbvh_kernels::shading::textures::TextureView;
use lightbvh_kernels::shading::trace::Surfaces;
use lightbvh_tests::generate::Random;
use lightbvh_tests::scenes::{self, Any};
use lightbvh_tests::soup::{in_cube, soup};
use proptest::prelude::*;

use crate::flushing::in_both;

/// Reflections of the paths.
const BOUNCES: u32 = 4;

/// All pixels by direct lighting and by paths, computed in one thread in each of the two modes.
fn rendered<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    picker: &P,
) -> [Vec<u32>; 2] {
    in_both(|| {
        (0..params.width * params.height)
            .flat_map(|pixel| {
                let pixel = std::hint::black_box(pixel);
                let direct = render_pixel(scene, camera, params, picker, pixel);
                let paths = path_pixel(scene, camera, params, BOUNCES, picker, pixel);
                [direct, paths].into_iter().flatten().map(f32::to_bits)
            })
            .collect()
    })
}

#[test]
fn the_flushing_mode_flushes() {
    let [plain, flushed] =
        in_both(|| (std::hint::black_box(f32::MIN_POSITIVE) * std::hint::black_box(0.5)).to_bits());
    assert_eq!(flushed, 0);
    assert_ne!(plain, 0);
}

/// A camera that sees what is within `size` of the origin, and what of it is computed.
fn looking(random: &mut Random, size: f32) -> (Camera, RenderParams) {
    let view = View {
        eye: [0.0, 0.0, 2.0 * size],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        forward: [0.0, 0.0, -1.0],
        yfov: 1.0,
    };
    let params = RenderParams {
        width: 16,
        height: 16,
        samples: 4,
        first: random.below(3),
        all: random.below(9),
        candidates: 1 + 3 * random.below(2),
        part: random.below(5),
        parts: random.below(7),
        seed: random.bits(),
        jitter: random.bits(),
        background: [0.0, random.unit(), 0.3],
    };
    (camera(&view, 16, 16), params)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    /// Lights of every kind.
    #[test]
    fn no_word_of_any_light_depends_on_subnormal_numbers(
        seed: u32, scale in -60_i32..26, edge in -8_i32..2, grid: bool, bright in -90_i32..90, specular: bool,
    ) {
        let random = &mut Random::new(seed);
        let size = exact::pow2(scale);
        let mut surfaces = soup(random, 40, size, size * exact::pow2(edge), grid && scale > 0);
        let shine = |random: &mut Random| in_cube(random, 1.0).map(|c| (c * c + 0.01) * exact::pow2(bright));
        let mut lights = Vec::<AnyLight>::new();
        for surface in surfaces.iter_mut().step_by(4) {
            surface.light = lights.len() as u32;
            let flags = random.below(2) * EmissiveTriangle::TWO_SIDED;
            lights.push(EmissiveTriangle { p: surface.p, radiance: shine(random), mesh: 0, flags }.into());
        }
        for _ in 0..10 {
            let place = in_cube(random, size);
            let shine = scenes::shine(random);
            let light = AnyLight::any(random, place, size * exact::pow2(edge), shine);
            lights.push(light.checked().expect("a light in the domain"));
        }
        let bvh = RayBvh::build(&surfaces).unwrap();
        let textures = TextureView { corners: &[], words: &[] };
        let Surfaces { nodes, blocks, .. } = bvh.surfaces();
        let materials = [Material {
            albedo: [0.8, exact::pow2(-110), 1e-3],
            specular: if specular { 0.5 } else { 0.0 },
            exponent_log2: seed % 17,
        }];
        let instances = listed(lights.len() as u32);
        let scene = Scene::new(nodes, blocks, &materials, &lights, &instances, textures);
        let (camera, params) = looking(random, size);
        let thresholds = power_thresholds(&lights).unwrap();
        for [plain, flushed] in [
            rendered(&scene, &camera, &params, &Uniform { count: lights.len() as u32 }),
            rendered(&scene, &camera, &params, &Power { thresholds: &thresholds }),
        ] {
            prop_assert!(plain.iter().all(|&word| f32::from_bits(word).is_finite()));
            prop_assert_eq!(plain, flushed);
        }
    }
}
