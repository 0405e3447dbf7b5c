//! Spheres, discs and cylinders: by formula where they shine, else as triangles.

use std::f64::consts::{PI, TAU};

use super::super::analytic::AnalyticKind;
use super::super::error::SceneError;
use super::light::Small;
use super::matrix;
use super::params::Params;
use super::shape::Surface;
use super::state::Loader;
use crate::vector::dot;

/// Facets around and along; after [`MANY`] of such shapes, fewer.
const FINE: [u32; 2] = [48, 24];
const COARSE: [u32; 2] = [16, 8];
const MANY: u32 = 1000;
/// Whole spheres that shine from both sides and are made of triangles, some 2200 each.
const SHELLS: u32 = 16;

/// Sizes that a light by formula may have, metres.
const SIZES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// The corners of a grid, and its triangles.
struct Grid {
    positions: Vec<[f32; 3]>,
    coordinates: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
}

/// A grid of points: `around` steps of an angle up to `sweep`, `along` steps of `profile`, which gives radius and z. Its front
/// is to the right of the profile's way as the angle grows: outward where z falls.
fn grid([around, along]: [u32; 2], sweep: f64, profile: impl Fn(f64) -> [f64; 2]) -> Grid {
    // Where it closes its first points are there twice: pictures begin and end there.
    let columns = around + 1;
    let (mut positions, mut coordinates) = (Vec::new(), Vec::new());
    for row in 0..=along {
        let [radius, z] = profile(f64::from(row) / f64::from(along));
        for column in 0..columns {
            let is_start = column == around && sweep >= TAU - 1e-6;
            let turned = if is_start { 0 } else { column };
            let (sine, cosine) = libm::sincos(sweep * f64::from(turned) / f64::from(around));
            positions.push([radius * cosine, radius * sine, z].map(|x| x as f32));
            // As pbrt has them: by the angle, and from the lowest or the inner edge to the other.
            let [u, v] = [
                f64::from(column) / f64::from(around),
                f64::from(row) / f64::from(along),
            ];
            coordinates.push([u as f32, (1.0 - v) as f32]);
        }
    }
    let mut triangles = Vec::new();
    for row in 0..along {
        for column in 0..around {
            let at = |row: u32, column: u32| row * columns + column;
            let [a, b, c, d] = [
                at(row, column),
                at(row + 1, column),
                at(row + 1, column + 1),
                at(row, column + 1),
            ];
            let is_point = |row: u32| profile(f64::from(row) / f64::from(along))[0].abs() < 1e-12;
            if !is_point(row + 1) {
                triangles.push([a, b, c]);
            }
            if !is_point(row) {
                triangles.push([a, c, d]);
            }
        }
    }
    Grid {
        positions,
        coordinates,
        triangles,
    }
}

