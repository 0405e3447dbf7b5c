//! Portable float maps: `PF` of three channels, `Pf` of one (P. Debevec, "HDRShop", "PFM Portable FloatMap Image Format").

use image::Rgb32FImage;

/// The pixels of a map, rows from above; `None` for what is another format.
pub(super) fn read(bytes: &[u8]) -> Option<Result<Rgb32FImage, String>> {
    let channels = match bytes {
        [b'P', b'F', b'\n' | b'\r' | b' ', ..] => 3,
        [b'P', b'f', b'\n' | b'\r' | b' ', ..] => 1,
        _ => return None,
    };
    Some(pixels(bytes, channels).ok_or_else(|| String::from("it is no PFM, or truncated; export it again")))
}

fn pixels(bytes: &[u8], channels: usize) -> Option<Rgb32FImage> {
    let mut rest = &bytes[2..];
    let mut word = || {
        rest = rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace)?;
        let (word, after) = rest.split_at(end);
        // One byte parts the last word from the numbers.
        rest = &after[1..];
        std::str::from_utf8(word).ok()
    };
    let width: u32 = word()?.parse().ok()?;
    let height: u32 = word()?.parse().ok()?;
    let scale: f32 = word()?.parse().ok()?;
    let floats = (width as usize)
        .checked_mul(height as usize)?
        .checked_mul(channels)?;
    let numbers = rest.get(..floats.checked_mul(4)?)?;
    let (words, _) = numbers.as_chunks::<4>();
    let number = |x: u32, y: u32, channel: usize| {
        let row = (height - 1 - y) as usize;
        let word = words[(row * width as usize + x as usize) * channels + channel.min(channels - 1)];
        let number = if scale < 0.0 {
            f32::from_le_bytes(word)
        } else {
            f32::from_be_bytes(word)
        };
        number * scale.abs()
    };
    (width > 0 && height > 0 && scale != 0.0).then(|| {
        Rgb32FImage::from_fn(width, height, |x, y| {
            image::Rgb([0, 1, 2].map(|channel| number(x, y, channel)))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One column, two rows: blue below, red above.
    fn map(is_little: bool) -> Vec<u8> {
        let mut bytes = format!("PF\n1 2\n{}\n", if is_little { "-2.0" } else { "2.0" }).into_bytes();
        for x in [0.0_f32, 0.0, 1.0, 1.0, 0.0, 0.0] {
            bytes.extend(if is_little {
                x.to_le_bytes()
            } else {
                x.to_be_bytes()
            });
        }
        bytes
    }

    #[test]
    fn rows_come_from_below() {
        for is_little in [true, false] {
            let picture = read(&map(is_little)).expect("a map").expect("valid");
            assert_eq!(picture.dimensions(), (1, 2));
            assert_eq!(picture.get_pixel(0, 0).0, [2.0, 0.0, 0.0]);
            assert_eq!(picture.get_pixel(0, 1).0, [0.0, 0.0, 2.0]);
        }
        let grey = read(b"Pf 1 1 1\n\x3f\x80\x00\x00")
            .expect("a map")
            .expect("valid");
        assert_eq!(grey.get_pixel(0, 0).0, [1.0; 3]);
    }

    #[test]
    fn what_is_announced_must_be_there() {
        assert!(read(b"P6 1 1 255\n").is_none());
        for bytes in [
            &b"PF\n1 2\n-1.0\n\0\0\0\0"[..],
            b"PF\n4000000000 4000000000\n-1.0\n",
            b"PF\n0 0\n1.0\n",
            b"PF\n1",
            b"PF\n",
        ] {
            assert!(read(bytes).expect("a map").is_err(), "{bytes:?}");
        }
        let mut maps = 0;
        crate::scene::random::damaged(&[map(true), map(false)], 2000, |bytes| {
            maps += u32::from(read(bytes).is_some_and(|read| read.is_ok()));
        });
        assert!(maps > 100, "{maps}");
    }
}
