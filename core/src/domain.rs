//! The domain in which lights and points are accepted.

use crate::exact;

/// Largest magnitude of a coordinate, metres: 2^40.
pub const MAX_COORDINATE: f32 = exact::pow2(40);
/// Smallest magnitude of a coordinate that is not zero, metres: 2^-100. The difference of two coordinates is then zero
/// or a normal number, which a device that flushes subnormal numbers keeps.
pub const MIN_COORDINATE: f32 = exact::pow2(MIN_COORDINATE_EXPONENT);
pub(crate) const MIN_COORDINATE_EXPONENT: i32 = -100;
/// Offsets from coordinates count as zero below this, metres: 2^-103. The last place of all others is a normal number, and so is every sum.
pub(crate) const MIN_OFFSET: f32 = exact::pow2(-103);
/// Smallest radiance that is not zero, W/(m² sr): 2^-100.
pub const MIN_RADIANCE: f32 = exact::pow2(-100);
/// Largest radiance, W/(m² sr): 2^100.
pub const MAX_RADIANCE: f32 = exact::pow2(100);
/// By how much the squared length of a normal may differ from 1: 2^-7, so that normals of 8-bit components divided by a rough
/// root pass.
pub const NORMAL_TOLERANCE: f32 = exact::pow2(-7);

/// Why a light, a point or a transform is refused: what of it, what was found, what is expected, and what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DomainError {
    /// A coordinate or a channel of `what`, or nothing.
    part: &'static str,
    what: &'static str,
    found: Found,
    expected: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Found {
    Number(f32),
    Vector([f32; 3]),
    Bits(u32),
}

impl DomainError {
    pub(crate) const fn number(what: &'static str, found: f32, expected: &'static str) -> Self {
        Self::part("", what, found, expected)
    }

    const fn part(part: &'static str, what: &'static str, found: f32, expected: &'static str) -> Self {
        let found = Found::Number(found);
        Self {
            part,
            what,
            found,
            expected,
        }
    }

    pub(crate) const fn vector(what: &'static str, found: [f32; 3], expected: &'static str) -> Self {
        Self {
            found: Found::Vector(found),
            ..Self::number(what, 0.0, expected)
        }
    }

    pub(crate) const fn bits(what: &'static str, found: u32, expected: &'static str) -> Self {
        Self {
            found: Found::Bits(found),
            ..Self::number(what, 0.0, expected)
        }
    }
}

impl core::fmt::Display for DomainError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}{} is ", self.part, self.what)?;
        match self.found {
            Found::Number(x) => write!(f, "{}", Number(x))?,
            Found::Vector([x, y, z]) => write!(f, "({x}, {y}, {z})")?,
            Found::Bits(bits) => write!(f, "{bits:#x}")?,
        }
        write!(f, ", expected {}", self.expected)
    }
}

impl core::error::Error for DomainError {}

/// Brings the coordinates of `what` into the domain.
pub(crate) fn checked_place(what: &'static str, mut place: [f32; 3]) -> Result<[f32; 3], DomainError> {
    for axis in 0..3 {
        let value = place[axis];
        // NaN is in no range.
        if !(-MAX_COORDINATE..=MAX_COORDINATE).contains(&value) {
            let part = [
                "coordinate x of the ",
                "coordinate y of the ",
                "coordinate z of the ",
            ][axis];
            let expected = "a finite number of magnitude at most 2^40 (1.1e12); scale the scene or repair it";
            return Err(DomainError::part(part, what, value, expected));
        }
        place[axis] = exact::flush(value, MIN_COORDINATE);
    }
    Ok(place)
}

/// Brings the linear R, G, B of `what` into the domain.
pub(crate) fn checked_emission(what: &'static str, mut emission: [f32; 3]) -> Result<[f32; 3], DomainError> {
    for channel in 0..3 {
        let value = emission[channel];
        if value != 0.0 && !(MIN_RADIANCE..=MAX_RADIANCE).contains(&value) {
            let part = ["red of the ", "green of the ", "blue of the "][channel];
            let expected = "0 or a number from 2^-100 to 2^100 (7.9e-31 to 1.3e30); repair the light";
            return Err(DomainError::part(part, what, value, expected));
        }
        emission[channel] = exact::flush(value, MIN_RADIANCE);
    }
    Ok(emission)
}

/// A number in a message: as people write it, by a power of ten only where it is very small or very large.
pub(crate) struct Number(pub f32);

impl core::fmt::Display for Number {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let magnitude = crate::exact::abs(self.0);
        if (1e-3..1e6).contains(&magnitude) || magnitude == 0.0 {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::Number;

    #[test]
    fn numbers_are_written_as_people_do() {
        for (value, text) in [
            (-1.0, "-1"),
            (0.0, "0"),
            (0.25, "0.25"),
            (1e-20, "1e-20"),
            (3e38, "3e38"),
            (f32::NAN, "NaN"),
            (f32::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(Number(value).to_string(), text);
        }
    }
}
