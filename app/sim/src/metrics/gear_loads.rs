//! Forces on each line and body of the gear now: drag of the water, and what the whale presses on rope.
//!
//! Drag of rope by Morison's law as the solver has it, `f_n = 1/2 rho C_n d |v_n| v_n` across and
//! `f_t = 1/2 rho C_t pi d w v_t` along (`w` of `Rope::drag_speed_along_m_s`), by metre at each node; of a body `1/2 rho |v| (C A) v` by its axes, over the wet
//! share of its floats. `v` is the water's velocity less that of the part.

use std::f64::consts::PI;

use glam::DVec3;

use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::State;

/// Drag of the water on a line's rope [N].
pub(super) fn line_drag(model: &Model, state: &State, line: usize) -> DVec3 {
    let (rope, water) = (&model.spec.ropes[model.spec.lines[line].rope], &model.spec.water);
    let (nodes, segments) = (model.line_nodes[line].clone(), &model.line_segments[line]);
    let on_segment = |(node, segment): (usize, usize)| {
        let [from, to] = [node, node + 1].map(|node| state.rope.position[node]);
        let (place, velocity) =
            (from.midpoint(to), state.rope.velocity[node].midpoint(state.rope.velocity[node + 1]));
        let flow = model.sea.at(place, state.time_s);
        if water.rope_dries && place.z > flow.surface_m {
            return DVec3::ZERO;
        }
        let way = (to - from).normalize_or_zero();
        let relative = flow.velocity_m_s - velocity;
        let along = way * relative.dot(way);
        let across = relative - along;
        let by_metre = across * (rope.drag_normal * across.length())
            + along * (PI * rope.drag_tangential * rope.drag_speed_along_m_s(along.length()));
        by_metre
            * (0.5 * water.density_kg_m3 * rope.diameter_m * state.rope.segment_length[segment])
    };
    nodes.zip(segments.clone()).map(on_segment).sum()
}

/// Drag of the water on a body [N].
pub(super) fn body_drag(model: &Model, state: &State, body: usize) -> DVec3 {
    let (spec, now) = (&model.spec.bodies[body], &state.bodies[body]);
    let flow = model.sea.at(now.position, state.time_s);
    let relative = now.orientation.inverse() * (flow.velocity_m_s - now.velocity);
    let half = 0.5 * model.spec.water.density_kg_m3 * relative.length();
    let axis = now.orientation * DVec3::Z;
    let share = |float: &crate::model::Float| {
        let height = now.position.z + (now.orientation * float.offset_m).z - flow.surface_m;
        float.form.wet(height, axis).facing
    };
    let (mut area, mut wet, mut volume) = (DVec3::ZERO, 0.0, 0.0);
    for float in &spec.floats {
        let share = share(float);
        area += float.drag_area_m2 * share;
        (wet, volume) = (wet + share * float.volume_m3, volume + float.volume_m3);
    }
    let wet = if spec.wetted_drag && volume > 0.0 { wet / volume } else { 1.0 };
    now.orientation * ((area + spec.drag_area_m2 * wet) * relative * half)
}

/// Push and friction of the whale on a line: sums of their sizes [N].
pub(super) fn on_line(contacts: &[ContactPoint], line: usize) -> [f64; 2] {
    let own = contacts.iter().filter(|contact| contact.line == line);
    own.fold([0.0; 2], |[normal, friction], contact| {
        [normal + contact.normal_force_n, friction + contact.friction_n.length()]
    })
}
