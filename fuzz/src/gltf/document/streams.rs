//! What decoders of their own read: compressed views, a Draco stream, pictures in KTX 2 and WebP.

/// The four positions of a document by the codecs of `EXT_meshopt_compression`, as they are and through the exponential filter.
#[rustfmt::skip]
pub(super) const VERTICES: [&[u8]; 2] = [
    &[
        160, 0, 0, 1, 60, 0, 0, 0, 255, 255, 1, 60, 0, 0, 0, 126, 125, 0, 0, 1, 15, 0, 0, 0, 255, 255, 1, 15, 0, 0, 0, 126,
        125, 0, 0, 1, 3, 0, 0, 0, 255, 1, 3, 0, 0, 0, 126, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    ],
    &[
        160, 0, 1, 60, 0, 0, 0, 64, 63, 0, 1, 32, 0, 0, 0, 0, 1, 15, 0, 0, 0, 64, 63, 0, 1, 8, 0, 0, 0, 0, 1, 3, 0, 0, 0,
        64, 0, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 242, 0, 0, 0, 242, 0, 0,
        0, 242,
    ],
];

/// Its six indices, as triangles and as a sequence.
#[rustfmt::skip]
pub(super) const INDICES: [&[u8]; 2] = [
    &[
        225, 240, 32, 0, 118, 135, 86, 103, 120, 169, 134, 101, 137, 104, 152, 1, 105, 0, 0,
    ],
    &[
        209, 0, 4, 4, 6, 12, 6, 0, 0, 0, 0,
    ],
];

/// Both by Draco's Edgebreaker.
#[rustfmt::skip]
pub(super) const DRACO: &[u8] = &[
    68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 4, 2, 0, 2, 0, 0, 1, 47, 255, 1, 17, 1, 255, 0, 1, 1, 0, 9, 3, 0, 0, 2, 1, 1,
    1, 0, 3, 3, 1, 32, 1, 32, 3, 0, 16, 132, 17, 104, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    128, 63, 8,
];

/// A picture of four by four texels of one colour in KTX 2: plain, by Zstandard, by Basis Universal (UASTC).
pub(super) fn ktx2(kind: u8) -> Vec<u8> {
    // The colour model is UASTC, of blocks of four by four.
    const DESCRIPTOR: [u8; 44] = [
        44, 0, 0, 0, 0, 0, 0, 0, 2, 0, 40, 0, 166, 1, 2, 0, 3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255,
    ];
    const BLOCK: [u8; 16] = [
        215, 176, 33, 9, 211, 8, 212, 137, 56, 144, 107, 221, 18, 48, 132, 45,
    ];
    let plain = [200_u8; 64];
    // A frame of one raw block: magic, the content's size, the block's header.
    let mut zstd = vec![0x28, 0xb5, 0x2f, 0xfd, 0x20, 64, 1, 2, 0];
    zstd.extend(plain);
    let (format, scheme, level, unpacked): (u32, u32, &[u8], u64) = match kind % 3 {
        0 => (43, 0, &plain, 64),
        1 => (43, 2, &zstd, 64),
        _ => (0, 0, &BLOCK, 16),
    };
    let mut out = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let descriptor = DESCRIPTOR.len() as u32;
    for word in [format, 1, 4, 4, 0, 0, 1, 1, scheme, 104, descriptor, 0, 0] {
        out.extend(word.to_le_bytes());
    }
    out.extend([0; 16]);
    for long in [104 + u64::from(descriptor), level.len() as u64, unpacked] {
        out.extend(long.to_le_bytes());
    }
    out.extend(DESCRIPTOR);
    out.extend(level);
    out
}
