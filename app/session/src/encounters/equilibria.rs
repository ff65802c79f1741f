//! Gear in equilibrium, settled once for each text of scenario and library rather than for each encounter.
//!
//! Statics do not look at the whale: [`Settled::with_whale_of`] brings the encounter's whale afterwards.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use endline_sim::model::JointKind;
use endline_sim::{Model, Settled, settle};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::run::as_placed;
use crate::source::Source;

/// Gear in equilibrium with the model it belongs to.
pub(crate) struct Equilibrium {
    pub model: Arc<Model>,
    pub settled: Arc<Settled>,
}

/// What was settled so far, by the hash of its source.
#[derive(Default)]
pub(crate) struct Equilibria(Mutex<BTreeMap<String, Arc<Equilibrium>>>);

/// Most kept; a study whose gear varies from encounter to encounter begins anew then.
const MOST_KEPT: usize = 64;

impl Equilibria {
    /// The gear of a source in equilibrium, settled where it was not yet.
    ///
    /// # Errors
    /// Faults of the source.
    pub(crate) fn of(&self, source: Source, host: &PluginHost) -> Result<Arc<Equilibrium>, Error> {
        let key = source.hash();
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        if let Some(kept) = kept {
            return Ok(kept);
        }
        let model = source.prepare_for_study(host)?.model;
        let settled = Arc::new(if model.spec.settings.as_placed {
            as_placed(&model)
        } else {
            settle(&model)
        });
        let found = Arc::new(Equilibrium { model, settled });
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() >= MOST_KEPT {
            kept.clear();
        }
        kept.insert(key, Arc::clone(&found));
        Ok(found)
    }
}

/// The gear in equilibrium for an encounter's own model; settled anew where the two do not fit.
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
