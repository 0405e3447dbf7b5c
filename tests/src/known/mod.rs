//! Known answers: files of words that any platform must reproduce (`tests/data/known`).
//!
//! A file holds what goes in beside what must come out, so no generator stands between an old answer and a new build; only
//! [`fresh`] makes inputs, on demand (`tests/examples/known_answers.rs`).

pub mod file;
pub mod fresh;
pub mod functions;
pub mod image;
pub mod tree;

use lightbvh_host::vulkan::Device;
use lightbvh_kernels::bvh::{Paper, Standard, WIDTH};

pub use file::{Answer, File, Table};

/// What a file is about, and so who answers it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Functions of the core, one per table.
    Functions,
    /// A tree of the default layout and importance: refit, samples, pmfs.
    Tree,
    /// A tree of the paper's.
    PaperTree,
    /// An image.
    Image,
}

/// All files and what they are about.
pub const FILES: [(&str, Subject); 9] = [
    ("exact", Subject::Functions),
    ("bounds", Subject::Functions),
    ("importance", Subject::Functions),
    ("tree_extremes", Subject::Tree),
    ("tree_two_levels", Subject::Tree),
    ("tree_deep", Subject::Tree),
    ("tree_instances", Subject::Tree),
    ("tree_eq4", Subject::PaperTree),
    ("image", Subject::Image),
];

/// The answers of the CPU.
#[must_use]
pub fn answer(file: &File, subject: Subject) -> Vec<Answer> {
    match subject {
        Subject::Functions => functions::answer(file),
        Subject::Tree => tree::answer::<Standard, WIDTH>(file),
        Subject::PaperTree => tree::answer::<Paper, 4>(file),
        Subject::Image => image::answer(file),
    }
}

/// The answers of a device, where a kernel gives any.
#[must_use]
pub fn answer_on(device: &Device, file: &File, subject: Subject) -> Option<Vec<Answer>> {
    match subject {
        Subject::Functions => None,
        Subject::Tree => Some(tree::answer_on::<Standard, WIDTH>(device, file)),
        Subject::PaperTree => Some(tree::answer_on::<Paper, 4>(device, file)),
        Subject::Image => Some(image::answer_on(device, file)),
    }
}

/// Entries under all headings "Changes to bits" of the changelog.
#[must_use]
pub fn changes_to_bits() -> u32 {
    let text = include_str!("../../../CHANGELOG.md");
    let mut inside = false;
    let mut entries = 0;
    for line in text.lines() {
        if line.starts_with('#') {
            inside = line == "### Changes to bits";
        } else if inside && line.starts_with("- ") {
            entries += 1;
        }
    }
    entries
}

/// The version of node words that the first entry under "Changes to bits" which names one gives: the newest stand above.
#[must_use]
pub fn stated_node_format() -> Option<u32> {
    let text = include_str!("../../../CHANGELOG.md");
    let section = text.split("### Changes to bits").nth(1)?;
    let digits = section.split("`NODE_FORMAT` ").nth(1)?;
    digits.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}
