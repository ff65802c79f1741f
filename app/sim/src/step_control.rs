//! The length of a solver step of free rope, chosen by the program, and what limited it.
//!
//! Two errors are estimated after each step, of length `h`:
//!
//! | error | estimate |
//! |---|---|
//! | of place in a second | `C h² x‴`, with `x‴` from `|x₁ - x₀ - h (v₀ + v₁)/2|`, root mean square over the nodes of a line |
//! | of tension | how far each line's greatest tension is from the straight line through its last two, `h² T″` |
//!
//! | step | `C`, its error of place | share of `h³ x‴` in the estimate |
//! |---|---|---|
//! | BDF2 | 1/3 | 1/4 |
//! | two stages | 0.0404 | 0.0404 - 1/12 |
//!
//! An error of place persists without drag: a swing keeps its phase error. Without water its rate is
//! therefore bounded at any setting, and steps are taken in two stages, down to [`STAYING_S`], if BDF2 exceeds the target.
//! Water drags, and rope forgets within a second; so it does on the seabed.
//!
//! With `auto_step` the rate is bounded in water too, as finely as waves along a rope need, and so is the tension.
//! A rate and not an error in each step: waves run to and fro hundreds of times before a snap, and its peak is the sum of
//! those that meet there. A step whose error is [`MISSED`] times its target is undone, with all since the last input, and made shorter.
//! With rope near the whale the contact step holds instead: friction makes tension jump at any step.
//! References: Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, section II.4; Alexander 1977 (two stages).

use crate::model::Model;
use crate::state::{BodyState, LimitedBy, State};

/// Target of the error of place in a second, with `auto_step` [m/s].
pub const PLACE_M_S: f64 = 1e-3;
/// Target without water, where the error persists, as far as steps of [`STAYING_S`] allow [m/s].
pub const STAYING_M_S: f64 = 1e-4;
/// Target of the error of tension in a step, as a share of the greatest tension.
pub const TENSION_SHARE: f64 = 0.02;
/// Smallest target of the error of tension [N].
pub const TENSION_N: f64 = 5.0;
/// Shortest step chosen for accuracy [s]; a step that does not converge may be shorter.
pub const SHORTEST_S: f64 = 1e-4;
/// Step after something parted [s].
pub const PARTED_S: f64 = 5e-4;
/// Shortest step in two stages for the sake of an error that stays; a shorter step between inputs was set on purpose [s].
pub const STAYING_S: f64 = 5e-3;
/// Density of water below which nothing drags; air has 1.2 [kg/m³].
const NO_DRAG_KG_M3: f64 = 10.0;
/// Error of place in a second of BDF2 and of a step in two stages, as a share of `h² x‴`.
const PLACE_SHARE: [f64; 2] = [1.0 / 3.0, 0.0404];
/// Share of `h³ x‴` in the estimate, for each.
const SHOWN_SHARE: [f64; 2] = [0.25, 1.0 / 12.0 - 0.0404];
/// Rope and feet closer to the seabed than this may touch it [m].
const NEAR_GROUND_M: f64 = 0.05;
/// Smallest third derivative [m/s³].
const LEAST_JERK_M_S3: f64 = 1e-9;
/// Safety factor on the step length.
const SAFETY: f64 = 0.9;
const LEAST_FACTOR: f64 = 0.2;
/// Below the growth at which the multistep scheme restarts.
const GREATEST_FACTOR: f64 = 1.8;
/// Ratio of error to target at which a step is undone.
const MISSED: f64 = 3.0;
/// Steps in two stages are used until BDF2 would reach the target with a step this many times as long.
const SURELY: f64 = 1.2;

/// A step of free rope that was taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taken {
    /// Its length [s].
    pub dt: f64,
    /// Length of the step before it [s].
    pub earlier_dt: f64,
    /// Whether it was taken in two stages.
    pub in_two_stages: bool,
}

/// Whether the program chooses steps of free rope in this model.
pub(crate) fn chooses(model: &Model) -> bool {
    let settings = &model.spec.settings;
    settings.auto_step || (settings.step_s >= STAYING_S && errors_stay(model))
}

/// Whether an error of place stays because nothing drags.
fn errors_stay(model: &Model) -> bool {
    model.spec.water.density_kg_m3 < NO_DRAG_KG_M3
}

