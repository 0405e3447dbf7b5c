//! Line charts with error bars, as SVG: text stays text, and the viewer brings the font.

use std::fmt::Write;

use super::ticks::{label, ticks};

/// Colours that most colour-blind people tell apart (M. Okabe and K. Ito, "Color Universal Design", 2008).
const COLORS: [&str; 7] = [
    "#D55E00", "#000000", "#56B4E9", "#0072B2", "#009E73", "#CC79A7", "#E69F00",
];
/// The area of the axes in a picture of 760 x 420.
const LEFT: f64 = 70.0;
const RIGHT: f64 = 540.0;
const TOP: f64 = 50.0;
const BOTTOM: f64 = 360.0;

/// A value at some place, and how far it may be off in either direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Place on the horizontal axis.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// Half the length of the error bar; 0 for none.
    pub error: f64,
}

/// A line of the chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// By place.
    pub points: Vec<Point>,
}

/// A line chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Above the chart.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// Whether the vertical axis begins at zero.
    pub from_zero: bool,
    /// The lines.
    pub series: Vec<Series>,
}

impl Chart {
    /// The chart as an SVG document. Points that are not finite are left out.
    pub fn svg(&self) -> String {
        let points = || {
            let all = self.series.iter().flat_map(|series| &series.points);
            all.filter(|p| (p.x + p.y + p.error).is_finite())
        };
        let range = |low: &dyn Fn(&Point) -> f64, high: &dyn Fn(&Point) -> f64| {
            let least = points().map(low).fold(f64::INFINITY, f64::min);
            let most = points().map(high).fold(f64::NEG_INFINITY, f64::max);
            if least <= most { (least, most) } else { (0.0, 1.0) }
        };
        let (left, right) = range(&|p| p.x, &|p| p.x);
        let (mut low, high) = range(&|p| p.y - p.error, &|p| p.y + p.error);
        if self.from_zero {
            low = low.min(0.0);
        }
        let x_marks = ticks(left, right, 6);
        let y_marks = ticks(low, high, 6);
        let place = |v: f64, marks: &[f64], from: f64, to: f64| {
            let (first, last) = (marks[0], marks[marks.len() - 1]);
            from + (v - first) / (last - first) * (to - from)
        };
        // A little room left and right of the first and last place.
        let x = |v: f64| place(v, &x_marks, LEFT + 15.0, RIGHT - 15.0);
        let y = |v: f64| place(v, &y_marks, BOTTOM, TOP);

        let mut svg = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 420\" width=\"760\" height=\"420\" \
             font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"760\" height=\"420\" fill=\"white\"/>\n",
        );
        // Writing to a string does not fail.
        let mut line = |text: std::fmt::Arguments<'_>| {
            let _ = writeln!(svg, "{text}");
        };
        let middle = (LEFT + RIGHT) / 2.0;
        let title = escape(&self.title);
        line(format_args!(
            "<text x=\"{middle}\" y=\"28\" text-anchor=\"middle\" font-size=\"16\">{title}</text>"
        ));
        for &mark in &y_marks {
            let (at, text) = (y(mark), label(mark, y_marks[1] - y_marks[0]));
            line(format_args!(
                "<path d=\"M{LEFT} {at:.1}H{RIGHT}\" stroke=\"#ddd\"/>"
            ));
            let base = at + 4.5;
            line(format_args!(
                "<text x=\"{}\" y=\"{base:.1}\" text-anchor=\"end\">{text}</text>",
                LEFT - 8.0
            ));
        }
        for &mark in &x_marks {
            let (at, text) = (x(mark), label(mark, x_marks[1] - x_marks[0]));
            line(format_args!("<path d=\"M{at:.1} {BOTTOM}v5\" stroke=\"#444\"/>"));
            line(format_args!(
                "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{text}</text>",
                BOTTOM + 20.0
            ));
        }
        line(format_args!(
            "<path d=\"M{LEFT} {TOP}V{BOTTOM}H{RIGHT}\" fill=\"none\" stroke=\"#444\"/>"
        ));
        let x_label = escape(&self.x_label);
        line(format_args!(
            "<text x=\"{middle}\" y=\"402\" text-anchor=\"middle\">{x_label}</text>"
        ));
        let (center, y_label) = ((TOP + BOTTOM) / 2.0, escape(&self.y_label));
        line(format_args!(
            "<text transform=\"translate(18 {center}) rotate(-90)\" text-anchor=\"middle\">{y_label}</text>"
        ));

        for (i, series) in self.series.iter().enumerate() {
            // Lines a little apart, so that error bars at one place do not hide each other.
            let aside = (i as f64 - 0.5 * (self.series.len() as f64 - 1.0)) * 3.0;
            let x = |v: f64| x(v) + aside;
            let color = COLORS[i % COLORS.len()];
            let dash = if i / COLORS.len() % 2 == 1 {
                " stroke-dasharray=\"6 3\""
            } else {
                ""
            };
            let shown = || series.points.iter().filter(|p| (p.x + p.y + p.error).is_finite());
            let path: Vec<String> = shown().map(|p| format!("{:.1},{:.1}", x(p.x), y(p.y))).collect();
            let path = path.join(" ");
            line(format_args!(
                "<polyline points=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"{dash}/>"
            ));
            for p in shown() {
                let (at, value) = (x(p.x), y(p.y));
                if p.error > 0.0 {
                    let (top, bottom) = (y(p.y + p.error), y(p.y - p.error));
                    line(format_args!(
                        "<path d=\"M{at:.1} {top:.1}V{bottom:.1}m-4 0h8M{:.1} {top:.1}h8\" stroke=\"{color}\"/>",
                        at - 4.0
                    ));
                }
                line(format_args!(
                    "<circle cx=\"{at:.1}\" cy=\"{value:.1}\" r=\"3.5\" fill=\"{color}\"/>"
                ));
            }
            let row = TOP + 12.0 + 22.0 * i as f64;
            let name = escape(&series.name);
            line(format_args!(
                "<path d=\"M{} {row}h26\" stroke=\"{color}\" stroke-width=\"2\"{dash}/>\
                 <circle cx=\"{}\" cy=\"{row}\" r=\"3.5\" fill=\"{color}\"/>\
                 <text x=\"{}\" y=\"{}\">{name}</text>",
                RIGHT + 18.0,
                RIGHT + 31.0,
                RIGHT + 52.0,
                row + 4.5
            ));
        }
        svg + "</svg>\n"
    }
}

