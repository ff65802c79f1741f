//! What the rope did to the whale.

use std::sync::Arc;

use endline_sdk::BodyPart;

use super::drag::{EffortMeter, added_drag};
use super::event::{EventKind, Log};
use super::extent::Extent;
use super::flukes::FlukeMeter;
use super::gear_loads::on_line;
use super::made_good::MadeGood;
use super::mouth::{Mouth, inside_of_mouth};
use super::outcome::Encounter;
use super::press::PressMeter;
use super::regions::Loads;
use super::summary::{BodySummary, RegionSummary, WhaleSummary};
use super::touches::Touches;
use super::trailing::Reach;
use super::twist::TwistMeter;
use super::unchanged::{Hold, Unchanged};
use super::winding::Winding;
use super::window::Window;
use super::wraps::WrapMeter;
use crate::contact::rope_on_skin::step_sums::SkinContact;
use crate::model::Model;
use crate::state::State;
use crate::strands::Strands;
use crate::whale::Skin;

/// Wraps must fall this far below a level to be reported as undone [turns]; estimate.
const UNDONE_TURNS: f64 = 0.15;

/// All measures of the whale.
#[derive(Clone, Debug)]
pub(super) struct WhaleMeter {
    skin: Arc<Skin>,
    winding: Winding,
    wraps: WrapMeter,
    twists: TwistMeter,
    mouth: Mouth,
    /// Normal and friction forces on each line now [N].
    on_lines: Vec<[f64; 2]>,
    loads: Loads,
    press: PressMeter,
    drag: Window<1>,
    effort: Option<EffortMeter>,
    made_good: MadeGood,
    encounter: Encounter,
    reach: Reach,
    extent: Extent,
    touches: Touches,
    flukes: FlukeMeter,
    unchanged: Unchanged,
}

