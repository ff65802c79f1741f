//! Threat by traps of a trawl: the mean over the breaking strengths of its lines, and its change by a cap on strength.
//!
//! With the share `f_j` of lines of strength `S_j`, the mean threat is `Σ f_j P(S_j)`. With a cap, each stronger line has the strength of the
//! cap, as in the tool's action `MaxRopeStrength`. The change is the mean with the cap over the mean without it, less 1. Lines outside the
//! simulated strengths count with the rate at the nearest one.

use schemars::JsonSchema;
use serde::Serialize;

use super::by_strength::SimulatedCurve;
use super::interpolation::combined;
use super::noaa::{LineStrengthTable, StrengthThreatTable, ThreatRange, TrawlLines};

/// The mean threat of the lines of a trawl.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct TrawlThreat {
    /// Traps of the trawl.
    pub traps: u64,
    /// Mean breaking strength of its lines in NOAA's distribution [lbf].
    pub mean_strength_lbf: f64,
    /// Share of its lines weaker than the least simulated strength; they count with the rate at that strength.
    pub weaker_share: f64,
    /// Share of its lines stronger than the greatest simulated strength; they count with the rate at that strength.
    pub stronger_share: f64,
    /// Mean simulated threat, with the means of the ends of its intervals of 95 %.
    pub simulated: ThreatRange,
    /// Mean of NOAA's threat, with the bounds of the means of its three curves.
    pub noaa: ThreatRange,
    /// With the cap; none if no cap was given.
    pub capped: Option<CappedTrawl>,
}

/// The mean threat of the lines of a trawl with a cap on strength.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct CappedTrawl {
    /// Mean simulated threat, with the means of the ends of its intervals of 95 %.
    pub simulated: ThreatRange,
    /// Mean of NOAA's threat, with the bounds of the means of its three curves.
    pub noaa: ThreatRange,
    /// Change of the simulated threat, -1 to 0 for a fall, with its interval of 95 % by chance; none where the event never occurs.
    pub simulated_change: Option<ThreatRange>,
    /// Change of NOAA's threat, with the bounds of the changes of its three curves, each by itself.
    pub noaa_change: ThreatRange,
}

/// The mean threats of all trawls of a distribution, with a cap [lbf] or without.
pub(super) fn of_trawls(
    simulated: &SimulatedCurve,
    noaa: &StrengthThreatTable,
    lines: &LineStrengthTable,
    cap_lbf: Option<f64>,
) -> Vec<TrawlThreat> {
    lines.trawls.iter().map(|trawl| of_trawl(simulated, noaa, trawl, cap_lbf)).collect()
}

fn of_trawl(
    simulated: &SimulatedCurve,
    noaa: &StrengthThreatTable,
    trawl: &TrawlLines,
    cap_lbf: Option<f64>,
) -> TrawlThreat {
    let strengths = &simulated.strengths;
    let free = strengths.of_lines(&trawl.lines, None);
    let noaa_free = noaa.of_lines(&trawl.lines, None);
    let capped = cap_lbf.map(|cap_lbf| {
        let capped = strengths.of_lines(&trawl.lines, Some(cap_lbf));
        let noaa_capped = noaa.of_lines(&trawl.lines, Some(cap_lbf));
        let less_one = |ratio: ThreatRange| ThreatRange {
            threat: ratio.threat - 1.0,
            lower: ratio.lower - 1.0,
            upper: ratio.upper - 1.0,
        };
        let change = |curve: usize| {
            let free = noaa_free[curve];
            if free > 0.0 { noaa_capped[curve] / free - 1.0 } else { 0.0 }
        };
        CappedTrawl {
            simulated: simulated.range(&capped),
            noaa: ThreatRange::of_curves(noaa_capped),
            simulated_change: simulated.ratio(&capped, &free).map(less_one),
            noaa_change: ThreatRange::of_curves([0, 1, 2].map(change)),
        }
    });
    TrawlThreat {
        traps: trawl.traps,
        mean_strength_lbf: trawl.mean_strength_lbf(),
        weaker_share: trawl.share_of(|strength_lbf| strength_lbf < strengths.least()),
        stronger_share: trawl.share_of(|strength_lbf| strength_lbf > strengths.greatest()),
        simulated: simulated.range(&free),
        noaa: ThreatRange::of_curves(noaa_free),
        capped,
    }
}

