//! What speed costs in accuracy: the variance of one light sample, exactly, for node layouts, widths and importance
//! models.

use std::io;
use std::time::Instant;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::node::{FullMomentNode, LeanMomentNode};
use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, FluxOverDistance, FullNode,
    ImportanceModel, LightNode, Lights, MomentNode, Moments, ShadingPoint,
};
use serde::Serialize;

use crate::cli::table;
use crate::cli::table::say;
use crate::vector::{dot, normal, sub};
use crate::workload::instance_of;

/// Lamps of the scene, triangles of each, and points where the variance is taken.
const LAMPS: u32 = 64;
const PER_LAMP: u32 = 24;
const POINTS: u32 = 200;

/// Samples by one structure, layout and importance.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    layout: &'static str,
    width: usize,
    importance: &'static str,
    structure: &'static str,
    bytes_per_light: f64,
    sample_ns: f64,
    /// Variance of the one-sample estimate of unshadowed diffuse light over its squared mean: mean over the points.
    relative_variance: f64,
}

/// Every combination.
pub(super) fn rows() -> Vec<Row> {
    let lights = lamps();
    let points = points();
    let mut rows = Vec::new();
    for two_level in [false, true] {
        let by = By {
            two_level,
            lights: &lights,
            points: &points,
        };
        rows.extend([
            by.row::<FullNode<2>, Eq4, 2>("Eq. 4"),
            by.row::<CompactNode<2>, Eq4, 2>("Eq. 4"),
            by.row::<CompactNode<4>, Eq4, 4>("Eq. 4"),
            by.row::<CompactNode<8>, Eq4, 8>("Eq. 4"),
            by.row::<CompactNode<16>, Eq4, 16>("Eq. 4"),
            by.row::<CompactNode<2>, FluxOverDistance, 2>("flux/d²"),
            by.row::<CompactNode<4>, FluxOverDistance, 4>("flux/d²"),
            by.row::<FullMomentNode<8>, Moments, 8>("moments"),
            by.row::<LeanMomentNode<8>, Moments, 8>("moments"),
            by.row::<MomentNode<4>, Moments, 4>("moments"),
            by.row::<MomentNode<8>, Moments, 8>("moments"),
            by.row::<MomentNode<16>, Moments, 16>("moments"),
            by.row::<MomentNode<8>, Defensive<Moments, 6>, 8>("moments, 1/64 uniform"),
        ]);
    }
    rows
}

/// What all rows of a structure share.
struct By<'a> {
    two_level: bool,
    lights: &'a Lights,
    points: &'a [ShadingPoint],
}

impl By<'_> {
    fn row<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        &self,
        importance: &'static str,
    ) -> Row {
        let &Self {
            two_level,
            lights,
            points,
        } = self;
        let params = BuildParams::default();
        let bvh = if two_level {
            Bvh::<N, I, W>::two_level(lights, &params)
        } else {
            Bvh::<N, I, W>::single_level(lights, &params)
        };
        let (mut variance, mut counted) = (0.0, 0);
        for point in points {
            let (mut mean, mut square) = (0.0, 0.0);
            for (i, triangle) in lights.triangles().iter().enumerate() {
                let light = diffuse(triangle, point);
                if light > 0.0 {
                    mean += light;
                    square += light * light
                        / f64::from(bvh.pmf(point, i as u32, instance_of(&bvh, lights, i as u32)));
                }
            }
            if mean > 0.0 {
                variance += square / (mean * mean) - 1.0;
                counted += 1;
            }
        }
        let times: Vec<f64> = (0..5)
            .map(|_| {
                let start = Instant::now();
                let mut sum = 0.0;
                for i in 0..20_000u32 {
                    sum += bvh.sample(&points[(i % POINTS) as usize], hash(i)).pmf;
                }
                std::hint::black_box(sum);
                start.elapsed().as_nanos() as f64 / 20_000.0
            })
            .collect();
        let mut sorted = times;
        sorted.sort_by(f64::total_cmp);
        Row {
            layout: N::NAME,
            width: W,
            importance,
            structure: if two_level { "two-level" } else { "single-level" },
            bytes_per_light: bvh.bytes() as f64 / lights.triangles().len() as f64,
            sample_ns: sorted[sorted.len() / 2],
            relative_variance: variance / f64::from(counted.max(1)),
        }
    }
}

