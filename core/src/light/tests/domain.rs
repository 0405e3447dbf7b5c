//! What is out of the domain, and the whole range of it.

use super::*;

/// What is out of the domain, and what each message names.
#[test]
fn wrong_lights_are_refused_by_name() {
    let text = |error: Result<(), LightError>| -> String { format!("{}", error.expect_err("it is wrong")) };
    let refused = |light: SpotLight, part: &str| {
        let found = text(light.checked().map(|_| ()));
        assert!(found.contains(part), "{found}");
    };
    let good = spot(0.9, 0.5);
    assert_eq!(good.checked(), Ok(good));
    refused(
        SpotLight {
            cos_inner: 0.4,
            ..good
        },
        "inner cosine of 0.4 to an outer one of 0.5",
    );
    refused(
        SpotLight {
            cos_outer: 1.0,
            cos_inner: 1.0,
            ..good
        },
        "outer < 1",
    );
    refused(
        SpotLight {
            cos_inner: f32::NAN,
            ..good
        },
        "inner cosine of NaN",
    );
    refused(
        SpotLight {
            cos_outer: -1.5,
            ..good
        },
        "-1.5",
    );
    refused(
        SpotLight {
            axis: [0.0; 3],
            ..good
        },
        "is (0, 0, 0), expected length 1",
    );
    refused(
        SpotLight {
            axis: [f32::NAN; 3],
            ..good
        },
        "is (NaN",
    );
    refused(
        SpotLight {
            intensity: [0.0, -1.0, 0.0],
            ..good
        },
        "green of the intensity of a spot is -1",
    );
    refused(
        SpotLight {
            p: [0.0, 0.0, f32::INFINITY],
            ..good
        },
        "coordinate z of the spot is inf",
    );
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY, exact::pow2(-61)] {
        let found = text(SphereLight { radius, ..sphere() }.checked().map(|_| ()));
        assert!(found.contains("the radius of a sphere is"), "{found}");
    }
    let flags = RectangleLight {
        flags: 2,
        ..rectangle(0)
    };
    assert_eq!(flags.checked(), Err(LightError::Flags { flags: 2 }));
    let edge = DiscLight {
        half: [[0.0, f32::NAN, 0.0], [1.0, 0.0, 0.0]],
        ..disc(0)
    };
    let found = text(edge.checked().map(|_| ()));
    assert!(
        found.contains("coordinate y of the half axis of a disc is NaN"),
        "{found}"
    );
    let found = text(
        BoxLight {
            radiance: [1e31, 0.0, 0.0],
            ..glow()
        }
        .checked()
        .map(|_| ()),
    );
    assert!(found.contains("red of the radiance of a box"), "{found}");
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
                check(PointLight {
                    p,
                    intensity: radiance,
                    range: 0.0,
                    mesh: 0,
                });
                check(SpotLight {
                    p,
                    intensity: radiance,
                    ..spot(0.9, 0.5)
                });
                check(ProfileLight {
                    p,
                    intensity: radiance,
                    ..profile()
                });
                check(ProfileLight {
                    whole: 0.0,
                    ..profile()
                });
                check(SphereLight {
                    p,
                    radius: s,
                    radiance,
                    mesh: 0,
                });
                let half = [[s, 0.0, 0.0], [0.0, s * exact::pow2(-20), s]];
                check(RectangleLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                    flags: 0,
                });
                check(DiscLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                    flags: TWO_SIDED,
                });
                check(RectangleLight {
                    half: [[s, 0.0, 0.0]; 2],
                    ..rectangle(0)
                });
                let half = [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, s, s * exact::pow2(-20)]];
                check(BoxLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                });
                check(BoxLight {
                    half: [[s, 0.0, 0.0]; 3],
                    ..glow()
                });
            }
        }
    }
}
