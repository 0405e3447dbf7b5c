//! What is painted on surfaces: pictures against an oracle, known answers of each texture, and every device against the CPU, word for word.

use std::f64::consts::PI;
use std::sync::Arc;

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_host::backend::{
    Backend, Bvh, Combination, CpuBackend, Integrator, Restir, RestirFrame, RestirOptions, Sampler,
};
use lightbvh_host::scene::{
    AnalyticKind, AnalyticLight, Camera, IN_PLACE, Instances, Material, Mesh, Node, Opacity, Paint, Picture,
    Primitive, Scene, SceneData, Texture, Transform, Wrap,
};
use lightbvh_host::workload::build;
use lightbvh_kernels::bvh::{Kinds, WIDTH};
use lightbvh_kernels::shading::picture::{Picture as Words, PictureWords};
use lightbvh_kernels::shading::skin::{HEADER_WORDS, SRGB_WORDS};

use lightbvh_tests::gltf_files::read_json;

use crate::gltf_surfaces::textured;
use crate::kinds_render::{SETTINGS, agree, arrays, at, down, mean, node, open_room};

/// What a painted floor reflects of the light that falls on it: its diffuse part, and at most this of gloss.
const GLOSS: f64 = 0.04 * 7.0 / 8.0;

const PLAIN: Paint = Paint::PLAIN;

const fn lying(picture: u32, is_color: bool) -> Texture {
    Texture {
        picture,
        is_color,
        is_nearest: true,
        wrap: [Wrap::Clamp; 2],
        transform: IN_PLACE,
    }
}

