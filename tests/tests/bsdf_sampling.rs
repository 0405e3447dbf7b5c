//! Sampled directions have exactly the density that is told of them; reflectances add no energy and are reciprocal.

use glam::{DVec3, Vec3};
use lightbvh_kernels::shading::lobe::about;
use lightbvh_kernels::shading::material::Material;
use lightbvh_tests::generate::Random;
use lightbvh_tests::statistics::{chi_squared, chi_squared_quantile};
use std::f64::consts::{PI, TAU};

/// Chance that a right sampler fails one comparison.
const TAIL: f64 = 1e-7;

fn material(albedo: f32, specular: f32, exponent_log2: u32) -> Material {
    Material {
        albedo: [albedo, 0.5 * albedo, 0.0],
        specular,
        exponent_log2,
    }
}

fn draw3(random: &mut Random) -> [f32; 3] {
    [random.unit(), random.unit(), random.unit()]
}

/// Polar angle by its cosine, and azimuth.
fn direction(cosine: f64, turns: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).sqrt();
    DVec3::new(sine * (turns * TAU).cos(), sine * (turns * TAU).sin(), cosine)
}

/// The density of [`Material::sample`] above the surface, in f64 and by the formulas: `share` of the directions mirror
/// `wo` in a half vector of density `k / (2 pi) cos^(k-1)`, the others have `cos / pi`.
fn density(wi: DVec3, wo: DVec3, share: f64, k: f64) -> f64 {
    let half = (wi + wo).normalize();
    if wi.z <= 0.0 || half.z <= 0.0 {
        return 0.0;
    }
    let gloss = k / TAU * half.z.powf(k - 1.0) / (4.0 * wo.dot(half));
    (1.0 - share) * wi.z / PI + share * gloss
}

/// The part of the lobe that the sampler is documented to take, of reflected light about.
fn share(m: &Material) -> f64 {
    let specular = f64::from(m.specular);
    specular / (specular + (1.0 - specular) * f64::from(m.albedo[0]))
}

/// Frequencies of sampled directions over cells of the hemisphere, against the integral of the density over each; all
/// that goes below the surface is one cell.
#[test]
fn directions_have_their_density() {
    const SAMPLES: u32 = 300_000;
    const RINGS: usize = 10;
    const SECTORS: usize = 16;
    const SIDE: usize = 40;
    let mut random = Random::new(2);
    for (m, cos_o) in [
        (material(0.8, 0.0, 3), 0.7),
        (material(0.0, 1.0, 0), 0.8),
        (material(0.0, 1.0, 1), 0.6),
        (material(0.3, 1.0, 3), 0.9),
        (material(0.5, 0.4, 2), 0.3),
        (material(0.9, 0.1, 5), 0.5),
        (material(0.1, 0.9, 4), 0.2),
    ] {
        let n = Vec3::from(random.direction());
        let local = direction(cos_o, f64::from(random.unit()));
        let wo = about(n, local.x as f32, local.y as f32, local.z as f32);
        let axes = [about(n, 1.0, 0.0, 0.0), about(n, 0.0, 1.0, 0.0), n].map(|v| v.as_dvec3());

        let mut counts = vec![0_u64; RINGS * SECTORS + 1];
        for _ in 0..SAMPLES {
            let wi = m.sample(n, wo, draw3(&mut random)).as_dvec3();
            assert!((wi.length() - 1.0).abs() < 4e-6);
            let [x, y, z] = axes.map(|a| a.dot(wi));
            let cell = if z > 0.0 {
                let ring = ((z * RINGS as f64) as usize).min(RINGS - 1);
                let sector = (y.atan2(x).rem_euclid(TAU) / TAU * SECTORS as f64) as usize;
                ring * SECTORS + sector.min(SECTORS - 1)
            } else {
                RINGS * SECTORS
            };
            counts[cell] += 1;
        }

        let k = f64::from(1_u32 << m.exponent_log2);
        let mut expected: Vec<f64> = (0..RINGS * SECTORS)
            .map(|cell| {
                let mut sum = 0.0;
                for i in 0..SIDE * SIDE {
                    let ring = (cell / SECTORS) as f64 + ((i / SIDE) as f64 + 0.5) / SIDE as f64;
                    let sector = (cell % SECTORS) as f64 + ((i % SIDE) as f64 + 0.5) / SIDE as f64;
                    let wi = direction(ring / RINGS as f64, sector / SECTORS as f64);
                    sum += density(wi, local, share(&m), k);
                }
                sum / (SIDE * SIDE) as f64 * TAU / (RINGS * SECTORS) as f64
            })
            .collect();
        let above: f64 = expected.iter().sum();
        assert!(above <= 1.0 + 1e-3, "{m:?}: {above}");
        expected.push((1.0 - above).max(0.0));
        // Midpoints err far less than the frequencies vary; where nothing goes below, a rounding may.
        if expected[RINGS * SECTORS] < 1e-4 {
            expected[RINGS * SECTORS] = 1e-4;
        }
        let (statistic, degrees) = chi_squared(&counts, &expected);
        let threshold = chi_squared_quantile(degrees, TAIL);
        assert!(
            statistic < threshold,
            "{m:?} at {cos_o}: {statistic} of {threshold}, {degrees} degrees"
        );
    }
}

