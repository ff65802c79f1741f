//! An option prepared for an encounter: what was drawn set in its scenario, with the whale aimed at rope.
//!
//! The snout starts `gap` short of the aim along the whale's bearing and `offset` to starboard of it: with the unit vectors
//! `f` ahead and `s` to starboard, mid-body is at `aim - (gap + L/2) f + offset s`, at the depth drawn, for a whale of length L.
//! The aim is where the line lies at rest at that depth. Bearings count from where the current flows: 0 goes with the tide.

use endline_gear::{Document, EditError, Setting, units};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{Overrides, Prepared, Source};

use super::open::Opened;
use super::plan::OptionPlan;
use crate::encounters::Encounter;

/// Length of a whale of which neither study nor scenario says anything [m].
const USUAL_LENGTH_M: f64 = 12.0;

impl Opened {
    /// An option in an encounter, ready to run.
    ///
    /// # Errors
    /// Faults of the scenario so made, or gear that cannot be aimed at.
    pub fn prepare(&self, option: usize, encounter: &Encounter) -> Result<Prepared, Error> {
        let plan = &self.options[option];
        let drawn = self.study.priors.iter().zip(&encounter.drawn);
        let (mut scenario, sources) = plan.edited(drawn, |_| true)?;
        self.place_whale(option, encounter, &mut scenario)
            .map_err(|error| self.of_encounter(plan, encounter, error))?;
        let source = Source {
            scenario_name: format!(
                "{} ({} {} of {})",
                plan.scenario_name, plan.id, encounter.index, self.study.id
            ),
            scenario: scenario.text(),
            library: sources,
            overrides: Overrides::default(),
        };
        source
            .prepare_for_study(&self.host)
            .map_err(|error| self.of_encounter(plan, encounter, error))
    }

    fn of_encounter(&self, plan: &OptionPlan, encounter: &Encounter, error: Error) -> Error {
        Error::Replay(format!(
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
        let fault = |error: EditError| Error::Replay(error.message);
        scenario
            .put("seed", &Setting::plain(&(u64::from(encounter.index) + 1).to_string()))
            .map_err(fault)?;
        if !self
            .study
            .priors
            .iter()
            .any(|prior| matches!(prior.name.value.as_str(), "depth" | "heading" | "offset"))
        {
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
        let (east, north) = (libm::sin(bearing), libm::cos(bearing));
        let position = [
            aim_m[0] - back_m * east + aside_m * north,
            aim_m[1] - back_m * north - aside_m * east,
        ];
        scenario.put("whale.heading", &Setting::text(&format!("{bearing} rad"))).map_err(fault)?;
        scenario
            .put("whale.position", &Setting::texts(&position.map(|metres| format!("{metres} m"))))
            .map_err(fault)
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
}

/// The same run for a window, up to a time at which it is over [s].
///
/// # Errors
/// Where the scenario cannot be assembled.
pub(crate) fn until(prepared: &Prepared, end_s: f64, host: &PluginHost) -> Result<Prepared, Error> {
    let failed = |error: EditError| Error::Replay(error.message);
    let mut source = (*prepared.source).clone();
    let mut scenario = Document::parse(&source.scenario).map_err(failed)?;
    scenario.put("duration", &Setting::text(&format!("{end_s} s"))).map_err(failed)?;
    source.scenario = scenario.text();
    source.prepare(host)
}

/// A value of a scenario [SI].
pub(super) fn value(scenario: &Document, field: &str, quantity: units::Quantity) -> Option<f64> {
    units::parse(&scenario.get(field)?, quantity).ok()
}
