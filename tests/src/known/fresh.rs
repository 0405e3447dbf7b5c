//! Inputs for new files. Nothing but `tests/examples/known_answers.rs` calls this: the committed files are the inputs.

mod functions;
mod image;
mod trees;

use lightbvh::node::NODE_FORMAT;

use super::{File, Table, changes_to_bits};

/// The file `name` with new inputs; its answers are zero yet.
///
/// # Panics
/// If there is no such file.
#[must_use]
pub fn inputs(name: &str) -> File {
    let (note, tables) = match name {
        "exact" => functions::exact(),
        "bounds" => functions::bounds(),
        "importance" => functions::importance(),
        "image" => image::image(),
        _ => trees::tree(name),
    };
    File {
        name: name.to_owned(),
        note: format!(
            "Known answers of lightbvh, https://github.com/lightbvh/lightbvh\n{note}\nEach row: the words that go in, then \
             the words that must come out; an f32 by its bits.\n`table NAME INPUTS OUTPUTS ROWS`.\n"
        ),
        node_format: NODE_FORMAT,
        changes_to_bits: changes_to_bits(),
        tables,
    }
}

/// Rows of records as words.
fn words<T: bytemuck::NoUninit>(records: &[T]) -> Vec<u32> {
    bytemuck::cast_slice(records).to_vec()
}

/// A table of records without outputs.
fn array<T: bytemuck::NoUninit>(name: &str, note: &str, records: &[T]) -> Table {
    Table::new(name, note, size_of::<T>() / 4, 0, &words(records))
}
