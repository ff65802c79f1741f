//! The verdict of a study about held whales, in plain sentences: how many the baseline holds, how many of them each option frees,
//! and how many more encounters would tell an option from the baseline.
//!
//! An option is distinct if the 95 % interval of its difference from the baseline in the same encounters excludes zero.
//! An option that frees the share `f` of the held whales, and newly holds the share `r`, differs from the baseline by `δ = f p` in the
//! rate of holding `p`, in `ψ = (f + 2 r) p` of the encounters. It is distinguished from the baseline with a probability of 80 % in
//!
//! ```text
//! n = (1.96 √ψ + 0.84 √(ψ - δ²))² / δ²
//! ```
//!
//! encounters of equal weight. Reference: Connor 1987 (Biometrics 43:207). For `r = 0` and `f = 0.3` this gives 2,620, 650 and 260
//! encounters at `p` of 1, 4 and 10 %; the exact McNemar test needs 2,650, 660 and 264.

use statrs::distribution::{ContinuousCDF, Normal};

use super::answer::{Asked, holm_words};
use super::held_whales::{HeldWhales, OptionOnHeld};
use super::strength_curve::{AskedStrength, StrengthCurve};
use super::{Findings, Interval, Paired, Rate, z95};
use crate::units::{N_PER_LBF, grouped};

/// Share of held whales that an option must free to be worth finding.
pub const WORTH_FINDING: f64 = 0.3;

/// Encounters of equal weight in which an option that frees a share `freed` of the held whales, and newly holds a share `newly`, is distinguished
/// from the baseline with a probability of 80 %; `held` is the rate of holding.
pub fn encounters_to_tell(held: f64, freed: f64, newly: f64) -> f64 {
    let (difference, apart) = (freed * held, (freed + 2.0 * newly) * held);
    let power = Normal::standard().inverse_cdf(0.8);
    let reach = z95() * apart.sqrt() + power * (apart - difference * difference).max(0.0).sqrt();
    (reach / difference).powi(2)
}

/// Encounters of the study's own distribution, beyond those it has, in which an option that frees [`WORTH_FINDING`] of the held whales would be
/// distinguished from the baseline; 0 if it has enough, `None` if no whale was held.
pub fn encounters_missing(held: &Rate, newly: f64) -> Option<f64> {
    if held.hits == 0 || held.effective <= 0.0 {
        return None;
    }
    let needed = encounters_to_tell(held.rate, WORTH_FINDING, newly);
    let runs = held.runs as f64;
    Some((needed * runs / held.effective - runs).max(0.0))
}

/// Share of the held whales that an option is expected to hold newly, from the newly held whales of several options. One of ten, as
/// assumed before any encounter, counts as much as ten held whales.
pub fn expected_newly(held: u64, newly: &[u64]) -> f64 {
    let count = newly.len().max(1) as f64;
    let mean = newly.iter().map(|newly| *newly as f64).sum::<f64>() / count;
    (mean + 1.0) / (held as f64 + 10.0)
}

/// An option with its comparison over all encounters.
struct Judged<'a> {
    on_held: &'a OptionOnHeld,
    paired: &'a Paired,
    adjusted: Option<f64>,
}

/// Sentences about held whales, the most important first.
pub(super) fn sentences(findings: &Findings, held: &HeldWhales, asked: &Asked<'_>) -> Vec<String> {
    let judged = findings.others().zip(&held.options).filter_map(|(option, on_held)| {
        debug_assert_eq!(option.id, on_held.id, "options in one order");
        let (paired, adjusted) = (option.against(&held.event)?, option.adjusted(&held.event));
        Some(Judged { on_held, paired, adjusted })
    });
    verdict(&held.rate, asked, judged.collect())
}

fn verdict(rate: &Rate, asked: &Asked<'_>, judged: Vec<Judged<'_>>) -> Vec<String> {
    let (distinct, open): (Vec<_>, Vec<_>) =
        judged.into_iter().partition(|option| option.paired.is_distinct());
    let differing = distinct.iter().map(|option| option.frees(asked));
    let open = (!open.is_empty()).then(|| undecided(rate, asked, &open, distinct.is_empty()));
    std::iter::once(holds(rate, asked)).chain(differing).chain(open).collect()
}

/// How many whales the baseline holds.
fn holds(rate: &Rate, asked: &Asked<'_>) -> String {
    let Asked { baseline, .. } = asked;
    let encounters = match rate.runs {
        1 => "1 valid encounter".to_owned(),
        runs => format!("{} valid encounters", thousands(runs as f64)),
    };
    let range = of_hundred(rate.interval);
    match rate.hits {
        0 => format!(
            "With {baseline}, no whale was held in {encounters}; up to {:.1} of 100 may be.",
            100.0 * rate.interval.high
        ),
        hits => format!(
            "With {baseline}, {:.1} of 100 whales are held {range}: {hits} in {encounters}.",
            100.0 * rate.rate
        ),
    }
}

