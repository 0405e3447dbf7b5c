//! Triangle shapes for the built-in scenes; all closed or one-sided with their front outward.

use glam::Vec3;

use super::transform::{normalized, trs};

const TAU: f64 = std::f64::consts::TAU;

/// A triangle list under construction.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Unit quaternion of a rotation by `angle` radians about the unit vector `axis`.
pub(super) fn rotation(axis: [f64; 3], angle: f64) -> [f32; 4] {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    [axis[0] * sine, axis[1] * sine, axis[2] * sine, cosine].map(|x| x as f32)
}

/// Point on a circle of radius one, `turn` in turns.
pub(super) fn on_circle(turn: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(turn * TAU);
    [cosine, sine]
}

impl Shape {
    pub fn new() -> Self {
        Self::default()
    }

    /// A shape in one step.
    pub fn of(draw: impl FnOnce(&mut Self) -> &mut Self) -> Self {
        std::mem::take(draw(&mut Self::default()))
    }

    fn vertex(&mut self, p: [f64; 3]) -> u32 {
        self.positions.push(p.map(|x| x as f32));
        self.positions.len() as u32 - 1
    }

    /// Four corners, counter-clockwise seen from the front.
    pub fn quad(&mut self, corners: [[f64; 3]; 4]) -> &mut Self {
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner));
        self.triangles.extend([[a, b, c], [a, c, d]]);
        self
    }

    /// An upright pane of this half size that faces +Z, or -Z where the half width is negative.
    pub fn pane(&mut self, [w, h]: [f64; 2]) -> &mut Self {
        self.quad([[-w, -h, 0.0], [w, -h, 0.0], [w, h, 0.0], [-w, h, 0.0]])
    }

    /// An axis-aligned box.
    pub fn cuboid(&mut self, min: [f64; 3], max: [f64; 3]) -> &mut Self {
        let corner: [u32; 8] = std::array::from_fn(|i| {
            self.vertex([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { max[axis] } else { min[axis] }))
        });
        for [a, b, c, d] in [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ] {
            let [a, b, c, d] = [a, b, c, d].map(|i: usize| corner[i]);
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
        self
    }

    /// A box around `centre`.
    pub fn block(&mut self, centre: [f64; 3], size: [f64; 3]) -> &mut Self {
        let half = size.map(|x| 0.5 * x);
        let min = [0, 1, 2].map(|i| centre[i] - half[i]);
        let max = [0, 1, 2].map(|i| centre[i] + half[i]);
        self.cuboid(min, max)
    }

    /// An octahedron, 8 triangles: the smallest bulb.
    pub fn octahedron(&mut self, centre: [f64; 3], radius: f64) -> &mut Self {
        let [x0, x1, y0, y1, z0, z1] = std::array::from_fn(|i| {
            let mut p = centre;
            p[i / 2] += if i % 2 == 0 { -radius } else { radius };
            self.vertex(p)
        });
        self.triangles
            .extend([[x1, y1, z1], [y1, x0, z1], [x0, y0, z1], [y0, x1, z1]]);
        self.triangles
            .extend([[y1, x1, z0], [x0, y1, z0], [y0, x0, z0], [x1, y0, z0]]);
        self
    }

    /// An icosahedron with each edge halved `level` times: 20 * 4^level triangles.
    pub fn icosphere(&mut self, centre: [f64; 3], radius: [f64; 3], level: u32) -> &mut Self {
        const T: f64 = 0.525_731_112_119_133_6;
        const U: f64 = 0.850_650_808_352_039_9;
        let corners = [
            -T, U, 0.0, T, U, 0.0, -T, -U, 0.0, T, -U, 0.0, 0.0, -T, U, 0.0, T, U, 0.0, -T, -U, 0.0, T, -U,
            U, 0.0, -T, U, 0.0, T, -U, 0.0, -T, -U, 0.0, T,
        ];
        let faces = [
            0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,
            3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1,
        ];
        let (corners, faces) = (corners.as_chunks::<3>().0, faces.as_chunks::<3>().0);
        let mut faces: Vec<[[f64; 3]; 3]> =
            faces.iter().map(|face| face.map(|i: usize| corners[i])).collect();
        for _ in 0..level {
            faces = faces.into_iter().flat_map(halve_edges).collect();
        }
        for face in faces {
            let [a, b, c] = face.map(|p| self.vertex([0, 1, 2].map(|i| centre[i] + radius[i] * p[i])));
            self.triangles.push([a, b, c]);
        }
        self
    }

    /// An upright cylinder or cone frustum with a top and a bottom: 4 * `sides` triangles.
    pub fn cylinder(&mut self, base: [f64; 3], radii: [f64; 2], height: f64, sides: u32) -> &mut Self {
        let mut ring = |y: f64, radius: f64| -> Vec<u32> {
            let point = |i: u32| {
                let [c, s] = on_circle(f64::from(i) / f64::from(sides));
                self.vertex([base[0] + radius * c, base[1] + y, base[2] - radius * s])
            };
            (0..sides).map(point).collect()
        };
        let (low, high) = (ring(0.0, radii[0]), ring(height, radii[1]));
        let bottom = self.vertex(base);
        let top = self.vertex([base[0], base[1] + height, base[2]]);
        for i in 0..sides as usize {
            let j = (i + 1) % sides as usize;
            self.triangles
                .extend([[low[i], low[j], high[j]], [low[i], high[j], high[i]]]);
            self.triangles
                .extend([[bottom, low[j], low[i]], [top, high[i], high[j]]]);
        }
        self
    }

    /// A torus around the z axis: 2 * `around` * `across` triangles.
    pub fn torus(&mut self, centre: [f64; 3], radius: f64, tube: f64, around: u32, across: u32) -> &mut Self {
        let first = self.positions.len() as u32;
        for i in 0..around {
            let [c, s] = on_circle(f64::from(i) / f64::from(around));
            for j in 0..across {
                let [tc, ts] = on_circle(f64::from(j) / f64::from(across));
                let r = radius + tube * tc;
                self.vertex([centre[0] + r * c, centre[1] + r * s, centre[2] + tube * ts]);
            }
        }
        for i in 0..around {
            for j in 0..across {
                let at = |i: u32, j: u32| first + (i % around) * across + j % across;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        self
    }

    /// A beam of square section from `a` to `b`.
    pub fn beam(&mut self, a: [f64; 3], b: [f64; 3], thickness: f64) -> &mut Self {
        let along = [0, 1, 2].map(|i| b[i] - a[i]);
        let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
        // The quaternion that turns +Y to `along`: half way between the two directions.
        let [x, y, z] = along.map(|x| x / length);
        let turn = if y > -0.999_999 {
            normalized([z, 0.0, -x, 1.0 + y])
        } else {
            [1.0, 0.0, 0.0, 0.0]
        };
        let mut beam = Self::new();
        beam.cuboid(
            [-0.5 * thickness, 0.0, -0.5 * thickness],
            [0.5 * thickness, length, 0.5 * thickness],
        );
        self.append(&beam, a, turn)
    }

    /// Adds a copy of `other`, turned and then moved.
    pub fn append(&mut self, other: &Self, at: [f64; 3], turn: [f64; 4]) -> &mut Self {
        let map = trs(at, turn, [1.0; 3]);
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions.iter().map(|&p| {
            map.transform_point3(Vec3::from(p).as_dvec3())
                .as_vec3()
                .to_array()
        }));
        self.triangles.extend(
            other
                .triangles
                .iter()
                .map(|triangle| triangle.map(|vertex| vertex + first)),
        );
        self
    }

    /// Adds a copy of `other`, turned about +Y by `heading` radians and then moved.
    pub fn place(&mut self, other: &Self, at: [f64; 3], heading: f64) -> &mut Self {
        self.append(other, at, rotation([0.0, 1.0, 0.0], heading).map(f64::from))
    }
}

/// One triangle on the unit sphere becomes four.
fn halve_edges([a, b, c]: [[f64; 3]; 3]) -> [[[f64; 3]; 3]; 4] {
    let middle = |p: [f64; 3], q: [f64; 3]| super::transform::unit_or([0, 1, 2].map(|i| p[i] + q[i]), p);
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
}
