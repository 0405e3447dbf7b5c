//! Points of two ratios, as SVG: both axes by powers, points numbered where there is room, names and figures in the legend.

use std::fmt::Write;

use super::chart::escape;

const LEFT: f64 = 62.0;
const RIGHT: f64 = 520.0;
const TOP: f64 = 44.0;
const ROW: f64 = 17.0;

/// A point, by ratios above zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// In the legend.
    pub name: String,
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// Whether it is filled, and a line goes through all such points that no other one is below and to the left of.
    pub marked: bool,
}

/// Points over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Above the points.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// In the order of the legend. What is not finite and above zero is in the legend alone.
    pub spots: Vec<Spot>,
}

/// An axis by powers, over pixels.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Over all `values`, with room beside the outermost.
    fn over(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min).min(1.0) / 1.15;
        let high = values.fold(0.0, f64::max).max(1.0) * 1.15;
        Self { low, high, from, to }
    }

    fn at(&self, value: f64) -> f64 {
        self.from + (value / self.low).ln() / (self.high / self.low).ln() * (self.to - self.from)
    }

    /// 1, 2 and 5 times powers of ten, or steps of a tenth where those are too few.
    fn marks(&self) -> Vec<f64> {
        let inside = |value: &f64| (self.low..=self.high).contains(value);
        let powers = (-6..=6).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(power)));
        let marks: Vec<f64> = powers.filter(inside).collect();
        if marks.len() >= 3 {
            return marks;
        }
        (1..=100).map(|k| f64::from(k) / 5.0).filter(inside).collect()
    }
}

impl Scatter {
    /// The points as an SVG document.
    pub fn svg(&self) -> String {
        let sound = |spot: &&Spot| spot.x > 0.0 && spot.y > 0.0 && (spot.x + spot.y).is_finite();
        let shown = || self.spots.iter().enumerate().filter(|(_, spot)| sound(spot));
        let bottom = (TOP + ROW * self.spots.len() as f64).max(TOP + 300.0);
        let x = Axis::over(shown().map(|(_, spot)| spot.x), LEFT, RIGHT);
        let y = Axis::over(shown().map(|(_, spot)| spot.y), bottom, TOP);
        let height = bottom + 52.0;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 880 {height}\" width=\"880\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"880\" height=\"{height}\" fill=\"white\"/>\n"
        );
        // Writing to a string does not fail.
        let mut line = |text: std::fmt::Arguments<'_>| {
            let _ = writeln!(svg, "{text}");
        };
        let middle = f64::midpoint(LEFT, RIGHT);
        let [title, x_label, y_label] = [&self.title, &self.x_label, &self.y_label].map(|text| escape(text));
        line(format_args!(
            "<text x=\"{middle}\" y=\"26\" text-anchor=\"middle\" font-size=\"16\">{title}</text>"
        ));
        for mark in x.marks() {
            let (at, color) = (x.at(mark), if mark == 1.0 { "#888" } else { "#e4e4e4" });
            line(format_args!(
                "<path d=\"M{at:.1} {TOP}V{bottom}\" stroke=\"{color}\"/>"
            ));
            line(format_args!(
                "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{mark}</text>",
                bottom + 16.0
            ));
        }
        for mark in y.marks() {
            let (at, color) = (y.at(mark), if mark == 1.0 { "#888" } else { "#e4e4e4" });
            line(format_args!(
                "<path d=\"M{LEFT} {at:.1}H{RIGHT}\" stroke=\"{color}\"/>"
            ));
            line(format_args!(
                "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{mark}</text>",
                LEFT - 6.0,
                at + 4.0
            ));
        }
        line(format_args!(
            "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{x_label}</text>",
            bottom + 38.0
        ));
        line(format_args!(
            "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{y_label}</text>",
            f64::midpoint(TOP, bottom)
        ));
        let marked = || shown().map(|(_, spot)| spot).filter(|spot| spot.marked);
        let beaten = |spot: &&Spot| marked().any(|other| other.x < spot.x && other.y < spot.y);
        let mut front: Vec<&Spot> = marked().filter(|spot| !beaten(spot)).collect();
        front.sort_by(|a, b| a.x.total_cmp(&b.x));
        let path: Vec<String> = front
            .iter()
            .map(|spot| format!("{:.1},{:.1}", x.at(spot.x), y.at(spot.y)))
            .collect();
        line(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#0072B2\" stroke-dasharray=\"5 4\"/>",
            path.join(" ")
        ));
        // What is marked is not covered.
        let all = || {
            shown()
                .filter(|(_, spot)| !spot.marked)
                .chain(shown().filter(|(_, spot)| spot.marked))
        };
        for (_, spot) in all() {
            let (x, y) = (x.at(spot.x), y.at(spot.y));
            let fill = if spot.marked { "#0072B2" } else { "white" };
            line(format_args!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{fill}\" stroke=\"#0072B2\"/>"
            ));
        }
        // Numbers where they cover no other, what is marked first; the legend has the figures of all.
        let mut taken: Vec<[f64; 2]> = shown().map(|(_, spot)| [x.at(spot.x), y.at(spot.y)]).collect();
        let first = shown().filter(|(_, spot)| spot.marked);
        for (number, spot) in first.chain(shown().filter(|(_, spot)| !spot.marked)) {
            let (x, y) = (x.at(spot.x), y.at(spot.y));
            let free = |at: &[f64; 2]| {
                taken
                    .iter()
                    .all(|to| (at[0] - to[0]).abs() > 12.0 || (at[1] - to[1]).abs() > 9.0)
            };
            let places = [
                [13.0, -8.0],
                [13.0, 8.0],
                [-13.0, -8.0],
                [-13.0, 8.0],
                [0.0, -13.0],
                [0.0, 13.0],
            ];
            if let Some(at) = places.map(|[dx, dy]| [x + dx, y + dy]).into_iter().find(free) {
                taken.push(at);
                line(format_args!(
                    "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"middle\">{}</text>",
                    at[0],
                    at[1] + 4.0,
                    number + 1
                ));
            }
        }
        for (row, spot) in self.spots.iter().enumerate() {
            let weight = if spot.marked { " font-weight=\"bold\"" } else { "" };
            line(format_args!(
                "<text x=\"{}\" y=\"{}\"{weight}>{} {}: {}, {}</text>",
                RIGHT + 16.0,
                TOP + 10.0 + ROW * row as f64,
                row + 1,
                escape(&spot.name),
                figure(spot.x),
                figure(spot.y)
            ));
        }
        svg + "</svg>\n"
    }
}

