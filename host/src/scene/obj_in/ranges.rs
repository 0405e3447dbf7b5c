//! Numbers of materials outside of the ranges of their words.

use super::super::notes::{Notes, Place};

/// Exporters round: what is this much above its range is in it.
const ROUNDED: f32 = 1e-3;

/// Greatest model of illumination of the format.
const MODELS: f32 = 10.0;

/// Names what `word` has no meaning for, and what is taken.
pub(super) fn note_outside(word: &str, values: &[f32], place: &Place, notes: &mut Notes) {
    let (is_inside, problem): (fn(f32) -> bool, _) = match word {
        "Kd" | "Ks" | "Pr" | "Pm" | "d" | "Tr" => (
            |x| (-ROUNDED..=1.0 + ROUNDED).contains(&x),
            "outside of 0 to 1 is taken as the nearer of the two",
        ),
        "Ns" => (|x| x >= 0.0, "below 0 is taken as 0"),
        "illum" => (
            |x| (0.0..=MODELS).contains(&x) && x.fract() == 0.0,
            "that is no whole number from 0 to 10 is passed by",
        ),
        _ => return,
    };
    if !values.iter().all(|&value| is_inside(value)) {
        notes.add(place, format!("`{word}` {problem}"));
    }
}

/// The same of `Ni`, which nothing here needs.
pub(super) fn note_index(text: &str, place: &Place, notes: &mut Notes) {
    if !text.trim().parse().is_ok_and(|x: f32| x > 0.0 && x.is_finite()) {
        notes.add(place, "`Ni` that is no number above 0 is passed by");
    }
}
