//! What happened in a run, in the order in which it was noticed.

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When it was noticed: the end of the step [s].
    pub time_s: f64,
    /// What.
    pub kind: EventKind,
    /// Of what: a body part's name or the id of a line, link or body; `whale` for the animal.
    pub subject: String,
    /// A number that goes with it; its meaning and unit stand at the kind.
    pub value: f64,
}

/// Kinds of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// Rope touched a body part; value: sum of normal forces [N].
    Contact,
    /// No rope touched a body part for a second; value: when it last did [s].
    ContactLost,
    /// Rope that had stuck to a body part for a second began to slip; value: its speed [m/s].
    Slip,
    /// Wraps on a body part passed a level, for the first time or again after it was undone; value: the level [turns].
    Wrap,
    /// Wraps on a body part fell below a level they had passed; value: the level [turns].
    WrapUndone,
    /// Rope hooked: half a turn or more about a part while it touches; value: the turns [turns].
    Hooked,
    /// Rope lodged in the mouth; value: sum of normal forces inside it [N].
    Lodged,
    /// Rope that was lodged in the mouth came out; value: when it last held there [s].
    Dislodged,
    /// Rope let go of the whale; value: when it last touched [s].
    Shed,
    /// A weak link parted; value: its peak tension [N].
    LinkParted,
    /// A line parted; value: its peak tension [N].
    LineParted,
    /// A trap, anchor or weight was moved a metre from its place; value: how far [m].
    Dragged,
    /// A buoy, trap, anchor or weight touched a part of the whale; value: its push [N].
    BodyTouched,
    /// A buoy stayed on the whale for [`CAUGHT_S`](super::CAUGHT_S); value: its greatest push so far [N].
    CaughtBuoy,
    /// A trap, anchor or weight stayed on the whale for as long; value: its greatest push so far [N].
    CaughtTrap,
    /// A knot, splice or link of a line stayed where it pressed on the whale for as long; value: its greatest push so far [N].
    JammedKnot,
    /// A buoy went under; value: its height [m].
    PulledUnder,
    /// The whale touched the seabed; value: its lowest point's height above it [m].
    AtSeabed,
    /// The whale broke the surface; value: height of its highest point [m].
    AtSurface,
}

impl EventKind {
    /// Every kind.
    pub const ALL: [Self; 19] = [
        Self::Contact,
        Self::ContactLost,
        Self::Slip,
        Self::Wrap,
        Self::WrapUndone,
        Self::Hooked,
        Self::Lodged,
        Self::Dislodged,
        Self::Shed,
        Self::LinkParted,
        Self::LineParted,
        Self::Dragged,
        Self::BodyTouched,
        Self::CaughtBuoy,
        Self::CaughtTrap,
        Self::JammedKnot,
        Self::PulledUnder,
        Self::AtSeabed,
        Self::AtSurface,
    ];

    /// Its name in results, such as `link_parted`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::ContactLost => "contact_lost",
            Self::Slip => "slip",
            Self::Wrap => "wrap",
            Self::WrapUndone => "wrap_undone",
            Self::Hooked => "hooked",
            Self::Lodged => "lodged",
            Self::Dislodged => "dislodged",
            Self::Shed => "shed",
            Self::LinkParted => "link_parted",
            Self::LineParted => "line_parted",
            Self::Dragged => "dragged",
            Self::BodyTouched => "body_touched",
            Self::CaughtBuoy => "caught_buoy",
            Self::CaughtTrap => "caught_trap",
            Self::JammedKnot => "jammed_knot",
            Self::PulledUnder => "pulled_under",
            Self::AtSeabed => "at_seabed",
            Self::AtSurface => "at_surface",
        }
    }

    /// Unit of its value: `N`, `s`, `m`, `m/s` or `turns`.
    #[must_use]
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

/// The list of events of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Log {
    pub(super) events: Vec<Event>,
}

impl Log {
    pub(super) fn note(&mut self, time_s: f64, kind: EventKind, subject: &str, value: f64) {
        self.events.push(Event { time_s, kind, subject: subject.to_owned(), value });
    }
}
