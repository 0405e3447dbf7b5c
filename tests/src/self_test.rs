//! The answers of the self-test that `lightbvh-gpu` carries.

use glam::UVec3;
use lightbvh_kernels::self_test::{CHECK_COUNT, SelfTestPush, operands, self_test};

/// The file, below the repository's root.
pub const FILE: &str = "kernels/gpu/src/self_test/words.bin";

/// What it holds: operands, then the answers of native code, little-endian.
#[must_use]
pub fn words() -> Vec<u8> {
    let operands = operands(128);
    let push = SelfTestPush {
        count: operands.len() as u32,
    };
    let mut answers = vec![0u32; operands.len() * CHECK_COUNT as usize];
    for i in 0..push.count {
        self_test(UVec3::new(i, 0, 0), &push, &operands, &mut answers);
    }
    let operands = operands.iter().flat_map(|o| [o.a, o.b, o.c]);
    operands.chain(answers).flat_map(u32::to_le_bytes).collect()
}