/// On how many of 100 held whales whole rope of the strengths asked for parts; empty if no whale is held.
pub(super) fn of_strengths(curve: &StrengthCurve) -> Vec<String> {
    let held = curve.parts_given_held.encounters;
    let (Some(weaker), Some(strongest)) = (curve.asked.iter().rev().nth(1), curve.asked.last())
    else {
        return Vec::new();
    };
    if held == 0 {
        return Vec::new();
    }
    let at = |asked: &AskedStrength| {
        let Rate { rate, interval, .. } = asked.parts;
        format!("{:.0} {} at {}", 100.0 * rate, of_hundred(interval), lbf(asked))
    };
    let all: Vec<String> = curve.asked.iter().map(at).collect();
    let more = &weaker.parts_alone;
    let effective = curve.parts_given_held.effective;
    vec![
        format!("Of 100 whales held if nothing parts, rope parts on {}.", all.join(", ")),
        format!(
            "Rope of {} parts on {:.0} {} more of 100 than rope of {}.",
            lbf(weaker),
            100.0 * more.rate,
            of_hundred(more.interval),
            lbf(strongest)
        ),
        format!(
            "The {held} held whales count as {effective:.0} of equal weight; about {:.0} are needed for a share within ±10 points, and about {:.0} for ±5.",
            whales_for_band(0.1),
            whales_for_band(0.05)
        ),
    ]
}

/// Held whales of equal weight from which a share of [`WORTH_FINDING`] is known to a half-width: `n = p (1 - p) (1.96 / d)²`.
pub fn whales_for_band(half_width: f64) -> f64 {
    WORTH_FINDING * (1.0 - WORTH_FINDING) * (z95() / half_width).powi(2)
}

fn lbf(asked: &AskedStrength) -> String {
    format!("{} lbf", thousands(asked.strength_n / N_PER_LBF))
}

impl Judged<'_> {
    /// How many whales a distinct option frees, or that it holds more.
    fn frees(&self, asked: &Asked<'_>) -> String {
        let OptionOnHeld { name, freed, newly_held_share, newly_held, .. } = self.on_held;
        let Asked { baseline, comparisons, .. } = asked;
        let among = holm_words(self.adjusted, *comparisons);
        let others = match (newly_held, 100.0 * newly_held_share) {
            (0, _) => String::new(),
            (_, share) => format!(" and holds {share:.0} others"),
        };
        if self.paired.difference > 0.0 {
            return format!(
                "For 100 whales held with {baseline}, {name} frees {:.0} and holds {:.0} others{among}.",
                100.0 * freed.rate,
                100.0 * newly_held_share
            );
        }
        format!(
            "Of 100 whales held with {baseline}, {name} frees {:.0} {}{others}{among}.",
            100.0 * freed.rate,
            of_hundred(freed.interval)
        )
    }
}

/// What the study cannot tell, and how many more encounters would.
fn undecided(rate: &Rate, asked: &Asked<'_>, open: &[Judged<'_>], all: bool) -> String {
    let Asked { baseline, .. } = asked;
    let options = match open {
        [one] => one.on_held.name.clone(),
        [_, _] if all => "either of the 2 options".to_owned(),
        several if all => format!("any of the {} options", several.len()),
        several => format!("the other {} options", several.len()),
    };
    let most = open.iter().map(|option| option.on_held.freed.interval.high).fold(0.0, f64::max);
    let newly: Vec<u64> = open.iter().map(|option| option.on_held.newly_held).collect();
    let newly = expected_newly(rate.hits, &newly);
    let head = format!("This study cannot tell {options} from {baseline}");
    let worth = 100.0 * WORTH_FINDING;
    match encounters_missing(rate, newly) {
        None => {
            let least = encounters_to_tell(rate.interval.high, WORTH_FINDING, 0.0);
            let more = rounded((least - rate.effective).max(1.0));
            format!(
                "{head}: no whale was held. At least {more} more encounters would show an option that frees {worth:.0} of 100."
            )
        }
        Some(missing) if missing >= 1.0 => format!(
            "{head}: of 100 held whales up to {:.0} may be freed. About {} more encounters would show an option that frees {worth:.0}.",
            100.0 * most,
            rounded(missing)
        ),
        Some(_) => format!(
            "{head}: of 100 held whales up to {:.0} may be freed. It has enough encounters to show an option that frees {worth:.0}.",
            100.0 * most
        ),
    }
}

/// `[22, 47]`, of 100; with a decimal where both ends are below 10.
fn of_hundred(interval: Interval) -> String {
    let [low, high] = [interval.low, interval.high].map(|end| 100.0 * end);
    let decimals = usize::from(high < 10.0);
    format!("[{low:.decimals$}, {high:.decimals$}]")
}

/// A number with two significant digits, such as `2,600`.
pub fn rounded(number: f64) -> String {
    let unit = 10.0_f64.powf((number.max(1.0).log10().floor() - 1.0).max(0.0));
    thousands((number / unit).ceil() * unit)
}

/// A whole number with commas between thousands.
fn thousands(number: f64) -> String {
    grouped(&format!("{number:.0}"))
}

