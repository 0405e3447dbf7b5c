//! What a loader leaves out or replaces, said once for each kind.

use super::error::sentence;

/// Kinds kept, and places named of each; the rest is counted.
const MAX_KINDS: usize = 50;
const MAX_PLACES: usize = 3;

/// Warnings of one file, and of what it includes.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// Each message with its first places and the number of all places.
    kinds: Vec<(String, Vec<String>, usize)>,
    more: u64,
}

impl Notes {
    /// Something at `place`, which may be empty, is left out or replaced: `what` has the same words for the same kind.
    pub fn add(&mut self, place: impl Into<String>, what: impl Into<String>) {
        let (place, what) = (place.into(), sentence(what));
        let is_full = self.kinds.len() == MAX_KINDS;
        match self.kinds.iter_mut().find(|kind| kind.0 == what) {
            // Several textures of an element say the same.
            Some((_, places, _)) if places.last() == Some(&place) => {}
            Some((_, places, count)) => {
                *count += 1;
                if places.len() < MAX_PLACES {
                    places.push(place);
                }
            }
            None if is_full => self.more += 1,
            None => self.kinds.push((what, vec![place], 1)),
        }
    }

    /// A line for each kind: `materials[0], materials[3], materials[4] and 7 more: ...`.
    pub fn into_warnings(self) -> Vec<String> {
        let line = |(what, places, count): (String, Vec<String>, usize)| match count - places.len() {
            _ if places[0].is_empty() => what,
            0 => format!("{}: {what}", places.join(", ")),
            more => format!("{} and {more} more: {what}", places.join(", ")),
        };
        let more = (self.more > 0).then(|| format!("and {} more", self.more));
        self.kinds.into_iter().map(line).chain(more).collect()
    }
}
