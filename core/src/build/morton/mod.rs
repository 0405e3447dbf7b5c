//! Clusters of neighbours along a curve: the fast half of the wide builder.
//!
//! Lights are sorted by their Morton codes (C. Lauterbach et al., "Fast BVH construction on GPUs", 2009). The codes'
//! common prefixes are a tree (T. Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees",
//! 2012); its greatest subtrees of up to `W` lights become leaf nodes, and Ward's criterion sorts those.

mod clusters;
mod codes;
mod radix;
#[cfg(test)]
mod tests;

pub(super) use clusters::clusters;
