use std::collections::HashMap;

use super::*;
use crate::scene::random::Random;
use crate::vector::{cross, dot, sub};

fn triangles(corners: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let mut out = Vec::new();
    cut(corners, |triangle| out.push(triangle));
    out
}

/// The triangles of a polygon, each side of which is that of one, and any other side that of two which turn alike.
fn joined(corners: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let (count, all) = (corners.len(), triangles(corners));
    assert_eq!(all.len(), count - 2);
    let mut sides: HashMap<(usize, usize), i32> = HashMap::new();
    for side in all.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]) {
        *sides.entry(side).or_default() += 1;
    }
    for (&(a, b), &times) in &sides {
        let expected = i32::from((a + 1) % count == b);
        let back = sides.get(&(b, a)).copied().unwrap_or_default();
        assert_eq!(
            times - back,
            expected - i32::from((b + 1) % count == a),
            "{a} {b}"
        );
    }
    all
}

fn fan(count: usize) -> Vec<[usize; 3]> {
    (2..count).map(|k| [0, k - 1, k]).collect()
}

fn flat(places: &[Place]) -> Vec<[f32; 3]> {
    places.iter().map(|&[x, y]| [x as f32, y as f32, 0.0]).collect()
}

fn doubled_area(places: &[Place]) -> f64 {
    let next = places.iter().cycle().skip(1);
    places
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum()
}

/// Places whose coordinates are whole numbers below 2^12, so that all is exact: no triangle may be turned over, and their areas
/// are the polygon's. Returns the number of those without an area.
fn covers(places: &[Place]) -> usize {
    let all = joined(&flat(places));
    let areas: Vec<f64> = all.iter().map(|t| doubled_area(&t.map(|k| places[k]))).collect();
    let sign = doubled_area(places).signum();
    assert!(
        areas.iter().all(|area| area * sign >= 0.0),
        "{places:?} {all:?} {areas:?}"
    );
    assert_eq!(
        areas.iter().map(|area| area.abs()).sum::<f64>(),
        doubled_area(places).abs()
    );
    areas.iter().filter(|&&area| area == 0.0).count()
}

/// A corner at each of `count` angles.
fn round(count: usize, radius: impl FnMut(usize) -> f64) -> Vec<Place> {
    let angle = |k: usize| k as f64 / count as f64 * std::f64::consts::TAU;
    let at = |(k, r): (usize, f64)| [r * libm::cos(angle(k)), r * libm::sin(angle(k))];
    (0..count).map(radius).enumerate().map(at).collect()
}

/// Teeth that stand on a bar.
fn comb(count: usize) -> Vec<Place> {
    let mut places: Vec<Place> = (0..count - 2)
        .map(|k| [k as f64, if k % 2 == 0 { 9.0 } else { 1.0 }])
        .collect();
    places.extend([[(count - 3) as f64, 0.0], [0.0, 0.0]]);
    places
}

/// The outline of passages between `side * side` rooms of a maze.
fn maze(side: usize, random: &mut Random) -> Vec<Place> {
    let width = 2 * side + 1;
    let mut open = vec![false; width * width];
    let mut seen = vec![false; side * side];
    let mut path = vec![0];
    (open[width + 1], seen[0]) = (true, true);
    while let Some(&room) = path.last() {
        let (x, y) = (room % side, room / side);
        let doors = [
            (x > 0, -1_isize, -1_isize),
            (x + 1 < side, 1, 1),
            (y > 0, -(side as isize), -(width as isize)),
        ];
        let doors = doors
            .into_iter()
            .chain([(y + 1 < side, side as isize, width as isize)]);
        let to = |step: isize| room.wrapping_add_signed(step);
        let doors: Vec<_> = doors.filter(|&(is, step, _)| is && !seen[to(step)]).collect();
        if doors.is_empty() {
            path.pop();
            continue;
        }
        let (_, step, cell) = doors[random.pick(doors.len())];
        let here = (2 * y + 1) * width + 2 * x + 1;
        open[here.wrapping_add_signed(cell)] = true;
        open[here.wrapping_add_signed(2 * cell)] = true;
        seen[to(step)] = true;
        path.push(to(step));
    }
    outline(&open, width)
}

/// The outline of open cells, of which (1, 1) is in the first row and those of the rim are none. Two that share a corner alone
/// are apart there.
fn outline(open: &[bool], width: usize) -> Vec<Place> {
    let is_open = |x: i32, y: i32| open[y as usize * width + x as usize];
    let (mut at, mut step) = ([1, 1], [1, 0]);
    let mut places = Vec::new();
    loop {
        places.push(at.map(f64::from));
        at = [at[0] + step[0], at[1] + step[1]];
        let [dx, dy] = step;
        // Cells lie between whole numbers.
        let cell = |side: i32| {
            is_open(
                (2 * at[0] + dx - side * dy - 1) / 2,
                (2 * at[1] + dy + side * dx - 1) / 2,
            )
        };
        step = match [cell(1), cell(-1)] {
            [true, true] => [dy, -dx],
            [true, false] => step,
            [false, _] => [-dy, dx],
        };
        if (at, step) == ([1, 1], [1, 0]) {
            return places;
        }
    }
}

