//! See [`lightbvh_fuzz::read_words`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::read_words(data, Forms::One));
