//! Events that a study counts: an outcome, the state of a held whale at the end, or rope on a part of the whale.

use endline_sdk::{BodyPart, Limb};
use endline_sim::metrics::ANCHORED_M_S;
use strum::IntoStaticStr;

use crate::diagnostic::{At, hint};
use crate::fields::Fields;

use super::option::texts;

pub use endline_sim::metrics::HOOKED_TURNS;

/// An event of an encounter.
#[derive(Clone, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum StudyEvent {
    /// Rope touched the whale.
    Contact,
    /// Rope touched and released, nothing parted.
    Shed,
    /// Rope held at the end, parted or not.
    Entangled,
    /// A link or line parted after the first contact.
    Parted,
    /// Something parted and the whale was free.
    PartedFree,
    /// Something parted and rope still held.
    PartedEntangled,
    /// Rope lodged in the mouth at some time.
    Lodged,
    /// A trap, buoy or anchor was caught on the whale at some time.
    Caught,
    /// Rope held at the end, lodged in the mouth or with a whole turn about some part.
    HeldFast,
    /// Rope held at the end, lodged in the mouth.
    HeldLodged,
    /// Rope held at the end with a whole turn about some part.
    HeldTurn,
    /// Rope held at the end, and the whale was anchored by fixed gear.
    Anchored,
    /// Rope held at the end, and the whale towed gear.
    Towing,
    /// Rope held at the end, at the mouth or head.
    OnHead,
    /// Rope held at the end, at a flipper.
    OnFlipper,
    /// Rope held at the end, at the peduncle or flukes.
    OnTail,
    /// Rope held at the end, at two or three of mouth or head, flippers and tail.
    OnTwoPlaces,
    /// Rope held at the end, with half a turn about some part.
    WrapsPresent,
    /// Rope held at the end, and constricted a part.
    Constricting,
    /// Rope held at the end, and led to a trap.
    TrapsAttached,
    /// Rope held at the end, and led to a buoy.
    BuoysAttached,
    /// Rope held at the end, and the whale trailed gear.
    Trailing,
    /// Rope held at the end, and the whale trailed more than 10 m of rope.
    #[strum(serialize = "trailing_10m")]
    Trailing10M,
    /// Rope on any of these parts.
    On(RegionEvent, Vec<BodyPart>),
}

/// Rope on a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionEvent {
    /// It touched.
    Contact,
    /// It went round at least [`HOOKED_TURNS`] at some time.
    Wrap,
    /// Its pressure exceeded the strength of blubber at some time.
    Injury,
}

/// The condition of an event in the table of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Counted<'a> {
    /// The outcome is one of these.
    Outcome(&'a [&'a str]),
    /// A column has a number.
    Present(&'a str),
    /// A column is true.
    Flag(&'a str),
    /// A column of any of these parts is at least this.
    AtLeast(&'a str, &'a [BodyPart], f64),
    /// A column is above this.
    Above(&'a str, f64),
    /// All of these.
    All(&'a [Counted<'a>]),
    /// Any of these.
    Any(&'a [Counted<'a>]),
}

/// Outcomes in which rope holds at the end.
const HELD: Counted<'static> = Counted::Outcome(&["entangled", "parted_entangled"]);
/// Rope lodged in the mouth at the end.
const LODGED: Counted<'static> = Counted::Flag("lodged_in_mouth");
/// A whole turn about some part at the end.
const TURN: Counted<'static> = Counted::AtLeast("wraps", &BodyPart::ALL, 1.0);
/// Strength of blubber: 0.25 to 0.44 MPa (Raymond 2007, in whalestrike), here the upper value [Pa].
pub const INJURY_PA: f64 = 4.4e5;

/// Declaration of an event of the whole whale.
struct Declared {
    event: StudyEvent,
    /// Name as shown to the user.
    words: &'static str,
    counted: Counted<'static>,
}

