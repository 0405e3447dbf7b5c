//! The renderer over lights of every kind: known answers, the same light described by a mesh and by a formula, and every device against the
//! CPU, word for word.

use std::f64::consts::PI;
use std::sync::Arc;

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use lightbvh::light::AnyLight;
use lightbvh::light::infinite::Environment;
use lightbvh_host::backend::{
    Backend, Bvh, Combination, CpuBackend, DeviceBackend, Integrator, PIXEL_RECORD, Restir, RestirFrame,
    RestirOptions, Sampler, SceneArrays,
};
use lightbvh_host::method::{Method, Step, Target};
use lightbvh_host::scene::{
    AnalyticKind, AnalyticLight, Camera, Instances, Material, Mesh, Node, Primitive, Scene, SceneData,
    Transform,
};
use lightbvh_host::vulkan::{Device, Options};
use lightbvh_host::words::compare_words;
use lightbvh_host::workload::{RenderSettings, arrays_lit_by, build};
use lightbvh_kernels::bvh::{Kinds, WIDTH};
use lightbvh_tests::devices::on_each_device;

use crate::profiles;
use crate::textures::painted_room;

const ALBEDO: f32 = 0.5;

pub fn node(transform: Transform, mesh: Option<u32>) -> Node {
    Node {
        transform,
        mesh,
        ..Node::default()
    }
}

pub fn at(translation: [f32; 3]) -> Transform {
    Transform::Trs {
        translation,
        rotation: [0.0, 0.0, 0.0, 1.0],
        scale: [1.0; 3],
    }
}

/// Turned so that -Z points down.
pub fn down(translation: [f32; 3]) -> Transform {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    Transform::Trs {
        translation,
        rotation: [-half, 0.0, 0.0, half],
        scale: [1.0; 3],
    }
}

