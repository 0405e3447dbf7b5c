//! What instances say of their meshes in the world against the same in `f64`.

extern crate std;

use glam::Vec3;

use super::Instance;
use crate::Transform;
use crate::bounds::LightBounds;
use crate::exact::pow2;
use crate::kit::{Random, Wide, cross, dot, narrow, normalize, times, triangle, wide};
use crate::moments::LightMoments;
use crate::point::ShadingPoint;

/// The columns of a map, and those of its inverse transposed.
struct Map {
    columns: [Wide; 3],
    normals: [Wide; 3],
}

impl Map {
    fn of(columns: [Vec3; 3]) -> Self {
        let columns = columns.map(wide);
        let [a, b, c] = columns;
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, cofactors[0]);
        Self {
            columns,
            normals: cofactors.map(|column| times(column, 1.0 / determinant)),
        }
    }

    fn determinant(&self) -> f64 {
        dot(self.columns[0], cross(self.columns[1], self.columns[2]))
    }

    fn by(columns: &[Wide; 3], v: Wide) -> Wide {
        [0, 1, 2].map(|k| columns[0][k] * v[0] + columns[1][k] * v[1] + columns[2][k] * v[2])
    }

    /// The map of normals of about unit length.
    fn normal(&self, v: Wide) -> Wide {
        let norm: f64 = self.normals.iter().map(|&column| dot(column, column)).sum();
        times(Self::by(&self.normals, v), (3.0 / norm).sqrt())
    }
}

/// A map that stretches each axis by up to `stretch`.
fn map(random: &mut Random, stretch: f32) -> ([Vec3; 3], Map) {
    loop {
        let columns = [(); 3].map(|()| random.vector() * (1.0 + random.unit() * stretch));
        let map = Map::of(columns);
        if map.determinant().abs() > 0.05 {
            return (columns, map);
        }
    }
}

fn placed(columns: [Vec3; 3], translation: Vec3, radiance: f32) -> Instance {
    Transform {
        columns: columns.map(|column| column.to_array()),
        translation: translation.to_array(),
    }
    .instance(radiance)
}

#[track_caller]
fn near(found: f32, expected: f64, size: f64, what: &str) {
    let off = (f64::from(found) - expected).abs();
    assert!(off <= 2e-5 * size, "{what}: {found:e}, expected {expected:e}");
}

/// Σ = va (1 − aaᵀ) + vn aaᵀ becomes AΣAᵀ; the mean normal, the factor on areas and the box are mapped.
#[test]
fn moments_in_the_world() {
    let mut random = Random(1);
    let mut squashed = 0;
    for turn in 0..4000 {
        let size = pow2((turn % 41) - 20);
        let (columns, map) = map(&mut random, if turn % 3 == 0 { 20.0 } else { 1.0 });
        let translation = random.vector() * size;
        let radiance = 0.5 + random.unit();
        let instance = placed(columns, translation, radiance);
        let axis = normalize(wide(random.vector()));
        let length = 0.05 + 0.95 * random.unit();
        let local = LightMoments {
            phi: 1.0 + random.unit(),
            c: random.vector() * size,
            across: random.unit() * size,
            along: random.unit() * size,
            m: Vec3::from_array(axis.map(|x| x as f32)) * length,
            h: Vec3::new(random.unit(), random.unit(), random.unit()) * size,
        };
        let found = instance.moments_to_world(&local);

        let greatest = map
            .columns
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let reach = 4.0 * greatest * f64::from(size);
        let (va, vn) = (f64::from(local.across).powi(2), f64::from(local.along).powi(2));
        let mapped = map.normal(axis);
        let world_axis = normalize(mapped);
        let norm: f64 = map.columns.iter().map(|&column| dot(column, column)).sum();
        let stretched = Map::by(&map.columns, axis);
        let total = va * norm + (vn - va) * dot(stretched, stretched);
        let back = map.columns.map(|column| dot(column, world_axis));
        let along = va * dot(back, back) + (vn - va) * dot(back, axis).powi(2);
        // Roots of differences: as exact as the squares are.
        let squares = reach * reach / 8.0;
        near(found.along * found.along, along, squares, "along");
        near(
            found.across * found.across,
            0.5 * (total - along),
            squares,
            "across",
        );
        let m_squared = f64::from(length).powi(2);
        let area = 1.0 + m_squared * (dot(mapped, mapped).sqrt() - 1.0);
        squashed += i32::from(area < 0.5);
        let phi = f64::from(local.phi) * f64::from(instance.flux) * area;
        near(found.phi, phi, phi, "flux");
        let center = Map::by(&map.columns, wide(local.c));
        let box_of = |k: usize| -> f64 {
            (0..3)
                .map(|j| map.columns[j][k].abs() * f64::from(local.h[j]))
                .sum()
        };
        for k in 0..3 {
            near(found.c[k], center[k] + f64::from(translation[k]), reach, "centre");
            near(found.m[k], world_axis[k] * f64::from(length), 4.0, "normal");
            near(found.h[k], box_of(k), reach, "half extent");
        }
    }
    assert!(squashed > 100, "{squashed}");
}

