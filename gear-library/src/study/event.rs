//! Events a study counts: an outcome, or rope on a part of the whale.

use endline_sdk::{BodyPart, Limb};

use crate::diagnostic::At;
use crate::fields::Fields;
use crate::nearest::hint;

use super::option::texts;

/// Turns about a part from which it counts as wrapped; as `docs/entanglement.md` has it, half a turn hooks. An estimate.
pub const HOOKED_TURNS: f64 = 0.5;

/// Something an encounter did or did not come to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StudyEvent {
    /// Rope touched the whale.
    Contact,
    /// Rope touched and let go, nothing parted.
    Shed,
    /// Rope still held at the end, parted or not.
    Entangled,
    /// A link or line parted after the first contact.
    Parted,
    /// It parted and the whale came free.
    PartedFree,
    /// It parted and rope still held.
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
    /// Rope held at the end, and the whale hung at gear that is fast.
    Anchored,
    /// Rope held at the end, and the whale towed what hung on it.
    Towing,
    /// Rope on any of these parts.
    On(RegionEvent, Vec<BodyPart>),
}

/// What rope did on a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionEvent {
    /// It touched.
    Contact,
    /// It went round at least [`HOOKED_TURNS`] at some time.
    Wrap,
    /// It pressed harder than blubber bears, at some time.
    Injury,
}

