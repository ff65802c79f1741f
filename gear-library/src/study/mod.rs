//! The study document: options compared on the same encounters, as data.
//!
//! A study names a baseline scenario, options as differences from it, and distributions of encounters. The session draws
//! and runs them. The order of tables does not matter: the hash of a study is that of its canonical text, with sorted keys and
//! options and without texts that do not change a run. The format is described in `docs/studies.md`.

mod comparison;
mod event;
mod exposure;
mod option;
mod prior;

use std::fmt::Write;

use crate::diagnostic::{At, Diagnostic, Place, hint};
use crate::entry::{self, FORMER_CONFIDENCE};
use crate::fields::{Fields, Problems, Range, id_of, read_file};
use crate::tree::{Content, Node};
use crate::units::Quantity;
use crate::{limits, names};

pub use comparison::{Claim, Discretisation, ObservedRoutes, ObservedShare};
pub use event::{Counted, HOOKED_TURNS, RegionEvent, StudyEvent};
pub use exposure::Exposure;
pub(crate) use option::texts;
pub use option::{Setting, StudyOption, ThreatLabels, ThreatRow, library_field};
pub use prior::{Law, Level, Prior, Target, prior_words, referenced_folder};

/// Greatest number of encounters: the number of points of the Sobol sequence.
pub const MOST_ENCOUNTERS: u64 = limits::ENCOUNTERS.most as u64;

/// Default share of encounters drawn from the priors: no weight then exceeds four times the mean.
const FROM_PRIORS: f64 = 0.25;

/// Default share of encounters drawn from the priors by a study that adapts.
const FROM_PRIORS_ADAPTED: f64 = 0.15;

/// A study as read; the session resolves the names of library items.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Its question, and limits of its results; may be empty.
    pub notes: String,
    /// The file itself.
    pub place: Place,
    /// The baseline: id of a scenario of the library, or a path beside the study.
    pub scenario: At<String>,
    /// Seed of the draws.
    pub seed: u64,
    /// Number of encounters.
    pub encounters: u64,
    /// Id of the reference option.
    pub baseline: At<String>,
    /// Event by which options are ranked.
    pub event: StudyEvent,
    /// Other events for comparison, registered before the first run.
    pub registered: Vec<At<StudyEvent>>,
    /// Prior by whose levels results are also listed.
    pub split: Option<At<String>>,
    /// When a run ends.
    pub run: RunRule,
    /// Stopping rule of the study, if any.
    pub enough: Option<Enough>,
    /// Options, by id.
    pub options: Vec<StudyOption>,
    /// Aim of the whale.
    pub aim: Aim,
    /// Priors, by name.
    pub priors: Vec<Prior>,
    /// Share of encounters drawn from the priors, if a prior has a proposal.
    pub from_priors: f64,
    /// Tracks of whales through an area with gear, in place of whales that are aimed at rope.
    pub exposure: Option<Exposure>,
    /// When proposals are fitted to the encounters so far, if the study adapts.
    pub adapt: Option<Adapt>,
    /// Claims, by id.
    pub claims: Vec<Claim>,
    /// Shares observed on real whales, by id.
    pub observations: Vec<ObservedShare>,
    /// How observed whales are held, if the study states it.
    pub routes: Option<ObservedRoutes>,
    /// Effects of finer segments and steps.
    pub discretisations: Vec<Discretisation>,
    /// Canonical text of the definition of the runs, for the hash of the study.
    pub canonical: String,
}

/// When a run ends before the duration of its scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunRule {
    /// Time after which a whale without contact has passed [s].
    pub passed_s: f64,
    /// Time from the first contact for which an entangled whale is simulated [s].
    pub held_s: f64,
    /// Time without change after which an entangled whale counts as permanently held [s].
    pub settled_s: Option<f64>,
    /// Time for which an entangled whale is simulated after the last parting [s].
    pub parted_s: Option<f64>,
}

impl Default for RunRule {
    fn default() -> Self {
        Self { passed_s: 30.0, held_s: 600.0, settled_s: None, parted_s: None }
    }
}

