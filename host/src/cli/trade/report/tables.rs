//! The points as tables and plots for documents: Markdown and SVG.

use std::fmt::Write;

use super::machine::Made;
use crate::cli::trade::point::Point;
use crate::cli::{table, target};
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
                "| {} | {:.1} | {} | {:.2}, {:.2} | {} | {}, {} | {} | {} | {} |",
                point.choice,
                structure.bytes_per_light,
                structure.sample_ratio,
                structure.update_ms,
                structure.beside_ms,
                images.frame_ratio,
                table::known(variances.variance, 2),
                table::known(variances.shadowed_variance, 2),
                images.error_ratio,
                images.equal_time_ratio,
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

/// The plots, by the names of their files: the error of a frame over its time, both by the same rays.
pub(super) fn plots(points: &[Point]) -> Vec<(String, Scatter)> {
    let plot = |(of_scene, file): (&[Point], String)| {
        let spot = |point: &Point| Spot {
            name: point.choice.clone(),
            x: point.images.frame_ratio.median,
            y: point.images.error_ratio.median,
            marked: point.pareto,
        };
        let scatter = Scatter {
            title: format!("{}: error over time, by the same rays", of_scene[0].scene),
            x_label: String::from("time of a frame over the default's"),
            y_label: String::from("error over the default's"),
            spots: of_scene.iter().map(spot).collect(),
        };
        (file, scatter)
    };
    let scenes = points.chunk_by(|a, b| a.scene == b.scene);
    scenes.zip(files(points)).map(plot).collect()
}

/// A file for each scene's plot.
fn files(points: &[Point]) -> Vec<String> {
    let scenes = points.chunk_by(|a, b| a.scene == b.scene);
    let stems = target::stems(scenes.map(|of_scene| of_scene[0].scene.as_str()));
    stems
        .into_iter()
        .map(|stem| format!("trade-{stem}.svg"))
        .collect()
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

#[cfg(test)]
mod tests {
    #[test]
    fn names_are_text_in_documents() {
        assert_eq!(super::escaped("a](b)\n<c>|"), r"a\](b) \<c\>\|");
    }
}
