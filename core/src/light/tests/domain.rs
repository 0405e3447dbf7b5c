//! What is out of the domain, and the whole range of it.

use super::*;

/// What is out of the domain, and what each message names.
#[test]
fn wrong_lights_are_refused_by_name() {
    refused(
        spot(0.9, 0.5),
        &[
            (
                |l| l.cos_inner = 0.4,
                "inner cosine of a spot is 0.4, expected the outer",
            ),
            (
                |l| l.cos_inner = 2.0,
                "inner cosine of a spot is 2, expected -1 to 1",
            ),
            (
                |l| (l.cos_outer, l.cos_inner) = (1.0, 1.0),
                "outer cosine of a spot is 1",
            ),
            (|l| l.cos_inner = f32::NAN, "inner cosine of a spot is NaN"),
            (|l| l.cos_outer = -1.5, "-1.5"),
            (|l| l.axis = [0.0; 3], "is (0, 0, 0), expected length 1"),
            (|l| l.axis = [f32::NAN; 3], "is (NaN"),
            (
                |l| l.intensity[1] = -1.0,
                "green of the intensity of a spot is -1",
            ),
            (|l| l.p[2] = f32::INFINITY, "coordinate z of the spot is inf"),
            (|l| l.range = -1.0, "the range of a light is -1"),
        ],
    );
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY, exact::pow2(-61)] {
        let wrong = SphereLight { radius, ..sphere() };
        refused(wrong, &[(|_| (), "the radius of a sphere is")]);
    }
    refused(rectangle(0), &[(|l| l.flags = 2, "flags is 0x2")]);
    let axis = "coordinate y of the half axis of a disc is NaN";
    refused(disc(0), &[(|l| l.half[0][1] = f32::NAN, axis)]);
}

/// A change of a light, and what the message that refuses it says.
type Wrong<L> = (fn(&mut L), &'static str);

/// A sound light, and changes that are refused with a message each.
fn refused<L: Light>(good: L, wrong: &[Wrong<L>]) {
    for (change, part) in wrong {
        let mut light = good;
        change(&mut light);
        let found = format!("{}", light.checked().expect_err("it is wrong"));
        assert!(found.contains(part), "{found}");
    }
}

/// Over the whole range of lengths and radiances, numbers stay in theirs.
#[test]
fn extremes_stay_finite() {
    fn check<L: Light>(light: L) {
        let light = light.checked().expect("in the domain");
        let moments = light.moments();
        let phi = moments.phi;
        assert!(
            phi == 0.0 || (crate::bounds::MIN_PHI..=crate::bounds::MAX_PHI).contains(&phi),
            "{light:?}"
        );
        assert_eq!(phi > 0.0, light.has_flux(), "{light:?}");
        for word in crate::summary::Summary::to_words(&moments) {
            assert!(word.is_finite(), "{light:?}: {moments:?}");
        }
        for from in [Vec3::ZERO, Vec3::splat(exact::pow2(40)), Vec3::new(1.0, 2.0, 3.0)] {
            for uv in [[0.0, 0.0], [0.5, 0.5], [0.999_999_94, 0.999_999_94], [0.0, 0.75]] {
                let at = light.point_for(from, uv);
                assert!(
                    at.p.iter().chain(&at.normal).all(|x| x.is_finite()),
                    "{light:?}: {at:?}"
                );
                assert!(at.density.is_finite() && at.density >= 0.0, "{light:?}: {at:?}");
                let receiver = ShadingPoint {
                    p: from.to_array(),
                    n: [0.0; 3],
                };
                let sent = at.irradiance(&receiver);
                assert!(
                    sent.iter().all(|x| !x.is_nan() && *x >= 0.0),
                    "{light:?}: {sent:?}"
                );
            }
        }
    }
    for e in [-60, -50, -30, -10, 0, 10, 30, 39] {
        let s = exact::pow2(e);
        for shine in [0.0, MIN_RADIANCE, 1.0, MAX_RADIANCE] {
            for place in [0.0, s, exact::pow2(39)] {
                let radiance = [shine; 3];
                let p = [place, -place, 0.0];
                let intensity = radiance;
                check(PointLight {
                    p,
                    intensity,
                    ..PointLight::DARK
                });
                check(SpotLight {
                    p,
                    intensity,
                    ..spot(0.9, 0.5)
                });
                check(SphereLight {
                    p,
                    radius: s,
                    radiance,
                    mesh: 0,
                });
                let thin = s * exact::pow2(-20);
                for half in [[[s, 0.0, 0.0], [0.0, thin, s]], [[s, 0.0, 0.0]; 2]] {
                    check(RectangleLight {
                        p,
                        half,
                        radiance,
                        ..rectangle(0)
                    });
                    check(DiscLight {
                        p,
                        half,
                        radiance,
                        ..disc(TWO_SIDED)
                    });
                }
            }
        }
    }
}