/// The ratio of two weighted means over the same encounters, with its interval of 95 %; none where the other mean is 0.
///
/// With the share `w` of the weight, and values `z` and `y` from 0 to 1 of each encounter, the ratio is `Z/Y = Σ w z / Σ w y`. Its interval is
/// that of `paired.rs`, extended to values between 0 and 1: with the effective numbers of events `A = Z²/Σ (w z)²` and `B = Y²/Σ (w y)²`,
/// the middle is `(Z/Y) (1 + 1/2A)/(1 + 1/2B)`, and its logarithm has the variance `(A B Σ w² (z/Z - y/Y)² + 1)/((A + 1/2)(B + 1/2))`.
/// The 1 allows for one encounter that decides otherwise and has not been drawn. `z95` is the normal quantile of the interval.
pub(super) fn ratio_of(values: &[([f64; 2], f64)], z95: f64) -> Option<ThreatRange> {
    let all: f64 = values.iter().map(|(_, weight)| weight).sum();
    let sum = |of: &dyn Fn([f64; 2], f64) -> f64| -> f64 {
        values.iter().map(|(pair, weight)| of(*pair, weight / all)).sum()
    };
    let mean = [0, 1].map(|side: usize| sum(&|pair, share| share * pair[side]));
    if mean[1] <= 0.0 {
        return None;
    }
    let events = [0, 1].map(|side: usize| {
        let squares = sum(&|pair, share| share * share * pair[side] * pair[side]);
        if squares > 0.0 { mean[side] * mean[side] / squares } else { 0.0 }
    });
    let ratio = mean[0] / mean[1];
    let halves = (events[0] + 0.5) * (events[1] + 0.5);
    if mean[0] <= 0.0 {
        // As for counts: the other has `B` events, and none of them with this one.
        let deviation = ((events[1] + 1.0) / halves).sqrt();
        let upper = 0.5 / (events[1] + 0.5) * (z95 * deviation).exp();
        return Some(ThreatRange { threat: 0.0, lower: 0.0, upper });
    }
    let variance = sum(&|[z, y], share| {
        let part = share * (z / mean[0] - y / mean[1]);
        part * part
    });
    let deviation = ((events[0] * events[1] * variance + 1.0) / halves).sqrt();
    let middle = ratio * (1.0 + 0.5 / events[0]) / (1.0 + 0.5 / events[1]);
    let factor = (z95 * deviation).exp();
    Some(ThreatRange { threat: ratio, lower: middle / factor, upper: middle * factor })
}

