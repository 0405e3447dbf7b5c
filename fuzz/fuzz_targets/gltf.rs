//! See [`lightbvh_fuzz::gltf`].
#![no_main]

use lightbvh_fuzz::Forms;

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::gltf(data, Forms::One));