#[cfg(test)]
mod tests {
    use super::super::held_whales::Weighted;
    use super::super::{Banded, EventIndicators};
    use super::*;

    /// The exact McNemar test needs 2,650, 660 and 264 encounters for 30 % fewer held whales.
    #[test]
    fn numbers_of_encounters_agree_with_the_exact_test() {
        for (held, exact) in [(0.01, 2650.0), (0.04, 660.0), (0.10, 264.0)] {
            let needed = encounters_to_tell(held, 0.3, 0.0);
            assert!((needed / exact - 1.0).abs() < 0.02, "{held}: {needed}");
        }
    }

    /// 40 held whales: rope of 600 lbf parts on 30, of 1,700 lbf on 12, of 2,600 lbf on 4.
    #[test]
    fn strengths_are_compared_in_counts_of_held_whales() {
        let at = |lbf: f64, parts: u64| AskedStrength {
            strength_n: lbf * N_PER_LBF,
            parts: Rate::from_counts(parts, 40),
            parts_alone: Rate::from_counts(parts - 4, 40),
            weighted: None,
        };
        let held = |encounters: u64| Banded {
            encounters,
            effective: 25.0,
            half_width: 0.2,
            shares: Vec::new(),
        };
        let curve = |encounters: u64| StrengthCurve {
            part: "whole rope".into(),
            option: "unbreakable".into(),
            parts: held(100),
            parts_given_held: held(encounters),
            held: Vec::new(),
            strengths_n: Vec::new(),
            asked: vec![at(600.0, 30), at(1700.0, 12), at(2600.0, 4)],
            by_route: Vec::new(),
            by_input: Vec::new(),
        };
        let found = of_strengths(&curve(40));
        assert!(found[0].contains("parts on 75 [60, 86] at 600 lbf, 30 ["), "{found:?}");
        assert!(found[1].starts_with("Rope of 1,700 lbf parts on 20 ["), "{found:?}");
        assert!(found[2].starts_with("The 40 held whales count as 25 of"), "{found:?}");
        assert!(found[2].contains("about 81 are") && found[2].contains("323 for"), "{found:?}");
        assert!(of_strengths(&curve(0)).is_empty());
    }

    fn asked(encounters: u64) -> Asked<'static> {
        Asked { event: "held".into(), baseline: "Rope 2,600 lbf", encounters, comparisons: 1 }
    }

    /// An option that frees the first of the whales held with the baseline.
    fn case(encounters: u64, held: u64, freed: u64) -> (Rate, OptionOnHeld, Paired) {
        let baseline = EventIndicators::even((0..encounters).map(|n| Some(n < held)));
        let option = EventIndicators::even((0..encounters).map(|n| Some(n < held && n >= freed)));
        let on_held = OptionOnHeld {
            id: "weak".into(),
            name: "rope 1,700 lbf".into(),
            freed: Rate::from_counts(freed, held),
            newly_held: 0,
            newly_held_share: 0.0,
            freed_by_route: Vec::new(),
            weighted: None::<Weighted>,
        };
        (Rate::of(&baseline), on_held, Paired::of(&option, &baseline))
    }

    fn verdict_of(encounters: u64, held: u64, freed: u64) -> Vec<String> {
        let (rate, on_held, paired) = case(encounters, held, freed);
        let judged = Judged { on_held: &on_held, paired: &paired, adjusted: Some(0.001) };
        verdict(&rate, &asked(encounters), vec![judged])
    }

    #[test]
    fn an_option_that_differs_is_stated_in_counts_of_a_hundred() {
        let said = verdict_of(1000, 50, 17);
        assert_eq!(
            said,
            [
                "With Rope 2,600 lbf, 5.0 of 100 whales are held [3.8, 6.5]: 50 in 1,000 valid encounters.",
                "Of 100 whales held with Rope 2,600 lbf, rope 1,700 lbf frees 34 [22, 48].",
            ]
        );
    }

    #[test]
    fn a_small_study_says_how_many_more_encounters_it_needs() {
        let said = verdict_of(100, 4, 0);
        assert_eq!(
            said[0],
            "With Rope 2,600 lbf, 4.0 of 100 whales are held [1.6, 9.8]: 4 in 100 valid encounters."
        );
        assert_eq!(
            said[1],
            "This study cannot tell rope 1,700 lbf from Rope 2,600 lbf: of 100 held whales up to 49 may be freed. \
             About 870 more encounters would show an option that frees 30."
        );
        let none = verdict_of(30, 0, 0);
        assert!(
            none[0].starts_with("With Rope 2,600 lbf, no whale was held in 30 valid encounters"),
            "{none:?}"
        );
        assert!(none[1].contains("no whale was held. At least "), "{none:?}");
        let enough = verdict_of(5000, 500, 0);
        assert!(
            enough[1].ends_with("It has enough encounters to show an option that frees 30."),
            "{enough:?}"
        );
    }

    #[test]
    fn numbers_are_rounded_up_to_two_digits() {
        assert_eq!([7.2, 123.0, 1201.0, 26_400.0].map(rounded), ["8", "130", "1,300", "27,000"]);
    }
}
