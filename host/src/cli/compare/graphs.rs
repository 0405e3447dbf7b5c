//! The graphs of the paper's Figures 4 and 5: errors over frames.

use std::path::Path;

use super::plan::Plan;
use super::summary::Row;
use crate::cli::target::store;
use crate::error::HostError;
use crate::method::Method;
use crate::plot::{Chart, Point, Series};

/// Writes the graphs of one scene on one backend; returns their file names.
pub(super) fn write(folder: &Path, plan: &Plan, stem: &str, rows: &[Row]) -> Result<Vec<String>, HostError> {
    let graphs = [("mse", "MSE", true), ("ssim", "SSIM", false)];
    let mut files = Vec::new();
    for (file, label, from_zero) in graphs {
        let series = shown(plan).into_iter().map(|method| {
            let own = rows.iter().filter(|row| row.method == method);
            let points = own.map(|row| {
                let (y, error) = row.errors.get(file);
                Point {
                    x: f64::from(row.frame),
                    y,
                    error: error.unwrap_or(0.0),
                }
            });
            Series {
                name: method.name().to_owned(),
                points: points.collect(),
            }
        });
        let chart = Chart {
            title: format!(
                "{stem}: {label} over frames, {} shadow rays per pixel",
                plan.samples
            ),
            x_label: String::from("frame"),
            y_label: String::from(label),
            from_zero,
            series: series.collect(),
        };
        let name = format!("{file}-{stem}.svg");
        store(&folder.join(&name), chart.svg().as_bytes())?;
        files.push(name);
    }
    Ok(files)
}

/// The methods of the graphs: those without a tree are so far off that the others would lie on one line; they stay in the
/// tables.
pub(super) fn shown(plan: &Plan) -> Vec<Method> {
    let is_far = |method: &Method| matches!(method, Method::Uniform | Method::Power);
    let near: Vec<Method> = plan
        .methods
        .iter()
        .copied()
        .filter(|method| !is_far(method))
        .collect();
    if near.is_empty() {
        plan.methods.clone()
    } else {
        near
    }
}
