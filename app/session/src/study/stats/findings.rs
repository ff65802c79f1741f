//! All that a report contains about the runs of a study.

use std::collections::BTreeSet;

use endline_gear::StudyEvent;
use schemars::JsonSchema;
use serde::Serialize;

use crate::settled::PartStrength;
use crate::study::folder::Folder;
use crate::study::plan::OptionPlan;
use crate::study::prepared::PreparedStudy;
use crate::study::registration::Registration;
use crate::study::runs::{RunRow, Runs};
use crate::table::Column;
use crate::units::grouped;

use super::bands::{self, Bands};
use super::changes::Changes;
use super::claims::{self, ClaimFinding, holm};
use super::exposure::{self, ExposureFinding};
use super::held_whales::HeldWhales;
use super::indicators::EventIndicators;
use super::interval::Rate;
use super::observations::{self, ObservationFinding};
use super::paired::Paired;
use super::sensitivity::{self, InputFinding, Lowest};
use super::strength_curve::{self, StrengthCurve};
use super::survival::Survival;
use super::tensions::Tensions;

/// Name of the schema.
const SCHEMA: &str = "endline.findings/2";

/// The results of a study.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Findings {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the study.
    pub study: String,
    /// Hash of what defines its runs.
    pub hash: String,
    /// Version of Endline that computed the runs.
    pub version: String,
    /// Encounters in the table.
    pub encounters: u64,
    /// Encounters of the study, the first of which are in the table.
    pub planned: u64,
    /// Name of the event options are ranked by.
    pub event: String,
    /// The registration before the first run.
    pub registration: Registration,
    /// Comparisons of options with the baseline among which Holm's adjustment is made.
    pub comparisons: u64,
    /// Place of the baseline among the options.
    pub baseline: usize,
    /// The options.
    pub options: Vec<OptionFinding>,
    /// What each option does for the whales held with the baseline; `None` if the event does not say that a whale is held.
    pub held_whales: Option<HeldWhales>,
    /// Rates by distance swum and by time of gear in the water, if whales cross an area of gear on tracks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub exposure: Vec<ExposureFinding>,
    /// Rates against any strength of rope or weak links, if an option cannot part.
    pub strength_curves: Vec<StrengthCurve>,
    /// Levels of the prior by which results are separated.
    pub levels: Vec<LevelFinding>,
    /// Uncertainty of the rates of registered events: chance, assumed inputs, segments.
    pub bands: Vec<Bands>,
    /// Claims.
    pub claims: Vec<ClaimFinding>,
    /// Shares seen on real whales, and the study's own.
    pub observations: Vec<ObservationFinding>,
    /// Inputs, that with the greatest effect on the event first.
    pub inputs: Vec<InputFinding>,
}

/// The results of an option.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct OptionFinding {
    /// Id.
    pub id: String,
    /// Name.
    pub name: String,
    /// Strength that it represents [N].
    pub strength_n: Option<f64>,
    /// Which curve of break-away against strength it belongs to.
    pub curve: Option<String>,
    /// What it differs in from the baseline: dotted paths without the numbers of lists.
    pub differs_in: Vec<String>,
    /// Runs that do not count.
    pub invalid: u64,
    /// Valid runs that were too short for a final outcome; they count.
    pub undecided: u64,
    /// Checks of segment lengths near the whale in all runs, and those that left a segment longer than requested by a quarter or more.
    pub resolution: ResolutionChecks,
    /// Rate of every event: name, rate. If runs end where something parts, only of events that are known then.
    pub rates: Vec<(String, Rate)>,
    /// Each of these events compared with the baseline: name, comparison.
    pub against: Vec<(String, Paired)>,
    /// Registered events: name, McNemar's probability among all such comparisons of the study, by Holm.
    pub adjusted: Vec<(String, f64)>,
    /// Outcomes and tensions beside the baseline's in the same encounters.
    pub changes: Changes,
    /// Greatest tensions.
    pub tensions: Tensions,
    /// Duration for which rope holds whales that it touched.
    pub survival: Survival,
    /// Delivered strength of each line and weak link in the gear as it is assembled.
    pub strengths: Vec<PartStrength>,
    /// Share of resamples in which it has the lowest rate of the event.
    pub lowest: Lowest,
}

/// Checks of segment lengths near the whale.
#[derive(Clone, Copy, Debug, Default, Eq, JsonSchema, PartialEq, Serialize)]
#[schemars(rename = "Looks")]
pub struct ResolutionChecks {
    /// All.
    pub all: u64,
    /// Checks that left a segment longer than requested by a quarter or more.
    pub missed: u64,
}

/// Rates within a level of the prior by which results are separated.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct LevelFinding {
    /// The level.
    pub level: String,
    /// By option: rate of the event the study asks about.
    pub rates: Vec<Rate>,
    /// By option: the same compared with the baseline.
    pub against: Vec<Paired>,
    /// By option: rate of parting.
    pub parted: Vec<Rate>,
}

impl ResolutionChecks {
    /// Share that left a segment longer than requested by a quarter or more; `None` without a check.
    pub fn share(&self) -> Option<f64> {
        (self.all > 0).then(|| self.missed as f64 / self.all as f64)
    }
}