/// Text between tags of SVG.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_stand_where_their_values_are() {
        let point = |x, y| Point { x, y, error: 1.0 };
        let chart = Chart {
            title: String::from("a < b & c"),
            x_label: String::from("frame"),
            y_label: String::from("MSE"),
            from_zero: true,
            series: vec![Series {
                name: String::from("one"),
                points: vec![point(0.0, 0.0), point(60.0, 9.0), point(30.0, f64::NAN)],
            }],
        };
        let svg = chart.svg();
        assert!(svg.contains("a &lt; b &amp; c"));
        // 0 to 60 in tens; the error bars reach from -1 to 10, so the axis from -2 to 10.
        let bottom = BOTTOM - (BOTTOM - TOP) * 2.0 / 12.0;
        let top = BOTTOM - (BOTTOM - TOP) * 11.0 / 12.0;
        assert!(
            svg.contains(&format!("points=\"85.0,{bottom:.1} 525.0,{top:.1}\"")),
            "{svg}"
        );
        assert!(!svg.contains("NaN"));
        // Two points and the legend's.
        assert_eq!(svg.matches("<circle").count(), 3);
        let empty = Chart {
            series: Vec::new(),
            ..chart
        };
        assert!(empty.svg().ends_with("</svg>\n"));
    }
}
