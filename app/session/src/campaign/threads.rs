//! How a campaign is spread: over machines by shards, over the threads of a process.

use std::io;

/// The part of a campaign that one of several machines runs: blocks whose number divided by `of` leaves `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 0.
    pub part: u32,
    /// Of how many.
    pub of: u32,
}

impl Shard {
    /// All of a campaign.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether a block belongs to it.
    pub fn holds(self, block: u32) -> bool {
        block % self.of == self.part
    }
}

/// Gives this thread, and the threads that it starts, the lowest priority. Does nothing on systems other than Unix.
pub fn try_lower_priority() -> io::Result<()> {
    #[cfg(unix)]
    rustix::process::nice(19)?;
    Ok(())
}

/// Lowers the priority of this thread on Linux. Other systems would slow the whole program.
pub(crate) fn lower_priority() {
    #[cfg(target_os = "linux")]
    // A thread whose priority cannot be lowered keeps the normal one.
    let _ = try_lower_priority();
}

/// Threads for encounters: all cores but one, which the window uses.
pub fn default_count() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1))
}
