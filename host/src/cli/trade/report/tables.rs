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
    for (of_scene, file) in points.chunk_by(|a, b| a.scene == b.scene).zip(files(points)) {
        let scene = &of_scene[0].scene;
        let shown = escaped(scene);
        line(format_args!("\n### {shown}\n\n![{shown}]({file})\n"));
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
            line(format_args!("- {}", escaped(sentence)));
        }
    }
    text
}

/// The plots, by the names of their files: time of a frame by the same rays, and the error at equal time.
pub(super) fn plots(points: &[Point]) -> Vec<(String, Scatter)> {
    let plot = |(of_scene, file): (&[Point], String)| {
        let scene = &of_scene[0].scene;
        let spot = |point: &Point| Spot {
            name: point.choice.clone(),
            x: point.images.frame_ratio.median,
            y: point.images.equal_time_ratio.median,
            marked: point.pareto,
        };
        let scatter = Scatter {
            title: format!("{}: time by the same rays, error in the same time", name(scene)),
            x_label: String::from("time of a frame over the default's"),
            y_label: String::from("error at equal time over the default's"),
            spots: of_scene.iter().map(spot).collect(),
        };
        (file, scatter)
    };
    let scenes = points.chunk_by(|a, b| a.scene == b.scene);
    scenes.zip(files(points)).map(plot).collect()
}

fn name(scene: &str) -> String {
    let stem = Path::new(scene).file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// A file for each scene's plot: its name as far as every system and every document takes it, with a number where another has it.
fn files(points: &[Point]) -> Vec<String> {
    let scenes = points.chunk_by(|a, b| a.scene == b.scene);
    numbered(scenes.map(|of_scene| of_scene[0].scene.as_str()))
}

fn numbered<'a>(scenes: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut files: Vec<String> = Vec::new();
    for scene in scenes {
        let plain = |c: char| {
            if c.is_alphanumeric() || "-_".contains(c) {
                c
            } else {
                '-'
            }
        };
        let stem: String = name(scene).chars().take(40).map(plain).collect();
        let file = std::iter::once(format!("trade-{stem}.svg"))
            .chain((2..).map(|k| format!("trade-{stem}-{k}.svg")))
            .find(|file| !files.contains(file));
        files.extend(file);
    }
    files
}

/// As a document's text, on one line.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\n' | '\r' => out.push(' '),
            '[' | ']' | '<' | '>' | '|' | '*' | '`' | '\\' => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out
}

fn ratio(interval: &Interval) -> String {
    let Interval { median, low, high } = interval;
    match median {
        0.0..10.0 => format!("{median:.2} [{low:.2}, {high:.2}]"),
        _ => format!("{median:.0} [{low:.0}, {high:.0}]"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_scene_has_a_plot_of_its_own() {
        let long = format!("x/{}.glb", "y".repeat(245));
        let files = numbered(["a/s.gltf", "b/s.gltf", "](z) <b>.glb", &long, "s-2.glb"].into_iter());
        let y = "y".repeat(40);
        let expected = ["s", "s-2", "--z---b-", y.as_str(), "s-2-2"].map(|stem| format!("trade-{stem}.svg"));
        assert_eq!(files, expected);
        assert_eq!(escaped("a](b)\n<c>|"), r"a\](b) \<c\>\|");
    }
}
