//! Forces along and on a rope with rope held as lines: the laws of `laws.rs`, node after node, and the lengths that they read.
//!
//! Statics adds what the laws leave out: with `D` the drag, `d` the chord between a node's neighbours and `t` its direction,
//! `∂D/∂t (1 - t tᵀ)/|d|` couples a node to its neighbours, and makes iterations converge quadratically.

use crate::bits::same_bits;
use crate::forces::Forces;
use crate::forces::axial::Axial;
use crate::forces::laws::{self as forces, NodeAt, PerMetre, PullOf, SegmentAt, Shared};
use crate::matrix::outer;
use crate::model::Model;
use crate::simd::space::Sym3;
use crate::system::LinearSystem;
use crate::trial::Trial;
use crate::trial::scheme::Scheme;
use core::ops::Range;
use glam::{DMat3, DVec3};

/// Least chord that is divided by [m].
const TINY_M: f64 = 1e-9;

impl Forces {
    /// Adds inertia, weight, buoyancy and drag of every node.
    pub(crate) fn add_nodes(
        &self,
        model: &Model,
        scheme: &Scheme,
        trial: &Trial,
        system: &mut LinearSystem,
    ) {
        let shared = Shared::of(model, scheme);
        // An anchored pass has its pseudo-mass from `add_anchors`.
        let shared = if scheme.anchored { Shared { inertia: 0.0, ..shared } } else { shared };
        for (index, line) in model.spec.lines.iter().enumerate() {
            let rope = PerMetre::of(&model.spec.ropes[line.rope], &model.spec.water);
            let nodes = &model.line_nodes[index];
            for node in nodes.clone() {
                let at = self.node_at(trial, node, nodes);
                let (force, block) = forces::node(&rope, &shared, &at);
                system.rope.force[node] += DVec3::from(force);
                system.rope.diagonal[node] += DMat3::from(block);
                if scheme.is_static() {
                    self.add_drag_turn(
                        trial,
                        system,
                        [node, node - index],
                        nodes,
                        (&rope, &shared),
                    );
                }
            }
            if scheme.anchored {
                self.add_anchors(
                    trial,
                    system,
                    nodes,
                    (rope.mass + rope.added) * scheme.inertia * self.pseudo_mass_scale[index],
                );
            }
        }
    }

    /// Adds the force back to where an anchored iteration of statics began, by pseudo-mass per metre [kg/m/s²].
    fn add_anchors(
        &self,
        trial: &Trial,
        system: &mut LinearSystem,
        nodes: &Range<usize>,
        pull: f64,
    ) {
        for node in nodes.clone() {
            let stiffness = pull * self.lengths.node[node];
            system.rope.force[node] -= (trial.place[node] - trial.place_history[node]) * stiffness;
            system.rope.diagonal[node] += DMat3::from_diagonal(DVec3::splat(stiffness));
        }
    }

    pub(crate) fn node_at(&self, trial: &Trial, node: usize, nodes: &Range<usize>) -> NodeAt<f64> {
        let [before, after] = neighbours(node, nodes);
        NodeAt {
            place: trial.place[node].into(),
            before: trial.place[before].into(),
            after: trial.place[after].into(),
            place_history: trial.place_history[node].into(),
            velocity_history: trial.velocity_history[node].into(),
            flow: self.water.flow[node].into(),
            surface: self.water.surface_at(node),
            length: self.lengths.node[node],
        }
    }

    /// Adds the derivative of a node's drag at rest by the places of its neighbours.
    fn add_drag_turn(
        &self,
        trial: &Trial,
        system: &mut LinearSystem,
        [node, segment]: [usize; 2],
        nodes: &Range<usize>,
        (rope, shared): (&PerMetre<f64>, &Shared<f64>),
    ) {
        let wet = shared.wet_at(trial.place[node].z - self.water.surface_at(node))
            * self.lengths.node[node];
        let (tangent, inverse_chord) = tangent(&trial.place, node, nodes);
        let turn = drag_by_tangent(self.water.flow[node], tangent, rope, wet) * inverse_chord;
        if node + 1 < nodes.end {
            system.rope.up[segment] -= turn;
        } else {
            system.rope.diagonal[node] -= turn;
        }
        if node > nodes.start {
            system.rope.low[segment - 1] += turn;
        } else {
            system.rope.diagonal[node] += turn;
        }
    }

