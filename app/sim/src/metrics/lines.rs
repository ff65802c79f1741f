//! Tension of lines and weak links.

use std::ops::Range;

use endline_sdk::LineEnd;
use glam::DVec3;

use super::event::{EventKind, Log};
use super::gear_loads::line_drag;
use super::summary::{LineSummary, LinkSummary};
use super::whale::WhaleMeter;
use crate::model::Model;
use crate::state::State;

/// Peaks of every line and weak link.
#[derive(Clone, Debug)]
pub(super) struct LineMeter {
    lines: Vec<Peak>,
    links: Vec<Peak>,
}

/// A peak, its time, and whether parting has been reported.
#[derive(Clone, Copy, Debug, Default)]
struct Peak {
    tension_n: f64,
    at_s: f64,
    /// Greatest tension in solver steps that did not converge [N].
    unconverged_n: f64,
    told: bool,
}

/// Greatest tensions of the segments over the solver steps of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peaks<'a> {
    /// Over those that converged; zero where none did [N].
    pub converged_n: &'a [f64],
    /// Over those that did not; zero or empty where all did [N].
    pub unconverged_n: &'a [f64],
}

impl Peaks<'_> {
    /// Greatest tension of some segments, in solver steps that converged and in those that did not [N].
    fn of(&self, segments: Range<usize>) -> [f64; 2] {
        [self.converged_n, self.unconverged_n].map(|peaks| {
            let own = peaks.get(segments.clone()).unwrap_or_default();
            own.iter().copied().fold(0.0, f64::max)
        })
    }
}

impl Peak {
    fn take(&mut self, [tension_n, unconverged_n]: [f64; 2], time_s: f64) {
        if tension_n > self.tension_n {
            (self.tension_n, self.at_s) = (tension_n, time_s);
        }
        self.unconverged_n = self.unconverged_n.max(unconverged_n);
    }

    /// Greatest tension at all [N].
    fn greatest_n(&self) -> f64 {
        self.tension_n.max(self.unconverged_n)
    }
}

impl LineMeter {
    pub(super) fn new(model: &Model) -> Self {
        Self {
            lines: vec![Peak::default(); model.spec.lines.len()],
            links: vec![Peak::default(); model.spec.links.len()],
        }
    }

    /// Takes in a step with the greatest tension of each segment during it.
    pub(super) fn fold(&mut self, model: &Model, state: &State, peaks: &Peaks<'_>, log: &mut Log) {
        for (line, peak) in self.lines.iter_mut().enumerate() {
            peak.take(peaks.of(model.line_segments[line].clone()), state.time_s);
            if state.line_parted[line].is_some() && !peak.told {
                peak.told = true;
                log.note(
                    state.time_s,
                    EventKind::LineParted,
                    &model.spec.lines[line].id,
                    peak.greatest_n(),
                );
            }
        }
        for (index, (link, peak)) in model.spec.links.iter().zip(&mut self.links).enumerate() {
            let borne = end_segment(model, link.line, link.end)
                .map_or([0.0; 2], |(segment, ..)| peaks.of(segment..segment + 1));
            peak.take(borne, state.time_s);
            if state.link_parted_s[index].is_some() && !peak.told {
                peak.told = true;
                log.note(state.time_s, EventKind::LinkParted, &link.id, peak.greatest_n());
            }
        }
    }

    pub(super) fn lines(
        &self,
        model: &Model,
        state: &State,
        whale: Option<&WhaleMeter>,
    ) -> Vec<LineSummary> {
        let summary = |(index, peak): (usize, &Peak)| {
            let [whale_normal_n, whale_friction_n] =
                whale.map_or([0.0; 2], |whale| whale.on_line(index));
            let [twist, peak_twist] = whale.map_or([0.0; 2], |whale| whale.twist(model, index));
            LineSummary {
                drag_n: line_drag(model, state, index),
                whale_normal_n,
                whale_friction_n,
                twist,
                peak_twist,
                id: model.spec.lines[index].id.clone(),
                peak_tension_n: peak.tension_n,
                peak_at_s: peak.at_s,
                unconverged_peak_n: peak.unconverged_n,
                end_a_tension_n: end_tension(model, state, index, LineEnd::A),
                end_b_tension_n: end_tension(model, state, index, LineEnd::B),
                parted_at_s: state.line_parted[index].map(|(time, _)| time),
            }
        };
        self.lines.iter().enumerate().map(summary).collect()
    }

    pub(super) fn links(&self, model: &Model, state: &State) -> Vec<LinkSummary> {
        let summary = |(index, peak): (usize, &Peak)| LinkSummary {
            id: model.spec.links[index].id.clone(),
            rating_n: model.spec.links[index].rating_n,
            peak_tension_n: peak.tension_n,
            unconverged_peak_n: peak.unconverged_n,
            parted_at_s: state.link_parted_s[index],
        };
        self.links.iter().enumerate().map(summary).collect()
    }
}

/// Tension that a line's end bears at its joint [N]; zero where it is slack, cut or empty.
///
/// The tension of a lumped segment is that at its middle. Between there and the end hangs half a
/// segment's load, so the end bears `T + (l/2) (w e_z - f)`: `e` the unit vector along the segment to
/// the end, `w` the weight in water and `f` the drag along `e`, both per metre, and `l` its length.
#[must_use]
pub fn end_tension(model: &Model, state: &State, line: usize, end: LineEnd) -> f64 {
    let middle = end_segment_tension(model, state, line, end);
    let Some((segment, tip, inner)) = end_segment(model, line, end) else { return 0.0 };
    if middle <= 0.0 {
        return 0.0;
    }
    let Some(outward) = (state.rope.position[tip] - state.rope.position[inner]).try_normalize()
    else {
        return middle;
    };
    let length = state.rope.segment_length[segment];
    (middle - 0.5 * length * load_along(model, state, line, tip, outward)).max(0.0)
}

/// Weight, buoyancy and drag of a line's rope at a node, along a direction [N/m].
fn load_along(model: &Model, state: &State, line: usize, node: usize, along: DVec3) -> f64 {
    let (rope, water) = (&model.spec.ropes[model.spec.lines[line].rope], &model.spec.water);
    let place = state.rope.position[node];
    let flow = model.sea.at(place, state.time_s);
    let density =
        if water.rope_dries && place.z > flow.surface_m { 0.0 } else { water.density_kg_m3 };
    let speed = (flow.velocity_m_s - state.rope.velocity[node]).dot(along);
    let drag = 0.5
        * density
        * rope.drag_tangential
        * std::f64::consts::PI
        * rope.diameter_m
        * rope.drag_speed_along_m_s(speed)
        * speed;
    drag - (rope.mass_kg_m - density * rope.displaced_m3_m) * water.gravity_m_s2 * along.z
}

/// Tension of the segment at an end, never below zero [N].
fn end_segment_tension(model: &Model, state: &State, line: usize, end: LineEnd) -> f64 {
    end_segment(model, line, end).map_or(0.0, |(segment, ..)| {
        if state.rope.cut[segment] { 0.0 } else { state.rope.tension[segment].max(0.0) }
    })
}

/// The segment at an end, its node at the joint and its other node.
fn end_segment(model: &Model, line: usize, end: LineEnd) -> Option<(usize, usize, usize)> {
    let (segments, nodes) = (&model.line_segments[line], &model.line_nodes[line]);
    match end {
        _ if segments.is_empty() => None,
        LineEnd::A => Some((segments.start, nodes.start, nodes.start + 1)),
        LineEnd::B => Some((segments.end - 1, nodes.end - 1, nodes.end - 2)),
    }
}
