//! An encounter: what was drawn, set in an option's scenario, with the whale aimed at rope.
//!
//! The snout starts `gap` short of the aim along the whale's bearing and `offset` to starboard of it: with the unit vectors
//! `f` ahead and `s` to starboard, mid-body is at `aim - (gap + L/2) f + offset s`, at the depth drawn, for a whale of length L.
//! The aim is where the line lies at rest at that depth. Bearings count from where the current flows: 0 goes with the tide.

use endline_gear::{Document, EditError, Prior, Setting, Sources, Target, units};

use crate::error::Error;
use crate::source::{Overrides, Prepared, Source};

use super::draw::{self, Drawn};
use super::open::{Opened, OptionPlan};

/// Length of a whale of which neither study nor scenario says anything [m].
const USUAL_LENGTH_M: f64 = 12.0;

/// An encounter drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Encounter {
    /// Its index.
    pub index: u32,
    /// What was drawn, by name.
    pub drawn: Vec<Drawn>,
}

impl Encounter {
    /// Draws encounter `index` of a study.
    #[must_use]
    pub fn of(opened: &Opened, index: u32) -> Self {
        Self { index, drawn: draw::draw(&opened.study.priors, opened.study.seed, index) }
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.drawn.iter().find(|drawn| drawn.name == name).and_then(|drawn| drawn.number)
    }
}

/// The field of the scenario or library item that a prior sets in the first place.
pub(super) fn field_of(prior: &Prior) -> &str {
    match &prior.target {
        Target::Scenario(field) | Target::Library(_, field) => field,
        Target::Known => known_field(&prior.name.value).unwrap_or("whale.position"),
    }
}

/// The same as an option would name it.
fn path_of(prior: &Prior) -> String {
    if let Target::Library(..) = prior.target {
        prior.name.value.clone()
    } else {
        field_of(prior).to_owned()
    }
}

/// The scenario field of a known prior; `None` where it is not one field.
fn known_field(name: &str) -> Option<&'static str> {
    Some(match name {
        "age" => "whale.age",
        "answer" => "whale.answer_to_touch",
        "answer_above" => "whale.answer_above",
        "behaviour" => "whale.pilot.0.act",
        "condition" => "whale.condition",
        "depth" => "whale.depth",
        "flipper_raise" => "whale.pilot.0.flipper_raise",
        "flipper_sweep" => "whale.pilot.0.flipper_sweep",
        "flipper_twist" => "whale.pilot.0.flipper_twist",
        "gape" => "whale.pilot.0.mouth",
        "length" => "whale.length",
        "pitch" => "whale.pitch",
        "roll" => "whale.roll",
        "speed" => "whale.speed",
        "tide" => "current.speed",
        _ => return None,
    })
}

/// Puts what was drawn into a scenario and library, but for fields that the option itself sets and for the whale's place.
pub(super) fn put_drawn(
    scenario: &mut Document,
    sources: &mut Sources,
    priors: &[Prior],
    drawn: &[Drawn],
    own: &[String],
) -> Result<(), Error> {
    for (prior, drawn) in
        priors.iter().zip(drawn).filter(|(prior, _)| !own.contains(&path_of(prior)))
    {
        put_one(scenario, sources, prior, drawn)
            .map_err(|error| Error::Diagnostics(vec![prior.name.place.error(error.message, "")]))?;
    }
    Ok(())
}

fn put_one(
    scenario: &mut Document,
    sources: &mut Sources,
    prior: &Prior,
    drawn: &Drawn,
) -> Result<(), EditError> {
    match &prior.target {
        Target::Scenario(field) => scenario.put(field, &drawn.setting()),
        Target::Library(file, field) => {
            let missing = EditError { message: format!("the library has no file {file}") };
            let mut item = Document::parse(sources.get(file).ok_or(missing)?)?;
            item.put(field, &drawn.setting())?;
            let text = item.text();
            sources.set(file.clone(), text);
            Ok(())
        }
        Target::Known => put_known(scenario, drawn),
    }
}

fn put_known(scenario: &mut Document, drawn: &Drawn) -> Result<(), EditError> {
    let Some(field) = known_field(&drawn.name) else { return Ok(()) };
    if field.starts_with("whale.pilot.0.") && !scenario.has("whale.pilot.0") {
        scenario.put("whale.pilot.0.at", &Setting::text("0 s"))?;
        scenario.put("whale.pilot.0.speed", &Setting::number(1.0))?;
    }
    match (drawn.name.as_str(), drawn.text.as_str()) {
        ("behaviour", "swim") => return forget(scenario, field),
        ("answer", "none") => return forget(scenario, field),
        ("age", _) => forget(scenario, "whale.length")?,
        ("length", _) => forget(scenario, "whale.age")?,
        ("speed", _) => scenario.put("whale.attributes.cruise_speed", &drawn.setting())?,
        _ => {}
    }
    scenario.put(field, &drawn.setting())
}

fn forget(scenario: &mut Document, field: &str) -> Result<(), EditError> {
    if scenario.has(field) { scenario.remove(field) } else { Ok(()) }
}

impl Opened {
    /// The scenario and library of an option in an encounter, but for the whale's place.
    pub(super) fn drawn_source(
        &self,
        option: &OptionPlan,
        encounter: &Encounter,
    ) -> Result<(Document, Sources), Error> {
        let (mut scenario, mut sources) = (option.scenario.clone(), option.sources.clone());
        put_drawn(&mut scenario, &mut sources, &self.study.priors, &encounter.drawn, &option.own)?;
        let fault =
            |error: EditError| Error::Replay(format!("option `{}`: {}", option.id, error.message));
        for field in &option.removes {
            scenario.remove(field).map_err(fault)?;
        }
        for setting in &option.settings {
            scenario.put(&setting.field.value, &setting.value).map_err(fault)?;
        }
        Ok((scenario, sources))
    }

    /// An option in an encounter, ready to run.
    ///
    /// # Errors
    /// Faults of the scenario so made, or gear that cannot be aimed at.
    pub fn prepare(&self, option: usize, encounter: &Encounter) -> Result<Prepared, Error> {
        let plan = &self.options[option];
        let (mut scenario, sources) = self.drawn_source(plan, encounter)?;
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
        source.prepare(&self.host).map_err(|error| self.of_encounter(plan, encounter, error))
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

/// A value of a scenario [SI].
fn value(scenario: &Document, field: &str, quantity: units::Quantity) -> Option<f64> {
    units::parse(&scenario.get(field)?, quantity).ok()
}
