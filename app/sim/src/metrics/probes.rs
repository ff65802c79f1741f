//! Probes: last, least, greatest and mean reading.

use super::along;
use super::energy::energy;
use super::lines::end_tension;
use super::summary::ProbeSummary;
use crate::model::{Model, ProbeTarget, WhaleFigure};
use crate::state::State;

/// What every probe has read.
#[derive(Clone, Debug)]
pub(super) struct ProbeMeter {
    tracks: Vec<Track>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Track {
    last: Option<f64>,
    min: f64,
    max: f64,
    /// Reading times time, by the trapezium rule.
    sum: f64,
    time_s: f64,
}

impl ProbeMeter {
    pub(super) fn new(model: &Model) -> Self {
        Self { tracks: vec![Track::default(); model.spec.probes.len()] }
    }

    /// Takes one reading of each; `dt_s` is the time since the reading before.
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
#[must_use]
pub fn unit(target: ProbeTarget) -> &'static str {
    match target {
        ProbeTarget::EndTension(..)
        | ProbeTarget::TensionAt(..)
        | ProbeTarget::Whale(WhaleFigure::Thrust | WhaleFigure::BodyDrag) => "N",
        ProbeTarget::Whale(WhaleFigure::Speed) => "m/s",
        ProbeTarget::Whale(WhaleFigure::Power) => "W",
        ProbeTarget::Energy(_) => "J",
        ProbeTarget::LineAt(..)
        | ProbeTarget::Height(..)
        | ProbeTarget::LineMiddle(..)
        | ProbeTarget::Joint(..)
        | ProbeTarget::Body { .. } => "m",
    }
}

/// What a probe reads in a state; zero where its target does not exist.
#[must_use]
pub fn reading(model: &Model, state: &State, target: ProbeTarget) -> f64 {
    let coordinate = |place: Option<glam::DVec3>, axis: usize| {
        place.and_then(|place| place.to_array().get(axis).copied()).unwrap_or(0.0)
    };
    match target {
        ProbeTarget::EndTension(line, end) => end_tension(model, state, line, end),
        ProbeTarget::TensionAt(line, length_m) => along::tension(model, state, line, length_m),
        ProbeTarget::LineAt(line, length_m, axis) => {
            coordinate(along::place(model, state, line, length_m), axis)
        }
        ProbeTarget::Height(line, away_m) => along::height(model, state, line, away_m),
        ProbeTarget::Energy(form) => energy(model, state, form),
        ProbeTarget::LineMiddle(line, axis) => coordinate(along::middle(model, state, line), axis),
        ProbeTarget::Joint(joint, axis) => coordinate(state.joint_place(model, joint), axis),
        ProbeTarget::Body { body, offset_m, axis } => coordinate(
            state.bodies.get(body).map(|body| body.position + body.orientation * offset_m),
            axis,
        ),
        ProbeTarget::Whale(figure) => of_whale(state, figure),
    }
}

fn of_whale(state: &State, figure: WhaleFigure) -> f64 {
    let Some(whale) = &state.whale else { return 0.0 };
    match figure {
        WhaleFigure::Speed => whale.speed_m_s,
        WhaleFigure::Thrust => whale.exertion.thrust_n,
        WhaleFigure::Power => whale.exertion.power_w,
        WhaleFigure::BodyDrag => whale.exertion.drag_n,
    }
}