fn figure(value: f64) -> String {
    match value {
        0.0..10.0 => format!("{value:.2}"),
        _ => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(x: f64, y: f64, marked: bool) -> Spot {
        Spot {
            name: format!("a < {x}"),
            x,
            y,
            marked,
        }
    }

    #[test]
    fn points_stand_by_their_powers() {
        let scatter = Scatter {
            title: String::from("t"),
            x_label: String::from("time"),
            y_label: String::from("error"),
            spots: vec![
                spot(1.0, 1.0, true),
                spot(0.25, 3.0, true),
                spot(f64::INFINITY, 1.0, false),
                // Another is below and to the left.
                spot(0.5, 4.0, true),
            ],
        };
        let svg = scatter.svg();
        let (x, y) = (
            Axis::over([1.0, 0.25].into_iter(), LEFT, RIGHT),
            Axis::over([1.0, 4.0].into_iter(), TOP + 300.0, TOP),
        );
        // The middle of two powers is the middle of the line.
        assert!((x.at(0.5) - f64::midpoint(x.at(0.25), x.at(1.0))).abs() < 1e-9);
        let from_left = format!(
            "points=\"{:.1},{:.1} {:.1},{:.1}\"",
            x.at(0.25),
            y.at(3.0),
            x.at(1.0),
            y.at(1.0)
        );
        assert!(svg.contains(&from_left), "{svg}");
        assert_eq!(svg.matches("<circle").count(), 3);
        assert_eq!(svg.matches("a &lt; ").count(), 4);
        assert!(svg.contains("a &lt; 0.25: 0.25, 3.00</text>"), "{svg}");
        // A heap has one number.
        let heap = Scatter {
            spots: vec![
                spot(1.0, 1.0, false),
                spot(1.001, 1.0, true),
                spot(1.0, 1.002, false),
                spot(4.0, 4.0, false),
            ],
            ..scatter
        };
        let numbers = heap.svg().matches("font-size=\"11\"").count();
        assert!((2..=4).contains(&numbers), "{numbers}");
        assert_eq!(x.marks(), [0.4, 0.6, 0.8, 1.0]);
    }
}
