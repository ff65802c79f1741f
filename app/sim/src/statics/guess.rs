//! Initial guess of statics: every slack line is an arc in the direction of its load.
//!
//! A line whose length `L` [m] exceeds the chord `c` [m] between its ends is laid along the circular arc of that length,
//! `sin(φ)/φ = c/L` with `φ` half of the arc's angle [rad]. The arc bulges in the direction of the load `q` [N/m], the weight
//! and the drag at its middle. Every segment has its own length, and the tension is that of an arc of radius `R` [m] under a
//! uniform load,
//! `T = |q| R` [N]. Rope that would sink to the seabed is laid on it.
//! This is the equilibrium of an arc under a uniform normal load.

use glam::DVec3;

use crate::model::{JointKind, Line, Model, Rope, Seabed};
use crate::solver::is_laid;
use crate::state::State;

/// Depth of laid rope in the seabed [m].
const LAID_M: f64 = 1e-4;
/// Slope of laid rope from its ends to the seabed.
const DESCENT: f64 = 0.25;

/// Greatest chord of a line between laid bodies, as a share of its length.
const LAID_SHARE: f64 = 1.0 - 1e-4;

/// Number of rounds in which laid bodies are moved together.
const LAYINGS: usize = 4;

/// Initial state with straight lines, with laid bodies at most as far apart as the lines between them are long, and at their
/// equilibrium depth in the seabed.
pub(super) fn straight(model: &Model) -> State {
    let mut state = State::start(model);
    for _ in 0..LAYINGS {
        (0..model.spec.lines.len()).for_each(|line| draw_near(model, line, &mut state));
    }
    (0..model.spec.lines.len())
        .filter(|line| model.spec.lines[*line].start_m.is_empty())
        .for_each(|line| straighten(model, line, &mut state));
    for index in (0..model.spec.bodies.len()).filter(|index| is_laid(model, *index)) {
        sink(model, index, &mut state);
    }
    state
}

/// Initial state of statics.
pub(super) fn first_guess(model: &Model) -> State {
    let mut state = straight(model);
    for index in 0..model.spec.lines.len() {
        if model.spec.lines[index].start_m.is_empty() {
            bend(model, index, &mut state);
        }
    }
    state
}

/// Moves a laid body, and the line ends at it, to the depth at which its feet carry its weight.
fn sink(model: &Model, index: usize, state: &mut State) {
    let (Some(seabed), body) = (&model.spec.seabed, &model.spec.bodies[index]) else { return };
    let now = &state.bodies[index];
    let arm = |foot| body.foot_arm(foot, now.orientation, seabed.normal);
    let lowest = (0..body.feet_m.len())
        .map(|foot| seabed.depth_of(now.position + arm(foot)))
        .fold(f64::MIN, f64::max);
    let displaced: f64 = body.floats.iter().map(|float| float.volume_m3).sum();
    let weight =
        (body.mass_kg - model.spec.water.density_kg_m3 * displaced) * model.spec.water.gravity_m_s2;
    if weight <= 0.0 {
        return;
    }
    shift(
        model,
        index,
        seabed.normal * (lowest - seabed.depth_under(weight / body.feet_m.len() as f64)),
        state,
    );
}

/// Moves the laid bodies at a line's ends together if their distance exceeds its length, because gear is laid with slack lines.
fn draw_near(model: &Model, line: usize, state: &mut State) {
    let (line, nodes) = (&model.spec.lines[line], &model.line_nodes[line]);
    let movable = |joint: usize| match model.spec.joints[joint].kind {
        JointKind::Body { body, .. } if is_laid(model, body) => {
            Some((body, model.spec.bodies[body].held_until_s.is_none()))
        }
        _ => None,
    };
    let (Some(seabed), Some((from, from_free)), Some((to, to_free))) =
        (&model.spec.seabed, movable(line.from), movable(line.to))
    else {
        return;
    };
    let chord = state.rope.position[nodes.end - 1] - state.rope.position[nodes.start];
    let excess = chord.length() - LAID_SHARE * line.segments_m.iter().sum::<f64>();
    let Some(along) = chord
        .reject_from_normalized(seabed.normal)
        .try_normalize()
        .filter(|_| excess > 0.0 && from != to)
    else {
        return;
    };
    if to_free {
        shift(model, to, along * -excess, state);
    } else if from_free {
        shift(model, from, along * excess, state);
    }
}

/// Lays a line straight between its ends.
fn straighten(model: &Model, index: usize, state: &mut State) {
    let (line, nodes) = (&model.spec.lines[index], model.line_nodes[index].clone());
    let (from, to) = (state.rope.position[nodes.start], state.rope.position[nodes.end - 1]);
    let (whole, mut along) = (line.segments_m.iter().sum::<f64>(), 0.0);
    for (node, segment) in (nodes.start + 1..nodes.end - 1).zip(&line.segments_m) {
        along += segment;
        state.rope.position[node] = from.lerp(to, along / whole);
    }
}

/// Moves a body and the line ends at it.
fn shift(model: &Model, index: usize, by: DVec3, state: &mut State) {
    state.bodies[index].position += by;
    for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
        for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
            if matches!(model.spec.joints[joint].kind, JointKind::Body { body, .. } if body == index)
            {
                state.rope.position[node] += by;
            }
        }
    }
}

