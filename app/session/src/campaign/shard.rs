//! A part of a study, for one of several machines.

/// Which part of a study to run: blocks whose number leaves `part` when divided by `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 0.
    pub part: u32,
    /// Of how many.
    pub of: u32,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether a block belongs to it.
    #[must_use]
    pub fn holds(self, block: u32) -> bool {
        block % self.of == self.part
    }
}
