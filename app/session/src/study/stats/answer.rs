//! The answer of a study about an event, in sentences, for the head of its report and of the panel *Results*. About whales that are held
//! it is in counts of whales (`verdict.rs`).
//!
//! A second list of sentences reports how often segments near the whale were longer than requested, and what this does to the rates.
//! A last one counts the observations of real whales with which the study agrees.
//!
//! An option differs from the baseline if the 95 % interval of their difference in the same encounters excludes zero. If
//! several registered comparisons are made, Holm's probability is beside it.
//!
//! A difference `d` is detected with a probability of 80 % from `n = (1.96 + 0.84)² s / d²` encounters, `s` being the share of them that come
//! out otherwise (Connor 1987, Biometrics 43:207, for small `d`): 314 for 5 points where one encounter in ten does.

use endline_gear::StudyEvent;

use super::{Agreement, Findings, Paired, ResolutionChecks, exposure, verdict};

/// Encounters below which a study is called small.
const SMALL: u64 = 314;

/// The question.
pub(super) struct Asked<'a> {
    /// The event in words.
    pub event: String,
    /// Name of the baseline.
    pub baseline: &'a str,
    /// Encounters in the table.
    pub encounters: u64,
    /// Registered comparisons.
    pub comparisons: u64,
}

/// An option beside the baseline.
struct Compared<'a> {
    name: &'a str,
    paired: &'a Paired,
    /// Holm's probability of a registered comparison.
    adjusted: Option<f64>,
}

/// Sentences that answer the question of an event, by its name, the most important first.
pub fn answer(findings: &Findings, event: &str) -> Vec<String> {
    // Shares of tracks depend on their length; rates by distance do not.
    if !findings.exposure.is_empty() {
        return exposure::sentences(&findings.exposure, findings.baseline, event);
    }
    let words = StudyEvent::find(event).map_or_else(|| event.to_owned(), |event| event.words());
    let asked = Asked {
        event: words,
        baseline: &findings.options[findings.baseline].name,
        encounters: findings.encounters,
        comparisons: findings.comparisons,
    };
    if let Some(held) = findings.held_whales.as_ref().filter(|held| held.event == event) {
        let mut all = verdict::sentences(findings, held, &asked);
        let whole_rope = findings.strength_curves.iter().find(|curve| curve.is_of_rope());
        let of_strengths = whole_rope.map(verdict::of_strengths).unwrap_or_default();
        all.splice(1..1, of_strengths);
        return all;
    }
    let compared = findings.others().filter_map(|option| {
        let adjusted = option.adjusted(event);
        Some(Compared { name: &option.name, paired: option.against(event)?, adjusted })
    });
    sentences(&asked, compared.collect())
}

fn sentences(asked: &Asked<'_>, compared: Vec<Compared<'_>>) -> Vec<String> {
    if compared.is_empty() {
        return Vec::new();
    }
    let (distinct, open): (Vec<_>, Vec<_>) =
        compared.into_iter().partition(|option| option.paired.is_distinct());
    let nothing = distinct.is_empty().then(|| {
        let Asked { event, baseline, encounters, .. } = asked;
        match encounters {
            1 => format!("In 1 encounter, no option differs from {baseline} in “{event}”."),
            _ => {
                format!(
                    "In {encounters} encounters, no option differs from {baseline} in “{event}” by more than chance."
                )
            }
        }
    });
    let apart = distinct.iter().map(|option| option.apart(asked));
    nothing
        .into_iter()
        .chain(apart)
        .chain(undecided(&open, &distinct))
        .chain(small(asked))
        .collect()
}

impl Compared<'_> {
    /// Greatest difference within the interval [points].
    fn reach(&self) -> f64 {
        let interval = self.paired.difference_interval;
        100.0 * interval.low.abs().max(interval.high.abs())
    }

    /// That it has more or less of the event than the baseline, and how surely.
    fn apart(&self, asked: &Asked<'_>) -> String {
        let Paired { difference, difference_interval, .. } = self.paired;
        let way = if *difference < 0.0 { "rarer" } else { "more frequent" };
        let [low, high] =
            [difference_interval.low, difference_interval.high].map(|side| 100.0 * side);
        let Asked { event, baseline, comparisons, .. } = asked;
        let among = holm_words(self.adjusted, *comparisons);
        format!(
            "With {}, “{event}” is {way} than with {baseline} by {:.1} points [{low:.1}, {high:.1}]{among}.",
            self.name,
            100.0 * difference.abs()
        )
    }
}

