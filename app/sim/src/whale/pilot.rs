//! The pilot program: controls that change at set times or on events.
//!
//! ```text
//! v_0 = 0,  v_k = v_(k-1) + w_k (c_k - v_(k-1))     over the entries in the order in which they began
//! w = min((t - b)/r, 1)                             during the duration, from the start b over the ramp r
//! w = max(min(h/r, 1) - (t - b - h)/r, 0)           after the duration h
//! ```
//!
//! for each control with the value `c_k` in entry `k`; times in seconds. An entry does not affect controls that it does not
//! name. A ramp of zero is a jump; an infinite duration never ends. Acts are not blended: the act is that of the entry from `b`
//! to `b + h`.
//!
//! The program is pure: the observations of its triggers and the start times of its entries are part of the [`State`], updated
//! at the end of each step, so that a run continues identically from a snapshot. It chooses inputs only, and these are
//! recorded.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use endline_sdk::Controls;
use glam::DVec3;

use crate::geometry::distance::segment_segment;
use crate::model::{Model, PilotEntry, PilotProgram, Sight, Target, Trigger};
use crate::state::{Begun, PilotMemory, Seen, State, WhaleState};

/// Tolerance of time comparisons: 0.3 s includes the step at 0.29999999999999999 [s].
const GRACE_S: f64 = 1e-7;

impl PilotProgram {
    /// Controls for the step that starts from a state.
    pub fn at(&self, state: &State) -> Controls {
        let mut controls = [0.0; Controls::COUNT];
        for begun in &state.pilot.begun {
            let Some(entry) = self.entries.get(begun.entry) else { continue };
            let weight = entry.weight(state.time_s - begun.at_s);
            let held = state.time_s - begun.at_s < entry.hold_s - GRACE_S;
            let of_side = entry.controls_starboard.filter(|_| begun.is_starboard);
            let named = of_side.unwrap_or(entry.controls);
            for (index, (control, wanted)) in controls.iter_mut().zip(named).enumerate() {
                let Some(wanted) = wanted else { continue };
                // A weight of 1 gives the exact value of the entry.
                match if index == Controls::ACT { f64::from(u8::from(held)) } else { weight } {
                    1.0 => *control = wanted,
                    weight => *control += weight * (wanted - *control),
                }
            }
        }
        Controls::from_array(controls)
    }
}

