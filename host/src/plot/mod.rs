//! Figures as SVG: line charts, and pictures within them. The viewer brings the font.

mod chart;
mod picture;
mod ticks;

pub use chart::{Chart, Point, Series, escape};
pub use picture::png_url;
