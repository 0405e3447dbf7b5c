//! Plain tables.

use std::borrow::Cow;
use std::io::{self, Write};

/// A column: its header, and what it says of a row.
pub(super) type Column<R> = (&'static str, fn(&R) -> String);

/// Prints rows under a header, columns aligned: the first to the left, numbers to the right.
pub(super) fn print<R>(rows: &[R], columns: &[Column<R>]) -> io::Result<()> {
    let header = columns.iter().map(|(name, _)| (*name).to_owned()).collect();
    let cells = rows
        .iter()
        .map(|row| columns.iter().map(|(_, cell)| cell(row)).collect());
    let lines: Vec<Vec<String>> = std::iter::once(header).chain(cells).collect();
    let width = |column: usize| {
        lines
            .iter()
            .map(|line| line[column].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let mut out = io::stdout().lock();
    for cells in &lines {
        let mut line = String::new();
        for (column, (cell, &width)) in cells.iter().zip(&widths).enumerate() {
            line += &match column {
                0 => format!("{cell:<width$}"),
                _ => format!("  {cell:>width$}"),
            };
        }
        writeln!(out, "{}", plain(line.trim_end()))?;
    }
    Ok(())
}

/// A truth in a cell.
pub(super) fn yes(value: bool) -> String {
    if value { "yes" } else { "no" }.to_owned()
}

/// A number in a cell; a stroke where there is none.
pub(super) fn known(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
}

/// Prints one JSON object.
pub(super) fn print_json(value: &impl serde::Serialize) -> io::Result<()> {
    let mut out = io::stdout().lock();
    serde_json::to_writer_pretty(&mut out, value)?;
    writeln!(out)
}

/// A line on standard output. A closed or full output is an error; `println!` panics then.
macro_rules! say {
    ($($words:tt)*) => {
        $crate::cli::table::print_text(&format!("{}\n", format_args!($($words)*)))
    };
}

/// A line of news on standard error. A closed or full output loses it; `eprintln!` panics then.
macro_rules! news {
    ($($words:tt)*) => {
        $crate::cli::table::tell(format_args!($($words)*))
    };
}

pub(super) use {news, say};

/// See [`news`].
pub(super) fn tell(words: std::fmt::Arguments<'_>) {
    let _ = writeln!(io::stderr().lock(), "{}", plain(&words.to_string()));
}

/// Prints text, [`plain`].
pub(super) fn print_text(text: &str) -> io::Result<()> {
    io::stdout().lock().write_all(plain(text).as_bytes())
}

/// Text with what a terminal obeys written out: names and paths come from files that anybody may have made. Lines and tabs stay.
fn plain(text: &str) -> Cow<'_, str> {
    let is_obeyed = |c: char| {
        // Marks of direction reorder what is beside them.
        let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        turns || c.is_control() && !matches!(c, '\n' | '\t')
    };
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut written = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            written.extend(c.escape_debug());
        } else {
            written.push(c);
        }
    }
    Cow::Owned(written)
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn what_a_terminal_obeys_is_written_out() {
        let kept = "a table\n\tof \u{e4}\u{65e5}\u{672c}, \"quoted\"\n";
        assert_eq!(plain(kept), kept);
        assert_eq!(plain("\u{1b}[31mred\u{7}\r\n"), "\\u{1b}[31mred\\u{7}\\r\n");
        assert_eq!(plain("\u{202e}gnp.exe \u{9b}2J"), "\\u{202e}gnp.exe \\u{9b}2J");
    }
}
