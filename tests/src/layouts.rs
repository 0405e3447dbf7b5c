//! Layouts of nodes, with an importance that they serve or without: what tests that hold for any are run over.

/// Calls a function of `<N, I, const W: usize>` for each of them.
#[macro_export]
macro_rules! each_layout {
    ($call:ident $arguments:tt) => {{
        use lightbvh::{CompactNode, Defensive, Eq4, FluxOverDistance, FullNode, MomentNode, Moments};
        $call::<CompactNode<2>, Eq4, 2> $arguments;
        $call::<CompactNode<4>, Eq4, 4> $arguments;
        $call::<CompactNode<8>, FluxOverDistance, 8> $arguments;
        $call::<CompactNode<16>, Eq4, 16> $arguments;
        $call::<FullNode<2>, Eq4, 2> $arguments;
        $call::<MomentNode<8>, Moments, 8> $arguments;
        $call::<FullNode<4>, Defensive<Eq4, 5>, 4> $arguments;
    }};
}

/// Calls a function of `<N, const W: usize>` for each layout of nodes.
#[macro_export]
macro_rules! each_node {
    ($call:ident $arguments:tt) => {{
        use lightbvh::{CompactNode, FullNode, MomentNode};
        $call::<CompactNode<2>, 2> $arguments;
        $call::<CompactNode<4>, 4> $arguments;
        $call::<CompactNode<16>, 16> $arguments;
        $call::<FullNode<2>, 2> $arguments;
        $call::<FullNode<8>, 8> $arguments;
        $call::<MomentNode<4>, 4> $arguments;
        $call::<MomentNode<8>, 8> $arguments;
    }};
}
