//! Houses with windows, some of them lit, shop fronts, awnings and café tables.

use super::super::builder::SceneBuilder;
use super::super::random::Random;
use super::super::shapes::Shape;
use super::{FACADE, HALF_LENGTH, Palette};

/// Height of the ground floor and of the others, metres.
const GROUND_FLOOR: f64 = 4.2;
const FLOOR: f64 = 3.2;

/// Width of a window with the wall beside it, metres.
const BAY: f64 = 2.6;

/// Static shapes, gathered over all houses, and the lit panes to come.
#[derive(Default)]
struct Houses {
    walls: [Shape; 4],
    trim: Shape,
    glass: Shape,
    awnings: [Shape; 3],
    doors: Shape,
    /// Centre of each pane and the side of the street it is on.
    lit_windows: Vec<([f64; 3], f64)>,
    shop_fronts: Vec<([f64; 3], f64)>,
    tables: Vec<[f64; 3]>,
}

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, palette: &Palette) {
    let mut houses = Houses::default();
    for side in [-1.0, 1.0] {
        let mut z = -HALF_LENGTH;
        while z < HALF_LENGTH - 4.0 {
            let bays = 4 + random.pick(3);
            let bays = bays.min(((HALF_LENGTH - z) / BAY) as usize).max(1);
            houses.add_house(random, side, z, bays);
            z += bays as f64 * BAY;
        }
    }

    let wall_colors = [
        [0.52, 0.38, 0.28],
        [0.55, 0.50, 0.42],
        [0.45, 0.26, 0.20],
        [0.40, 0.42, 0.45],
    ];
    let walls = wall_colors.map(|color| b.matte("plaster", color, 0.9));
    let awning_colors = [[0.55, 0.08, 0.07], [0.08, 0.25, 0.14], [0.70, 0.62, 0.45]];
    let awnings = awning_colors.map(|color| b.matte("awning", color, 0.9));
    let glass = b.matte("dark glass", [0.04, 0.05, 0.06], 0.1);
    let mut shapes: Vec<(&Shape, u32)> = houses.walls.iter().zip(walls).collect();
    shapes.extend(houses.awnings.iter().zip(awnings));
    shapes.extend([
        (&houses.trim, palette.stone),
        (&houses.glass, glass),
        (&houses.doors, palette.wood),
    ]);
    let mesh = b.mesh("houses", &shapes);
    b.put("houses", None, [0.0; 3], mesh);
    add_panes(b, random, &houses);
    add_tables(b, &houses, palette);
}

impl Houses {
    fn add_house(&mut self, random: &mut Random, side: f64, z: f64, bays: usize) {
        let floors = 2 + random.pick(3);
        let style = random.pick(self.walls.len());
        let (width, height) = (bays as f64 * BAY, GROUND_FLOOR + floors as f64 * FLOOR);
        let (front, back) = (side * FACADE, side * (FACADE + 8.0));
        self.walls[style].cuboid([front.min(back), 0.0, z], [front.max(back), height, z + width]);
        let middle = z + 0.5 * width;
        for (y, depth) in [(height - 0.15, 0.5), (GROUND_FLOOR - 0.1, 0.25)] {
            self.trim
                .block([front - side * 0.5 * depth, y, middle], [depth, 0.28, width]);
        }
        for bay in 0..bays {
            let z = z + (bay as f64 + 0.5) * BAY;
            for floor in 0..floors {
                let y = GROUND_FLOOR + floor as f64 * FLOOR + 1.6;
                self.add_window([front, y, z], side, random.unit() < 0.24);
            }
        }
        self.add_shop(random, side, z, bays);
    }

    /// A frame of four bars with a sill, 1.2 m by 1.8 m inside.
    fn add_window(&mut self, [x, y, z]: [f64; 3], side: f64, lit: bool) {
        let out = x - side * 0.05;
        for end in [-1.0, 1.0] {
            self.trim.block([out, y + end * 0.95, z], [0.1, 0.1, 1.4]);
            self.trim.block([out, y, z + end * 0.65], [0.1, 1.8, 0.1]);
        }
        self.trim.block([x - side * 0.12, y - 1.03, z], [0.24, 0.06, 1.6]);
        let pane = [x - side * 0.02, y, z];
        if lit {
            self.lit_windows.push((pane, side));
        } else {
            self.glass.quad(pane_corners(pane, side, [1.2, 1.8]));
        }
    }

