//! See [`lightbvh_fuzz::trees`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::trees(data, Forms::One));
