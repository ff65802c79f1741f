//! Places and speeds of bodies; traps dragged, buoys pulled under.

use glam::DVec3;

use super::body_on_whale::Touching;
use super::event::{EventKind, Log};
use super::gear_loads::body_drag;
use super::summary::BodySummary;
use crate::contact::body_on_skin::sums::{BodySum, BodySums};
use crate::model::{Body, BodyRole, Model};
use crate::state::{BodyState, State};

/// How far a trap, anchor or weight moves along the seabed before it counts as dragged [m]; estimate.
pub const DRAGGED_M: f64 = 1.0;

/// Wet share of a buoy's top float below which it counts as back at the surface; estimate.
const SURFACED_SHARE: f64 = 0.9;

/// What is followed of every body.
#[derive(Clone, Debug)]
pub(super) struct BodyMeter {
    tracks: Vec<Track>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Track {
    start: Option<DVec3>,
    peak_speed_m_s: f64,
    dragged: bool,
    /// Whether a buoy has been at the surface since it last went under.
    afloat: bool,
    touching: Touching,
}

impl BodyMeter {
    pub(super) fn new(model: &Model) -> Self {
        Self { tracks: vec![Track::default(); model.spec.bodies.len()] }
    }

    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        (on_whale, dt_s): (&BodySums, f64),
        log: &mut Log,
    ) {
        let sums = on_whale.bodies.iter().copied().chain(std::iter::repeat(BodySum::default()));
        for ((track, body), sum) in self.tracks.iter_mut().zip(&model.spec.bodies).zip(sums) {
            track.touching.fold(body, &sum, (state.time_s, dt_s), log);
        }
        for ((track, body), now) in
            self.tracks.iter_mut().zip(&model.spec.bodies).zip(&state.bodies)
        {
            track.peak_speed_m_s = track.peak_speed_m_s.max(now.velocity.length());
            match body.role {
                BodyRole::Buoy => track.float(body, now, state.time_s, log),
                BodyRole::Trap | BodyRole::Anchor | BodyRole::Weight => {
                    track.drag(body, now, state.time_s, log)
                }
            }
        }
    }

    pub(super) fn summary(&self, model: &Model, state: &State) -> Vec<BodySummary> {
        let summary = |((track, body), now): ((&Track, &Body), &BodyState)| BodySummary {
            id: body.id.clone(),
            position_m: now.position,
            peak_speed_m_s: track.peak_speed_m_s,
            drag_n: DVec3::ZERO,
            on_whale: track.touching.summary(state.time_s),
        };
        let mut bodies: Vec<BodySummary> =
            self.tracks.iter().zip(&model.spec.bodies).zip(&state.bodies).map(summary).collect();
        for (index, body) in bodies.iter_mut().enumerate() {
            body.drag_n = body_drag(model, state, index);
        }
        bodies
    }
}

impl Track {
    fn drag(&mut self, body: &Body, now: &BodyState, time_s: f64, log: &mut Log) {
        let start = *self.start.get_or_insert(now.position);
        let moved = (now.position - start).truncate().length();
        if moved > DRAGGED_M && !self.dragged {
            self.dragged = true;
            log.note(time_s, EventKind::Dragged, &body.id, moved);
        }
    }

    fn float(&mut self, body: &Body, now: &BodyState, time_s: f64, log: &mut Log) {
        let driest = body.floats.iter().fold(1.0_f64, |least, float| {
            let height = now.position.z + (now.orientation * float.offset_m).z;
            least.min(float.form.wet(height, now.orientation * DVec3::Z).share)
        });
        if driest < SURFACED_SHARE {
            self.afloat = true;
        } else if driest >= 1.0 && self.afloat {
            self.afloat = false;
            log.note(time_s, EventKind::PulledUnder, &body.id, now.position.z);
        }
    }
}
