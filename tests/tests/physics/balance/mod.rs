//! Forces on a body from the model's figures, summed apart from the solver.

use std::collections::BTreeMap;

use endline_sim::model::{Float, JointKind, Seabed};
use endline_sim::state::BodyState;
use endline_sim::{DVec3, Model, State};

/// Height over which rope goes under at the surface (docs/physics.md) [m].
const SURFACE_HEIGHT_M: f64 = 0.1;
/// Depth over which the seabed's push sets in (docs/physics.md) [m].
const ONSET_M: f64 = 0.01;

/// Sum of the vertical forces on a body: weight, floats, drag, seabed, line ends, rope that rests on it [N].
pub fn vertical(model: &Model, state: &State, index: usize) -> f64 {
    let (body, now) = (&model.spec.bodies[index], &state.bodies[index]);
    let water = &model.spec.water;
    let wet = |float: &Float| {
        float
            .form
            .wet((now.position + now.orientation * float.offset_m).z, now.orientation * DVec3::Z)
    };
    let displaced: f64 = body.floats.iter().map(|float| wet(float).share * float.volume_m3).sum();
    let facing: f64 = body.floats.iter().map(|float| wet(float).facing * float.volume_m3).sum();
    let whole: f64 = body.floats.iter().map(|float| float.volume_m3).sum();
    let constants = [water.density_kg_m3, water.gravity_m_s2];
    let passing = body.passing(water.velocity(now.position), constants, wet);
    let drag_by = |area: DVec3| {
        let flow = now.orientation.inverse() * water.velocity(now.position);
        let half = 0.5 * water.density_kg_m3 * (1.0 + passing.waves);
        now.orientation * (area * flow * flow.length()) * half
    };
    let plane: f64 = body.floats.iter().map(|float| wet(float).slope * float.volume_m3).sum();
    let wet_share = if body.wetted_drag && whole > 0.0 { facing / whole } else { 1.0 };
    let of_floats = body
        .floats
        .iter()
        .map(|float| drag_by(float.drag_area_m2 * wet(float).facing))
        .sum::<DVec3>();
    let drag = drag_by(body.drag_area_m2 * wet_share) + of_floats;
    let weight = (water.density_kg_m3 * displaced - body.mass_kg) * water.gravity_m_s2;
    weight - passing.pull_pa * plane
        + drag.z
        + seabed(model, now, &body.feet_m)
        + line_ends(model, state, index)
        + resting(model, state, index)
}

/// What rope near a body lacks to balance itself, away from its ends at bodies and fixtures: that it rests on the body with [N].
/// Rope near several bodies rests on the one that it comes nearest to.
fn resting(model: &Model, state: &State, index: usize) -> f64 {
    let apart_m = |body: usize, free: &FreePlace| {
        let corners = model.spec.bodies[body].corners();
        let reach_m = corners.map(DVec3::length).fold(0.0, f64::max);
        free.distance_m(state.bodies[body].position) - reach_m
    };
    let rests_here = |free: &&FreePlace| {
        let mine = apart_m(index, free);
        mine < 0.0 && (0..model.spec.bodies.len()).all(|other| apart_m(other, free) >= mine)
    };
    free_places(model, state).values().filter(rests_here).map(|free| free.force_n).sum()
}

/// A free joint, or a node within a line.
struct FreePlace {
    place: DVec3,
    /// The nodes beside it.
    beside: Vec<DVec3>,
    /// Vertical force of rope on it [N].
    force_n: f64,
}

impl FreePlace {
    /// Distance of the segments beside it from a place [m].
    fn distance_m(&self, from: DVec3) -> f64 {
        let to_segment = |end: &DVec3| {
            let along = *end - self.place;
            let share = (from - self.place).dot(along) / along.length_squared();
            from.distance(self.place + along * share.clamp(0.0, 1.0))
        };
        self.beside.iter().map(to_segment).fold(f64::INFINITY, f64::min)
    }
}

