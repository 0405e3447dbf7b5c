//! The gallery as Markdown: links lead to files beside the page alone, and to sources.

use std::fmt::Write;

use super::plan::{Equal, Plan};
use super::report::{Exhibit, Measured, Report, Spread, figure};

/// The whole page.
pub(super) fn page(plan: &Plan, report: &Report) -> String {
    let mut out = String::from("# Gallery\n\n");
    // Writing to a string does not fail.
    let mut say = |text: String| {
        let _ = writeln!(out, "{text}");
    };
    let equal = match plan.equal {
        Equal::Time(ms) => format!("{} ms for each image", figure(ms)),
        Equal::Samples(samples) => format!("{samples} shadow rays per pixel for each image"),
    };
    say(format!(
        "Scenes by every method in equal measure, {equal}, next to a reference: {} × {} pixels, {} images of each method, references of {} \
         shadow rays per pixel.\n",
        plan.width, plan.height, plan.seeds, plan.reference_samples
    ));
    let made = &report.made;
    let unoptimised = if made.optimised {
        ""
    } else {
        ", not optimised: times say nothing"
    };
    say(format!(
        "Made by `{}` (version {}{unoptimised}) on {}, {} threads, {}. Numbers of every image: gallery.json.\n",
        made.command.replace('`', "'"),
        made.version,
        plain(&made.machine),
        made.threads,
        made.date,
    ));
    for note in report.notes {
        say(format!("- {note}"));
    }
    say(String::from(
        "\n| scene | triangles | emissive | by formula | least error | MSE | uniform's |\n|---|---|---|---|---|---|---|",
    ));
    for exhibit in &report.scenes {
        say(summary(exhibit));
    }
    for exhibit in &report.scenes {
        say(format!("\n## {}\n", plain(&exhibit.title)));
        for credit in credits(exhibit) {
            say(format!("{credit}\n"));
        }
        match (&exhibit.error, &exhibit.measured) {
            (Some(error), _) => say(format!("Could not be rendered: {}", plain(error))),
            (None, Some(measured)) => say(body(exhibit, measured)),
            (None, None) => {}
        }
    }
    out
}

/// A scene in the table of all.
fn summary(exhibit: &Exhibit) -> String {
    let title = plain(&exhibit.title);
    let Some(measured) = &exhibit.measured else {
        return format!("| {title} | | | | could not be rendered | | |");
    };
    let least = measured
        .methods
        .iter()
        .min_by(|a, b| a.mse.mean.total_cmp(&b.mse.mean));
    let (name, least) = least.map_or((String::new(), String::new()), |row| {
        (row.method.name().to_owned(), spread(&row.mse))
    });
    let uniform = measured.methods.iter().find(|row| row.method.name() == "uniform");
    format!(
        "| {title} | {} | {} | {} | {name} | {least} | {} |",
        measured.triangles,
        measured.emissive_triangles,
        measured.lights_by_formula,
        uniform.map_or(String::new(), |row| spread(&row.mse)),
    )
}

/// Who made a scene, as the list or else the file says.
fn credits(exhibit: &Exhibit) -> Vec<String> {
    let mut lines = Vec::new();
    if exhibit.listed {
        let mut parts = Vec::new();
        parts.extend(
            exhibit
                .author
                .as_deref()
                .map(|author| format!("By {}", plain(author))),
        );
        parts.extend(exhibit.licence.as_deref().map(plain));
        // Checked where it was read: it has no brackets or spaces.
        parts.extend(exhibit.source.as_deref().map(|source| format!("<{source}>")));
        if !parts.is_empty() {
            lines.push(format!("{}.", parts.join(", ")));
        }
    } else if !exhibit.built_in {
        let asset = exhibit.asset.clone().unwrap_or_default();
        let copyright = asset
            .copyright
            .map(|words| format!("The file says: {}.", plain(&words)));
        let generator = asset
            .generator
            .map(|words| format!("Written by {}.", plain(&words)));
        lines.extend(copyright);
        lines.extend(generator);
        lines.push(String::from(
            "It has no entry in a list: see to its licence before the page is published.",
        ));
    }
    lines
}

fn body(exhibit: &Exhibit, measured: &Measured) -> String {
    let mut out = String::new();
    match &measured.picture {
        Some(picture) if exhibit.may_be_shown => {
            out += &format!(
                "![{}: reference and close-ups]({picture})\n\n",
                plain(&exhibit.title)
            );
        }
        Some(_) => out += "Its pictures may not be shown.\n\n",
        None => {}
    }
    out += &format!(
        "Frame {}, camera {}, exposure {}. The reference's own noise: MSE {}, linear MSE {:.2e}.\n",
        exhibit.frame,
        exhibit.camera,
        figure(f64::from(measured.exposure)),
        figure(measured.reference.mse),
        measured.reference.linear_mse,
    );
    if let Some(environment) = &exhibit.environment {
        out += &format!("Lit by the environment map {}.\n", plain(environment));
    }
    for warning in &measured.warnings {
        out += &format!("\n- {}", plain(warning));
    }
    // A table does not belong to the list before it.
    if !measured.warnings.is_empty() {
        out.push('\n');
    }
    out += "\n| method | rays per pixel | image ms | update ms | MSE | FLIP | linear MSE |\n|---|---|---|---|---|---|---|\n";
    for row in &measured.methods {
        out += &format!(
            "| {} | {} | {} | {} | {} | {} | {} |\n",
            row.method.name(),
            row.chosen.samples,
            spread(&row.ms),
            figure(row.update_ms.mean),
            spread(&row.mse),
            spread(&row.flip),
            spread(&row.linear_mse),
        );
    }
    if !measured.skipped.is_empty() {
        let names: Vec<&str> = measured
            .skipped
            .iter()
            .map(|skipped| skipped.method.name())
            .collect();
        out += &format!("\nNot for this scene: {}.", names.join(", "));
        let mut reasons: Vec<&str> = measured
            .skipped
            .iter()
            .map(|skipped| skipped.why.as_str())
            .collect();
        reasons.dedup();
        out += &format!(" {}.\n", plain(&reasons.join("; ")));
    }
    out
}

fn spread(of: &Spread) -> String {
    match of.ci95 {
        Some(ci95) => format!("{} ± {}", figure(of.mean), figure(ci95)),
        None => figure(of.mean),
    }
}

/// Text that Markdown and HTML leave as it is.
fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '#' | '!' | '~' | '&' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests;
