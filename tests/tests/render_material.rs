//! Reflectances add no energy and are reciprocal.

use glam::Vec3;
use lightbvh_kernels::shading::material::Material;
use lightbvh_tests::generate::Random;
use lightbvh_tests::soup::in_cube;

const WHITE: Material = Material {
    albedo: [1.0; 3],
    specular: 0.0,
    exponent_log2: 0,
};

/// Reflected part of light from everywhere, by quadrature over the hemisphere.
fn albedo(material: &Material, cos_o: f32) -> f64 {
    let wo = Vec3::new((1.0 - cos_o * cos_o).sqrt(), 0.0, cos_o);
    let side = 400;
    let mut sum = 0.0;
    for i in 0..side {
        for j in 0..side {
            // Uniform in the square of the sine: the density is cos / pi, which cancels the cosine.
            let sin = ((i as f32 + 0.5) / side as f32).sqrt();
            let phi = (j as f32 + 0.5) / side as f32 * std::f32::consts::TAU;
            let wi = Vec3::new(sin * phi.cos(), sin * phi.sin(), (1.0 - sin * sin).sqrt());
            sum += f64::from(material.eval(Vec3::Z, wi, wo).x) * std::f64::consts::PI;
        }
    }
    sum / f64::from(side * side)
}

#[test]
fn materials_reflect_no_more_than_arrives() {
    for exponent_log2 in 0..=10 {
        let gloss = Material {
            albedo: [1.0; 3],
            specular: 1.0,
            exponent_log2,
        };
        for cos_o in [1.0, 0.9, 0.5, 0.1] {
            let reflected = albedo(&gloss, cos_o);
            assert!(
                reflected <= 1.0 + 2e-3,
                "2^{exponent_log2} at {cos_o}: {reflected}"
            );
        }
        assert!(
            albedo(&gloss, 1.0) > 0.79,
            "2^{exponent_log2} loses too much: {}",
            albedo(&gloss, 1.0)
        );
    }
    assert!((albedo(&WHITE, 0.5) - 1.0).abs() < 1e-5);
    let half = Material {
        specular: 0.5,
        ..WHITE
    };
    let both = Material {
        specular: 7.0,
        exponent_log2: u32::MAX,
        ..WHITE
    };
    assert!(albedo(&half, 0.5) <= 1.0);
    assert!(both.eval(Vec3::Z, Vec3::Z, Vec3::Z).is_finite());
}

#[test]
fn materials_are_reciprocal() {
    let mut random = Random::new(3);
    let material = Material {
        albedo: [0.2, 0.5, 0.8],
        specular: 0.3,
        exponent_log2: 5,
    };
    for _ in 0..1000 {
        let [a, b] = [0; 2].map(|_| {
            let v = Vec3::from(in_cube(&mut random, 1.0)).normalize();
            Vec3::new(v.x, v.y, v.z.abs())
        });
        assert_eq!(material.eval(Vec3::Z, a, b), material.eval(Vec3::Z, b, a));
    }
}
