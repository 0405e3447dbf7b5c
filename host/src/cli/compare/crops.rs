//! Close-ups as the paper's Figure 6: regions of the last frame by every method, side by side.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::graphs::shown;
use super::plan::Plan;
use crate::error::HostError;
use crate::method::Method;
use crate::metrics::{Judge, Judged, Quality, Region, mean_squared_error};
use crate::plot::{Canvas, text_size};
use crate::render::Film;

/// Regions shown.
const REGIONS: usize = 3;
/// A region's share of the image's width and height.
const SHARE: u32 = 6;
/// Least width of an enlarged region: the longest label must fit.
const CELL: u32 = 250;
const MARGIN: u32 = 10;
const TEXT: u32 = 2;
const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [30; 3];
const MARK: [u8; 3] = [255, 60, 60];

/// A region and how good a method is in it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Crop {
    pub scene: String,
    pub frame: u32,
    #[serde(flatten)]
    pub region: Region,
    pub method: Method,
    /// `null` for a region without any error.
    pub psnr: f64,
    #[serde(flatten)]
    pub quality: Quality,
}

/// Writes the sheet of one scene; returns what it shows.
pub(super) fn write(
    path: &Path,
    plan: &Plan,
    scene: &str,
    judge: &Judge,
    films: &BTreeMap<Method, Film>,
) -> Result<Vec<Crop>, HostError> {
    let mut columns: Vec<(Method, Judged<'_>)> = Vec::new();
    for method in shown(plan) {
        if let Some(film) = films.get(&method) {
            columns.push((method, judge.judge(film)?));
        }
    }
    let regions = choose(judge, &columns, SHARE, REGIONS);
    let mut crops = Vec::new();
    for (method, judged) in &columns {
        for &region in &regions {
            let quality = judged.region(region)?;
            crops.push(Crop {
                scene: scene.to_owned(),
                frame: plan.last(),
                region,
                method: *method,
                psnr: quality.psnr(),
                quality,
            });
        }
    }
    sheet(plan, scene, judge, &columns, &regions, &crops).write_png(path)?;
    Ok(crops)
}

/// The `count` regions where the methods' errors are furthest apart, without overlap: the greatest MSE less the least. Each has
/// one part in `share` of the image's width and height.
pub(in crate::cli) fn choose(
    judge: &Judge,
    columns: &[(Method, Judged<'_>)],
    share: u32,
    count: usize,
) -> Vec<Region> {
    let (width, height) = judge.size();
    let (across, down) = (width.div_ceil(share), height.div_ceil(share));
    let steps = |all: u32, size: u32| (0..=all - size).step_by((size as usize / 4).max(1));
    let mut found: Vec<(f64, Region)> = Vec::new();
    for y in steps(height, down) {
        for x in steps(width, across) {
            let region = Region {
                x,
                y,
                width: across,
                height: down,
            };
            let cut = |bytes: &[u8]| region.cut(bytes.as_chunks::<3>().0, width);
            let reference = cut(judge.shown());
            let errors = columns
                .iter()
                .map(|(_, judged)| mean_squared_error(&cut(judged.shown()), &reference));
            let (least, most) = errors.fold((f64::INFINITY, 0.0_f64), |(least, most), e| {
                (least.min(e), most.max(e))
            });
            // One method alone is as far from the reference as it is.
            found.push((if columns.len() > 1 { most - least } else { most }, region));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<Region> = Vec::new();
    for (_, region) in found {
        if chosen.len() < count && chosen.iter().all(|other| !other.overlaps(&region)) {
            chosen.push(region);
        }
    }
    chosen
}

/// The reference with the regions marked, above a row of close-ups for each region.
fn sheet(
    plan: &Plan,
    scene: &str,
    judge: &Judge,
    columns: &[(Method, Judged<'_>)],
    regions: &[Region],
    crops: &[Crop],
) -> Canvas {
    let (width, height) = judge.size();
    let (across, down) = regions
        .first()
        .map_or((1, 1), |region| (region.width, region.height));
    let zoom = CELL.div_ceil(across);
    let line = text_size("", TEXT).1 + MARGIN;
    let cell = (across * zoom, down * zoom);
    let count = columns.len() as u32 + 1;
    let overview = 640_u32.div_ceil(width).max(1);
    let title = format!(
        "{scene}, frame {}, {} shadow rays per pixel",
        plan.last(),
        plan.samples
    );
    let canvas_width = (MARGIN + count * (cell.0 + MARGIN))
        .max(2 * MARGIN + width * overview)
        .max(2 * MARGIN + text_size(&title, TEXT).0);
    let rows_top = MARGIN + line + height * overview + MARGIN;
    let canvas_height = rows_top + regions.len() as u32 * (cell.1 + 2 * line + MARGIN);
    let mut canvas = Canvas::new(canvas_width, canvas_height, PAPER);

    canvas.text((MARGIN, MARGIN), &title, TEXT, INK);
    let at = (MARGIN, MARGIN + line);
    canvas.image(at, judge.shown().as_chunks::<3>().0, width, overview);
    for (number, region) in (1..).zip(regions) {
        let corner = (at.0 + region.x * overview, at.1 + region.y * overview);
        canvas.outline(corner, (region.width * overview, region.height * overview), MARK);
        let text = format!("{number}");
        let size = text_size(&text, TEXT);
        canvas.fill(corner, (size.0 + 6, size.1 + 6), MARK);
        canvas.text((corner.0 + 3, corner.1 + 3), &text, TEXT, PAPER);
    }
    for (row, region) in (0..).zip(regions) {
        let y = rows_top + row * (cell.1 + 2 * line + MARGIN);
        let mut draw = |column: u32, name: &str, shown: &[u8], below: &str| {
            let x = MARGIN + column * (cell.0 + MARGIN);
            canvas.text((x, y), name, TEXT, INK);
            let pixels = region.cut(shown.as_chunks::<3>().0, width);
            canvas.image((x, y + line), &pixels, region.width, zoom);
            canvas.text((x, y + line + cell.1 + MARGIN / 2), below, TEXT, INK);
        };
        for (column, (method, judged)) in (0..).zip(columns) {
            let own = crops
                .iter()
                .find(|crop| crop.method == *method && crop.region == *region);
            let below = own.map_or(String::new(), |crop| format!("MSE {:.1}", crop.quality.mse));
            draw(column, method.name(), judged.shown(), &below);
        }
        draw(
            count - 1,
            "reference",
            judge.shown(),
            &format!("region {}", row + 1),
        );
    }
    canvas
}