    /// A door in the first bay; shop windows, awnings and café tables along the others.
    fn add_shop(&mut self, random: &mut Random, side: f64, z: f64, bays: usize) {
        let front = side * FACADE;
        self.doors
            .block([front - side * 0.04, 1.25, z + 0.5 * BAY], [0.1, 2.4, 1.2]);
        let color = random.pick(self.awnings.len());
        let cafe = random.unit() < 0.5;
        for bay in 1..bays {
            let z = z + (bay as f64 + 0.5) * BAY;
            let pane = [front - side * 0.02, 1.6, z];
            if bay % 2 == 1 {
                self.shop_fronts.push((pane, side));
            } else {
                self.glass.quad(pane_corners(pane, side, [2.2, 2.0]));
            }
            let (inner, outer) = (front, front - side * 1.5);
            let slope = [
                [inner, 3.4, z + 1.25],
                [inner, 3.4, z - 1.25],
                [outer, 2.8, z - 1.25],
                [outer, 2.8, z + 1.25],
            ];
            let under = [slope[3], slope[2], slope[1], slope[0]].map(|[x, y, z]| [x, y - 0.03, z]);
            // Seen from above on the left side of the street; the right side is its mirror image.
            let (top, bottom) = if side > 0.0 {
                (slope, under)
            } else {
                (under, slope)
            };
            self.awnings[color].quad(top).quad(bottom);
            if cafe {
                self.tables.push([front - side * 1.6, 0.12, z + 0.4]);
            }
        }
    }
}

/// A vertical pane that faces the street; `size` is its width and height in metres.
fn pane_corners([x, y, z]: [f64; 3], side: f64, size: [f64; 2]) -> [[f64; 3]; 4] {
    let (w, h) = (0.5 * size[0] * side, 0.5 * size[1]);
    [
        [x, y - h, z - w],
        [x, y - h, z + w],
        [x, y + h, z + w],
        [x, y + h, z - w],
    ]
}

/// Lit panes as instances: one mesh per colour and side, every pane a mesh light.
fn add_panes(b: &mut SceneBuilder, random: &mut Random, houses: &Houses) {
    let colors = [
        [1.0, 0.58, 0.22],
        [0.85, 0.62, 0.36],
        [0.32, 0.45, 0.7],
        [0.9, 0.42, 0.15],
    ];
    let glows = colors.map(|radiance| b.glow("lit window", radiance));
    let shop = b.glow("shop front", [0.85, 0.62, 0.34]);
    for (panes, size, name) in [
        (&houses.lit_windows, [1.2, 1.8], "window"),
        (&houses.shop_fronts, [2.2, 2.0], "shop front"),
    ] {
        let sides = [-1.0, 1.0].map(|side| {
            let pane = Shape::of(|s| s.quad(pane_corners([0.0; 3], side, size)));
            if name == "window" {
                glows.map(|glow| b.mesh(name, &[(&pane, glow)]))
            } else {
                [b.mesh(name, &[(&pane, shop)]); 4]
            }
        });
        for &(at, side) in panes {
            b.put(
                name,
                None,
                at,
                sides[usize::from(side > 0.0)][random.pick(colors.len())],
            );
        }
    }
}

/// Round tables with two stools and a candle.
fn add_tables(b: &mut SceneBuilder, houses: &Houses, palette: &Palette) {
    let mut wood = Shape::new();
    wood.cylinder([0.0, 0.70, 0.0], [0.4, 0.4], 0.04, 12)
        .cylinder([0.0, 0.0, 0.0], [0.04, 0.04], 0.7, 6);
    for x in [-0.7, 0.7] {
        wood.cylinder([x, 0.42, 0.0], [0.2, 0.2], 0.04, 8)
            .cylinder([x, 0.0, 0.0], [0.03, 0.03], 0.42, 4);
    }
    let table = b.mesh("table", &[(&wood, palette.wood)]);
    let flame = b.glow("candle", [90.0, 48.0, 16.0]);
    let candle = Shape::of(|s| s.octahedron([0.0, 0.82, 0.0], 0.05));
    let candle = b.mesh("candle", &[(&candle, flame)]);
    for &at in &houses.tables {
        b.put("table", None, at, table);
        b.put("candle", None, at, candle);
    }
}
