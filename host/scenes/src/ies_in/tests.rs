use super::*;
use crate::Profile;
use crate::profile::{OVER_DIRECTIONS, towards};
use crate::shown::Shown;

/// A file of type `kind` with these angles, whose candela values are `value` of both angles.
fn file(kind: u32, vertical: &[f64], horizontal: &[f64], value: impl Fn(f64, f64) -> f64) -> Vec<u8> {
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut text = format!(
        "IESNA:LM-63-2002\r\n[TEST] 1\r\n[MANUFAC] \u{fffd}\r\nTILT=NONE\r\n1 1000 2.0 {} {} {kind} 2 0 0 0\r\n0.5 1 40\r\n{}\r\n{}\r\n",
        vertical.len(),
        horizontal.len(),
        list(vertical),
        list(horizontal)
    );
    for h in horizontal {
        let row: Vec<f64> = vertical.iter().map(|v| value(*v, *h)).collect();
        text += &list(&row);
        text += "\r\n";
    }
    text.into_bytes()
}

/// The direction at angles of type C.
fn luminaire(vertical: f64, horizontal: f64) -> [f64; 3] {
    let (v, h) = (vertical.to_radians(), horizontal.to_radians());
    [v.sin() * h.cos(), v.sin() * h.sin(), v.cos()]
}

fn near(found: f64, expected: f64) {
    let is_near = (found - expected).abs() < 1.0e-6 * expected.abs().max(1.0);
    assert!(is_near, "{found}, expected {expected}");
}

fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| from + (to - from) * k as f64 / (count - 1) as f64)
        .collect()
}

fn table(kind: u32, vertical: &[f64], horizontal: &[f64], value: impl Fn(f64, f64) -> f64) -> Photometry {
    Photometry::read(&file(kind, vertical, horizontal, value)).expect("sound")
}

#[test]
fn angles_of_luminaires_name_directions() {
    let value = |v: f64, h: f64| 100.0 + v + 0.1 * h;
    let (all, quarter) = (steps(0.0, 180.0, 19), steps(0.0, 90.0, 10));
    let circle = steps(0.0, 360.0, 13);
    // All around; a quadrant and a half, of which the rest is an image; one angle for all; a half from 90 to 270 degrees; up.
    let (right, first, one) = (steps(0.0, 180.0, 4), steps(0.0, 90.0, 4), vec![0.0]);
    let (old, up) = (steps(90.0, 270.0, 7), steps(90.0, 180.0, 10));
    for (vertical, horizontal, [v, h], [own_v, own_h]) in [
        (&all, &circle, [35.0, 100.0], [35.0, 100.0]),
        (&all, &circle, [90.0, 270.0], [90.0, 270.0]),
        (&all, &circle, [171.0, 359.0], [171.0, 359.0]),
        (&quarter, &first, [50.0, 20.0], [50.0, 20.0]),
        (&quarter, &first, [50.0, 160.0], [50.0, 20.0]),
        (&quarter, &first, [50.0, 200.0], [50.0, 20.0]),
        (&quarter, &first, [50.0, 340.0], [50.0, 20.0]),
        (&quarter, &right, [50.0, 130.0], [50.0, 130.0]),
        (&quarter, &right, [50.0, 230.0], [50.0, 130.0]),
        (&quarter, &one, [50.0, 230.0], [50.0, 0.0]),
        (&quarter, &old, [50.0, 200.0], [50.0, 200.0]),
        (&quarter, &old, [50.0, 340.0], [50.0, 200.0]),
        (&quarter, &old, [50.0, 30.0], [50.0, 150.0]),
        (&up, &one, [120.0, 0.0], [120.0, 0.0]),
        // Where all planes meet, one value.
        (&all, &circle, [0.0, 0.0], [0.0, 0.0]),
    ] {
        let table = table(1, vertical, horizontal, value);
        near(table.candela(luminaire(v, h)), value(own_v, own_h));
    }
    // Beyond the table there is nothing.
    for (vertical, v) in [(&quarter, 95.0), (&up, 60.0)] {
        let beyond = table(1, vertical, &right, value).candela(luminaire(v, 0.0));
        assert_eq!(beyond, 0.0);
    }
}

#[test]
fn angles_of_floodlights_and_headlamps_name_directions() {
    let value = |v: f64, h: f64| 200.0 + v + 0.1 * h;
    let (v, h) = (20.0_f64.to_radians(), 30.0_f64.to_radians());
    let b = table(2, &steps(-90.0, 90.0, 19), &steps(-90.0, 90.0, 19), value);
    let a = table(3, &steps(-90.0, 90.0, 19), &steps(0.0, 90.0, 10), value);
    for side in [1.0, -1.0] {
        let own = [side * h.sin(), side * h.cos() * v.sin(), h.cos() * v.cos()];
        near(b.candela(own), value(side * 20.0, side * 30.0));
        // The half that is not there is an image.
        let own = [side * v.cos() * h.sin(), v.sin(), v.cos() * h.cos()];
        near(a.candela(own), value(20.0, 30.0));
    }
}