/// Events of the whole whale, in the order of a report.
static WHOLE: [Declared; 13] = [
    Declared {
        event: StudyEvent::Contact,
        words: "rope touches",
        counted: Counted::Present("first_contact_s"),
    },
    Declared { event: StudyEvent::Shed, words: "shed", counted: Counted::Outcome(&["shed"]) },
    Declared { event: StudyEvent::Entangled, words: "entangled at the end", counted: HELD },
    Declared {
        event: StudyEvent::Parted,
        words: "something parted",
        counted: Counted::Outcome(&["parted", "parted_free", "parted_entangled"]),
    },
    Declared {
        event: StudyEvent::PartedFree,
        words: "parted and free",
        counted: Counted::Outcome(&["parted_free"]),
    },
    Declared {
        event: StudyEvent::PartedEntangled,
        words: "parted, still entangled",
        counted: Counted::Outcome(&["parted_entangled"]),
    },
    Declared {
        event: StudyEvent::Lodged,
        words: "lodged in the mouth",
        counted: Counted::Flag("was_lodged_in_mouth"),
    },
    Declared {
        event: StudyEvent::Caught,
        words: "buoy or trap caught on the whale",
        counted: Counted::Flag("was_body_caught"),
    },
    Declared {
        event: StudyEvent::HeldFast,
        words: "held: lodged or a whole turn",
        counted: Counted::All(&[HELD, Counted::Any(&[LODGED, TURN])]),
    },
    Declared {
        event: StudyEvent::HeldLodged,
        words: "held, lodged in the mouth",
        counted: Counted::All(&[HELD, LODGED]),
    },
    Declared {
        event: StudyEvent::HeldTurn,
        words: "held with a whole turn",
        counted: Counted::All(&[HELD, TURN]),
    },
    Declared {
        event: StudyEvent::Anchored,
        words: "held at anchor",
        counted: Counted::Flag("anchored"),
    },
    Declared {
        event: StudyEvent::Towing,
        words: "held, towing",
        counted: Counted::All(&[HELD, Counted::Above("speed_made_good_m_s", ANCHORED_M_S)]),
    },
];

/// Rope at the mouth or head at the end, at a flipper, and at the tail; of held whales alone.
const ON_PLACES: [Counted<'static>; 3] = [
    Counted::Flag("rope_on_head"),
    Counted::Flag("rope_on_flipper"),
    Counted::Flag("rope_on_tail"),
];

/// Events that describe a held whale as accounts of real ones do: rope at its end, and the gear that it carries.
static HELD_STATE: [Declared; 10] = [
    Declared {
        event: StudyEvent::OnHead,
        words: "held, rope at mouth or head",
        counted: ON_PLACES[0],
    },
    Declared {
        event: StudyEvent::OnFlipper,
        words: "held, rope at a flipper",
        counted: ON_PLACES[1],
    },
    Declared { event: StudyEvent::OnTail, words: "held, rope at the tail", counted: ON_PLACES[2] },
    Declared {
        event: StudyEvent::OnTwoPlaces,
        words: "held, rope at two places or more",
        counted: Counted::Any(&[
            Counted::All(&[ON_PLACES[0], ON_PLACES[1]]),
            Counted::All(&[ON_PLACES[0], ON_PLACES[2]]),
            Counted::All(&[ON_PLACES[1], ON_PLACES[2]]),
        ]),
    },
    Declared {
        event: StudyEvent::WrapsPresent,
        words: "held with half a turn",
        counted: Counted::Flag("wraps_present"),
    },
    Declared {
        event: StudyEvent::Constricting,
        words: "held, a part constricted",
        counted: Counted::Flag("constricting"),
    },
    Declared {
        event: StudyEvent::TrapsAttached,
        words: "held, traps attached",
        counted: Counted::All(&[HELD, Counted::Above("carried_traps", 0.0)]),
    },
    Declared {
        event: StudyEvent::BuoysAttached,
        words: "held, buoys attached",
        counted: Counted::All(&[HELD, Counted::Above("carried_buoys", 0.0)]),
    },
    Declared {
        event: StudyEvent::Trailing,
        words: "held, gear trails",
        counted: Counted::Flag("trailing"),
    },
    Declared {
        event: StudyEvent::Trailing10M,
        words: "held, more than 10 m of rope trails",
        counted: Counted::All(&[HELD, Counted::Above("trailing_m", 10.0)]),
    },
];

