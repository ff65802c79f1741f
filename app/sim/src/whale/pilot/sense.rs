//! What a trigger of the pilot program sees in a state.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use crate::geometry::distance::segment_segment;
use crate::model::{Model, Target, Trigger};
use crate::state::{Seen, State, WhaleState};

/// What a trigger has seen once it has looked at this state too.
pub(super) fn look(model: &Model, state: &State, trigger: &Trigger, before: Seen) -> Seen {
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
        Trigger::Depth(depth_m) => passing(before, -whale.position.z - depth_m, f64::INFINITY, now),
        Trigger::Heading(bearing_rad) => {
            passing(before, turn(bearing(whale) - bearing_rad), FRAC_PI_2, now)
        }
        Trigger::After(_) => before,
    }
}

/// Met where a difference is zero or has changed its sign since it was last looked at; beyond `most` it is no passing
/// (a heading turns over behind the whale, too).
fn passing(before: Seen, difference: f64, most: f64, now: f64) -> Seen {
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

/// An angle brought between minus and plus half a turn [rad].
fn turn(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// From snout to fluke notch, as if the whale were straight [m].
fn axis(whale: &WhaleState, length_m: f64) -> [DVec3; 2] {
    let half = whale.orientation * DVec3::new(0.5 * length_m, 0.0, 0.0);
    [whale.position + half, whale.position - half]
}

fn is_within(
    model: &Model,
    state: &State,
    axis: [DVec3; 2],
    distance_m: f64,
    target: &Target,
) -> bool {
    let near = |other: [DVec3; 2]| {
        let (s, t) = segment_segment(axis, other);
        axis[0].lerp(axis[1], s).distance_squared(other[0].lerp(other[1], t))
            <= distance_m * distance_m
    };
    let line = |line: usize| {
        let (nodes, segments) = (model.line_nodes[line].clone(), model.line_segments[line].clone());
        let pairs = state.rope.position[nodes].windows(2).zip(&state.rope.cut[segments]);
        pairs.into_iter().any(|(ends, cut)| !cut && near([ends[0], ends[1]]))
    };
    match target {
        Target::AnyLine => (0..model.spec.lines.len()).any(line),
        Target::Lines(lines) => lines.clone().any(line),
        Target::Body(body) => state.bodies.get(*body).is_some_and(|body| near([body.position; 2])),
        Target::Joint(joint) => {
            state.joint_place(model, *joint).is_some_and(|place| near([place; 2]))
        }
    }
}