/// Lays a line along its arc.
fn bend(model: &Model, index: usize, state: &mut State) {
    let line = &model.spec.lines[index];
    let nodes = model.line_nodes[index].clone();
    let (from, to) = (state.rope.position[nodes.start], state.rope.position[nodes.end - 1]);
    let (chord, length) = (to - from, line.segments_m.iter().sum::<f64>());
    let span = chord.length();
    let load =
        load(model, &model.spec.ropes[line.rope], from.midpoint(to), chord.normalize_or_zero());
    if span >= length || span < 1e-6 {
        let pull = (model.spec.ropes[line.rope].axial_stiffness_n * (span / length - 1.0))
            .max(1e-3 * load.length() * length);
        state.rope.tension[model.line_segments[index].clone()].fill(pull);
        return;
    }
    let along = chord / span;
    let out = (load - along * load.dot(along))
        .try_normalize()
        .unwrap_or_else(|| along.any_orthonormal_vector());
    let mut places = arc(line, from, along, out, span, length);
    let tension = load.length() * 0.5 * length / half_angle(span / length);
    if let Some(seabed) = model.spec.seabed.as_ref().filter(|seabed| lies(seabed, &places)) {
        // The line is a bight on the seabed, on the downstream side of its ends.
        let level = |vector: DVec3| vector - seabed.normal * vector.dot(seabed.normal);
        let ahead = level(along).try_normalize().unwrap_or(along);
        let side = (level(load) - ahead * load.dot(ahead))
            .try_normalize()
            .unwrap_or_else(|| seabed.normal.cross(ahead));
        places = lie(seabed, line, from, to, ahead, side);
    }
    if let Some(seabed) = &model.spec.seabed {
        // Rope below the seabed is moved up to it.
        for place in &mut places {
            *place += seabed.normal * (seabed.depth_of(*place) - LAID_M).max(0.0);
        }
    }
    state.rope.position[nodes.start + 1..nodes.end - 1]
        .copy_from_slice(&places[1..nodes.len() - 1]);
    state.rope.tension[model.line_segments[index].clone()].fill(tension);
}

/// Nodes of a line along an arc from a point, with the chord along `along` and the bulge along `out`.
fn arc(line: &Line, from: DVec3, along: DVec3, out: DVec3, span: f64, length: f64) -> Vec<DVec3> {
    let half = half_angle(span / length);
    let radius = 0.5 * length / half;
    let middle = from + along * (0.5 * span) - out * (radius * libm::cos(half));
    let mut angle = -half;
    let mut places = vec![from];
    for segment in &line.segments_m {
        angle += segment / radius;
        places
            .push(middle + along * (radius * libm::sin(angle)) + out * (radius * libm::cos(angle)));
    }
    places
}

/// Lays a line on the seabed: down from each end, and in an arc on the seabed between; no segment is stretched.
fn lie(
    seabed: &Seabed,
    line: &Line,
    from: DVec3,
    to: DVec3,
    ahead: DVec3,
    side: DVec3,
) -> Vec<DVec3> {
    let whole: f64 = line.segments_m.iter().sum();
    let (first, last) = (-seabed.depth_of(from), -seabed.depth_of(to));
    let height =
        |along: f64| (first - DESCENT * along).max(last - DESCENT * (whole - along)).max(-LAID_M);
    // Length of each segment along the seabed.
    let (mut along, mut before, mut level) =
        (0.0, first, Vec::with_capacity(line.segments_m.len()));
    for segment in &line.segments_m {
        along += segment;
        let after = height(along);
        level.push(libm::sqrt((segment * segment - (after - before) * (after - before)).max(0.0)));
        before = after;
    }
    let (span, length) = ((to - from).dot(ahead), level.iter().sum::<f64>());
    let half = half_angle((span / length).min(1.0 - 1e-9));
    let radius = 0.5 * length / half;
    let (mut angle, mut along) = (-half, 0.0);
    let mut places = vec![from];
    for (segment, level) in line.segments_m.iter().zip(&level) {
        angle += level / radius;
        along += segment;
        let on = from
            + ahead * (0.5 * span + radius * libm::sin(angle))
            + side * (radius * (libm::cos(angle) - libm::cos(half)));
        places.push(on + seabed.normal * (seabed.depth_of(on) + height(along)));
    }
    places
}

/// Whether most nodes of a line are below the seabed.
fn lies(seabed: &Seabed, places: &[DVec3]) -> bool {
    let below = places.iter().filter(|place| seabed.depth_of(**place) > 0.0).count();
    2 * below > places.len()
}

/// Half of the angle of an arc with this ratio of chord to length, `sin(φ)/φ = share`, by bisection [rad].
fn half_angle(share: f64) -> f64 {
    let (mut low, mut high) = (1e-6, core::f64::consts::PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if libm::sin(middle) > share * middle { low = middle } else { high = middle }
    }
    low
}

/// Weight in water and drag per metre of rope with the direction `tangent` at a point [N/m].
fn load(model: &Model, rope: &Rope, place: DVec3, tangent: DVec3) -> DVec3 {
    let water = &model.spec.water;
    let weight = (water.density_kg_m3 * rope.displaced_m3_m - rope.mass_kg_m) * water.gravity_m_s2;
    let flow = model.sea.at(place, 0.0).velocity_m_s;
    let across = flow - tangent * flow.dot(tangent);
    DVec3::Z * weight
        + across
            * (0.5 * water.density_kg_m3 * rope.drag_normal * rope.diameter_m * across.length())
}
