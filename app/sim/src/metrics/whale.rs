//! Metrics of the whale, and the time for which an encounter has not changed.
//!
//! An encounter has changed if rope starts or stops holding the whale, lodges in the mouth or leaves it, if turns about a part
//! differ by [`TURNS`] from those at the last change, if something parts, or if a tension exceeds all previous ones by the
//! factor [`MORE`]. Repeated pulls of the same strength are no change.

use std::sync::Arc;

use endline_sdk::BodyPart;

use super::events::{Encounter, EventKind, Log, Touches};
use super::flukes::FlukeMeter;
use super::loads::{EffortMeter, Window, added_drag, on_line};
use super::mouth::{Mouth, inside_of_mouth};
use super::pressure::{ExcessForceMeter, Loads};
use super::summary::{BodySummary, RegionSummary, WhaleSummary};
use super::trailing::{Extent, Reach};
use super::whale_momentum::MadeGood;
use super::winding::{TwistMeter, Winding};
use super::wraps::WrapMeter;
use crate::contact::rope_on_skin::step_sums::SkinContact;
use crate::model::{BodyRole, Model};
use crate::state::State;
use crate::strands::Strands;
use crate::whale::Skin;

/// Decrease below a level at which wraps are reported as undone; estimate [turns].
const UNDONE_TURNS: f64 = 0.15;

/// All metrics of the whale.
#[derive(Clone, Debug)]
pub(super) struct WhaleMeter {
    skin: Arc<Skin>,
    winding: Winding,
    wraps: WrapMeter,
    twists: TwistMeter,
    mouth: Mouth,
    /// Normal force and friction on each line [N].
    on_lines: Vec<[f64; 2]>,
    loads: Loads,
    excess_force: ExcessForceMeter,
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
            winding: Winding::new(&skin, Arc::clone(&inside), strands),
            loads: Loads::default(),
            excess_force: ExcessForceMeter::new(inside),
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
        let Some(whale) = &state.whale else {
            debug_assert!(false, "a model with a whale has a whale in its state");
            return;
        };
        let touching = contacts.iter().any(|contact| contact.normal_force_n > 0.0);
        self.loads.fold(model, state, contacts, sums);
        self.excess_force.fold(model, state, contacts, dt_s);
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
        self.extent.fold(model, whale, state.time_s, log);
        self.touches.fold(&self.loads, state.time_s, log);
        self.flukes.fold(whale, state.time_s, dt_s);
        self.report_wraps(state.time_s, log);
        let most = self.winding.most().max(self.wraps.most());
        self.encounter.fold(state.time_s, dt_s, touching, most, log);
        // Rope that is off the skin for a moment still holds the whale where it last touched.
        if touching || !self.encounter.holds() {
            self.reach.fold(model, state, contacts);
        }
        let hold = Hold {
            held: self.encounter.holds(),
            lodged: self.mouth.lodged,
            turns: self.wraps.turns.map(libm::fabs),
        };
        self.unchanged.fold(state, hold);
    }

    /// Normal force and friction on a line [N].
    pub(super) fn on_line(&self, line: usize) -> [f64; 2] {
        self.on_lines[line]
    }

    /// Twist of the legs of a line's strand, current and greatest, signed [turns].
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
        let carried = |role: BodyRole| {
            beyond.bodies.iter().filter(|body| model.spec.bodies[**body].role == role).count()
                as u64
        };
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
            carried_traps: carried(BodyRole::Trap),
            carried_buoys: carried(BodyRole::Buoy),
            carried: beyond.bodies.iter().map(|body| model.spec.bodies[*body].id.clone()).collect(),
            beat: self.flukes.summary(),
            kinetic: self.effort.as_ref().map(EffortMeter::summary),
            winding_jumps: self.winding.jumps.max(self.wraps.jumps),
            beyond_rope_share: self.excess_force.beyond_share(),
        }
    }

    fn region(&self, part: BodyPart) -> RegionSummary {
        let load = self.loads.parts[part as usize];
        RegionSummary {
            part,
            touching: self.touches.is_touching(part),
            wraps: libm::fabs(self.wraps.turns[part as usize]),
            peak_wraps: load.peak_wraps,
            touching_wraps: libm::fabs(self.winding.turns[part as usize]),
            peak_touching_wraps: load.peak_touching_wraps,
            across: self.winding.across[part as usize],
            contact_length_m: load.length_m,
            peak_contact_length_m: load.peak_length_m,
            peak_normal_n: load.peak_normal_n,
            peak_pressure_pa: load.peak_pressure_pa,
            friction_work_j: load.work_j,
        }
    }

    /// Reports every level that wraps exceed (a half, then whole turns), and every level that they fall below again.
    fn report_wraps(&mut self, time_s: f64, log: &mut Log) {
        for (index, (part, load)) in BodyPart::ALL.iter().zip(&mut self.loads.parts).enumerate() {
            let wraps = libm::fabs(self.wraps.turns[index]);
            load.peak_wraps = load.peak_wraps.max(wraps);
            load.peak_touching_wraps =
                load.peak_touching_wraps.max(libm::fabs(self.winding.turns[index]));
            while level_above(load.reported_wraps) <= wraps {
                load.reported_wraps = level_above(load.reported_wraps);
                log.record(time_s, EventKind::Wrap, part.name(), load.reported_wraps);
            }
            while load.reported_wraps > 0.0 && wraps < load.reported_wraps - UNDONE_TURNS {
                log.record(time_s, EventKind::WrapUndone, part.name(), load.reported_wraps);
                load.reported_wraps = level_below(load.reported_wraps);
            }
        }
    }
}

