//! The values that a law can give, compared between a prior and its proposal.
//!
//! Importance sampling draws from a proposal and weights by the prior's density over the proposal's.
//! Wherever the prior may lie the proposal must be able to draw, and nowhere else: both laws then have the same values.

use crate::diagnostic::Place;
use crate::fields::Problems;

use super::law::Law;

impl Law {
    /// Least and greatest number; none for a choice.
    #[must_use]
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Uniform { low, high, .. } | Self::Normal { low, high, .. } => Some([*low, *high]),
            Self::Bins { edges, .. } => Some([*edges.first()?, *edges.last()?]),
            Self::Choice(_) => None,
        }
    }

    /// Texts of the levels of a choice that can be drawn, in order; none of another law.
    fn levels(&self) -> Vec<&str> {
        let Self::Choice(levels) = self else { return Vec::new() };
        let drawn = levels.iter().filter(|(_, weight)| *weight > 0.0);
        drawn.map(|(level, _)| level.text.as_str()).collect()
    }

    /// Ranges within a law's ends that it never draws.
    fn gaps(&self) -> Vec<[f64; 2]> {
        let Self::Bins { edges, shares, .. } = self else { return Vec::new() };
        let empty = edges.windows(2).zip(shares).filter(|(_, share)| **share <= 0.0);
        empty.map(|(ends, _)| [ends[0], ends[1]]).collect()
    }
}

/// Whether a proposal draws the values of a prior and no others; if not, the problem is told.
pub(super) fn check_same(prior: &Law, proposal: &Law, place: &Place, problems: &Problems) -> bool {
    let problem = match (prior.ends(), proposal.ends()) {
        (Some(own), Some(other)) => differing_ranges(prior, proposal, own, other),
        (None, None) => (prior.levels() != proposal.levels()).then(|| {
            format!(
                "the proposal draws {} where the prior has {}",
                proposal.levels().join(", "),
                prior.levels().join(", ")
            )
        }),
        _ => Some("the proposal draws numbers of a range where the prior has a choice, or the other way round".into()),
    };
    let same = problem.is_none();
    if let Some(problem) = problem {
        problems.push(place.error(
            problem,
            "a proposal has the values of its prior, each with a share above zero: change the shares alone",
        ));
    }
    same
}

fn differing_ranges(prior: &Law, proposal: &Law, own: [f64; 2], other: [f64; 2]) -> Option<String> {
    let width = own[1] - own[0];
    let far = |one: f64, other: f64| (one - other).abs() > 1e-9 * width;
    if far(own[0], other[0]) || far(own[1], other[1]) {
        return Some(format!(
            "the proposal reaches from {} to {}, the prior from {} to {} (SI units)",
            other[0], other[1], own[0], own[1]
        ));
    }
    let differ = prior.gaps() != proposal.gaps();
    differ.then(|| "the proposal and the prior leave out different ranges".to_owned())
}
