//! Photometric lights: what they send by every way to render.

use lightbvh_host::scene::{AnalyticKind, AnalyticLight, Photometry, Profile, SceneData, Transform};

use crate::kinds_render::node;
use crate::textures::{along, plain_floor, reflects};

/// A file of a luminaire that shines to one side: a beam about 40° down, none above 80°.
fn uneven() -> Vec<u8> {
    let vertical: Vec<f64> = (0..=18).map(|k| 5.0 * f64::from(k)).collect();
    let horizontal: Vec<f64> = (0..=24).map(|k| 15.0 * f64::from(k)).collect();
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut text = format!(
        "IES:LM-63-2019\nTILT=NONE\n1 -1 1 19 25 1 2 0 0 0\n1 1 20\n{}\n{}\n",
        list(&vertical),
        list(&horizontal)
    );
    for h in &horizontal {
        let row: Vec<f64> = vertical
            .iter()
            .map(|v| {
                let side = 1.0 + 0.8 * h.to_radians().cos() + 0.1 * h.to_radians().sin();
                let beam = (-(v - 40.0) * (v - 40.0) / 800.0).exp() + 0.2;
                if *v > 80.0 {
                    0.0
                } else {
                    (6.0 * side * beam * 1000.0).round() / 1000.0
                }
            })
            .collect();
        text += &list(&row);
        text += "\n";
    }
    text.into_bytes()
}

fn profile() -> Profile {
    Profile::read(String::from("uneven"), uneven()).expect("a sound file")
}

/// Adds two lamps with a profile, one of them turned and mirrored.
pub fn hang(data: &mut SceneData) {
    let index = data.profiles.len() as u32;
    data.profiles.push(profile());
    for (translation, scale) in [([0.3, 2.8, 0.5], [1.0; 3]), ([-1.4, 2.2, -0.8], [0.5, -0.7, 0.4])] {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let place = Transform::Trs {
            translation,
            rotation: [-half, 0.0, 0.0, half],
            scale,
        };
        data.nodes.push(node(place, None));
        data.analytic.push(AnalyticLight {
            name: String::from("measured"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::Profile {
                profile: index,
                sent: data.profiles[index as usize].sent,
            },
            color: [1.0, 0.7, 0.5],
            intensity: 0.6,
            range: None,
        });
    }
}

/// At several places beneath a lamp that is turned, all ways to render find the candela of the table.
#[test]
fn floors_get_what_the_table_says() {
    let table = Photometry::read(&uneven()).expect("a sound file");
    for [aim, height] in [[0.0_f64, 2.0], [1.3, 2.0], [-1.1, 1.5], [9.0, 1.0]] {
        let mut data = plain_floor([aim as f32, 12.0]);
        data.profiles.push(profile());
        // Above the origin; its -Z leans.
        let lean = [3.0_f64, -9.0, 2.0].map(|x| x / 94.0_f64.sqrt());
        let Transform::Matrix([x, y, z, _]) = along(lean) else {
            unreachable!("a matrix");
        };
        let place = Transform::Matrix([x, y, z, [0.0, height as f32, 0.0]]);
        data.nodes.push(node(place, None));
        data.analytic.push(AnalyticLight {
            name: String::from("measured"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::Profile {
                profile: 0,
                sent: data.profiles[0].sent,
            },
            color: [1.0, 0.5, 0.25],
            intensity: 2.0,
            range: None,
        });
        let d = [aim, -height, 0.0];
        let squared: f64 = d.iter().map(|x| x * x).sum();
        let component =
            |axis: [f32; 3]| axis.iter().zip(d).map(|(a, d)| f64::from(*a) * d).sum::<f64>() / squared.sqrt();
        let candela = table.candela([component(x), component(y), -component(z)]);
        let light = 2.0 * candela * height / squared.powf(1.5);
        // Pictures are of bytes and of means over texels: two hundredths of what is there.
        reflects(data, [light, 0.5 * light, 0.25 * light], [0.5; 3], 0.022);
    }
}