impl Loader<'_> {
    /// How fine the next shape is.
    fn facets(&mut self) -> [u32; 2] {
        self.quadrics = self.quadrics.saturating_add(1);
        if self.quadrics > MANY { COARSE } else { FINE }
    }

    /// Whether a shape shines by formula: in the world, not in an object that may have instances.
    fn shines(&self) -> bool {
        let area = self.graphics.area.as_ref();
        area.is_some_and(|area| area.radiance.iter().any(|&x| x > 0.0)) && self.object.is_none()
    }

    /// How far around a shape goes, radians.
    fn sweep(&mut self, params: &Params) -> f64 {
        let degrees = params.number("phimax").unwrap_or(360.0);
        if !(0.0..=360.0).contains(&degrees) {
            self.note(
                &params.place,
                "`phimax` outside of 0 to 360 degrees is taken as the nearer of the two, as in pbrt",
            );
        }
        degrees.to_radians().clamp(0.0, TAU)
    }

    /// The lower and the upper of two ends along z.
    fn ends(&mut self, params: &Params, [low, high]: [f64; 2]) -> (f64, f64) {
        if low > high {
            self.note(
                &params.place,
                "a `zmin` above its `zmax` is exchanged with it, as in pbrt",
            );
        }
        (low.min(high), low.max(high))
    }

    /// Whether a shape has an area; what has none is left out.
    fn has_area(&mut self, params: &Params, has: bool) -> bool {
        if !has {
            self.note(&params.place, "shapes without area are left out");
        }
        has
    }

    /// Whether a whole sphere is made of triangles, for it shines inward too: the first ones, among which what surrounds a
    /// scene is.
    fn is_shell(&mut self, params: &Params, is_two_sided: bool) -> bool {
        if is_two_sided && self.shells == SHELLS {
            self.note(
                &params.place,
                "after the first 16 whole spheres that shine from both sides, others shine outward alone",
            );
            return false;
        }
        self.shells += u32::from(is_two_sided);
        is_two_sided
    }

    pub fn sphere(&mut self, params: &Params) -> Result<(), SceneError> {
        let radius = params.number("radius").unwrap_or(1.0);
        if !self.has_area(params, radius > 0.0) {
            return Ok(());
        }
        let ends = [("zmin", -radius), ("zmax", radius)]
            .map(|(name, default)| params.number(name).unwrap_or(default));
        let (low, high) = self.ends(params, ends);
        let [low, high] = [low, high].map(|z| z.clamp(-radius, radius));
        let sweep = self.sweep(params);
        if !self.has_area(params, high > low && sweep > 0.0) {
            return Ok(());
        }
        let is_whole = low == -radius && high == radius && sweep >= TAU - 1e-6;
        let size = matrix::uniform_scale(&self.graphics.ctm).map(|scale| scale * radius);
        if let (Some(size), Some(area)) = (size, self.graphics.area.clone())
            && is_whole
            && self.shines()
            && SIZES.contains(&size)
            && !self.graphics.is_reversed
            && !self.is_shell(params, area.is_two_sided)
        {
            let radiance = area.radiance_of(4.0 * PI * size * size);
            self.small.push(Small {
                name: "sphere",
                kind: AnalyticKind::Sphere { radius: size as f32 },
                at: self.graphics.ctm.columns[3],
                towards: [0.0, 0.0, -1.0],
                across: [0.0; 3],
                emission: radiance.map(f64::from),
            });
            return Ok(());
        }
        let [top, bottom] = [high, low].map(|z| libm::acos((z / radius).clamp(-1.0, 1.0)));
        let profile = |t: f64| {
            let (sine, cosine) = libm::sincos(top + (bottom - top) * t);
            [radius * sine, radius * cosine]
        };
        let facets = self.facets();
        let key = format!("sphere {radius} {low} {high} {sweep} {facets:?}");
        self.add_grid("sphere", params, key, move || grid(facets, sweep, profile))
    }

    pub fn disk(&mut self, params: &Params) -> Result<(), SceneError> {
        let [height, radius, inner] = [("height", 0.0), ("radius", 1.0), ("innerradius", 0.0)]
            .map(|(name, default)| params.number(name).unwrap_or(default));
        if !self.has_area(params, radius > 0.0) {
            return Ok(());
        }
        let inner = inner.clamp(0.0, radius);
        let sweep = self.sweep(params);
        if !self.has_area(params, inner < radius && sweep > 0.0) {
            return Ok(());
        }
        if inner == 0.0 && sweep >= TAU - 1e-6 && self.shines() && self.disc_light(height, radius) {
            return Ok(());
        }
        let around = self.facets()[0];
        let profile = |t: f64| [inner + (radius - inner) * t, height];
        let key = format!("disk {height} {radius} {inner} {sweep} {around}");
        self.add_grid("disk", params, key, move || grid([around, 1], sweep, profile))
    }

    /// A disc by formula, where the shape is one: of one side, and an ellipse whose axes are the shape's.
    fn disc_light(&mut self, height: f64, radius: f64) -> bool {
        let Some(area) = self.graphics.area.clone().filter(|area| !area.is_two_sided) else {
            return false;
        };
        let map = self.graphics.ctm;
        let [x, y, ..] = map.columns.map(|column| column.map(|x| x * radius));
        let half = [dot(x, x).sqrt(), dot(y, y).sqrt()];
        let front = matrix::normal(&map, [0.0, 0.0, 1.0]);
        let is_ellipse = dot(x, y).abs() <= 1e-4 * half[0] * half[1];
        if !is_ellipse || front == [0.0; 3] || !half.iter().all(|size| SIZES.contains(size)) {
            return false;
        }
        let sign = if self.graphics.is_reversed { -1.0 } else { 1.0 };
        let radiance = area.radiance_of(PI * half[0] * half[1]);
        self.small.push(Small {
            name: "disk",
            kind: AnalyticKind::Disc {
                half: half.map(|x| x as f32),
            },
            at: map.point([0.0, 0.0, height]),
            towards: front.map(|x| sign * x),
            across: x,
            emission: radiance.map(f64::from),
        });
        true
    }

    pub fn cylinder(&mut self, params: &Params) -> Result<(), SceneError> {
        let [radius, a, b] = [("radius", 1.0), ("zmin", -1.0), ("zmax", 1.0)]
            .map(|(name, default)| params.number(name).unwrap_or(default));
        let (low, high) = self.ends(params, [a, b]);
        let sweep = self.sweep(params);
        if !self.has_area(params, radius > 0.0 && high > low && sweep > 0.0) {
            return Ok(());
        }
        let around = self.facets()[0];
        let profile = |t: f64| [radius, high + (low - high) * t];
        let key = format!("cylinder {radius} {low} {high} {sweep} {around}");
        self.add_grid("cylinder", params, key, move || grid([around, 1], sweep, profile))
    }

    fn add_grid(
        &mut self,
        name: &str,
        params: &Params,
        key: String,
        grid: impl FnOnce() -> Grid,
    ) -> Result<(), SceneError> {
        let make = || {
            let grid = grid();
            Surface {
                positions: grid.positions,
                normals: Vec::new(),
                coordinates: grid.coordinates,
                per_light: grid.triangles.len(),
                triangles: grid.triangles,
            }
        };
        self.add(make, name.into(), Some(key), &params.place)
    }
}