fn square(side: f32, material: u32) -> Mesh {
    let s = side / 2.0;
    Mesh {
        name: String::from("square"),
        primitives: vec![Primitive {
            positions: vec![[-s, 0.0, -s], [-s, 0.0, s], [s, 0.0, s], [s, 0.0, -s]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material,
            ..Primitive::default()
        }],
    }
}

/// A diffuse floor seen from above by a narrow camera, at `aim` metres from the origin along x: all pixels see about one point.
fn floor(aim: f32, lights: Vec<(Transform, AnalyticKind, f32)>) -> Scene {
    let eye = Transform::Matrix([
        [1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0],
        [aim, 1.0, 0.0],
    ]);
    let mut data = SceneData {
        name: String::from("floor"),
        nodes: vec![node(at([0.0; 3]), Some(0)), node(eye, None)],
        meshes: vec![square(50.0, 0)],
        materials: vec![Material {
            base_color: [ALBEDO; 3],
            metallic: 0.0,
            // The dielectric's lobe of 4 % is as wide as there is; its share is in the known answers' tolerance.
            roughness: 1.0,
            ..Material::default()
        }],
        cameras: vec![Camera { node: 1, yfov: 1e-4 }],
        ..SceneData::default()
    };
    for (transform, kind, intensity) in lights {
        let node_index = data.nodes.len() as u32;
        data.nodes.push(node(transform, None));
        data.analytic.push(AnalyticLight {
            name: String::from("lamp"),
            node: node_index,
            kind,
            color: [1.0; 3],
            intensity,
            range: None,
        });
    }
    Scene::new(data).expect("a sound scene")
}

pub const SETTINGS: RenderSettings = RenderSettings {
    frame: 0,
    width: 32,
    height: 32,
    samples: 64,
    seed: 5,
};

pub fn arrays(scene: &Scene, settings: &RenderSettings) -> SceneArrays<AnyLight> {
    arrays_lit_by(scene, settings.frame, settings.width, settings.height).expect("a frame")
}

/// Mean of an image, and its standard error.
pub fn mean(image: &[[f32; 3]]) -> (f64, f64) {
    let n = image.len() as f64;
    let mean = image.iter().map(|p| f64::from(p[1])).sum::<f64>() / n;
    let squares = image
        .iter()
        .map(|p| (f64::from(p[1]) - mean).powi(2))
        .sum::<f64>();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

fn rendered(scene: &Scene, sampler: Sampler, integrator: Integrator) -> (f64, f64) {
    let arrays = arrays(scene, &SETTINGS);
    let bvh: Bvh<Kinds, WIDTH> = match sampler {
        Sampler::TwoLevel => {
            Instances::<AnyLight>::new(scene, 0, BuildParams::default())
                .expect("sound")
                .0
        }
        _ => build(&arrays.lights, sampler, &BuildParams::default()),
    };
    let mut cpu = CpuBackend::<Kinds, WIDTH>::new(bvh);
    let params = SETTINGS.params([0.0; 3]);
    let image = cpu
        .render(&arrays, &params, sampler, integrator)
        .expect("an image");
    mean(&image.value)
}

/// What the floor reflects straight up of irradiance `e`: the diffuse part alone.
fn diffuse(e: f64) -> f64 {
    e * f64::from(ALBEDO) * 0.96 / PI
}

/// Irradiance at a point of the floor at `x` from below the lamp, which hangs `h` above it.
fn known(kind: AnalyticKind, h: f64, x: f64) -> f64 {
    let d = (h * h + x * x).sqrt();
    let cosine = h / d;
    match kind {
        AnalyticKind::Point => cosine / (d * d),
        AnalyticKind::Spot { inner, outer } => {
            let (ci, co) = (f64::from(inner).cos(), f64::from(outer).cos());
            let t = ((cosine - co) / (ci - co)).clamp(0.0, 1.0);
            t * t * cosine / (d * d)
        }
        // All of it above the horizon.
        AnalyticKind::Sphere { radius } => PI * f64::from(radius).powi(2) * cosine / (d * d),
        // By quadrature; the lamp's -Z points down, so both normals are vertical.
        AnalyticKind::Rectangle { half } => over(half.map(f64::from), |u, v| [u, v, 1.0], h, x),
        AnalyticKind::Disc { half } => over(
            half.map(f64::from),
            |u, v| [u, v, if u * u + v * v <= 1.0 { 1.0 } else { 0.0 }],
            h,
            x,
        ),
        AnalyticKind::Box { half } => {
            let half = half.map(f64::from);
            let n = 60;
            let step = |i: usize| 2.0 * (i as f64 + 0.5) / f64::from(n as u32) - 1.0;
            let volume = 8.0 * half[0] * half[1] * half[2] / (n as f64).powi(3);
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    for k in 0..n {
                        let p = [half[0] * step(i) - x, half[1] * step(j), h + half[2] * step(k)];
                        let squared = p.iter().map(|x| x * x).sum::<f64>();
                        sum += volume * p[2] / squared.powf(1.5);
                    }
                }
            }
            sum
        }
        AnalyticKind::Directional | AnalyticKind::Profile { .. } => unreachable!("it is not among these"),
    }
}

/// Irradiance of unit radiance from a horizontal surface of `half` sizes; `shape` says where it is.
fn over(half: [f64; 2], shape: impl Fn(f64, f64) -> [f64; 3], h: f64, x: f64) -> f64 {
    let n = 800;
    let step = |i: usize| 2.0 * (i as f64 + 0.5) / f64::from(n as u32) - 1.0;
    let area = 4.0 * half[0] * half[1] / (n as f64).powi(2);
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let [u, v, weight] = shape(step(i), step(j));
            let (dx, dz) = (half[0] * u - x, half[1] * v);
            let squared = dx * dx + dz * dz + h * h;
            sum += weight * area * h * h / (squared * squared);
        }
    }
    sum
}

const ALL: [AnalyticKind; 6] = [
    AnalyticKind::Point,
    AnalyticKind::Spot {
        inner: 0.2,
        outer: 0.7,
    },
    AnalyticKind::Sphere { radius: 0.4 },
    AnalyticKind::Rectangle { half: [0.7, 0.3] },
    AnalyticKind::Disc { half: [0.5, 0.5] },
    AnalyticKind::Box {
        half: [0.3, 0.5, 0.2],
    },
];

/// The gloss of the floor: within what `Material` may reflect beside the diffuse part, at the widest lobe.
fn gloss(e: f64) -> f64 {
    // (k + 6) / (8 pi) (n . h)^k of 4 %, k = 1.
    e * 0.04 * 7.0 / (8.0 * PI)
}

