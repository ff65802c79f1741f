//! Mechanical energy of a rig.
//!
//! `E = Σ ½ m v² + ½ ω·Iω` (nodes and bodies) `+ Σ m g z + Σ (EA ε²/2 + EA2 ε³/3) l` (segments that are not
//! slack), with `ε` the strain, `l` the unstretched length of a segment and `EA2` the soft toe's stiffening. A node carries half of each segment beside it.
//! Buoyancy and added mass are not counted: this is for rigs in a vacuum, where nothing but a rope's own damping
//! and the time scheme may take energy away.

use glam::DMat3;

use crate::model::{EnergyForm, Model};
use crate::state::State;

/// Energy of a form now [J].
#[must_use]
pub fn energy(model: &Model, state: &State, form: EnergyForm) -> f64 {
    match form {
        EnergyForm::Total => kinetic(model, state) + height(model, state) + stretch(model, state),
        EnergyForm::Kinetic => kinetic(model, state),
        EnergyForm::Height => height(model, state),
        EnergyForm::Stretch => stretch(model, state),
    }
}

fn kinetic(model: &Model, state: &State) -> f64 {
    let rope: f64 = node_masses(model, state)
        .map(|(node, mass)| 0.5 * mass * state.rope.velocity[node].length_squared())
        .sum();
    let body = |(body, now): (&crate::model::Body, &crate::state::BodyState)| {
        let axes = DMat3::from_quat(now.orientation);
        let spin = axes.transpose() * now.spin;
        0.5 * (body.mass_kg * now.velocity.length_squared() + spin.dot(body.inertia_kg_m2 * spin))
    };
    rope + model.spec.bodies.iter().zip(&state.bodies).map(body).sum::<f64>()
}

fn height(model: &Model, state: &State) -> f64 {
    let rope: f64 =
        node_masses(model, state).map(|(node, mass)| mass * state.rope.position[node].z).sum();
    let bodies: f64 = model
        .spec
        .bodies
        .iter()
        .zip(&state.bodies)
        .map(|(body, now)| body.mass_kg * now.position.z)
        .sum();
    (rope + bodies) * model.spec.water.gravity_m_s2
}

fn stretch(model: &Model, state: &State) -> f64 {
    let of_segment = |(line, segment): (usize, usize)| {
        let own = &model.line_segments[line];
        let node = model.line_nodes[line].start + segment - own.start;
        let length = state.rope.segment_length[segment];
        let chord = (state.rope.position[node + 1] - state.rope.position[node]).length();
        let strain = if state.rope.cut[segment] { 0.0 } else { (chord / length - 1.0).max(0.0) };
        let rope = model.rope_of_segment(segment);
        (rope.axial_stiffness_n / 2.0 + rope.axial_stiffening_n * strain / 3.0)
            * strain
            * strain
            * length
    };
    let segments = model
        .line_segments
        .iter()
        .enumerate()
        .flat_map(|(line, own)| own.clone().map(move |segment| (line, segment)));
    segments.map(of_segment).sum()
}

/// Nodes with the mass of rope each carries [kg].
fn node_masses(model: &Model, state: &State) -> impl Iterator<Item = (usize, f64)> {
    model.spec.lines.iter().enumerate().flat_map(|(index, line)| {
        let mass_kg_m = model.spec.ropes[line.rope].mass_kg_m;
        let lengths = &state.rope.segment_length[model.line_segments[index].clone()];
        let length = |segment: Option<usize>| {
            segment.and_then(|segment| lengths.get(segment)).copied().unwrap_or(0.0)
        };
        let nodes = model.line_nodes[index].clone().enumerate();
        nodes.map(move |(place, node)| {
            (node, 0.5 * (length(place.checked_sub(1)) + length(Some(place))) * mass_kg_m)
        })
    })
}
