//! See [`lightbvh_fuzz::build_validate`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::build_validate(data, Forms::One));
