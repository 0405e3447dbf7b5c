//! The extremes.

mod counts;
mod depth;
mod flux;
mod moving;
mod places;
mod receivers;
mod scattered;
mod shapes;

pub use counts::{equal, many};
pub use scattered::scattered;

use lightbvh::EmissiveTriangle;

use super::case::Case;
use scattered::add;

/// All extremes but the largest, [`equal`] and [`many`], in the order of the report.
pub fn small() -> Vec<Case> {
    [
        places::cases(),
        flux::cases(),
        shapes::cases(),
        receivers::cases(),
        depth::cases(),
        moving::cases(),
        counts::few(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A right triangle of legs `size` at `corner` that faces along `x`.
fn facing_x(corner: [f32; 3], size: f32, radiance: f32, mesh: u32, flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [
            corner,
            add(corner, [0.0, size, 0.0]),
            add(corner, [0.0, 0.0, size]),
        ],
        radiance: [radiance; 3],
        mesh,
        flags,
    }
}
