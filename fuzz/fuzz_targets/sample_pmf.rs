//! See [`lightbvh_fuzz::sample_pmf`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::sample_pmf(data, Forms::One));