impl OptionFinding {
    /// The rate of an event.
    pub fn rate(&self, event: &str) -> Option<&Rate> {
        self.rates.iter().find(|(name, _)| name == event).map(|(_, rate)| rate)
    }

    /// McNemar's probability of a registered event among all registered comparisons.
    pub fn adjusted(&self, event: &str) -> Option<f64> {
        self.adjusted.iter().find(|(name, _)| name == event).map(|(_, adjusted)| *adjusted)
    }

    /// The comparison of an event with the baseline.
    pub fn against(&self, event: &str) -> Option<&Paired> {
        self.against.iter().find(|(name, _)| name == event).map(|(_, paired)| paired)
    }
}

impl Findings {
    /// The options but for the baseline.
    pub fn others(&self) -> impl Iterator<Item = &OptionFinding> {
        let options = self.options.iter().enumerate();
        options.filter(|(index, _)| *index != self.baseline).map(|(_, option)| option)
    }

    /// The number of encounters, such as `600 encounters` or `the first 195 of 1,800 encounters`.
    pub fn extent(&self) -> String {
        let [done, planned] =
            [self.encounters, self.planned].map(|count| grouped(&count.to_string()));
        match self.encounters {
            1 if self.planned <= 1 => "1 encounter".to_owned(),
            fewer if fewer < self.planned => format!("the first {done} of {planned} encounters"),
            _ => format!("{done} encounters"),
        }
    }

    /// The findings of a study's runs in a folder.
    pub fn of(opened: &PreparedStudy, runs: &Runs, folder: &Folder) -> Self {
        let registration = &folder.registration;
        let order = opened.reading_order();
        let ids: Vec<String> =
            order.iter().map(|option| opened.options[*option].id.clone()).collect();
        let baseline =
            order.iter().position(|option| *option == opened.baseline).unwrap_or_default();
        let event = &opened.study.event;
        let indicators: Vec<EventIndicators> =
            ids.iter().map(|id| EventIndicators::of(runs, id, event)).collect();
        let lowest = sensitivity::lowest(&indicators);
        let mut options: Vec<OptionFinding> =
            order.iter().map(|option| found(opened, runs, *option)).collect();
        options.iter_mut().zip(lowest).for_each(|(option, lowest)| option.lowest = lowest);
        let comparisons = adjust(&mut options, baseline, registration);
        let now = Registration::of(&opened.study);
        let mut claims = claims::assess_all(&opened.study.claims, runs);
        claims
            .iter_mut()
            .for_each(|claim| claim.registered = registration.has_claim(&now, &claim.id));
        Self {
            schema: SCHEMA,
            study: opened.study.id.clone(),
            hash: folder.hash.clone(),
            version: folder.version.clone(),
            encounters: runs.encounters() as u64,
            planned: opened.study.encounters,
            event: event.name(),
            registration: registration.clone(),
            comparisons,
            baseline,
            held_whales: held_whales(opened, runs, (&ids, baseline)),
            exposure: exposure_of(opened, runs, &order, baseline),
            strength_curves: strength_curve::of_study(opened, runs, event),
            options,
            levels: levels(opened, runs, &indicators, (&ids, baseline)),
            bands: bands::of_registered(opened, runs, registration),
            claims,
            observations: opened
                .study
                .observations
                .iter()
                .map(|seen| ObservationFinding {
                    registered: registration.has_observation(&now, &seen.id.value),
                    ..observations::compare(seen, runs, &ids[baseline])
                })
                .collect(),
            inputs: sensitivity::of_inputs(opened, runs, &indicators, baseline),
        }
    }
}

/// Rates on tracks: of gear met, of contact, and of registered events.
fn exposure_of(
    opened: &PreparedStudy,
    runs: &Runs,
    order: &[usize],
    baseline: usize,
) -> Vec<ExposureFinding> {
    let options: Vec<&OptionPlan> = order.iter().map(|option| &opened.options[*option]).collect();
    let mut events = vec![StudyEvent::Contact];
    let registered = opened.study.registered.iter().map(|event| &event.value);
    for event in std::iter::once(&opened.study.event).chain(registered) {
        if !events.contains(event) {
            events.push(event.clone());
        }
    }
    exposure::of(runs, &options, baseline, &events)
}

fn held_whales(
    opened: &PreparedStudy,
    runs: &Runs,
    (ids, baseline): (&[String], usize),
) -> Option<HeldWhales> {
    let name = |id: &String| {
        let option = opened.options.iter().find(|option| option.id == *id);
        (id.clone(), option.map_or_else(|| id.clone(), |option| option.name.clone()))
    };
    // Whether a whale is held at the end is unknown if runs end where something parts.
    let ends_early =
        |id: &&String| opened.options.iter().any(|option| option.id == **id && option.until_parted);
    let options: Vec<(String, String)> =
        ids.iter().filter(|id| !ends_early(id)).map(name).collect();
    let baseline = options.iter().position(|(id, _)| *id == ids[baseline])?;
    let observed = opened.study.routes.as_ref();
    HeldWhales::of(runs, &options, baseline, &opened.study.event, observed)
}

