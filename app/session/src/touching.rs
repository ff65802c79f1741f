//! The contact of a body with the whale at the moment shown, from its frame and the events up to it.
//!
//! The summary of a run stands for its newest moment. An earlier moment that is shown has its frame, and of the events those before it.

use endline_sdk::BodyPart;
use endline_sim::metrics::{Event, EventKind};
use endline_sim::{DVec3, Frame};

/// A body on the whale's skin at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyOnSkin {
    /// Parts of the whale that it presses on, with the sum of its pushes on each, the hardest first [N].
    pub parts: Vec<(BodyPart, f64)>,
    /// Sum of its pushes [N].
    pub push_n: f64,
    /// Friction of skin on it, all places together [N].
    pub friction_n: f64,
    /// Since when it has touched, short gaps left out [s].
    pub since_s: Option<f64>,
    /// When it was classified as caught, if it was [s].
    pub caught_s: Option<f64>,
}

impl BodyOnSkin {
    /// Of the body of an index and id; empty where it does not touch.
    pub fn at(frame: &Frame, events: &[Event], body: usize, id: &str) -> Self {
        let mut found = Self::default();
        let mut friction = DVec3::ZERO;
        let mine = frame.body_contacts.iter().filter(|contact| contact.body == body);
        for contact in mine.filter(|contact| contact.normal_force_n > 0.0) {
            let (part, push_n) = (contact.region.part(), contact.normal_force_n);
            match found.parts.iter_mut().find(|(known, _)| *known == part) {
                Some((_, sum_n)) => *sum_n += push_n,
                None => found.parts.push((part, push_n)),
            }
            found.push_n += push_n;
            friction += contact.friction_n;
        }
        found.friction_n = friction.length();
        found.parts.sort_by(|one, other| other.1.total_cmp(&one.1));
        if !found.parts.is_empty() {
            (found.since_s, found.caught_s) = spell(events, id, frame.time_s);
        }
        found
    }

    /// The part that it presses on most.
    pub fn part(&self) -> Option<BodyPart> {
        self.parts.first().map(|(part, _)| *part)
    }
}

/// Start of the contact in progress at a time, and when the body was classified as caught in it [s].
fn spell(events: &[Event], id: &str, time_s: f64) -> (Option<f64>, Option<f64>) {
    let mut found = (None, None);
    // An event bears the time of the end of its step, which may differ from the frame's by rounding.
    let before = |event: &&Event| event.subject == id && event.time_s <= time_s + 1e-9;
    for event in events.iter().filter(before) {
        match event.kind {
            EventKind::BodyTouched => found = (Some(event.time_s), None),
            EventKind::CaughtBuoy | EventKind::CaughtTrap => found.1 = Some(event.time_s),
            _ => {}
        }
    }
    found
}

/// Pushes of bodies on a part of the whale: index of each body and the sum of its pushes there, the hardest first [N].
pub fn bodies_on(frame: &Frame, part: BodyPart) -> Vec<(usize, f64)> {
    let mut found: Vec<(usize, f64)> = Vec::new();
    let here = frame.body_contacts.iter().filter(|contact| contact.region.part() == part);
    for contact in here.filter(|contact| contact.normal_force_n > 0.0) {
        match found.iter_mut().find(|(body, _)| *body == contact.body) {
            Some((_, sum_n)) => *sum_n += contact.normal_force_n,
            None => found.push((contact.body, contact.normal_force_n)),
        }
    }
    found.sort_by(|one, other| other.1.total_cmp(&one.1));
    found
}

#[cfg(test)]
mod tests {
    use endline_sdk::Region;
    use endline_sim::contact::body_on_skin::BodyContact;

    use super::*;

    fn contact(body: usize, region: Region, push_n: f64, friction_n: DVec3) -> BodyContact {
        BodyContact {
            body,
            triangle: 0,
            region,
            position: DVec3::ZERO,
            normal: DVec3::Z,
            depth_m: 0.01,
            normal_force_n: push_n,
            friction_n,
            slip_m: DVec3::ZERO,
        }
    }

    fn event(time_s: f64, kind: EventKind, subject: &str) -> Event {
        Event { time_s, kind, subject: subject.to_owned(), value: 1.0 }
    }

    #[test]
    fn an_earlier_moment_is_described_by_its_frame_and_the_events_before_it() {
        let frame = |time_s: f64| Frame {
            time_s,
            body_contacts: vec![
                contact(1, Region::Head, 30.0, DVec3::X * 3.0),
                contact(1, Region::LeftFluke, 50.0, DVec3::Y * 4.0),
                contact(1, Region::LeftFluke, 20.0, DVec3::ZERO),
                contact(0, Region::Head, 700.0, DVec3::ZERO),
            ],
            ..Frame::default()
        };
        let events = [
            event(2.0, EventKind::BodyTouched, "buoy"),
            event(7.0, EventKind::CaughtBuoy, "buoy"),
            event(8.0, EventKind::BodyTouched, "trap"),
            event(12.0, EventKind::BodyTouched, "buoy"),
        ];
        let at = |time_s: f64| BodyOnSkin::at(&frame(time_s), &events, 1, "buoy");
        let early = at(3.0);
        assert_eq!(early.parts, [(BodyPart::LeftFluke, 70.0), (BodyPart::Head, 30.0)]);
        assert!((early.push_n - 100.0).abs() < 1e-12 && (early.friction_n - 5.0).abs() < 1e-12);
        assert_eq!((early.since_s, early.caught_s), (Some(2.0), None));
        assert_eq!((at(9.0).since_s, at(9.0).caught_s), (Some(2.0), Some(7.0)));
        assert_eq!((at(13.0).since_s, at(13.0).caught_s), (Some(12.0), None), "a new spell");
        assert_eq!(BodyOnSkin::at(&Frame::default(), &events, 1, "buoy"), BodyOnSkin::default());
        assert_eq!(bodies_on(&frame(3.0), BodyPart::Head), [(0, 700.0), (1, 30.0)]);
    }
}