/// Next level of wraps above a level: 0.5, 1, 2, 3 and so on.
fn level_above(level: f64) -> f64 {
    if level < 0.5 { 0.5 } else { libm::floor(level) + 1.0 }
}

/// Next level of wraps below a level.
fn level_below(level: f64) -> f64 {
    match level {
        _ if level > 1.5 => level - 1.0,
        _ if level > 0.75 => 0.5,
        _ => 0.0,
    }
}

/// Difference of turns about a part that is a change; estimate.
const TURNS: f64 = 0.25;

/// Factor over all previous tensions that is a change; estimate.
const MORE: f64 = 1.05;

/// Least tension that can be a change; estimate [N].
const LEAST_N: f64 = 50.0;

/// Hold of rope on the whale, for the detection of changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Hold {
    pub held: bool,
    pub lodged: bool,
    pub turns: [f64; BodyPart::ALL.len()],
}

/// Hold at the last change.
#[derive(Clone, Debug, Default)]
pub(super) struct Unchanged {
    since_s: f64,
    now_s: f64,
    then: Hold,
    parted: usize,
    greatest_n: f64,
}

impl Unchanged {
    pub fn fold(&mut self, state: &State, now: Hold) {
        self.now_s = state.time_s;
        let parted = state.line_parted.iter().flatten().count()
            + state.link_parted_s.iter().flatten().count();
        let tension_n = state.rope.tension.iter().copied().fold(0.0, f64::max);
        let harder = tension_n > (MORE * self.greatest_n).max(LEAST_N);
        if harder || parted != self.parted || has_changed(&self.then, &now) {
            (self.since_s, self.then, self.parted) = (self.now_s, now, parted);
        }
        if harder {
            self.greatest_n = tension_n;
        }
    }

    /// Time since the last change; zero for a whale that is not held [s].
    pub fn seconds(&self) -> f64 {
        if self.then.held { self.now_s - self.since_s } else { 0.0 }
    }
}

/// Whether the hold has changed.
fn has_changed(then: &Hold, now: &Hold) -> bool {
    let moved = |(then, now): (&f64, &f64)| libm::fabs(now - then) >= TURNS;
    then.held != now.held
        || then.lodged != now.lodged
        || then.turns.iter().zip(&now.turns).any(moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::{model, spec};

    /// Unchanged time after 100 s, for tension and hold as functions of time.
    fn held(pull_n: impl Fn(f64) -> f64, hold: impl Fn(f64) -> Hold) -> f64 {
        let model = model(spec(vec![1.0; 4]));
        let mut state = State::start(&model);
        let mut meter = Unchanged::default();
        for step in 0..=1000 {
            state.time_s = 0.1 * f64::from(step);
            state.rope.tension.fill(pull_n(state.time_s));
            meter.fold(&state, hold(state.time_s));
        }
        meter.seconds()
    }

    fn turns_of(about_head: f64) -> Hold {
        let mut turns = [0.0; BodyPart::ALL.len()];
        turns[BodyPart::Head as usize] = about_head;
        Hold { held: true, lodged: true, turns }
    }

    #[test]
    fn repeated_pulls_are_no_change_and_stronger_ones_are() {
        let again = |time_s: f64| 1000.0 * libm::fabs(libm::sin(0.3 * time_s));
        let unchanged = held(again, |_| turns_of(0.5));
        assert!(
            (94.0..97.0).contains(&unchanged),
            "from the first full pull at 5.2 s: {unchanged}"
        );
        let harder = |time_s: f64| if time_s < 60.0 { 1000.0 } else { 1100.0 };
        assert!((held(harder, |_| turns_of(0.5)) - 40.0).abs() < 1e-9);
    }

    #[test]
    fn winding_lodging_and_release_are_changes() {
        let winds = |time_s: f64| turns_of(if time_s < 70.0 { 0.5 } else { 0.8 });
        assert!((held(|_| 500.0, winds) - 30.0).abs() < 1e-9);
        let leaves = |time_s: f64| Hold { lodged: time_s < 80.0, ..turns_of(0.5) };
        assert!((held(|_| 500.0, leaves) - 20.0).abs() < 1e-9);
        let free = |time_s: f64| Hold { held: time_s < 50.0, ..turns_of(0.0) };
        assert!(held(|_| 500.0, free).abs() < 1e-12);
    }
}