/// Stopping rule of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Enough {
    /// Event whose rate counts.
    pub event: StudyEvent,
    /// Width of its 95 % interval at which the study ends, in all options.
    pub width: f64,
    /// Minimum number of encounters.
    pub least: u64,
}

/// Stages of a study that adapts: before each, proposals are fitted to the encounters of the earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Adapt {
    /// Encounters before each stage but the first, ascending.
    pub after: Vec<u64>,
    /// Event whose encounters the proposals favour.
    pub event: StudyEvent,
}

/// Aim of the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// Target lines of the gear at rest; empty for any.
    pub lines: Vec<At<String>>,
    /// Whether the whale is aimed at each option's own gear; else at that of the baseline.
    pub own: bool,
    /// Initial distance from snout to rope [m].
    pub gap_m: f64,
}

impl Study {
    /// Reads a study's text; `name` is its path as shown in messages.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        read_file(name, text, |node, problems| Self::from_node(name, node, problems))
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, _) = entry::header(&fields, "study", problems);
        let scenario = scenario(&fields);
        let seed = fields.count("seed", &limits::SEED);
        let encounters = encounters(&fields);
        let baseline = fields.need_text("baseline", "write the id of the reference option");
        let event = event::maybe(&fields, "event");
        let registered = event::list(&fields, "registered");
        let split = fields.text("split");
        let run = run_rule(&fields);
        let enough = fields.inside("enough", enough).flatten();
        let options = option::read_options(&fields);
        let adapt = fields.inside("adapt", adapt).flatten();
        let exposure = fields.inside("exposure", exposure::exposure).flatten();
        let (aim, priors, from_priors) = encounter(&fields);
        if exposure.is_some() {
            exposure::check_priors(&fields, &priors);
        }
        let usual = if adapt.is_some() { FROM_PRIORS_ADAPTED } else { FROM_PRIORS };
        let claims = comparison::read_claims(&fields, &options);
        let observations = comparison::read_observations(&fields, &options);
        let routes = comparison::read_routes(&fields);
        let discretisations = comparison::read_discretisations(&fields);
        fields.finish();
        let study = Self {
            id: id_of(path),
            name,
            notes,
            place: node.place.clone(),
            scenario: scenario?,
            seed: seed.map_or(1, |seed| seed.value),
            encounters: encounters?,
            baseline: baseline?,
            event: event.unwrap_or(StudyEvent::Entangled),
            registered,
            split,
            run,
            enough,
            options,
            aim,
            priors,
            from_priors: from_priors.unwrap_or(usual),
            exposure,
            adapt,
            claims,
            observations,
            routes,
            discretisations,
            canonical: defining_text(node),
        };
        study.check_whole(problems);
        Some(study)
    }

    fn check_whole(&self, problems: &Problems) {
        let ids = || self.options.iter().map(|option| option.id.value.as_str());
        if !ids().any(|id| id == self.baseline.value) {
            problems.push(self.baseline.place.error(
                format!("there is no option `{}`", self.baseline.value),
                hint(&self.baseline.value, ids()),
            ));
        }
        let is_cut =
            |option: &StudyOption| option.until_parted && option.id.value == self.baseline.value;
        if self.options.iter().any(is_cut) {
            let message = "the runs of the baseline end where something parts";
            let help = "remove `until = \"parted\"` from it: other options are compared with how its encounters end";
            problems.push(self.baseline.place.error(message, help));
        }
        if self.exposure.is_some() && self.adapt.is_some() {
            let message = "the study has [adapt] and [exposure]";
            let help = "remove one of them: rates by distance count every track alike";
            problems.push(self.place.error(message, help));
        }
        let choices = || {
            self.priors
                .iter()
                .filter(|prior| matches!(prior.law, Law::Choice { .. }))
                .map(|prior| prior.name.value.as_str())
        };
        if let Some(split) =
            self.split.as_ref().filter(|split| !choices().any(|name| name == split.value))
        {
            let message = format!("`{}` is not a prior with a `choice`", split.value);
            problems.push(split.place.error(message, hint(&split.value, choices())));
        }
    }
}

