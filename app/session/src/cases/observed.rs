//! What was read of a case: every probe at the times asked for.

/// Readings of every probe.
#[derive(Clone, Debug, Default)]
pub(super) struct Observed {
    /// Times of the samples [s].
    pub times_s: Vec<f64>,
    /// By probe of the model: its reading at each time.
    pub samples: Vec<Vec<f64>>,
    /// The same at closer times, for a plot: times and readings.
    pub trace: (Vec<f64>, Vec<Vec<f64>>),
}
