//! Pictures of few colours: a palette by repeated cuts, where the colours differ most.

use std::collections::BTreeMap;

/// Colours and how often each is there.
type Colors = Vec<([u8; 3], u32)>;

/// At most `most` colours, from 1 to 256, that stand for those of `pixels`, and the index of each pixel's. Boxes of colours are
/// cut at their means, always the one whose colours are furthest from its mean in sum of squares (X. Wu's criterion, by
/// Heckbert's cuts).
pub(super) fn palette(pixels: &[[u8; 3]], most: usize) -> (Vec<[u8; 3]>, Vec<u8>) {
    let mut counts: BTreeMap<[u8; 3], u32> = BTreeMap::new();
    for &pixel in pixels {
        *counts.entry(pixel).or_default() += 1;
    }
    let mut boxes: Vec<(f64, Colors)> = vec![weighed(counts.into_iter().collect())];
    while boxes.len() < most.clamp(1, 256) {
        let worst = (0..boxes.len()).max_by(|&a, &b| boxes[a].0.total_cmp(&boxes[b].0));
        let Some(worst) = worst.filter(|&at| boxes[at].0 > 0.0) else {
            break;
        };
        let (_, colors) = boxes.swap_remove(worst);
        let (axis, mean, _) = widest(&colors);
        let (low, high): (Colors, Colors) = colors
            .into_iter()
            .partition(|(color, _)| f64::from(color[axis]) <= mean);
        boxes.push(weighed(low));
        boxes.push(weighed(high));
    }
    let mut of: BTreeMap<[u8; 3], u8> = BTreeMap::new();
    let mut palette = Vec::new();
    for (index, (_, colors)) in (0..=255).zip(&boxes) {
        palette.push([0, 1, 2].map(|axis| mean(colors, axis).round() as u8));
        of.extend(colors.iter().map(|&(color, _)| (color, index)));
    }
    let indices = pixels
        .iter()
        .map(|pixel| of.get(pixel).copied().unwrap_or(0))
        .collect();
    (palette, indices)
}

/// A box with its sum of squares.
fn weighed(colors: Colors) -> (f64, Colors) {
    (widest(&colors).2, colors)
}

/// The channel in which colours are furthest from their mean, that mean, and the sum of squares in it.
fn widest(colors: &Colors) -> (usize, f64, f64) {
    let of = |axis: usize| {
        let mean = mean(colors, axis);
        let squares = colors.iter().map(|(color, count)| {
            let d = f64::from(color[axis]) - mean;
            f64::from(*count) * d * d
        });
        (axis, mean, squares.sum::<f64>())
    };
    let [red, green, blue] = [of(0), of(1), of(2)];
    let wider = if green.2 >= red.2 { green } else { red };
    if blue.2 > wider.2 { blue } else { wider }
}

fn mean(colors: &Colors, axis: usize) -> f64 {
    let (mut sum, mut all) = (0.0, 0.0);
    for (color, count) in colors {
        sum += f64::from(*count) * f64::from(color[axis]);
        all += f64::from(*count);
    }
    if all > 0.0 { sum / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let pixels = [[255; 3], [0; 3], [255, 64, 64], [0; 3], [3, 2, 1]];
        let (palette, indices) = palette(&pixels, 4);
        assert_eq!(palette.len(), 4);
        let back: Vec<[u8; 3]> = indices.iter().map(|&index| palette[index as usize]).collect();
        assert_eq!(back, pixels);
    }

    #[test]
    fn the_furthest_colours_are_told_apart_and_others_become_their_mean() {
        // Twice as many of 10 as of 13: their mean is 11. The other channels are equal.
        let pixels = [[10, 7, 7], [13, 7, 7], [10, 7, 7], [200, 7, 7]];
        let (palette, indices) = palette(&pixels, 2);
        let back: Vec<u8> = indices.iter().map(|&index| palette[index as usize][0]).collect();
        assert_eq!(back, [11, 11, 11, 200]);
    }

    #[test]
    fn more_than_256_colours_get_256() {
        let pixels: Vec<[u8; 3]> = (0..1024_u32)
            .map(|i| [(i / 4) as u8, (i % 4) as u8 * 80, 0])
            .collect();
        let (palette, indices) = palette(&pixels, 1000);
        assert_eq!(palette.len(), 256);
        assert_eq!(indices.len(), 1024);
        assert!(super::palette(&[], 3).1.is_empty());
    }
}
