//! Loops over the slots of a node.

/// `each!(i, W, { .. })` runs the block for `i` from 0 to `W - 1`, of at most 16.
///
/// In kernels the block stands there once for each `i`, for refits and choices. rust-gpu keeps an array that a loop indexes in memory, and its ranges hide from
/// drivers how often a loop runs: the passes over one node and over its children took an NVIDIA H100 50 and 27 µs so, and take 14 and 10, of
/// which a dispatch of nothing takes 8.
macro_rules! each {
    ($i:ident, $count:expr, $body:block) => {{
        #[cfg(not(target_arch = "spirv"))]
        {
            const { assert!($count <= 16, "kernels would leave out the rest") };
            for $i in 0..$count {
                $body
            }
        }
        #[cfg(target_arch = "spirv")]
        {
            $crate::unroll::each!(@ $i, $count, $body, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
        }
    }};
    (@ $i:ident, $count:expr, $body:block, $($k:literal)*) => {
        $(
            if $k < $count {
                let $i: usize = $k;
                $body
            }
        )*
    };
}

pub(crate) use each;