    /// Sets the tension of every segment to that by the law at the trial places.
    pub(crate) fn measure_tension(&self, model: &Model, scheme: &Scheme, trial: &mut Trial) {
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (node, segment) in (first_node..).zip(segments.clone()) {
                trial.tension[segment] = if self.cut[segment] {
                    0.0
                } else {
                    self.pull_of(segment, node, scheme, trial).tension
                };
            }
        }
    }

    /// Adds the pull of every segment that is taut.
    pub(crate) fn add_tension(
        &mut self,
        model: &Model,
        scheme: &Scheme,
        trial: &Trial,
        system: &mut LinearSystem,
    ) {
        for index in 0..model.spec.lines.len() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index].clone().enumerate() {
                self.add_segment(segment, first_node + k, scheme, trial, system);
            }
        }
    }

    fn add_segment(
        &mut self,
        segment: usize,
        node: usize,
        scheme: &Scheme,
        trial: &Trial,
        system: &mut LinearSystem,
    ) {
        if self.cut[segment] {
            self.pull[segment] = Pull::default();
            return;
        }
        let pull = self.law_between(
            segment,
            node,
            scheme,
            trial,
            trial.place[node + 1] - trial.place[node],
        );
        let taut = trial.tension[segment] > 0.0;
        let across = trial.tension[segment].max(0.0) * pull.inverse_chord;
        self.pull[segment] = Pull { taut, across, ..Pull::of(&pull) };
        if taut {
            self.add_pull(system, segment, node, 1.0);
        }
    }

    /// Adds the pull of a segment and its block; subtracts them if `sign` is negative.
    fn add_pull(&self, system: &mut LinearSystem, segment: usize, node: usize, sign: f64) {
        let Pull { direction, tension, stiffness, across, .. } = self.pull[segment];
        let force = direction * (sign * tension);
        let block =
            DMat3::from(Sym3::round(sign * across, direction.into(), sign * (stiffness - across)));
        system.rope.force[node] += force;
        system.rope.force[node + 1] -= force;
        system.rope.diagonal[node] += block;
        system.rope.diagonal[node + 1] += block;
        system.rope.up[segment] -= block;
        system.rope.low[segment] -= block;
    }

    /// After a solution: makes exactly the segments pull that are taut by the linear solution; returns the nodes whose forces changed, if
    /// there are any.
    pub(crate) fn change_taut(
        &mut self,
        model: &Model,
        trial: &Trial,
        system: &mut LinearSystem,
    ) -> Option<&[bool]> {
        self.changed.clear();
        self.changed.resize(model.node_count, false);
        let mut any = false;
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in segments.clone().enumerate() {
                let tension = trial.tension[segment];
                let pull = self.pull[segment];
                if pull.taut == (tension > 0.0) || self.cut[segment] {
                    continue;
                }
                any = true;
                self.changed[first_node + k] = true;
                self.changed[first_node + k + 1] = true;
                if pull.taut {
                    self.add_pull(system, segment, first_node + k, -1.0);
                    self.pull[segment].taut = false;
                } else {
                    let chord =
                        trial.place[first_node + k + 1].distance(trial.place[first_node + k]);
                    self.pull[segment].across = tension / chord.max(TINY_M);
                    self.pull[segment].taut = true;
                    self.add_pull(system, segment, first_node + k, 1.0);
                }
            }
        }
        any.then_some(&self.changed)
    }

    /// Tension of a segment at the trial places, before it is judged taut or slack.
    pub(crate) fn pull_of(
        &self,
        segment: usize,
        node: usize,
        scheme: &Scheme,
        trial: &Trial,
    ) -> Pull {
        let between = trial.place[node + 1] - trial.place[node];
        Pull::of(&self.law_between(segment, node, scheme, trial, between))
    }

    /// Tension of a segment with the trial moved by a share of the solved step.
    pub(crate) fn pull_moved(
        &self,
        segment: usize,
        node: usize,
        scheme: &Scheme,
        (trial, system): (&Trial, &LinearSystem),
        share: f64,
    ) -> Pull {
        let between = trial.place[node + 1] - trial.place[node];
        let moved = (system.rope.step[node + 1] - system.rope.step[node]) * share;
        Pull::of(&self.law_between(segment, node, scheme, trial, between + moved))
    }

    fn law_between(
        &self,
        segment: usize,
        node: usize,
        scheme: &Scheme,
        trial: &Trial,
        between: DVec3,
    ) -> PullOf<f64> {
        let length = self.lengths.segment[segment];
        let at = SegmentAt {
            between: between.into(),
            history: (trial.place_history[node + 1] - trial.place_history[node]).into(),
            length,
            inverse_length: 1.0 / length,
            law: self.lengths.axial[segment],
            predicted: trial.tension[segment],
        };
        forces::pull(&at, scheme.rate)
    }

    /// After a solution: sets the tension of each segment to that of the linear solution.
    pub(crate) fn predict_tension(
        &self,
        model: &Model,
        trial: &mut Trial,
        system: &LinearSystem,
        share: f64,
    ) {
        for (index, _) in model.spec.lines.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index].clone().enumerate() {
                let pull = &self.pull[segment];
                trial.tension[segment] = pull.tension
                    + pull.stiffness * pull.stretch(&system.rope.step, first_node + k) * share;
            }
        }
    }
}

