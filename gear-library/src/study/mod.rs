//! The study document: options compared on the same encounters, as data.
//!
//! A study names a baseline scenario, options as differences from it, and how encounters are drawn. The session draws
//! and runs them; nothing in a study hangs on the order of its tables. The format is described in `docs/studies.md`.

mod axis;
mod canon;
mod claim;
mod discretisation;
mod event;
mod observation;
mod option;
mod options;
mod prior;
mod threat;

use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry;
use crate::fields::{Fields, Problems, Range};
use crate::limits;
use crate::names;
use crate::nearest::hint;
use crate::tree::{self, Node};
use crate::units::Quantity;

pub use claim::Claim;
pub use discretisation::Discretisation;
pub use event::{Counted, HOOKED_TURNS, RegionEvent, StudyEvent};
pub use observation::ObservedShare;
pub(crate) use option::texts;
pub use option::{Setting, StudyOption};
pub use prior::{Law, Level, Prior, Target};
pub use threat::{ThreatLabels, ThreatRow};

/// Most encounters: the Sobol sequence used has this many points.
pub const MOST_ENCOUNTERS: u64 = limits::ENCOUNTERS.most as u64;

/// Share of encounters drawn from the priors themselves, where a study does not say: no encounter then weighs more than
/// four times the mean.
const FROM_PRIORS: f64 = 0.25;

/// A study as read; what it names in the library is looked up by the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// What it asks, and what its numbers do not say; may be empty.
    pub notes: String,
    /// The file itself.
    pub place: Place,
    /// The baseline: id of a scenario of the library, or a path beside the study.
    pub scenario: At<String>,
    /// Seed of the draws.
    pub seed: u64,
    /// How many encounters.
    pub encounters: u64,
    /// Id of the option that others are compared with.
    pub baseline: At<String>,
    /// What options are ranked by.
    pub event: StudyEvent,
    /// Other events by which options are to be compared, decided before the first run.
    pub registered: Vec<At<StudyEvent>>,
    /// Prior by whose levels results are also listed apart.
    pub split: Option<At<String>>,
    /// When a run ends.
    pub run: RunRule,
    /// When the study has seen enough, where it asks so.
    pub enough: Option<Enough>,
    /// Options, by id.
    pub options: Vec<StudyOption>,
    /// Where the whale is aimed.
    pub aim: Aim,
    /// What is drawn, by name.
    pub priors: Vec<Prior>,
    /// Share of encounters drawn from the priors themselves where a prior has a proposal.
    pub from_priors: f64,
    /// Statements whose sign is looked at, by id.
    pub claims: Vec<Claim>,
    /// Shares seen on real whales against which its own are held, by id.
    pub observations: Vec<ObservedShare>,
    /// What finer segments and steps change.
    pub discretisations: Vec<Discretisation>,
    /// What defines the runs, in one order whatever the file's: for the study's hash.
    pub canonical: String,
}

/// When a run ends before its scenario's time is over: nothing more can happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunRule {
    /// A whale that rope has not touched by then has passed [s].
    pub passed_s: f64,
    /// How long an entangled whale is followed from the first contact on [s].
    pub held_s: f64,
    /// An entangled whale about which nothing has changed for so long is held for good [s].
    pub settled_s: Option<f64>,
}

impl Default for RunRule {
    fn default() -> Self {
        Self { passed_s: 30.0, held_s: 600.0, settled_s: None }
    }
}

/// When the study has seen enough.
#[derive(Clone, Debug, PartialEq)]
pub struct Enough {
    /// The rate that counts.
    pub event: StudyEvent,
    /// Width of its 95 % interval below which the study ends, in every option.
    pub width: f64,
    /// Encounters that are run in any case.
    pub least: u64,
}

/// Where the whale is aimed.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// Lines as the gear lies at rest; any where none is named.
    pub lines: Vec<At<String>>,
    /// Whether each option's own gear is aimed at; else all options meet the whale that the baseline does.
    pub own: bool,
    /// From the snout to the rope at the start [m].
    pub gap_m: f64,
}

