//! The header of Radiance pictures (.hdr): what their pixels are times light (G. Ward, "Radiance File Formats", "Picture File
//! Format (.hdr)").

use image::Rgb32FImage;
use image::codecs::hdr::HdrDecoder;

/// First bytes of such pictures.
const SIGNATURE: &[u8] = b"#?RADIANCE";
/// Those that other programs write (B. Walter's `rgbe.c`), for the same format.
const OTHER_SIGNATURE: &[u8] = b"#?RGBE";

/// Longest header.
const MAX_HEADER: usize = 1 << 16;

/// Primaries of sRGB, x and y of red, green and blue (IEC 61966-2-1); those of Radiance itself are near.
const PRIMARIES: [f64; 6] = [0.64, 0.33, 0.30, 0.60, 0.15, 0.06];
const NEAR: f64 = 0.02;

/// What a header says of all pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    /// What each channel is to be divided by: all `EXPOSURE` and `COLORCORR` lines together.
    divisors: [f64; 3],
    /// Whether colours are of other primaries than those of sRGB.
    pub has_other_primaries: bool,
}

impl Header {
    /// Whether pixels are light as they stand.
    pub fn is_plain(&self) -> bool {
        self.divisors == [1.0; 3]
    }

    /// What light the numbers of a pixel are.
    pub fn light_of(&self, pixel: [f32; 3]) -> [f32; 3] {
        let [r, g, b] = self.divisors;
        let [x, y, z] = pixel.map(f64::from);
        [x / r, y / g, z / b].map(|channel| channel as f32)
    }

    /// Makes light of all pixels.
    pub fn apply(&self, picture: &mut Rgb32FImage) {
        if !self.is_plain() {
            for pixel in picture.pixels_mut() {
                pixel.0 = self.light_of(pixel.0);
            }
        }
    }
}

/// The bytes of a file, where it is such a picture with the usual first ones.
pub(super) fn with_signature(bytes: Vec<u8>) -> Vec<u8> {
    match bytes.strip_prefix(OTHER_SIGNATURE) {
        Some(rest) => [SIGNATURE, rest].concat(),
        None => bytes,
    }
}

/// The header of a picture; `None` for other formats.
pub(super) fn read(bytes: &[u8]) -> Option<Result<Header, String>> {
    bytes.starts_with(SIGNATURE).then(|| header(bytes))
}

