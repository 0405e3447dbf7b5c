//! The fuzz target that this program is named after.
#![no_main]

use lightbvh_fuzz::{Forms, TARGETS};

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let target = TARGETS.iter().find(|(name, _)| *name == env!("CARGO_BIN_NAME"));
    target.expect("a target of that name").1(data, Forms::One);
});
