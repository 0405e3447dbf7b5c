//! The points as tables and plots for documents: Markdown and SVG.

use std::fmt::Write;
use std::path::Path;

use super::machine::Made;
use crate::cli::trade::Point;
use crate::cli::trade::quantile::Interval;
use crate::plot::{Scatter, Spot};

/// A section for each scene: its plot, its table, the sentences along its front.
pub(super) fn markdown(made: &Made, frame: u32, points: &[Point], steps: &[String]) -> String {
    let mut text = format!(
        "`{}`, {}: {}, {} threads, version {}; frame {frame}.\n",
        made.command, made.date, made.machine, made.threads, made.version
    );
    // Writing to a string does not fail.
    let mut line = |words: std::fmt::Arguments<'_>| {
        let _ = writeln!(text, "{words}");
    };
    for of_scene in points.chunk_by(|a, b| a.scene == b.scene) {
        let scene = &of_scene[0].scene;
        line(format_args!("\n### {scene}\n\n![{scene}]({})\n", file(scene)));
        line(format_args!(
            "| choice | bytes a light | sample | update, beside ms | frame | variance, shadowed | error | at equal time | front |"
        ));
        line(format_args!("|---|---|---|---|---|---|---|---|---|"));
        for point in of_scene {
            let (structure, images) = (&point.structure, &point.images);
            let variances = &structure.variances;
            line(format_args!(
                "| {} | {:.1} | {} | {:.2}, {:.2} | {} | {:.2}, {:.2} | {} | {} | {} |",
                point.choice,
                structure.bytes_per_light,
                ratio(&structure.sample_ratio),
                structure.update_ms,
                structure.beside_ms,
                ratio(&images.frame_ratio),
                variances.variance,
                variances.shadowed_variance,
                ratio(&images.error_ratio),
                ratio(&images.equal_time_ratio),
                if point.pareto { "yes" } else { "" },
            ));
        }
        line(format_args!(""));
        let along = format!("{scene}: ");
        for sentence in steps.iter().filter_map(|step| step.strip_prefix(&along)) {
            line(format_args!("- {sentence}"));
        }
    }
    text
}

/// The plots, by the names of their files: time of a frame and its error, by the same rays.
pub(super) fn plots(points: &[Point]) -> Vec<(String, Scatter)> {
    let plot = |of_scene: &[Point]| {
        let scene = &of_scene[0].scene;
        let spot = |point: &Point| Spot {
            name: point.choice.clone(),
            x: point.images.frame_ratio.median,
            y: point.images.error_ratio.median,
            marked: point.pareto,
        };
        let scatter = Scatter {
            title: format!("{}: time and error of a frame by the same rays", name(scene)),
            x_label: String::from("time of a frame over the default's"),
            y_label: String::from("its error over the default's"),
            spots: of_scene.iter().map(spot).collect(),
        };
        (file(scene), scatter)
    };
    points.chunk_by(|a, b| a.scene == b.scene).map(plot).collect()
}

fn name(scene: &str) -> String {
    let stem = Path::new(scene).file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

fn file(scene: &str) -> String {
    format!("trade-{}.svg", name(scene))
}

fn ratio(interval: &Interval) -> String {
    let Interval { median, low, high } = interval;
    match median {
        0.0..10.0 => format!("{median:.2} [{low:.2}, {high:.2}]"),
        _ => format!("{median:.0} [{low:.0}, {high:.0}]"),
    }
}
