//! The graphs of the paper's Figures 4 and 5: errors over frames.

use std::path::Path;

use super::plan::Plan;
use super::summary::{Errors, Row};
use crate::error::HostError;
use crate::method::Method;
use crate::plot::{Chart, Point, Series};

/// A mean and half its confidence interval.
type Measure = fn(&Errors) -> (f64, Option<f64>);

/// Writes the graphs of one scene on one backend; returns their file names.
pub(super) fn write(folder: &Path, plan: &Plan, stem: &str, rows: &[Row]) -> Result<Vec<String>, HostError> {
    let graphs: [(&str, &str, bool, Measure); 2] = [
        ("mse", "MSE", true, |e| (e.mse, e.mse_ci95)),
        ("ssim", "SSIM", false, |e| (e.ssim, e.ssim_ci95)),
    ];
    let mut files = Vec::new();
    for (file, label, from_zero, measure) in graphs {
        let series = shown(plan).into_iter().map(|method| {
            let own = rows.iter().filter(|row| row.method == method);
            let points = own.map(|row| {
                let (y, error) = measure(&row.errors);
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
        let path = folder.join(&name);
        chart
            .write(&path)
            .map_err(|source| HostError::Store { path, source })?;
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
