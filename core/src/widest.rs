//! Code compiled for several sets of vector instructions, of which the machine's widest is taken when the program runs.
//!
//! All are compiled from one source without contraction, so they give the same words. Without the feature `std` there is one:
//! that of the instructions that the program is compiled for.

/// Runs `job` with the machine's widest registers. It is compiled for them where it is inlined, so closures are `#[inline(always)]`.
#[cfg(feature = "std")]
#[inline(always)]
pub fn widest<R>(job: impl FnOnce() -> R) -> R {
    use pulp::{Arch, Simd, WithSimd};

    struct Job<F>(F);

    impl<R, F: FnOnce() -> R> WithSimd for Job<F> {
        type Output = R;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> R {
            (self.0)()
        }
    }

    Arch::new().dispatch(Job(job))
}

/// Runs `job`.
#[cfg(not(feature = "std"))]
#[inline(always)]
pub fn widest<R>(job: impl FnOnce() -> R) -> R {
    job()
}
