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
        "Times rope passed through skin.",
        Quantity::Count,
        |run: &Report| run.audit.tunnelled.into(),
    )
    .shown(&[Table])
    .column(12)
    .alarming(),
    Figure::new(
        "max_penetration_m",
        "deepest penetration",
        "Greatest depth to which the rope's surface sank into the skin.",
        Quantity::SmallLength,
        |run: &Report| run.audit.max_penetration_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "bodies_crossed",
        "bodies through skin",
        "Times a buoy, trap or anchor passed through skin.",
        Quantity::Count,
        |run: &Report| run.audit.bodies_crossed.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "ropes_crossed",
        "rope through rope",
        "Times rope passed through rope.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_crossed.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "ropes_through",
        "ropes through each other since the start",
        "Most pairs of segments at a time that have run through each other since the start, and \
         are left alone.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_through.into(),
    ),
    Figure::new(
        "rope_within_m",
        "rope within bodies since the start",
        "Most rope at a time that has lain within bodies since the start, such as an endline stowed \
         in its trap; it touches a body once it has come out of it.",
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
        "Least distance of the rope's centre line from skin that it touched; none where it touched \
         none.",
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
        "Solver steps that were redone shorter.",
        Quantity::Count,
        |run: &Report| run.audit.halved.into(),
    ),
    Figure::new(
        "unconverged",
        "solver steps not converged",
        "Solver steps accepted above the wanted residual.",
        Quantity::Count,
        |run: &Report| run.audit.unconverged.into(),
    )
    .shown(&[Table])
    .column(13),
    Figure::new(
        "unconverged_parted",
        "partings in steps not converged",
        "Solver steps accepted above the wanted residual at whose end something parted.",
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
         of rope in touch: greatest tension T, turn θ in radians, resultant R of its contact \
         forces.",
        Quantity::Number,
        |run: &Report| run.summary.whale.as_ref().map(|whale| whale.beyond_rope_share).into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "passes",
        "Newton passes",
        "Newton passes in all.",
        Quantity::Count,
        |run: &Report| run.audit.passes.into(),
    ),
    Figure::new(
        "splits",
        "segments split",
        "Segments split, each together with a merge, as resolution followed the whale.",
        Quantity::Count,
        |run: &Report| run.audit.splits.into(),
    ),
    Figure::new(
        "resolution_looks",
        "looks at lengths near the whale",
        "Times at which segment lengths were looked at with rope near the whale; 0 without \
         `[resolution]`.",
        Quantity::Count,
        |run: &Report| run.audit.resolution_looks.into(),
    )
    .column(306),
    Figure::new(
        "resolution_missed",
        "looks at which resolution was missed",
        "Those of them that left a segment near the whale longer than `near` or `edges` by a \
         quarter or more: nodes ran out, or rope in touch could not be split.",
        Quantity::Count,
        |run: &Report| run.audit.resolution_missed.into(),
    )
    .shown(&[Table])
    .column(307)
    .alarming(),
    Figure::new(
        "resolution_ratio",
        "longest segment near the whale over wanted",
        "Greatest ratio of a segment's length near the whale to the length wanted there; 0 without \
         `[resolution]`.",
        Quantity::Number,
        |run: &Report| run.audit.resolution_ratio.into(),
    ),
    Figure::new(
        "postures_held",
        "steps with joints at their limits",
        "Steps in which the whale's posture was held at the ranges of its joints.",
        Quantity::Count,
        |run: &Report| run.audit.postures_held.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "steps_limited_by",
        "solver steps by what limited them",
        "Solver steps by what kept them from being longer: `inputs`, `accuracy`, `snap`, \
         `contact`, `parting`, `convergence`.",
        Quantity::Group,
        |run: &Report| Value::Counts(limits(run)),
    ),
    Figure::new(
        "steps_mostly_limited_by",
        "solver steps mostly limited by",
        "What limited most of the solver steps, in words.",
        Quantity::Id,
        |run: &Report| Value::Text(mostly(run)),
    )
    .shown(&[Table]),
    Figure::new(
        "balance",
        "momentum and energy of the gear",
        "Momentum and energy of the gear by source; none where a scenario sets `balance = false`.",
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
