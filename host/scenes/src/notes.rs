//! What a loader leaves out, said once for each kind.

use std::collections::HashMap;
use std::rc::Rc;

/// Kinds kept; the rest is counted.
const MAX_KINDS: usize = 50;

/// A line of a file.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub file: Rc<str>,
    /// Counted from 1.
    pub line: u32,
}

/// Warnings of one file, and of what it includes.
#[derive(Debug, Default)]
pub(super) struct Notes {
    kinds: Vec<(String, Place, u64)>,
    by_kind: HashMap<String, usize>,
    more: u64,
}

impl Notes {
    /// Something was left out, or replaced: `kind` says what, the same words wherever it is the same.
    pub fn add(&mut self, place: &Place, kind: impl Into<String>) {
        let kind = kind.into();
        if let Some(&index) = self.by_kind.get(&kind) {
            self.kinds[index].2 += 1;
        } else if self.kinds.len() < MAX_KINDS {
            self.by_kind.insert(kind.clone(), self.kinds.len());
            self.kinds.push((kind, place.clone(), 1));
        } else {
            self.more += 1;
        }
    }

    /// One sentence for each kind.
    pub fn into_warnings(self) -> Vec<String> {
        let more = self.more;
        let sentence = |(kind, place, count): (String, Place, u64)| {
            let Place { file, line } = place;
            let at = match line {
                0 => file.to_string(),
                line => format!("{file}, line {line}"),
            };
            match count {
                1 => format!("{kind} ({at})"),
                count => format!("{kind} ({count} times, first in {at})"),
            }
        };
        let mut out: Vec<String> = self.kinds.into_iter().map(sentence).collect();
        if more > 0 {
            out.push(format!("and {more} more"));
        }
        out
    }
}