/// What has corners only outwards stays as it was, however it lies and wherever it begins; also where their rounding dents it.
#[test]
fn convex_polygons_are_fans() {
    for count in (3..40).chain([1000]) {
        let tilted = |&[x, y]: &Place| [x + 5.0, 0.6 * y - 0.8, 0.8 * y - 0.3 * x].map(|c| c as f32);
        let mut corners: Vec<_> = round(count, |_| 2.0).iter().map(tilted).collect();
        assert_eq!(joined(&corners), fan(count));
        corners.reverse();
        assert_eq!(joined(&corners), fan(count));
    }
    assert_eq!(triangles(&[[0.0; 3]; 2]), fan(2));
    let mut dents = 0;
    for first in 0..10 {
        let mut places = round(20_000, |_| 2.0);
        places.rotate_left(first);
        let corners = flat(
            &places
                .iter()
                .map(|[x, y]| [x + 60.0, y - 50.0])
                .collect::<Vec<_>>(),
        );
        assert_eq!(triangles(&corners), fan(20_000));
        let areas = fan(20_000)
            .into_iter()
            .map(|t| turn(t.map(|k| place(corners[k], [0, 1]))));
        dents += areas.filter(|&area| area < 0.0).count();
    }
    assert!(dents > 0);
}

/// A notch is where another diagonal must be taken, whichever corner is first.
#[test]
fn darts_are_cut_at_their_notch() {
    for turns in 0..8 {
        let mut dart = vec![[-2.0, 2.0], [0.0, 0.5], [2.0, 2.0], [0.0, -2.0]];
        dart.rotate_left(turns % 4);
        if turns > 3 {
            dart.reverse();
        }
        assert_eq!(
            covers(&dart.iter().map(|p| p.map(|c| 2.0 * c)).collect::<Vec<_>>()),
            0
        );
        let notch = dart.iter().position(|place| place[1] == 0.5);
        let all = triangles(&flat(&dart));
        assert!(
            all.iter()
                .all(|triangle| triangle.iter().any(|&k| Some(k) == notch)),
            "{all:?}"
        );
        let unchanged = notch.is_some_and(|notch| notch % 2 == 0);
        assert_eq!(all == fan(4), unchanged);
    }
}

#[test]
fn mazes_and_combs_are_covered_once() {
    let mut random = Random::new(1);
    for case in 0..200 {
        let mut places = match case % 4 {
            0 => comb(5 + random.pick(200)),
            // Many corners in a row, at which a maze goes straight on.
            _ => maze(2 + random.pick(12), &mut random),
        };
        let first = random.pick(places.len());
        places.rotate_left(first);
        // Other directions, and all of it exact.
        let [a, b, c, d] = [
            [1.0, 0.0, 0.0, 1.0],
            [3.0, 1.0, -1.0, 2.0],
            [0.0, 1.0, 1.0, 0.0],
            [7.0, 5.0, 4.0, 3.0],
        ][random.pick(4)];
        let places: Vec<Place> = places
            .iter()
            .map(|[x, y]| [a * x + b * y, c * x + d * y])
            .collect();
        assert_eq!(covers(&places), 0, "{case}");
    }
}

/// Wherever their plane lies, the area of stars is what their corners say.
#[test]
fn stars_keep_their_area_in_every_plane() {
    let mut random = Random::new(2);
    for _ in 0..100 {
        let count = 5 + random.pick(300);
        let places = round(count, |_| random.between(0.1, 3.0));
        let unit = |v: [f64; 3]| v.map(|c| c / dot(v, v).sqrt());
        let mut direction = || unit([0; 3].map(|_| random.between(-1.0, 1.0)));
        let (u, w) = (direction(), direction());
        let normal = unit(cross(u, w));
        let v = cross(normal, u);
        let middle = direction().map(|c| 4.0 * c);
        let corner = |&[x, y]: &Place| [0, 1, 2].map(|k| (middle[k] + x * u[k] + y * v[k]) as f32);
        let corners: Vec<_> = places.iter().map(corner).collect();
        // Each coordinate is below 8 and so off by half of 2^-21 at most, also where it is rounded before; a corner by twice that.
        let off = 2.0_f64.powi(-21);
        let (mut sum, mut tolerance) = (0.0, 0.0);
        for triangle in joined(&corners) {
            let [a, b, c] = triangle.map(|k| corners[k].map(f64::from));
            let sides = [sub(b, a), sub(c, b), sub(a, c)];
            let rounding =
                off * sides.iter().map(|&side| dot(side, side).sqrt()).sum::<f64>() + 4.0 * off * off;
            let area = 0.5 * dot(cross(sides[0], sides[1]), normal);
            assert!(area > -rounding, "{area} {rounding}");
            sum += area.abs();
            tolerance += 2.0 * rounding;
        }
        let expected = 0.5 * doubled_area(&places);
        assert!(
            (sum - expected).abs() <= tolerance,
            "{sum} {expected} {tolerance}"
        );
    }
}