/// Flux, mean cosine and cone of the picture against integrals of what the file says.
#[test]
fn pictures_have_the_flux_of_their_tables() {
    let lambert = |v: f64, _: f64| 900.0 * v.to_radians().cos().max(0.0);
    let narrow = |v: f64, _: f64| 5.0e4 * (-0.5 * (v / 6.0) * (v / 6.0)).exp();
    let uneven = |v: f64, h: f64| (300.0 - 2.0 * v).max(0.0) * (1.2 + h.to_radians().sin());
    type Case<'a> = (&'a str, Vec<f64>, Vec<f64>, &'a dyn Fn(f64, f64) -> f64);
    let cases: [Case<'_>; 3] = [
        ("lambert", steps(0.0, 90.0, 37), vec![0.0], &lambert),
        ("narrow", steps(0.0, 90.0, 91), vec![0.0], &narrow),
        ("uneven", steps(0.0, 180.0, 37), steps(0.0, 360.0, 25), &uneven),
    ];
    for (name, vertical, horizontal, value) in cases {
        let bytes = file(1, &vertical, &horizontal, value);
        let table = Photometry::read(&bytes).expect("sound");
        let profile = Profile::read(name.into(), bytes).expect("sound");
        let [width, height] = [profile.picture.width, profile.picture.height];
        let picture = Shown::new([width, height], &profile.picture.texels, &OVER_DIRECTIONS);
        // By rings, as no octahedron has them.
        let (mut flux, mut first, mut shown) = (0.0, 0.0, 0.0);
        let rings = 720;
        for ring in 0..rings {
            let v = 180.0 * (f64::from(ring) + 0.5) / f64::from(rings);
            let solid =
                std::f64::consts::TAU * v.to_radians().sin() * std::f64::consts::PI / f64::from(rings);
            for k in 0..72 {
                let d = luminaire(v, 5.0 * f64::from(k) + 2.5);
                flux += table.candela(d) * solid / 72.0;
                first += table.candela(d) * d[2] * solid / 72.0;
                let seen = towards(&picture, d.map(|x| x as f32));
                shown += f64::from(seen) * f64::from(profile.sent.peak) * solid / 72.0;
                assert!(
                    seen <= 0.0 || d[2] as f32 >= profile.sent.cos_outer,
                    "{name}: {}",
                    d[2]
                );
            }
        }
        let whole = f64::from(profile.sent.whole) * std::f64::consts::TAU * f64::from(profile.sent.peak);
        for share in [
            shown / flux,
            whole / flux,
            1.0 + f64::from(profile.sent.mean_cosine) - first / flux,
        ] {
            assert!((share - 1.0).abs() < 0.005, "{name}: {shown}, {whole} of {flux}");
        }
    }
}

#[test]
fn broken_files_are_named_and_never_panic() {
    let sound = file(1, &[0.0, 45.0, 90.0], &[0.0], |_, _| 100.0);
    assert!(Photometry::read(&sound).is_ok());
    let text = String::from_utf8_lossy(&sound).into_owned();
    let with = |from: &str, to: &str| text.replace(from, to);
    let cut = String::from("TILT=NONE\n1 2 3");
    for (text, part) in [
        (String::new(), "no line `TILT=`"),
        (cut, "ends before its number of vertical angles"),
        (with("2.0 3 1 1", "2.0 0 1 1"), "0 vertical angles"),
        (with("2.0 3 1 1", "2.0 4096 4096 1"), "more than"),
        (with("2.0 3 1 1", "2.0 3 1 7"), "photometric type is 7"),
        (with("2.0 3 1 1", "nan 3 1 1"), "expected a number"),
        (with("2.0 3 1 1", "-2.0 3 1 1"), "make -1"),
        (with("0 45 90", "0 90 45"), "do not ascend"),
        (with("100 100 100", "100 1e400 100"), "expected a number"),
        (with("100 100 100", "0 -5 0"), "no light in any direction"),
        (with("100 100 100", "100 100"), "before its candela value"),
    ] {
        let problem = Profile::read(String::new(), text.clone().into_bytes()).expect_err(&text);
        assert!(problem.contains(part), "{problem}");
    }
    let mut random = crate::random::Random::new(1);
    for _ in 0..20_000 {
        let mut bytes = sound[..random.pick(sound.len())].to_vec();
        bytes.extend(&sound[random.pick(sound.len())..]);
        let at = random.pick(bytes.len());
        bytes[at] = random.pick(256) as u8;
        _ = Photometry::read(&bytes);
    }
    let tilted = text.replace("TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1 0.9");
    assert_eq!(Photometry::read(tilted.as_bytes()), Photometry::read(&sound));
}

/// Files that leave the last plane out, which is the first: from 345 to 360 degrees there is light too.
#[test]
fn a_circle_that_is_not_closed_is_closed() {
    for (last, count) in [(345.0, 24), (270.0, 4), (350.0, 36)] {
        let (vertical, horizontal) = (steps(0.0, 90.0, 10), steps(0.0, last, count));
        let table = table(1, &vertical, &horizontal, |_, h| 100.0 + h);
        near(table.candela(luminaire(30.0, last)), 100.0 + last);
        let between = 0.5 * (last + 360.0);
        near(table.candela(luminaire(30.0, between)), 100.0 + 0.5 * last);
        near(table.candela(luminaire(30.0, 0.0)), 100.0);
    }
}
