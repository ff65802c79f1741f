//! Why a run ends before its time.

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Time at which it stopped [s].
    pub time_s: f64,
    /// Which part, such as `line endline-top` or a plugin's id.
    pub part: String,
    /// The reason, for the user.
    pub reason: String,
}
