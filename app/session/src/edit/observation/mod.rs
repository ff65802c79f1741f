//! An observation edited part by part: the sighting of each part, and the path of the rope with what trailed behind.
//!
//! A part that was hidden from view is under `[hidden]`, any other under `[[site]]`; a part under neither is unknown.
//! A fin has a sighting of its own or one of its pair, as in the text.

mod rope;
#[cfg(test)]
mod tests;

use endline_gear::{Document, EditError, Setting, Site};

use super::documents::Documents;
pub use rope::{
    Range, add_end, add_place, ends, move_place, places, range, remove_end, remove_place, set_range,
};

/// Text of a new observation.
pub const NEW: &str = r#"format = 1
kind = "observation"
name = "A new observation"
source = "not stated yet"
confidence = "estimate"
encounters = "met-single"
mirrored = false
"#;

/// List of the parts with a sighting.
const SITES: &str = "site";

/// List of the parts that were hidden from view.
const HIDDEN: &str = "hidden.parts";

/// How sure it is that rope was there, where the text does not say.
const SURE: f64 = 0.95;

/// The sighting of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sighting {
    /// Nothing.
    Nothing,
    /// It was hidden from view.
    Hidden,
    /// That it was seen, and the probability that rope was there: 1 surely, 0 surely not.
    Seen(f64),
}

impl Sighting {
    /// Whether rope was seen there rather than not.
    pub fn has_rope(self) -> bool {
        matches!(self, Self::Seen(present) if present > 0.5)
    }
}

/// The site that holds the sighting of a single part: itself, or its pair.
pub fn site_of(documents: &Documents, single: Site) -> Site {
    let pair = pair_of(single).filter(|pair| {
        sighting_of(documents, single) == Sighting::Nothing
            && sighting_of(documents, *pair) != Sighting::Nothing
    });
    pair.unwrap_or(single)
}

/// The pair of a fin: both of it.
pub fn pair_of(site: Site) -> Option<Site> {
    [Site::Flipper, Site::Fluke].into_iter().find(|pair| pair.singles().contains(&site))
}

/// The sighting of a site by its own name.
pub fn sighting_of(documents: &Documents, site: Site) -> Sighting {
    if list(documents, HIDDEN).iter().any(|name| name == site.name()) {
        return Sighting::Hidden;
    }
    match index_of(documents, site) {
        None => Sighting::Nothing,
        Some(_) => {
            let present = field(documents, site, "present").and_then(|text| text.parse().ok());
            Sighting::Seen(present.unwrap_or(SURE))
        }
    }
}

/// A field of a site as typed, such as `tight`; `None` where it is missing.
pub fn field(documents: &Documents, site: Site, key: &str) -> Option<String> {
    documents.field(Documents::OBSERVATION, &path(documents, site, key)?)
}

/// Dotted path of a field of a site, for its problems; `None` if the site has no sighting.
pub fn path(documents: &Documents, site: Site, key: &str) -> Option<String> {
    index_of(documents, site).map(|index| format!("{SITES}.{index}.{key}"))
}

fn index_of(documents: &Documents, site: Site) -> Option<usize> {
    let part = |index: usize| documents.field(Documents::OBSERVATION, &part_field(index));
    (0..documents.count(Documents::OBSERVATION, SITES))
        .find(|index| part(*index).as_deref() == Some(site.name()))
}

fn index_in(document: &Document, site: Site) -> Option<usize> {
    (0..document.count(SITES))
        .find(|index| document.get(&part_field(*index)).as_deref() == Some(site.name()))
}

fn part_field(index: usize) -> String {
    format!("{SITES}.{index}.part")
}