/// Named groups of parts.
fn groups() -> [(&'static str, Vec<BodyPart>); 3] {
    let tailstock = std::iter::once(BodyPart::Peduncle).chain(Limb::Fluke.parts());
    [
        (Limb::Flipper.name(), Limb::Flipper.parts().collect()),
        (Limb::Fluke.name(), Limb::Fluke.parts().collect()),
        ("tailstock", tailstock.collect()),
    ]
}

impl StudyEvent {
    /// Whether the moment at which something first parts decides it; other events depend on what follows.
    pub fn is_known_at_parting(&self) -> bool {
        matches!(self, Self::Contact | Self::Parted)
    }

    /// All events.
    pub fn all() -> Vec<Self> {
        let mut all = Self::of_the_whole();
        all.extend(HELD_STATE.iter().map(|declared| declared.event.clone()));
        for kind in [RegionEvent::Contact, RegionEvent::Wrap, RegionEvent::Injury] {
            all.extend(BodyPart::ALL.into_iter().map(|part| Self::On(kind, vec![part])));
            all.extend(groups().into_iter().map(|(_, parts)| Self::On(kind, parts)));
        }
        all.push(Self::On(RegionEvent::Wrap, BodyPart::ALL.to_vec()));
        all
    }

    /// Events of the whole whale, in the order of a report.
    pub fn of_the_whole() -> Vec<Self> {
        WHOLE.iter().map(|declared| declared.event.clone()).collect()
    }

    /// Events of the chart at the head of a report.
    pub fn of_the_chart() -> [Self; 4] {
        [Self::Contact, Self::Entangled, Self::Parted, Self::HeldFast]
    }

    /// Names of places on the whale in names of events, in the order of a report: parts of the trunk and pairs of limbs.
    pub fn places() -> Vec<&'static str> {
        let place = |part: BodyPart| match part.limb() {
            Limb::Trunk => part.name(),
            limb => limb.name(),
        };
        let mut places: Vec<&'static str> = BodyPart::ALL.into_iter().map(place).collect();
        places.dedup();
        places
    }

    /// Its name in files and tables, such as `entangled`, `contact_head` or `wrap_flipper`.
    pub fn name(&self) -> String {
        match self {
            Self::On(RegionEvent::Contact, parts) => format!("contact_{}", place(parts)),
            Self::On(RegionEvent::Wrap, parts) => format!("wrap_{}", place(parts)),
            Self::On(RegionEvent::Injury, parts) => format!("injury_{}", place(parts)),
            whole => <&str>::from(whole).to_owned(),
        }
    }

    /// Its name as shown to the user, such as `rope on head` or `wrap on flipper`.
    pub fn words(&self) -> String {
        match self {
            Self::On(RegionEvent::Contact, parts) => {
                format!("rope on {}", place(parts).replace('_', " "))
            }
            Self::On(RegionEvent::Wrap, parts) => {
                format!("wrap on {}", place(parts).replace('_', " "))
            }
            Self::On(RegionEvent::Injury, parts) => {
                format!("pressed beyond blubber's strength on {}", place(parts).replace('_', " "))
            }
            whole => whole.declared().map_or("", |declared| declared.words).to_owned(),
        }
    }

    /// Its condition in the table of a study.
    pub fn counted(&self) -> Counted<'_> {
        match self {
            Self::On(RegionEvent::Contact, parts) => {
                Counted::AtLeast("peak_normal_N", parts, f64::MIN_POSITIVE)
            }
            Self::On(RegionEvent::Wrap, parts) => {
                Counted::AtLeast("peak_wraps", parts, HOOKED_TURNS)
            }
            Self::On(RegionEvent::Injury, parts) => {
                Counted::AtLeast("peak_pressure_Pa", parts, INJURY_PA)
            }
            whole => whole.declared().map_or(Counted::Outcome(&[]), |declared| declared.counted),
        }
    }

    /// Whether the event says that rope holds the whale at the end.
    pub fn is_held(&self) -> bool {
        use StudyEvent::{Anchored, Entangled, HeldFast, HeldLodged, HeldTurn, Towing};
        matches!(self, Entangled | HeldFast | HeldLodged | HeldTurn | Anchored | Towing)
            || HELD_STATE.iter().any(|declared| declared.event == *self)
    }

    fn declared(&self) -> Option<&'static Declared> {
        WHOLE.iter().chain(&HELD_STATE).find(|declared| declared.event == *self)
    }

    /// The event of a name.
    pub fn find(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|event| event.name() == name)
    }
}

fn place(parts: &[BodyPart]) -> String {
    if let [part] = parts {
        return part.name().to_owned();
    }
    groups().iter().find(|(_, group)| group == parts).map_or("any", |(name, _)| name).to_owned()
}

/// A required event.
pub(super) fn need(fields: &Fields<'_>, key: &'static str) -> Option<StudyEvent> {
    fields
        .need_text(key, "write an event such as \"entangled\", \"parted\" or \"wrap_flipper\"")?;
    maybe(fields, key)
}

/// An event, if present.
pub(super) fn maybe(fields: &Fields<'_>, key: &'static str) -> Option<StudyEvent> {
    find(&fields.text(key)?, fields)
}

/// A list of events.
pub(super) fn list(fields: &Fields<'_>, key: &'static str) -> Vec<At<StudyEvent>> {
    let at = |word: At<String>| Some(At { value: find(&word, fields)?, place: word.place });
    texts(fields, key).into_iter().filter_map(at).collect()
}

/// The event of a word; an unknown one is reported.
fn find(word: &At<String>, fields: &Fields<'_>) -> Option<StudyEvent> {
    let found = StudyEvent::find(&word.value);
    if found.is_none() {
        let names: Vec<String> = StudyEvent::all().iter().map(StudyEvent::name).collect();
        fields.problems().push(word.place.error(
            format!("there is no event `{}`", word.value),
            hint(&word.value, names.iter().map(String::as_str)),
        ));
    }
    found
}
