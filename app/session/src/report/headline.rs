//! The headline of a run: its result in a few plain sentences, for people who read nothing else.

use endline_gear::{StrengthBudget, WEAK_PLACES};
use endline_sim::metrics::{HOOKED_TURNS, Outcome, Summary, WhaleSummary};
use endline_sim::{Audit, Model};

use super::greatest;
use super::needed::needed_of;
use super::validity::percent;

/// Greatest number of parts named as parted.
const NAMED: usize = 2;

/// Purpose of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// The result.
    Result,
    /// Rope segments near the whale were longer than requested.
    Coarse,
    /// The whale does not feel the gear.
    Kinematic,
    /// A reason not to use it.
    Invalid,
}

/// A sentence of a headline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sentence {
    /// Its text.
    pub text: String,
    /// Its purpose.
    pub tone: Tone,
}

/// Load of the part that is nearest to its strength.
#[derive(Clone, Debug, PartialEq)]
struct Load {
    /// The part in words, such as `rope of endline-top`.
    part: String,
    /// Greatest tension over strength.
    share: f64,
}

/// The result of a run in numbers, from which the sentences are made.
#[derive(Clone, Debug, PartialEq)]
pub struct Headline<'a> {
    whale: Option<&'a WhaleSummary>,
    time_s: f64,
    /// Line with the greatest tension: id, tension [N], time [s].
    peak: Option<(&'a str, f64, f64)>,
    /// Part nearest to its strength; `None` if nothing can part.
    load: Option<Load>,
    /// Parts that parted, with the time [s], in the order of time.
    parted: Vec<(String, f64)>,
    /// Share of the checks of segment lengths near the whale that found too long ones, their greatest length over the requested one, and
    /// the number of rope nodes; `None` if none was too long.
    coarse: Option<(f64, f64, usize)>,
    invalid_because: &'a [String],
}

impl<'a> Headline<'a> {
    /// The headline of a run of a model so far.
    pub fn of(
        model: &Model,
        summary: &'a Summary,
        budgets: &[StrengthBudget],
        audit: &Audit,
        invalid_because: &'a [String],
        time_s: f64,
    ) -> Self {
        let missed = audit.resolution_missed as f64 / audit.resolution_looks.max(1) as f64;
        Self {
            whale: summary.whale.as_ref(),
            time_s,
            peak: greatest(summary)
                .map(|line| (line.id.as_str(), line.peak_tension_n, line.peak_at_s)),
            load: nearest_to_strength(model, summary, budgets),
            parted: parted(summary),
            coarse: (missed > 0.0).then_some((missed, audit.resolution_ratio, model.node_count)),
            invalid_because,
        }
    }

    /// Its sentences, the result first; `force` formats a force in newtons.
    pub fn sentences(&self, force: impl Fn(f64) -> String) -> Vec<Sentence> {
        let result = [
            self.whale.map(|whale| outcome(whale, self.time_s)),
            self.loads(&force),
            Some(self.partings()),
        ];
        let toned = |tone: Tone| move |text: String| Sentence { text, tone };
        let result = result.into_iter().flatten().map(toned(Tone::Result));
        let kinematic = self.kinematic().map(toned(Tone::Kinematic));
        let coarse = self.too_coarse().map(toned(Tone::Coarse));
        let invalid = (!self.invalid_because.is_empty()).then(|| Sentence {
            text: format!("Do not use these numbers: {}.", self.invalid_because.join("; ")),
            tone: Tone::Invalid,
        });
        result.chain(kinematic).chain(coarse).chain(invalid).collect()
    }

    fn loads(&self, force: impl Fn(f64) -> String) -> Option<String> {
        let (line, tension_n, at_s) = self.peak?;
        let peak = format!("Greatest tension: {} in {line} at {at_s:.1} s", force(tension_n));
        Some(match &self.load {
            Some(Load { part, share }) => {
                format!(
                    "{peak}; nearest to parting: {part}, at {} % of its strength.",
                    percent(*share)
                )
            }
            None => peak + ".",
        })
    }

    fn partings(&self) -> String {
        let named: Vec<String> = self
            .parted
            .iter()
            .take(NAMED)
            .map(|(part, at_s)| format!("{part} at {at_s:.1} s"))
            .collect();
        match self.parted.len() {
            0 => "Nothing parted.".to_owned(),
            count if count <= NAMED => format!("Parted: {}.", named.join(", ")),
            count => format!("Parted: {}, and {} more.", named.join(", "), count - NAMED),
        }
    }

