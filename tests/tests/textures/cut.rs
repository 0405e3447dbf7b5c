//! What is cut out: light passes, and eyes see what is behind it.

use super::*;

/// A lamp at height `lamp` above the floor, and a sheet of which the half at negative x is there, 2 m above it. The eye looks
/// at `aim` from height `eye`.
fn behind(lamp: f32, [aim, eye]: [f32; 2]) -> SceneData {
    let halves = picture(2, 1, |x, _| [0, 0, 0, if x == 0 { 255 } else { 100 }]);
    let textures = MaterialTextures {
        base: [0.5, 0.5, 0.5, 1.0],
        ..PLAIN
    };
    let mut data = floor(textures, vec![halves], [aim, eye]);
    data.materials.push(textured(MaterialTextures {
        base_texture: Some(lying(0)),
        cutoff: 0.5,
        ..PLAIN
    }));
    data.meshes.push(sheet(8.0, 1));
    data.nodes.push(node(at([0.0, 2.0, 0.0]), Some(1)));
    add(&mut data, at([0.0, lamp, 0.0]), AnalyticKind::Point, 30.0);
    data
}

#[test]
fn cut_surface_hides_nothing() {
    let open = 30.0 * 4.0 / 17.0_f64.powf(1.5);
    reflects(behind(4.0, [1.0, 1.0]), [open; 3], [0.5; 3], 2e-3);
    reflects(behind(4.0, [-1.0, 1.0]), [0.0; 3], [0.5; 3], 2e-3);
    // The lamp stands below the sheet, the eye above it.
    let open = 30.0 / 2.0_f64.powf(1.5);
    reflects(behind(1.0, [1.0, 3.0]), [open; 3], [0.5; 3], 2e-3);
    reflects(behind(1.0, [-1.0, 3.0]), [0.0; 3], [0.5; 3], 2e-3);
}