/// Chooses the next step from the one just taken; returns whether that one should be undone.
pub(crate) fn choose(model: &Model, state: &mut State, taken: Taken) -> bool {
    let settings = &model.spec.settings;
    let longest = settings.step_s;
    let lengths = lengths(model, jerk(model, state, taken));
    let has_grown = taken.dt * GREATEST_FACTOR >= longest;
    let multistep_will_do = !settings.auto_step && is_on_ground(model, state)
        || has_grown
            && lengths.multistep >= longest * if taken.in_two_stages { SURELY } else { 1.0 };
    if !settings.auto_step {
        let control = &mut state.step_control;
        (control.step_s, control.limit) = if multistep_will_do {
            (0.0, LimitedBy::Inputs)
        } else {
            (lengths.in_two_stages.min(longest), LimitedBy::Accuracy)
        };
        return false;
    }
    let wanted = if taken.in_two_stages { lengths.in_two_stages } else { lengths.multistep };
    let place = (taken.dt / wanted) * (taken.dt / wanted);
    let tension = tension_error(model, state, taken);
    // A number that is not finite makes neither comparison true and ends in the shortest step.
    let by_place = SAFETY * lengths.in_two_stages / taken.dt;
    let by_tension = SAFETY / tension.max(1e-9).sqrt();
    let factor = by_place.min(by_tension).clamp(LEAST_FACTOR, GREATEST_FACTOR);
    let control = &mut state.step_control;
    control.step_s = (taken.dt * factor).clamp(SHORTEST_S.min(longest), longest);
    control.limit = if multistep_will_do && control.step_s >= longest {
        LimitedBy::Inputs
    } else if by_tension < by_place {
        LimitedBy::Snap
    } else {
        LimitedBy::Accuracy
    };
    place.max(tension) > MISSED && taken.dt > 1.5 * SHORTEST_S
}

/// Whether anything is at the seabed, whose friction makes an error of place vanish as drag does.
fn is_on_ground(model: &Model, state: &State) -> bool {
    let Some(seabed) = &model.spec.seabed else { return false };
    let bodies = model.spec.bodies.iter().zip(&state.bodies);
    let feet = bodies.flat_map(|(body, now)| {
        let arm = |foot| body.foot_arm(foot, now.orientation, seabed.normal);
        (0..body.feet_m.len()).map(move |foot| now.position + arm(foot))
    });
    feet.chain(state.rope.position.iter().copied())
        .any(|place| seabed.depth_of(place) > -NEAR_GROUND_M)
}

/// Lengths of steps with the target error of place, by scheme [s].
#[derive(Clone, Copy, Debug)]
struct Lengths {
    multistep: f64,
    in_two_stages: f64,
}

/// The longest steps with the target error of place, for motion with this third derivative.
fn lengths(model: &Model, jerk: f64) -> Lengths {
    let settings = &model.spec.settings;
    let length = |rate: f64, share: f64| (rate / (share * jerk)).sqrt();
    let [mut multistep, mut in_two_stages] = if settings.auto_step {
        PLACE_SHARE.map(|share| length(PLACE_M_S, share))
    } else {
        [f64::INFINITY; 2]
    };
    if errors_stay(model) {
        let [of_multistep, of_two_stages] = PLACE_SHARE.map(|share| length(STAYING_M_S, share));
        multistep = multistep.min(of_multistep);
        in_two_stages = in_two_stages.min(of_two_stages.max(STAYING_S));
    }
    Lengths { multistep, in_two_stages }
}

/// Third derivative of place by time, as the step just taken shows it: the greatest of any body and of any line's root mean
/// square [m/s³].
fn jerk(model: &Model, state: &State, Taken { dt, in_two_stages, .. }: Taken) -> f64 {
    let rope = &state.rope;
    let node = |node: usize| {
        let mean = 0.5 * (rope.velocity[node] + rope.earlier_velocity[node]);
        (rope.position[node] - rope.earlier_position[node] - mean * dt).length_squared()
    };
    let body = |body: &BodyState| {
        let mean = 0.5 * (body.velocity + body.earlier_velocity);
        (body.position - body.earlier_position - mean * dt).length_squared()
    };
    let lines = model.line_nodes.iter().map(|nodes| {
        let count = nodes.len().max(1) as f64;
        nodes.clone().map(node).sum::<f64>() / count
    });
    let greatest = lines.chain(state.bodies.iter().map(body)).fold(0.0, f64::max).sqrt();
    (greatest / (SHOWN_SHARE[usize::from(in_two_stages)] * dt * dt * dt)).max(LEAST_JERK_M_S3)
}

/// Greatest error of a line's tension, as a share of its target; stores the tensions of lines.
fn tension_error(model: &Model, state: &mut State, Taken { dt, earlier_dt, .. }: Taken) -> f64 {
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
