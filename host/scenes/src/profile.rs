//! Photometric profiles as the renderer shows them: a picture over all directions, and the numbers that a tree needs of it.

use std::sync::Arc;

use lightbvh::light::{direction_at, place_of};

use super::ies_in::Photometry;
use super::paint::{IN_PLACE, Picture, Texture, Wrap};
use super::shown::Shown;
use super::srgb::linear_from_srgb;

/// Sides of the picture: the least of which two texels fit between the angles of the table, or the greatest.
const SIDES: [u32; 4] = [64, 128, 256, 512];
/// Places along a side of a texel that the table is read at.
const WITHIN: u32 = 3;
/// What corners of a texel may miss of the cone around it, in cosine.
const SLACK: f32 = 2.0e-4;

/// How the picture is read.
pub(super) const OVER_DIRECTIONS: Texture = Texture {
    picture: 0,
    is_nearest: false,
    wrap: [Wrap::Clamp; 2],
    transform: IN_PLACE,
};

/// A luminaire's profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// For messages.
    pub name: String,
    /// The file, for export.
    pub file: Arc<Vec<u8>>,
    /// What it sends, relative to [`Sent::peak`], encoded as sRGB: an unfolded octahedron with the axis in the middle.
    pub picture: Picture,
    /// What a tree knows of it.
    pub sent: Sent,
}

/// What a profile sends, in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sent {
    /// Candela where the picture shows one; such that its integral is the table's.
    pub peak: f32,
    /// Integral of what the picture shows, over 2π.
    pub whole: f32,
    /// The mean cosine to the axis over that.
    pub mean_cosine: f32,
    /// Cosine of the angle beyond which the picture is black.
    pub cos_outer: f32,
}

impl Profile {
    /// Of a photometric file.
    ///
    /// # Errors
    /// As [`Photometry::read`], and for a luminaire that sends nothing.
    pub fn read(name: String, file: Vec<u8>) -> Result<Self, String> {
        let table = Photometry::read(&file)?;
        let step = table.least_step();
        let side = SIDES
            .into_iter()
            .find(|side| 360.0 / f64::from(*side) <= step)
            .unwrap_or(SIDES[3]);
        let means = means(&table, side);
        let greatest = means.iter().copied().fold(0.0, f64::max);
        if greatest <= 0.0 {
            return Err(String::from("it sends no light in any direction"));
        }
        let linear: Vec<f64> = (0..=255).map(|byte| f64::from(linear_from_srgb(byte))).collect();
        let middles: Vec<f64> = linear.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
        let texels = means.iter().flat_map(|mean| {
            let byte = middles.partition_point(|middle| *middle <= mean / greatest) as u8;
            [byte, byte, byte, 255]
        });
        let picture = Picture {
            width: side,
            height: side,
            texels: Arc::new(texels.collect()),
        };
        let shown = Shown::new([side; 2], &picture.texels, &OVER_DIRECTIONS);
        let sent = over_directions(side, |local| table.candela(local.map(f64::from)));
        let seen = over_directions(side, |local| f64::from(towards(&shown, local)));
        let tau = std::f64::consts::TAU;
        let mean_cosine = (seen[1] / seen[0]) as f32;
        let sent = Sent {
            peak: (greatest * (sent[0] / (greatest * seen[0]))) as f32,
            whole: ((seen[0] / tau) as f32).min(2.0),
            mean_cosine: mean_cosine.clamp(-1.0, 1.0),
            cos_outer: cos_outer(&picture).min(mean_cosine - 1.0e-6).max(-1.0),
        };
        Ok(Self {
            name,
            file: Arc::new(file),
            picture,
            sent,
        })
    }
}

/// The direction in the profile at a place of the octahedron, whose pole is y.
fn local_at(place: [f32; 2]) -> [f32; 3] {
    let [x, y, z] = direction_at(place);
    [x, z, y]
}

/// Places spread over the octahedron: the texel that each lies in, and its direction.
fn places(side: u32) -> impl Iterator<Item = (u32, [f32; 3])> {
    let fine = side * WITHIN;
    let place = move |k: u32| (2 * k + 1) as f32 / fine as f32 - 1.0;
    let all = (0..fine).flat_map(move |row| (0..fine).map(move |column| [column, row]));
    all.map(move |[column, row]| {
        let texel = (row / WITHIN) * side + column / WITHIN;
        (texel, local_at([place(column), place(row)]))
    })
}

/// The mean of the table over each texel.
fn means(table: &Photometry, side: u32) -> Vec<f64> {
    let mut sums = vec![0.0; (side * side) as usize];
    for (texel, local) in places(side) {
        sums[texel as usize] += table.candela(local.map(f64::from));
    }
    sums.iter().map(|sum| sum / f64::from(WITHIN * WITHIN)).collect()
}

/// Integrals over all directions of `value`, and of it times the cosine to the axis.
fn over_directions(side: u32, value: impl Fn([f32; 3]) -> f64) -> [f64; 2] {
    let fine = f64::from(side * WITHIN);
    let cell = 4.0 / (fine * fine);
    let mut sums = [0.0; 2];
    for (_, local) in places(side) {
        // The octahedron |x| + |y| + |z| = 1 is 1/sum away in that direction; a part of the square is seen under the cube
        // of that less.
        let sum: f64 = local.iter().map(|x| f64::from(x.abs())).sum();
        let own = cell * sum * sum * sum * value(local);
        sums[0] += own;
        sums[1] += own * f64::from(local[2]);
    }
    sums
}

/// The least cosine of a direction in which the picture shows anything: each texel shows up to the middles of those beside it.
fn cos_outer(picture: &Picture) -> f32 {
    let side = picture.width;
    let mut least: f32 = 1.0;
    for row in 0..side {
        for column in 0..side {
            if picture.texels[((row * side + column) * 4) as usize] == 0 {
                continue;
            }
            let place =
                |k: u32, by: f32| (((2 * k + 1) as f32 + 2.0 * by) / side as f32 - 1.0).clamp(-1.0, 1.0);
            for by in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 0.0]] {
                least = least.min(local_at([place(column, by[0]), place(row, by[1])])[2]);
            }
        }
    }
    (least - SLACK).max(-1.0)
}

/// What the picture shows in a direction of the profile: x where horizontal angles begin, z its axis, y to their left.
pub(super) fn towards(shown: &Shown, [x, y, z]: [f32; 3]) -> f32 {
    shown.at(place_of([x, z, y]).map(|place| place * 0.5 + 0.5)).r
}
