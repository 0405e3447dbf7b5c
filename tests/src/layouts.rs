//! Layouts of nodes, with an importance that they serve or without, for tests that hold for any: each layout, width and importance
//! once, since each more is compiled again.

/// Calls a function of `<N, I, const W: usize>` for each of them.
#[macro_export]
macro_rules! each_layout {
    ($call:ident $arguments:tt) => {{
        use lightbvh::{CompactNode, Defensive, Eq4, FluxOverDistance, MomentNode, Moments};
        $call::<CompactNode<2>, Eq4, 2> $arguments;
        $call::<CompactNode<16>, FluxOverDistance, 16> $arguments;
        $call::<MomentNode<8>, Moments, 8> $arguments;
        $call::<CompactNode<4>, Defensive<Eq4, 5>, 4> $arguments;
    }};
}

/// Calls a function of `<N, const W: usize>` for each layout of nodes.
#[macro_export]
macro_rules! each_node {
    ($call:ident $arguments:tt) => {{
        use lightbvh::{CompactNode, MomentNode};
        $call::<CompactNode<4>, 4> $arguments;
        $call::<CompactNode<16>, 16> $arguments;
        $call::<MomentNode<8>, 8> $arguments;
    }};
}