/// Adjusts the probabilities of all comparisons of registered events with the baseline; answers how many there are.
fn adjust(options: &mut [OptionFinding], baseline: usize, registration: &Registration) -> u64 {
    let events = || registration.events.iter().collect::<BTreeSet<&String>>();
    let places: Vec<(usize, String, f64)> = options
        .iter()
        .enumerate()
        .filter(|(place, _)| *place != baseline)
        .flat_map(|(place, option)| {
            let of =
                move |name: &String| Some((place, name.clone(), option.against(name)?.mcnemar));
            events().into_iter().filter_map(of)
        })
        .collect();
    let adjusted = holm(&places.iter().map(|(.., probability)| *probability).collect::<Vec<_>>());
    let count = adjusted.len() as u64;
    for ((place, name, _), adjusted) in places.into_iter().zip(adjusted) {
        options[place].adjusted.push((name, adjusted));
    }
    count
}

fn found(opened: &PreparedStudy, runs: &Runs, option: usize) -> OptionFinding {
    let (plan, baseline) = (&opened.options[option], &opened.options[opened.baseline].id);
    let own: Vec<&RunRow> = runs.rows().iter().filter(|run| run.option == plan.id).collect();
    let count = |is_it: fn(&RunRow) -> bool| own.iter().filter(|run| is_it(run)).count() as u64;
    let sum = |of: fn(&RunRow) -> u64| own.iter().map(|run| of(run)).sum::<u64>();
    // Of a run that ends where something parts, other events are unknown.
    let is_known = |event: &StudyEvent| !plan.until_parted || event.is_known_at_parting();
    let events: Vec<StudyEvent> = StudyEvent::all().into_iter().filter(is_known).collect();
    let indicators = |event: &StudyEvent| EventIndicators::of(runs, &plan.id, event);
    let paired = |event: &StudyEvent| {
        (event.name(), Paired::of(&indicators(event), &EventIndicators::of(runs, baseline, event)))
    };
    OptionFinding {
        id: plan.id.clone(),
        name: plan.name.clone(),
        strength_n: plan.strength_n,
        curve: plan.curve.clone(),
        differs_in: plan.differs_in(&opened.options[opened.baseline]),
        invalid: count(|run| !run.valid),
        undecided: count(|run| run.valid && !run.decided && !run.until_parted),
        resolution: ResolutionChecks {
            all: sum(|run| run.resolution_looks),
            missed: sum(|run| run.resolution_missed),
        },
        rates: events.iter().map(|event| (event.name(), Rate::of(&indicators(event)))).collect(),
        against: events.iter().map(paired).collect(),
        adjusted: Vec::new(),
        changes: Changes::of(runs, &plan.id, baseline),
        tensions: Tensions::of(runs, &plan.id, baseline),
        survival: Survival::of(runs, &plan.id),
        strengths: plan.prepared.strengths.iter().map(PartStrength::from).collect(),
        lowest: Lowest::default(),
    }
}

fn levels(
    opened: &PreparedStudy,
    runs: &Runs,
    indicators: &[EventIndicators],
    (ids, baseline): (&[String], usize),
) -> Vec<LevelFinding> {
    let Some(split) = &opened.study.split else { return Vec::new() };
    let Some(column) = runs.drawn(&split.value) else { return Vec::new() };
    let mut levels: Vec<String> = (0..column.len()).map(|row| level(column, row)).collect();
    levels.sort();
    levels.dedup();
    let parted: Vec<EventIndicators> =
        ids.iter().map(|id| EventIndicators::of(runs, id, &StudyEvent::Parted)).collect();
    let finding = |level_name: String| {
        let mut keep = vec![false; EventIndicators::longest(indicators)];
        let rows = runs.rows().iter().enumerate();
        rows.filter(|(row, _)| level(column, *row) == level_name)
            .for_each(|(_, run)| keep[run.index()] = true);
        let own: Vec<EventIndicators> =
            indicators.iter().map(|indicators| indicators.within(&keep)).collect();
        LevelFinding {
            rates: own.iter().map(Rate::of).collect(),
            against: own.iter().map(|indicators| Paired::of(indicators, &own[baseline])).collect(),
            parted: parted.iter().map(|indicators| Rate::of(&indicators.within(&keep))).collect(),
            level: level_words(opened, &split.value, &level_name),
        }
    };
    levels.into_iter().map(finding).collect()
}

/// A level in words, such as `age 15 yr` for its seconds.
fn level_words(opened: &PreparedStudy, prior: &str, level: &str) -> String {
    let prior = opened.study.priors.iter().find(|known| known.name.value == prior);
    let Some(prior) = prior else { return level.to_owned() };
    let value = opened.value_words(prior, level);
    if level.parse::<f64>().is_ok() { format!("{} {value}", prior.words()) } else { value }
}

fn level(column: &Column, row: usize) -> String {
    match column {
        Column::Text(values) => values[row].clone(),
        column => column.written(row),
    }
}