/// Light from a triangle taken as a point at its centroid, up to a constant.
pub(super) fn diffuse(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    let normal = normal(triangle.p);
    let [a, b, c] = triangle.p.map(|vertex| vertex.map(f64::from));
    let centroid: [f64; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
    let to_light = sub(centroid, point.p.map(f64::from));
    let d_squared = dot(to_light, to_light);
    let received = dot(point.n.map(f64::from), to_light).max(0.0);
    let sent = (-dot(normal, to_light)).max(0.0);
    f64::from(triangle.luminance()) * received * sent / (d_squared * d_squared)
}

/// Round lamps in a room of 20 × 6 × 20 m: each a band of triangles facing outward, of very different flux.
fn lamps() -> Lights {
    let draw = |i: u32, k: u32| unit_f32(hash(hash(i ^ 0x00c0_ffee).wrapping_add(k)));
    let mut triangles = Vec::new();
    for lamp in 0..LAMPS {
        let center = [
            20.0 * draw(lamp, 0),
            1.0 + 5.0 * draw(lamp, 1),
            20.0 * draw(lamp, 2),
        ];
        let radius = 0.05 + 0.2 * draw(lamp, 3);
        let radiance = [0.5 + 20.0 * draw(lamp, 4) * draw(lamp, 5); 3];
        for i in 0..PER_LAMP {
            let ring = |j: u32, up: f32| {
                let angle = 2.0 * std::f32::consts::PI * (j % (PER_LAMP / 2)) as f32 / (PER_LAMP / 2) as f32;
                [
                    center[0] + radius * angle.cos(),
                    center[1] + up * radius,
                    center[2] - radius * angle.sin(),
                ]
            };
            let j = i / 2;
            let p = if i % 2 == 0 {
                [ring(j, -1.0), ring(j + 1, -1.0), ring(j, 1.0)]
            } else {
                [ring(j + 1, -1.0), ring(j + 1, 1.0), ring(j, 1.0)]
            };
            triangles.push(EmissiveTriangle {
                p,
                radiance,
                mesh: lamp,
                flags: 0,
            });
        }
    }
    Lights::new(triangles).expect("the lamps are made within the domain")
}

/// Points on the floor, the ceiling and a wall of the room.
fn points() -> Vec<ShadingPoint> {
    (0..POINTS)
        .map(|i| {
            let draw = |k: u32| unit_f32(hash(hash(i ^ 0x0bad_cafe).wrapping_add(k)));
            let (x, y, z) = (20.0 * draw(0), 7.0 * draw(1), 20.0 * draw(2));
            match i % 3 {
                0 => ShadingPoint {
                    p: [x, 0.0, z],
                    n: [0.0, 1.0, 0.0],
                },
                1 => ShadingPoint {
                    p: [x, 7.0, z],
                    n: [0.0, -1.0, 0.0],
                },
                _ => ShadingPoint {
                    p: [0.0, y, z],
                    n: [1.0, 0.0, 0.0],
                },
            }
        })
        .collect()
}

/// Prints the table.
pub(super) fn print(rows: &[Row]) -> io::Result<()> {
    if rows.is_empty() {
        return Ok(());
    }
    say!("")?;
    table::print(
        rows,
        &[
            ("layout", |r| r.layout.to_owned()),
            ("width", |r| r.width.to_string()),
            ("importance", |r| r.importance.to_owned()),
            ("structure", |r| r.structure.to_owned()),
            ("bytes/light", |r| format!("{:.1}", r.bytes_per_light)),
            ("sample ns", |r| format!("{:.0}", r.sample_ns)),
            ("relative variance", |r| format!("{:.3}", r.relative_variance)),
        ],
    )
}
