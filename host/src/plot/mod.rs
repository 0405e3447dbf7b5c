//! Figures as SVG: line charts, scattered points, and pictures within them. The viewer brings the font.

mod chart;
mod picture;
mod scatter;
mod ticks;

pub use chart::{Chart, Point, Series, escape};
pub use picture::png_url;
pub use scatter::{Scatter, Spot};
