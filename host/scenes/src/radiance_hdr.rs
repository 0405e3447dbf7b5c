//! What `image` leaves of Radiance pictures (.hdr): their pixels are light times the EXPOSURE and COLORCORR lines of the header
//! (G. Ward, "Radiance File Formats").

use image::codecs::hdr::HdrDecoder;

/// First bytes of such pictures, and those that other programs write (B. Walter's `rgbe.c`) for the same format.
const SIGNATURE: &[u8] = b"#?RADIANCE";
const OTHER_SIGNATURE: &[u8] = b"#?RGBE";

/// Longest header.
const MAX_HEADER: usize = 1 << 16;

/// The bytes of a file, with the usual first ones if it is such a picture.
pub(super) fn with_signature(bytes: Vec<u8>) -> Vec<u8> {
    match bytes.strip_prefix(OTHER_SIGNATURE) {
        Some(rest) => [SIGNATURE, rest].concat(),
        None => bytes,
    }
}

/// What each channel is divided by; ones for other formats.
pub(super) fn divisors(bytes: &[u8]) -> Result<[f32; 3], String> {
    if !bytes.starts_with(SIGNATURE) {
        return Ok([1.0; 3]);
    }
    let beginning = &bytes[..bytes.len().min(MAX_HEADER)];
    let header = HdrDecoder::new(beginning)
        .map_err(|error| format!("its header, {MAX_HEADER} bytes at most: {error}"))?;
    let header = header.metadata();
    let (exposure, (r, g, b)) = (
        header.exposure.unwrap_or(1.0),
        header.color_correction.unwrap_or((1.0, 1.0, 1.0)),
    );
    let divisors = [exposure * r, exposure * g, exposure * b];
    if !divisors.iter().all(|x| *x > 0.0 && x.is_finite()) {
        return Err(String::from(
            "its EXPOSURE and COLORCORR lines are to be numbers above 0, and so are their products; repair or remove the lines",
        ));
    }
    Ok(divisors)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A picture with these lines in its header and these pixels in a row: mantissas, and the exponent of 2 plus 128.
    pub fn picture(lines: &str, pixels: &[[u8; 4]]) -> Vec<u8> {
        picture_of(lines, [pixels.len(), 1], pixels)
    }

    /// One of columns and rows.
    pub fn picture_of(lines: &str, [width, height]: [usize; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
        let mut bytes =
            format!("#?RADIANCE\n{lines}FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
        bytes.extend(pixels.as_flattened());
        bytes
    }

    #[test]
    fn exposures_and_corrections_multiply() {
        let of = |lines: &str| divisors(&picture(lines, &[[128, 128, 128, 129]]));
        let own = picture("EXPOSURE=4\n", &[[128, 128, 128, 129]]);
        let other = [OTHER_SIGNATURE, &own[SIGNATURE.len()..]].concat();
        assert_eq!(with_signature(other), own);
        assert_eq!(divisors(b"\x89PNG\r\n"), Ok([1.0; 3]));
        let found = of("EXPOSURE=4\nCOLORCORR= 1 2 4\n# EXPOSURE=9\nEXPOSURE= 0.5 \nCOLORCORR=0.5 0.5 0.5\n");
        assert_eq!(found, Ok([1.0, 2.0, 4.0]));
        for lines in [
            "EXPOSURE=0\n",
            "EXPOSURE=-1\n",
            "EXPOSURE=nan\n",
            "COLORCORR=1 1 inf\n",
        ] {
            let problem = of(lines).expect_err(lines);
            assert!(
                problem.contains("EXPOSURE") && problem.contains("repair"),
                "{lines}: {problem}"
            );
        }
        let long = format!("#{}\n", "x".repeat(MAX_HEADER));
        for lines in ["EXPOSURE=bright\n", "COLORCORR=1\n", &long] {
            assert!(of(lines).is_err(), "{lines}");
        }
    }
}
