//! The calling thread's floating-point mode, which software devices inherit.

/// Default MXCSR: round to nearest even, all exceptions masked, no flush-to-zero, denormals kept. Intel SDM vol. 1,
/// section 10.2.3.
#[cfg(target_arch = "x86_64")]
const DEFAULT: u32 = 0x1f80;

/// Everything but the six sticky exception flags (bits 0 to 5), which arithmetic sets in passing.
#[cfg(target_arch = "x86_64")]
const CONTROL: u32 = 0xffc0;

/// The thread's MXCSR if it differs from the default in more than the sticky flags.
///
/// The worker threads of lavapipe inherit it from the thread that creates the device, so a stray flush-to-zero there
/// changes results without a word.
#[cfg(target_arch = "x86_64")]
pub(crate) fn unusual_control_word() -> Option<u32> {
    let mxcsr = control_word();
    (mxcsr & CONTROL != DEFAULT).then_some(mxcsr)
}

/// Other processors have no MXCSR; nothing was measured there.
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn unusual_control_word() -> Option<u32> {
    None
}

#[cfg(target_arch = "x86_64")]
fn control_word() -> u32 {
    let mut mxcsr = 0u32;
    // SAFETY: stores four bytes to a live, aligned u32 and touches nothing else; SSE is part of x86-64.
    unsafe { core::arch::asm!("stmxcsr [{}]", in(reg) &raw mut mxcsr, options(nostack, preserves_flags)) };
    mxcsr
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    fn set(mxcsr: u32) {
        // SAFETY: loads a valid control word (no reserved bits) from a live u32. No float arithmetic happens on this
        // thread until the default is restored.
        unsafe {
            core::arch::asm!("ldmxcsr [{}]", in(reg) &raw const mxcsr, options(nostack, preserves_flags))
        };
    }

    #[test]
    fn default_is_usual_and_sticky_flags_do_not_matter() {
        assert_eq!(unusual_control_word(), None);
        set(DEFAULT | 0x20); // precision flag, set by any inexact operation
        let seen = unusual_control_word();
        set(DEFAULT);
        assert_eq!(seen, None);
    }

    #[test]
    fn flushing_and_other_rounding_are_found() {
        for word in [0x9f80, 0x1fc0, 0x9fc0, 0x3f80, 0x5f80, 0x7f80] {
            set(word);
            let seen = unusual_control_word();
            set(DEFAULT);
            assert_eq!(seen, Some(word));
        }
    }
}
