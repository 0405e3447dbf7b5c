//! Lines of OBJ and MTL files.

use super::super::error::SceneError;
use super::{REPAIR, wrong};

/// Lines without comments, those that go on after `\` as one, each with its number from 1.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u32,
}

impl<'a> Lines<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            number: 0,
        }
    }

    fn line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number = self.number.saturating_add(1);
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        Some(line.trim_ascii())
    }
}

impl Iterator for Lines<'_> {
    type Item = (u32, String);

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = self.line()?;
        let number = self.number;
        let mut text = String::new();
        // A comment ends with its line.
        if line.starts_with(b"#") {
            return Some((number, text));
        }
        while let Some(part) = line.strip_suffix(b"\\") {
            text.push_str(&String::from_utf8_lossy(part));
            text.push(' ');
            line = self.line().unwrap_or_default();
        }
        text.push_str(&String::from_utf8_lossy(line));
        // Names have such signs too.
        let comment = text
            .char_indices()
            .find(|&(at, c)| c == '#' && text[..at].ends_with(|before: char| before.is_ascii_whitespace()));
        if let Some((comment, _)) = comment {
            text.truncate(comment);
        }
        Some((number, text))
    }
}

/// The first word, and what comes after it.
pub(super) fn split(line: &str) -> (&str, &str) {
    let line = line.trim();
    line.split_once(|c: char| c.is_ascii_whitespace())
        .map_or((line, ""), |(word, rest)| (word, rest.trim()))
}

/// The first `N` numbers of a line, where there are as many.
pub(super) fn numbers<const N: usize>(file: &str, line: u32, text: &str) -> Result<[f32; N], SceneError> {
    let mut out = [0.0; N];
    let mut words = text.split_ascii_whitespace();
    for value in &mut out {
        let word = words.next().unwrap_or_default();
        *value = word
            .parse()
            .ok()
            .filter(|value: &f32| value.is_finite())
            .ok_or_else(|| {
                wrong(
                    file,
                    line,
                    format!("expected {N} numbers, found `{}`", shown(text)),
                    REPAIR,
                )
            })?;
    }
    Ok(out)
}

/// The beginning of a text, for messages.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}
