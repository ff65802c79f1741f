//! The priority of threads that run studies.

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
