//! A stream of small shapes of light along a knot: each flies, spins and pulses; globes breathe.

// Only the CPU moves the world, so any function does.
#![allow(clippy::disallowed_methods)]

use std::f32::consts::{PI, TAU};

use lightbvh::bvh::Swap;
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, MeshId, Rebuilder, RebuilderParams, Transform};

/// Lights of each instance.
pub const LIGHTS: u16 = 100;

/// The lights.
pub struct World {
    pub bvh: LightBvh,
    rebuilder: Rebuilder,
    shapes: [MeshId; 3],
    placed: Vec<InstanceId>,
}

impl World {
    /// Shapes, none in the world yet.
    pub fn new() -> Self {
        let mut bvh = LightBvh::default();
        let globe = shape(|part, k| globe(part, k, 1.0));
        let shapes = [globe, shape(ring), shape(ribbon)];
        let shapes = shapes.map(|lights| bvh.add_mesh(lights).expect("in the domain"));
        Self {
            bvh,
            rebuilder: Rebuilder::new(RebuilderParams {
                swap: Swap::Deterministic,
                idle: 7.0,
                ..RebuilderParams::default()
            }),
            shapes,
            placed: Vec::new(),
        }
    }

    /// Does the edits of the frame at `time`, s, with `count` instances, and refits.
    pub fn advance(&mut self, count: usize, time: f32) {
        self.rebuilder.begin_frame(&mut self.bvh).expect("its own");
        let mut edits = vec![Edit::SetLights {
            mesh: self.shapes[0],
            lights: shape(|part, k| globe(part, k, 1.0 + 0.2 * (1.3 * time).sin())),
        }];
        for (k, &instance) in (0..).zip(self.placed.iter().take(count)) {
            let (transform, radiance) = at(k, time);
            edits.push(Edit::SetTransform { instance, transform });
            edits.push(Edit::SetRadiance { instance, radiance });
        }
        for k in self.placed.len()..count {
            let (transform, radiance) = at(k as u32, time);
            edits.push(Edit::AddInstance {
                mesh: self.shapes[k % 3],
                transform,
                radiance,
                mask: u32::MAX,
            });
        }
        let kept = count.min(self.placed.len());
        edits.extend(self.placed.drain(kept..).map(Edit::RemoveInstance));
        self.placed
            .extend(self.bvh.apply(edits).expect("in the domain").instances);
        self.bvh.refit();
        self.rebuilder.end_frame(&self.bvh);
    }

    /// Indices of the instances.
    pub fn live(&self) -> impl ExactSizeIterator<Item = u32> {
        self.placed.iter().map(|own| own.index())
    }
}

/// Place and factor on radiance of instance `k`.
fn at(k: u32, time: f32) -> (Transform, [f32; 3]) {
    let number = |of: u32| unit_f32(hash(16 * k + of));
    // A (2, 3) torus knot round the middle, a tube of instances about it.
    let phase = number(0);
    let angle = TAU * phase + 0.045 * time * (0.8 + 0.4 * number(1));
    let away = 0.95 * number(2).sqrt();
    let round = TAU * number(3) + 0.2 * time;
    let reach = 2.0 + (3.0 * angle).cos() + 0.28 * away * round.cos();
    let height = 4.6 + 3.3 * (3.0 * angle).sin() + 1.1 * away * round.sin();
    let bob = 0.15 * (1.7 * time + TAU * number(4)).sin();
    let translation = [
        4.4 * reach * (2.0 * angle).cos(),
        height + bob,
        4.4 * reach * (2.0 * angle).sin(),
    ];
    let size = 0.11 + 0.15 * number(5) * number(5);
    let spin = time * (0.4 + 1.6 * number(6)) + TAU * number(7);
    let pulse = 0.62 + 0.38 * (time * (0.8 + 1.8 * number(8)) + TAU * number(9)).sin();
    let power = 3.2 * pulse * pulse;
    (
        Transform::from_trs(translation, turned(spin, TAU * number(10)), [size; 3]),
        hue(phase).map(|own| own * power),
    )
}

/// The quaternion of a turn by `spin` about an axis of azimuth `lean`, tilted from the vertical.
fn turned(spin: f32, lean: f32) -> [f32; 4] {
    let (s, c) = (0.5 * spin).sin_cos();
    [0.6 * s * lean.cos(), 0.8 * s, 0.6 * s * lean.sin(), c]
}

/// The stream's colour at a place of the knot: amber, rose, blue, and back.
fn hue(phase: f32) -> [f32; 3] {
    const STOPS: [[f32; 3]; 4] = [
        [1.0, 0.44, 0.09],
        [1.0, 0.17, 0.25],
        [0.30, 0.24, 1.0],
        [0.07, 0.62, 0.80],
    ];
    let place = phase * STOPS.len() as f32;
    let (from, part) = (place as usize, place.fract());
    let part = part * part * (3.0 - 2.0 * part);
    std::array::from_fn(|c| {
        let [a, b] = [from, from + 1].map(|stop| STOPS[stop % STOPS.len()][c]);
        a + (b - a) * part
    })
}

/// A light around `middle`, `size` wide, that shines to `front`.
fn tile(middle: [f32; 3], front: [f32; 3], size: f32, turn: f32) -> EmissiveTriangle {
    let [across, along, _] = Transform::look_along(middle, front.map(|x| -x), [0.0, 1.0, 0.0]).columns;
    let corner = |k: u8| {
        let (s, c) = (turn + TAU / 3.0 * f32::from(k)).sin_cos();
        std::array::from_fn(|i| middle[i] + size * (c * across[i] + s * along[i]))
    };
    EmissiveTriangle {
        p: [corner(0), corner(1), corner(2)],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

/// The lights of a shape.
fn shape(light: impl Fn(f32, u16) -> EmissiveTriangle) -> Vec<EmissiveTriangle> {
    let lights = (0..LIGHTS).map(|k| light(f32::from(k) / f32::from(LIGHTS), k));
    lights.collect()
}

/// Tiles spread over a sphere.
fn globe(part: f32, k: u16, radius: f32) -> EmissiveTriangle {
    let y = 1.0 - 2.0 * part - 1.0 / f32::from(LIGHTS);
    let (s, c) = (PI * (3.0 - 5.0_f32.sqrt()) * f32::from(k)).sin_cos();
    let r = (1.0 - y * y).max(0.0).sqrt();
    let front = [c * r, y, s * r];
    tile(front.map(|x| radius * x), front, 0.17, f32::from(k))
}

/// Tiles of a ring of four rows, to all sides.
fn ring(part: f32, k: u16) -> EmissiveTriangle {
    let (s, c) = (TAU * part).sin_cos();
    let (sv, cv) = (TAU * f32::from(k % 4) / 4.0).sin_cos();
    let r = 1.1 + 0.22 * cv;
    tile([c * r, 0.22 * sv, s * r], [c * cv, sv, s * cv], 0.15, 0.0)
}

/// Two strands of tiles that wind about each other.
fn ribbon(part: f32, k: u16) -> EmissiveTriangle {
    let side = if k.is_multiple_of(2) { 0.0 } else { PI };
    let (s, c) = (2.0 * TAU * part + side).sin_cos();
    tile([0.5 * c, 3.0 * part - 1.5, 0.5 * s], [c, 0.0, s], 0.17, 0.0)
}
