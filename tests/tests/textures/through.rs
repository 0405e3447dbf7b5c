//! What is cut out, blended or thin glass: how much light passes, and what eyes see behind it.

use super::*;

/// A lamp above a sheet above the floor: what of it arrives at `aim`, where its ray crosses the sheet at half of that.
fn behind(sheet_paint: Paint, pictures: Vec<Picture>, aim: f32) -> SceneData {
    let paint = Paint {
        base: [0.5, 0.5, 0.5, 1.0],
        ..PLAIN
    };
    let mut data = floor(paint, pictures, [aim, 1.0]);
    data.materials.push(painted(sheet_paint));
    if sheet_paint.is_clear() {
        data.materials[1].transmission = sheet_paint.transmission;
    }
    data.meshes.push(sheet(8.0, 1));
    data.nodes.push(node(at([0.0, 2.0, 0.0]), Some(1)));
    add(&mut data, at([0.0, 4.0, 0.0]), AnalyticKind::Point, 30.0);
    data
}

/// Irradiance of that lamp without the sheet.
fn open(aim: f64) -> f64 {
    30.0 * 4.0 / (16.0 + aim * aim).powf(1.5)
}

#[test]
fn what_is_cut_out_hides_nothing() {
    let halves = picture(2, 1, |x, _| [255, 255, 255, if x == 0 { 255 } else { 100 }]);
    let cut = Paint {
        base_texture: Some(lying(0, true)),
        opacity: Opacity::Cut(0.5),
        ..PLAIN
    };
    reflects(
        behind(cut, vec![halves.clone()], 1.0),
        [open(1.0); 3],
        [0.5; 3],
        2e-3,
    );
    reflects(behind(cut, vec![halves], -1.0), [0.0; 3], [0.5; 3], 2e-3);
}

#[test]
fn what_is_blended_hides_its_part() {
    let halves = picture(2, 1, |x, _| [255, 255, 255, if x == 0 { 255 } else { 51 }]);
    let blended = Paint {
        base: [1.0, 1.0, 1.0, 0.5],
        base_texture: Some(lying(0, true)),
        opacity: Opacity::Blended,
        ..PLAIN
    };
    // A fifth of a half is there.
    reflects(
        behind(blended, vec![halves.clone()], 1.0),
        [0.9 * open(1.0); 3],
        [0.5; 3],
        2e-3,
    );
    reflects(
        behind(blended, vec![halves], -1.0),
        [0.5 * open(1.0); 3],
        [0.5; 3],
        2e-3,
    );
}

#[test]
fn glass_tints() {
    let glass = Paint {
        base: [1.0, 0.5, 0.25, 1.0],
        transmission: 0.8,
        ..PLAIN
    };
    reflects(
        behind(glass, Vec::new(), 1.0),
        [0.8, 0.4, 0.2].map(|tint| tint * open(1.0)),
        [0.5; 3],
        2e-3,
    );
}

/// The floor seen through a sheet: tinted by glass, covered in part by what is blended, and not at all by what is cut out.
#[test]
fn eyes_see_what_is_behind() {
    let blended = Paint {
        base: [0.0, 0.0, 0.0, 0.25],
        opacity: Opacity::Blended,
        ..PLAIN
    };
    let glass = Paint {
        base: [1.0, 0.5, 0.25, 1.0],
        transmission: 0.8,
        ..PLAIN
    };
    let cut = Paint {
        base: [1.0, 1.0, 1.0, 0.25],
        opacity: Opacity::Cut(0.5),
        ..PLAIN
    };
    for (paint, tint) in [(blended, [0.75; 3]), (glass, [0.8, 0.4, 0.2]), (cut, [1.0; 3])] {
        let mut data = behind(paint, Vec::new(), 1.0);
        // Black where it is seen itself, but for a gloss.
        data.materials[1].base_color = [0.0; 3];
        // The lamp stands between the floor and the sheet, so that no shadow falls; the eye is above the sheet.
        let lamp = data.nodes.len() - 1;
        data.nodes[lamp].transform = at([0.0, 1.0, 0.0]);
        data.nodes[1].transform = Transform::Matrix([
            [1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0],
            [0.0, 1.0, 0.0],
            [1.0, 3.0, 0.0],
        ]);
        let e = 30.0 / 2.0_f64.powf(1.5);
        let scene = Scene::new(data).expect("sound");
        for (what, means, errors) in images(&scene) {
            for k in 0..3 {
                let error = errors[k];
                let low = 0.96 * 0.5 * e / PI * tint[k];
                let high = low + GLOSS * e / PI * tint[k];
                // Which rays the sheet stops is even among 1024 pixels: a standard error of that is in it.
                let slack = 5.0 * error + 2e-3 * high;
                assert!(
                    means[k] > low - slack && means[k] < high + slack,
                    "{what} {paint:?}: channel {k} is {} ± {error}, expected {low} to {high}",
                    means[k]
                );
            }
        }
    }
}
