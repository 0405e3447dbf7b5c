//! Numbers for placement, the same on every machine and in every run.

/// A small generator; the seed names the sequence.
pub(super) struct Random(u32);

impl Random {
    pub fn new(seed: u32) -> Self {
        Self(seed)
    }

    /// PCG-RXS-M-XS on 32 bits (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient ... Generators").
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        f64::from(self.next()) / 4_294_967_296.0
    }

    /// In [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// In 0..count.
    pub fn pick(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }
}

/// Hands `check` the files, each cut or with bytes that differ, `count` times: what a reader must bear.
#[cfg(test)]
pub(super) fn damaged(files: &[Vec<u8>], count: u32, mut check: impl FnMut(&[u8])) {
    /// Bytes that mean something to text files.
    const LIKELY: &[u8] = b"\0\n \"[]#/-+.eE0123456789\\\xff\x80";
    let mut random = Random::new(1);
    for case in 0..count {
        let mut bytes = files[case as usize % files.len()].clone();
        if bytes.is_empty() {
            continue;
        }
        if random.unit() < 0.3 {
            bytes.truncate(random.pick(bytes.len()));
        }
        for _ in 0..random.pick(4) {
            if bytes.is_empty() {
                break;
            }
            let at = random.pick(bytes.len());
            match random.pick(4) {
                0 => bytes[at] = random.pick(256) as u8,
                1 => bytes[at] = LIKELY[random.pick(LIKELY.len())],
                2 => bytes[at] ^= 1 << random.pick(8),
                _ => {
                    // A piece of the file again, elsewhere in it.
                    let from = random.pick(bytes.len());
                    let piece = bytes[from..bytes.len().min(from + random.pick(40))].to_vec();
                    bytes.splice(at..at, piece);
                }
            }
        }
        check(&bytes);
    }
}
