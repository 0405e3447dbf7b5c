//! `stage`: a small theatre with every kind of light, none of which the paper has: spots that swing, softboxes, lanterns,
//! footlights, bulbs, and a sign of triangles among them.
//!
//! The boards are y = 0, the back wall is z = −5.

use super::analytic::{AnalyticKind, AnalyticLight};
use super::builder::{STILL, SceneBuilder};
use super::error::SceneError;
use super::scene::Scene;
use super::shapes::{Shape, on_circle, rotation};

const ALONG_X: [f64; 3] = [1.0, 0.0, 0.0];
const ALONG_Z: [f64; 3] = [0.0, 0.0, 1.0];
/// Turns -Z downward.
const DOWN: f64 = -std::f64::consts::FRAC_PI_2;

/// Builds the scene, which passes the same checks as one from a file.
pub(super) fn stage() -> Result<Scene, SceneError> {
    let mut b = SceneBuilder::new("stage", [0.002, 0.002, 0.004]);
    room(&mut b);
    spots(&mut b);
    soft(&mut b);
    lanterns(&mut b);
    footlights(&mut b);
    bulbs(&mut b);
    sign(&mut b);
    b.camera([0.0, 2.3, 9.6], [0.0, 2.35, -2.0], 46.0);
    b.finish()
}

/// A node with a light by formula on it.
fn light(
    b: &mut SceneBuilder,
    name: &str,
    at: [f64; 3],
    turn: [f32; 4],
    kind: AnalyticKind,
    color: [f32; 3],
) {
    let node = b.node(name, None, at, turn, None);
    on(b, name, node, kind, color);
}

/// A light by formula on a node.
fn on(b: &mut SceneBuilder, name: &str, node: u32, kind: AnalyticKind, color: [f32; 3]) {
    b.analytic(AnalyticLight {
        name: name.to_owned(),
        node,
        kind,
        color,
        intensity: 1.0,
        range: None,
    });
}

/// Boards, walls, curtains, steps and a ball on a pedestal.
fn room(b: &mut SceneBuilder) {
    let boards = b.matte("boards", [0.34, 0.22, 0.13], 0.35);
    let plaster = b.matte("plaster", [0.42, 0.40, 0.38], 0.9);
    let velvet = b.matte("velvet", [0.42, 0.05, 0.06], 0.95);
    let metal = b.metal("metal", [0.75, 0.74, 0.70], 1.0, 0.25);
    let floor = Shape::of(|s| s.cuboid([-7.0, -0.2, -5.2], [7.0, 0.0, 4.0]));
    let walls = Shape::of(|s| {
        s.cuboid([-7.0, 0.0, -5.2], [7.0, 6.5, -5.0])
            .cuboid([-7.2, 0.0, -5.2], [-7.0, 6.5, 4.0])
            .cuboid([7.0, 0.0, -5.2], [7.2, 6.5, 4.0])
    });
    let mut folds = Shape::new();
    for side in [-1.0, 1.0] {
        for k in 0..9 {
            let x = side * (6.6 - 0.22 * f64::from(k));
            let z = 2.6 + 0.12 * f64::from(k % 2);
            folds.cylinder([x, 0.0, z], [0.15, 0.15], 6.0, 8);
        }
    }
    let mut steps = Shape::new();
    for k in 0..3 {
        let k = f64::from(k);
        steps.cuboid(
            [-2.4 + 0.5 * k, 0.25 * k, -3.0 + 0.4 * k],
            [2.4 - 0.5 * k, 0.25 * (k + 1.0), -0.9 - 0.3 * k],
        );
    }
    let mut truss = Shape::new();
    truss.beam([-6.0, 5.6, 0.6], [6.0, 5.6, 0.6], 0.12);
    truss.beam([-6.0, 5.6, -2.2], [6.0, 5.6, -2.2], 0.12);
    let ball = Shape::of(|s| s.icosphere([0.0, 1.35, -1.9], [0.6, 0.6, 0.6], 3));
    let mesh = b.mesh("boards", &[(&floor, boards)]);
    b.put("boards", None, [0.0; 3], mesh);
    let mesh = b.mesh(
        "house",
        &[
            (&walls, plaster),
            (&folds, velvet),
            (&steps, plaster),
            (&truss, metal),
            (&ball, metal),
        ],
    );
    b.put("house", None, [0.0; 3], mesh);
}

