//! Gear at rest in the sea of an encounter, settled once for each text of scenario and library rather than for each encounter.
//!
//! The whale does not affect statics: [`Settled::with_whale_of`] adds the encounter's whale afterwards. The gear of an encounter is
//! that of the option with the values drawn for sea and gear, so that most encounters of an option share one equilibrium.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use endline_gear::{Prior, Target};
use endline_sim::model::JointKind;
use endline_sim::{Model, Settled, settle};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::run::as_placed;
use crate::source::Source;
use crate::task::lock;

use super::priors::field_of;

/// Gear in equilibrium with the model it belongs to.
pub(crate) struct Equilibrium {
    pub model: Arc<Model>,
    pub settled: Arc<Settled>,
}

/// Equilibria by the hash of their source.
#[derive(Default)]
pub(crate) struct Equilibria(Mutex<BTreeMap<String, Arc<Equilibrium>>>);

/// Greatest number of stored equilibria. A study whose gear varies from encounter to encounter exceeds it; all are then dropped.
const MOST_STORED: usize = 64;

impl Equilibria {
    /// The gear of a source in equilibrium, settled unless it is stored.
    pub(crate) fn of(&self, source: Source, host: &PluginHost) -> Result<Arc<Equilibrium>, Error> {
        let key = source.hash();
        let stored = lock(&self.0).get(&key).cloned();
        if let Some(stored) = stored {
            return Ok(stored);
        }
        let model = source.prepare_for_study(host)?.model;
        let settled = Arc::new(if model.spec.settings.as_placed {
            as_placed(&model)
        } else {
            settle(&model)
        });
        let found = Arc::new(Equilibrium { model, settled });
        let mut stored = lock(&self.0);
        if stored.len() >= MOST_STORED {
            stored.clear();
        }
        stored.insert(key, Arc::clone(&found));
        Ok(found)
    }
}

/// The gear in equilibrium for an encounter's own model; settled again if the two differ in nodes or bodies.
pub(crate) fn fitted(equilibrium: &Equilibrium, model: &Model) -> Arc<Settled> {
    let fast_to_whale =
        model.spec.joints.iter().any(|joint| matches!(joint.kind, JointKind::Whale(_)));
    let fits = equilibrium.model.node_count == model.node_count
        && equilibrium.model.spec.bodies.len() == model.spec.bodies.len();
    match (fits && !fast_to_whale, model.spec.settings.as_placed) {
        (true, _) => Arc::new(equilibrium.settled.with_whale_of(model)),
        (false, true) => Arc::new(as_placed(model)),
        (false, false) => Arc::new(settle(model)),
    }
}

/// Whether a field of the scenario affects gear at rest: those of the whale and of its friction do not.
pub(crate) fn moves_gear(field: &str) -> bool {
    !["whale.", "friction."].iter().any(|whale| field.starts_with(whale))
}

/// Whether a prior affects gear at rest; each folder of the library holds one kind of item.
pub(crate) fn is_drawn_for_gear(prior: &Prior) -> bool {
    match &prior.target {
        Target::Library(file, _) => {
            !["whales/", "friction/", "acts/"].iter().any(|folder| file.starts_with(folder))
        }
        _ => moves_gear(field_of(prior)),
    }
}
