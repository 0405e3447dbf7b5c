//! Records that the passes write, for comparison by name.

use std::marker::PhantomData;

use lightbvh::node::Node;

use crate::words::{Field, Record};

/// Words of a node of layout `N`; by place alone where the names of the layout's words are not known here.
pub fn node_record<N: Node<W>, const W: usize>() -> Record {
    let words = size_of::<N>() / size_of::<u32>();
    let known = [
        Words::<W>::COMPACT,
        Words::<W>::MOMENTS,
        Words::<W>::BEAMS,
        Words::<W>::MASKS,
    ];
    let names = ["compact", "moments", "moments with beams", "linked moments"];
    let named = names.iter().zip(known).map(|(name, fields)| {
        let record = Record { name: "node", fields };
        (*name == N::NAME && record.words() == words).then_some(record)
    });
    named.flatten().next().unwrap_or(Record {
        name: "node",
        fields: Layout::<N>::PLAIN,
    })
}

/// The words of layouts of width `W`.
struct Words<const W: usize>;

impl<const W: usize> Words<W> {
    const EACH: u32 = W as u32;
    /// [`lightbvh::CompactNode`].
    const COMPACT: &'static [Field] = &[
        Field::new("center_x", Self::EACH),
        Field::new("center_y", Self::EACH),
        Field::new("center_z", Self::EACH),
        Field::new("extent", Self::EACH),
        Field::new("axis_kind", Self::EACH),
        Field::new("phi_cone", Self::EACH),
        Field::new("link", Self::EACH),
    ];
    /// [`lightbvh::MomentNode`]. Codes may be all ones.
    const MOMENTS: &'static [Field] = Self::BEAMS.split_at(8).0;
    /// [`lightbvh::node::SpotMomentNode`].
    const BEAMS: &'static [Field] = &Self::moments_and("beam");
    /// [`lightbvh::node::LinkedMomentNode`]. A mask of ones is that of most lights.
    const MASKS: &'static [Field] = &Self::moments_and("mask");

    const fn moments_and(row: &'static str) -> [Field; 9] {
        [
            Field::new("origin", 3),
            Field::new("exponents", 1),
            Field::new("unused", Self::EACH.saturating_sub(4)),
            Field::any("center_kind", Self::EACH),
            Field::any("center_phi", Self::EACH),
            Field::any("normal", Self::EACH),
            Field::any("extent", Self::EACH),
            Field::new("link", Self::EACH),
            Field::any(row, Self::EACH),
        ]
    }
}

/// The words of any layout.
struct Layout<N>(PhantomData<N>);

impl<N> Layout<N> {
    const PLAIN: &'static [Field] = &[Field::new("word", (size_of::<N>() / size_of::<u32>()) as u32)];
}

/// Words of a sampled light.
pub const SAMPLED_RECORD: Record = Record {
    name: "sampled light",
    fields: &[
        Field::index("light"),
        Field::index("instance"),
        Field::new("pmf", 1),
    ],
};

/// Word of a pmf.
pub const PMF_RECORD: Record = Record {
    name: "pmf",
    fields: &[Field::new("pmf", 1)],
};

/// Words of a pixel.
pub const PIXEL_RECORD: Record = Record {
    name: "pixel",
    fields: &[Field::new("radiance", 3)],
};

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::node::TwoSidedMomentNode;
    use lightbvh_kernels::bvh::{Choice, Kinds, Paper, Standard};
    use lightbvh_kernels::receivers::LinkedNode;

    fn covers<N: Node<W>, const W: usize>(first: &str) {
        let record = node_record::<N, W>();
        assert_eq!(record.words() * size_of::<u32>(), size_of::<N>());
        assert_eq!(record.name_of(0), first);
    }

    #[test]
    fn records_cover_their_nodes() {
        covers::<<Paper as Choice<4>>::Node, 4>("center_x[0]");
        covers::<<Standard as Choice<8>>::Node, 8>("origin[0]");
        // Of lights of any kind too: without a name for it, a code of ones looks as if no kernel had written it.
        covers::<<Kinds as Choice<8>>::Node, 8>("origin[0]");
        covers::<LinkedNode, 8>("origin[0]");
        covers::<TwoSidedMomentNode<8>, 8>("word[0]");
    }
}
