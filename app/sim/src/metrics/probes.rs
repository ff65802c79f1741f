//! Probes: last, least, greatest and mean reading; and mechanical energy of the gear.
//!
//! `E = Σ ½ m v² + ½ ω·Iω` (nodes and bodies) `+ Σ m g z + Σ (EA ε²/2 + EA2 ε³/3) l` (taut segments) [J], with `m` mass [kg],
//! `v` velocity [m/s],
//! `I` inertia [kg m²], `ω` spin [rad/s], `ε` the strain, `l` the unstretched length of a segment [m], and `EA`, `EA2` its
//! stiffnesses [N]. A node has half of the mass of each adjacent segment. Buoyancy and added mass are not included: in a
//! vacuum, only damping of rope and the time scheme dissipate this energy.
//! Reference: the stretch energy is the integral of the rope law of [`Rope`](crate::model::Rope).

use glam::DMat3;

use super::lines;
use super::lines::end_tension;
use super::summary::ProbeSummary;
use crate::model::{EnergyForm, Hitch, Model, ProbeTarget, WhaleFigure};
use crate::state::State;
use crate::whale::pose;

/// Readings of all probes.
#[derive(Clone, Debug)]
pub(super) struct ProbeMeter {
    tracks: Vec<Track>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Track {
    last: Option<f64>,
    min: f64,
    max: f64,
    /// Integral of the readings over time, by the trapezium rule.
    sum: f64,
    time_s: f64,
}

impl ProbeMeter {
    pub(super) fn new(model: &Model) -> Self {
        Self { tracks: vec![Track::default(); model.spec.probes.len()] }
    }

    /// Adds a reading of each probe; `dt_s` is the time since the previous one.
    pub(super) fn fold(&mut self, model: &Model, state: &State, dt_s: f64) {
        for (track, probe) in self.tracks.iter_mut().zip(&model.spec.probes) {
            track.take(reading(model, state, probe.target), dt_s);
        }
    }

    pub(super) fn summary(&self, model: &Model) -> Vec<ProbeSummary> {
        let summary = |(track, probe): (&Track, &crate::model::Probe)| ProbeSummary {
            id: probe.id.clone(),
            unit: unit(probe.target),
            last: track.last.unwrap_or(0.0),
            min: track.min,
            max: track.max,
            mean: if track.time_s > 0.0 {
                track.sum / track.time_s
            } else {
                track.last.unwrap_or(0.0)
            },
        };
        self.tracks.iter().zip(&model.spec.probes).map(summary).collect()
    }
}

impl Track {
    fn take(&mut self, reading: f64, dt_s: f64) {
        (self.min, self.max) = match self.last {
            None => (reading, reading),
            Some(_) => (self.min.min(reading), self.max.max(reading)),
        };
        self.sum += 0.5 * (self.last.unwrap_or(reading) + reading) * dt_s;
        self.time_s += dt_s;
        self.last = Some(reading);
    }
}

/// Unit of a probe's readings: `N`, `m`, `J`, `m/s` or `W`.
pub fn unit(target: ProbeTarget) -> &'static str {
    match target {
        ProbeTarget::EndTension(..)
        | ProbeTarget::TensionAt(..)
        | ProbeTarget::Whale(
            WhaleFigure::Thrust | WhaleFigure::BodyDrag | WhaleFigure::ContactForce,
        ) => "N",
        ProbeTarget::Whale(WhaleFigure::Speed) => "m/s",
        ProbeTarget::Whale(WhaleFigure::Power) => "W",
        ProbeTarget::Energy(_) => "J",
        ProbeTarget::LineAt(..)
        | ProbeTarget::Height(..)
        | ProbeTarget::LineMiddle(..)
        | ProbeTarget::Joint(..)
        | ProbeTarget::Body { .. }
        | ProbeTarget::WhaleOrigin(_)
        | ProbeTarget::Skin(..) => "m",
    }
}

/// Reading of a probe in a state; zero if its target does not exist.
pub fn reading(model: &Model, state: &State, target: ProbeTarget) -> f64 {
    let coordinate = |place: Option<glam::DVec3>, axis: usize| {
        place.and_then(|place| place.to_array().get(axis).copied()).unwrap_or(0.0)
    };
    match target {
        ProbeTarget::EndTension(line, end) => end_tension(model, state, line, end),
        ProbeTarget::TensionAt(line, length_m) => lines::tension(model, state, line, length_m),
        ProbeTarget::LineAt(line, length_m, axis) => {
            coordinate(lines::place(model, state, line, length_m), axis)
        }
        ProbeTarget::Height(line, away_m) => lines::height(model, state, line, away_m),
        ProbeTarget::Energy(form) => energy(model, state, form),
        ProbeTarget::LineMiddle(line, axis) => coordinate(lines::middle(model, state, line), axis),
        ProbeTarget::Joint(joint, axis) => coordinate(state.joint_place(model, joint), axis),
        ProbeTarget::Body { body, offset_m, axis } => coordinate(
            state.bodies.get(body).map(|body| body.position + body.orientation * offset_m),
            axis,
        ),
        ProbeTarget::WhaleOrigin(axis) => {
            coordinate(state.whale.as_ref().map(|whale| whale.position), axis)
        }
        ProbeTarget::Skin(hitch, axis) => coordinate(on_skin(model, state, &hitch), axis),
        ProbeTarget::Whale(figure) => of_whale(state, figure),
    }
}

/// Place of a point of the skin in the whale's present posture [m].
fn on_skin(model: &Model, state: &State, hitch: &Hitch) -> Option<glam::DVec3> {
    let (whale, now) = model.spec.whale.as_ref().zip(state.whale.as_ref())?;
    let mut bones = Vec::new();
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut bones);
    Some(hitch.place(&whale.skin, &bones))
}

fn of_whale(state: &State, figure: WhaleFigure) -> f64 {
    let Some(whale) = &state.whale else { return 0.0 };
    match figure {
        WhaleFigure::Speed => whale.speed_m_s,
        WhaleFigure::Thrust => whale.exertion.thrust_n,
        WhaleFigure::Power => whale.exertion.power_w,
        WhaleFigure::BodyDrag => whale.exertion.drag_n,
        WhaleFigure::ContactForce => whale.contact_force_n.iter().sum(),
    }
}

/// Energy of a form in a state [J].
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

/// Nodes with the mass of rope of each [kg].
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