impl PilotEntry {
    /// Weight of its controls at a time after its start.
    fn weight(&self, since_s: f64) -> f64 {
        let ramped =
            |time_s: f64| if time_s < self.ramp_s { (time_s / self.ramp_s).max(0.0) } else { 1.0 };
        let over_s = since_s - self.hold_s;
        if over_s < -GRACE_S {
            ramped(since_s)
        } else if over_s < self.ramp_s {
            (ramped(self.hold_s) - over_s / self.ramp_s).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Initialises the progress of a model's program at a state.
pub(crate) fn begin(model: &Model, state: &mut State) {
    let entries = model.spec.whale.as_ref().map_or(0, |whale| whale.pilot.entries.len());
    state.pilot =
        PilotMemory { seen: vec![Seen::default(); entries], begun: Vec::with_capacity(entries) };
    poll(model, state);
}

/// The memory that another program would have at a moment if the same controls had been given until then; `None` if that cannot be known
/// from this moment alone.
///
/// An entry that equals that of the same index has its memory. Of other entries only those are known that begin at a later time.
pub fn memory_for(
    memory: &PilotMemory,
    [from, to]: [&PilotProgram; 2],
    time_s: f64,
) -> Option<PilotMemory> {
    let is_kept = |index: usize| {
        let entry = to.entries.get(index);
        entry.is_some() && entry == from.entries.get(index)
    };
    let seen = |(index, entry): (usize, &PilotEntry)| match entry.trigger {
        // The observation of an entry that follows another one is that entry's own.
        Trigger::After(other) if is_kept(index) && is_kept(other) => {
            memory.seen.get(index).copied()
        }
        Trigger::After(_) => None,
        _ if is_kept(index) => memory.seen.get(index).copied(),
        Trigger::Time(at_s) if at_s + entry.delay_s > time_s + GRACE_S => {
            Some(Seen { met_s: Some(at_s), ..Seen::default() })
        }
        _ => None,
    };
    let seen = to.entries.iter().enumerate().map(seen).collect::<Option<Vec<Seen>>>()?;
    let begun = memory.begun.iter().filter(|begun| is_kept(begun.entry)).copied().collect();
    Some(PilotMemory { seen, begun })
}

/// Evaluates triggers at a new state and starts entries.
pub(crate) fn poll(model: &Model, state: &mut State) {
    let Some(whale) = &model.spec.whale else { return };
    let mut memory = std::mem::take(&mut state.pilot);
    debug_assert_eq!(memory.seen.len(), whale.pilot.entries.len(), "one observation per entry");
    let known = memory.begun.len();
    for (index, entry) in whale.pilot.entries.iter().enumerate() {
        let Some(seen) = memory.seen.get(index).copied().filter(|seen| !seen.begun) else {
            continue;
        };
        let mut seen = match entry.trigger {
            Trigger::After(other) => Seen { met_s: began_s(&memory, other), ..seen },
            _ => observe(model, state, &entry.trigger, seen),
        };
        let begins_s = seen.met_s.map(|met_s| met_s + entry.delay_s);
        if let Some(at_s) = begins_s.filter(|at_s| *at_s <= state.time_s + GRACE_S) {
            seen.begun = true;
            memory.begun.push(Begun { entry: index, at_s, is_starboard: seen.is_starboard });
        }
        memory.seen[index] = seen;
    }
    memory.begun[known..].sort_unstable_by(|one, other| {
        one.at_s.total_cmp(&other.at_s).then(one.entry.cmp(&other.entry))
    });
    state.pilot = memory;
}

/// Start of an entry [s].
fn began_s(memory: &PilotMemory, entry: usize) -> Option<f64> {
    if !memory.seen.get(entry)?.begun {
        return None;
    }
    memory.begun.iter().find(|begun| begun.entry == entry).map(|begun| begun.at_s)
}

/// Updates the observation of a trigger with this state.
fn observe(model: &Model, state: &State, trigger: &Trigger, before: Seen) -> Seen {
    let (Some(spec), Some(whale)) = (&model.spec.whale, &state.whale) else { return before };
    if before.met_s.is_some() {
        return before;
    }
    let now = state.time_s;
    match trigger {
        Trigger::Time(time_s) => Seen { met_s: Some(*time_s), ..before },
        Trigger::Touch(part) => {
            let touched = |force: &f64| *force > 0.0;
            let met = match part {
                Some(part) => touched(&whale.contact_force_n[*part as usize]),
                None => whale.contact_force_n.iter().any(touched),
            };
            Seen { met_s: met.then_some(now), ..before }
        }
        Trigger::Within(distance_m, target) => {
            let met = is_within(model, state, axis(whale, spec.length_m), *distance_m, target);
            Seen { met_s: met.then_some(now), ..before }
        }
        Trigger::Sees(sight) => {
            let is_touched =
                before.is_touched || whale.contact_force_n.iter().any(|force| *force > 0.0);
            let side = if is_touched { None } else { side_seen(model, state, whale, sight) };
            let is_starboard = side.unwrap_or(false);
            Seen { met_s: side.map(|_| now), is_starboard, is_touched, ..before }
        }
        Trigger::Depth(depth_m) => {
            crossing(before, -whale.position.z - depth_m, f64::INFINITY, now)
        }
        Trigger::Heading(bearing_rad) => {
            crossing(before, turn(bearing(whale) - bearing_rad), FRAC_PI_2, now)
        }
        Trigger::After(_) => before,
    }
}

/// Updates an observation of a crossing: a difference that is zero or has changed sign since the last evaluation, with both
/// values below `most` (a heading also changes sign behind the whale).
fn crossing(before: Seen, difference: f64, most: f64, now: f64) -> Seen {
    let near = |difference: f64| difference.abs() < most;
    let crossed = before
        .last
        .is_some_and(|last| (last < 0.0) != (difference < 0.0) && near(last) && near(difference));
    Seen { met_s: (crossed || difference == 0.0).then_some(now), last: Some(difference), ..before }
}

/// Compass bearing of the whale's x axis [rad].
fn bearing(whale: &WhaleState) -> f64 {
    let ahead = whale.orientation * DVec3::X;
    libm::atan2(ahead.x, ahead.y)
}

/// An angle reduced to the range from -π to π [rad].
fn turn(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// Line from snout to fluke notch of the straight whale [m].
fn axis(whale: &WhaleState, length_m: f64) -> [DVec3; 2] {
    let half = whale.orientation * DVec3::new(0.5 * length_m, 0.0, 0.0);
    [whale.position + half, whale.position - half]
}

/// Whether a target is within a distance of the axis.
fn is_within(
    model: &Model,
    state: &State,
    axis: [DVec3; 2],
    distance_m: f64,
    target: &Target,
) -> bool {
    any_part(model, state, target, |part| {
        let (s, t) = segment_segment(axis, part);
        axis[0].lerp(axis[1], s).distance_squared(part[0].lerp(part[1], t))
            <= distance_m * distance_m
    })
}

/// Sine of the angle beyond the midplane up to which an eye sees: half of a binocular field of 30 degrees. In dolphins it is 20 to 30 degrees
/// wide (Mass and Supin 2007, The Anatomical Record 290, 701, recalled); for right whales it is assumed.
const BEYOND_MIDPLANE: f64 = 0.26;

/// The eye that sees a target, the nearer one of both: `Some(true)` for the starboard eye, `None` if neither does.
fn side_seen(model: &Model, state: &State, whale: &WhaleState, sight: &Sight) -> Option<bool> {
    let (mut nearest_m, mut side) = (sight.distance_m, None);
    if nearest_m <= 0.0 {
        return None;
    }
    let eyes = [(1.0, false), (-1.0, true)].map(|(port, is_starboard)| {
        let eye = whale.position + whale.orientation * (sight.eye_m * DVec3::new(1.0, port, 1.0));
        (eye, whale.orientation * DVec3::new(0.0, port, 0.0), is_starboard)
    });
    any_part(model, state, &sight.target, |part| {
        for (eye, out, is_starboard) in eyes {
            let (_, fraction) = segment_segment([eye; 2], part);
            let seen = part[0].lerp(part[1], fraction) - eye;
            let distance_m = seen.length();
            if distance_m < nearest_m && seen.dot(out) >= -BEYOND_MIDPLANE * distance_m {
                (nearest_m, side) = (distance_m, Some(is_starboard));
            }
        }
        false // The nearest of all parts is sought.
    });
    side
}

/// Whether any part of a target meets a condition: segments of its lines that are not cut, or its place as a segment without length.
fn any_part(
    model: &Model,
    state: &State,
    target: &Target,
    mut meets: impl FnMut([DVec3; 2]) -> bool,
) -> bool {
    let line = |line: usize| {
        let (nodes, segments) = (model.line_nodes[line].clone(), model.line_segments[line].clone());
        let mut pairs = state.rope.position[nodes].windows(2).zip(&state.rope.cut[segments]);
        pairs.any(|(ends, cut)| !cut && meets([ends[0], ends[1]]))
    };
    match target {
        Target::AnyLine => (0..model.spec.lines.len()).any(line),
        Target::Lines(lines) => lines.clone().any(line),
        Target::Body(body) => state.bodies.get(*body).is_some_and(|body| meets([body.position; 2])),
        Target::Joint(joint) => {
            state.joint_place(model, *joint).is_some_and(|place| meets([place; 2]))
        }
    }
}