/// Axial law of a segment at the trial places.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pull {
    pub direction: DVec3,
    pub tension: f64,
    pub stiffness: f64,
    /// Stiffness across: predicted tension over length [N/m].
    pub across: f64,
    /// Whether it pulls in the last solution.
    pub taut: bool,
}

impl Pull {
    fn of(pull: &PullOf<f64>) -> Self {
        Self {
            direction: pull.direction.into(),
            tension: pull.tension,
            stiffness: pull.stiffness,
            across: 0.0,
            taut: false,
        }
    }

    /// How much the solved step stretches the segment [m].
    pub fn stretch(&self, step: &[DVec3], node: usize) -> f64 {
        self.direction.dot(step[node + 1] - step[node])
    }
}

/// Derivative of the drag on a wet length by the tangent, kept a unit vector [N].
fn drag_by_tangent(relative: DVec3, tangent: DVec3, rope: &PerMetre<f64>, wet: f64) -> DMat3 {
    let (across, along) = (rope.across * wet, rope.along * wet);
    let along_speed = relative.dot(tangent);
    let normal = relative - tangent * along_speed;
    let normal_speed = normal.length();
    let mut of_normal = DMat3::from_diagonal(DVec3::splat(across * normal_speed));
    if normal_speed > 1e-12 {
        of_normal += outer(normal, normal) * (across / normal_speed);
    }
    let identity = DMat3::IDENTITY;
    let turn_of_normal = (outer(tangent, relative) + identity * along_speed) * -1.0;
    let speed = along_speed.abs();
    let turn_of_along = outer(tangent, relative) * (2.0 * speed) + identity * (speed * along_speed);
    let unit = identity - outer(tangent, tangent);
    let mut turn = of_normal * turn_of_normal + turn_of_along * along;
    if rope.along_root > 0.0 {
        let root = rope.along_root * wet * speed.sqrt();
        turn += outer(tangent, relative) * (1.5 * root) + identity * (root * along_speed);
    }
    turn * unit
}

/// The nodes before and after one in its line, or itself at an end.
fn neighbours(node: usize, nodes: &Range<usize>) -> [usize; 2] {
    [
        if node > nodes.start { node - 1 } else { node },
        if node + 1 < nodes.end { node + 1 } else { node },
    ]
}

