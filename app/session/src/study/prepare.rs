//! An option in an encounter: drawn values set in its scenario, the whale aimed at rope, all assembled; on a finer resolution too.

use std::sync::Arc;

use endline_gear::{Document, Setting, Sources, units};

use crate::encounters::Encounter;
use crate::encounters::aim::{lines_aimed_at, rope_along, rope_at, start_m};
use crate::encounters::equilibria::{Equilibrium, is_drawn_for_gear, moves_gear};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{Prepared, Source};

use super::exposure::{Met, leave_only};
use super::plan::OptionPlan;
use super::play::Played;
use super::prepared::PreparedStudy;

/// Length of a whale for which neither study nor scenario names one [m].
const USUAL_LENGTH_M: f64 = 12.0;

/// Lengths and times of a scenario that a finer resolution halves.
const HALVED: [(&str, units::Quantity); 5] = [
    ("segment", units::Quantity::Length),
    ("resolution.near", units::Quantity::Length),
    ("resolution.edges", units::Quantity::Length),
    ("resolution.far", units::Quantity::Length),
    ("step", units::Quantity::Time),
];

impl PreparedStudy {
    /// An option in an encounter, ready to run.
    /// Errors: faults of the scenario so made, or gear that cannot be aimed at.
    pub fn prepare(&self, option: usize, encounter: &Encounter) -> Result<Prepared, Error> {
        let plan = &self.options[option];
        let drawn = self.study.priors.iter().zip(&encounter.drawn);
        let (mut scenario, sources) = plan.edited(drawn, |_| true)?;
        self.place_whale(option, encounter, &mut scenario)
            .map_err(|error| self.of_encounter(plan, encounter, error))?;
        let name = format!(
            "{} ({} {} of {})",
            plan.scenario_name, plan.id, encounter.index, self.study.id
        );
        Source::new(name, scenario.text(), sources)
            .prepare_for_study(&self.host)
            .map_err(|error| self.of_encounter(plan, encounter, error))
    }

    fn of_encounter(&self, plan: &OptionPlan, encounter: &Encounter, error: Error) -> Error {
        Error::Message(format!(
            "{}: encounter {}, option `{}`: {error}",
            self.study.place.source.path, encounter.index, plan.id
        ))
    }

    /// Aims the whale at rope and gives the run a seed of its own.
    fn place_whale(
        &self,
        option: usize,
        encounter: &Encounter,
        scenario: &mut Document,
    ) -> Result<(), Error> {
        scenario.put("seed", &Setting::plain(&(u64::from(encounter.index) + 1).to_string()))?;
        if self.study.exposure.is_some() {
            return self.place_on_track(option, encounter, scenario);
        }
        let places = |name: &str| matches!(name, "along" | "depth" | "heading" | "offset");
        if !self.study.priors.iter().any(|prior| places(&prior.name.value)) {
            return Ok(());
        }
        let aimed = if self.study.aim.own { option } else { self.baseline };
        let depth_m = value(scenario, "whale.depth", units::Quantity::Length).unwrap_or_default();
        let aim_m = self.aim_at(aimed, encounter, depth_m)?;
        let toward = value(scenario, "current.toward", units::Quantity::Angle)
            .unwrap_or(std::f64::consts::FRAC_PI_2);
        let chosen = self.options[option].own.iter().any(|field| field == "whale.heading");
        let heading =
            encounter.number("heading").filter(|_| !chosen).map(|heading| toward + heading);
        let bearing = heading
            .or_else(|| value(scenario, "whale.heading", units::Quantity::Angle))
            .unwrap_or(std::f64::consts::FRAC_PI_2);
        let back_m = self.study.aim.gap_m + 0.5 * self.length_m(scenario);
        let aside_m = encounter.number("offset").unwrap_or_default();
        let position = start_m(aim_m, bearing, [back_m, aside_m]);
        scenario.put("whale.heading", &Setting::text(&format!("{bearing} rad")))?;
        let position = Setting::texts(&position.map(|metres| format!("{metres} m")));
        Ok(scenario.put("whale.position", &position)?)
    }

    /// Places the whale on its track before the gear that it meets, and leaves this gear alone.
    /// Errors: a track that meets no gear.
    fn place_on_track(
        &self,
        option: usize,
        encounter: &Encounter,
        scenario: &mut Document,
    ) -> Result<(), Error> {
        let met = self.met(option, encounter)?;
        let back_m = self.study.aim.gap_m + 0.5 * self.length_m(scenario);
        let at = |axis: usize| format!("{} m", met.place_m[axis] - back_m * met.ahead[axis]);
        leave_only(scenario, &self.options[option].places[met.gear])?;
        scenario.put("whale.heading", &Setting::text(&format!("{} rad", met.bearing)))?;
        scenario.put("whale.depth", &Setting::text(&format!("{} m", met.depth_m)))?;
        Ok(scenario.put("whale.position", &Setting::texts(&[at(0), at(1)]))?)
    }

