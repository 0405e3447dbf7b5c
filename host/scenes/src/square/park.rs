//! Trees with fairy lights, path lamps and a fountain.

use super::super::builder::SceneBuilder;
use super::super::random::Random;
use super::super::shapes::{Shape, on_circle};
use super::PARK;

/// Trees in the park.
const TREES: usize = 210;

/// Fairy lights in each tree.
const LIGHTS_PER_TREE: u32 = 9;

pub(super) fn add(b: &mut SceneBuilder, random: &mut Random, iron: u32) {
    trees(b, random);
    path_lamps(b, iron);
    fountain(b);
}

fn trees(b: &mut SceneBuilder, random: &mut Random) {
    let bark = b.matte("bark", [0.16, 0.11, 0.07], 1.0);
    let leaves =
        [[0.10, 0.24, 0.06], [0.14, 0.26, 0.05], [0.07, 0.18, 0.07]].map(|c| b.matte("leaves", c, 1.0));
    let kinds: Vec<(u32, f64)> = leaves
        .iter()
        .zip([1.0, 1.25, 0.8])
        .map(|(&leaf, size)| {
            let trunk = Shape::of(|s| s.cylinder([0.0; 3], [0.22 * size, 0.14 * size], 3.0 * size, 7));
            let mut crown = Shape::new();
            for _ in 0..2 {
                let at = [
                    random.between(-0.8, 0.8) * size,
                    random.between(3.4, 4.8) * size,
                    random.between(-0.8, 0.8) * size,
                ];
                let radius = random.between(1.2, 1.6) * size;
                crown.icosphere(at, [radius, 0.85 * radius, radius], 1);
            }
            (b.mesh("tree", &[(&trunk, bark), (&crown, leaf)]), size)
        })
        .collect();

    let glows =
        [[260.0, 170.0, 85.0], [280.0, 100.0, 36.0], [80.0, 130.0, 260.0]].map(|c| b.glow("fairy light", c));
    let lights = glows.map(|glow| {
        let bulb = Shape::of(|s| s.octahedron([0.0; 3], 0.05));
        b.mesh("fairy light", &[(&bulb, glow)])
    });
    for _ in 0..TREES {
        let at = loop {
            let at = [
                random.between(-PARK + 3.0, PARK - 3.0),
                0.0,
                random.between(-PARK + 3.0, PARK - 3.0),
            ];
            // Paths and the round place in the middle stay free.
            if at[0].abs() > 4.5 && at[2].abs() > 4.5 && at[0] * at[0] + at[2] * at[2] > 18.0 * 18.0 {
                break at;
            }
        };
        let (mesh, size) = kinds[random.pick(kinds.len())];
        let tree = b.put("tree", None, at, mesh);
        let color = random.pick(lights.len());
        for i in 0..LIGHTS_PER_TREE {
            // Around the crown's widest part, where the leaves do not hide them.
            let [c, s] = on_circle((f64::from(i) + random.unit()) / f64::from(LIGHTS_PER_TREE));
            let radius = random.between(2.3, 2.6) * size;
            let y = random.between(2.6, 4.6) * size;
            b.put(
                "fairy light",
                Some(tree),
                [radius * c, y, radius * s],
                lights[color],
            );
        }
    }
}

/// Along both crossing paths, round the middle and along the park's edge.
fn path_lamps(b: &mut SceneBuilder, iron: u32) {
    let post = Shape::of(|s| {
        s.cylinder([0.0; 3], [0.07, 0.05], 3.0, 6)
            .cylinder([0.0, 3.32, 0.0], [0.28, 0.05], 0.15, 8)
    });
    let globe = Shape::of(|s| s.icosphere([0.0, 3.16, 0.0], [0.15; 3], 0));
    let glow = b.glow("path lamp", [150.0, 112.0, 62.0]);
    let lamp = b.mesh("path lamp", &[(&globe, glow), (&post, iron)]);
    let mut places = Vec::new();
    let mut along = -PARK + 2.0;
    while along < PARK {
        for side in [-2.6, 2.6] {
            if along.abs() > 15.0 {
                places.extend([[along, side], [side, along]]);
            }
        }
        for edge in [-PARK - 1.0, PARK + 1.0] {
            places.extend([[along, edge], [edge, along]]);
        }
        along += 5.0;
    }
    for i in 0..24 {
        let [c, s] = on_circle((f64::from(i) + 0.5) / 24.0);
        places.push([14.6 * c, 14.6 * s]);
    }
    for [x, z] in places {
        b.put("path lamp", None, [x, 0.0, z], lamp);
    }
}

/// Three basins with a ring of lights under each rim.
fn fountain(b: &mut SceneBuilder) {
    let stone = b.matte("fountain stone", [0.6, 0.58, 0.54], 0.6);
    let glow = b.glow("fountain light", [40.0, 100.0, 140.0]);
    let mut basins = Shape::new();
    let bulb = b.solid("fountain light", glow, |s| s.octahedron([0.0; 3], 0.07));
    for (radius, y, lights) in [(5.0, 0.0, 32), (2.6, 1.3, 20), (1.2, 2.4, 12)] {
        basins.cylinder([0.0, y, 0.0], [0.6 * radius, radius], 0.6, 24);
        basins.cylinder([0.0, y, 0.0], [0.3, 0.3], 1.4, 10);
        for i in 0..lights {
            let [c, s] = on_circle(f64::from(i) / f64::from(lights));
            b.put(
                "fountain light",
                None,
                [(radius + 0.1) * c, y + 0.68, (radius + 0.1) * s],
                bulb,
            );
        }
    }
    let mesh = b.mesh("fountain", &[(&basins, stone)]);
    b.put("fountain", None, [0.0; 3], mesh);
}