#[test]
fn each_kind_has_the_known_irradiance() {
    for kind in ALL {
        for x in [0.0, 1.1] {
            let (h, intensity) = (2.5, 3.0);
            let scene = floor(
                x as f32,
                vec![(down([0.0, h as f32, 0.0]), kind, intensity as f32)],
            );
            let e = intensity * known(kind, h, x);
            let (low, high) = (diffuse(e), diffuse(e) + gloss(e));
            for sampler in Sampler::ALL {
                for integrator in [Integrator::Direct, Integrator::Path { bounces: 1 }] {
                    let (found, error) = rendered(&scene, sampler, integrator);
                    // Five standard errors, rounding, and the box's quadrature.
                    let slack = 5.0 * error + 1e-3 * high;
                    assert!(
                        found > low - slack && found < high + slack,
                        "{kind:?} at {x} by {}, {integrator:?}: {found} ± {error}, expected {low} to {high}",
                        sampler.name()
                    );
                }
            }
        }
    }
}

/// A room with every kind of light, a mesh light and things in the way; some of the lamps are turned, scaled and mirrored.
fn room() -> Scene {
    let mut data = SceneData {
        name: String::from("room"),
        meshes: vec![square(8.0, 0), square(0.8, 1), square(1.2, 2)],
        materials: vec![
            Material {
                base_color: [0.6, 0.5, 0.4],
                double_sided: true,
                roughness: 0.4,
                ..Material::default()
            },
            Material {
                radiance: [2.0, 3.0, 1.0],
                double_sided: true,
                ..Material::default()
            },
            Material {
                base_color: [0.9; 3],
                metallic: 1.0,
                roughness: 0.2,
                ..Material::default()
            },
        ],
        ..SceneData::default()
    };
    let tilt = [0.2588, 0.1, 0.0, 0.9607];
    data.nodes = vec![
        node(at([0.0; 3]), Some(0)),
        node(down([0.0, 4.0, -4.0]), Some(0)),
        node(at([1.5, 2.5, 0.0]), Some(1)),
        node(at([-1.0, 0.8, 0.3]), Some(2)),
        node(
            Transform::Trs {
                translation: [0.5, 1.2, -1.0],
                rotation: tilt,
                scale: [1.0, 1.0, 1.0],
            },
            Some(2),
        ),
        node(at([0.0, 1.5, 6.0]), None),
    ];
    data.cameras = vec![Camera { node: 5, yfov: 0.9 }];
    for (k, kind) in (0..12).zip(ALL.into_iter().cycle()) {
        let translation = [
            -2.5 + 0.5 * k as f32,
            1.0 + 0.3 * (k % 5) as f32,
            -1.5 + 0.7 * (k % 4) as f32,
        ];
        let scale = if k < 6 { [1.0; 3] } else { [0.5, -0.7, 0.4] };
        data.nodes.push(node(
            Transform::Trs {
                translation,
                rotation: tilt,
                scale,
            },
            None,
        ));
        data.analytic.push(AnalyticLight {
            name: format!("lamp {k}"),
            node: data.nodes.len() as u32 - 1,
            kind,
            color: [1.0, 0.8, 0.3 + 0.05 * k as f32],
            intensity: 2.0,
            range: (k % 2 == 1).then_some(2.5),
        });
    }
    profiles::hang(&mut data);
    Scene::new(data).expect("a sound scene")
}