    fn kinematic(&self) -> Option<String> {
        let whale = self.whale?;
        (whale.kinetic.is_none() && whale.outcome != Outcome::NoContact).then(|| {
            "The whale swims its course and does not feel the gear, so that tensions are not those \
             of a living whale; choose kinetic dynamics."
                .to_owned()
        })
    }

    fn too_coarse(&self) -> Option<String> {
        let (missed, ratio, nodes) = self.coarse?;
        Some(format!(
            "Rope segments near the whale were longer than requested in {} % of the checks, at most {ratio:.1} times. \
             Coarse rope slips off more easily, and its small tensions are too great; use more than {nodes} rope \
             nodes, or request longer segments.",
            percent(missed)
        ))
    }
}

/// The outcome of an encounter so far.
fn outcome(whale: &WhaleSummary, time_s: f64) -> String {
    let last_s = whale.last_contact_s.unwrap_or(0.0);
    let ago_s = (time_s - last_s).max(0.0);
    let touches = whale.regions.iter().any(|part| part.touching);
    let touched = format!("rope touched the whale for {:.1} s in all", whale.contact_time_s);
    match whale.outcome {
        Outcome::NoContact if whale.decided => "No contact: no rope touched the whale.".to_owned(),
        Outcome::NoContact => "No contact so far.".to_owned(),
        Outcome::Shed => format!("Shed: {touched}, and the whale is free."),
        Outcome::PartedFree => "Free after a parting.".to_owned(),
        Outcome::Entangled | Outcome::PartedEntangled if !whale.decided && !touches => {
            format!("Not decided: rope last touched the whale {ago_s:.1} s ago.")
        }
        Outcome::Entangled | Outcome::PartedEntangled if !whale.decided => {
            format!("In contact: {}; not decided.", places(whale))
        }
        Outcome::Entangled => format!("Entangled: {}.", places(whale)),
        Outcome::PartedEntangled => {
            format!("Still entangled after a parting: {}.", places(whale))
        }
    }
}

/// Where rope is, with the turns about each part.
fn places(whale: &WhaleSummary) -> String {
    let mut named: Vec<String> = whale
        .regions
        .iter()
        .filter(|part| part.touching || part.wraps >= HOOKED_TURNS)
        .map(|part| match part.wraps {
            wraps if wraps >= HOOKED_TURNS => format!("{} ({wraps:.1} turns)", part.part.name()),
            _ => part.part.name().to_owned(),
        })
        .map(|part| part.replace('_', " "))
        .collect();
    if whale.lodged_in_mouth {
        named.insert(0, "mouth (lodged)".to_owned());
    }
    match named.split_last() {
        None => "rope touched it in the last ten seconds".to_owned(),
        Some((last, [])) => format!("rope at the {last}"),
        Some((last, others)) => format!("rope at the {} and {last}", others.join(", ")),
    }
}

/// Links and lines that parted, in the order of time.
fn parted(summary: &Summary) -> Vec<(String, f64)> {
    let links =
        summary.links.iter().map(|link| (format!("weak link {}", link.id), link.parted_at_s));
    let lines = summary.lines.iter().map(|line| (format!("line {}", line.id), line.parted_at_s));
    let mut all: Vec<(String, f64)> =
        links.chain(lines).filter_map(|(part, at_s)| Some((part, at_s?))).collect();
    all.sort_by(|one, other| one.1.total_cmp(&other.1));
    all
}

/// The part of which the greatest share of the strength was used; `None` if nothing can part.
fn nearest_to_strength(
    model: &Model,
    summary: &Summary,
    budgets: &[StrengthBudget],
) -> Option<Load> {
    if model.spec.settings.unbreakable {
        return None;
    }
    let strength_n =
        |part: &str| budgets.iter().find(|budget| budget.part == part).map(StrengthBudget::drawn_n);
    let lines = summary.lines.iter().zip(&model.spec.lines);
    let ropes = lines.clone().filter_map(|(borne, line)| {
        let share = needed_of(borne, line) / strength_n(&line.id)?;
        Some(Load { part: format!("rope of {}", line.id), share })
    });
    let places = lines.filter_map(|(borne, line)| {
        let peaks = line.weak_places.iter().map(|place| borne.peak_near_n(place.at_m));
        let share = peaks.reduce(f64::max)? / strength_n(&format!("{}.{WEAK_PLACES}", line.id))?;
        Some(Load { part: format!("weak places of {}", line.id), share })
    });
    let links = summary.links.iter().map(|link| Load {
        part: format!("weak link {}", link.id),
        share: link.peak_tension_n / link.rating_n,
    });
    let all = ropes.chain(places).chain(links).filter(|load| load.share.is_finite());
    all.max_by(|one, other| one.share.total_cmp(&other.share))
}