impl SimulatedCurve {
    /// The mean threat with given coefficients of the simulated strengths, and the means of the ends of the intervals.
    pub(super) fn range(&self, coefficients: &[f64]) -> ThreatRange {
        let rates = || self.options.iter().map(|option| option.rate);
        ThreatRange {
            threat: combined(coefficients, rates().map(|rate| rate.rate)),
            lower: combined(coefficients, rates().map(|rate| rate.interval.low)),
            upper: combined(coefficients, rates().map(|rate| rate.interval.high)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_strength::tests::curve;
    use super::super::noaa::LineShare;
    use super::super::noaa::tests::{lines, threats};
    use super::*;
    use crate::study::stats::{EventIndicators, Paired, z95};

    /// For events that occur or not, the ratio is that of two paired options, which has tests of its own.
    #[test]
    fn the_ratio_of_counts_is_that_of_paired_options() {
        for [both, only_this, only_other] in [[10, 2, 5], [7, 0, 0], [0, 0, 6], [3, 4, 0]] {
            let total = 200;
            let kind = |index: usize| {
                let this = index < both + only_this;
                let other = index < both
                    || (both + only_this..both + only_this + only_other).contains(&index);
                [this, other]
            };
            let side = |side: usize| {
                EventIndicators::even((0..total).map(|index| Some(kind(index)[side])))
            };
            let expected = Paired::of(&side(0), &side(1));
            let values: Vec<([f64; 2], f64)> =
                (0..total).map(|index| (kind(index).map(f64::from), 1.0)).collect();
            let found = ratio_of(&values, z95()).unwrap();
            let interval = expected.ratio_interval.unwrap();
            for (one, other) in [
                (found.threat, expected.ratio.unwrap()),
                (found.lower, interval.low),
                (found.upper, interval.high),
            ] {
                assert!((one - other).abs() < 1e-9, "{both} {only_this}: {found:?}, {expected:?}");
            }
        }
        assert_eq!(ratio_of(&[([0.0, 0.0], 1.0)], z95()), None);
    }

    /// Rates 0.1 at 1,000 lbf and 0.4 at 3,000 lbf. Half of the lines at 1,500 lbf (0.175), half at 4,000 lbf (0.4): 0.2875. With a cap of
    /// 1,000 lbf 0.1, a change of 0.1/0.2875 - 1.
    #[test]
    fn the_mean_over_lines_and_its_change_by_a_cap_are_those_by_hand() {
        let simulated = curve(&[(1000.0, 10), (3000.0, 40)], 100);
        let line = |strength_lbf: f64| LineShare { strength_lbf, share: 0.5 };
        let trawl = TrawlLines { traps: 20, lines: vec![line(1500.0), line(4000.0)] };
        let found = of_trawl(&simulated, &threats(), &trawl, Some(1000.0));
        assert!((found.simulated.threat - 0.2875).abs() < 1e-12, "{found:?}");
        assert!((found.stronger_share - 0.5).abs() < 1e-12 && found.weaker_share == 0.0);
        let capped = found.capped.unwrap();
        assert!((capped.simulated.threat - 0.1).abs() < 1e-12);
        let change = capped.simulated_change.unwrap();
        assert!((change.threat - (0.1 / 0.2875 - 1.0)).abs() < 1e-12, "{change:?}");
        assert!(change.lower < change.threat && change.threat < change.upper && change.upper < 0.0);
        // NOAA's: 0.06310 and 0.21703 at the two strengths, 0.04843 at the cap.
        let noaa = 0.5 * (0.063_10 + threats().at(4000.0)[0]);
        assert!((found.noaa.threat - noaa).abs() < 1e-12);
        assert!((capped.noaa_change.threat - (0.048_43 / noaa - 1.0)).abs() < 1e-12);
    }

    /// NOAA's change by a cap of 1,700 lbf, computed from the two files apart from this program.
    #[test]
    fn noaas_change_by_the_cap_of_the_rule_is_that_of_its_own_tables() {
        let simulated = curve(&[(600.0, 10), (5200.0, 40)], 100);
        let found = of_trawls(&simulated, &threats(), &lines(), Some(1700.0));
        for (traps, change, lower, upper, stronger) in [
            (1, -0.244, -0.423, -0.030, 0.0),
            (10, -0.377, -0.604, -0.052, 0.0),
            (20, -0.546, -0.783, -0.088, 0.0467),
            (45, -0.823, -0.953, -0.217, 0.5021),
        ] {
            let trawl = found.iter().find(|trawl| trawl.traps == traps).unwrap();
            let noaa = trawl.capped.as_ref().unwrap().noaa_change;
            for (one, other) in [
                (noaa.threat, change),
                (noaa.lower, lower),
                (noaa.upper, upper),
                (trawl.stronger_share, stronger),
            ] {
                assert!((one - other).abs() < 6e-4, "{traps} traps: {trawl:?}");
            }
        }
    }
}
