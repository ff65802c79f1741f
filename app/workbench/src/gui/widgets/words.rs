//! Words and colours on screen for status, events and outcome of a run, and titles for keys of files.

use std::time::Duration;

use egui::Color32;
use endline_gear::Confidence;
use endline_session::live::Status;
use endline_sim::metrics::{EventKind, Outcome, WhaleSummary};

use super::super::theme::Palette;

/// A status in words, and whether it is an error.
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
pub fn event(kind: EventKind) -> String {
    capital(&spoken(kind.name()))
}

/// Words before the value of an event.
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

/// An outcome in words, its meaning (docs/entanglement.md) and its colour.
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

/// Words and meaning of an entanglement that may still end: that of a run which is too short, or continues.
pub const UNDECIDED: (&str, &str) =
    ("Not decided", "rope touches, or did within 10 s; not decided yet");

/// The outcome of a run up to a time [s], in words, with its meaning and its colour. Until it is decided, an entanglement is the present
/// contact or the time since the last one, in grey.
pub fn outcome_at(
    whale: &WhaleSummary,
    time_s: f64,
    palette: Palette,
) -> (String, &'static str, Color32) {
    let (words, meaning, colour) = outcome(whale.outcome, palette);
    if whale.decided || !whale.is_held() {
        return (words.to_owned(), meaning, colour);
    }
    let touches = whale.regions.iter().any(|part| part.touching);
    let last_s = whale.last_contact_s.filter(|_| !touches);
    (in_contact(last_s.map(|last_s| time_s - last_s)), UNDECIDED.1, palette.faint)
}

/// The present contact, or the time since the last one [s].
fn in_contact(ago_s: Option<f64>) -> String {
    match ago_s {
        None => "In contact".to_owned(),
        Some(ago_s) => format!("In contact {:.0} s ago", ago_s.max(0.0)),
    }
}

/// Colour of a confidence.
pub fn confidence_colour(confidence: Confidence, palette: Palette) -> Color32 {
    match confidence {
        Confidence::Measured => palette.good,
        Confidence::Catalogue | Confidence::Derived => palette.accent,
        Confidence::Estimate | Confidence::Assumed => palette.warning,
    }
}

/// Makes the first letter a capital.
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// An identifier in words: underscores become spaces.
pub fn spoken(name: &str) -> String {
    name.replace('_', " ")
}

/// Rounds a number of a plugin to six digits.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A remaining time in suitable units.
pub fn time_left(left: Duration) -> String {
    let minutes = left.as_secs().div_ceil(60);
    match left.as_secs() {
        seconds @ 0..=59 => format!("{seconds} s"),
        60..=3599 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

/// Titles of keys that are unclear without the name of their table.
const TITLES: [(&str, &str); 6] = [
    ("mass.length", "Mass, of length"),
    ("mass.mass", "Mass"),
    ("mass.exponent", "Mass, exponent"),
    ("age.birth", "Length at birth"),
    ("age.one_year", "Length at 1 year"),
    ("age.tenfold", "Growth, tenfold age"),
];

/// A key as a title: `stretch_at_break` is `Stretch at break`.
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
    fn a_contact_that_has_ended_is_said_with_its_age() {
        assert_eq!(in_contact(None), "In contact");
        assert_eq!(in_contact(Some(6.2)), "In contact 6 s ago");
    }

    #[test]
    fn keys_become_titles_in_words() {
        assert_eq!(title("stretch_at_break"), "Stretch at break");
        assert_eq!(title("head.mouth"), "Head mouth");
    }
}
