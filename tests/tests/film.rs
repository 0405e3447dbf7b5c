//! Images: files come back as they were written, and failures name the file and leave nothing behind.

use lightbvh_host::render::{Film, FilmError, MAX_AUTO_EXPOSURE};
use std::fs;
use std::path::PathBuf;

/// A fresh directory for one test, removed with it.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lightbvh-film-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn files(&self) -> usize {
        fs::read_dir(&self.0).unwrap().count()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn gradient() -> Film {
    let pixels = (0..48)
        .map(|i| [i as f32 * 0.1, (i * i) as f32 * 1e-3, 1e-6 * i as f32])
        .collect();
    Film::new(8, 6, pixels).unwrap()
}

#[test]
fn an_exr_holds_every_bit_of_the_radiance() {
    let scratch = Scratch::new("exr");
    let path = scratch.0.join("out.exr");
    let film = gradient();
    film.write(&path, 0.5).unwrap();
    let read = image::open(&path).unwrap().into_rgb32f();
    assert_eq!(read.dimensions(), (8, 6));
    let words: Vec<u32> = read.into_raw().into_iter().map(f32::to_bits).collect();
    let expected: Vec<u32> = film.pixels().iter().flatten().map(|c| c.to_bits()).collect();
    assert_eq!(words, expected);
    assert_eq!(scratch.files(), 1);
}

#[test]
fn a_png_holds_the_tone_mapped_image_and_replaces_an_older_one() {
    let scratch = Scratch::new("png");
    let path = scratch.0.join("out.PNG");
    fs::write(&path, b"old").unwrap();
    let film = Film::new(3, 1, vec![[0.0; 3], [0.18; 3], [100.0, f32::NAN, 4.0]]).unwrap();
    film.write(&path, 1.0).unwrap();
    let read = image::load_from_memory(&fs::read(&path).unwrap())
        .unwrap()
        .into_rgb8();
    // Middle grey is compressed to 0.1543, of which sRGB makes 0.4292: 109.45 of 255.
    assert_eq!(read.into_raw(), [0, 0, 0, 109, 109, 109, 255, 0, 255]);
    assert_eq!(scratch.files(), 1);
}

#[test]
fn failures_are_typed_name_the_file_and_leave_nothing() {
    let scratch = Scratch::new("fail");
    let film = gradient();

    let missing = scratch.0.join("no/such/out.png");
    let error = film.write(&missing, 1.0).unwrap_err();
    assert!(matches!(&error, FilmError::Write { path, .. } if *path == missing));
    assert!(error.to_string().contains("no/such/out.png"), "{error}");

    let unknown = scratch.0.join("out.bmp");
    assert!(matches!(film.write(&unknown, 1.0), Err(FilmError::Format { .. })));
    assert!(matches!(
        film.write(&scratch.0.join("out"), 1.0),
        Err(FilmError::Format { .. })
    ));

    // A directory is in the way: the temporary must go again.
    let taken = scratch.0.join("taken.png");
    fs::create_dir(&taken).unwrap();
    assert!(matches!(film.write(&taken, 1.0), Err(FilmError::Write { .. })));
    assert_eq!(scratch.files(), 1);
}

#[test]
fn sizes_fit_the_pixels() {
    assert!(matches!(
        Film::new(2, 2, vec![[0.0; 3]; 3]),
        Err(FilmError::Size { .. })
    ));
    assert!(matches!(Film::new(0, 5, vec![]), Err(FilmError::Size { .. })));
    assert!(matches!(
        Film::new(1 << 31, 2, vec![]),
        Err(FilmError::Size { .. })
    ));
}

#[test]
fn exposure_by_hand() {
    // One grey pixel and one black: the black one has no logarithm and does not count.
    let grey = Film::new(2, 1, vec![[0.36; 3], [0.0; 3]]).unwrap();
    assert!((grey.auto_exposure() - 0.5).abs() < 1e-6);
    assert_eq!(Film::new(1, 1, vec![[0.0; 3]]).unwrap().auto_exposure(), 1.0);
}

#[test]
fn exposure_makes_no_picture_of_noise() {
    let film = |pixels: Vec<[f32; 3]>| Film::new(1000, 1, pixels).unwrap();
    // Two in a thousand pixels have found a little light.
    let mut pixels = vec![[0.0; 3]; 1000];
    pixels[7] = [1e-7; 3];
    pixels[900] = [3e-6; 3];
    let noise = film(pixels);
    assert_eq!(noise.auto_exposure(), MAX_AUTO_EXPOSURE);
    assert!(noise.darkness().is_some_and(|words| words.contains("--exposure")));
    assert!(noise.shown(noise.auto_exposure()).iter().all(|&byte| byte < 24));
    let black = film(vec![[0.0; 3]; 1000]);
    assert!(black.darkness().is_some_and(|words| words.contains("black")));
    assert_eq!(film(vec![[0.01; 3]; 1000]).darkness(), None);
}
