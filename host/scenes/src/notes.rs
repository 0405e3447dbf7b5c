//! What a loader leaves out or replaces, said once for each kind.

/// Kinds kept, and places named of each; the rest is counted.
const MAX_KINDS: usize = 50;
const MAX_PLACES: usize = 3;

/// Warnings of one file, and of what it includes.
#[derive(Debug, Default)]
pub(super) struct Notes {
    kinds: Vec<Kind>,
    more: u64,
}

#[derive(Debug)]
struct Kind {
    what: String,
    /// The first ones.
    places: Vec<String>,
    last: Option<String>,
    count: usize,
}

impl Notes {
    /// Something at `place`, which may be empty, is left out or replaced: `what` has the same words for the same kind.
    pub fn add(&mut self, place: impl Into<String>, what: impl Into<String>) {
        let (place, what) = (place.into(), what.into());
        let known = self.kinds.iter().position(|kind| kind.what == what);
        if known.is_none() && self.kinds.len() == MAX_KINDS {
            self.more += 1;
            return;
        }
        let index = known.unwrap_or_else(|| {
            let (places, last, count) = (Vec::new(), None, 0);
            self.kinds.push(Kind {
                what,
                places,
                last,
                count,
            });
            self.kinds.len() - 1
        });
        let kind = &mut self.kinds[index];
        // Several textures of an element say the same.
        if kind.last.as_ref() != Some(&place) {
            kind.count += 1;
            if kind.places.len() < MAX_PLACES && !place.is_empty() {
                kind.places.push(place.clone());
            }
            kind.last = Some(place);
        }
    }

    /// A line for each kind: `materials[0], materials[3], materials[4] and 7 more: ...`.
    pub fn into_warnings(self) -> Vec<String> {
        let line = |kind: Kind| {
            let places = kind.places.join(", ");
            match kind.count.saturating_sub(MAX_PLACES) {
                _ if places.is_empty() => kind.what,
                0 => format!("{places}: {}", kind.what),
                more => format!("{places} and {more} more: {}", kind.what),
            }
        };
        let more = (self.more > 0).then(|| format!("and {} more", self.more));
        self.kinds.into_iter().map(line).chain(more).collect()
    }
}