/// A map keeps a cone where it keeps the length of its axis within a hundredth of the square; else the cone is all directions.
#[test]
fn cones_stay_where_lengths_stay() {
    let mut random = Random(7);
    let (mut kept, mut opened) = (0, 0);
    for turn in 0..2000 {
        let (columns, map) = if turn % 2 == 0 {
            map(&mut random, 1.0)
        } else {
            let columns = random.axes().map(|v| narrow(times(v, 3.0)));
            (columns, Map::of(columns))
        };
        let instance = placed(columns, Vec3::new(0.0, 0.0, 0.0), 1.0);
        let axis = normalize(wide(random.vector()));
        let (center, half) = (
            random.vector(),
            Vec3::new(random.unit(), random.unit(), random.unit()),
        );
        let local = LightBounds {
            min: center - half,
            max: center + half,
            axis: Vec3::from_array(axis.map(|x| x as f32)),
            cos_theta_o: 0.75,
            phi: 1.0,
        };
        let found = instance.bounds_to_world(&local);
        let mapped = map.normal(axis);
        let squared = dot(mapped, mapped);
        if (squared - 1.0).abs() < 0.0099 {
            kept += 1;
            assert_eq!(found.cos_theta_o, 0.75, "{squared}");
        } else if (squared - 1.0).abs() > 0.0101 {
            opened += 1;
            assert_eq!(found.cos_theta_o, -1.0, "{squared}");
        }
        let center = Map::by(&map.columns, wide(center));
        for k in 0..3 {
            near(found.axis[k], normalize(mapped)[k], 4.0, "axis");
            let reach: f64 = (0..3).map(|j| map.columns[j][k].abs() * f64::from(half[j])).sum();
            near(found.min[k], center[k] - reach, 8.0, "box");
            near(found.max[k], center[k] + reach, 8.0, "box");
        }
    }
    assert!(kept > 1000 && opened > 900, "{kept} {opened}");
}

/// Normals of the mesh's space are of unit length whatever the map's size, down to where its entries count as zero, and places come
/// back.
#[test]
fn points_come_back() {
    let mut random = Random(13);
    for exponent in [-42, -40, -20, -11, -3, 0, 2, 20, 38] {
        let (columns, map) = map(&mut random, 1.0);
        let (size, p) = (pow2(exponent), random.vector());
        let instance = placed(columns.map(|c| c * size), random.vector(), 1.0);
        let n = normalize(wide(random.vector()));
        let point = ShadingPoint {
            p: p.to_array(),
            n: n.map(|x| x as f32),
        };
        let expected = normalize(map.columns.map(|column| dot(column, n)));
        let found = instance.to_local(&point);
        let back = instance.vertex(found.p);
        for k in 0..3 {
            near(found.n[k], expected[k], 1.0, "normal");
            near(back[k], p[k].into(), 4.0, "place");
        }
    }
}

/// A volume stays one, and a map that loses the normal makes one: its lights then count on both sides of the horizon.
#[test]
fn normals_that_are_lost() {
    let up = |n| ShadingPoint {
        p: [3.0, 4.0, 5.0],
        n,
    };
    let flat = placed([Vec3::X, Vec3::ZERO, Vec3::Z], Vec3::Y, 1.0);
    assert_eq!(flat.to_local(&up([0.0, 1.0, 0.0])).n, [0.0; 3]);
    let slanted = flat.to_local(&up([0.6, 0.8, 0.0])).n;
    near(slanted[0], 1.0, 1.0, "normal");
    assert_eq!(slanted[1..], [0.0; 2]);
    for columns in [[Vec3::X, Vec3::ZERO, Vec3::Z], map(&mut Random(4), 1.0).0] {
        assert_eq!(placed(columns, Vec3::Y, 1.0).to_local(&up([0.0; 3])).n, [0.0; 3]);
    }
}

/// Radiance in the world: scaled and kept within its range, zero where the triangle, its channel or the instance has none, and
/// where the mesh's triangle has no area, though rounding gives it some in the world.
#[test]
fn radiance_in_the_world() {
    use crate::light::{EmissiveTriangle, Light, MAX_RADIANCE, MIN_RADIANCE};
    let of_colors = |radiance: [f32; 3], factor: [f32; 3]| {
        let triangle = EmissiveTriangle {
            radiance,
            ..triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        };
        let instance = Transform::IDENTITY.instance_by(factor, true);
        triangle.in_world(&instance, 7).radiance
    };
    let of = |radiance, factor| of_colors(radiance, [factor; 3]);
    assert_eq!(of([1.0, 0.0, 3.0], 0.5), [0.5, 0.0, 1.5]);
    assert_eq!(of_colors([1.0, 2.0, 3.0], [0.0, 0.5, 2.0]), [0.0, 1.0, 6.0]);
    assert_eq!(of([1.0, 2.0, 3.0], 0.0), [0.0; 3]);
    assert_eq!(of([0.0; 3], 2.0), [0.0; 3]);
    let [least, most] = crate::bvh::RADIANCE_FACTORS;
    assert_eq!(of([MIN_RADIANCE, 0.0, 1.0], least), [MIN_RADIANCE, 0.0, least]);
    assert_eq!(of([MAX_RADIANCE, 0.0, 1.0], most), [MAX_RADIANCE, 0.0, most]);

    // A line in the mesh, which the map's rounding bends.
    let line = triangle([[0.0; 3], [0.1, 0.2, 0.3], [0.2, 0.4, 0.6]]);
    assert_eq!(LightBounds::of_triangle(&line).phi, 0.0);
    let mut random = Random(5);
    let mut bent = 0;
    for _ in 0..100 {
        let (columns, _) = map(&mut random, 1.0);
        let world = line.in_world(&placed(columns, random.vector(), 1.0), 0);
        assert_eq!(world.radiance, [0.0; 3]);
        bent += u32::from(LightBounds::of_triangle(&triangle(world.p)).phi > 0.0);
    }
    assert!(bent > 10, "{bent}");
}

#[test]
fn direction_that_a_map_loses_stays() {
    let flat = placed([Vec3::X, Vec3::Y, Vec3::ZERO], Vec3::ZERO, 1.0);
    assert_eq!(flat.direction_to_world(Vec3::Z), Vec3::Z);
}
