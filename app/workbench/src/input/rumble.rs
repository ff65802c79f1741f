//! What a pilot feels: seabed, surface, contact, slip, parting, as pulses of the pad.
//!
//! Pads over radio fall behind when told too often, so pulses come at most thirty times a second and end by themselves.

use endline_sim::metrics::{Event, EventKind};

/// Least time between two pulses [s].
const APART_S: f64 = 1.0 / 30.0;

/// A pulse of the pad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Strength, 0 to 1.
    pub strength: f64,
    /// How long [s].
    pub long_s: f64,
}

/// The pulse of an event; `None` where there is nothing to feel.
#[must_use]
pub fn pulse(kind: EventKind) -> Option<Pulse> {
    let (strength, long_s) = match kind {
        EventKind::LinkParted | EventKind::LineParted => (1.0, 0.35),
        EventKind::AtSeabed => (0.7, 0.25),
        EventKind::Contact => (0.6, 0.2),
        EventKind::AtSurface => (0.5, 0.3),
        EventKind::Slip => (0.25, 0.1),
        _ => return None,
    };
    Some(Pulse { strength, long_s })
}

/// Turns the events of a run into pulses.
#[derive(Clone, Debug, Default)]
pub struct Rumble {
    seen: usize,
    last_s: Option<f64>,
    /// The pulse felt last, and when it began [s].
    felt: Option<(Pulse, f64)>,
}

impl Rumble {
    /// The strongest pulse of events since the last call, where it is time for one.
    pub fn feel(&mut self, events: &[Event], now_s: f64) -> Option<Pulse> {
        // A run begun anew has fewer events than were seen.
        let fresh = events.get(self.seen..).unwrap_or_default();
        if events.len() < self.seen {
            self.seen = events.len();
            return None;
        }
        let strongest = fresh
            .iter()
            .filter_map(|event| pulse(event.kind))
            .max_by(|a, b| a.strength.total_cmp(&b.strength));
        if strongest.is_some() && self.last_s.is_some_and(|last_s| now_s - last_s < APART_S) {
            return None;
        }
        self.seen = events.len();
        if let Some(pulse) = strongest {
            self.last_s = Some(now_s);
            self.felt = Some((pulse, now_s));
        }
        strongest
    }

    /// Events up to now are not felt any more.
    pub fn skip(&mut self, events: &[Event]) {
        self.seen = events.len();
    }

    /// How strong the pulse is at a time, fading to its end, for the screen to mirror.
    #[must_use]
    pub fn strength(&self, now_s: f64) -> f64 {
        let Some((pulse, begun_s)) = self.felt else { return 0.0 };
        let left = 1.0 - (now_s - begun_s) / (2.0 * pulse.long_s);
        pulse.strength * left.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(kind: EventKind) -> Event {
        Event { time_s: 0.0, kind, subject: String::new(), value: 0.0 }
    }

    #[test]
    fn the_strongest_of_new_events_is_felt_once_and_not_too_often() {
        let mut rumble = Rumble::default();
        let events = [event(EventKind::Slip), event(EventKind::LinkParted), event(EventKind::Wrap)];
        assert_eq!(rumble.feel(&events, 1.0), pulse(EventKind::LinkParted));
        assert_eq!(rumble.feel(&events, 2.0), None);
        let more = [events.as_slice(), &[event(EventKind::Contact)]].concat();
        assert_eq!(rumble.feel(&more, 1.01), None, "too soon after the last");
        assert_eq!(
            rumble.feel(&more, 1.1),
            pulse(EventKind::Contact),
            "it is felt when it is time"
        );
        assert_eq!(rumble.feel(&[], 3.0), None, "a run begun anew");
        assert_eq!(rumble.feel(&[event(EventKind::Slip)], 4.0), pulse(EventKind::Slip));
        assert!(rumble.strength(4.05) > 0.0 && rumble.strength(5.0) <= 0.0);
    }
}
