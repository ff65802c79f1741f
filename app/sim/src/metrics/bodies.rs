//! Positions and speeds of bodies, dragged traps, submerged buoys, and contact of bodies with the whale.

use endline_sdk::BodyPart;
use glam::DVec3;

use super::events::{EventKind, LOST_S, Log};
use super::loads::body_drag;
use super::summary::{BodyOnWhale, BodySummary};
use crate::contact::body_on_skin::sums::{BodySum, BodySums};
use crate::model::{Body, BodyRole, Model};
use crate::state::{BodyState, State};

/// Displacement along the seabed above which a trap, anchor or weight counts as dragged; estimate [m].
pub const DRAGGED_M: f64 = 1.0;

/// Submerged share of a buoy's top float below which it counts as at the surface; estimate.
const SURFACED_SHARE: f64 = 0.9;

/// Metrics of all bodies.
#[derive(Clone, Debug)]
pub(super) struct BodyMeter {
    tracks: Vec<Track>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Track {
    start: Option<DVec3>,
    peak_speed_m_s: f64,
    dragged: bool,
    /// Whether a buoy has been at the surface since it was last submerged.
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
            log.record(time_s, EventKind::Dragged, &body.id, moved);
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
            log.record(time_s, EventKind::PulledUnder, &body.id, now.position.z);
        }
    }
}

/// Duration of contact, with gaps of less than a second, after which a body is caught on the whale; estimate [s].
pub const CAUGHT_S: f64 = 5.0;

/// Contact of a body with the whale.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Touching {
    /// Start of the current contact [s].
    since_s: Option<f64>,
    /// Time of the last contact [s].
    last_s: f64,
    /// Part with the greatest force at the last contact.
    part: Option<BodyPart>,
    contact_time_s: f64,
    caught: bool,
    was_caught: bool,
    peak_n: f64,
    peak_part: Option<BodyPart>,
    friction_work_j: f64,
}

impl Touching {
    /// Adds the contact in a step of length `dt_s` that ends at `time_s`.
    pub fn fold(&mut self, body: &Body, sum: &BodySum, (time_s, dt_s): (f64, f64), log: &mut Log) {
        if self.since_s.is_some() && time_s - self.last_s > LOST_S {
            (self.since_s, self.caught) = (None, false);
        }
        let Some(part) = sum.part() else { return };
        if self.since_s.is_none() {
            self.since_s = Some(time_s);
            log.record(time_s, EventKind::BodyTouched, &body.id, sum.peak_n);
        }
        (self.last_s, self.part) = (time_s, Some(part));
        self.contact_time_s += dt_s;
        self.friction_work_j += sum.friction_work_j;
        if sum.peak_n > self.peak_n {
            (self.peak_n, self.peak_part) = (sum.peak_n, Some(part));
        }
        let stays = self.since_s.is_some_and(|since_s| time_s - since_s >= CAUGHT_S);
        if stays && !std::mem::replace(&mut self.caught, true) {
            self.was_caught = true;
            let kind = match body.role {
                BodyRole::Buoy => EventKind::CaughtBuoy,
                BodyRole::Trap | BodyRole::Anchor | BodyRole::Weight => EventKind::CaughtTrap,
            };
            log.record(time_s, kind, &body.id, self.peak_n);
        }
    }

    pub fn summary(&self, time_s: f64) -> BodyOnWhale {
        let since_s = self.since_s.filter(|_| time_s - self.last_s <= LOST_S);
        BodyOnWhale {
            whale_part: self.part.filter(|_| since_s.is_some()),
            whale_since_s: since_s,
            whale_contact_time_s: self.contact_time_s,
            caught: self.caught && since_s.is_some(),
            was_caught: self.was_caught,
            peak_whale_push_n: self.peak_n,
            peak_whale_part: self.peak_part,
            whale_friction_work_j: self.friction_work_j,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::body;
    use glam::DVec3;

    fn pressed(part: BodyPart, push_n: f64) -> BodySum {
        let mut sum = BodySum { peak_n: push_n, ..BodySum::default() };
        sum.push_n_s[part as usize] = push_n * 0.01;
        sum
    }

    #[test]
    fn a_buoy_in_continuing_contact_is_caught_and_one_in_short_contact_is_not() {
        let buoy = body("ball", BodyRole::Buoy, DVec3::ZERO);
        let (mut touching, mut log) = (Touching::default(), Log::default());
        let mut follow = |from_s: f64, to_s: f64, sum: &BodySum| {
            let mut step = (from_s * 100.0).round() as u32;
            while f64::from(step) * 0.01 < to_s - 1e-9 {
                step += 1;
                touching.fold(&buoy, sum, (f64::from(step) * 0.01, 0.01), &mut log);
            }
            touching.summary(to_s)
        };
        let bumped = follow(0.0, 2.0, &pressed(BodyPart::Head, 40.0));
        assert_eq!((bumped.whale_part, bumped.caught), (Some(BodyPart::Head), false));
        let left = follow(2.0, 4.0, &BodySum::default());
        assert_eq!((left.whale_part, left.whale_since_s), (None, None));
        let held = follow(4.0, 10.0, &pressed(BodyPart::Peduncle, 300.0));
        assert!(held.caught && held.peak_whale_part == Some(BodyPart::Peduncle));
        assert!((held.whale_since_s.unwrap() - 4.01).abs() < 1e-9);
        assert!((held.whale_contact_time_s - 8.0).abs() < 1e-9);
        let kinds: Vec<_> = log.events.iter().map(|event| event.kind).collect();
        let touched = EventKind::BodyTouched;
        assert_eq!(kinds, [touched, touched, EventKind::CaughtBuoy]);
    }
}