/// Holes are often written so: a seam leads to them and back.
#[test]
fn polygons_that_touch_themselves_are_covered_once() {
    let outer = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]];
    let hole = [[3.0, 3.0], [3.0, 6.0], [6.0, 6.0], [6.0, 3.0]];
    for first in 0..10 {
        let mut places = outer.to_vec();
        places.push(outer[0]);
        places.extend(hole);
        places.push(hole[0]);
        places.rotate_left(first);
        covers(&places);
    }
    // Slits without a width from one side, or from both.
    let mut random = Random::new(5);
    for _ in 0..100 {
        let mut places = Vec::new();
        for (count, top, sign) in [(1 + random.pick(40), 9.0, 1.0), (random.pick(40), 0.0, -1.0)] {
            let mut slits: Vec<Place> = Vec::new();
            for k in 0..count {
                let x = if sign > 0.0 { 40 - k } else { k } as f64;
                let depth = top - sign * (1 + random.pick(4)) as f64;
                slits.extend([[x, top], [x, depth], [x, top]]);
            }
            places.extend([[20.0 + 21.0 * sign, top]]);
            places.append(&mut slits);
            places.extend([[20.0 - 21.0 * sign, top]]);
        }
        let first = random.pick(places.len());
        places.rotate_left(first);
        covers(&places);
    }
    // Heaps of squares, of which some share a corner alone.
    for _ in 0..400 {
        let width = 4 + random.pick(12);
        let mut open = vec![false; width * width];
        for _ in 0..2 * width * width {
            let here = [0; 2].map(|_| 1 + random.pick(width - 2));
            open[here[1] * width + here[0]] |= random.unit() < 0.3;
        }
        open[width + 1] = true;
        let mut places = outline(&open, width);
        let first = random.pick(places.len());
        places.rotate_left(first);
        covers(&places);
    }
    // Two squares that share a corner.
    let twins = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [8.0, 4.0],
        [8.0, 8.0],
        [4.0, 8.0],
        [4.0, 4.0],
        [0.0, 4.0],
    ];
    for first in 0..8 {
        let mut places = twins.to_vec();
        places.rotate_left(first);
        covers(&places);
    }
}

/// All end, in `n - 2` triangles that hang together.
#[test]
fn polygons_that_are_none_end() {
    let mut random = Random::new(3);
    let most = f32::MAX;
    for count in [4, 5, 8, 100, 3000] {
        let mut any = |scale: f64| [0; 3].map(|_| (scale * random.between(-1.0, 1.0)) as f32);
        let crossing: Vec<_> = (0..count).map(|_| any(1.0)).collect();
        joined(&crossing);
        joined(&(0..count).map(|_| any(1e-44)).collect::<Vec<_>>());
        joined(&crossing.iter().map(|v| v.map(|c| c * most)).collect::<Vec<_>>());
        joined(&vec![[1.0; 3]; count]);
        joined(
            &(0..count)
                .map(|k| [(k * k % 7) as f32, 0.0, 0.0])
                .collect::<Vec<_>>(),
        );
        let few = crossing.iter().map(|v| [v[0].round(), v[1].round(), 0.0]);
        joined(&few.collect::<Vec<_>>());
        for odd in [f32::NAN, f32::INFINITY] {
            let mut corners = crossing.clone();
            corners[count / 2][1] = odd;
            joined(&corners);
        }
    }
    joined(&[[0.0; 3], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
}

/// Boxes looked into grow no faster than a logarithm where notches are in a row, in any direction; in a star of random rays as
/// a root.
#[test]
fn work_is_bounded() {
    let looks = |places: Vec<Place>| {
        let count = places.len();
        let mut ring = Ring::new(places);
        let mut area = 0.0;
        let all = ring.places.clone();
        let mut around = vec![0; count];
        ring.cut(|triangle| {
            area += turn(triangle.map(|k| all[k])).abs();
            for corner in triangle {
                around[corner] += 1;
            }
        });
        let expected = doubled_area(&all);
        assert!((area - expected).abs() <= expected * count as f64 * f64::EPSILON);
        let looks = notches::MOST_LOOKS as f64 - ring.notches.looks() as f64 / count as f64;
        (looks, around.into_iter().max().unwrap_or(0))
    };
    for [a, b] in [[1.0, 0.0], [1.0, 1.0], [3.0, 1.0]] {
        let turned = |[x, y]: Place| [a * x - b * y, b * x + a * y];
        let [few, many] = [1000, 16_000].map(|count| {
            let mut places: Vec<Place> = comb(count).into_iter().map(turned).collect();
            places.reverse();
            looks(places)
        });
        assert!(few.0 <= 32.0 && many.0 <= few.0 + 16.0, "{few:?} {many:?}");
    }
    let mut random = Random::new(4);
    let [few, many] = [1000, 16_000].map(|count| looks(round(count, |_| random.between(0.01, 1.0))));
    assert!(few.0 <= 64.0 && many.0 <= 4.0 * few.0, "{few:?} {many:?}");
    // Nor are there many triangles around one corner.
    assert!(few.1 <= 32 && many.1 <= 32, "{few:?} {many:?}");
}
