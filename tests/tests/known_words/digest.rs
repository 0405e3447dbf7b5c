//! A digest of words.

use bytemuck::{Pod, cast_slice};
use lightbvh::Summary;

/// FNV-1a, 64 bits, word by word.
pub struct Digest(u64);

impl Digest {
    pub fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
    }

    pub fn float(&mut self, x: f32) {
        // Whose bits no standard settles.
        assert!(!x.is_nan());
        self.word(x.to_bits());
    }

    pub fn words<T: Pod>(&mut self, values: &[T]) {
        self.word(values.len() as u32);
        cast_slice::<T, u32>(values)
            .iter()
            .for_each(|&word| self.word(word));
    }

    pub fn summary<S: Summary>(&mut self, summary: &S) {
        summary.to_words().into_iter().for_each(|x| self.float(x));
    }

    #[track_caller]
    pub fn is(self, known: u64, what: &str) {
        // For a change of bits: prints all digests instead of stopping at the first.
        if std::env::var_os("LIGHTBVH_PRINT_DIGESTS").is_some() {
            println!("{what}: 0x{:016x}, known 0x{known:016x}", self.0);
            return;
        }
        assert!(
            self.0 == known,
            "{what}: 0x{:016x} is not the known 0x{known:016x}",
            self.0
        );
    }
}
