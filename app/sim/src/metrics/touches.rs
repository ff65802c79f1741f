//! Contact begun and lost, and slip begun, part by part.

use endline_sdk::BodyPart;

use super::event::{EventKind, Log};
use super::outcome::LOST_S;
use super::regions::{Load, Loads};

/// Slower than this, rope sticks [m/s]; estimate.
const STICK_M_S: f64 = 0.01;

/// Faster than this, rope slips [m/s]; estimate.
const SLIP_M_S: f64 = 0.05;

/// Rope must have stuck this long before its slip is reported [s]; estimate.
const STUCK_S: f64 = 1.0;

/// Whether and how rope touches each part.
#[derive(Clone, Debug, Default)]
pub(super) struct Touches {
    parts: [Touch; BodyPart::ALL.len()],
}

#[derive(Clone, Copy, Debug, Default)]
struct Touch {
    /// When rope last touched, while contact lasts [s].
    last_s: Option<f64>,
    /// Since when it has not slipped [s].
    stuck_since_s: Option<f64>,
}

impl Touches {
    /// Tells of what changed with the loads of the step that ends at `time_s`.
    pub(super) fn fold(&mut self, loads: &Loads, time_s: f64, log: &mut Log) {
        for ((part, load), touch) in BodyPart::ALL.iter().zip(&loads.parts).zip(&mut self.parts) {
            touch.contact(part.name(), load, time_s, log);
            touch.slip(part.name(), load, time_s, log);
        }
    }
}

impl Touch {
    /// Contact begun, and lost for [`LOST_S`].
    fn contact(&mut self, part: &str, load: &Load, time_s: f64, log: &mut Log) {
        if load.normal_n > 0.0 {
            if self.last_s.replace(time_s).is_none() {
                log.note(time_s, EventKind::Contact, part, load.normal_n);
            }
        } else if let Some(last) = self.last_s.filter(|last| time_s - last >= LOST_S) {
            self.last_s = None;
            log.note(time_s, EventKind::ContactLost, part, last);
        }
    }

    /// Slip begun after [`STUCK_S`] of sticking.
    fn slip(&mut self, part: &str, load: &Load, time_s: f64, log: &mut Log) {
        if load.normal_n <= 0.0 {
            self.stuck_since_s = None;
        } else if load.slip_m_s < STICK_M_S {
            self.stuck_since_s.get_or_insert(time_s);
        } else if load.slip_m_s > SLIP_M_S
            && let Some(since) = self.stuck_since_s.take()
            && time_s - since >= STUCK_S
        {
            log.note(time_s, EventKind::Slip, part, load.slip_m_s);
        }
    }
}
