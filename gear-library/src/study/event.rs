//! Events a study counts: an outcome, or rope on a part of the whale.

use endline_sdk::{BodyPart, Limb};

use crate::fields::Fields;
use crate::nearest::hint;

/// Turns about a part from which it counts as wrapped; as `docs/entanglement.md` has it, half a turn hooks. An estimate.
pub const HOOKED_TURNS: f64 = 0.5;

/// Something an encounter did or did not come to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
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
}

/// Groups of parts that have a name of their own.
fn groups() -> [(&'static str, Vec<BodyPart>); 3] {
    let tailstock = std::iter::once(BodyPart::Peduncle).chain(Limb::Fluke.parts());
    [
        (Limb::Flipper.name(), Limb::Flipper.parts().collect()),
        (Limb::Fluke.name(), Limb::Fluke.parts().collect()),
        ("tailstock", tailstock.collect()),
    ]
}

impl Event {
    /// Every event there is.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Self::of_the_whole().to_vec();
        for kind in [RegionEvent::Contact, RegionEvent::Wrap] {
            all.extend(BodyPart::ALL.into_iter().map(|part| Self::On(kind, vec![part])));
            all.extend(groups().into_iter().map(|(_, parts)| Self::On(kind, parts)));
        }
        all.push(Self::On(RegionEvent::Wrap, BodyPart::ALL.to_vec()));
        all
    }

    /// Events that concern the whole whale, in the order in which a report lists them.
    #[must_use]
    pub fn of_the_whole() -> [Self; 7] {
        [
            Self::Contact,
            Self::Shed,
            Self::Entangled,
            Self::Parted,
            Self::PartedFree,
            Self::PartedEntangled,
            Self::Lodged,
        ]
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
            Self::Contact => "contact".into(),
            Self::Shed => "shed".into(),
            Self::Entangled => "entangled".into(),
            Self::Parted => "parted".into(),
            Self::PartedFree => "parted_free".into(),
            Self::PartedEntangled => "parted_entangled".into(),
            Self::Lodged => "lodged".into(),
            Self::On(kind, parts) => {
                let kind = if *kind == RegionEvent::Contact { "contact" } else { "wrap" };
                format!("{kind}_{}", place(parts))
            }
        }
    }

    /// Its name as shown to the user, such as `rope on head` or `wrap on flipper`.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Contact => "rope touches".into(),
            Self::Shed => "shed".into(),
            Self::Entangled => "entangled at the end".into(),
            Self::Parted => "something parted".into(),
            Self::PartedFree => "parted and free".into(),
            Self::PartedEntangled => "parted, still entangled".into(),
            Self::Lodged => "lodged in the mouth".into(),
            Self::On(RegionEvent::Contact, parts) => {
                format!("rope on {}", place(parts).replace('_', " "))
            }
            Self::On(RegionEvent::Wrap, parts) => {
                format!("wrap on {}", place(parts).replace('_', " "))
            }
        }
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
pub(super) fn need(fields: &Fields<'_>, key: &'static str) -> Option<Event> {
    fields
        .need_text(key, "write an event such as \"entangled\", \"parted\" or \"wrap_flipper\"")?;
    maybe(fields, key)
}

/// An event under a key, if it is there.
pub(super) fn maybe(fields: &Fields<'_>, key: &'static str) -> Option<Event> {
    let word = fields.text(key)?;
    let found = Event::find(&word.value);
    if found.is_none() {
        let names: Vec<String> = Event::all().iter().map(Event::name).collect();
        fields.problems().push(word.place.error(
            format!("there is no event `{}`", word.value),
            hint(&word.value, names.iter().map(String::as_str)),
        ));
    }
    found
}
