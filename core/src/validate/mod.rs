//! The invariants of a light BVH, checked one by one; the first that does not hold is named.
//!
//! [`Bvh::validate`](crate::Bvh::validate) trusts no word: links, kinds and trails may hold anything. It runs on the CPU only,
//! takes time linear in the number of nodes, and needs as much memory again as the tree.

mod bounds;

pub(crate) use bounds::{same, same_words, within as contained};

use core::fmt;

use crate::tree::INVALID;

/// A word that is not what it must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Index of the node, or `u32::MAX` where it is about no node.
    pub node: u32,
    /// Slot of the child, or `u32::MAX` where it is about no child.
    pub slot: u32,
    /// What the words are.
    pub what: What,
    /// The word expected, or the greatest or least that would do; the bits of an `f32` where [`What::is_float`].
    pub expected: u32,
    /// The word found.
    pub found: u32,
}

/// What a [`Violation`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum What {
    /// Bottom level of a mesh light (`slot` is its index).
    Blas,
    /// Index of the root, in its tree's part of the nodes.
    Root,
    /// Kind of a child in a level where it has no place (a mesh light outside the top level, a triangle within it).
    Kind,
    /// A link, below the number of what it leads to; 0 in an empty slot.
    Link,
    /// How often a node is reached from the root of its tree.
    Reached,
    /// Level of a node, below the trail's capacity.
    Level,
    /// How often a triangle (`slot` is its index) is a leaf.
    Triangle,
    /// How often a mesh light (`slot` is its index) is a leaf.
    Mesh,
    /// First triangle of a mesh light (`slot` is its index).
    First,
    /// A triangle of another mesh light than the bottom level is of.
    Owner,
    /// Low word of the trail of a leaf.
    TrailLow,
    /// High word of the trail of a leaf.
    TrailHigh,
    /// How often a record stands in its list: once.
    Listed,
    /// The place of a node of the top level in the node above it, in the record of its number.
    Place,
    /// Number of children of a node of the top level, at least two below the root.
    Children,
    /// Parts of an opened mesh light (`slot` is its index), or of a bottom level: as many as children of the root.
    Parts,
    /// A word of a node that does not show in the decoded summaries; the number counts words.
    Word(u32),
    /// A component of a child's summary that refit would not give.
    Bounds(&'static str),
    /// A component of a child's summary that reaches out of its parent's.
    Containment(&'static str),
}

impl What {
    /// Whether the words are the bits of an `f32`.
    #[must_use]
    pub fn is_float(self) -> bool {
        matches!(self, Self::Bounds(_) | Self::Containment(_))
    }
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Blas => write!(f, "bottom level of the mesh light"),
            Self::Root => write!(f, "index of the root"),
            Self::Kind => write!(f, "kind of child"),
            Self::Link => write!(f, "link"),
            Self::Reached => write!(f, "times reached"),
            Self::Level => write!(f, "level"),
            Self::Triangle => write!(f, "times that the triangle is a leaf"),
            Self::Mesh => write!(f, "times that the mesh light is a leaf"),
            Self::First => write!(f, "first triangle of the mesh light"),
            Self::Owner => write!(f, "mesh light of the triangle"),
            Self::TrailLow => write!(f, "low word of the leaf's trail"),
            Self::TrailHigh => write!(f, "high word of the leaf's trail"),
            Self::Place => write!(f, "place in the node above"),
            Self::Children => write!(f, "number of children"),
            Self::Parts => write!(f, "parts"),
            Self::Listed => write!(f, "times in its list"),
            Self::Word(word) => write!(f, "word {word} of the node"),
            Self::Bounds(component) => write!(f, "{component} after a refit"),
            Self::Containment(component) => write!(f, "{component} within the parent's"),
        }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.node != INVALID {
            write!(f, "node {}, ", self.node)?;
        }
        if self.slot != INVALID {
            write!(f, "slot {}, ", self.slot)?;
        }
        if self.what.is_float() {
            let (expected, found) = (f32::from_bits(self.expected), f32::from_bits(self.found));
            write!(f, "{}: expected {expected:e}, found {found:e}", self.what)
        } else {
            write!(
                f,
                "{}: expected {}, found {}",
                self.what, self.expected, self.found
            )
        }
    }
}

impl core::error::Error for Violation {}

/// `Ok` if the words are equal.
pub(crate) fn equal(node: u32, slot: u32, what: What, expected: u32, found: u32) -> Result<(), Violation> {
    if expected == found {
        Ok(())
    } else {
        Err(Violation {
            node,
            slot,
            what,
            expected,
            found,
        })
    }
}
