//! Filtering and base colour of textures.

use super::*;

/// A picture is what an oracle says it is, wherever coordinates lie, in every way to go on beyond its edges.
#[test]
fn pictures_are_the_mean_of_four_texels() {
    let (width, height) = (5_u32, 3_u32);
    let texel = |x: u32, y: u32| hash(x + 17 * y);
    let header = (HEADER_WORDS + SRGB_WORDS) as usize;
    let decoded: Vec<f64> = (0..256).map(|byte| f64::from(byte) / 300.0).collect();
    for (columns, rows) in [0, 1, 2].iter().flat_map(|&a| [0, 1, 2].map(|b| (a, b))) {
        for flags in [0, PictureWords::NEAREST] {
            let mut words = vec![0; HEADER_WORDS as usize];
            words.extend(decoded.iter().map(|&x| (x as f32).to_bits()));
            assert_eq!(words.len(), header);
            let own = PictureWords {
                width,
                height,
                flags: flags | (columns << PictureWords::WRAP_COLUMNS) | (rows << PictureWords::WRAP_ROWS),
                transform: [0.5, 0.25, -0.125, 1.5, 0.375, -0.25],
                texels: header as u32 + PictureWords::COUNT,
            };
            words.extend_from_slice(bytemuck::cast_slice(&[own]));
            words.extend((0..height).flat_map(|y| (0..width).map(move |x| texel(x, y))));
            let shown = Words {
                words: &words,
                at: header as u32,
            };
            for k in 0..2000_u32 {
                let random = |n: u32| f64::from(hash(3 * k + n)) / f64::from(u32::MAX);
                // Multiples of 2^-10, so that the oracle starts from the same coordinates.
                let uv = [0, 1].map(|n| ((random(n) * 8.0 - 4.0) * 1024.0).round() / 1024.0);
                let x = 0.5 * uv[0] - 0.125 * uv[1] + 0.375;
                let y = 0.25 * uv[0] + 1.5 * uv[1] - 0.25;
                let cell = |i: f64, size: u32, wrap: u32| -> u32 {
                    let size = f64::from(size);
                    match wrap {
                        PictureWords::REPEAT => i.rem_euclid(size) as u32,
                        PictureWords::CLAMP => i.clamp(0.0, size - 1.0) as u32,
                        _ => {
                            let i = i.rem_euclid(2.0 * size);
                            if i < size {
                                i as u32
                            } else {
                                (2.0 * size - 1.0 - i) as u32
                            }
                        }
                    }
                };
                let number = |byte: u32, is_color: bool| {
                    if is_color {
                        decoded[byte as usize]
                    } else {
                        f64::from(byte) / 255.0
                    }
                };
                let (sx, sy) = (x * f64::from(width), y * f64::from(height));
                let mut expected = [0.0; 4];
                if flags == PictureWords::NEAREST {
                    let word = texel(cell(sx.floor(), width, columns), cell(sy.floor(), height, rows));
                    expected = [0, 1, 2, 3].map(|c| number((word >> (8 * c)) & 255, c < 3));
                } else {
                    let (left, top) = ((sx - 0.5).floor(), (sy - 0.5).floor());
                    let (a, b) = (sx - 0.5 - left, sy - 0.5 - top);
                    for (dx, dy, weight) in [
                        (0.0, 0.0, (1.0 - a) * (1.0 - b)),
                        (1.0, 0.0, a * (1.0 - b)),
                        (0.0, 1.0, (1.0 - a) * b),
                        (1.0, 1.0, a * b),
                    ] {
                        let word = texel(cell(left + dx, width, columns), cell(top + dy, height, rows));
                        for (c, sum) in expected.iter_mut().enumerate() {
                            *sum += weight * number((word >> (8 * c)) & 255, c < 3);
                        }
                    }
                }
                let found = shown.at(uv.map(|x| x as f32));
                let found = [found.r, found.g, found.b, found.a].map(f64::from);
                for c in 0..4 {
                    assert!(
                        (found[c] - expected[c]).abs() < 2e-5,
                        "{columns} {rows} {flags} at {x} {y}: {found:?}, expected {expected:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn base_colours_are_those_of_the_texels() {
    // Left and right of the middle: encoded 188 is 0.5029 linear, 255 is 1.
    let colors = picture(2, 1, |x, _| {
        if x == 0 {
            [188, 0, 255, 255]
        } else {
            [0, 188, 188, 255]
        }
    });
    let half = 0.502_886_5;
    for (aim, albedo) in [
        (-1.0, [0.4 * half, 0.0, 0.6]),
        (1.0, [0.0, 0.8 * half, 0.6 * half]),
    ] {
        let textures = MaterialTextures {
            base: [0.4, 0.8, 0.6, 1.0],
            base_texture: Some(lying(0)),
            ..PLAIN
        };
        let mut data = floor(textures, vec![colors.clone()], [aim, 1.0]);
        // 100 m away, with a cosine of 0.8: 2e4 W/sr are 1.6 W/m².
        add(&mut data, at([aim - 60.0, 80.0, 0.0]), AnalyticKind::Point, 2e4);
        reflects(data, [1.6; 3], albedo, 2e-3);
    }
}
