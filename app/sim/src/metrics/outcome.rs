//! How an encounter ends: contact, its loss, and what parted, judged with hysteresis.

use super::event::{EventKind, Log};
use super::summary::Outcome;
use crate::state::State;

/// Without contact for this long the rope has let go [s]; estimate.
pub const RELEASE_S: f64 = 10.0;

/// Without contact for less than this, contact goes on [s]; estimate.
pub const LOST_S: f64 = 1.0;

/// Contact this long makes an entanglement stand [s]; estimate.
pub const LONG_CONTACT_S: f64 = 10.0;

/// Share of an episode that must be free of contact where it is short; estimate.
const RELEASE_SHARE: f64 = 1.0 / 3.0;

/// Turns that do not count as let go until [`RELEASE_S`] is over, however short the episode; estimate.
const HOOKED_TURNS: f64 = 0.5;

/// What is remembered of contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Encounter {
    pub(super) first_s: Option<f64>,
    pub(super) last_s: Option<f64>,
    pub(super) contact_time_s: f64,
    /// When the present episode of contact began; `None` while free.
    episode_s: Option<f64>,
    /// Most turns about any part when rope last touched.
    turns: f64,
    /// Whether it hooked in the present episode.
    pub(super) hooked: bool,
}

impl Encounter {
    /// Takes in whether rope touches at `time_s` and the most turns about any part.
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
                log.note(time_s, EventKind::Hooked, "whale", turns);
            }
        } else if self.episode_s.is_some() && self.free_s(time_s) >= self.release_s(time_s) {
            (self.episode_s, self.hooked) = (None, false);
            log.note(time_s, EventKind::Shed, "whale", self.last_s.unwrap_or(time_s));
        }
    }

    /// Whether rope holds.
    pub(super) fn holds(&self) -> bool {
        self.episode_s.is_some()
    }

    /// How it stands, and whether that will hold.
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

    /// Time since rope last touched [s].
    fn free_s(&self, time_s: f64) -> f64 {
        self.last_s.map_or(0.0, |last| time_s - last)
    }

    /// How long without contact ends the present episode [s].
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