/// Direction of a line at a node from its neighbours, and the inverse of the chord it was taken over.
pub(crate) fn tangent(place: &[DVec3], node: usize, nodes: &Range<usize>) -> (DVec3, f64) {
    let [before, after] = neighbours(node, nodes);
    let chord = place[after] - place[before];
    let length = chord.length();
    if length > 1e-12 { (chord / length, 1.0 / length) } else { (DVec3::Z, 0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rope of one metre in water that flows past it, its neighbours at either end, moving.
    fn moving() -> (PerMetre<f64>, Shared<f64>, NodeAt<f64>) {
        let rope = PerMetre {
            mass: 0.07,
            added: 0.05,
            spared: 0.04,
            weight: 0.7,
            lift: 0.6,
            across: 6.0,
            along: 0.3,
            along_root: 0.2,
        };
        let shared =
            Shared { rate: 150.0, inertia: 22_500.0, wet: 0.5, drying: 10.0, viscous: true };
        let (place, tangent) = (DVec3::new(0.3, -0.2, 0.01), DVec3::new(0.1, 0.2, 0.9).normalize());
        let at = NodeAt {
            place: place.into(),
            before: (place - tangent).into(),
            after: (place + tangent).into(),
            place_history: (place - DVec3::new(2e-3, -1e-3, 3e-3)).into(),
            velocity_history: DVec3::new(0.2, -0.1, 0.3).into(),
            flow: DVec3::new(0.4, -0.3, 0.2).into(),
            surface: 0.0,
            length: 1.0,
        };
        (rope, shared, at)
    }

    fn force(rope: &PerMetre<f64>, shared: &Shared<f64>, at: &NodeAt<f64>) -> DVec3 {
        forces::node(rope, shared, at).0.into()
    }

    /// The block against central differences of the force; at a height where drag and buoyancy are whole or gone, and at one
    /// where only buoyancy fades.
    #[test]
    fn the_block_of_a_node_is_the_derivative_of_its_force() {
        for (surface, across) in [(1.0, 6.0), (-1.0, 6.0), (0.0, 0.0)] {
            let (rope, shared, at) = moving();
            let rope = if across > 0.0 {
                rope
            } else {
                PerMetre { across, along: 0.0, along_root: 0.0, added: 0.0, spared: 0.0, ..rope }
            };
            let at = NodeAt { surface, ..at };
            let block = DMat3::from(forces::node(&rope, &shared, &at).1);
            let step = 1e-6;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let [ahead, behind] = [step, -step].map(|by| {
                    let place = (DVec3::from(at.place) + axis * by).into();
                    force(&rope, &shared, &NodeAt { place, ..at })
                });
                let difference = (behind - ahead) / (2.0 * step);
                assert!(
                    (block * axis - difference).length() < 1e-6 * difference.length(),
                    "{surface}: {block} {difference}"
                );
            }
        }
    }

    #[test]
    fn drag_turns_with_the_tangent_as_its_derivative_says() {
        let (rope, shared, at) = moving();
        let at = NodeAt { surface: 1.0, ..at };
        let shared = Shared { inertia: 0.0, rate: 0.0, ..shared };
        let chord = DVec3::from(at.after) - DVec3::from(at.before);
        let turn = drag_by_tangent(at.flow.into(), chord.normalize(), &rope, 1.0) / chord.length();
        let step = 1e-6;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let [ahead, behind] = [step, -step].map(|by| {
                let after = (DVec3::from(at.after) + axis * by).into();
                force(&rope, &shared, &NodeAt { after, ..at })
            });
            assert!((turn * axis - (ahead - behind) / (2.0 * step)).length() < 1e-6);
        }
    }
}

/// Lengths of a step, taken from the state it begins from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lengths {
    /// Unstretched length of each segment [m].
    pub segment: Vec<f64>,
    /// Length of the shortest segment [m].
    pub shortest: f64,
    /// Unstretched length assigned to each node: half of its segments in the same line [m].
    pub node: Vec<f64>,
    /// Axial law of each segment.
    pub axial: Vec<Axial>,
}

impl Lengths {
    /// Copies the lengths of a state, if they have changed.
    pub fn take(&mut self, model: &Model, segment_length: &[f64]) {
        if self.shortest > 0.0 && same_bits(&self.segment, segment_length) {
            return;
        }
        self.segment.clear();
        self.segment.extend_from_slice(segment_length);
        self.shortest = segment_length.iter().copied().fold(f64::INFINITY, f64::min);
        self.axial.clear();
        self.axial.extend(
            segment_length
                .iter()
                .enumerate()
                .map(|(segment, length)| Axial::of(model.rope_of_segment(segment), *length)),
        );
        self.node.clear();
        self.node.resize(model.node_count, 0.0);
        for (nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
            for (node, length) in (nodes.start..).zip(&segment_length[segments.clone()]) {
                self.node[node] += 0.5 * length;
                self.node[node + 1] += 0.5 * length;
            }
        }
    }
}
