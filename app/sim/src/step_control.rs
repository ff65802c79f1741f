//! The length of a solver step, chosen by the program, and what limited it.
//!
//! Error of place of a step of length `h`, from the state after it: `e = |x₁ - x₀ - h (v₀ + v₁)/2|`, which is `h³ x‴/4` for BDF2
//! (its local error is `2h³ x‴/9`) and the local error itself for backward Euler, `h² x″/2`.
//! Error of tension: how far each line's greatest tension is from the straight line through its last two, `e = h² T″`.
//! The next step aims at the wanted errors, `h (wanted/e)^{1/3}` and `h (wanted/e)^{1/2}`, within a factor of [`LEAST_FACTOR`]
//! and [`GREATEST_FACTOR`]; a step that misses by [`MISSED`] is taken back, with all since the last input, and made shorter.
//! With rope near the whale the contact step holds instead: friction makes tension jump at any step.
//! Reference: Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, section II.4.

use crate::model::Model;
use crate::state::{BodyState, LimitedBy, State};

/// Error of place wanted in a step [m].
pub const PLACE_M: f64 = 5e-4;
/// Error of tension wanted in a step, as a share of the greatest tension.
pub const TENSION_SHARE: f64 = 0.02;
/// Least error of tension that is looked at [N].
pub const TENSION_N: f64 = 5.0;
/// Shortest step chosen for accuracy [s]; what does not converge may be made shorter still.
pub const SHORTEST_S: f64 = 1e-4;
/// Step after something parted [s].
pub const PARTED_S: f64 = 5e-4;
/// Aim a little below what is wanted.
const SAFETY: f64 = 0.9;
const LEAST_FACTOR: f64 = 0.2;
/// Below the growth at which the multistep scheme starts anew.
const GREATEST_FACTOR: f64 = 1.8;
/// Times the wanted error at which a step is taken back.
const MISSED: f64 = 3.0;

/// Chooses the next step from the one just taken; whether that one missed and should be taken back.
pub(crate) fn choose(model: &Model, state: &mut State, dt: f64, earlier_dt: f64) -> bool {
    let place = place_error(model, state, dt) / PLACE_M;
    let tension = tension_error(model, state, dt, earlier_dt);
    let longest = model.spec.settings.step_s;
    // A number that is not finite makes neither comparison true and ends in the shortest step.
    let by_place = SAFETY / libm::cbrt(place.max(1e-9));
    let by_tension = SAFETY / tension.max(1e-9).sqrt();
    let factor = by_place.min(by_tension).clamp(LEAST_FACTOR, GREATEST_FACTOR);
    let control = &mut state.step_control;
    control.step_s = (dt * factor).clamp(SHORTEST_S.min(longest), longest);
    control.limit = if by_tension < by_place { LimitedBy::Snap } else { LimitedBy::Accuracy };
    place.max(tension) > MISSED && dt > 1.5 * SHORTEST_S
}

/// Greatest error of place of any node or body [m].
fn place_error(model: &Model, state: &State, dt: f64) -> f64 {
    let rope = &state.rope;
    let node = |node: usize| {
        let mean = 0.5 * (rope.velocity[node] + rope.earlier_velocity[node]);
        (rope.position[node] - rope.earlier_position[node] - mean * dt).length_squared()
    };
    let body = |body: &BodyState| {
        let mean = 0.5 * (body.velocity + body.earlier_velocity);
        (body.position - body.earlier_position - mean * dt).length_squared()
    };
    let rope = (0..model.node_count).map(node).fold(0.0, f64::max);
    state.bodies.iter().map(body).fold(rope, f64::max).sqrt()
}

/// Greatest error of a line's tension, as a share of what is wanted; takes the line's tensions down.
fn tension_error(model: &Model, state: &mut State, dt: f64, earlier_dt: f64) -> f64 {
    let State { rope, step_control: control, .. } = state;
    let ratio = if earlier_dt > 0.0 { dt / earlier_dt } else { 0.0 };
    let mut worst = 0.0_f64;
    for (segments, kept) in model.line_segments.iter().zip(&mut control.tension_n) {
        let now = rope.tension[segments.clone()].iter().copied().fold(0.0, f64::max);
        let [last, before] = *kept;
        let predicted = match control.known {
            0 => now,
            1 => last,
            _ => last + ratio * (last - before),
        };
        worst = worst.max((now - predicted).abs() / TENSION_N.max(TENSION_SHARE * now.max(last)));
        *kept = [now, last];
    }
    control.known = (control.known + 1).min(2);
    worst
}
