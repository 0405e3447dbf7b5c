//! Numbers in messages.

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