/// Every free joint, and every node within a line.
fn free_places(model: &Model, state: &State) -> BTreeMap<(bool, usize), FreePlace> {
    let mut places = BTreeMap::new();
    for ((line, nodes), segments) in
        model.spec.lines.iter().zip(&model.line_nodes).zip(&model.line_segments)
    {
        let position = &state.rope.position[nodes.clone()];
        let lengths = &state.rope.segment_length[segments.clone()];
        for (k, node) in nodes.clone().enumerate() {
            let key = match k {
                0 => (true, line.from),
                _ if k == lengths.len() => (true, line.to),
                _ => (false, node),
            };
            if key.0 && !matches!(model.spec.joints[key.1].kind, JointKind::Free) {
                continue;
            }
            let [before, after] = [k.saturating_sub(1), (k + 1).min(lengths.len())];
            let beside = &lengths[before..after];
            let tangent = (position[after] - position[before]).normalize();
            let pull = |other: usize, length_m: f64| {
                pull_z(model, line.rope, length_m, [position[k], position[other]])
            };
            let pulls: f64 = [before, after]
                .into_iter()
                .filter(|other| *other != k)
                .map(|other| pull(other, lengths[k.min(other)]))
                .sum();
            let hanging_m = 0.5 * beside.iter().sum::<f64>();
            let force_n = pulls + load_z(model, line.rope, position[k], tangent) * hanging_m;
            let free = places.entry(key).or_insert_with(|| FreePlace {
                place: position[k],
                beside: Vec::new(),
                force_n: 0.0,
            });
            free.beside.extend(
                [before, after]
                    .into_iter()
                    .filter(|other| *other != k)
                    .map(|other| position[other]),
            );
            free.force_n += force_n;
        }
    }
    places
}

/// Upward push of a level seabed on a body's feet [N].
fn seabed(model: &Model, now: &BodyState, feet_m: &[DVec3]) -> f64 {
    let bed = model.spec.seabed.as_ref().unwrap();
    let press =
        |foot: &DVec3| bed.foot_stiffness_n_m * push(bed, now.position + now.orientation * *foot);
    feet_m.iter().map(press).sum()
}

/// Pull of the lines that end at a body, with weight and drag of the half segment next to it [N].
fn line_ends(model: &Model, state: &State, index: usize) -> f64 {
    let at_body = |joint: usize| matches!(model.spec.joints[joint].kind, JointKind::Body { body, .. } if body == index);
    let mut sum = 0.0;
    for ((line, nodes), segments) in
        model.spec.lines.iter().zip(&model.line_nodes).zip(&model.line_segments)
    {
        if at_body(line.from) {
            let length = state.rope.segment_length[segments.start];
            sum += end_force(
                model,
                line.rope,
                length,
                [nodes.start, nodes.start + 1].map(|node| state.rope.position[node]),
            );
        }
        if at_body(line.to) {
            let length = state.rope.segment_length[segments.end - 1];
            sum += end_force(
                model,
                line.rope,
                length,
                [nodes.end - 1, nodes.end - 2].map(|node| state.rope.position[node]),
            );
        }
    }
    sum
}

/// Pull of a segment on its end, with weight, drag and bed of the half of it next to it [N].
fn end_force(model: &Model, rope: usize, length_m: f64, [at, next]: [DVec3; 2]) -> f64 {
    let tangent = (next - at).normalize();
    pull_z(model, rope, length_m, [at, next]) + load_z(model, rope, at, tangent) * (length_m / 2.0)
}

/// Upward pull of a segment on its end [N].
fn pull_z(model: &Model, rope: usize, length_m: f64, [at, next]: [DVec3; 2]) -> f64 {
    let (rope, between) = (&model.spec.ropes[rope], next - at);
    let strain = (between.length() / length_m - 1.0).max(0.0);
    let tension = rope.axial_stiffness_n * strain + rope.axial_stiffening_n * strain * strain;
    tension * between.normalize().z
}

/// Upward force of weight, drag and bed on a metre of rope [N/m].
fn load_z(model: &Model, rope: usize, at: DVec3, tangent: DVec3) -> f64 {
    let (rope, water) = (&model.spec.ropes[rope], &model.spec.water);
    let wet = (0.5 - at.z / SURFACE_HEIGHT_M).clamp(0.0, 1.0);
    let weight =
        (water.density_kg_m3 * rope.displaced_m3_m * wet - rope.mass_kg_m) * water.gravity_m_s2;
    let flow = water.velocity(at);
    let along = tangent * flow.dot(tangent);
    let across = flow - along;
    let sides = across * (across.length() * rope.drag_normal)
        + along * (along.length() * rope.drag_tangential * std::f64::consts::PI);
    let drag = sides * (0.5 * water.density_kg_m3 * rope.diameter_m * wet);
    // An end that lies on the bed itself, as that of an overturned trap, is pushed up too.
    let bed = model.spec.seabed.as_ref().map_or(0.0, |bed| push(bed, at) * bed.rope_stiffness_n_m2);
    weight + drag.z + bed
}

/// Push of a level seabed on a point, over its stiffness [m].
fn push(bed: &Seabed, at: DVec3) -> f64 {
    let depth = -bed.depth_m - at.z;
    let soft = depth.clamp(0.0, ONSET_M);
    soft * soft / (2.0 * ONSET_M) + (depth - ONSET_M).max(0.0)
}