/// What the number of comparisons means for one of them, by Holm's probability; none was registered if that is absent.
pub(super) fn holm_words(adjusted: Option<f64>, comparisons: u64) -> String {
    match adjusted {
        Some(p) if comparisons > 1 && p > 0.05 => format!(
            "; among {comparisons} registered comparisons this may be chance (p = {p:.2} by Holm)"
        ),
        Some(p) if comparisons > 1 => {
            let p = if p < 0.001 { "p < 0.001".to_owned() } else { format!("p = {p:.3}") };
            format!("; {p} among {comparisons} registered comparisons")
        }
        Some(_) => String::new(),
        None => "; this comparison was not registered beforehand".to_owned(),
    }
}

/// How large a difference may be that was not seen.
fn undecided(open: &[Compared<'_>], distinct: &[Compared<'_>]) -> Option<String> {
    if open.is_empty() {
        return None;
    }
    let same = |option: &&Compared<'_>| option.paired.only_this + option.paired.only_other == 0;
    let same = open.iter().filter(same).count();
    let most = open.iter().map(Compared::reach).fold(0.0, f64::max);
    let rest = if distinct.is_empty() { "" } else { "other " };
    let options = match open {
        [one] => one.name.to_owned(),
        several => format!("The {} {rest}options", several.len()),
    };
    let same = match same {
        0 => String::new(),
        all if all == open.len() => " All these encounters have the same result.".to_owned(),
        some => format!(" With {some} of them, all encounters have the same result."),
    };
    let of_it = if distinct.is_empty() { "it" } else { "the baseline" };
    Some(format!("{options} may differ from {of_it} by up to {most:.0} points.{same}"))
}

/// That there are few encounters.
fn small(asked: &Asked<'_>) -> Option<String> {
    (asked.encounters < SMALL).then(|| {
        let few = match asked.encounters {
            1 => "1 encounter is".to_owned(),
            count => format!("{count} encounters are"),
        };
        format!(
            "{few} few: a difference of 5 points is detected with a probability of 80 % from {SMALL}, if one encounter in ten has another result."
        )
    })
}

/// Difference of the shares of missed checks from the baseline's that is reported; estimate.
const COARSER: f64 = 0.1;

/// How often segments near the whale were longer than requested, and what this does to the rates, in sentences.
pub fn resolution(findings: &Findings) -> Vec<String> {
    let checks: Vec<(&str, ResolutionChecks)> =
        findings.options.iter().map(|option| (option.name.as_str(), option.resolution)).collect();
    let Some(share) = shares_in_words(&checks) else {
        return vec![
            "The scenario requests no length of segments near the whale, so that none was checked."
                .to_owned(),
        ];
    };
    let coarser = coarser(&checks, findings.baseline);
    std::iter::once(share).chain(effects(findings)).chain(coarser).collect()
}

/// How the study's shares compare with what was observed on real whales; `None` without an observation that tests anything.
pub fn observed(findings: &Findings) -> Option<String> {
    let with = |wanted: Agreement| {
        let all = findings.observations.iter().filter(move |seen| seen.agreement == wanted);
        all.map(|seen| seen.id.as_str()).collect::<Vec<_>>()
    };
    let [agreed, missed, open] = [Agreement::Agrees, Agreement::Misses, Agreement::Open].map(with);
    let all = agreed.len() + missed.len() + open.len();
    let named = |ids: &[&str]| match ids {
        [] => "none".to_owned(),
        ids => format!("{} ({})", ids.len(), ids.join(", ")),
    };
    (all > 0).then(|| {
        format!(
            "Of {all} observations of real whales, this study agrees with {}, misses {} and does not settle {}.",
            named(&agreed),
            named(&missed),
            if open.is_empty() { "none".to_owned() } else { open.len().to_string() }
        )
    })
}

/// The share of missed checks over all options, with the least and the greatest of one; `None` without a check.
fn shares_in_words(checks: &[(&str, ResolutionChecks)]) -> Option<String> {
    let sum = |of: fn(&ResolutionChecks) -> u64| checks.iter().map(|(_, own)| of(own)).sum();
    let all = ResolutionChecks { all: sum(|own| own.all), missed: sum(|own| own.missed) };
    let share = 100.0 * all.share()?;
    let shares = || checks.iter().filter_map(|(_, own)| own.share());
    let (least, most) =
        (100.0 * shares().fold(1.0, f64::min), 100.0 * shares().fold(0.0, f64::max));
    Some(format!(
        "In {share:.1} % of the checks of segments near the whale, one was longer than requested by a quarter or more; by option {least:.1} to {most:.1} %."
    ))
}

