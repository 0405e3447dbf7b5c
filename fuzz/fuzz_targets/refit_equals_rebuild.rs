//! See [`lightbvh_fuzz::refit_equals_rebuild`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::refit_equals_rebuild(data, Forms::One));
