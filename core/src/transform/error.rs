//! What transforms are refused for.

use core::fmt;

use crate::number::Number;

/// Why a transform is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TransformError {
    /// An entry is NaN, infinite or beyond 2^40.
    Entry {
        /// Row, 0..3.
        row: usize,
        /// Column; 3 is the translation.
        column: usize,
        /// What was found.
        value: f32,
    },
    /// The mesh would reach beyond 2^40 m.
    TooFar {
        /// How far it may reach.
        metres: f32,
    },
}

impl fmt::Display for TransformError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Entry { row, column, value } => {
                if column < 3 {
                    write!(f, "columns[{column}][{row}]")?;
                } else {
                    write!(f, "translation[{row}]")?;
                }
                write!(
                    f,
                    " of a transform is {}, expected a finite number of magnitude at most 2^40 (1.1e12); repair the \
                     animation",
                    Number(value)
                )
            }
            Self::TooFar { metres } => write!(
                f,
                "a transform may move a mesh as far as {metres:e} m, expected at most 2^40 m (1.1e12); scale the scene or move its \
                 origin"
            ),
        }
    }
}

impl core::error::Error for TransformError {}
