//! See [`lightbvh_fuzz::edits`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::edits(data, Forms::One));
