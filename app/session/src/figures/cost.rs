//! Figures of what the computing time of a run went to.

use endline_sim::{Cost, CostPart};

use super::View::Table;
use super::{Figure, Quantity};

/// Computing time of a run by what it went to; all but the first sum to the first.
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

/// What the computing time went to and its share of the whole, the greatest share first; empty before the first step.
#[must_use]
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
        for (place, part) in CostPart::ALL.into_iter().enumerate() {
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