    /// The gear that is met in an encounter of a study with `[exposure]`.
    /// Errors: a track that meets no gear.
    fn met(&self, option: usize, encounter: &Encounter) -> Result<Met, Error> {
        let crossing = self.crossing(option, encounter)?;
        let way_m = crossing.as_ref().map_or(0.0, |crossing| crossing.way_m);
        crossing.and_then(|crossing| crossing.met).ok_or_else(|| {
            Error::Message(format!("no gear is met on the track of {:.1} km", 1e-3 * way_m))
        })
    }

    /// Length of the scenario's whale [m].
    fn length_m(&self, scenario: &Document) -> f64 {
        let item = scenario
            .get("whale.item")
            .and_then(|id| self.library.whales.iter().find(|whale| whale.entry.id == id));
        let by_age = value(scenario, "whale.age", units::Quantity::Time)
            .and_then(|age_s| Some(item?.growth.age?.length_m(age_s)));
        let named = value(scenario, "whale.length", units::Quantity::Length);
        named.or(by_age).or(item.map(|item| item.form.length_m)).unwrap_or(USUAL_LENGTH_M)
    }

    /// The gear of an option in equilibrium in the sea of an encounter.
    pub(super) fn equilibrium(
        &self,
        option: usize,
        encounter: &Encounter,
    ) -> Result<Arc<Equilibrium>, Error> {
        if self.study.exposure.is_some() {
            let met = self.met(option, encounter)?;
            let place = &self.options[option].places[met.gear];
            return self.equilibrium_of_gear(option, encounter, place);
        }
        let (scenario, library) = self.gear_of(option, encounter)?;
        let source = Source::new(&self.options[option].scenario_name, scenario.text(), library);
        self.equilibria.of(source, &self.host)
    }

    /// The option's gear in the encounter's sea, with the whale of the baseline scenario.
    pub(super) fn gear_of(
        &self,
        option: usize,
        encounter: &Encounter,
    ) -> Result<(Document, Sources), Error> {
        let drawn = self.study.priors.iter().zip(&encounter.drawn);
        let for_gear = drawn.filter(|(prior, _)| is_drawn_for_gear(prior));
        self.options[option].edited(for_gear, moves_gear)
    }

    /// East and north of rope at rest: at the share `along` of the lines aimed at, if the study draws it, else at a depth [m].
    fn aim_at(
        &self,
        option: usize,
        encounter: &Encounter,
        depth_m: f64,
    ) -> Result<[f64; 2], Error> {
        let gear = self.equilibrium(option, encounter)?;
        let lines = match lines_aimed_at(&gear.model, &self.study.aim.lines) {
            // Gear of another kind may have no such line: the whale then starts as for the baseline.
            Err(_) if option != self.baseline => {
                return self.aim_at(self.baseline, encounter, depth_m);
            }
            found => found?,
        };
        let (model, state) = (&gear.model, &gear.settled.state);
        let place = match encounter.number("along") {
            Some(share) => rope_along(model, state, &lines, share),
            None => rope_at(model, state, &lines, depth_m),
        };
        place.ok_or_else(|| {
            Error::Message(
                "the gear has no rope to aim at; name lines in `aim` of [encounter]".into(),
            )
        })
    }
}

/// A prepared run for a window, with a duration of `end_s` [s].
/// Errors: where the scenario cannot be assembled.
pub(crate) fn until(prepared: &Prepared, end_s: f64, host: &PluginHost) -> Result<Prepared, Error> {
    let mut source = (*prepared.source).clone();
    let mut scenario = Document::parse(&source.scenario)?;
    scenario.put("duration", &Setting::text(&format!("{end_s} s")))?;
    source.scenario = scenario.text();
    source.prepare(host)
}

impl PreparedStudy {
    /// Plays an option in an encounter on a finer resolution than its scenario's.
    /// Errors: as [`play`](Self::play).
    pub fn play_finer(&self, option: usize, encounter: &Encounter) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
        let source = Source { scenario: finer(&prepared)?, ..(*prepared.source).clone() };
        let prepared = source.prepare_for_study(&self.host)?;
        self.play_prepared(option, encounter, prepared, 0.0, |_| {})
    }
}

/// The scenario with twice the nodes, half the lengths and half the steps.
fn finer(prepared: &Prepared) -> Result<String, Error> {
    let mut scenario = Document::parse(&prepared.source.scenario)?;
    for (field, quantity) in HALVED {
        if let Some(now) = value(&scenario, field, quantity) {
            let unit = if quantity == units::Quantity::Time { "s" } else { "m" };
            scenario.put(field, &Setting::text(&format!("{} {unit}", 0.5 * now)))?;
        }
    }
    if let Some(nodes) = scenario.get("rope_nodes").and_then(|nodes| nodes.parse::<u64>().ok()) {
        scenario.put("rope_nodes", &Setting::plain(&(2 * nodes).to_string()))?;
    }
    let step_s = 0.5 * prepared.model.spec.settings.contact_step_s;
    scenario.put("contact_step", &Setting::text(&format!("{step_s} s")))?;
    Ok(scenario.text())
}

/// A value of a scenario [SI].
fn value(scenario: &Document, field: &str, quantity: units::Quantity) -> Option<f64> {
    units::parse(&scenario.get(field)?, quantity).ok()
}
