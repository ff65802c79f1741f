//! The audit of a run: counters of the solver's work, and its computing time by purpose.

use std::collections::BTreeMap;

use endline_sim::state::LimitedBy;
use endline_sim::{Cost, CostPart};

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
        "held_steps",
        "steps of gear at rest",
        "Steps without a solver step, in which gear that stood still was held as it was.",
        Quantity::Count,
        |run: &Report| run.audit.held_steps.into(),
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
        "checks of lengths near the whale",
        "Number of checks of segment lengths with rope near the whale; 0 without `[resolution]`.",
        Quantity::Count,
        |run: &Report| run.audit.resolution_looks.into(),
    )
    .column(306),
    Figure::new(
        "resolution_missed",
        "checks at which resolution was missed",
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

/// Computing time of a run by purpose; all but the first sum to the first.
pub static COST: &[Figure<Cost>] = &[
    Figure::new(
        "whole_s",
        "computing time",
        "Real time of the steps and of the measures after each: the sum of the others.",
        Quantity::Duration,
        |cost: &Cost| cost.whole_s().into(),
    )
    .shown(&[Table]),
    Figure::new(
        "free_rope_s",
        "free rope",
        "Solving rope and bodies that touch nothing but water and seabed, with the drag on them.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::FreeRope).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "detection_s",
        "contact detection",
        "Search for skin, rope and bodies near rope, distances, and proofs that paths are free.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Detection).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "contact_s",
        "contact solve",
        "Solving steps in which rope touches the whale, rope or bodies, with friction; all rope of \
         the step is solved together, with the drag on it.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Contact).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "whale_s",
        "whale",
        "The whale's motion, posture and pilot program.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Whale).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "water_s",
        "water",
        "Current and waves at every node and body; the drag that follows from them belongs to the \
         solves.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Water).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "metrics_s",
        "metrics",
        "Metrics, state hash and stored frames, after each step; `wall_s` of the run does not \
         include it.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Metrics).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "other_s",
        "other",
        "The rest, such as the copy of the state for a retry, lengths of segments that follow the \
         whale, and gear plugins.",
        Quantity::Duration,
        |cost: &Cost| cost.of_s(CostPart::Other).into(),
    )
    .shown(&[Table]),
];

/// The purposes of the computing time with their shares, the greatest first; empty before the first step.
pub fn shares(cost: &Cost) -> Vec<(&'static Figure<Cost>, f64)> {
    let whole_s = cost.whole_s();
    if whole_s <= 0.0 {
        return Vec::new();
    }
    let share = |figure: &'static Figure<Cost>| {
        (figure, (figure.read)(cost).number().unwrap_or_default() / whole_s)
    };
    let mut shares: Vec<_> = COST.iter().skip(1).map(share).collect();
    shares.sort_by(|one, other| other.1.total_cmp(&one.1));
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_sum_to_the_whole_and_the_greatest_share_is_first() {
        let mut cost = Cost::default();
        assert!(shares(&cost).is_empty());
        for (place, part) in CostPart::ALL.iter().copied().enumerate() {
            cost.add_ns(part, 1_000_000_000 << place);
        }
        let seconds = |figure: &Figure<Cost>| (figure.read)(&cost).number().unwrap();
        let parts: f64 = COST[1..].iter().map(seconds).sum();
        assert!((seconds(&COST[0]) - 127.0).abs() < 1e-9 && (parts - 127.0).abs() < 1e-9);
        let shares = shares(&cost);
        assert_eq!(shares.len(), CostPart::ALL.len());
        assert_eq!((shares[0].0.key, shares[6].0.key), ("other_s", "free_rope_s"));
        assert!((shares.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