/// How an event is counted in the table of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Counted<'a> {
    /// By the outcome, which is one of these.
    Outcome(&'a [&'a str]),
    /// By a column that has a number where the event came.
    Present(&'a str),
    /// By a column that says yes.
    Flag(&'a str),
    /// By a column of any of these parts, whose number is at least so much.
    AtLeast(&'a str, &'a [BodyPart], f64),
    /// By a column whose number is above so much.
    Above(&'a str, f64),
    /// By a column whose number is not above so much.
    NotAbove(&'a str, f64),
    /// Where all of these came.
    All(&'a [Counted<'a>]),
    /// Where any of these came.
    Any(&'a [Counted<'a>]),
}

/// Outcomes in which rope holds at the end.
const HELD: Counted<'static> = Counted::Outcome(&["entangled", "parted_entangled"]);
/// Rope lodged in the mouth at the end.
const LODGED: Counted<'static> = Counted::Flag("lodged_in_mouth");
/// A whole turn about some part at the end.
const TURN: Counted<'static> = Counted::AtLeast("wraps", &BodyPart::ALL, 1.0);
/// Speed made good up to which a whale held by tethered rope hangs at anchor [m/s]; an estimate.
pub const ANCHORED_M_S: f64 = 0.1;
/// Pressure that blubber bears: its strength is 0.25 to 0.44 MPa (Raymond 2007, in whalestrike), the greater taken [Pa].
pub const INJURY_PA: f64 = 4.4e5;

/// What is declared of an event that concerns the whole whale.
struct Declared {
    event: StudyEvent,
    /// Name in files and tables.
    name: &'static str,
    /// Name as shown to the user.
    words: &'static str,
    counted: Counted<'static>,
    /// Whether the chart at the head of a report has it.
    in_chart: bool,
}

/// Every event that concerns the whole whale, in the order in which a report lists them.
static WHOLE: [Declared; 13] = [
    Declared {
        event: StudyEvent::Contact,
        name: "contact",
        words: "rope touches",
        counted: Counted::Present("first_contact_s"),
        in_chart: true,
    },
    Declared {
        event: StudyEvent::Shed,
        name: "shed",
        words: "shed",
        counted: Counted::Outcome(&["shed"]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::Entangled,
        name: "entangled",
        words: "entangled at the end",
        counted: HELD,
        in_chart: true,
    },
    Declared {
        event: StudyEvent::Parted,
        name: "parted",
        words: "something parted",
        counted: Counted::Outcome(&["parted_free", "parted_entangled"]),
        in_chart: true,
    },
    Declared {
        event: StudyEvent::PartedFree,
        name: "parted_free",
        words: "parted and free",
        counted: Counted::Outcome(&["parted_free"]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::PartedEntangled,
        name: "parted_entangled",
        words: "parted, still entangled",
        counted: Counted::Outcome(&["parted_entangled"]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::Lodged,
        name: "lodged",
        words: "lodged in the mouth",
        counted: Counted::Flag("was_lodged_in_mouth"),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::Caught,
        name: "caught",
        words: "buoy or trap caught on the whale",
        counted: Counted::Flag("was_body_caught"),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::HeldFast,
        name: "held_fast",
        words: "held: lodged or a whole turn",
        counted: Counted::All(&[HELD, Counted::Any(&[LODGED, TURN])]),
        in_chart: true,
    },
    Declared {
        event: StudyEvent::HeldLodged,
        name: "held_lodged",
        words: "held, lodged in the mouth",
        counted: Counted::All(&[HELD, LODGED]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::HeldTurn,
        name: "held_turn",
        words: "held with a whole turn",
        counted: Counted::All(&[HELD, TURN]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::Anchored,
        name: "anchored",
        words: "held at anchor",
        counted: Counted::All(&[
            HELD,
            Counted::Above("tethered_m", 0.0),
            Counted::NotAbove("speed_made_good_m_s", ANCHORED_M_S),
        ]),
        in_chart: false,
    },
    Declared {
        event: StudyEvent::Towing,
        name: "towing",
        words: "held, towing",
        counted: Counted::All(&[HELD, Counted::Above("speed_made_good_m_s", ANCHORED_M_S)]),
        in_chart: false,
    },
];

/// Groups of parts that have a name of their own.
fn groups() -> [(&'static str, Vec<BodyPart>); 3] {
    let tailstock = std::iter::once(BodyPart::Peduncle).chain(Limb::Fluke.parts());
    [
        (Limb::Flipper.name(), Limb::Flipper.parts().collect()),
        (Limb::Fluke.name(), Limb::Fluke.parts().collect()),
        ("tailstock", tailstock.collect()),
    ]
}

impl StudyEvent {
    /// Every event there is.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Self::of_the_whole();
        for kind in [RegionEvent::Contact, RegionEvent::Wrap, RegionEvent::Injury] {
            all.extend(BodyPart::ALL.into_iter().map(|part| Self::On(kind, vec![part])));
            all.extend(groups().into_iter().map(|(_, parts)| Self::On(kind, parts)));
        }
        all.push(Self::On(RegionEvent::Wrap, BodyPart::ALL.to_vec()));
        all
    }

    /// Events that concern the whole whale, in the order in which a report lists them.
    #[must_use]
    pub fn of_the_whole() -> Vec<Self> {
        WHOLE.iter().map(|declared| declared.event.clone()).collect()
    }

    /// Events of the chart at the head of a report.
    #[must_use]
    pub fn of_the_chart() -> Vec<Self> {
        let charted = WHOLE.iter().filter(|declared| declared.in_chart);
        charted.map(|declared| declared.event.clone()).collect()
    }

    /// Names of the places on the whale that a report lists, as they stand in names of events: each part of the trunk,
    /// and each pair of limbs as one.
    #[must_use]
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
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::On(RegionEvent::Contact, parts) => format!("contact_{}", place(parts)),
            Self::On(RegionEvent::Wrap, parts) => format!("wrap_{}", place(parts)),
            Self::On(RegionEvent::Injury, parts) => format!("injury_{}", place(parts)),
            whole => whole.declared().map_or("", |declared| declared.name).to_owned(),
        }
    }

    /// Its name as shown to the user, such as `rope on head` or `wrap on flipper`.
    #[must_use]
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

    /// How it is counted in the table of a study.
    #[must_use]
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

    fn declared(&self) -> Option<&'static Declared> {
        WHOLE.iter().find(|declared| declared.event == *self)
    }

    /// The event of a name.
    #[must_use]
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

/// An event that must be named under a key.
pub(super) fn need(fields: &Fields<'_>, key: &'static str) -> Option<StudyEvent> {
    fields
        .need_text(key, "write an event such as \"entangled\", \"parted\" or \"wrap_flipper\"")?;
    maybe(fields, key)
}

/// An event under a key, if it is there.
pub(super) fn maybe(fields: &Fields<'_>, key: &'static str) -> Option<StudyEvent> {
    find(&fields.text(key)?, fields)
}

/// Events in a list under a key.
pub(super) fn list(fields: &Fields<'_>, key: &'static str) -> Vec<At<StudyEvent>> {
    let at = |word: At<String>| Some(At { value: find(&word, fields)?, place: word.place });
    texts(fields, key).into_iter().filter_map(at).collect()
}

/// The event of a word, or the problem that there is none.
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
