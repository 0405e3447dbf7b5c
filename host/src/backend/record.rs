//! Records that the passes write, for comparison by name.

use lightbvh::node::Node;

use crate::words::Record;

/// Words of a node of layout `N`, by their place.
pub fn node_record<N: Node<W>, const W: usize>() -> Record {
    Record {
        name: "node",
        fields: const { &[("word", size_of::<N>() / size_of::<u32>())] },
    }
}

/// Words of a sampled light.
pub const SAMPLED_RECORD: Record = Record {
    name: "sampled light",
    fields: &[("light", 1), ("instance", 1), ("pmf", 1)],
};

/// Word of a pmf.
pub const PMF_RECORD: Record = Record {
    name: "pmf",
    fields: &[("pmf", 1)],
};

/// Words of a pixel.
pub const PIXEL_RECORD: Record = Record {
    name: "pixel",
    fields: &[("radiance", 3)],
};