/// Of sampled directions and of others.
#[test]
fn density_matches_formula() {
    let mut random = Random::new(6);
    let mut seen = 0;
    for i in 0..100_000_u32 {
        let m = material(random.unit(), [0.0, 1.0, random.unit()][i as usize % 3], i % 17);
        let n = Vec3::Z;
        let wo = direction(0.05 + 0.95 * f64::from(random.unit()), f64::from(random.unit()));
        let wo = wo.as_vec3();
        let wi = if i % 2 == 0 {
            m.sample(n, wo, draw3(&mut random))
        } else {
            direction(f64::from(random.unit()), f64::from(random.unit())).as_vec3()
        };
        let k = f64::from(1_u32 << m.exponent_log2);
        let told = f64::from(m.scatter(n, wi, wo).density);
        let (i64, o64) = (wi.as_dvec3().normalize(), wo.as_dvec3().normalize());
        let expected = density(i64, o64, share(&m), k);
        let half = (i64 + o64).normalize();
        // Rounding of the directions tilts the half vector; below 2^-40 the lobe's power is cut.
        let length = (i64 + o64).length();
        let tilt = 2f64.powi(-22) / length * (k * half.z.acos().tan() + 1.0 / i64.z + 1.0 / half.z);
        let cut = k * 2f64.powi(-39) / length;
        // The share is a multiple of 2^-24.
        let either = density(i64, o64, 0.0, k) + density(i64, o64, 1.0, k);
        let tolerance = expected * (tilt + 2f64.powi(-17)) + cut + 2f64.powi(-23) * either;
        if i64.z > 1e-3 && expected > 1e-12 {
            assert!(
                (told - expected).abs() <= tolerance,
                "{m:?} {wi} {wo}: {told} {expected}"
            );
            seen += 1;
        }
    }
    assert!(seen > 60_000, "{seen}");
}

/// The part of light from everywhere that is reflected to `wo`, by quadrature with `side`² points.
fn albedo(material: &Material, wo: Vec3, side: u32) -> f64 {
    let mut sum = 0.0;
    for i in 0..side * side {
        // Uniform in the square of the sine: the cosine cancels.
        let squared = (f64::from(i / side) + 0.5) / f64::from(side);
        let turns = (f64::from(i % side) + 0.5) / f64::from(side);
        let wi = direction((1.0 - squared).sqrt(), turns).as_vec3();
        sum += f64::from(material.scatter(Vec3::Z, wi, wo).reflectance.x) * PI;
    }
    sum / f64::from(side * side)
}

/// No gloss reflects more than arrives, nor loses much of what falls straight on it.
#[test]
fn materials_reflect_no_more_than_arrives() {
    for exponent_log2 in 0..=10 {
        let gloss = material(1.0, 1.0, exponent_log2);
        for cosine in [1.0, 0.9, 0.5, 0.1] {
            let found = albedo(&gloss, direction(cosine, 0.0).as_vec3(), 400);
            assert!(found <= 1.0 + 2e-3, "2^{exponent_log2} at {cosine}: {found}");
            assert!(
                found > 0.79 || cosine < 1.0,
                "2^{exponent_log2} loses too much: {found}"
            );
        }
    }
    let white = albedo(&material(1.0, 0.0, 0), direction(0.5, 0.0).as_vec3(), 400);
    assert!((white - 1.0).abs() < 1e-5);
}

/// Materials and vectors from broken files: no direction and no density that is not a number.
#[test]
fn hostile_materials_give_numbers() {
    let mut random = Random::new(10);
    for albedo in [0.0, 1e-30, 1.0, 7.0, -1.0] {
        for specular in [0.0, 1e-30, 1e-8, 1.0, -3.0, 9.0] {
            for exponent_log2 in [0, 1, 16, 17, u32::MAX] {
                let m = material(albedo, specular, exponent_log2);
                for wo in [Vec3::Z, Vec3::X, Vec3::new(0.6, 0.0, 0.8), -Vec3::Z] {
                    for u in [draw3(&mut random), [0.0; 3], [1.0 - 2f32.powi(-24); 3]] {
                        let wi = m.sample(Vec3::Z, wo, u);
                        let s = m.scatter(Vec3::Z, wi, wo);
                        assert!(
                            wi.is_finite() && s.density.is_finite() && s.density >= 0.0,
                            "{m:?} {wo}"
                        );
                        assert!(s.reflectance.is_finite(), "{m:?} {wo}");
                    }
                }
            }
        }
    }
}
