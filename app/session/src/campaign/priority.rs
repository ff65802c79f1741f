//! Threads that run studies and searches behind a window: how many, and at which priority.

use std::io;

/// Gives this thread, and the threads that it starts, the lowest priority: everything else on the
/// machine goes first. Does nothing where the system is not Unix.
///
/// # Errors
/// Where the system refuses.
pub fn lower() -> io::Result<()> {
    #[cfg(unix)]
    rustix::process::nice(19)?;
    Ok(())
}

/// Lowers this thread's priority on Linux. On other systems that would slow the whole program.
pub(crate) fn step_back() {
    #[cfg(target_os = "linux")]
    // A thread whose priority cannot be lowered runs at the ordinary one.
    let _ = lower();
}

/// Threads for encounters: one core is left to whatever shows them.
#[must_use]
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1))
}
