//! The lamps, and the picture of them.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, LightBvh, MeshId, Transform};

use crate::{Image, Result, SIZE};

pub const LAMPS: u32 = 1024;

// As in `path.wgsl`.
const CELLS: f32 = 12.0;
const PITCH: f32 = 10.0;
const EYE: [f32; 3] = [50.3, 8.6, 1.0];
const FORWARD: [f32; 3] = [0.36, -0.29, 0.85];

/// In [0, 1), of a thing and a question.
fn unit(thing: u32, question: u32) -> f32 {
    unit_f32(hash(thing ^ hash(question)))
}

/// A lamp of unit radius: two pyramids of five sides, base to base.
pub fn lamp() -> Vec<EmissiveTriangle> {
    let corner = |k: u8| {
        let (z, x) = (f32::from(k) * std::f32::consts::TAU / 5.0).sin_cos();
        [x, 0.0, z]
    };
    let [up, down] = [1.3, -1.3].map(|y| [0.0, y, 0.0]);
    let sides = (0..5).flat_map(|k| [[corner(k), up, corner(k + 1)], [corner(k + 1), down, corner(k)]]);
    let radiance = [1.0; 3];
    sides
        .map(|p| EmissiveTriangle {
            p,
            radiance,
            mesh: 0,
            flags: 0,
        })
        .collect()
}

/// Where lamp `k` is after `time` seconds: it drifts along a street, and turns.
pub fn place(k: u32, time: f32) -> Transform {
    let street = (1.0 + (CELLS - 1.0) * unit(k, 0)).floor() * PITCH;
    let across = street + 2.6 * (unit(k, 1) - 0.5);
    let along = (unit(k, 2) * CELLS * PITCH + (unit(k, 3) - 0.5) * time).rem_euclid(CELLS * PITCH);
    let height = 0.8 + 8.0 * unit(k, 4);
    let [x, z] = if k % 2 == 0 {
        [along, across]
    } else {
        [across, along]
    };
    let (sin, cos) = (unit(k, 6) * 3.0 + 0.5 * time).sin_cos();
    Transform::from_trs(
        [x, height, z],
        [0.0, sin, 0.0, cos],
        [0.12 + 0.16 * unit(k, 7); 3],
    )
}

/// White, red, blue and amber.
fn colour(k: u32) -> [f32; 3] {
    let [warm, cool] = [[1.0, 0.7, 0.38], [1.0, 0.25, 0.22]];
    [
        warm,
        cool,
        [0.25, 0.75, 0.95],
        [1.0, 0.55, 0.18],
        [1.0, 0.42, 0.12],
    ][k as usize % 5]
}

/// Dim lamps, and a few bright ones: radiances from 6 to 384 W/(m² sr).
pub fn added(mesh: MeshId, k: u32) -> Edit {
    let power = 6.0 * (6.0 * unit(k, 8)).exp2();
    Edit::AddInstance {
        mesh,
        transform: place(k, 0.0),
        radiance: colour(k).map(|part| part * power),
        mask: u32::MAX,
    }
}

/// Each light, its instance, and the sum of the powers before it in parts of 2^32: `Listed` in `path.wgsl`.
pub fn listed(bvh: &LightBvh) -> Vec<[u32; 3]> {
    let power = |own: &EmissiveTriangle| {
        let edge = |to: [f32; 3]| [0, 1, 2].map(|k| f64::from(to[k] - own.p[0][k]));
        let (u, v) = (edge(own.p[1]), edge(own.p[2]));
        let area = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| (u[i] * v[j] - u[j] * v[i]).powi(2));
        let [red, green, blue] = own.radiance.map(f64::from);
        area.iter().sum::<f64>().sqrt() * (0.2126 * red + 0.7152 * green + 0.0722 * blue)
    };
    let lights = bvh.view().world_lights();
    let all: f64 = lights.iter().map(power).sum();
    let mut below = 0.0;
    let with_sum = |(light, own): (u32, &EmissiveTriangle)| {
        let at = (below / all * 4_294_967_296.0) as u32;
        below += power(own);
        // The `mesh` of a light in the world is the index of its instance.
        [light, own.mesh, at]
    };
    (0..).zip(&lights).map(with_sum).collect()
}

/// The lamps that the camera sees, as rhombs: radiance, and how much of a pixel they cover.
fn drawn(behind: &Image) -> Image {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: [f32; 3]| a.map(|part| part / dot(a, a).sqrt());
    let forward = unit(FORWARD);
    let right = unit([-forward[2], 0.0, forward[0]]);
    let up = [0, 1, 2].map(|k| {
        (if k == 1 { 1.0 } else { 0.0 } - forward[1] * forward[k])
            / dot(right, [-forward[2], 0.0, forward[0]])
    });
    let seen = |k: u32| {
        let own = place(k, 1.0);
        let to = [0, 1, 2].map(|k| own.translation[k] - EYE[k]);
        let scale = SIZE[0] as f32 / 1.3 / dot(to, forward);
        let [x, y] = [(dot(to, right), SIZE[0]), (-dot(to, up), SIZE[1])]
            .map(|(at, side)| 0.5 * side as f32 + scale * at);
        (dot(to, forward), x, y, scale * own.columns[1][1], colour(k))
    };
    let mut lamps: Vec<_> = (0..LAMPS).map(seen).filter(|own| own.0 > 0.5).collect();
    // Farther ones first.
    lamps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut image = vec![[0.0; 4]; behind.len()];
    for (depth, x, y, radius, [red, green, blue]) in lamps {
        let range = |at: f32, side: u32| {
            let end = |by: f32| (at + by).clamp(0.0, side as f32) as u32;
            end(-2.0 * radius - 1.0)..end(2.0 * radius + 2.0)
        };
        for (column, row) in
            range(y, SIZE[1]).flat_map(|row| range(x, SIZE[0]).map(move |column| (column, row)))
        {
            let [across, along] =
                [(column, x), (row, y)].map(|(at, middle)| (at as f32 + 0.5 - middle).abs());
            let covered = (0.5 + 0.7 * (radius - across - along / 1.3)).clamp(0.0, 1.0) * radius.min(1.0);
            let own = &mut image[(row * SIZE[0] + column) as usize];
            if depth < behind[(row * SIZE[0] + column) as usize][3] {
                let lamp = [4.0 * red, 4.0 * green, 4.0 * blue, 1.0];
                *own = std::array::from_fn(|k| own[k] * (1.0 - covered) + lamp[k] * covered);
            }
        }
    }
    image
}

/// Writes images side by side, with the lamps before them, in sRGB.
pub fn write(path: &std::path::Path, images: &[&Image]) -> Result<()> {
    let lamps = drawn(images[0]);
    let mut picture = image::RgbImage::new(SIZE[0] * images.len() as u32, SIZE[1]);
    for (x, y, own) in picture.enumerate_pixels_mut() {
        let pixel = (y * SIZE[0] + x % SIZE[0]) as usize;
        let (behind, lamp) = (images[(x / SIZE[0]) as usize][pixel], lamps[pixel]);
        own.0 = [0, 1, 2].map(|k| {
            let light = 0.5 * (behind[k] * (1.0 - lamp[3]) + lamp[k]);
            // K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016.
            let shown = (light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14);
            (255.0 * shown.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8
        });
    }
    Ok(picture.save(path)?)
}
