//! What each step along the front costs and buys, in words.

use super::Point;
use super::front::alike;

/// Sentences for the points of a scene: what is as good as the default, and the steps of the front from the fastest on.
pub(super) fn steps(points: &[Point]) -> Vec<String> {
    let mut front: Vec<&Point> = points.iter().filter(|point| point.pareto).collect();
    front.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let mut sentences: Vec<String> = front.windows(2).map(|pair| step(pair[0], pair[1])).collect();
    if let Some(default) = points.iter().find(|point| point.default) {
        let like: Vec<&str> = points
            .iter()
            .filter(|point| !point.default && alike(point, default))
            .map(|point| point.choice.as_str())
            .collect();
        if !like.is_empty() {
            sentences.push(format!("no different from the default here: {}", like.join("; ")));
        }
    }
    sentences
}

fn time(point: &Point) -> f64 {
    point.images.frame_ratio.median
}

fn step(a: &Point, b: &Point) -> String {
    let of = |get: fn(&Point) -> f64| {
        let (before, after) = (get(a), get(b));
        match after / before {
            _ if before == after => "the same".to_owned(),
            ratio if !ratio.is_finite() => "some, where there was no,".to_owned(),
            ratio if ratio < 1.0 => format!("{:.0} % less", 100.0 * (1.0 - ratio)),
            ratio if ratio < 4.0 => format!("{:.0} % more", 100.0 * (ratio - 1.0)),
            ratio => format!("{ratio:.1} times the"),
        }
    };
    format!(
        "from {} to {}: a frame takes {} time, of which the update {:.2} ms for {:.2}, and has {} error by the same rays, {} error at equal time",
        a.choice,
        b.choice,
        of(time),
        b.structure.update_ms,
        a.structure.update_ms,
        of(|point| point.images.error),
        of(|point| point.images.error_equal_time),
    )
}
