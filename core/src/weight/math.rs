//! The operations of weights that a device leaves open, as a type: exact ones, or the processor's own.

use crate::exact;

/// Reciprocals, roots and sums of products, as weights need them: what one processor computes otherwise than another unless it is written
/// out. [`Moments`](crate::Moments) is generic over it.
pub trait Math: Copy + Send + Sync + core::fmt::Debug + 'static {
    /// `c + a·b`.
    fn add_product(c: f32, a: f32, b: f32) -> f32;

    /// About `1 / x`, within 3e-3 relative, of a positive normal `x` up to 2^125.
    fn recip(x: f32) -> f32;

    /// About `1 / √x`, within 7e-4 relative, of a positive normal `x`.
    fn rsqrt(x: f32) -> f32;

    /// `a / b`, `b` an integer of at least 1.
    fn div(a: f32, b: f32) -> f32;
}

/// The operations of [`exact`]: the same bits on every processor.
#[derive(Clone, Copy, Debug)]
pub struct ExactMath;

impl Math for ExactMath {
    #[inline(always)]
    fn add_product(c: f32, a: f32, b: f32) -> f32 {
        c + a * b
    }

    /// [`recip_rough`](exact::recip_rough) of a positive number, whose sign need not be kept.
    #[inline(always)]
    fn recip(x: f32) -> f32 {
        let seed = f32::from_bits(0x7ef3_11c7_u32.wrapping_sub(x.to_bits()));
        seed * (2.0 - x * seed)
    }

    #[inline(always)]
    fn rsqrt(x: f32) -> f32 {
        exact::rsqrt_rough(x)
    }

    #[inline(always)]
    fn div(a: f32, b: f32) -> f32 {
        exact::div(a, b)
    }
}

/// The processor's own operations: a division, a root and a division, and one rounding for a product and a sum where that is an
/// instruction of the target. Each processor has bits of its own. There is no equality between two of them, nor between two
/// compilations; on the same one the pmf of a sample is still that of its light.
///
/// Only where there are such operations: on devices, and on the CPU with the feature `std`.
#[cfg(any(feature = "std", target_arch = "spirv"))]
#[derive(Clone, Copy, Debug)]
pub struct NativeMath;

#[cfg(any(feature = "std", target_arch = "spirv"))]
// The one type that is there for what shared code must not use.
#[allow(clippy::disallowed_methods)]
impl Math for NativeMath {
    #[inline(always)]
    fn add_product(c: f32, a: f32, b: f32) -> f32 {
        #[cfg(target_arch = "spirv")]
        {
            core::f32::math::mul_add(a, b, c)
        }
        // Where it is no instruction it is a function many times as slow.
        #[cfg(all(
            not(target_arch = "spirv"),
            any(target_feature = "fma", target_arch = "aarch64")
        ))]
        {
            a.mul_add(b, c)
        }
        #[cfg(not(any(target_arch = "spirv", target_feature = "fma", target_arch = "aarch64")))]
        {
            c + a * b
        }
    }

    #[inline(always)]
    fn recip(x: f32) -> f32 {
        1.0 / x
    }

    #[inline(always)]
    fn rsqrt(x: f32) -> f32 {
        #[cfg(target_arch = "spirv")]
        {
            1.0 / core::f32::math::sqrt(x)
        }
        #[cfg(not(target_arch = "spirv"))]
        {
            1.0 / x.sqrt()
        }
    }

    #[inline(always)]
    fn div(a: f32, b: f32) -> f32 {
        a / b
    }
}
