//! Where the whale is aimed: rope of an option's gear at rest in the sea of an encounter.
//!
//! The gear of an encounter is that of the option with what was drawn for the sea and the gear, and the baseline's whale:
//! so most encounters of an option share one equilibrium.

use std::sync::Arc;

use endline_gear::{Prior, Target};
use endline_sim::{Model, State};

use crate::error::Error;
use crate::source::{Overrides, Source};

use super::open::Opened;
use crate::encounters::Encounter;
use crate::encounters::aim::lines_aimed_at;
use crate::encounters::equilibria::Equilibrium;
use crate::encounters::priors::field_of;

impl Opened {
    /// The gear of an option in equilibrium in the sea of an encounter.
    pub(super) fn equilibrium(
        &self,
        option: usize,
        encounter: &Encounter,
    ) -> Result<Arc<Equilibrium>, Error> {
        self.equilibria.of(self.still_source(option, encounter)?, &self.host)
    }

    /// The option's gear in the encounter's sea, with the whale of the baseline scenario.
    fn still_source(&self, option: usize, encounter: &Encounter) -> Result<Source, Error> {
        let plan = &self.options[option];
        let drawn = self.study.priors.iter().zip(&encounter.drawn);
        let for_gear = drawn.filter(|(prior, _)| is_drawn_for_gear(prior));
        let (scenario, library) = plan.edited(for_gear, moves_gear)?;
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
        let gear = self.equilibrium(option, encounter)?;
        let lines = match lines_aimed_at(&gear.model, &self.study.aim.lines) {
            // Gear of another kind may have no such line: then the whale goes where it would go for the baseline.
            Err(_) if option != self.baseline => {
                return self.aim_at(self.baseline, encounter, depth_m);
            }
            found => found?,
        };
        rope_at(&gear.model, &gear.settled.state, &lines, depth_m).ok_or_else(|| {
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

/// Whether what is drawn matters to gear at rest; folders of the library hold one kind of item each.
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