fn picture(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Picture {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Picture {
        width,
        height,
        texels: Arc::new(texels.flat_map(|(x, y)| texel(x, y)).collect()),
    }
}

fn painted(paint: Paint) -> Material {
    Material {
        base_color: [0.5; 3],
        radiance: paint.radiance,
        double_sided: true,
        paint: Some(paint),
        ..Material::default()
    }
}

/// A square in the plane y = 0 with its front up, whose texture coordinates go from 0 to 1 along x and z.
fn sheet(side: f32, material: u32) -> Mesh {
    let s = side / 2.0;
    Mesh {
        name: String::from("sheet"),
        primitives: vec![Primitive {
            positions: vec![[-s, 0.0, -s], [-s, 0.0, s], [s, 0.0, s], [s, 0.0, -s]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material,
            coordinates: Some(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]),
            ..Primitive::default()
        }],
    }
}

/// A floor that reflects half of all light diffusely, seen from straight above from height `eye`, `aim` metres from the origin along x.
fn floor(paint: Paint, pictures: Vec<Picture>, [aim, eye]: [f32; 2]) -> SceneData {
    let above = Transform::Matrix([
        [1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0],
        [aim, eye, 0.0],
    ]);
    SceneData {
        name: String::from("painted floor"),
        nodes: vec![node(at([0.0; 3]), Some(0)), node(above, None)],
        meshes: vec![sheet(40.0, 0)],
        materials: vec![painted(paint)],
        pictures,
        cameras: vec![Camera { node: 1, yfov: 1e-4 }],
        ..SceneData::default()
    }
}

fn add(data: &mut SceneData, transform: Transform, kind: AnalyticKind, intensity: f32) {
    data.nodes.push(node(transform, None));
    data.analytic.push(AnalyticLight {
        name: String::from("lamp"),
        node: data.nodes.len() as u32 - 1,
        kind,
        color: [1.0; 3],
        intensity,
        range: None,
    });
}

/// Shines along this direction.
pub fn along(d: [f64; 3]) -> Transform {
    // -Z of the node points along `d`; the other axes are any.
    let z = d.map(|x| -x);
    let other = if z[1].abs() < 0.9 {
        [0.0, 1.0, 0.0]
    } else {
        [1.0, 0.0, 0.0]
    };
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let x = unit(cross(other, z));
    let y = cross(z, x);
    let column = |v: [f64; 3]| v.map(|x| x as f32);
    Transform::Matrix([column(x), column(y), column(unit(z)), [0.0; 3]])
}

/// Every way to render the scene: the mean of each channel, and its standard error.
fn images(scene: &Scene) -> Vec<(String, [f64; 3], [f64; 3])> {
    let arrays = Arc::new(arrays(scene, &SETTINGS));
    let mut found = Vec::new();
    let mut keep = |what: String, image: &[[f32; 3]]| {
        // Of each channel alone.
        let of = |k: usize| mean(&image.iter().map(|p| [p[k]; 3]).collect::<Vec<_>>());
        let (means, errors) = ([0, 1, 2].map(|k| of(k).0), [0, 1, 2].map(|k| of(k).1));
        found.push((what, means, errors));
    };
    for sampler in Sampler::ALL {
        let bvh: Bvh<Kinds, WIDTH> = match sampler {
            Sampler::TwoLevel => Instances::new(scene, 0, BuildParams::default()).expect("sound").0,
            _ => build(&arrays.lights, sampler, &BuildParams::default()),
        };
        let mut cpu = CpuBackend::<Kinds, WIDTH>::new(bvh);
        for (integrator, candidates, scattered) in [
            (Integrator::Direct, 1, 0),
            (Integrator::Direct, 4, 2),
            (Integrator::Path { bounces: 1 }, 1, 0),
        ] {
            let params = lightbvh_kernels::render::RenderParams {
                candidates,
                scattered,
                ..SETTINGS.params([0.0; 3])
            };
            let image = cpu
                .render(&arrays, &params, sampler, integrator)
                .expect("an image");
            keep(
                format!("{} {integrator:?} {candidates} {scattered}", sampler.name()),
                &image.value,
            );
        }
        if sampler == Sampler::Uniform {
            continue;
        }
        let options = RestirOptions {
            // Pixels that share samples have no standard error of their own.
            history: 0,
            spatial_passes: 0,
            ..RestirOptions::new(sampler, Combination::Unbiased)
        };
        let mut sum = vec![[0.0_f32; 3]; (SETTINGS.width * SETTINGS.height) as usize];
        let images = 64;
        for seed in 0..images {
            let frame = RestirFrame {
                scene: &arrays,
                width: SETTINGS.width,
                height: SETTINGS.height,
                seed,
                jitter: seed,
                background: [0.0; 3],
                remap: None,
            };
            let image = cpu
                .restir(&mut Restir::new(options), &frame)
                .expect("an image")
                .value;
            for (sum, pixel) in sum.iter_mut().zip(&image) {
                *sum = [0, 1, 2].map(|k| sum[k] + pixel[k] / images as f32);
            }
        }
        keep(format!("{} restir", sampler.name()), &sum);
    }
    found
}

/// A floor that reflects half of all light, `aim` metres from the origin along x seen from above.
pub fn plain_floor(aim: f32) -> SceneData {
    let mut data = floor(PLAIN, Vec::new(), [aim, 12.0]);
    data.materials[0] = Material {
        paint: None,
        metallic: 0.0,
        roughness: 1.0,
        ..data.materials[0].clone()
    };
    data
}

/// That every way finds `light`, up to a `share` of it, reflected by this albedo and no more gloss than there may be, in each channel; `light`
/// is irradiance.
pub fn reflects(data: SceneData, light: [f64; 3], albedo: [f64; 3], share: f64) {
    let scene = Scene::new(data).expect("a sound scene");
    assert!(scene.has_kinds());
    for (what, means, errors) in images(&scene) {
        for k in 0..3 {
            let error = errors[k];
            let low = 0.96 * albedo[k] * light[k] / PI;
            let high = low + GLOSS * light[k] / PI;
            let slack = 5.0 * error + (2e-3 + share) * high + 1e-6;
            assert!(
                means[k] > low - slack && means[k] < high + slack,
                "{what}: channel {k} is {} ± {error}, expected {low} to {high}",
                means[k]
            );
        }
    }
}

/// A picture is what an oracle says it is, wherever coordinates lie, in every way to go on beyond its edges.
#[test]
fn pictures_are_the_mean_of_four_texels() {
    let (width, height) = (5_u32, 3_u32);
    let texel = |x: u32, y: u32| hash(x + 17 * y);
    let header = (HEADER_WORDS + SRGB_WORDS) as usize;
    let decoded: Vec<f64> = (0..256).map(|byte| f64::from(byte) / 300.0).collect();
    for (columns, rows) in [0, 1, 2].iter().flat_map(|&a| [0, 1, 2].map(|b| (a, b))) {
        for flags in [0, PictureWords::SRGB, PictureWords::NEAREST] {
            let mut words = vec![0; HEADER_WORDS as usize];
            words.extend(decoded.iter().map(|&x| (x as f32).to_bits()));
            assert_eq!(words.len(), header);
            let own = PictureWords {
                width,
                height,
                flags: flags | (columns << PictureWords::WRAP_COLUMNS) | (rows << PictureWords::WRAP_ROWS),
                transform: [0.5, 0.25, -0.125, 1.5, 0.375, -0.25],
                texels: header as u32 + PictureWords::COUNT,
            };
            words.extend_from_slice(bytemuck::cast_slice(&[own]));
            words.extend((0..height).flat_map(|y| (0..width).map(move |x| texel(x, y))));
            let shown = Words {
                words: &words,
                at: header as u32,
            };
            for k in 0..2000_u32 {
                let random = |n: u32| f64::from(hash(3 * k + n)) / f64::from(u32::MAX);
                // Multiples of 2^-10, so that the oracle starts from the same coordinates.
                let uv = [0, 1].map(|n| ((random(n) * 8.0 - 4.0) * 1024.0).round() / 1024.0);
                let x = 0.5 * uv[0] - 0.125 * uv[1] + 0.375;
                let y = 0.25 * uv[0] + 1.5 * uv[1] - 0.25;
                let cell = |i: f64, size: u32, wrap: u32| -> u32 {
                    let size = f64::from(size);
                    match wrap {
                        PictureWords::REPEAT => i.rem_euclid(size) as u32,
                        PictureWords::CLAMP => i.clamp(0.0, size - 1.0) as u32,
                        _ => {
                            let i = i.rem_euclid(2.0 * size);
                            if i < size {
                                i as u32
                            } else {
                                (2.0 * size - 1.0 - i) as u32
                            }
                        }
                    }
                };
                let number = |byte: u32, is_color: bool| {
                    if is_color && flags == PictureWords::SRGB {
                        decoded[byte as usize]
                    } else {
                        f64::from(byte) / 255.0
                    }
                };
                let (sx, sy) = (x * f64::from(width), y * f64::from(height));
                let mut expected = [0.0; 4];
                if flags == PictureWords::NEAREST {
                    let word = texel(cell(sx.floor(), width, columns), cell(sy.floor(), height, rows));
                    expected = [0, 1, 2, 3].map(|c| number((word >> (8 * c)) & 255, c < 3));
                } else {
                    let (left, top) = ((sx - 0.5).floor(), (sy - 0.5).floor());
                    let (a, b) = (sx - 0.5 - left, sy - 0.5 - top);
                    for (dx, dy, weight) in [
                        (0.0, 0.0, (1.0 - a) * (1.0 - b)),
                        (1.0, 0.0, a * (1.0 - b)),
                        (0.0, 1.0, (1.0 - a) * b),
                        (1.0, 1.0, a * b),
                    ] {
                        let word = texel(cell(left + dx, width, columns), cell(top + dy, height, rows));
                        for (c, sum) in expected.iter_mut().enumerate() {
                            *sum += weight * number((word >> (8 * c)) & 255, c < 3);
                        }
                    }
                }
                let found = shown.at(uv.map(|x| x as f32));
                let found = [found.r, found.g, found.b, found.a].map(f64::from);
                for c in 0..4 {
                    assert!(
                        (found[c] - expected[c]).abs() < 2e-5,
                        "{columns} {rows} {flags} at {x} {y}: {found:?}, expected {expected:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn base_colours_are_those_of_the_texels() {
    // Left and right of the middle: encoded 188 is 0.5029 linear, 255 is 1.
    let colors = picture(2, 1, |x, _| {
        if x == 0 {
            [188, 0, 255, 255]
        } else {
            [0, 188, 188, 255]
        }
    });
    let half = 0.502_886_5;
    for (aim, albedo) in [
        (-1.0, [0.4 * half, 0.0, 0.6]),
        (1.0, [0.0, 0.8 * half, 0.6 * half]),
    ] {
        let paint = Paint {
            base: [0.4, 0.8, 0.6, 1.0],
            base_texture: Some(lying(0, true)),
            ..PLAIN
        };
        let mut data = floor(paint, vec![colors.clone()], [aim, 1.0]);
        let d = [0.6, -0.8, 0.0];
        add(&mut data, along(d), AnalyticKind::Directional, 2.0);
        reflects(data, [1.6; 3], albedo, 0.0);
    }
}

#[test]
fn metal_and_roughness_are_those_of_the_texels() {
    // Metal keeps its colour in the diffuse part that the white gloss leaves: 1 - luminance.
    let numbers = picture(
        2,
        1,
        |x, _| if x == 0 { [9, 255, 255, 9] } else { [9, 255, 0, 9] },
    );
    for (aim, is_metal) in [(-1.0, true), (1.0, false)] {
        let paint = Paint {
            base: [0.5, 0.5, 0.5, 1.0],
            metallic: 1.0,
            rough_texture: Some(lying(0, false)),
            ..PLAIN
        };
        let mut data = floor(paint, vec![numbers.clone()], [aim, 1.0]);
        add(&mut data, along([0.6, -0.8, 0.0]), AnalyticKind::Directional, 2.0);
        let scene = Scene::new(data).expect("sound");
        // (k + 6) / (8 pi) (n . h)^k with k = 1: n . h of a light at 36.9 degrees is the cosine of half of that.
        let lobe = 7.0 / (8.0 * PI) * (0.5_f64 * 0.8_f64.acos()).cos();
        let specular = if is_metal { 0.5 } else { 0.04 };
        let expected = 1.6 * (0.5 * (1.0 - specular) / PI + specular * lobe);
        for (what, means, errors) in images(&scene) {
            let error = errors[1];
            assert!(
                (means[1] - expected).abs() < 5.0 * error + 1e-3 * expected,
                "{what} {is_metal}: {} ± {error}, expected {expected}",
                means[1]
            );
        }
    }
}

#[test]
fn normals_bend_as_gltf_says() {
    // Red to the right, green up, which is against the second coordinate: towards -z here.
    for map in [[204, 128, 204], [52, 128, 204], [128, 204, 204], [128, 52, 204]] {
        let numbers = picture(1, 1, |_, _| [map[0], map[1], map[2], 255]);
        let paint = Paint {
            base: [0.5, 0.5, 0.5, 1.0],
            bump: 1.0,
            base_texture: None,
            bump_texture: Some(lying(0, false)),
            ..PLAIN
        };
        let [x, y, z] = map.map(|byte| f64::from(byte) / 255.0 * 2.0 - 1.0);
        let length = (x * x + y * y + z * z).sqrt();
        let n = [x / length, z / length, -y / length];
        for d in [[0.6, -0.8, 0.0], [0.0, -0.8, 0.6], [0.0, -1.0, 0.0]] {
            let mut data = floor(paint, vec![numbers.clone()], [1.0, 1.0]);
            add(&mut data, along(d), AnalyticKind::Directional, 2.0);
            let cosine: f64 = -(0..3).map(|k| n[k] * d[k]).sum::<f64>();
            reflects(data, [2.0 * cosine.max(0.0); 3], [0.5; 3], 0.0);
        }
    }
}

/// A lamp above a sheet above the floor: what of it arrives at `aim`, where its ray crosses the sheet at half of that.
fn behind(sheet_paint: Paint, pictures: Vec<Picture>, aim: f32) -> SceneData {
    let paint = Paint {
        base: [0.5, 0.5, 0.5, 1.0],
        ..PLAIN
    };
    let mut data = floor(paint, pictures, [aim, 1.0]);
    data.materials.push(painted(sheet_paint));
    if sheet_paint.is_clear() {
        data.materials[1].transmission = sheet_paint.transmission;
    }
    data.meshes.push(sheet(8.0, 1));
    data.nodes.push(node(at([0.0, 2.0, 0.0]), Some(1)));
    add(&mut data, at([0.0, 4.0, 0.0]), AnalyticKind::Point, 30.0);
    data
}

/// Irradiance of that lamp without the sheet.
fn open(aim: f64) -> f64 {
    30.0 * 4.0 / (16.0 + aim * aim).powf(1.5)
}

#[test]
fn what_is_cut_out_hides_nothing() {
    let halves = picture(2, 1, |x, _| [255, 255, 255, if x == 0 { 255 } else { 100 }]);
    let cut = Paint {
        base_texture: Some(lying(0, true)),
        opacity: Opacity::Cut(0.5),
        ..PLAIN
    };
    reflects(
        behind(cut, vec![halves.clone()], 1.0),
        [open(1.0); 3],
        [0.5; 3],
        0.0,
    );
    reflects(behind(cut, vec![halves], -1.0), [0.0; 3], [0.5; 3], 0.0);
}

#[test]
fn what_is_blended_hides_its_part() {
    let halves = picture(2, 1, |x, _| [255, 255, 255, if x == 0 { 255 } else { 51 }]);
    let blended = Paint {
        base: [1.0, 1.0, 1.0, 0.5],
        base_texture: Some(lying(0, true)),
        opacity: Opacity::Blended,
        ..PLAIN
    };
    // A fifth of a half is there.
    reflects(
        behind(blended, vec![halves.clone()], 1.0),
        [0.9 * open(1.0); 3],
        [0.5; 3],
        0.0,
    );
    reflects(
        behind(blended, vec![halves], -1.0),
        [0.5 * open(1.0); 3],
        [0.5; 3],
        0.0,
    );
}

#[test]
fn glass_tints() {
    let glass = Paint {
        base: [1.0, 0.5, 0.25, 1.0],
        transmission: 0.8,
        ..PLAIN
    };
    reflects(
        behind(glass, Vec::new(), 1.0),
        [0.8, 0.4, 0.2].map(|tint| tint * open(1.0)),
        [0.5; 3],
        0.0,
    );
}

/// The floor seen through a sheet: tinted by glass, covered in part by what is blended, and not at all by what is cut out.
#[test]
fn eyes_see_what_is_behind() {
    let blended = Paint {
        base: [0.0, 0.0, 0.0, 0.25],
        opacity: Opacity::Blended,
        ..PLAIN
    };
    let glass = Paint {
        base: [1.0, 0.5, 0.25, 1.0],
        transmission: 0.8,
        ..PLAIN
    };
    let cut = Paint {
        base: [1.0, 1.0, 1.0, 0.25],
        opacity: Opacity::Cut(0.5),
        ..PLAIN
    };
    for (paint, tint) in [(blended, [0.75; 3]), (glass, [0.8, 0.4, 0.2]), (cut, [1.0; 3])] {
        let mut data = behind(paint, Vec::new(), 1.0);
        // Black where it is seen itself, but for a gloss.
        data.materials[1].base_color = [0.0; 3];
        // The lamp stands between the floor and the sheet, so that no shadow falls; the eye is above the sheet.
        let lamp = data.nodes.len() - 1;
        data.nodes[lamp].transform = at([0.0, 1.0, 0.0]);
        data.nodes[1].transform = Transform::Matrix([
            [1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0],
            [0.0, 1.0, 0.0],
            [1.0, 3.0, 0.0],
        ]);
        let e = 30.0 / 2.0_f64.powf(1.5);
        let scene = Scene::new(data).expect("sound");
        for (what, means, errors) in images(&scene) {
            for k in 0..3 {
                let error = errors[k];
                let low = 0.96 * 0.5 * e / PI * tint[k];
                let high = low + GLOSS * e / PI * tint[k];
                // Which rays the sheet stops is even among 1024 pixels: a standard error of that is in it.
                let slack = 5.0 * error + 2e-3 * high;
                assert!(
                    means[k] > low - slack && means[k] < high + slack,
                    "{what} {paint:?}: channel {k} is {} ± {error}, expected {low} to {high}",
                    means[k]
                );
            }
        }
    }
}

/// A sheet that glows as a picture says lights the floor as the integral over it, whatever its means are.
#[test]
fn pictures_glow() {
    let texels = |x: u32, y: u32| -> [u8; 4] {
        let bright = hash(x + 4 * y) & 3 == 0;
        let word = hash(100 + x + 4 * y);
        let level = |shift: u32| if bright { ((word >> shift) & 255) as u8 } else { 0 };
        [level(0), level(8), level(16), 255]
    };
    let paint = Paint {
        radiance: [3.0, 5.0, 2.0],
        glow_texture: Some(lying(0, false)),
        ..PLAIN
    };
    // Without a picture of the glow each triangle has its own; another texture changes nothing of that.
    for (opacity, covered, is_shown) in [
        (Opacity::Opaque, 1.0, true),
        (Opacity::Blended, 0.5, true),
        (Opacity::Blended, 0.5, false),
    ] {
        let own = [[0.3_f32, 0.2, 0.1], [0.1, 0.2, 0.6]];
        let paint = Paint {
            glow_texture: paint.glow_texture.filter(|_| is_shown),
            bump_texture: Some(lying(0, false)).filter(|_| !is_shown),
            base: [0.5, 0.5, 0.5, if covered < 1.0 { 0.5 } else { 1.0 }],
            opacity,
            ..paint
        };
        let (side, h, aim) = (2.0, 1.5, 0.4);
        let floor_paint = Paint {
            base: [0.5, 0.5, 0.5, 1.0],
            ..PLAIN
        };
        let mut data = floor(floor_paint, vec![picture(4, 4, texels)], [aim as f32, 1.0]);
        data.materials.push(painted(paint));
        // The mean of each triangle is any: it chooses lights, and the picture says what they send.
        let mut lamp = sheet(side as f32, 1);
        lamp.primitives[0].radiance = Some(own.to_vec());
        data.meshes.push(lamp);
        // Turned about x: its front looks down, its second coordinate grows towards -z.
        data.nodes.push(Node {
            transform: Transform::Trs {
                translation: [0.0, h as f32, 0.0],
                rotation: [1.0, 0.0, 0.0, 0.0],
                scale: [1.0; 3],
            },
            mesh: Some(1),
            ..Node::default()
        });
        let mut e = [0.0; 3];
        let n = 400;
        for i in 0..n {
            for j in 0..n {
                let (u, v) = ((i as f64 + 0.5) / f64::from(n), (j as f64 + 0.5) / f64::from(n));
                let texel = texels((4.0 * u) as u32, (4.0 * v) as u32);
                let (x, z) = (side * (u - 0.5), -side * (v - 0.5));
                let squared = (x - aim).powi(2) + z * z + h * h;
                let area = side * side / f64::from(n * n);
                for k in 0..3 {
                    let radiance = match is_shown {
                        true => f64::from(paint.radiance[k]) * f64::from(texel[k]) / 255.0,
                        // Places on the diagonal are half in each.
                        false if i == j => 0.5 * f64::from(own[0][k] + own[1][k]),
                        false => f64::from(own[usize::from(v < u)][k]),
                    };
                    e[k] += covered * radiance * area * h * h / (squared * squared);
                }
            }
        }
        reflects(data, e, [0.5; 3], 0.0);
    }
}

/// The room of all kinds, with paint of every sort.
pub fn painted_room() -> Scene {
    let mut data = open_room().into_data();
    let noise = picture(8, 8, |x, y| hash(x + 8 * y).to_le_bytes());
    let bumps = picture(4, 4, |x, y| {
        let word = hash(7 + x + 4 * y);
        [100 + (word & 63) as u8, 100 + ((word >> 8) & 63) as u8, 230, 255]
    });
    data.pictures = vec![noise, bumps];
    let smooth = |picture, is_color, wrap| Texture {
        is_nearest: false,
        wrap: [wrap; 2],
        transform: [[2.4, -1.8], [1.2, 1.6], [0.1, 0.2]],
        ..lying(picture, is_color)
    };
    data.materials[0].paint = Some(Paint {
        base: [0.9, 0.8, 0.7, 1.0],
        base_texture: Some(smooth(0, true, Wrap::Repeat)),
        bump: 0.8,
        bump_texture: Some(smooth(1, false, Wrap::Mirror)),
        ..PLAIN
    });
    data.materials[1].paint = Some(Paint {
        base: [1.0, 1.0, 1.0, 0.8],
        radiance: [2.0, 3.0, 1.0],
        base_texture: Some(smooth(0, true, Wrap::Clamp)),
        glow_texture: Some(smooth(0, true, Wrap::Mirror)),
        opacity: Opacity::Blended,
        ..PLAIN
    });
    data.materials[2].paint = Some(Paint {
        metallic: 1.0,
        base_texture: Some(smooth(0, true, Wrap::Repeat)),
        rough_texture: Some(smooth(0, false, Wrap::Repeat)),
        opacity: Opacity::Cut(0.4),
        ..PLAIN
    });
    data.materials.push(Material {
        base_color: [0.9, 0.6, 0.5],
        transmission: 0.9,
        double_sided: true,
        paint: Some(Paint {
            base: [0.9, 0.6, 0.5, 1.0],
            base_texture: Some(smooth(0, true, Wrap::Repeat)),
            transmission: 0.9,
            ..PLAIN
        }),
        ..Material::default()
    });
    for primitive in data.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        primitive.coordinates = Some(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]);
    }
    let glass = data.materials.len() as u32 - 1;
    data.meshes.push(sheet(2.5, glass));
    let mesh = data.meshes.len() as u32 - 1;
    data.nodes.push(node(at([-0.5, 1.9, 0.5]), Some(mesh)));
    data.nodes.push(node(down([0.4, 1.0, 2.0]), Some(mesh)));
    Scene::new(data).expect("a sound scene")
}

#[test]
fn samplers_agree_on_what_is_painted() {
    agree(&painted_room());
}

/// A painted scene that is written and read again is painted as it was, and shows the same image.
#[test]
fn paint_survives_a_file() {
    let scene = painted_room();
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    assert!(back.data().is_painted());
    let of = |scene: &Scene| {
        let materials = scene.data().materials.iter();
        materials.map(|own| own.paint).collect::<Vec<_>>()
    };
    for (own, other) in of(&scene).iter().zip(of(&back)) {
        let (own, mut other) = (own.expect("painted"), other.expect("painted"));
        let near = |a: Option<Texture>, b: &mut Option<Texture>| {
            if let (Some(a), Some(b)) = (a, b.as_mut()) {
                let [x, y] = [a.transform, b.transform].map(|t| t.as_flattened().to_vec());
                assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-6), "{x:?} {y:?}");
                b.transform = a.transform;
            }
        };
        near(own.base_texture, &mut other.base_texture);
        near(own.rough_texture, &mut other.rough_texture);
        near(own.bump_texture, &mut other.bump_texture);
        near(own.glow_texture, &mut other.glow_texture);
        if own.bump_texture.is_none() {
            other.bump = own.bump;
        }
        // Means of textures are chosen by; what they are of is equal.
        assert_eq!(own, other);
    }
    assert_eq!(scene.data().pictures, back.data().pictures);
    let coordinates = |scene: &Scene| -> Vec<_> {
        let meshes = scene.data().meshes.iter();
        let primitives = meshes.flat_map(|mesh| &mesh.primitives);
        primitives
            .map(|own| {
                let uv = own.coordinates.as_ref().expect("coordinates");
                own.triangles
                    .iter()
                    .map(|t| t.map(|v| uv[v as usize]))
                    .collect::<Vec<_>>()
            })
            .collect()
    };
    assert_eq!(coordinates(&scene), coordinates(&back));
}

/// The flux of a triangle that glows by a picture is that of an integral over it, to a hundredth, however it lies.
#[test]
fn textured_flux_is_an_integral() {
    let (width, height) = (37_u32, 19_u32);
    let texel = |x: u32, y: u32| hash(x + 64 * y).to_le_bytes();
    let png = {
        let pixels = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
        let mut bytes = std::io::Cursor::new(Vec::new());
        pixels
            .write_to(&mut bytes, image::ImageFormat::Png)
            .expect("encoded");
        bytes.into_inner()
    };
    let linear = |byte: u8| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.04045 {
            x / 12.92
        } else {
            ((x + 0.055) / 1.055).powf(2.4)
        }
    };
    for corners in [
        [[0.1, 0.2], [0.9, 0.3], [0.2, 0.8]],
        [[-1.3, 0.4], [2.7, 0.9], [0.3, 3.1]],
        [[0.51, 0.52], [0.53, 0.52], [0.51, 0.55]],
    ] {
        let root = textured(corners, &png);
        let mut root = root;
        root["samplers"] = serde_json::json!([{ "magFilter": 9729 }]);
        let scene = read_json(&root).expect("sound");
        let found = scene.frame(0).emissive[0].radiance;
        let mut sum = [0.0; 3];
        let n = 1500;
        for i in 0..n {
            for j in 0..n - i {
                let (v, w) = ((i as f64 + 0.5) / f64::from(n), (j as f64 + 0.5) / f64::from(n));
                let at = |k: usize| {
                    let [a, b, c] = corners.map(|corner| f64::from(corner[k]));
                    a + (b - a) * v + (c - a) * w
                };
                let (x, y) = (at(0) * f64::from(width) - 0.5, at(1) * f64::from(height) - 0.5);
                let (left, top) = (x.floor(), y.floor());
                for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                    let weight = (1.0 - (x - left - dx).abs()) * (1.0 - (y - top - dy).abs());
                    let wrap = |i: f64, size: u32| i.rem_euclid(f64::from(size)) as u32;
                    let rgb = texel(wrap(left + dx, width), wrap(top + dy, height));
                    for k in 0..3 {
                        sum[k] += weight * linear(rgb[k]);
                    }
                }
            }
        }
        let count = f64::from(n) * f64::from(n + 1) / 2.0;
        let factor = scene.data().materials[0].radiance;
        for k in 0..3 {
            let expected = sum[k] / count * f64::from(factor[k]);
            let ratio = f64::from(found[k]) / expected;
            assert!((ratio - 1.0).abs() < 0.01, "{corners:?} channel {k}: {ratio}");
        }
    }
}

