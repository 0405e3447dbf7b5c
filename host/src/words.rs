//! Two results, compared word for word.

use rayon::prelude::*;
use std::fmt;

/// What an output word holds that no kernel wrote; the Vulkan buffers are filled with it.
pub const UNWRITTEN: u32 = 0xffff_ffff;

/// Words that one task compares.
const CHUNK: usize = 1 << 16;

/// The fields of a record, in memory order, so that a difference can be told by name.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// Name of the record type.
    pub name: &'static str,
    /// Its fields; together they cover it.
    pub fields: &'static [Field],
}

/// A field of a record.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    name: &'static str,
    words: u32,
    all_ones: bool,
}

impl Field {
    /// A field of `words` words that never rightly holds [`UNWRITTEN`].
    pub const fn new(name: &'static str, words: u32) -> Self {
        Self {
            name,
            words,
            all_ones: false,
        }
    }

    /// An index that is `u32::MAX` where there is nothing to refer to: one word, as of [`any`](Self::any).
    pub const fn index(name: &'static str) -> Self {
        Self::any(name, 1)
    }

    /// A field of `words` words that may hold anything, and so cannot tell a word from one that was never written. A record
    /// needs another field that can.
    pub const fn any(name: &'static str, words: u32) -> Self {
        Self {
            name,
            words,
            all_ones: true,
        }
    }
}

impl Record {
    /// A plain array of words.
    pub const WORDS: Self = Self {
        name: "word",
        fields: &[Field::new("value", 1)],
    };

    /// Words of one record.
    pub fn words(&self) -> usize {
        self.fields.iter().map(|field| field.words as usize).sum()
    }

    /// The name of word `word` of a record: that of its field, with the place in it if it has several words.
    pub fn name_of(&self, word: usize) -> String {
        match self.field(word) {
            Some((field, place)) if field.words > 1 => format!("{}[{place}]", field.name),
            Some((field, _)) => field.name.into(),
            None => format!("word {word}"),
        }
    }

    /// The field that word `word` of a record belongs to, and its place in that field.
    fn field(&self, word: usize) -> Option<(&Field, usize)> {
        let mut place = word;
        for field in self.fields {
            if place < field.words as usize {
                return Some((field, place));
            }
            place -= field.words as usize;
        }
        None
    }
}

/// Why two results cannot be compared.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// They are not equally long.
    #[error("{record}: {expected} words expected, {actual} came; the two sides did different work")]
    Length {
        record: &'static str,
        expected: usize,
        actual: usize,
    },
    /// They do not hold a whole number of records.
    #[error(
        "{words} words are not a whole number of `{record}` records of {size} words; the field table is wrong"
    )]
    Ragged {
        record: &'static str,
        words: usize,
        size: usize,
    },
}

/// The outcome of a comparison.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comparison {
    /// Words compared.
    pub compared: u64,
    /// Words that differ, or that nobody wrote.
    pub different: u64,
    /// The first of them.
    pub first: Option<Difference>,
}

/// A word that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The record type.
    pub record: &'static str,
    /// Index of the record.
    pub index: usize,
    /// The field, with the place in it if it has several words.
    pub field: String,
    /// The word of the reference.
    pub expected: u32,
    /// The word of the result.
    pub actual: u32,
}

/// Compares `actual` with `expected`, both arrays of `record`, using all cores.
///
/// A word of `actual` that is still [`UNWRITTEN`] counts as different even where the reference holds the same word,
/// unless its field may hold it ([`Field::any`]).
///
/// # Errors
/// [`CompareError`] if the two cannot be laid beside each other.
pub fn compare_words(record: &Record, expected: &[u32], actual: &[u32]) -> Result<Comparison, CompareError> {
    if expected.len() != actual.len() {
        let (expected, actual) = (expected.len(), actual.len());
        return Err(CompareError::Length {
            record: record.name,
            expected,
            actual,
        });
    }
    let size = record.words();
    if size == 0 || !expected.len().is_multiple_of(size) {
        return Err(CompareError::Ragged {
            record: record.name,
            words: expected.len(),
            size,
        });
    }
    let differs = |at: usize| {
        let unwritten =
            actual[at] == UNWRITTEN && record.field(at % size).is_none_or(|(field, _)| !field.all_ones);
        unwritten || expected[at] != actual[at]
    };
    let (different, first) = (0..expected.len().div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let range = chunk * CHUNK..((chunk + 1) * CHUNK).min(expected.len());
            let mut different = 0u64;
            let mut first = None;
            for at in range.filter(|at| differs(*at)) {
                different += 1;
                first = first.or(Some(at));
            }
            (different, first)
        })
        .reduce(
            || (0, None),
            |left, right| (left.0 + right.0, left.1.into_iter().chain(right.1).min()),
        );
    let first = first.map(|at| Difference {
        record: record.name,
        index: at / size,
        field: record.name_of(at % size),
        expected: expected[at],
        actual: actual[at],
    });
    Ok(Comparison {
        compared: expected.len() as u64,
        different,
        first,
    })
}

/// Number of floats from one bit pattern to the other, `None` if either is not a number. Both zeros are one float.
pub fn ulp_distance(a: u32, b: u32) -> Option<u32> {
    if f32::from_bits(a).is_nan() || f32::from_bits(b).is_nan() {
        return None;
    }
    // Sign and magnitude to a place on one line: neighbouring floats have neighbouring magnitudes.
    let place = |bits: u32| {
        let magnitude = i64::from(bits & 0x7fff_ffff);
        if bits >> 31 == 0 { magnitude } else { -magnitude }
    };
    u32::try_from(place(a).abs_diff(place(b))).ok()
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            record,
            index,
            field,
            expected,
            actual,
        } = self;
        let (a, b) = (f32::from_bits(*expected), f32::from_bits(*actual));
        write!(
            f,
            "{record} {index}, {field}: expected {expected:#010x} ({a:e}), got {actual:#010x} ({b:e})"
        )?;
        match ulp_distance(*expected, *actual) {
            _ if *actual == UNWRITTEN => write!(f, ", never written"),
            Some(distance) => write!(f, ", {distance} ulp apart"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