#[cfg(test)]
mod tests {
    use endline_sdk::BodyPart;

    use super::*;
    use crate::figures::tests::made_up;

    /// A whale with an outcome, last touched at 20 s, without rope on it.
    fn whale(outcome: Outcome, decided: bool) -> WhaleSummary {
        let mut whale = made_up::report().summary.whale.unwrap();
        (whale.outcome, whale.decided, whale.lodged_in_mouth) = (outcome, decided, false);
        for part in &mut whale.regions {
            (part.touching, part.wraps) = (false, 0.0);
        }
        (whale.last_contact_s, whale.contact_time_s) = (Some(20.0), 8.0);
        whale
    }

    fn headline(whale: &WhaleSummary) -> Headline<'_> {
        Headline {
            whale: Some(whale),
            time_s: 26.0,
            peak: Some(("endline-top", 250.0, 31.0)),
            load: Some(Load { part: "rope of endline-top".into(), share: 0.0449 }),
            parted: Vec::new(),
            coarse: None,
            invalid_because: &[],
        }
    }

    fn texts(headline: &Headline<'_>) -> Vec<String> {
        let force = |force_n: f64| format!("{force_n:.0} N");
        headline.sentences(force).into_iter().map(|sentence| sentence.text).collect()
    }

    #[test]
    fn it_names_outcome_load_and_partings() {
        assert_eq!(
            texts(&headline(&whale(Outcome::Shed, true))),
            [
                "Shed: rope touched the whale for 8.0 s in all, and the whale is free.",
                "Greatest tension: 250 N in endline-top at 31.0 s; nearest to parting: rope of endline-top, at 4.5 % of its strength.",
                "Nothing parted.",
            ]
        );
        let whale = whale(Outcome::PartedFree, true);
        let mut parted = headline(&whale);
        parted.parted = [("weak link a", 3.0), ("line b", 4.0), ("line c", 5.0)]
            .map(|(part, at_s)| (part.to_owned(), at_s))
            .to_vec();
        assert_eq!(texts(&parted)[0], "Free after a parting.");
        assert_eq!(texts(&parted)[2], "Parted: weak link a at 3.0 s, line b at 4.0 s, and 1 more.");
    }

    #[test]
    fn an_entangled_whale_has_its_places_and_an_undecided_one_the_time_since_contact() {
        let mut entangled = whale(Outcome::Entangled, true);
        entangled.lodged_in_mouth = true;
        let flipper = entangled.regions.iter_mut().find(|part| part.part == BodyPart::LeftFlipper);
        flipper.unwrap().wraps = 1.25;
        assert_eq!(
            texts(&headline(&entangled))[0],
            "Entangled: rope at the mouth (lodged) and left flipper (1.2 turns)."
        );
        assert_eq!(
            texts(&headline(&whale(Outcome::Entangled, false)))[0],
            "Not decided: rope last touched the whale 6.0 s ago."
        );
    }

    #[test]
    fn doubts_and_reasons_against_it_follow() {
        let kinematic = WhaleSummary { kinetic: None, ..whale(Outcome::Entangled, true) };
        let reasons = ["rope passed through skin once".to_owned()];
        let doubtful = Headline {
            coarse: Some((0.99, 4.0, 500)),
            invalid_because: &reasons,
            ..headline(&kinematic)
        };
        let found = doubtful.sentences(|force_n| format!("{force_n} N"));
        let tones: Vec<Tone> = found.iter().map(|sentence| sentence.tone).collect();
        let [result, coarse, invalid] = [Tone::Result, Tone::Coarse, Tone::Invalid];
        assert_eq!(tones, [result, result, result, Tone::Kinematic, coarse, invalid]);
        for words in ["99 % of the checks", "4.0 times", "500 rope nodes"] {
            assert!(found[4].text.contains(words), "{words}: {}", found[4].text);
        }
        assert!(found[5].text.ends_with("rope passed through skin once."));
    }
}
