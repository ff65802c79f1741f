//! What a trap, buoy or anchor does to the whale: when it touches, where it stays, how hard it presses.

use endline_sdk::BodyPart;

use super::event::{EventKind, Log};
use super::outcome::LOST_S;
use super::summary::BodyOnWhale;
use crate::contact::body_on_skin::sums::BodySum;
use crate::model::{Body, BodyRole};

/// A body that has been on the whale for so long, but for gaps of less than a second, is caught there [s]; estimate.
pub const CAUGHT_S: f64 = 5.0;

/// What is followed of a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Touching {
    /// When the present spell began, and when it last touched [s].
    since_s: Option<f64>,
    last_s: f64,
    /// The part that it pressed on most when it last touched.
    part: Option<BodyPart>,
    contact_time_s: f64,
    caught: bool,
    was_caught: bool,
    peak_n: f64,
    peak_part: Option<BodyPart>,
    friction_work_j: f64,
}

impl Touching {
    /// Takes in what the body did in a step of length `dt_s` that ends at `time_s`.
    pub fn fold(&mut self, body: &Body, sum: &BodySum, (time_s, dt_s): (f64, f64), log: &mut Log) {
        if self.since_s.is_some() && time_s - self.last_s > LOST_S {
            (self.since_s, self.caught) = (None, false);
        }
        let Some(part) = sum.part() else { return };
        if self.since_s.is_none() {
            self.since_s = Some(time_s);
            log.note(time_s, EventKind::BodyTouched, &body.id, sum.peak_n);
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
            log.note(time_s, kind, &body.id, self.peak_n);
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
    use glam::DVec3;

    use super::*;
    use crate::metrics::tests::body;

    fn pressed(part: BodyPart, push_n: f64) -> BodySum {
        let mut sum = BodySum { peak_n: push_n, ..BodySum::default() };
        sum.push_n_s[part as usize] = push_n * 0.01;
        sum
    }

    #[test]
    fn a_buoy_that_stays_is_caught_and_one_that_goes_is_not() {
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
