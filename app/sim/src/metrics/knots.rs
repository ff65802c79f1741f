//! Knots, splices and links on the whale and at other rope, and whether they have jammed.
//!
//! A knot has jammed after it has pressed on the whale, or been held by other rope, for [`CAUGHT_S`] with gaps of less than
//! [`LOST_S`], and has slid by less than its own diameter in that time. Slip is relative to skin or rope, by the speed at the
//! end of each step.
//!
//! Other rope holds a knot with the force `|t · Σ N n|` [N], with `N` and `n` the normal force and direction of every contact
//! of other rope and other knots, and `t` the direction of the knot's own rope. Rope that is only beside a knot does not hold
//! it.

use glam::DVec3;

use super::CAUGHT_S;
use super::events::{EventKind, LOST_S, Log};
use crate::contact::ContactPoint;
use crate::contact::rope_on_rope::RopeTouch;
use crate::model::{Knot, Model};
use crate::state::State;

/// Force along its own rope above which other rope holds a knot [N].
pub const HELD_N: f64 = 1.0;

/// Metrics of all knots.
#[derive(Clone, Debug, Default)]
pub(super) struct KnotMeter(Vec<Pressed>);

/// A knot on the whale or at other rope.
#[derive(Clone, Copy, Debug, Default)]
struct Pressed {
    /// Start of the contact at one place [s].
    since_s: Option<f64>,
    /// Time of the last contact [s].
    last_s: f64,
    slid_m: f64,
    peak_n: f64,
    jammed: bool,
}

impl KnotMeter {
    pub fn new(model: &Model) -> Self {
        Self(vec![Pressed::default(); model.knots.len()])
    }

    /// Adds the contacts at the end of a step of length `dt_s`.
    pub fn fold(
        &mut self,
        model: &Model,
        state: &State,
        (contacts, ropes): (&[ContactPoint], &[RopeTouch]),
        dt_s: f64,
        log: &mut Log,
    ) {
        let time_s = state.time_s;
        for ((index, knot), pressed) in model.knots.iter().enumerate().zip(&mut self.0) {
            let [on_skin, at_rope] = [by_skin(knot, contacts), by_rope(model, state, index, ropes)];
            let both = [on_skin[0].max(at_rope[0]), on_skin[1].max(at_rope[1])];
            if pressed.fold(knot, both, (time_s, dt_s)) {
                let line = &model.spec.lines[model.segment_line[knot.segment]].id;
                log.record(time_s, EventKind::JammedKnot, line, pressed.peak_n);
            }
        }
    }
}

/// Greatest normal force of skin on a knot [N], and greatest slip speed [m/s].
fn by_skin(knot: &Knot, contacts: &[ContactPoint]) -> [f64; 2] {
    let mine = contacts.iter().filter(|contact| contact.is_knot && contact.segment == knot.segment);
    let push_n = mine.clone().map(|contact| contact.normal_force_n).fold(0.0, f64::max);
    let speed = |contact: &ContactPoint| contact.slip_m.length() / contact.dt_s;
    [push_n, mine.map(speed).fold(0.0, f64::max)]
}

/// Force with which other rope holds a knot [N], and greatest slip speed [m/s]; both zero if it does not hold it.
fn by_rope(model: &Model, state: &State, index: usize, ropes: &[RopeTouch]) -> [f64; 2] {
    let (mut push, mut speed_m_s) = (DVec3::ZERO, 0.0_f64);
    for touch in ropes.iter().filter(|touch| touch.knots.contains(&Some(index))) {
        let sign = if touch.knots[0] == Some(index) { 1.0 } else { -1.0 };
        push += touch.normal * (sign * touch.normal_force_n);
        speed_m_s = speed_m_s.max(touch.slip_m.length() / touch.dt_s);
    }
    if push == DVec3::ZERO {
        return [0.0; 2];
    }
    let segment = model.knots[index].segment;
    let line = model.segment_line[segment];
    let node = model.line_nodes[line].start + segment - model.line_segments[line].start;
    let along = state.rope.position[node + 1] - state.rope.position[node];
    let held_n = along.normalize_or_zero().dot(push).abs();
    if held_n < HELD_N { [0.0; 2] } else { [held_n, speed_m_s] }
}

impl Pressed {
    /// Adds its greatest force and slip speed in a step; returns whether it has just jammed.
    fn fold(
        &mut self,
        knot: &Knot,
        [push_n, speed_m_s]: [f64; 2],
        (time_s, dt_s): (f64, f64),
    ) -> bool {
        if self.since_s.is_some() && time_s - self.last_s > LOST_S {
            *self = Self::default();
        }
        if push_n <= 0.0 {
            return false;
        }
        (self.last_s, self.peak_n) = (time_s, self.peak_n.max(push_n));
        self.slid_m += speed_m_s * dt_s;
        if self.slid_m > 2.0 * knot.radius_m {
            (self.since_s, self.slid_m, self.jammed) = (Some(time_s), 0.0, false);
        }
        let since_s = *self.since_s.get_or_insert(time_s);
        time_s - since_s >= CAUGHT_S && !std::mem::replace(&mut self.jammed, true)
    }
}

#[cfg(test)]
mod tests {
    use endline_sdk::LineEnd;

    use super::*;

    #[test]
    fn a_knot_at_rest_jams_and_one_that_slides_does_not() {
        let knot = Knot { segment: 0, end: LineEnd::B, from_end_m: 0.0, radius_m: 0.015 };
        for (speed_m_s, push_n, jams) in
            [(0.0, 40.0, 1), (0.004, 40.0, 1), (0.02, 40.0, 0), (0.0, 0.0, 0)]
        {
            let mut pressed = Pressed::default();
            let steps = (1..=900).map(|step| 0.01 * f64::from(step));
            let count = steps
                .filter(|time_s| pressed.fold(&knot, [push_n, speed_m_s], (*time_s, 0.01)))
                .count();
            assert_eq!(count, jams, "{speed_m_s} m/s under {push_n} N");
        }
    }
}
