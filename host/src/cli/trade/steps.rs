//! What each step along the front costs and buys, in words.

use super::front::alike;
use super::point::Point;

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
    let of = |get: fn(&Point) -> f64| change(get(a), get(b));
    format!(
        "from {} to {}: frame time {} (update {:.2} ms, before {:.2}); error {} by the same rays, {} at equal time",
        a.choice,
        b.choice,
        of(time),
        b.structure.update_ms,
        a.structure.update_ms,
        of(|point| point.images.error),
        of(|point| point.images.error_equal_time),
    )
}

/// How a figure that is not negative changes.
fn change(before: f64, after: f64) -> String {
    let percent = |part: f64| format!("{:.0} %", 100.0 * part);
    match after / before {
        _ if before == after => "the same".to_owned(),
        ratio if !ratio.is_finite() => "some, before none".to_owned(),
        ratio if ratio < 1.0 => format!("{} less", percent(1.0 - ratio)),
        ratio if ratio < 2.0 => format!("{} more", percent(ratio - 1.0)),
        ratio => format!("{ratio:.1} times"),
    }
}

#[cfg(test)]
mod tests {
    use super::change;

    #[test]
    fn changes_are_said_in_words() {
        let said = [
            (2.0, 2.0),
            (0.0, 0.0),
            (0.0, 1.0),
            (4.0, 3.0),
            (4.0, 5.0),
            (2.0, 9.0),
        ]
        .map(|(a, b)| change(a, b));
        assert_eq!(
            said,
            [
                "the same",
                "the same",
                "some, before none",
                "25 % less",
                "25 % more",
                "4.5 times"
            ]
        );
    }
}
