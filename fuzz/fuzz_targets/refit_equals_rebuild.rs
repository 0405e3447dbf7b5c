//! See [`lightbvh_fuzz::refit_equals_rebuild`].
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| lightbvh_fuzz::refit_equals_rebuild(data));
