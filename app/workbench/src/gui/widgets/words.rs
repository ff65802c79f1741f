//! Words and colours for what a run reports: its status, events and outcome; names of the format as titles.

use std::time::Duration;

use egui::Color32;
use endline_gear::Confidence;
use endline_session::live::Status;
use endline_sim::metrics::{EventKind, Outcome};

use super::super::theme::Palette;

/// A status in words, and whether it is bad.
#[must_use]
pub fn status(status: &Status) -> (String, bool) {
    match status {
        Status::Settling => ("Settling".into(), false),
        Status::Paused => ("Paused".into(), false),
        Status::Running => ("Running".into(), false),
        Status::Finished => ("Finished".into(), false),
        Status::Stopped(why) => (format!("Stopped: {why}"), true),
        Status::Failed(why) => (format!("Could not start: {why}"), true),
    }
}

/// A kind of event in a few words.
#[must_use]
pub fn event(kind: EventKind) -> String {
    capital(&spoken(kind.name()))
}

/// What the number of an event is, in a word or two before it.
#[must_use]
pub fn event_number(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Contact | EventKind::Lodged => "pressed by",
        EventKind::BodyTouched => "pushed by",
        EventKind::CaughtBuoy | EventKind::CaughtTrap | EventKind::JammedKnot => "at most",
        EventKind::ContactLost | EventKind::Dislodged | EventKind::Shed => "last at",
        EventKind::Slip | EventKind::LinkParted | EventKind::LineParted => "at",
        EventKind::Wrap | EventKind::Hooked => "passed",
        EventKind::WrapUndone => "below",
        EventKind::Dragged => "moved",
        EventKind::PulledUnder | EventKind::AtSurface => "height",
        EventKind::AtSeabed => "clearance",
    }
}

/// The colour of a kind of event.
pub fn event_colour(kind: EventKind, palette: Palette) -> Color32 {
    match kind {
        EventKind::LinkParted | EventKind::LineParted => palette.error,
        EventKind::CaughtBuoy | EventKind::CaughtTrap | EventKind::JammedKnot => palette.error,
        EventKind::Wrap | EventKind::Dragged | EventKind::PulledUnder => palette.warning,
        _ => palette.text,
    }
}

/// An outcome in words, what it means (docs/entanglement.md), and its colour.
#[must_use]
pub fn outcome(outcome: Outcome, palette: Palette) -> (&'static str, &'static str, Color32) {
    match outcome {
        Outcome::NoContact => ("No contact", "rope never touched the whale", palette.faint),
        Outcome::Shed => (
            "Shed",
            "rope touched, nothing parted, and the whale is free: no contact for 10 s, less after a short touch",
            palette.good,
        ),
        Outcome::PartedFree => (
            "Parted, whale free",
            "a link or line parted after the first contact, and the whale is free",
            palette.good,
        ),
        Outcome::Entangled => {
            ("Entangled", "rope touches, or did within 10 s, and nothing parted", palette.error)
        }
        Outcome::PartedEntangled => (
            "Parted, still entangled",
            "a link or line parted after the first contact, and rope still holds",
            palette.error,
        ),
    }
}

/// Colour of a confidence.
#[must_use]
pub fn confidence_colour(confidence: Confidence, palette: Palette) -> Color32 {
    match confidence {
        Confidence::Measured => palette.good,
        Confidence::Derived => palette.accent,
        Confidence::Estimate | Confidence::Assumed => palette.warning,
    }
}

/// Words with a capital first letter.
#[must_use]
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A name of a part or outcome in words.
#[must_use]
pub fn spoken(name: &str) -> String {
    name.replace('_', " ")
}

/// A number of a plugin to six digits, as it is shown.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A time in the largest fitting units.
#[must_use]
pub fn time_left(left: Duration) -> String {
    let minutes = left.as_secs().div_ceil(60);
    match left.as_secs() {
        seconds @ 0..=59 => format!("{seconds} s"),
        60..=3599 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

/// Keys that say too little without their table.
const TITLES: [(&str, &str); 6] = [
    ("mass.length", "Mass, of length"),
    ("mass.mass", "Mass"),
    ("mass.exponent", "Mass, exponent"),
    ("age.birth", "Length at birth"),
    ("age.one_year", "Length at 1 year"),
    ("age.tenfold", "Growth, tenfold age"),
];

/// A key as a title: `stretch_at_break` is `Stretch at break`.
#[must_use]
pub fn title(key: &str) -> String {
    if let Some((_, title)) = TITLES.iter().find(|(known, _)| *known == key) {
        return (*title).to_owned();
    }
    capital(&key.replace(['_', '.'], " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_readable() {
        assert_eq!(title("stretch_at_break"), "Stretch at break");
        assert_eq!(title("head.mouth"), "Head mouth");
    }
}
