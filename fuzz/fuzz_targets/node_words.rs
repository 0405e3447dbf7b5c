//! See [`lightbvh_fuzz::node_words`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::node_words(data));