/// The baseline: an id of the library, or a file in or below the study's folder. A study is copied with its files, so that a
/// path out of its folder would be written elsewhere.
fn scenario(fields: &Fields<'_>) -> Option<At<String>> {
    let help = "write the id of a scenario of the library, such as \"hello-endline\"";
    let named = fields.need_text("scenario", help)?;
    let text = &named.value;
    let is_known =
        if text.ends_with(".toml") { names::stays_below(text) } else { names::is_id(text) };
    if is_known {
        return Some(named);
    }
    let message = format!("`scenario` is {text:?}, which leads out of the study's folder");
    let help = format!("{help}, or the path of a file below the study's own folder");
    fields.refuse(named.place.error(message, help))
}

fn encounters(fields: &Fields<'_>) -> Option<u64> {
    fields.require(
        "encounters",
        "write the number of encounters of each option, such as encounters = 1000",
    );
    let count = fields.count("encounters", &limits::ENCOUNTERS)?;
    Some(count.value)
}

/// `[run]`: when a run ends.
fn run_rule(fields: &Fields<'_>) -> RunRule {
    let usual = RunRule::default();
    let Some(table) = fields.table("run") else { return usual };
    let passed = table.value("passed", Quantity::Time, Range::Positive);
    let held = table.value("held", Quantity::Time, Range::Positive);
    let settled = table.value("settled", Quantity::Time, Range::Positive);
    let parted = table.value("parted", Quantity::Time, Range::Positive);
    table.finish();
    RunRule {
        passed_s: passed.map_or(usual.passed_s, |passed| passed.value),
        held_s: held.map_or(usual.held_s, |held| held.value),
        settled_s: settled.map(|settled| settled.value),
        parted_s: parted.map(|parted| parted.value),
    }
}

/// `[enough]`: the stopping rule.
fn enough(table: &Fields<'_>) -> Option<Enough> {
    let event = event::need(table, "event");
    let width = table.need_value("narrower", Quantity::Ratio, Range::Between(1e-4, 1.0));
    let least = table.count("least", &limits::ENCOUNTERS);
    Some(Enough {
        event: event?,
        width: width?.value,
        least: least.map_or(50, |least| least.value),
    })
}

/// Least number of encounters to which proposals are fitted.
const LEAST_FITTED: u64 = 20;

/// `[adapt]`: stages and their event.
fn adapt(table: &Fields<'_>) -> Option<Adapt> {
    let help = "write the numbers of encounters after which proposals are fitted, such as after = [100, 300, 600]";
    table.require("after", help);
    let event = event::need(table, "event");
    let node = table.get("after")?;
    let Content::List(items) = &node.content else {
        return table.refuse(node.place.error("`after` is not a list of numbers", help));
    };
    let most = MOST_ENCOUNTERS as f64;
    let number = |item: &Node| match item.content {
        Content::Number(number) if number.fract() == 0.0 && (1.0..=most).contains(&number) =>
        {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tested")]
            Some(number as u64)
        }
        _ => None,
    };
    let after: Option<Vec<u64>> = items.iter().map(number).collect();
    let rises = |after: &Vec<u64>| after.windows(2).all(|pair| pair[0] < pair[1]);
    let fits = after
        .filter(rises)
        .filter(|after| after.first().is_some_and(|first| *first >= LEAST_FITTED));
    let Some(after) = fits else {
        let message =
            format!("`after` is not a rising list of whole numbers from {LEAST_FITTED} on");
        return table.refuse(node.place.error(message, help));
    };
    Some(Adapt { after, event: event? })
}

