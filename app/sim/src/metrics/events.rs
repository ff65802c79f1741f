//! Events of a run, outcome of an encounter, and contact and slip of rope by part.
//!
//! The outcome depends on contact, its loss, and partings, with hysteresis.

use endline_sdk::BodyPart;
use strum::IntoStaticStr;

use super::pressure::{Load, Loads};
use super::summary::Outcome;
use crate::state::State;

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time: the end of the step in which it was detected [s].
    pub time_s: f64,
    /// Kind.
    pub kind: EventKind,
    /// Subject: the name of a body part or the id of a line, link or body; `whale` for the animal.
    pub subject: String,
    /// Value; the kind defines its meaning and unit.
    pub value: f64,
}

/// Kinds of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum EventKind {
    /// Rope touched a body part; value: sum of normal forces [N].
    Contact,
    /// No rope touched a body part for a second; value: time of the last contact [s].
    ContactLost,
    /// Rope slipped on a body part after a second of sticking; value: its speed [m/s].
    Slip,
    /// Wraps on a body part exceeded a level, for the first time or again; value: the level [turns].
    Wrap,
    /// Wraps on a body part fell below a level that they had exceeded; value: the level [turns].
    WrapUndone,
    /// Rope hooked: half a turn or more about a part while in contact; value: the turns [turns].
    Hooked,
    /// Rope lodged in the mouth; value: sum of normal forces inside it [N].
    Lodged,
    /// Rope left the mouth; value: time at which it was last held there [s].
    Dislodged,
    /// The whale shed rope; value: time of the last contact [s].
    Shed,
    /// A weak link parted; value: its peak tension [N].
    LinkParted,
    /// A line parted; value: its peak tension [N].
    LineParted,
    /// A trap, anchor or weight moved by more than a metre; value: its displacement [m].
    Dragged,
    /// A buoy, trap, anchor or weight touched the whale; value: its force [N].
    BodyTouched,
    /// A buoy was in contact for [`CAUGHT_S`](super::CAUGHT_S); value: its greatest force so far [N].
    CaughtBuoy,
    /// A trap, anchor or weight was in contact for [`CAUGHT_S`](super::CAUGHT_S); value: its greatest force so far [N].
    CaughtTrap,
    /// A knot, splice or link pressed on one place for [`CAUGHT_S`](super::CAUGHT_S); value: its greatest force so far [N].
    JammedKnot,
    /// A buoy was submerged; value: its height [m].
    PulledUnder,
    /// The whale's trunk touched the seabed; value: height of the trunk's lowest point above it [m].
    AtSeabed,
    /// The whale broke the surface; value: height of its highest point [m].
    AtSurface,
}

impl EventKind {
    /// Name in results, such as `link_parted`.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Unit of its value: `N`, `s`, `m`, `m/s` or `turns`.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Contact | Self::Lodged | Self::LinkParted | Self::LineParted => "N",
            Self::BodyTouched | Self::CaughtBuoy | Self::CaughtTrap | Self::JammedKnot => "N",
            Self::ContactLost | Self::Dislodged | Self::Shed => "s",
            Self::Slip => "m/s",
            Self::Wrap | Self::WrapUndone | Self::Hooked => "turns",
            Self::Dragged | Self::PulledUnder | Self::AtSeabed | Self::AtSurface => "m",
        }
    }
}

/// Events of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Log {
    pub(super) events: Vec<Event>,
}

impl Log {
    pub(super) fn record(&mut self, time_s: f64, kind: EventKind, subject: &str, value: f64) {
        debug_assert!(
            self.events.last().is_none_or(|last| last.time_s <= time_s),
            "events are in the order of time"
        );
        self.events.push(Event { time_s, kind, subject: subject.to_owned(), value });
    }
}

/// Time without contact after which rope is shed; estimate [s].
pub const RELEASE_S: f64 = 10.0;

/// Longest gap within a continuing contact; estimate [s].
pub const LOST_S: f64 = 1.0;

/// Duration of contact after which an entanglement is decided; estimate [s].
pub const LONG_CONTACT_S: f64 = 10.0;

/// Share of a short episode after which rope is shed; estimate.
const RELEASE_SHARE: f64 = 1.0 / 3.0;

/// Turns about a part that hook: [`RELEASE_S`] applies to such episodes of any duration; estimate [turns].
pub const HOOKED_TURNS: f64 = 0.5;

/// Contact of rope with the whale.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Encounter {
    pub(super) first_s: Option<f64>,
    pub(super) last_s: Option<f64>,
    pub(super) contact_time_s: f64,
    /// Start of the current episode of contact; `None` while free [s].
    episode_s: Option<f64>,
    /// Greatest turns about any part at the last contact.
    turns: f64,
    /// Whether rope hooked in the current episode.
    pub(super) hooked: bool,
}

