//! Two results, compared word for word.

use rayon::prelude::*;
use std::fmt;

/// The value of an output word that no kernel wrote; the Vulkan buffers are filled with it.
pub const UNWRITTEN: u32 = 0xffff_ffff;

/// Words that one task compares.
const CHUNK: usize = 1 << 16;

/// The fields of a record, so that a difference can be reported by name.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// Name of the record type.
    pub name: &'static str,
    /// Names and words of its fields, in memory order; together they cover it.
    pub fields: &'static [(&'static str, usize)],
}

impl Record {
    /// Words of one record.
    pub fn words(&self) -> usize {
        self.fields.iter().map(|(_, words)| words).sum()
    }

    /// The name of word `word` of a record: that of its field, with the place in it if it has several words.
    pub fn name_of(&self, word: usize) -> String {
        let mut place = word;
        for &(name, words) in self.fields {
            if place < words {
                return match words {
                    1 => name.to_owned(),
                    _ => format!("{name}[{place}]"),
                };
            }
            place -= words;
        }
        format!("word {word}")
    }
}

/// Two results of different lengths.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{record}: {expected} words expected, {actual} came; the two sides did different work")]
pub struct CompareError {
    record: &'static str,
    expected: usize,
    actual: usize,
}

/// The outcome of a comparison.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Comparison {
    /// Words compared.
    pub compared: u64,
    /// Words that differ.
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
pub fn compare_words(record: &Record, expected: &[u32], actual: &[u32]) -> Result<Comparison, CompareError> {
    if expected.len() != actual.len() {
        return Err(CompareError {
            record: record.name,
            expected: expected.len(),
            actual: actual.len(),
        });
    }
    let pairs = expected
        .par_chunks(CHUNK)
        .zip(actual.par_chunks(CHUNK))
        .enumerate();
    let of = |(chunk, (expected, actual)): (usize, (&[u32], &[u32]))| {
        let places = (0..expected.len()).filter(|&at| expected[at] != actual[at]);
        let first = places.clone().next().map(|at| chunk * CHUNK + at);
        (places.count() as u64, first)
    };
    let (different, first) = pairs.map(of).reduce(
        || (0, None),
        |left, right| (left.0 + right.0, left.1.into_iter().chain(right.1).min()),
    );
    let size = record.words().max(1);
    Ok(Comparison {
        compared: expected.len() as u64,
        different,
        first: first.map(|at| Difference {
            record: record.name,
            index: at / size,
            field: record.name_of(at % size),
            expected: expected[at],
            actual: actual[at],
        }),
    })
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
        match *actual {
            UNWRITTEN => write!(f, ", never written"),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: Record = Record {
        name: "node",
        fields: &[("min", 3), ("phi", 1), ("light", 1)],
    };

    #[test]
    fn the_first_difference_is_named() {
        let expected = vec![1.0f32.to_bits(); 5 * 40_000];
        let mut actual = expected.clone();
        for at in [5 * 39_999, 5 * 20_000 + 3, 5 * 20_000 + 2] {
            actual[at] += 2;
        }
        let comparison = compare_words(&NODE, &expected, &actual).unwrap();
        assert_eq!((comparison.compared, comparison.different), (200_000, 3));
        let text = "node 20000, min[2]: expected 0x3f800000 (1e0), got 0x3f800002 (1.0000002e0)";
        assert_eq!(comparison.first.unwrap().to_string(), text);
        assert!(compare_words(&NODE, &[0; 5], &[0; 10]).is_err());
        let unwritten = compare_words(&NODE, &[0; 5], &[0, 0, 0, UNWRITTEN, 0]).unwrap();
        let said = unwritten.first.unwrap().to_string();
        assert!(
            said.starts_with("node 0, phi: ") && said.ends_with("never written"),
            "{said}"
        );
    }
}
