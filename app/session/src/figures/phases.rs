//! Figures of the phases of a run and of the statics before it.

use super::View::Table;
use super::{Figure, Quantity};
use crate::report::Report;
use crate::timing::Phase;

/// Figures of a phase of a run.
pub static PHASE: &[Figure<Phase>] = &[
    Figure::new(
        "simulated_s",
        "simulated time",
        "Simulated time.",
        Quantity::Duration,
        |phase: &Phase| phase.simulated_s.into(),
    )
    .shown(&[Table]),
    Figure::new("wall_s", "real time", "Real time.", Quantity::Duration, |phase: &Phase| {
        phase.wall_s.into()
    })
    .shown(&[Table]),
    Figure::new(
        "times_real_time",
        "times real time",
        "Simulated time divided by real time; 0 if the phase is empty.",
        Quantity::Number,
        |phase: &Phase| phase.times_real_time().into(),
    )
    .shown(&[Table]),
];

/// Figures of the statics before a run.
pub static SETTLED: &[Figure<Report>] = &[
    Figure::new(
        "settled",
        "started from rest",
        "Whether the run began from rest.",
        Quantity::Flag,
        |run: &Report| run.settled.converged.into(),
    ),
    Figure::new(
        "outcome",
        "statics",
        "Result of statics, in words.",
        Quantity::Id,
        |run: &Report| (&run.settled.outcome).into(),
    ),
    Figure::new(
        "residual_N",
        "greatest force out of balance",
        "Greatest force out of balance.",
        Quantity::Force,
        |run: &Report| run.settled.residual_n.into(),
    ),
    Figure::new(
        "wall_s",
        "real time of the statics",
        "Real time of the statics.",
        Quantity::Duration,
        |run: &Report| run.timing.settle_wall_s.into(),
    ),
];
