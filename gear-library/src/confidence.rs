//! How well a figure or a distribution is known.

/// The key by which older files give a confidence; it is still read.
pub(crate) const FORMER_CONFIDENCE: &str = "sureness";

/// How well something is known, from the best to the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Confidence {
    /// Measured, or printed by its source as such.
    Measured,
    /// Computed from measured figures.
    Derived,
    /// An engineer's estimate, from what is known of similar things.
    Estimate,
    /// Assumed: nobody measured it, and no source supports it.
    Assumed,
}

impl Confidence {
    /// Every level, from the best to the least.
    pub const ALL: [Self; 4] = [Self::Measured, Self::Derived, Self::Estimate, Self::Assumed];

    /// The words a file may use for a figure. An assumption has no source, and a figure needs one.
    pub(crate) const OF_FIGURES: [&'static str; 3] = ["measured", "derived", "estimate"];

    /// The words a study may use for a distribution.
    pub(crate) const OF_PRIORS: [&'static str; 4] = ["measured", "derived", "estimate", "assumed"];

    /// The word a file uses for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Derived => "derived",
            Self::Estimate => "estimate",
            Self::Assumed => "assumed",
        }
    }

    /// The level of a file's word.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|confidence| confidence.word() == word)
    }
}
