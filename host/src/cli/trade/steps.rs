//! What each step along the front costs and buys, in words.

use super::Point;
use super::front::{less, more};
use super::quantile::Interval;

/// Sentences for the points of a scene, from the fastest on: the steps of the front, and what is as good as their ends.
pub(super) fn steps(points: &[Point]) -> Vec<String> {
    let groups = groups(points);
    let mut sentences = Vec::new();
    for (at, group) in groups.iter().enumerate() {
        if at > 0 {
            sentences.push(step(groups[at - 1][0], group[0]));
        }
        let [head, others @ ..] = &group[..] else { continue };
        if !others.is_empty() {
            let names: Vec<&str> = others.iter().map(|point| point.choice.as_str()).collect();
            sentences.push(format!(
                "not surely better or worse than {}: {}",
                head.choice,
                names.join("; ")
            ));
        }
    }
    sentences
}

/// The front by time, what does not surely differ together. The default is the first of its group.
fn groups(points: &[Point]) -> Vec<Vec<&Point>> {
    let mut front: Vec<&Point> = points.iter().filter(|point| point.pareto).collect();
    front.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let mut groups: Vec<Vec<&Point>> = Vec::new();
    // The default first, so that what is like it is in its group and no other.
    let (defaults, others): (Vec<&Point>, Vec<&Point>) = front.into_iter().partition(|point| point.default);
    for point in defaults.into_iter().chain(others) {
        match groups.iter_mut().find(|group| alike(group[0], point)) {
            Some(group) => group.push(point),
            None => groups.push(vec![point]),
        }
    }
    groups.sort_by(|a, b| time(a[0]).total_cmp(&time(b[0])));
    groups
}

fn time(point: &Point) -> f64 {
    point.images.frame_ratio.median
}

fn alike(a: &Point, b: &Point) -> bool {
    let same = |a: &[f64], b: &[f64]| {
        let ratio = Interval::of_ratios(a, b);
        !less(ratio) && !more(ratio)
    };
    same(&a.images.frames, &b.images.frames) && same(&a.images.errors, &b.images.errors)
}

fn step(a: &Point, b: &Point) -> String {
    let of = |get: fn(&Point) -> f64, [less, more]: [&str; 2]| {
        let percent = 100.0 * (get(b) / get(a) - 1.0);
        match percent < 0.0 {
            true => format!("{:.0} % {less}", -percent),
            false if percent < 300.0 => format!("{percent:.0} % {more}"),
            false => format!("{:.1} times the", get(b) / get(a)),
        }
    };
    format!(
        "from {} to {}: a frame takes {} time and has {} error by the same rays, {} error at equal time",
        a.choice,
        b.choice,
        of(time, ["less", "more"]),
        of(|point| point.images.error, ["less", "more"]),
        of(|point| point.images.error_equal_time, ["less", "more"]),
    )
}