fn header(bytes: &[u8]) -> Result<Header, String> {
    let beginning = &bytes[..bytes.len().min(MAX_HEADER)];
    let decoder = HdrDecoder::new(beginning).map_err(|error| match bytes.len() > beginning.len() {
        true => format!("its header, of which {MAX_HEADER} bytes are read: {error}"),
        false => format!("its header: {error}"),
    })?;
    let mut divisors = [1.0_f64; 3];
    let mut has_other_primaries = false;
    for (key, value) in decoder.metadata().custom_attributes {
        let numbers: Vec<f64> = value
            .split_ascii_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect();
        let by = match (key.as_str(), &numbers[..]) {
            ("EXPOSURE", &[exposure]) => [exposure; 3],
            ("COLORCORR", &[r, g, b]) => [r, g, b],
            ("PRIMARIES", numbers) => {
                // Photoshop writes zeros, which name no colours.
                if !numbers.is_empty() && numbers.iter().all(|&x| x == 0.0) {
                    continue;
                }
                let is_near = |(x, own): (&f64, &f64)| (x - own).abs() <= NEAR;
                has_other_primaries =
                    numbers.len() < PRIMARIES.len() || !numbers.iter().zip(&PRIMARIES).all(is_near);
                continue;
            }
            ("EXPOSURE" | "COLORCORR", _) => [f64::NAN; 3],
            // A key without a value.
            ("", _) if value.starts_with("EXPOSURE") || value.starts_with("COLORCORR") => [f64::NAN; 3],
            _ => continue,
        };
        divisors = [0, 1, 2].map(|channel| divisors[channel] * by[channel]);
    }
    let is_factor = |x: &f64| *x > 0.0 && x.is_finite();
    if !divisors.iter().all(is_factor) {
        return Err(String::from(
            "its EXPOSURE and COLORCORR lines are to be numbers above 0, and so are their products; repair or remove the lines",
        ));
    }
    Ok(Header {
        divisors,
        has_other_primaries,
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A picture with these lines in its header and these pixels in a row: mantissas, and the exponent of 2 plus 128.
    pub fn picture(lines: &str, pixels: &[[u8; 4]]) -> Vec<u8> {
        picture_of(lines, [pixels.len(), 1], pixels)
    }

    /// One of so many columns and rows.
    pub fn picture_of(lines: &str, [width, height]: [usize; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
        let mut bytes =
            format!("#?RADIANCE\n{lines}FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
        bytes.extend(pixels.as_flattened());
        bytes
    }

    fn of(lines: &str) -> Result<Header, String> {
        read(&picture(lines, &[[128, 128, 128, 129]])).expect("a picture of Radiance")
    }

    #[test]
    fn the_other_signature_is_the_same_format() {
        let own = picture("EXPOSURE=4\n", &[[128, 128, 128, 129]]);
        let other = [OTHER_SIGNATURE, &own[SIGNATURE.len()..]].concat();
        assert!(read(&other).is_none());
        assert_eq!(with_signature(other), own);
        assert_eq!(with_signature(own.clone()), own);
        assert_eq!(with_signature(b"#?RG".to_vec()), b"#?RG");
    }

    #[test]
    fn exposures_and_corrections_multiply() {
        let plain = of("").expect("sound");
        assert!(plain.is_plain() && !plain.has_other_primaries);
        assert_eq!(plain.light_of([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
        let header =
            of("EXPOSURE=4\nCOLORCORR= 1 2 4\n# EXPOSURE=9\nEXPOSURE= 0.5 \nCOLORCORR=0.5 0.5 0.5\n");
        // 4 / 2 of all, times 1/2, 1, 2.
        assert_eq!(header.expect("sound").light_of([8.0; 3]), [8.0, 4.0, 2.0]);
        // A product that `f32` does not hold on the way.
        let header = of("EXPOSURE=1e30\nEXPOSURE=1e30\nEXPOSURE=1e-30\nEXPOSURE=1e-30\n").expect("sound");
        let [r, ..] = header.light_of([1.0; 3]);
        assert!((r - 1.0).abs() < 1e-6, "{r}");
        for lines in [
            "EXPOSURE=0\n",
            "EXPOSURE=-1\n",
            "EXPOSURE=nan\n",
            "EXPOSURE=\n",
            "COLORCORR=1 1 inf\n",
        ] {
            let problem = of(lines).expect_err(lines);
            assert!(
                problem.contains("EXPOSURE") && problem.contains("repair"),
                "{lines}: {problem}"
            );
        }
        assert!(
            of("EXPOSURE=bright\n")
                .expect_err("no number")
                .contains("EXPOSURE")
        );
    }

    #[test]
    fn primaries_are_compared() {
        for (lines, expected) in [
            ("PRIMARIES= .64 .33 .29 .60 .15 .06 .333 .333\n", false),
            (
                "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n",
                true,
            ),
            ("PRIMARIES=0 0 0 0 0 0 0 0\n", false),
            ("PRIMARIES=0.64 0.33\n", true),
        ] {
            assert_eq!(of(lines).expect("sound").has_other_primaries, expected, "{lines}");
        }
    }

    #[test]
    fn other_formats_have_none_and_long_headers_an_end() {
        assert!(read(b"\x89PNG\r\n").is_none());
        let comment = format!("#{}\n", "x".repeat(MAX_HEADER));
        assert!(of(&comment).expect_err("too long").contains("65536"));
    }
}
