//! The processor's floating-point state: its rounding, and its treatment of subnormal numbers.
//!
//! A library that changes it, as it is opened or in a call, changes every number that is computed afterwards, of this program too.
//! It is therefore read before and after every call into a library, restored, and reported.
#![expect(
    unsafe_code,
    reason = "one of the two sides of the plugin boundary: the processor's control register has no safe way in"
)]

/// The state that [`guarded`] restores: rounding, masks of exceptions, treatment of subnormal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FloatState(u64);

/// Runs a library's code; whether it left the floating-point state as it was. It is put back.
pub(super) fn guarded<T>(run: impl FnOnce() -> T) -> (T, bool) {
    let before = FloatState::now();
    let done = run();
    let kept = FloatState::now() == before;
    if !kept {
        before.put_back();
    }
    (done, kept)
}

#[cfg(target_arch = "x86_64")]
impl FloatState {
    /// The six lowest bits record which exceptions arose, and are no setting.
    const SETTINGS: u32 = !0x3f;

    fn now() -> Self {
        let mut control = 0_u32;
        // SAFETY: writes four bytes to a place of four bytes.
        unsafe {
            std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut control, options(nostack, preserves_flags));
        }
        Self(u64::from(control & Self::SETTINGS))
    }

    fn put_back(self) {
        let control = self.0 as u32;
        // SAFETY: loads what was read of the same register before, without the flags.
        unsafe {
            std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const control, options(nostack, preserves_flags));
        }
    }
}

#[cfg(target_arch = "aarch64")]
impl FloatState {
    fn now() -> Self {
        let control: u64;
        // SAFETY: reads a register.
        unsafe {
            std::arch::asm!("mrs {}, fpcr", out(reg) control, options(nomem, nostack, preserves_flags));
        }
        Self(control)
    }

    fn put_back(self) {
        // SAFETY: loads what was read of the same register before.
        unsafe {
            std::arch::asm!("msr fpcr, {}", in(reg) self.0, options(nomem, nostack, preserves_flags));
        }
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
impl FloatState {
    fn now() -> Self {
        Self(0)
    }

    fn put_back(self) {}
}