/// Tells of a site that rope was there or not, that it was hidden, or nothing.
/// Errors: where `site` or `hidden` are something else in the text.
pub fn set_sighting(document: &mut Document, site: Site, sighting: Sighting) -> Result<(), String> {
    let mut hidden = list_in(document, HIDDEN);
    hidden.retain(|name| name != site.name());
    match sighting {
        Sighting::Seen(present) => {
            put_list(document, HIDDEN, &hidden)?;
            let present = format!("{}", (100.0 * present).round() / 100.0);
            set(document, site, "present", Some(&Setting::plain(&present)))
        }
        Sighting::Hidden | Sighting::Nothing => {
            if let Some(index) = index_in(document, site) {
                document.remove_table(SITES, index).map_err(message)?;
            }
            if sighting == Sighting::Hidden {
                hidden.push(site.name().to_owned());
            }
            put_list(document, HIDDEN, &hidden)
        }
    }
}

/// Sets a field of a site, such as `tight`; `None` takes it away. A site without a sighting gets one.
/// Errors: where `site` is something else in the text.
pub fn set(
    document: &mut Document,
    site: Site,
    key: &str,
    value: Option<&Setting>,
) -> Result<(), String> {
    let index = match index_in(document, site) {
        Some(index) => index,
        None => document.push_table(SITES, &[("part", site.name())]).map_err(message)?,
    };
    put(document, &format!("{SITES}.{index}.{key}"), value)
}

/// Gives a pair the sighting of one of its parts, or a part that of its pair.
/// Errors: where `site` or `hidden` are something else in the text.
pub fn rename(document: &mut Document, from: Site, to: Site) -> Result<(), String> {
    let was_hidden = list_in(document, HIDDEN).iter().any(|name| name == from.name());
    let covered: Vec<Site> =
        to.singles().iter().copied().filter(|single| *single != from).collect();
    covered.into_iter().try_for_each(|single| set_sighting(document, single, Sighting::Nothing))?;
    if was_hidden {
        set_sighting(document, from, Sighting::Nothing)?;
        return set_sighting(document, to, Sighting::Hidden);
    }
    match index_in(document, from) {
        Some(index) => document.set(&part_field(index), to.name()).map_err(message),
        None => Ok(()),
    }
}

/// Sets a field of the observation itself as typed, such as `source`; without a text it goes. A length takes the place of an age, and
/// the reverse.
/// Errors: where the text has no place for the field.
pub fn set_field(document: &mut Document, field: &str, text: &str) -> Result<(), String> {
    let text = text.trim();
    let other = match field {
        "age" => Some("length"),
        "length" => Some("age"),
        _ => None,
    };
    if let Some(other) = other.filter(|other| !text.is_empty() && document.has(other)) {
        put(document, other, None)?;
    }
    if document.has(field) && !text.is_empty() {
        return document.set(field, text).map_err(message);
    }
    put(document, field, (!text.is_empty()).then(|| Setting::text(text)).as_ref())
}

/// Sets a field, or takes it away with its table where nothing is left in that.
fn put(document: &mut Document, field: &str, value: Option<&Setting>) -> Result<(), String> {
    if let Some(value) = value {
        return document.put(field, value).map_err(message);
    }
    if document.has(field) {
        document.remove(field).map_err(message)?;
    }
    match field.split_once('.') {
        Some((table, _)) if table != SITES && document.has(table) => {
            if document.keys(table).is_empty() {
                document.remove(table).map_err(message)
            } else {
                Ok(())
            }
        }
        _ => Ok(()),
    }
}

/// A list of texts of the open observation.
fn list(documents: &Documents, field: &str) -> Vec<String> {
    let item = |index: usize| documents.field(Documents::OBSERVATION, &format!("{field}.{index}"));
    (0..).map_while(item).collect()
}

fn list_in(document: &Document, field: &str) -> Vec<String> {
    (0..).map_while(|index: usize| document.get(&format!("{field}.{index}"))).collect()
}

/// Puts a list of texts; an empty one goes with its table.
fn put_list(document: &mut Document, field: &str, texts: &[String]) -> Result<(), String> {
    if list_in(document, field) == texts {
        return Ok(());
    }
    put(document, field, (!texts.is_empty()).then(|| Setting::texts(texts)).as_ref())
}

fn message(error: EditError) -> String {
    error.message
}
