//! Houses around the square; about every third window is lit.

use super::super::builder::SceneBuilder;
use super::super::random::Random;
use super::super::shapes::{Shape, on_circle};
use super::FRONTS;

/// Width of a window with the wall beside it, and height of a floor, metres.
const BAY: f64 = 3.2;
const FLOOR: f64 = 3.6;

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random) {
    let wall_colors = [
        [0.50, 0.34, 0.26],
        [0.52, 0.48, 0.42],
        [0.38, 0.36, 0.38],
        [0.56, 0.42, 0.32],
    ];
    let walls = wall_colors.map(|color| b.matte("wall", color, 0.9));
    let stone = b.matte("stone", [0.5, 0.48, 0.45], 0.8);
    let glass = b.matte("dark glass", [0.04, 0.05, 0.06], 0.1);
    let colors = [
        [1.3, 0.8, 0.33],
        [1.1, 0.82, 0.5],
        [0.45, 0.62, 0.95],
        [1.2, 0.55, 0.2],
    ];
    let pane = Shape::of(|s| s.pane([0.7, 0.9]));
    let lit = colors.map(|radiance| {
        let glow = b.glow("lit window", radiance);
        b.mesh("window", &[(&pane, glow)])
    });

    let mut bodies: [Shape; 4] = std::array::from_fn(|_| Shape::new());
    let mut trim = Shape::new();
    let mut dark = Shape::new();
    for face in 0..4 {
        // Each side of the square is built facing +Z and turned into place.
        let quarter = f64::from(face) * 0.25;
        let [cosine, sine] = on_circle(quarter);
        let turned = |[x, y, z]: [f64; 3]| [x * cosine + z * sine, y, z * cosine - x * sine];
        let heading = quarter * std::f64::consts::TAU;
        let mut x = -FRONTS;
        while x < FRONTS - 4.0 * BAY {
            let bays = 5 + random.pick(4);
            let width = bays as f64 * BAY;
            let floors = 4 + random.pick(5);
            let body = Shape::of(|s| {
                s.block(
                    [0.0, 0.5 * (floors as f64 * FLOOR + 1.0), -7.0],
                    [width - 0.4, floors as f64 * FLOOR + 1.0, 14.0],
                )
            });
            let middle = x + 0.5 * width;
            bodies[random.pick(4)].place(&body, turned([middle, 0.0, -FRONTS]), heading);
            let cornice = Shape::of(|s| s.block([0.0, 0.0, 0.15], [width - 0.2, 0.4, 0.6]));
            trim.place(
                &cornice,
                turned([middle, floors as f64 * FLOOR + 0.8, -FRONTS]),
                heading,
            );
            for floor in 0..floors {
                for bay in 0..bays {
                    let at = [
                        x + (bay as f64 + 0.5) * BAY,
                        floor as f64 * FLOOR + 2.2,
                        -FRONTS + 0.03,
                    ];
                    let sill = Shape::of(|s| s.block([0.0, -1.0, 0.1], [1.7, 0.12, 0.24]));
                    trim.place(&sill, turned(at), heading);
                    if random.unit() < 0.36 {
                        let turn = super::super::shapes::rotation([0.0, 1.0, 0.0], heading);
                        b.node("window", None, turned(at), turn, Some(lit[random.pick(4)]));
                    } else {
                        dark.place(&pane, turned(at), heading);
                    }
                }
            }
            x += width;
        }
    }
    let mut shapes: Vec<(&Shape, u32)> = bodies.iter().zip(walls).collect();
    shapes.extend([(&trim, stone), (&dark, glass)]);
    let mesh = b.mesh("houses", &shapes);
    b.put("houses", None, [0.0; 3], mesh);
}
