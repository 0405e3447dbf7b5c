//! Figures: line charts as SVG, and sheets of enlarged images with labels as PNG. Neither needs a font file.

mod canvas;
mod chart;
mod font;
mod ticks;

pub use canvas::{Canvas, text_size};
pub use chart::{Chart, Point, Series};
