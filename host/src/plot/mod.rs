//! Figures: line charts and scattered points as SVG, and sheets of enlarged images with labels as PNG. Neither needs a font file.

mod canvas;
mod chart;
mod font;
mod scatter;
mod ticks;

pub use canvas::{Canvas, text_size};
pub use chart::{Chart, Point, Series};
pub use scatter::{Scatter, Spot};
