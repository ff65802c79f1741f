//! An encounter on a finer resolution: rope segments of half the length, and half the step in contact.
//!
//! What only happens at one resolution hangs on the computation, and not on the encounter.

use endline_gear::{Document, EditError, Setting, units};

use crate::error::Error;
use crate::source::{Prepared, Source};

use super::open::Opened;
use super::play::Played;
use super::prepare::value;
use crate::encounters::Encounter;

/// Lengths and times of a scenario that are halved, where it has them.
const HALVED: [(&str, units::Quantity); 5] = [
    ("segment", units::Quantity::Length),
    ("resolution.near", units::Quantity::Length),
    ("resolution.edges", units::Quantity::Length),
    ("resolution.far", units::Quantity::Length),
    ("step", units::Quantity::Time),
];

impl Opened {
    /// Plays an option in an encounter on a finer resolution than its scenario's.
    ///
    /// # Errors
    /// As [`play`](Self::play).
    pub fn play_finer(&self, option: usize, encounter: &Encounter) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
        let source = Source { scenario: finer(&prepared)?, ..(*prepared.source).clone() };
        let prepared = source.prepare_for_study(&self.host)?;
        self.play_prepared(option, encounter, prepared, 0.0, |_| {})
    }
}

/// The scenario with twice the nodes, half the lengths and half the steps.
fn finer(prepared: &Prepared) -> Result<String, Error> {
    let fault = |error: EditError| Error::Replay(error.message);
    let mut scenario = Document::parse(&prepared.source.scenario).map_err(fault)?;
    for (field, quantity) in HALVED {
        if let Some(now) = value(&scenario, field, quantity) {
            let unit = if quantity == units::Quantity::Time { "s" } else { "m" };
            scenario.put(field, &Setting::text(&format!("{} {unit}", 0.5 * now))).map_err(fault)?;
        }
    }
    if let Some(nodes) = scenario.get("rope_nodes").and_then(|nodes| nodes.parse::<u64>().ok()) {
        scenario.put("rope_nodes", &Setting::plain(&(2 * nodes).to_string())).map_err(fault)?;
    }
    let step_s = 0.5 * prepared.model.spec.settings.contact_step_s;
    scenario.put("contact_step", &Setting::text(&format!("{step_s} s"))).map_err(fault)?;
    Ok(scenario.text())
}
