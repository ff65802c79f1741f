//! Forces on a body from the model's figures, summed apart from the solver.

use endline_sim::model::{Float, JointKind, Seabed};
use endline_sim::state::BodyState;
use endline_sim::{DVec3, Model, State};

/// Height over which rope goes under at the surface (docs/physics.md) [m].
const SURFACE_HEIGHT_M: f64 = 0.1;
/// Depth over which the seabed's push sets in (docs/physics.md) [m].
const ONSET_M: f64 = 0.01;

/// Sum of the vertical forces on a body: weight, floats, drag, seabed, line ends [N].
pub fn vertical(model: &Model, state: &State, index: usize) -> f64 {
    let (body, now) = (&model.spec.bodies[index], &state.bodies[index]);
    let water = &model.spec.water;
    let wet = |float: &Float| {
        float
            .form
            .wet((now.position + now.orientation * float.offset_m).z, now.orientation * DVec3::Z)
            .share
    };
    let displaced: f64 = body.floats.iter().map(|float| wet(float) * float.volume_m3).sum();
    let whole: f64 = body.floats.iter().map(|float| float.volume_m3).sum();
    let drag_by = |area: DVec3| {
        let flow = now.orientation.inverse() * water.velocity(now.position);
        now.orientation * (area * flow * flow.length()) * (0.5 * water.density_kg_m3)
    };
    let wet_share = if body.wetted_drag && whole > 0.0 { displaced / whole } else { 1.0 };
    let of_floats =
        body.floats.iter().map(|float| drag_by(float.drag_area_m2 * wet(float))).sum::<DVec3>();
    let drag = drag_by(body.drag_area_m2 * wet_share) + of_floats;
    let weight = (water.density_kg_m3 * displaced - body.mass_kg) * water.gravity_m_s2;
    weight + drag.z + seabed(model, now, &body.feet_m) + line_ends(model, state, index)
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

fn end_force(model: &Model, rope: usize, length_m: f64, [at, next]: [DVec3; 2]) -> f64 {
    let (rope, water) = (&model.spec.ropes[rope], &model.spec.water);
    let (chord, tangent) = ((next - at).length(), (next - at).normalize());
    let strain = (chord / length_m - 1.0).max(0.0);
    let tension = rope.axial_stiffness_n * strain + rope.axial_stiffening_n * strain * strain;
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
    tension * tangent.z + (weight + drag.z + bed) * (length_m / 2.0)
}

/// Push of a level seabed on a point, over its stiffness [m].
fn push(bed: &Seabed, at: DVec3) -> f64 {
    let depth = -bed.depth_m - at.z;
    let soft = depth.clamp(0.0, ONSET_M);
    soft * soft / (2.0 * ONSET_M) + (depth - ONSET_M).max(0.0)
}
