//! See [`lightbvh_fuzz::exact`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::exact(data, Forms::One));
