//! Lights of every kind and size, and scenes of them at the ends of the domain: at one place or far apart, in maps that shrink and
//! stretch them.

use lightbvh::light::{AnyLight, DiscLight, PointLight, RectangleLight, SphereLight, SpotLight};
use lightbvh::node::Node;
use lightbvh::{Bvh, EmissiveTriangle, ShadingPoint, Transform, exact};

use crate::generate::{Random, extreme_triangle, log_uniform};
use crate::placing;

/// Lights of a type.
pub trait Any: Sized {
    /// One about `p`, of lengths of about `size` metres, of this radiance or intensity.
    fn any(random: &mut Random, p: [f32; 3], size: f32, shine: [f32; 3]) -> Self;
    /// A triangle anywhere in the domain.
    fn extreme(random: &mut Random) -> Self;
}

/// Some lengths are none, or the same but for some units in the last place.
fn vector(random: &mut Random, size: f32) -> [f32; 3] {
    [0; 3].map(|_| match random.below(6) {
        0 => 0.0,
        1 => size * (1.0 + f32::EPSILON * random.below(3) as f32),
        2 => -size,
        _ => random.between(-size, size),
    })
}

/// Radiance or intensity: zero, or of any size.
pub fn shine(random: &mut Random) -> [f32; 3] {
    [0; 3].map(|_| match random.below(4) {
        0 => 0.0,
        1 => log_uniform(random, -100, 99),
        _ => random.between(0.1, 5.0),
    })
}

impl Any for EmissiveTriangle {
    fn any(random: &mut Random, p: [f32; 3], size: f32, shine: [f32; 3]) -> Self {
        let add = |by: [f32; 3]| [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
        Self {
            p: [p, add(vector(random, size)), add(vector(random, size))],
            radiance: shine,
            mesh: 0,
            flags: random.below(2) * Self::TWO_SIDED,
        }
    }

    fn extreme(random: &mut Random) -> Self {
        extreme_triangle(random)
    }
}

impl Any for AnyLight {
    fn any(random: &mut Random, p: [f32; 3], size: f32, shine: [f32; 3]) -> Self {
        let (flags, mesh) = (random.below(2) * EmissiveTriangle::TWO_SIDED, 0);
        let half = [0; 2].map(|_| vector(random, size));
        let axis = random.direction();
        let range = match random.below(3) {
            0 => (8.0 * size).clamp(exact::pow2(-20), exact::pow2(40)),
            _ => 0.0,
        };
        let cos_outer = random.between(-1.0, 0.99);
        match random.below(6) {
            0 => EmissiveTriangle::any(random, p, size, shine).into(),
            1 => PointLight {
                p,
                intensity: shine,
                range,
                mesh,
            }
            .into(),
            2 => SpotLight {
                p,
                intensity: shine,
                axis,
                cos_inner: random.between(cos_outer, 1.0),
                cos_outer,
                range,
                mesh,
            }
            .into(),
            3 => SphereLight {
                p,
                radius: size.clamp(exact::pow2(-60), exact::pow2(39)),
                radiance: shine,
                mesh,
            }
            .into(),
            4 => RectangleLight {
                p,
                half,
                radiance: shine,
                mesh,
                flags,
            }
            .into(),
            _ => DiscLight {
                p,
                half,
                radiance: shine,
                mesh,
                flags,
            }
            .into(),
        }
    }

    fn extreme(random: &mut Random) -> Self {
        extreme_triangle(random).into()
    }
}

/// 2^-99 to 2^37: any, about 1, the least, or such that a square is about the least normal number.
fn size(random: &mut Random) -> f32 {
    match random.below(4) {
        0 => log_uniform(random, -99, 36),
        1 => log_uniform(random, -99, -80),
        2 => log_uniform(random, -66, -40),
        _ => log_uniform(random, -4, 4),
    }
}

/// A map whose sums cancel: of two columns to one unit in the last place.
fn cancelling(random: &mut Random) -> [[f32; 3]; 3] {
    let c = log_uniform(random, -50, 4);
    let almost = -c * (1.0 + f32::EPSILON * random.below(3) as f32);
    let third = [0.0, c, c * exact::pow2(-40)][random.below(3) as usize];
    [[c, c, 0.0], [almost, c, 0.0], [0.0, almost, third]]
}

/// Any map, of any scale.
fn transform(random: &mut Random) -> Transform {
    let reach = match random.below(3) {
        0 => 0.0,
        1 => size(random),
        _ => 30.0,
    };
    let kind = placing::kind(random);
    let mut map = placing::transform(random, kind, reach);
    match random.below(4) {
        0 => {
            let scale = log_uniform(random, -60, 20);
            map.columns = map.columns.map(|column| column.map(|x| x * scale));
        }
        1 => map.columns = cancelling(random),
        _ => {}
    }
    map
}

/// A scene, and lengths that occur in it.
///
/// # Panics
/// If a light is out of the domain.
pub fn scene<N: Node<W>, const W: usize>(random: &mut Random) -> (Bvh<(N, ()), W>, Vec<f32>)
where
    N::Light: Any,
{
    let mut bvh = Bvh::<(N, ()), W>::default();
    let mut sizes = vec![1.0];
    for _ in 0..1 + random.below(4) {
        // Lights of one place, about each other, or farther apart than they are large.
        let (own, apart) = (size(random), [0.0, 1.0, 30.0][random.below(3) as usize]);
        let (count, first) = ([1, 2, 9, 40][random.below(4) as usize], vector(random, own));
        let lights = (0..count).map(|_| {
            if random.below(8) == 0 {
                return N::Light::extreme(random);
            }
            let by = vector(random, (apart * own).min(exact::pow2(38)));
            let (place, shine) = ([0, 1, 2].map(|k: usize| first[k] + by[k]), shine(random));
            N::Light::any(random, place, own, shine)
        });
        let lights = lights.collect();
        sizes.push(own);
        let mesh = bvh.add_mesh(lights).expect("lights in the domain");
        for _ in 0..random.below(6) {
            // Maps that bring lights out of the domain are refused.
            let _ = bvh.add_instance(mesh, transform(random));
        }
    }
    bvh.refit();
    (bvh, sizes)
}

/// A unit direction, or zero; one in four about along an axis.
pub fn normal(random: &mut Random) -> [f32; 3] {
    match random.below(4) {
        0 => [0.0; 3],
        1 => {
            let tiny =
                [0; 2].map(|_| log_uniform(random, -99, -12) * [0.0, 1.0, -1.0][random.below(3) as usize]);
            [tiny[0], 1.0, tiny[1]]
        }
        _ => random.direction(),
    }
}

/// A point near what is in the scene, in a volume one time in four.
///
/// # Panics
/// If it is out of the domain.
pub fn point(random: &mut Random, sizes: &[f32]) -> ShadingPoint {
    let size = sizes[random.below(sizes.len() as u32) as usize] * [0.0, 1.0, 30.0][random.below(3) as usize];
    let n = normal(random);
    let p = vector(random, size.min(exact::pow2(39)));
    ShadingPoint { p, n }.checked().expect("a point in the domain")
}
