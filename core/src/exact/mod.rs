//! The only arithmetic that code shared by CPU and device may use.
//!
//! Vulkan promises a correctly rounded result for `+`, `-` and `*` of `f32` (as long as the compiler is kept from
//! contracting and re-arranging, which the kernels' post-pass sees to), for comparisons, selects, bit casts, integer
//! operations and conversions in range — and for nothing else: division may be off by 2.5 ULP, `sqrt` by more, `fma` may
//! or may not fuse, `min`/`max` leave zeros and NaN open, denormals may be flushed (Vulkan 1.4 specification, appendix
//! "Precision and Operation of SPIR-V Instructions"). What else the light BVH needs is built here from the promised part:
//!
//! | function | result | how |
//! |---|---|---|
//! | [`div`], [`sqrt`] | correctly rounded | native on the CPU, integer remainder on the device; the tests compare both over all significands |
//! | [`recip`], [`rsqrt`] | same bits, within 7e-6 relative | Newton steps, the same code on both sides |
//! | [`recip_rough`], [`rsqrt_rough`] | same bits, within 3e-3 and 7e-4 relative | one Newton step |
//! | [`min`], [`max`], [`clamp`], [`abs`] | exact | compare and select, bit masks |
//! | [`flush`], [`floor_u32`], [`floor_small`] | exact | compare and select, truncation |
//! | [`exponent`], [`significand`], [`pow2`] | exact | the bits themselves |
//! | [`hash`], [`unit_f32`] | exact | 32-bit integers |
//!
//! Two conditions hold for every function unless it says otherwise: arguments are neither NaN nor infinite, and a
//! denormal argument counts as zero or is excluded (some devices flush it before they look at it).

mod div;
mod hash;
mod order;
mod root;
mod scale;

pub use div::{div, div_emulated, recip, recip_rough};
pub use hash::{hash, unit_f32};
pub use order::{abs, clamp, floor_small, floor_u32, flush, max, min};
pub(crate) use order::{mask, mask_of, masked, masked_u32};
pub use root::{rsqrt, rsqrt_rough, sqrt, sqrt_emulated};
pub(crate) use scale::power;
pub use scale::{exponent, pow2, significand};

/// The sign bit of an `f32`.
const SIGN: u32 = 0x8000_0000;
/// The bits of 1.0, and of every significand's exponent once it is moved into `[1, 2)`.
const ONE: u32 = 0x3f80_0000;
/// The stored part of a significand.
const FRACTION: u32 = 0x007f_ffff;
/// The leading one of a normal number's significand, which is not stored; also the bits of 2^-126.
const HIDDEN: u32 = 0x0080_0000;
/// The bits of +infinity.
const INFINITY: u32 = 0x7f80_0000;
