//! Densities of values under a law, for importance sampling.
//!
//! Of `n` encounters a share `α` is drawn from the priors `p`, the others from the proposals `q`. A value's density under
//! that mixture is `α p + (1 - α) q`, so that an encounter weighs `p / (α p + (1 - α) q) = 1 / (α + (1 - α) r)` with
//! `r = Π q_j / p_j` over the priors that have a proposal. No weight exceeds `1/α`, and weights have mean 1.
//! Reference: Hesterberg 1995, Weighted average importance sampling and defensive mixture distributions (Technometrics 37).

use endline_gear::{Law, Prior};
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

use super::Drawn;

/// Density of the proposals over that of the priors, over the priors that have one.
pub(super) fn ratio_of_proposals(priors: &[Prior], drawn: &[Drawn]) -> f64 {
    let ratio = |(prior, drawn): (&Prior, &Drawn)| {
        let proposal = prior.proposal.as_ref()?;
        Some(density(proposal, drawn) / density(&prior.law, drawn))
    };
    priors.iter().zip(drawn).filter_map(ratio).product()
}

/// Density of a law at a number, or the share of a level.
fn density(law: &Law, drawn: &Drawn) -> f64 {
    match law {
        Law::Choice(levels) => {
            let own = levels.iter().filter(|(level, _)| level.text == drawn.text);
            own.map(|(_, weight)| weight).sum()
        }
        Law::Uniform { low, high, .. } => 1.0 / (high - low),
        Law::Normal { mean, deviation, low, high, .. } => drawn
            .number
            .map_or(0.0, |number| truncated_normal(*mean, *deviation, [*low, *high], number)),
        Law::Bins { edges, shares, .. } => {
            drawn.number.map_or(0.0, |number| binned(edges, shares, number))
        }
    }
}

/// Density of a truncated normal law.
fn truncated_normal(mean: f64, deviation: f64, [low, high]: [f64; 2], number: f64) -> f64 {
    let Ok(normal) = Normal::new(mean, deviation) else { return 0.0 };
    normal.pdf(number) / (normal.cdf(high) - normal.cdf(low))
}

/// Density of a law that is uniform within each of several ranges.
fn binned(edges: &[f64], shares: &[f64], number: f64) -> f64 {
    let ranges = || edges.windows(2).zip(shares);
    let of = |(ends, share): (&[f64], &f64)| share / (ends[1] - ends[0]);
    // The last range holds its upper end too.
    ranges().find(|(ends, _)| number < ends[1]).or_else(|| ranges().next_back()).map_or(0.0, of)
}