/// The effect of finer segments on the rates of registered events with the baseline.
fn effects(findings: &Findings) -> impl Iterator<Item = String> {
    let baseline = &findings.options[findings.baseline].id;
    findings.bands.iter().filter(move |bands| bands.option == *baseline).map(|bands| {
        let event = StudyEvent::find(&bands.event).map_or_else(|| bands.event.clone(), |event| event.words());
        match &bands.segments {
            Some(band) => format!(
                "With finer segments and steps, “{event}” is {:.2} times as frequent [{:.2}, {:.2}] ({}).",
                band.ratio, band.ratio_interval.low, band.ratio_interval.high, band.source
            ),
            None => format!(
                "What this does to the rate of “{event}” is not known: the study names no [[discretisation]] for it."
            ),
        }
    })
}

/// That some options meet the requested lengths less often than the baseline.
fn coarser(checks: &[(&str, ResolutionChecks)], baseline: usize) -> Option<String> {
    let own = checks[baseline].1.share()?;
    let more = |(name, checks): &(&str, ResolutionChecks)| {
        let more = checks.share()? - own;
        (more >= COARSER).then(|| format!("{name} (by {:.0} points)", 100.0 * more))
    };
    let names: Vec<String> = checks.iter().filter_map(more).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Segments near the whale are too long more often than with the baseline in: {}. Part of their difference of rates may come from this.",
            names.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::{EventIndicator, EventIndicators};
    use super::*;

    /// Indicators of encounters in which the event occurred or did not.
    fn indicators(occurred: impl Iterator<Item = bool>) -> EventIndicators {
        EventIndicators(
            occurred.map(|occurred| Some(EventIndicator { occurred, weight: 1.0 })).collect(),
        )
    }

    fn asked(encounters: u64, comparisons: u64) -> Asked<'static> {
        Asked { event: "held".to_owned(), baseline: "as today", encounters, comparisons }
    }

    fn compared(paired: &Paired, adjusted: Option<f64>) -> Compared<'_> {
        Compared { name: "weak", paired, adjusted }
    }

    #[test]
    fn encounters_that_all_end_alike_decide_nothing_and_say_how_much_may_hide() {
        let all = || indicators((0..8).map(|number| number < 2));
        let paired = Paired::of(&all(), &all());
        let answer = sentences(&asked(8, 1), vec![compared(&paired, Some(1.0))]);
        assert_eq!(
            answer[0],
            "In 8 encounters, no option differs from as today in “held” by more than chance."
        );
        let points = 100.0 * paired.difference_interval.high;
        assert!((20.0..40.0).contains(&points), "Wilson's upper bound of 0 in 8 is 32 %");
        let hidden = format!("weak may differ from it by up to {points:.0} points.");
        assert!(answer[1].starts_with(&hidden), "{}", answer[1]);
        assert!(answer[1].ends_with("All these encounters have the same result."), "{}", answer[1]);
        assert!(answer[2].starts_with("8 encounters are few"));
        assert_eq!(answer.len(), 3);
    }

    /// 30 of 300 checks missed: 1 of 100 with the first option, 28 with the second, 1 with the third.
    #[test]
    fn missed_lengths_are_reported_with_the_options_that_miss_them_more_often() {
        let checks = [("whole", 1), ("inserts", 28), ("link", 1)]
            .map(|(name, missed)| (name, ResolutionChecks { all: 100, missed }));
        let words = shares_in_words(&checks).unwrap();
        assert!(words.starts_with("In 10.0 % of the checks"), "{words}");
        assert!(words.ends_with("by option 1.0 to 28.0 %."), "{words}");
        let coarse = coarser(&checks, 0).unwrap();
        assert!(coarse.contains("in: inserts (by 27 points). Part"), "{coarse}");
        assert_eq!(coarser(&checks, 1), None, "the others miss them less often");
        assert_eq!(shares_in_words(&[("whole", ResolutionChecks::default())]), None);
    }

    #[test]
    fn an_option_that_differs_comes_first_with_its_interval() {
        // Of 400 encounters 100 are held with the baseline, 60 of these with the option.
        let (this, other) =
            (indicators((0..400).map(|n| n < 60)), indicators((0..400).map(|n| n < 100)));
        let paired = Paired::of(&this, &other);
        let answer = sentences(&asked(400, 3), vec![compared(&paired, Some(0.000_1))]);
        assert_eq!(answer.len(), 1, "{answer:?}");
        assert!(
            answer[0].starts_with("With weak, “held” is rarer than with as today by 10.0 points [")
        );
        assert!(
            answer[0].ends_with("; p < 0.001 among 3 registered comparisons."),
            "{}",
            answer[0]
        );
        let by_chance = sentences(&asked(400, 30), vec![compared(&paired, Some(0.2))]);
        assert!(by_chance[0].contains("this may be chance (p = 0.20 by Holm)"), "{}", by_chance[0]);
        let unregistered = sentences(&asked(400, 3), vec![compared(&paired, None)]);
        assert!(unregistered[0].contains("not registered beforehand"));
    }
}
