//! The rope of an observation: the order of places that it passes, what hung behind, and ranges from least to most.

use endline_gear::{Document, PathPlace, RopeEnd, Setting, Site};

use super::super::documents::Documents;
use super::{list, list_in, path, put, put_list, set};

/// List of the places that a rope passes.
const ORDER: &str = "path.order";

/// List of what was at the ends of the rope.
const ENDS: &str = "trailing.ends";

/// A range of an observation, from least to most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Wraps about a site [turns].
    Wraps(Site),
    /// Strands that lie across a site without a turn.
    Across(Site),
    /// Rope behind the whale, with its unit.
    Trailing,
    /// Turns of the rope's two legs about each other.
    Twist,
}

impl Range {
    /// Its dotted path, for its problems; `None` if its site has no sighting.
    pub fn path(self, documents: &Documents) -> Option<String> {
        match self {
            Self::Wraps(site) => path(documents, site, "wraps"),
            Self::Across(site) => path(documents, site, "across"),
            Self::Trailing => Some("trailing.length".to_owned()),
            Self::Twist => Some("twist.turns".to_owned()),
        }
    }
}

/// Least and most of a range as typed; empty if it is unknown.
pub fn range(documents: &Documents, range: Range) -> [String; 2] {
    let ends = range.path(documents).map(|path| list(documents, &path)).unwrap_or_default();
    [0, 1].map(|end| ends.get(end).cloned().unwrap_or_default())
}

/// Sets least (0) or most (1) of a range to the text typed. The other end begins with the same; without a text the range goes.
/// Errors: where the text has something else in its place.
pub fn set_range(
    document: &mut Document,
    range: Range,
    mut ends: [String; 2],
    end: usize,
    text: &str,
) -> Result<(), String> {
    let text = text.trim();
    for (place, other) in ends.iter_mut().enumerate() {
        if place == end || other.is_empty() {
            text.clone_into(other);
        }
    }
    let written = ends.map(|end| match range {
        Range::Trailing => Setting::text(&end).written(),
        Range::Wraps(_) | Range::Across(_) | Range::Twist => Setting::plain(&end).written(),
    });
    let value =
        (!text.is_empty()).then(|| Setting::plain(&format!("[{}, {}]", written[0], written[1])));
    match range {
        Range::Wraps(site) => set(document, site, "wraps", value.as_ref()),
        Range::Across(site) => set(document, site, "across", value.as_ref()),
        Range::Trailing => put(document, "trailing.length", value.as_ref()),
        Range::Twist => put(document, "twist.turns", value.as_ref()),
    }
}

/// The places that a rope passes, as typed.
pub fn places(documents: &Documents) -> Vec<String> {
    list(documents, ORDER)
}

/// Adds a place at the end of the path.
/// Errors: where the path is something else in the text.
pub fn add_place(document: &mut Document, place: PathPlace) -> Result<(), String> {
    let mut places = list_in(document, ORDER);
    places.push(place.to_string());
    put_list(document, ORDER, &places)
}

/// Takes a place out of the path.
/// Errors: where the path is something else in the text.
pub fn remove_place(document: &mut Document, index: usize) -> Result<(), String> {
    let mut places = list_in(document, ORDER);
    if index < places.len() {
        places.remove(index);
    }
    put_list(document, ORDER, &places)
}

/// Moves a place of the path one place towards the beginning.
/// Errors: where the path is something else in the text.
pub fn move_place(document: &mut Document, index: usize) -> Result<(), String> {
    let mut places = list_in(document, ORDER);
    if index > 0 && index < places.len() {
        places.swap(index - 1, index);
    }
    put_list(document, ORDER, &places)
}

/// What was at the ends of the rope, as typed.
pub fn ends(documents: &Documents) -> Vec<String> {
    list(documents, ENDS)
}

/// Adds an end of the rope.
/// Errors: where the ends are something else in the text.
pub fn add_end(document: &mut Document, end: RopeEnd) -> Result<(), String> {
    let mut ends = list_in(document, ENDS);
    ends.push(end.name().to_owned());
    put_list(document, ENDS, &ends)
}

/// Takes an end of the rope away.
/// Errors: where the ends are something else in the text.
pub fn remove_end(document: &mut Document, index: usize) -> Result<(), String> {
    let mut ends = list_in(document, ENDS);
    if index < ends.len() {
        ends.remove(index);
    }
    put_list(document, ENDS, &ends)
}