/// The room under a map and two suns.
pub fn open_room() -> Scene {
    let mut data = room().into_data();
    let colors = |[x, y, z]: [f32; 3]| [0.1 + 0.1 * x * x, 0.1 + 0.2 * y.max(0.0), 0.2 + 0.1 * z * z];
    data.environment = Some(Arc::new(Environment::from_fn(8, colors).expect("a map")));
    for (k, lean) in [0.3_f32, -0.6].into_iter().enumerate() {
        let (sine, cosine) = (0.5 * (lean - std::f32::consts::FRAC_PI_2)).sin_cos();
        data.nodes.push(node(
            Transform::Trs {
                translation: [0.0; 3],
                rotation: [sine, 0.0, 0.0, cosine],
                scale: [1.0; 3],
            },
            None,
        ));
        data.analytic.push(AnalyticLight {
            name: format!("sun {k}"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::Directional,
            color: [1.0, 0.9, 0.7],
            intensity: 0.8,
            range: None,
        });
    }
    Scene::new(data).expect("a sound scene")
}

/// The images of all samplers agree, of direct light and of paths.
#[test]
fn samplers_agree_on_every_kind() {
    agree(&open_room());
}

/// That they do on a scene.
pub fn agree(scene: &Scene) {
    let settings = RenderSettings {
        width: 48,
        height: 36,
        samples: 256,
        ..SETTINGS
    };
    let arrays = arrays(scene, &settings);
    let params = settings.params([0.05; 3]);
    for integrator in [Integrator::Direct, Integrator::Path { bounces: 3 }] {
        let images: Vec<Vec<[f32; 3]>> = Sampler::ALL
            .iter()
            .map(|&sampler| {
                let bvh: Bvh<Kinds, WIDTH> = build(&arrays.lights, sampler, &BuildParams::default());
                let mut cpu = CpuBackend::<Kinds, WIDTH>::new(bvh);
                cpu.render(&arrays, &params, sampler, integrator)
                    .expect("an image")
                    .value
            })
            .collect();
        let power = mean(&images[1]).0;
        for (sampler, image) in Sampler::ALL.iter().zip(&images) {
            // Pixel by pixel against the power sampler: noise of both is in the differences.
            let differences: Vec<[f32; 3]> = image
                .iter()
                .zip(&images[1])
                .map(|(a, b)| [0, 1, 2].map(|c| a[c] - b[c]))
                .collect();
            let (difference, error) = mean(&differences);
            assert!(
                difference.abs() <= 5.0 * error + 1e-6,
                "{} {integrator:?}: {difference} ± {error} of {power}",
                sampler.name()
            );
            // Points and boxes near surfaces have heavy tails.
            assert!(error < 0.06 * power, "too noisy to tell: {error} of {power}");
        }
    }
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
        data.meshes.push(square(1.0, 3));
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

#[test]
fn every_kind_and_paint_have_the_same_words_on_every_device() {
    // Devices compile the kernels once for both, which takes longer than all the rest.
    on_each_device(Options::default(), |device| {
        for scene in [open_room(), painted_room()] {
            same_on(device, &scene);
        }
    });
}

/// That a device has the CPU's words of a scene, by every sampler, directly, of several candidates, by paths and by ReSTIR.
fn same_on(device: &Device, scene: &Scene) {
    let settings = RenderSettings {
        width: 40,
        height: 25,
        samples: 2,
        ..SETTINGS
    };
    let arrays = Arc::new(arrays(scene, &settings));
    let params = settings.params([0.2, 0.3, 0.4]);
    let (two_level, _) = Instances::<AnyLight>::new(scene, 0, BuildParams::default()).expect("sound");
    for sampler in Sampler::ALL {
        let bvh: Bvh<Kinds, WIDTH> = match sampler {
            Sampler::TwoLevel => two_level.clone(),
            _ => build(&arrays.lights, sampler, &BuildParams::default()),
        };
        let mut cpu = CpuBackend::<Kinds, WIDTH>::new(bvh.clone());
        let mut other = DeviceBackend::<Kinds, WIDTH>::new(device, &bvh).expect("a backend");
        let candidates = [(1, 0), (6, 0), (4, 2)];
        let direct = candidates.map(|(candidates, scattered)| (Integrator::Direct, candidates, scattered));
        let paths = [1, 4].map(|bounces| (Integrator::Path { bounces }, 1, 0));
        for (integrator, candidates, scattered) in direct.into_iter().chain(paths) {
            let params = lightbvh_kernels::render::RenderParams {
                candidates,
                scattered,
                ..params
            };
            let what = format!(
                "{} by {}, {integrator:?}, {candidates} {scattered}",
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
        if sampler == Sampler::Uniform {
            continue;
        }
        for combination in [Combination::Unbiased, Combination::Biased] {
            let options = RestirOptions::new(sampler, combination);
            let (mut here, mut there) = (Restir::new(options), Restir::new(options));
            for frame in 0..3 {
                let frame = RestirFrame {
                    scene: &arrays,
                    width: settings.width,
                    height: settings.height,
                    seed: frame,
                    jitter: 0,
                    background: [0.1; 3],
                    remap: None,
                };
                let expected = cpu.restir(&mut here, &frame).expect("an image").value;
                let found = other.restir(&mut there, &frame).expect("an image").value;
                let what = format!("{} restir by {}, {combination:?}", device.name(), sampler.name());
                same(&expected, &found, &what);
            }
        }
    }
}

/// The sky of a uniform map lights an open floor as theory says, and as a background does by paths; a sun does by its cosine.
#[test]
fn skies_have_the_known_irradiance() {
    let sun = AnalyticKind::Directional;
    for angle in [0.0_f32, 0.9] {
        // Turned from straight down about x.
        let (sine, cosine) = (0.5 * (angle - std::f32::consts::FRAC_PI_2)).sin_cos();
        let transform = Transform::Trs {
            translation: [0.0; 3],
            rotation: [sine, 0.0, 0.0, cosine],
            scale: [1.0; 3],
        };
        let scene = floor(0.0, vec![(transform, sun, 2.0)]);
        let e = 2.0 * f64::from(angle).cos();
        known_light(&scene, e);
    }
    let mut data = floor(0.0, Vec::new()).into_data();
    data.environment = Some(Arc::new(Environment::from_fn(4, |_| [1.5; 3]).expect("a map")));
    known_light(&Scene::new(data).expect("sound"), 1.5 * PI);
    // A small bright patch, which both ways find: weights share it.
    let mut data = floor(0.0, Vec::new()).into_data();
    let patch = |[x, y, z]: [f32; 3]| {
        let is_bright = x > 0.2 && x < 0.4 && y > 0.7 && z.abs() < 0.1;
        [if is_bright { 200.0 } else { 0.1 }; 3]
    };
    let map = Environment::from_fn(64, patch).expect("a map");
    let mut e = 0.0;
    let n = 2000;
    for i in 0..n {
        for j in 0..4 * n {
            // Even over the hemisphere's cosine: E = π times the mean radiance.
            let (u, v) = (
                (i as f64 + 0.5) / f64::from(n),
                (j as f64 + 0.5) / f64::from(4 * n),
            );
            let (r, angle) = (u.sqrt(), 2.0 * PI * v);
            let d = [r * angle.cos(), (1.0 - u).sqrt(), r * angle.sin()].map(|x| x as f32);
            e += f64::from(map.radiance(d)[1]) * PI / (f64::from(n) * f64::from(4 * n));
        }
    }
    data.environment = Some(Arc::new(map));
    known_light(&Scene::new(data).expect("sound"), e);
}

/// That the floor reflects irradiance `e`, by every sampler, directly and by paths.
fn known_light(scene: &Scene, e: f64) {
    let (low, high) = (diffuse(e), diffuse(e) + gloss(e));
    for sampler in Sampler::ALL {
        for integrator in [Integrator::Direct, Integrator::Path { bounces: 1 }] {
            let (found, error) = rendered(scene, sampler, integrator);
            let slack = 5.0 * error + 2e-3 * high;
            assert!(
                found > low - slack && found < high + slack,
                "by {}, {integrator:?}: {found} ± {error}, expected {low} to {high}",
                sampler.name()
            );
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
    let arrays = Arc::new(arrays(&scene, &settings));
    let step = Step {
        scene: &scene,
        frame: 0,
        lights: &arrays.lights,
    };
    let mut refused = Vec::new();
    for method in Method::ALL {
        match method.recipe().runner(&step, Target::Cpu) {
            Ok(mut runner) => {
                let image = runner
                    .image(&step, &arrays, &settings, 0)
                    .expect("an image")
                    .value;
                assert!(mean(&image).0 > 0.0, "{method:?}");
            }
            Err(error) => {
                assert!(error.to_string().contains("emissive triangles alone"), "{error}");
                refused.push(method);
            }
        }
    }
    assert!(refused.len() < Method::ALL.len() / 2, "{refused:?}");
}