/// `[encounter]`: aim of the whale, and one table per prior.
fn encounter(fields: &Fields<'_>) -> (Aim, Vec<Prior>, Option<f64>) {
    let Some(table) = fields.table("encounter") else {
        fields.missing("encounter", "write the distribution of encounters, such as [encounter.speed] with uniform = [\"0.5 m/s\", \"1.6 m/s\"]");
        return (Aim { lines: Vec::new(), own: false, gap_m: 4.0 }, Vec::new(), None);
    };
    let lines = texts(&table, "aim");
    let by = table.choice("aim_by", &[("baseline", false), ("own", true)]);
    let gap = table.value("gap", Quantity::Length, Range::Between(0.1, 1000.0));
    let aim =
        Aim { lines, own: by.is_some_and(|by| by.value), gap_m: gap.map_or(4.0, |gap| gap.value) };
    let from_priors = table.value("from_priors", Quantity::Ratio, Range::Between(0.05, 1.0));
    let priors = prior::read_all(&table);
    table.finish();
    (aim, priors, from_priors.map(|share| share.value))
}

/// Top-level tables and keys that define the runs.
const DEFINING: [&str; 8] =
    ["scenario", "seed", "run", "option", "axis", "encounter", "exposure", "adapt"];

/// Keys that do not affect the runs.
const EXPLAINING: [&str; 7] =
    ["confidence", "curve", "name", "notes", "source", "threat", FORMER_CONFIDENCE];

/// The text of which the hash of a study is computed.
fn defining_text(study: &Node) -> String {
    let Content::Table(entries) = &study.content else { return String::new() };
    let mut text = String::new();
    for key in DEFINING {
        for (_, _, node) in entries.iter().filter(|(name, _, _)| name == key) {
            let _ = writeln!(text, "{key} = {}", canonical(node));
        }
    }
    text
}

fn canonical(node: &Node) -> String {
    match &node.content {
        Content::Text(text) => format!("{text:?}"),
        Content::Number(number) => format!("{number:?}"),
        Content::Flag(flag) => flag.to_string(),
        Content::Date(date) => date.clone(),
        Content::List(items) => list(items),
        Content::Table(entries) => {
            let defining = entries.iter().filter(|(key, _, _)| !EXPLAINING.contains(&key.as_str()));
            let mut pairs: Vec<String> =
                defining.map(|(key, _, value)| format!("{key:?}={}", canonical(value))).collect();
            pairs.sort();
            format!("{{{}}}", pairs.join(","))
        }
    }
}

/// Lists of tables, such as options, are sorted; other lists keep their order.
fn list(items: &[Node]) -> String {
    let mut texts: Vec<String> = items.iter().map(canonical).collect();
    if items.iter().all(|item| matches!(item.content, Content::Table(_))) {
        texts.sort();
    }
    format!("[{}]", texts.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ADAPTS: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"hello-endline\"\nencounters = 400\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[adapt]\nafter = [100, 300]\nevent = \"entangled\"\n\
        [encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n";

    #[test]
    fn stages_are_read_and_define_the_runs() {
        let study = Study::read("s.toml", ADAPTS).unwrap();
        let adapt = study.adapt.unwrap();
        assert_eq!((adapt.after.as_slice(), adapt.event), (&[100, 300][..], StudyEvent::Entangled));
        assert!((study.from_priors - FROM_PRIORS_ADAPTED).abs() < 1e-15);
        let other = Study::read("s.toml", &ADAPTS.replace("300", "200")).unwrap();
        assert_ne!(other.canonical, study.canonical);
    }

    #[test]
    fn stages_that_make_no_sense_are_reported() {
        for (from, to, expected) in [
            ("[100, 300]", "[300, 100]", "not a rising list of whole numbers"),
            ("[100, 300]", "[5, 100]", "from 20 on"),
            ("[100, 300]", "[100.5]", "not a rising list"),
            ("[100, 300]", "100", "is not a list of numbers"),
            ("after = [100, 300]\n", "", "`after` is missing"),
            ("event = \"entangled\"\n[enc", "[enc", "`event` is missing"),
        ] {
            let problems = Study::read("s.toml", &ADAPTS.replace(from, to)).unwrap_err();
            let is_it = |problem: &Diagnostic| problem.message.contains(expected);
            assert!(problems.iter().any(is_it), "{to}: {problems:?}");
        }
    }
}
