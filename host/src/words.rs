//! Two results, compared word for word.

use rayon::prelude::*;

/// The value of an output word that no kernel wrote; the Vulkan buffers are filled with it.
pub const UNWRITTEN: u32 = 0xffff_ffff;

/// Words that one task compares.
const CHUNK: usize = 1 << 16;

/// A type of record, so that a difference can be reported by its place.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// Its name.
    pub name: &'static str,
    /// Words of one record.
    pub words: usize,
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
    /// The first of them: record, its index, the place of the word in it, and both words.
    pub first: Option<String>,
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
    let size = record.words.max(1);
    Ok(Comparison {
        compared: expected.len() as u64,
        different,
        first: first.map(|at| {
            let (name, index, word) = (record.name, at / size, at % size);
            let [expected, actual] = [expected[at], actual[at]];
            let unwritten = if actual == UNWRITTEN { ", never written" } else { "" };
            format!(
                "{name} {index}, word {word}: expected {expected:#010x} ({:e}), got {actual:#010x} ({:e}){unwritten}",
                f32::from_bits(expected),
                f32::from_bits(actual)
            )
        }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: Record = Record {
        name: "node",
        words: 5,
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
        let text = "node 20000, word 2: expected 0x3f800000 (1e0), got 0x3f800002 (1.0000002e0)";
        assert_eq!(comparison.first.unwrap(), text);
        assert!(compare_words(&NODE, &[0; 5], &[0; 10]).is_err());
        let unwritten = compare_words(&NODE, &[0; 5], &[0, 0, 0, UNWRITTEN, 0]).unwrap();
        let said = unwritten.first.unwrap();
        assert!(
            said.starts_with("node 0, word 3: ") && said.ends_with("never written"),
            "{said}"
        );
    }
}
