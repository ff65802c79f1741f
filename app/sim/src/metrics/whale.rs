//! What the rope did to the whale.

use std::sync::Arc;

use endline_sdk::BodyPart;

use super::drag::{EffortMeter, added_drag};
use super::event::{EventKind, Log};
use super::extent::Extent;
use super::flukes::FlukeMeter;
use super::outcome::Encounter;
use super::regions::Loads;
use super::strands::Strands;
use super::summary::{RegionSummary, WhaleSummary};
use super::touches::Touches;
use super::trailing::Reach;
use super::winding::Winding;
use super::window::Window;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::whale::Skin;

/// All measures of the whale.
#[derive(Clone, Debug)]
pub(super) struct WhaleMeter {
    skin: Arc<Skin>,
    winding: Winding,
    loads: Loads,
    drag: Window<1>,
    effort: Option<EffortMeter>,
    encounter: Encounter,
    reach: Reach,
    extent: Extent,
    touches: Touches,
    flukes: FlukeMeter,
}

impl WhaleMeter {
    pub(super) fn new(model: &Model) -> Option<Self> {
        let whale = model.spec.whale.as_ref()?;
        let skin = Arc::clone(&whale.skin);
        Some(Self {
            winding: Winding::new(&skin, Strands::new(model)),
            loads: Loads::default(),
            drag: Window::new(model),
            effort: EffortMeter::new(model),
            encounter: Encounter::default(),
            reach: Reach::new(model),
            extent: Extent::new(&skin),
            touches: Touches::default(),
            flukes: FlukeMeter::new(&skin, whale.length_m),
            skin,
        })
    }

    pub(super) fn fold(&mut self, model: &Model, state: &State, whale: &WhaleState, contacts: &[ContactPoint], dt_s: f64, log: &mut Log) {
        let touching = contacts.iter().any(|contact| contact.normal_force_n > 0.0);
        self.loads.fold(model, contacts, dt_s);
        self.winding.fold(&self.skin, contacts, &state.rope);
        self.drag.fold([added_drag(model, state, whale, contacts)], dt_s);
        if let Some(effort) = &mut self.effort {
            effort.fold(whale, dt_s);
        }
        self.reach.fold(model, state, contacts);
        self.encounter.fold(state.time_s, dt_s, touching, self.winding.most());
        self.extent.fold(model, whale, state.time_s, log);
        self.touches.fold(&self.loads, state.time_s, log);
        self.flukes.fold(whale, state.time_s, dt_s);
        self.tell_wraps(state.time_s, log);
    }

    pub(super) fn summary(&self, model: &Model, state: &State) -> WhaleSummary {
        let (outcome, decided) = self.encounter.outcome(state);
        let beyond = self.reach.beyond(model, state);
        WhaleSummary {
            outcome,
            decided,
            first_contact_s: self.encounter.first_s,
            last_contact_s: self.encounter.last_s,
            contact_time_s: self.encounter.contact_time_s,
            regions: BodyPart::ALL.iter().map(|part| self.region(*part)).collect(),
            drag_added_n: self.drag.mean()[0],
            drag_added_now_n: self.drag.now[0],
            trailing_m: beyond.trailing_m,
            tethered_m: beyond.tethered_m,
            beat: self.flukes.summary(),
            kinetic: self.effort.as_ref().map(EffortMeter::summary),
            winding_jumps: self.winding.jumps,
        }
    }

    fn region(&self, part: BodyPart) -> RegionSummary {
        let load = self.loads.parts[part as usize];
        RegionSummary {
            part,
            wraps: libm::fabs(self.winding.turns[part as usize]),
            peak_wraps: load.peak_wraps,
            contact_length_m: load.length_m,
            peak_contact_length_m: load.peak_length_m,
            peak_normal_n: load.peak_normal_n,
            peak_pressure_pa: load.peak_pressure_pa,
            friction_work_j: load.work_j,
        }
    }

    /// Tells of every level that wraps pass for the first time: a half, then whole turns.
    fn tell_wraps(&mut self, time_s: f64, log: &mut Log) {
        for ((part, load), turns) in BodyPart::ALL.iter().zip(&mut self.loads.parts).zip(&self.winding.turns) {
            let wraps = libm::fabs(*turns);
            while next_level(load.peak_wraps) <= wraps {
                load.peak_wraps = next_level(load.peak_wraps);
                log.note(time_s, EventKind::Wrap, part.name(), load.peak_wraps);
            }
            load.peak_wraps = load.peak_wraps.max(wraps);
        }
    }
}

/// The least level of wraps above a number of turns: 0.5, 1, 2, 3 and so on.
fn next_level(turns: f64) -> f64 {
    if turns < 0.5 { 0.5 } else { libm::floor(turns) + 1.0 }
}
