//! Records that the passes write, for comparison by name.

use lightbvh::node::Node;

use crate::words::Record;

/// Words of a node of layout `N`; by place alone where the names of the layout's words are not known here.
pub fn node_record<N: Node<W>, const W: usize>() -> Record {
    let plain: &[_] = const { &[("word", size_of::<N>() / size_of::<u32>())] };
    let fields: &[_] = match N::NAME {
        "compact" => {
            const {
                &[
                    ("center_x", W),
                    ("center_y", W),
                    ("center_z", W),
                    ("extent", W),
                    ("axis_kind", W),
                    ("phi_cone", W),
                    ("link", W),
                ]
            }
        }
        "moments" => const { &moments_and::<W>(("", 0)) },
        "moments with beams" => const { &moments_and::<W>(("beam", W)) },
        "linked moments" => const { &moments_and::<W>(("mask", W)) },
        _ => plain,
    };
    let named = Record { name: "node", fields };
    match named.words() == plain[0].1 {
        true => named,
        false => Record {
            name: "node",
            fields: plain,
        },
    }
}

/// Words of layouts of moments of width `W`, and a row after them.
const fn moments_and<const W: usize>(row: (&'static str, usize)) -> [(&'static str, usize); 9] {
    [
        ("origin", 3),
        ("exponents", 1),
        ("unused", W.saturating_sub(4)),
        ("center_kind", W),
        ("center_phi", W),
        ("normal", W),
        ("extent", W),
        ("link", W),
        row,
    ]
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
        covers::<<Kinds as Choice<8>>::Node, 8>("origin[0]");
        covers::<LinkedNode, 8>("origin[0]");
        covers::<TwoSidedMomentNode<8>, 8>("word[0]");
    }
}