impl Study {
    /// Reads a study's text; `name` is its path as shown in messages.
    ///
    /// # Errors
    /// Everything wrong with it that can be seen without its scenario.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let problems = Problems::default();
        let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
        match Self::from_node(name, &node, &problems) {
            Some(study) if !problems.any_error() => Ok(study),
            _ => Err(problems.into_sorted()),
        }
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, _) = entry::header(&fields, "study", problems);
        let scenario = scenario(&fields);
        let seed = fields.count("seed", &limits::SEED);
        let encounters = encounters(&fields);
        let baseline = fields
            .need_text("baseline", "write the id of the option that others are compared with");
        let event = event::maybe(&fields, "event");
        let registered = event::list(&fields, "registered");
        let split = fields.text("split");
        let run = run_rule(&fields);
        let enough = fields.table("enough").and_then(|fields| enough(&fields));
        let options = options::read_all(&fields);
        let (aim, priors, from_priors) = encounter(&fields);
        let claims = claim::read_all(&fields, &options);
        let observations = observation::read_all(&fields, &options);
        let discretisations = discretisation::read_all(&fields);
        fields.finish();
        let study = Self {
            id: path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml").to_owned(),
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
            from_priors,
            claims,
            observations,
            discretisations,
            canonical: canon::of(node),
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
        let choices = || {
            self.priors
                .iter()
                .filter(|prior| matches!(prior.law, Law::Choice { .. }))
                .map(|prior| prior.name.value.as_str())
        };
        if let Some(split) =
            self.split.as_ref().filter(|split| !choices().any(|name| name == split.value))
        {
            let message = format!("`{}` is no prior with a `choice`", split.value);
            problems.push(split.place.error(message, hint(&split.value, choices())));
        }
    }
}

/// The baseline: an id of the library, or a file beside the study or below its folder. A study is copied with what it names, so
/// that a path out of its folder would be written to elsewhere.
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
    fields.problems().push(named.place.error(message, help));
    None
}

fn encounters(fields: &Fields<'_>) -> Option<u64> {
    if fields.get("encounters").is_none() {
        fields.missing(
            "encounters",
            "write how many encounters every option meets, such as encounters = 1000",
        );
    }
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
    table.finish();
    RunRule {
        passed_s: passed.map_or(usual.passed_s, |passed| passed.value),
        held_s: held.map_or(usual.held_s, |held| held.value),
        settled_s: settled.map(|settled| settled.value),
    }
}

/// `[enough]`: when the study has seen enough.
fn enough(table: &Fields<'_>) -> Option<Enough> {
    let event = event::need(table, "event");
    let width = table.need_value("narrower", Quantity::Ratio, Range::Between(1e-4, 1.0));
    let least = table.count("least", &limits::ENCOUNTERS);
    table.finish();
    Some(Enough {
        event: event?,
        width: width?.value,
        least: least.map_or(50, |least| least.value),
    })
}

/// `[encounter]`: where the whale is aimed, and one table for each prior.
fn encounter(fields: &Fields<'_>) -> (Aim, Vec<Prior>, f64) {
    let Some(table) = fields.table("encounter") else {
        fields.missing("encounter", "write how encounters are drawn, such as [encounter.speed] with uniform = [\"0.5 m/s\", \"1.6 m/s\"]");
        return (Aim { lines: Vec::new(), own: false, gap_m: 4.0 }, Vec::new(), FROM_PRIORS);
    };
    let lines = texts(&table, "aim");
    let by = table.word("aim_by", &["baseline", "own"]);
    let gap = table.value("gap", Quantity::Length, Range::Between(0.1, 1000.0));
    let aim = Aim {
        lines,
        own: by.is_some_and(|by| by.value == "own"),
        gap_m: gap.map_or(4.0, |gap| gap.value),
    };
    let from_priors = table.value("from_priors", Quantity::Ratio, Range::Between(0.05, 1.0));
    let priors = prior::read_all(&table);
    table.finish();
    (aim, priors, from_priors.map_or(FROM_PRIORS, |share| share.value))
}