impl Encounter {
    /// Adds a step: whether rope touches at `time_s`, and the greatest turns about any part.
    pub(super) fn fold(
        &mut self,
        time_s: f64,
        dt_s: f64,
        touching: bool,
        turns: f64,
        log: &mut Log,
    ) {
        if touching {
            self.first_s.get_or_insert(time_s);
            self.episode_s.get_or_insert(time_s);
            (self.last_s, self.turns) = (Some(time_s), turns);
            self.contact_time_s += dt_s;
            if turns >= HOOKED_TURNS && !std::mem::replace(&mut self.hooked, true) {
                log.record(time_s, EventKind::Hooked, "whale", turns);
            }
        } else if self.episode_s.is_some() && self.free_s(time_s) >= self.release_s(time_s) {
            (self.episode_s, self.hooked) = (None, false);
            log.record(time_s, EventKind::Shed, "whale", self.last_s.unwrap_or(time_s));
        }
    }

    /// Whether rope holds the whale.
    pub(super) fn holds(&self) -> bool {
        self.episode_s.is_some()
    }

    /// Outcome so far, and whether it is decided.
    pub(super) fn outcome(&self, state: &State) -> (Outcome, bool) {
        let Some(first) = self.first_s else { return (Outcome::NoContact, true) };
        let parted = parted_since(state, first);
        match (self.episode_s, parted) {
            (Some(start), false) => (Outcome::Entangled, self.lasting(start, state.time_s)),
            (Some(start), true) => (Outcome::PartedEntangled, self.lasting(start, state.time_s)),
            (None, false) => (Outcome::Shed, self.free_s(state.time_s) >= RELEASE_S),
            (None, true) => (Outcome::PartedFree, self.free_s(state.time_s) >= RELEASE_S),
        }
    }

    fn lasting(&self, start_s: f64, time_s: f64) -> bool {
        time_s - start_s >= LONG_CONTACT_S && self.free_s(time_s) <= LOST_S
    }

    /// Time since the last contact [s].
    fn free_s(&self, time_s: f64) -> f64 {
        self.last_s.map_or(0.0, |last| time_s - last)
    }

    /// Time without contact that ends the current episode [s].
    fn release_s(&self, time_s: f64) -> f64 {
        let episode = self.episode_s.map_or(0.0, |start| time_s - start);
        if self.turns >= HOOKED_TURNS {
            RELEASE_S
        } else {
            (RELEASE_SHARE * episode).clamp(LOST_S, RELEASE_S)
        }
    }
}

/// Whether any link or line parted at or after a time.
fn parted_since(state: &State, since_s: f64) -> bool {
    let links = state.link_parted_s.iter().flatten().copied();
    let lines = state.line_parted.iter().flatten().map(|(time, _)| *time);
    links.chain(lines).any(|time| time >= since_s)
}

/// Speed below which rope sticks; estimate [m/s].
const STICK_M_S: f64 = 0.01;

/// Speed above which rope slips; estimate [m/s].
const SLIP_M_S: f64 = 0.05;

/// Duration of sticking before slip is reported; estimate [s].
const STUCK_S: f64 = 1.0;

/// Contact and slip of rope on each part.
#[derive(Clone, Debug, Default)]
pub(super) struct Touches {
    parts: [Touch; BodyPart::ALL.len()],
}

#[derive(Clone, Copy, Debug, Default)]
struct Touch {
    /// Time of the last contact, during continuing contact [s].
    last_s: Option<f64>,
    /// Start of sticking [s].
    stuck_since_s: Option<f64>,
}

impl Touches {
    /// Reports changes with the loads of the step that ends at `time_s`.
    pub(super) fn fold(&mut self, loads: &Loads, time_s: f64, log: &mut Log) {
        for ((part, load), touch) in BodyPart::ALL.iter().zip(&loads.parts).zip(&mut self.parts) {
            touch.contact(part.name(), load, time_s, log);
            touch.slip(part.name(), load, time_s, log);
        }
    }

    /// Whether rope touches a part, or did less than [`LOST_S`] ago.
    pub(super) fn is_touching(&self, part: BodyPart) -> bool {
        self.parts[part as usize].last_s.is_some()
    }
}

impl Touch {
    /// Reports the start of contact, and its loss for [`LOST_S`].
    fn contact(&mut self, part: &str, load: &Load, time_s: f64, log: &mut Log) {
        if load.normal_n > 0.0 {
            if self.last_s.replace(time_s).is_none() {
                log.record(time_s, EventKind::Contact, part, load.normal_n);
            }
        } else if let Some(last) = self.last_s.filter(|last| time_s - last >= LOST_S) {
            self.last_s = None;
            log.record(time_s, EventKind::ContactLost, part, last);
        }
    }

    /// Reports slip after [`STUCK_S`] of sticking.
    fn slip(&mut self, part: &str, load: &Load, time_s: f64, log: &mut Log) {
        if load.normal_n <= 0.0 {
            self.stuck_since_s = None;
        } else if load.slip_m_s < STICK_M_S {
            self.stuck_since_s.get_or_insert(time_s);
        } else if load.slip_m_s > SLIP_M_S
            && let Some(since) = self.stuck_since_s.take()
            && time_s - since >= STUCK_S
        {
            log.record(time_s, EventKind::Slip, part, load.slip_m_s);
        }
    }
}
