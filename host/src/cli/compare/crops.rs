//! Close-ups as the paper's Figure 6: regions of the last frame by every method, side by side.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use image::ExtendedColorType;
use serde::Serialize;

use super::graphs::shown;
use super::plan::Plan;
use crate::cli::target::store;
use crate::error::HostError;
use crate::method::Method;
use crate::metrics::{Judge, Judged, Quality, Region, mean_squared_error};
use crate::plot::{escape, png_url};
use crate::render::Film;

/// Regions shown.
const REGIONS: usize = 3;
/// A region's share of the image's width and height.
const SHARE: u32 = 6;
/// Width of the marked reference and of an enlarged region, pixels; their distance, and the height of a line of text.
const OVERVIEW: u32 = 640;
const CELL: u32 = 250;
const GAP: u32 = 10;
const LINE: u32 = 24;

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
    store(
        path,
        sheet(plan, scene, judge, &columns, &regions, &crops)?.as_bytes(),
    )?;
    Ok(crops)
}

/// The `count` regions where the methods' errors are furthest apart, without overlap: the greatest MSE less the least. Each has
/// one part in `share` of the image's width and height.
fn choose(judge: &Judge, columns: &[(Method, Judged<'_>)], share: u32, count: usize) -> Vec<Region> {
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

/// The reference with the regions marked, above a row of close-ups for each region, as SVG.
fn sheet(
    plan: &Plan,
    scene: &str,
    judge: &Judge,
    columns: &[(Method, Judged<'_>)],
    regions: &[Region],
    crops: &[Crop],
) -> Result<String, HostError> {
    let (width, height) = judge.size();
    let down = regions
        .first()
        .map_or(0, |region| CELL * region.height / region.width);
    let zoom = f64::from(OVERVIEW) / f64::from(width);
    let top = 2 * LINE + OVERVIEW * height / width;
    let row_height = down + 2 * LINE;
    let whole = (
        OVERVIEW.max((columns.len() as u32 + 1) * (CELL + GAP)) + 2 * GAP,
        top + regions.len() as u32 * row_height + GAP,
    );
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" font-family=\"sans-serif\" \
         font-size=\"14\">\n<style>image {{ image-rendering: pixelated }}</style>\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        whole.0, whole.1
    );
    // Writing to a string does not fail.
    let mut line = |text: std::fmt::Arguments<'_>| {
        let _ = writeln!(svg, "{text}");
    };
    line(format_args!(
        "<text x=\"{GAP}\" y=\"{}\">{}, frame {}, {} shadow rays per pixel</text>",
        LINE - 7,
        escape(scene),
        plan.last(),
        plan.samples
    ));
    let url = png_url(judge.shown(), (width, height), ExtendedColorType::Rgb8)?;
    line(format_args!(
        "<image x=\"{GAP}\" y=\"{LINE}\" width=\"{OVERVIEW}\" href=\"{url}\"/>"
    ));
    for (number, region) in (1..).zip(regions) {
        let [x, y, w, h] = [region.x, region.y, region.width, region.height].map(|k| f64::from(k) * zoom);
        let (x, y) = (x + f64::from(GAP), y + f64::from(LINE));
        line(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"none\" stroke=\"#ff3c3c\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"#ff3c3c\">{number}</text>",
            x + 4.0,
            y + 15.0
        ));
    }
    for (row, region) in (0..).zip(regions) {
        let y = top + row * row_height;
        let shown = columns
            .iter()
            .map(|(method, judged)| (method.name(), judged.shown(), Some(*method)));
        for (column, (name, shown, method)) in (0..).zip(shown.chain([("reference", judge.shown(), None)])) {
            let is_it = |crop: &&Crop| Some(crop.method) == method && crop.region == *region;
            let below = match crops.iter().find(is_it) {
                Some(crop) => format!("MSE {:.1}", crop.quality.mse),
                None => format!("region {}", row + 1),
            };
            let pixels = region.cut(shown.as_chunks::<3>().0, width);
            let size = (region.width, region.height);
            let url = png_url(pixels.as_flattened(), size, ExtendedColorType::Rgb8)?;
            let x = GAP + column * (CELL + GAP);
            line(format_args!(
                "<text x=\"{x}\" y=\"{}\">{name}</text><image x=\"{x}\" y=\"{y}\" width=\"{CELL}\" href=\"{url}\"/>\
                 <text x=\"{x}\" y=\"{}\">{below}</text>",
                y - 5,
                y + down + 16
            ));
        }
    }
    Ok(svg + "</svg>\n")
}
