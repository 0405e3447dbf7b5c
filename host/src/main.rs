//! The `lightbvh` program.

fn main() {}
