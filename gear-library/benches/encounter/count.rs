//! Counts instructions of a section of a run under Callgrind: `valgrind --tool=callgrind --instr-atstart=no <bench> count=NAME`.
//!
//! The run up to the section is not counted. `cargo xtask instructions` calls this for all sections and compares the counts with the
//! table beside this benchmark.
#![allow(
    unsafe_code,
    reason = "a request to Valgrind is a sequence of instructions, valgrind/valgrind.h"
)]

/// Requests to Callgrind, valgrind/callgrind.h.
const START_INSTRUMENTATION: u64 = CALLGRIND + 4;
const STOP_INSTRUMENTATION: u64 = CALLGRIND + 5;
/// First request of this tool: its letters CT in the upper half.
const CALLGRIND: u64 = 0x4354_0000;

/// Runs `advance` with instrumentation.
pub fn counted(advance: impl FnOnce()) {
    request(START_INSTRUMENTATION);
    advance();
    request(STOP_INSTRUMENTATION);
}

/// Sends a request to Valgrind. Without Valgrind, the instructions change nothing.
#[cfg(target_arch = "x86_64")]
fn request(number: u64) {
    let arguments = [number, 0, 0, 0, 0, 0];
    // SAFETY: the four rotations of rdi sum to 128 bits, which restores it; xchg of a register with itself changes nothing. Valgrind
    // recognises the sequence, reads the arguments and writes rdx.
    unsafe {
        core::arch::asm!(
            "rol rdi, 3",
            "rol rdi, 13",
            "rol rdi, 61",
            "rol rdi, 51",
            "xchg rbx, rbx",
            in("rax") arguments.as_ptr(),
            inout("rdx") 0_u64 => _,
            inout("rdi") 0_u64 => _,
        );
    }
}

/// Instructions are counted on x86-64 only.
#[cfg(not(target_arch = "x86_64"))]
fn request(_number: u64) {}