/// Files say what cannot be shown, and what stands for it is what is said.
#[test]
fn what_cannot_be_shown_has_what_stands_for_it() {
    let png = lightbvh_tests::gltf_files::png_white_black();
    let left = [[0.1, 0.1], [0.3, 0.1], [0.1, 0.9]];
    let file = || textured(left, &png);
    let material = |root: &serde_json::Value, index: usize| -> Material {
        read_json(root).expect("sound").data().materials[index].clone()
    };
    // A cutoff that no opacity reaches.
    let mut root = file();
    root["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({ "baseColorTexture": { "index": 0 } });
    root["materials"][0]["alphaMode"] = "MASK".into();
    root["materials"][0]["alphaCutoff"] = 2.0.into();
    assert_eq!(
        material(&root, 0).paint.expect("painted").opacity,
        Opacity::Cut(2.0)
    );
    root["materials"][0]["alphaCutoff"] = 0.5.into();
    assert_eq!(
        material(&root, 0).paint.expect("painted").opacity,
        Opacity::Opaque
    );
    // Without coordinates means stand for textures.
    let attributes = &mut root["meshes"][0]["primitives"][0]["attributes"];
    attributes.as_object_mut().expect("a list").remove("TEXCOORD_0");
    let scene = read_json(&root).expect("sound");
    let own = scene.data().meshes[0].primitives[0].material as usize;
    let plain = &scene.data().materials[own];
    assert!(
        plain.paint.is_none() && (plain.base_color[0] - 0.5).abs() < 1e-6,
        "{plain:?}"
    );
    // What glows by a picture that is not there does not, whatever it reflects.
    let mut root = file();
    root["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({ "baseColorFactor": [0, 0, 0, 1] });
    root["images"][0] = serde_json::json!({ "uri": "nowhere.png" });
    assert!(read_json(&root).expect("sound").frame(0).emissive.is_empty());
    // A map that turns over, and a colour that is shown as it is, in part.
    let mut root = file();
    root["materials"] = serde_json::json!([{
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 1.0, 0.25, 0.25],
            "baseColorTexture": {
                "index": 0,
                "extensions": { "KHR_texture_transform": { "scale": [1.0, -1.0], "offset": [0.25, 0.5] } },
            },
        },
        "extensions": { "KHR_materials_unlit": {} },
    }]);
    let scene = read_json(&root).expect("sound");
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    let paint = |scene: &Scene| scene.data().materials[0].paint.expect("painted");
    assert_eq!(paint(&scene).radiance, [0.5, 1.0, 0.25]);
    assert_eq!(paint(&scene), paint(&back));
}
