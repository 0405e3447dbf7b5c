//! The renderer over lights of every kind: known answers, and every device against the CPU, word for word.

mod devices;
mod known;

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use lightbvh::light::AnyLight;
use lightbvh_host::backend::{
    Backend, Bvh, CpuBackend, DeviceBackend, Integrator, PIXEL_RECORD, Sampler, SceneArrays,
};
use lightbvh_host::scene::{
    AnalyticKind, AnalyticLight, Camera, Instances, Material, Node, Scene, SceneData, Transform,
};
use lightbvh_host::vulkan::{Device, Options};
use lightbvh_host::words::compare_words;
use lightbvh_host::workload::{arrays_lit_by, build, render_params};
use lightbvh_kernels::bvh::{AnyKind, WIDTH};
use lightbvh_kernels::render::RenderParams;
use lightbvh_tests::devices::on_each_device;

use crate::textures::{sheet, textured_room};

const ALL: [AnalyticKind; 5] = [
    AnalyticKind::Point,
    AnalyticKind::Spot {
        inner: 0.2,
        outer: 0.7,
    },
    AnalyticKind::Sphere { radius: 0.4 },
    AnalyticKind::Rectangle { half: [0.7, 0.3] },
    AnalyticKind::Disc { half: [0.5, 0.5] },
];

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

pub fn arrays(scene: &Scene, params: &RenderParams) -> SceneArrays<AnyLight> {
    arrays_lit_by(scene, 0, params.width, params.height).expect("a frame")
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

/// A room with every kind of light, a mesh light and things in the way; some of the lamps are turned, scaled and mirrored.
pub fn room() -> Scene {
    let mut data = SceneData {
        name: String::from("room"),
        meshes: vec![sheet(8.0, 0), sheet(0.8, 1), sheet(1.2, 2)],
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
    for (k, kind) in (0..10).zip(ALL.into_iter().cycle()) {
        let translation = [
            -2.5 + 0.5 * k as f32,
            1.0 + 0.3 * (k % 5) as f32,
            -1.5 + 0.7 * (k % 4) as f32,
        ];
        let scale = if k < 5 { [1.0; 3] } else { [0.5, -0.7, 0.4] };
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
    Scene::new(data).expect("a sound scene")
}

/// That the images of all samplers agree, of direct light and of paths.
#[test]
fn samplers_agree_on_every_kind_and_texture() {
    let params = render_params((48, 36), 256, 5, [0.05; 3]);
    let arrays = arrays(&textured_room(), &params);
    for integrator in [Integrator::Direct, Integrator::Path { bounces: 3 }] {
        let images: Vec<Vec<[f32; 3]>> = Sampler::ALL
            .iter()
            .map(|&sampler| {
                let bvh: Bvh<AnyKind, WIDTH> = build(&arrays.lights, sampler, &BuildParams::default());
                let mut cpu = CpuBackend::<AnyKind, WIDTH>::new(bvh);
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
            // Points near surfaces have heavy tails.
            assert!(error < 0.06 * power, "too noisy to tell: {error} of {power}");
        }
    }
}
