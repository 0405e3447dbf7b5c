//! See [`lightbvh_fuzz::texts`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::texts(data, Forms::One));
