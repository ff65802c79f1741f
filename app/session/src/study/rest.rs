//! Gear at rest, found once for each option and tide rather than for each encounter.
//!
//! Statics do not look at the whale. So the gear of an encounter is that of the option with what was drawn for the sea and
//! the gear, and the baseline's whale: its text is the key. [`Settled::with_whale_of`] then brings the encounter's whale.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use endline_gear::{Prior, Target, hint};
use endline_sim::model::JointKind;
use endline_sim::{Model, Settled, State, settle};

use crate::error::Error;
use crate::run::as_placed;
use crate::source::{Overrides, Source};

use super::encounter::{Encounter, field_of, put_drawn};
use super::open::Opened;

/// Gear at rest with the model it belongs to.
pub(super) struct Rest {
    pub model: Arc<Model>,
    pub settled: Arc<Settled>,
}

/// What was settled so far, by the hash of its text.
#[derive(Default)]
pub(super) struct Rests(Mutex<BTreeMap<String, Arc<Rest>>>);

/// Most kept; a study whose gear varies from encounter to encounter begins anew then.
const MOST_KEPT: usize = 64;

impl Opened {
    /// The gear of an option at rest in the sea of an encounter.
    pub(super) fn rest(&self, option: usize, encounter: &Encounter) -> Result<Arc<Rest>, Error> {
        let source = self.still_source(option, encounter)?;
        let key = source.hash();
        let kept = self.rests.0.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        if let Some(rest) = kept {
            return Ok(rest);
        }
        let model = source.prepare(&self.host)?.model;
        let settled = Arc::new(if model.spec.settings.as_placed {
            as_placed(&model)
        } else {
            settle(&model)
        });
        let rest = Arc::new(Rest { model, settled });
        let mut rests = self.rests.0.lock().unwrap_or_else(PoisonError::into_inner);
        if rests.len() >= MOST_KEPT {
            rests.clear();
        }
        rests.insert(key, Arc::clone(&rest));
        Ok(rest)
    }

    /// The option's gear in the encounter's sea, with the whale of the baseline scenario.
    fn still_source(&self, option: usize, encounter: &Encounter) -> Result<Source, Error> {
        let plan = &self.options[option];
        let (mut scenario, mut library) = (plan.scenario.clone(), plan.sources.clone());
        let priors = &self.study.priors;
        let (priors, drawn): (Vec<_>, Vec<_>) = priors
            .iter()
            .cloned()
            .zip(encounter.drawn.iter().cloned())
            .filter(|(prior, _)| is_drawn_for_gear(prior))
            .unzip();
        put_drawn(&mut scenario, &mut library, &priors, &drawn, &plan.own)?;
        let fault = |error: endline_gear::EditError| {
            Error::Replay(format!("option `{}`: {}", plan.id, error.message))
        };
        for field in plan.removes.iter().filter(|field| moves_gear(field)) {
            scenario.remove(field).map_err(fault)?;
        }
        for setting in plan.settings.iter().filter(|setting| moves_gear(&setting.field.value)) {
            scenario.put(&setting.field.value, &setting.value).map_err(fault)?;
        }
        Ok(Source {
            scenario_name: plan.scenario_name.clone(),
            scenario: scenario.text(),
            library,
            overrides: Overrides::default(),
        })
    }

    /// Where rope lies at rest at a depth, east and north [m].
    pub(super) fn aim_at(
        &self,
        option: usize,
        encounter: &Encounter,
        depth_m: f64,
    ) -> Result<[f64; 2], Error> {
        let rest = self.rest(option, encounter)?;
        let wanted = &self.study.aim.lines;
        let line_ids = || rest.model.spec.lines.iter().map(|line| line.id.as_str());
        let mut lines = Vec::new();
        for id in wanted {
            match line_ids().position(|known| known == id.value) {
                Some(line) => lines.push(line),
                // Gear of another kind may have no such line: then the whale goes where it would go for the baseline.
                None if option != self.baseline => {
                    return self.aim_at(self.baseline, encounter, depth_m);
                }
                None => {
                    let message = format!("the baseline's gear has no line `{}`", id.value);
                    return Err(Error::Diagnostics(vec![
                        id.place.error(message, hint(&id.value, line_ids())),
                    ]));
                }
            }
        }
        if wanted.is_empty() {
            lines = (0..rest.model.spec.lines.len()).collect();
        }
        rope_at(&rest.model, &rest.settled.state, &lines, depth_m).ok_or_else(|| {
            Error::Replay(
                "the gear has no rope to aim at; name lines in `aim` of [encounter]".into(),
            )
        })
    }
}

/// Whether a field of the scenario matters to gear at rest: those of the whale and of its friction do not.
fn moves_gear(field: &str) -> bool {
    !["whale.", "friction."].iter().any(|whale| field.starts_with(whale))
}

/// The same of what is drawn; folders of the library hold one kind of item each.
fn is_drawn_for_gear(prior: &Prior) -> bool {
    match &prior.target {
        Target::Library(file, _) => {
            !["whales/", "friction/", "acts/"].iter().any(|folder| file.starts_with(folder))
        }
        _ => moves_gear(field_of(prior)),
    }
}

/// Where the first of these lines passes a depth; else the node nearest to it.
fn rope_at(model: &Model, state: &State, lines: &[usize], depth_m: f64) -> Option<[f64; 2]> {
    let mut nearest: Option<(f64, [f64; 2])> = None;
    for line in lines {
        let nodes = &state.rope.position[model.line_nodes[*line].clone()];
        for pair in nodes.windows(2) {
            let [above, below] = [pair[0].z + depth_m, pair[1].z + depth_m];
            if (above < 0.0) != (below < 0.0) {
                let place = pair[0].lerp(pair[1], above / (above - below));
                return Some([place.x, place.y]);
            }
        }
        for node in nodes {
            let off = (node.z + depth_m).abs();
            if nearest.is_none_or(|(least, _)| off < least) {
                nearest = Some((off, [node.x, node.y]));
            }
        }
    }
    nearest.map(|(_, place)| place)
}

/// The gear at rest for an encounter's own model; settled anew where the two do not fit.
pub(super) fn fitted(rest: &Rest, model: &Model) -> Arc<Settled> {
    let fast_to_whale =
        model.spec.joints.iter().any(|joint| matches!(joint.kind, JointKind::Whale(_)));
    let fits = rest.model.node_count == model.node_count
        && rest.model.spec.bodies.len() == model.spec.bodies.len();
    match (fits && !fast_to_whale, model.spec.settings.as_placed) {
        (true, _) => Arc::new(rest.settled.with_whale_of(model)),
        (false, true) => Arc::new(as_placed(model)),
        (false, false) => Arc::new(settle(model)),
    }
}
