use super::super::list::Entry;
use super::super::measure::{Chosen, Image, Skipped};
use super::super::reference::Noise;
use super::super::report::{NOTES, Row};
use super::*;
use crate::cli::trade::report::machine::Made;
use crate::method::Method;
use crate::metrics::Quality;
use crate::scene::Asset;

fn plan() -> Plan {
    Plan {
        entries: Vec::new(),
        equal: Equal::Time(50.0),
        width: 64,
        height: 36,
        methods: Vec::new(),
        seeds: 2,
        reference_samples: 128,
        frame: 8,
    }
}

fn row(method: Method, errors: [f64; 2]) -> Row {
    let images = [0, 1].map(|seed| Image {
        seed,
        ms: 40.0 + 20.0 * f64::from(seed),
        update_ms: 0.0,
        quality: Quality {
            mse: errors[seed as usize],
            ssim: 0.5,
            flip: 0.25,
            linear_mse: 0.5,
            relative_mse: 0.5,
        },
    });
    Row::of(
        method,
        Chosen {
            samples: 7,
            trials: Vec::new(),
        },
        images.to_vec(),
        None,
    )
    .expect("two images")
}

fn exhibit(entry: &Entry, listed: bool) -> Exhibit {
    let folder = if entry.may_be_shown {
        "gallery"
    } else {
        "not-shown"
    };
    Exhibit {
        measured: Some(Measured {
            triangles: 12,
            emissive_triangles: 3,
            lights_by_formula: 1,
            warnings: Vec::new(),
            exposure: 2.0,
            reference: Noise {
                samples: 128,
                mse: 0.75,
                linear_mse: 0.001,
            },
            picture: Some(format!("{folder}/lamp.png")),
            region: None,
            methods: vec![
                row(Method::Uniform, [250.0, 350.0]),
                row(Method::TwoLevelMoments, [5.0, 7.0]),
            ],
            skipped: vec![Skipped {
                method: Method::TwoLevelSaoh,
                why: String::from("triangles alone"),
            }],
        }),
        ..Exhibit::new(entry, listed, 8, false, None)
    }
}

fn page_of(scenes: Vec<Exhibit>) -> String {
    let report = Report {
        made: Made::now(),
        settings: serde_json::Value::Null,
        notes: &NOTES,
        scenes,
        failed: Vec::new(),
        computed: 0,
        reused: 0,
    };
    page(&plan(), &report)
}

fn lamp(may_be_shown: bool) -> Entry {
    Entry {
        title: Some(String::from("A [lamp] | <b>")),
        author: Some(String::from("A_B_C")),
        licence: Some(String::from("CC0-1.0")),
        source: Some(String::from("https://example.org/lamp")),
        may_be_shown,
        ..Entry::named("/some/where/lamp.glb")
    }
}

#[test]
fn a_scene_has_its_picture_credits_and_figures() {
    let page = page_of(vec![exhibit(&lamp(true), true)]);
    for words in [
        "](gallery/lamp.png)",
        "By A\\_B\\_C, CC0-1.0, <https://example.org/lamp>.",
        "## A \\[lamp\\] \\| \\<b\\>\n",
        // Means of 250 and 350, of 5 and 7; Student's t for one degree of freedom, 12.7062, times half of their distance.
        "| uniform | 7 | 50.0 ± 127 | 0 | 300 ± 635 |",
        "| two-level-moments | 7 | 50.0 ± 127 | 0 | 6.00 ± 12.7 |",
        "| two-level-moments | 6.00 ± 12.7 | 300 ± 635 |",
        "noise: MSE 0.75",
        "Not for this scene: two-level-saoh. triangles alone.",
        "50.0 ms for each image",
    ] {
        assert!(page.contains(words), "{words} is not in {page}");
    }
    assert!(!page.contains("/some/where"), "{page}");
}

#[test]
fn a_picture_that_may_not_be_shown_is_not_linked() {
    let page = page_of(vec![exhibit(&lamp(false), true)]);
    assert!(!page.contains(".png"), "{page}");
    assert!(
        page.contains("may not be shown") && page.contains("| two-level-moments | 7 |"),
        "{page}"
    );
}

#[test]
fn a_scene_without_an_entry_has_what_its_file_says() {
    let asset = Asset {
        copyright: Some(String::from("2020 (c) `Somebody`")),
        generator: Some(String::from("A\nTool")),
    };
    let page = page_of(vec![Exhibit {
        asset: Some(asset),
        ..exhibit(&Entry::named("lamp.glb"), false)
    }]);
    for words in [
        "The file says: 2020 (c) \\`Somebody\\`.",
        "Written by A Tool.",
        "see to its licence",
    ] {
        assert!(page.contains(words), "{words} is not in {page}");
    }
}

#[test]
fn a_scene_that_failed_is_a_row_with_its_error() {
    let failed = Exhibit {
        error: Some(String::from("cannot read lamp.glb")),
        ..Exhibit::new(&Entry::named("lamp.glb"), false, 8, false, None)
    };
    let page = page_of(vec![failed, exhibit(&lamp(true), true)]);
    assert!(
        page.contains("| lamp.glb | | | | could not be rendered | | |"),
        "{page}"
    );
    assert!(
        page.contains("Could not be rendered: cannot read lamp.glb"),
        "{page}"
    );
    assert!(page.contains("](gallery/lamp.png)"), "{page}");
}

#[test]
fn warnings_stand_before_the_table_and_not_in_it() {
    let mut of = exhibit(&lamp(true), true);
    if let Some(measured) = &mut of.measured {
        measured.warnings = vec![String::from("dark")];
    }
    let page = page_of(vec![of]);
    assert!(page.contains("\n\n- dark\n\n| method |"), "{page}");
}