impl WhaleMeter {
    pub(super) fn new(model: &Model) -> Option<Self> {
        let whale = model.spec.whale.as_ref()?;
        let skin = Arc::clone(&whale.skin);
        let inside = inside_of_mouth(&skin);
        let strands = Strands::new(model);
        Some(Self {
            wraps: WrapMeter::new(&skin, &strands),
            twists: TwistMeter::new(&strands),
            mouth: Mouth::new(Arc::clone(&inside)),
            on_lines: vec![[0.0; 2]; model.spec.lines.len()],
            winding: Winding::new(&skin, strands),
            loads: Loads::default(),
            press: PressMeter::new(inside),
            drag: Window::new(model),
            effort: EffortMeter::new(model),
            made_good: MadeGood::default(),
            encounter: Encounter::default(),
            reach: Reach::new(model),
            extent: Extent::new(&skin),
            touches: Touches::default(),
            flukes: FlukeMeter::new(&skin, whale.length_m),
            unchanged: Unchanged::default(),
            skin,
        })
    }

    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        SkinContact { contacts, sums }: SkinContact<'_>,
        dt_s: f64,
        log: &mut Log,
    ) {
        let Some(whale) = &state.whale else { return };
        let touching = contacts.iter().any(|contact| contact.normal_force_n > 0.0);
        self.loads.fold(model, state, contacts, sums);
        self.press.fold(model, state, contacts, dt_s);
        self.winding.fold(&self.skin, contacts, &state.rope);
        self.wraps.fold(model, state, whale, &self.winding.strands, contacts);
        self.twists.fold(model, state, &self.winding.strands, contacts);
        self.mouth.fold(&self.skin, contacts, state.time_s, log);
        for (line, sums) in self.on_lines.iter_mut().enumerate() {
            *sums = on_line(contacts, line);
        }
        self.drag.fold([added_drag(model, state, whale, sums.force_n())], dt_s);
        if let Some(effort) = &mut self.effort {
            effort.fold(whale, dt_s);
        }
        self.made_good.fold(state.time_s, whale.position);
        self.reach.fold(model, state, contacts);
        self.extent.fold(model, whale, state.time_s, log);
        self.touches.fold(&self.loads, state.time_s, log);
        self.flukes.fold(whale, state.time_s, dt_s);
        self.tell_wraps(state.time_s, log);
        let most = self.winding.most().max(self.wraps.most());
        self.encounter.fold(state.time_s, dt_s, touching, most, log);
        let hold = Hold {
            held: self.encounter.holds(),
            lodged: self.mouth.lodged,
            turns: self.wraps.turns.map(libm::fabs),
        };
        self.unchanged.fold(state, hold);
    }

    /// Normal and friction forces on a line now [N].
    pub(super) fn on_line(&self, line: usize) -> [f64; 2] {
        self.on_lines[line]
    }

    /// Twist of the legs of the strand that a line belongs to, now and greatest, with their signs [turns].
    pub(super) fn twist(&self, model: &Model, line: usize) -> [f64; 2] {
        let place = self.winding.strands.places.get(model.line_segments[line].start);
        place.map_or([0.0; 2], |place| self.twists.of(place.strand))
    }

    pub(super) fn summary(
        &self,
        model: &Model,
        state: &State,
        bodies: &[BodySummary],
    ) -> WhaleSummary {
        let (outcome, decided) = self.encounter.outcome(state);
        let beyond = self.reach.beyond(model, state);
        WhaleSummary {
            outcome,
            decided,
            first_contact_s: self.encounter.first_s,
            last_contact_s: self.encounter.last_s,
            contact_time_s: self.encounter.contact_time_s,
            regions: BodyPart::ALL.iter().map(|part| self.region(*part)).collect(),
            patches: self.loads.patches(),
            hooked: self.encounter.hooked,
            lodged_in_mouth: self.mouth.lodged,
            was_lodged_in_mouth: self.mouth.was_lodged,
            was_body_caught: bodies.iter().any(|body| body.on_whale.was_caught),
            peak_body_push_n: bodies
                .iter()
                .map(|body| body.on_whale.peak_whale_push_n)
                .fold(0.0, f64::max),
            drag_added_n: self.drag.mean()[0],
            drag_added_now_n: self.drag.now[0],
            speed_made_good_m_s: self.made_good.speed_m_s(),
            unchanged_s: self.unchanged.seconds(),
            trailing_m: beyond.trailing_m,
            tethered_m: beyond.tethered_m,
            carried: beyond.bodies.iter().map(|body| model.spec.bodies[*body].id.clone()).collect(),
            beat: self.flukes.summary(),
            kinetic: self.effort.as_ref().map(EffortMeter::summary),
            winding_jumps: self.winding.jumps.max(self.wraps.jumps),
            beyond_rope_share: self.press.beyond_share(),
        }
    }

    fn region(&self, part: BodyPart) -> RegionSummary {
        let load = self.loads.parts[part as usize];
        RegionSummary {
            part,
            wraps: libm::fabs(self.wraps.turns[part as usize]),
            peak_wraps: load.peak_wraps,
            touching_wraps: libm::fabs(self.winding.turns[part as usize]),
            peak_touching_wraps: load.peak_touching_wraps,
            contact_length_m: load.length_m,
            peak_contact_length_m: load.peak_length_m,
            peak_normal_n: load.peak_normal_n,
            peak_pressure_pa: load.peak_pressure_pa,
            friction_work_j: load.work_j,
        }
    }

    /// Tells of every level that wraps pass, a half, then whole turns, and of every one they fall below again.
    fn tell_wraps(&mut self, time_s: f64, log: &mut Log) {
        for (index, (part, load)) in BodyPart::ALL.iter().zip(&mut self.loads.parts).enumerate() {
            let wraps = libm::fabs(self.wraps.turns[index]);
            load.peak_wraps = load.peak_wraps.max(wraps);
            load.peak_touching_wraps =
                load.peak_touching_wraps.max(libm::fabs(self.winding.turns[index]));
            while level_above(load.told_wraps) <= wraps {
                load.told_wraps = level_above(load.told_wraps);
                log.note(time_s, EventKind::Wrap, part.name(), load.told_wraps);
            }
            while load.told_wraps > 0.0 && wraps < load.told_wraps - UNDONE_TURNS {
                log.note(time_s, EventKind::WrapUndone, part.name(), load.told_wraps);
                load.told_wraps = level_below(load.told_wraps);
            }
        }
    }
}

/// The least level of wraps above a level: 0.5, 1, 2, 3 and so on.
fn level_above(level: f64) -> f64 {
    if level < 0.5 { 0.5 } else { libm::floor(level) + 1.0 }
}

/// The greatest level of wraps below a level.
fn level_below(level: f64) -> f64 {
    match level {
        _ if level > 1.5 => level - 1.0,
        _ if level > 0.75 => 0.5,
        _ => 0.0,
    }
}
