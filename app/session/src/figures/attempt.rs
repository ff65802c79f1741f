//! Figures that a study adds to a run.

use super::{Figure, Quantity};

/// A run that a study asked for, whether or not there is one.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// Index of the encounter.
    pub encounter: u32,
    /// Id of the option.
    pub option: String,
    /// What the encounter counts for.
    pub weight: f64,
    /// Key by which `endline study replay` finds it.
    pub replay_key: String,
    /// Reason for a missing or invalid run; empty if it is valid.
    pub fault: String,
}

/// Figures of a run that a study asked for.
pub static ATTEMPT: &[Figure<Attempt>] = &[
    Figure::new(
        "encounter",
        "encounter",
        "Index of the encounter.",
        Quantity::Count,
        |attempt: &Attempt| attempt.encounter.into(),
    )
    .not_in_json()
    .column(0),
    Figure::new("option", "option", "Id of the option.", Quantity::Id, |attempt: &Attempt| {
        (&attempt.option).into()
    })
    .not_in_json()
    .column(1),
    Figure::new(
        "weight",
        "weight",
        "Weight of the encounter, if encounters are drawn from proposals; else 1.",
        Quantity::Number,
        |attempt: &Attempt| attempt.weight.into(),
    )
    .not_in_json()
    .column(3),
    Figure::new(
        "replay_key",
        "replay key",
        "Study hash, encounter and option, which define the run.",
        Quantity::Id,
        |attempt: &Attempt| (&attempt.replay_key).into(),
    )
    .not_in_json()
    .column(2),
    Figure::new(
        "fault",
        "fault",
        "Reason for a missing or invalid run; empty if it is valid.",
        Quantity::Id,
        |attempt: &Attempt| (&attempt.fault).into(),
    )
    .not_in_json()
    .column(11),
];
