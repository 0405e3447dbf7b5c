//! Maps for instances, sound and not.

use arbitrary::{Result, Unstructured};
use lightbvh::Transform;
use lightbvh::exact::pow2;

use crate::input::Coordinates;

/// A map: a similarity more often than not, else sheared, flat, singular, of any words, or almost a similarity.
pub fn transform(u: &mut Unstructured<'_>) -> Result<Transform> {
    let kind: u8 = u.arbitrary()?;
    let mut transform = Transform {
        columns: match kind % 12 {
            0..=2 => Transform::IDENTITY.columns,
            3 | 4 => permutation(u)?,
            5..=7 => rotation(u)?,
            8 => entries(u)?,
            9 => flat(u)?,
            10 => [[f32::from(u.arbitrary::<i8>()?); 3]; 3],
            _ => u
                .arbitrary::<[[u32; 3]; 3]>()?
                .map(|column| column.map(f32::from_bits)),
        },
        translation: if kind & 0x80 == 0 {
            u.arbitrary::<[i8; 3]>()?.map(|x| f32::from(x) * 0.25)
        } else {
            Coordinates::choose(u)?.vertex(u)?
        },
    };
    // A few units in the last place, or of one entry all bits.
    if kind & 0x60 == 0x60 {
        let (at, step): (u8, i8) = u.arbitrary()?;
        let [column, row] = [usize::from(at % 4), usize::from(at >> 2) % 3];
        let entry = match column {
            3 => &mut transform.translation[row],
            _ => &mut transform.columns[column][row],
        };
        *entry = if at & 0x80 == 0 {
            f32::from_bits(entry.to_bits().wrapping_add_signed(i32::from(step)))
        } else {
            f32::from_bits(u.arbitrary()?)
        };
    }
    Ok(transform)
}

/// A factor on radiance: of one colour, or of one that may be none at all in some channels.
pub fn color(u: &mut Unstructured<'_>) -> Result<[f32; 3]> {
    let first = factor(u)?;
    Ok(match u.arbitrary()? {
        false => [first; 3],
        true => [first, factor(u)?, factor(u)?],
    })
}

/// Factor on radiance: sound but for one in sixteen.
fn factor(u: &mut Unstructured<'_>) -> Result<f32> {
    let kind: u8 = u.arbitrary()?;
    Ok(match kind % 16 {
        0..=7 => 1.0,
        8 | 9 => 0.0,
        10 => 0.3,
        11..=14 => pow2(u.int_in_range(-62..=62)?),
        _ => f32::from_bits(u.arbitrary()?),
    })
}

fn scale(u: &mut Unstructured<'_>) -> Result<f32> {
    let byte: u8 = u.arbitrary()?;
    Ok(match byte {
        0..=0x7f => 1.0,
        0x80..=0xdf => pow2(i32::from(byte % 9) - 4),
        _ => pow2(2 * (i32::from(byte & 31) - 16)),
    })
}

/// Axes exchanged and turned round, evenly scaled: exact.
fn permutation(u: &mut Unstructured<'_>) -> Result<[[f32; 3]; 3]> {
    let bits: u8 = u.arbitrary()?;
    let scale = scale(u)?;
    let order =
        [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]][usize::from(bits >> 3) % 6];
    let mut columns = [[0.0; 3]; 3];
    for (k, column) in columns.iter_mut().enumerate() {
        column[order[k]] = if bits >> k & 1 == 0 { scale } else { -scale };
    }
    Ok(columns)
}

/// A rotation by a quaternion of small integers, mirrored by a negative scale, evenly scaled.
fn rotation(u: &mut Unstructured<'_>) -> Result<[[f32; 3]; 3]> {
    let [x, y, z, w] = u.arbitrary::<[i8; 4]>()?.map(f64::from);
    let scale = f64::from(scale(u)?) * if u.arbitrary()? { -1.0 } else { 1.0 };
    let square = x * x + y * y + z * z + w * w;
    if square == 0.0 {
        return Ok(Transform::IDENTITY.columns);
    }
    let s = 2.0 / square;
    Ok([
        [
            1.0 - s * (y * y + z * z),
            s * (x * y + z * w),
            s * (x * z - y * w),
        ],
        [
            s * (x * y - z * w),
            1.0 - s * (x * x + z * z),
            s * (y * z + x * w),
        ],
        [
            s * (x * z + y * w),
            s * (y * z - x * w),
            1.0 - s * (x * x + y * y),
        ],
    ]
    .map(|column| column.map(|entry| (entry * scale) as f32)))
}

/// Any small entries.
fn entries(u: &mut Unstructured<'_>) -> Result<[[f32; 3]; 3]> {
    let scale = scale(u)?;
    Ok(u.arbitrary::<[[i8; 3]; 3]>()?
        .map(|column| column.map(|entry| f32::from(entry) * 0.0625 * scale)))
}

/// One direction flattened, wholly or almost.
fn flat(u: &mut Unstructured<'_>) -> Result<[[f32; 3]; 3]> {
    let mut columns = rotation(u)?;
    let bits: u8 = u.arbitrary()?;
    let rest = if bits & 1 == 0 {
        0.0
    } else {
        pow2(-i32::from(bits >> 1))
    };
    columns[usize::from(bits % 3)] = columns[usize::from(bits % 3)].map(|entry| entry * rest);
    Ok(columns)
}
