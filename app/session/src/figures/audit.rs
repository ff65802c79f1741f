//! The audit of a run: counters of the solver's work.

use std::collections::BTreeMap;

use endline_sim::state::LimitedBy;

use super::View::Table;
use super::{BALANCE, Figure, Quantity, Value, object};
use crate::report::Report;

/// Counters of the solver's work.
pub static AUDIT: &[Figure<Report>] = &[
    Figure::new(
        "tunnelled",
        "rope through skin",
        "Number of times rope passed through skin.",
        Quantity::Count,
        |run: &Report| run.audit.tunnelled.into(),
    )
    .shown(&[Table])
    .column(12)
    .alarming(),
    Figure::new(
        "max_penetration_m",
        "deepest penetration",
        "Greatest penetration of the rope's surface into the skin.",
        Quantity::SmallLength,
        |run: &Report| run.audit.max_penetration_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "bodies_crossed",
        "bodies through skin",
        "Number of times a buoy, trap or anchor passed through skin.",
        Quantity::Count,
        |run: &Report| run.audit.bodies_crossed.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "ropes_crossed",
        "rope through rope",
        "Number of times rope passed through rope.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_crossed.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "ropes_through",
        "ropes through each other since the start",
        "Greatest number of pairs of segments at a time that have crossed since the start of the \
         run and are not separated.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_through.into(),
    ),
    Figure::new(
        "rope_within_m",
        "rope within bodies since the start",
        "Greatest length of rope at a time that has been within bodies since the start, such as an \
         endline stowed in its trap. It touches a body once it has come out of it.",
        Quantity::Length,
        |run: &Report| run.audit.rope_within_m.into(),
    ),
    Figure::new(
        "rope_steps",
        "solver steps with rope on rope",
        "Solver steps, away from the whale, with rope on rope.",
        Quantity::Count,
        |run: &Report| run.audit.rope_steps.into(),
    ),
    Figure::new(
        "least_distance_m",
        "least distance from skin",
        "Least distance of the rope's centre line from skin that it touched; none without contact.",
        Quantity::SmallLength,
        |run: &Report| run.audit.least_distance_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "winding_jumps",
        "winding jumps",
        "Steps in which wraps jumped by more than 0.3 turns along unbroken contact.",
        Quantity::Count,
        |run: &Report| run.summary.whale.as_ref().map_or(0, |whale| whale.winding_jumps).into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "non_finite",
        "numbers not finite",
        "Numbers that were not finite.",
        Quantity::Count,
        |run: &Report| run.audit.non_finite.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "solver_steps",
        "solver steps",
        "Solver steps taken.",
        Quantity::Count,
        |run: &Report| run.audit.solver_steps.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "contact_steps",
        "solver steps in contact",
        "Solver steps with rope near the whale.",
        Quantity::Count,
        |run: &Report| run.audit.contact_steps.into(),
    ),
    Figure::new(
        "touching_steps",
        "solver steps in touch",
        "Solver steps with rope on skin, rope, obstacles or bodies.",
        Quantity::Count,
        |run: &Report| run.audit.touching_steps.into(),
    ),
    Figure::new(
        "halved",
        "solver steps redone",
        "Solver steps that were repeated with a shorter step.",
        Quantity::Count,
        |run: &Report| run.audit.halved.into(),
    ),
    Figure::new(
        "unconverged",
        "solver steps not converged",
        "Solver steps accepted with a residual above the tolerance.",
        Quantity::Count,
        |run: &Report| run.audit.unconverged.into(),
    )
    .shown(&[Table])
    .column(13),
    Figure::new(
        "unconverged_parted",
        "partings in steps not converged",
        "Solver steps accepted with a residual above the tolerance, at whose end a link or line \
         parted.",
        Quantity::Count,
        |run: &Report| run.audit.unconverged_parted.into(),
    )
    .alarming(),
    Figure::new(
        "spikes",
        "tension spikes",
        "Tensions of a line that last a single solver step: three times those before and after, \
         and 50 N above both.",
        Quantity::Count,
        |run: &Report| run.audit.spikes.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "beyond_rope_share",
        "normal force beyond what rope can press",
        "Share of the normal force on the whale, over time, above T (θ + 2) + R for each stretch \
         of rope in contact. T is its greatest tension, θ its turn in radians, R the resultant of \
         its contact forces.",
        Quantity::Number,
        |run: &Report| run.summary.whale.as_ref().map(|whale| whale.beyond_rope_share).into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "passes",
        "Newton passes",
        "Total number of Newton iterations.",
        Quantity::Count,
        |run: &Report| run.audit.passes.into(),
    ),
    Figure::new(
        "splits",
        "segments split",
        "Segments split, each together with a merge, as the resolution followed the whale.",
        Quantity::Count,
        |run: &Report| run.audit.splits.into(),
    ),
    Figure::new(
        "resolution_looks",
        "looks at lengths near the whale",
        "Number of checks of segment lengths with rope near the whale; 0 without `[resolution]`.",
        Quantity::Count,
        |run: &Report| run.audit.resolution_looks.into(),
    )
    .column(306),
    Figure::new(
        "resolution_missed",
        "looks at which resolution was missed",
        "Number of these checks in which a segment near the whale exceeded `near` or `edges` by a \
         quarter or more. Causes are too few nodes, or rope in contact, which is not split.",
        Quantity::Count,
        |run: &Report| run.audit.resolution_missed.into(),
    )
    .shown(&[Table])
    .column(307)
    .alarming(),
    Figure::new(
        "resolution_ratio",
        "longest segment near the whale over wanted",
        "Greatest ratio of a segment's length near the whale to its target length; 0 without \
         `[resolution]`.",
        Quantity::Number,
        |run: &Report| run.audit.resolution_ratio.into(),
    ),
    Figure::new(
        "postures_held",
        "steps with joints at their limits",
        "Steps in which the ranges of its joints limited the whale's posture.",
        Quantity::Count,
        |run: &Report| run.audit.postures_held.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "steps_limited_by",
        "solver steps by what limited them",
        "Solver steps by the limit of their length: `inputs`, `accuracy`, `snap`, \
         `contact`, `parting`, `convergence`.",
        Quantity::Group,
        |run: &Report| Value::Counts(limits(run)),
    ),
    Figure::new(
        "steps_mostly_limited_by",
        "solver steps mostly limited by",
        "Limit of most of the solver steps, in words.",
        Quantity::Id,
        |run: &Report| Value::Text(mostly(run)),
    )
    .shown(&[Table]),
    Figure::new(
        "balance",
        "momentum and energy of the gear",
        "Momentum and energy of the gear by source; none if a scenario sets `balance = false`.",
        Quantity::Group,
        |run: &Report| {
            run.balance.as_ref().map_or(Value::Absent, |balance| object(BALANCE, balance))
        },
    ),
];

fn limits(run: &Report) -> BTreeMap<&'static str, u64> {
    let names = LimitedBy::ALL.iter().map(|limit| limit.name());
    names.zip(run.audit.limited_by).collect()
}

fn mostly(run: &Report) -> String {
    let (limit, steps) = LimitedBy::mostly(&run.audit.limited_by);
    let share = steps as f64 / run.audit.solver_steps.max(1) as f64;
    format!("{} ({:.0} %)", limit.words(), 100.0 * share)
}