/// Two rows of coloured spots that swing.
fn spots(b: &mut SceneBuilder) {
    let colors = [
        [190.0, 60.0, 40.0],
        [50.0, 130.0, 190.0],
        [170.0, 150.0, 100.0],
        [120.0, 40.0, 170.0],
    ];
    for row in 0..2 {
        for k in 0..8 {
            let x = -5.2 + 10.4 * f64::from(k) / 7.0;
            let z = if row == 0 { 0.5 } else { -2.3 };
            let hanger = b.node("hanger", None, [x, 5.45, z], rotation(ALONG_X, DOWN), None);
            let spot = b.node("spot", Some(hanger), [0.0; 3], STILL, None);
            let kind = AnalyticKind::Spot {
                inner: 0.12,
                outer: 0.26,
            };
            on(b, "spot", spot, kind, colors[(k + 2 * row) as usize % 4]);
            let axis = if k % 2 == 0 { ALONG_X } else { [0.0, 1.0, 0.0] };
            b.swing(spot, axis, 0.45, 60 + 10 * (k as u32 % 3), f64::from(k) / 8.0);
        }
    }
}

/// Softboxes at the sides, a panel above.
fn soft(b: &mut SceneBuilder) {
    for side in [-1.0, 1.0] {
        light(
            b,
            "softbox",
            [side * 6.6, 3.2, 0.5],
            rotation([0.0, 1.0, 0.0], side * std::f64::consts::FRAC_PI_2),
            AnalyticKind::Rectangle { half: [0.7, 1.0] },
            [0.9, 0.8, 0.65],
        );
    }
    light(
        b,
        "panel",
        [0.0, 5.9, -3.8],
        rotation(ALONG_X, DOWN),
        AnalyticKind::Rectangle { half: [2.5, 0.15] },
        [1.2, 1.4, 1.9],
    );
}

/// Paper lanterns that swing on their strings.
fn lanterns(b: &mut SceneBuilder) {
    for k in 0..10 {
        let x = -5.4 + 10.8 * f64::from(k) / 9.0;
        let drop = 1.1 + 0.35 * f64::from(k % 3);
        let hook = b.node("hook", None, [x, 5.5, -4.0], STILL, None);
        let lantern = b.node("lantern", Some(hook), [0.0, -drop, 0.0], STILL, None);
        let radius = 0.16 + 0.03 * (k % 2) as f32;
        let color = [7.5, 4.6 - 0.2 * k as f32, 1.6 + 0.3 * k as f32];
        on(b, "lantern", lantern, AnalyticKind::Sphere { radius }, color);
        b.swing(hook, ALONG_Z, 0.12, 50, f64::from(k) / 10.0);
    }
}

/// Discs along the front of the boards that shine back and up.
fn footlights(b: &mut SceneBuilder) {
    for k in 0..14 {
        let x = -5.2 + 10.4 * f64::from(k) / 13.0;
        light(
            b,
            "footlight",
            [x, 0.12, 3.6],
            rotation(ALONG_X, 0.6),
            AnalyticKind::Disc { half: [0.09, 0.09] },
            [9.0, 6.5, 3.6],
        );
    }
}

/// Bare bulbs around the arch at the back.
fn bulbs(b: &mut SceneBuilder) {
    for k in 0..25 {
        let [x, y] = on_circle(0.5 * f64::from(k) / 24.0);
        let at = [3.2 * x, 1.2 + 2.6 * y, -4.7];
        light(b, "bulb", at, STILL, AnalyticKind::Point, [0.10, 0.07, 0.035]);
    }
}

/// A ring of glowing tube, of triangles.
fn sign(b: &mut SceneBuilder) {
    let glow = b.glow("neon", [14.0, 2.0, 9.0]);
    let mesh = b.solid("sign", glow, |s| s.torus([0.0; 3], 0.75, 0.05, 24, 6));
    let node = b.node(
        "sign",
        None,
        [0.0, 3.3, -4.6],
        rotation(ALONG_X, DOWN),
        Some(mesh),
    );
    b.bob(node, [0.0, 3.3, -4.6], 0.15, 80, 0.0);
}
