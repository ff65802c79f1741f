//! One field of a scenario set as typed, together with the fields that depend on it.

use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Setting};

use super::documents::Documents;
use super::pilot_program::{self, LIST};

/// Fields without which their table means nothing.
const ESSENTIAL: [(&str, &str); 2] =
    [("waves.height", "waves"), ("current.tide.period", "current.tide")];
/// Fields that a new field needs beside it, with the value they begin with.
const BESIDE: [(&str, &str, &str); 1] = [("waves.height", "waves.period", "6 s")];
/// Pairs of fields of which only one may stand.
const EITHER: [(&str, &str); 2] = [("whale.length", "whale.age"), ("whale.age", "whale.length")];
/// Fields that a dead whale does not have, in the order of the file.
const ALIVE: [&str; 7] = [
    "whale.speed",
    "whale.motion",
    "whale.dynamics",
    "whale.acts",
    "whale.answer_to_touch",
    "whale.attributes",
    LIST,
];
/// Fields that a living whale needs.
const TO_LIVE: [(&str, &str); 2] =
    [("whale.speed", "1 m/s"), ("whale.motion", "org.endline.motion.swim")];

/// Sets a field of a scenario to the text typed; an empty text removes the field.
/// Errors: where the scenario has no place for the field.
pub fn set_field(document: &mut Document, field: &str, text: &str) -> Result<(), String> {
    let text = text.trim();
    if text.is_empty() {
        let whole =
            ESSENTIAL.iter().find(|(known, _)| *known == field).map_or(field, |(_, table)| table);
        take_away(document, whole)?;
        return if field == "whale.state" { revive(document) } else { Ok(()) };
    }
    // Another motion or law of friction has attributes of its own.
    let of_other = field.strip_suffix(".model").or_else(|| field.strip_suffix(".motion"));
    if let Some(table) = of_other {
        take_away(document, &format!("{table}.attributes"))?;
    }
    if field == "whale.state" {
        ALIVE.iter().try_for_each(|field| take_away(document, field))?;
    }
    for (_, other) in EITHER.iter().filter(|(known, _)| *known == field) {
        take_away(document, other)?;
    }
    put(document, field, text)?;
    for (_, other, usual) in BESIDE.iter().filter(|(known, ..)| *known == field) {
        if !document.has(other) {
            put(document, other, usual)?;
        }
    }
    Ok(())
}

/// Path of the list of friction laws for single surfaces.
pub const FRICTION_LAWS: &str = "friction.on";

/// Adds a friction law, by its plugin's id, for one surface.
/// Errors: where `friction.on` is no list of tables.
pub fn add_friction_law(document: &mut Document, surface: &str, law: &str) -> Result<(), String> {
    let failed = |error: endline_gear::EditError| error.to_string();
    let index = document.push_table(FRICTION_LAWS, &[("model", law)]).map_err(failed)?;
    let surfaces = Setting::texts(&[surface.to_owned()]);
    document.put(&format!("{FRICTION_LAWS}.{index}.surfaces"), &surfaces).map_err(failed)
}

fn put(document: &mut Document, field: &str, text: &str) -> Result<(), String> {
    let reported = |error: endline_gear::EditError| error.to_string();
    // A scenario without an entry at the start gets one.
    if field.starts_with(LIST)
        && !document.has(field.rsplit_once('.').map_or(field, |(table, _)| table))
    {
        let index =
            document.push_table(LIST, &[("at", "0 s"), ("mouth", text)]).map_err(reported)?;
        return pilot_program::in_order(document, index).map(|_| ());
    }
    if document.has(field) {
        document.set(field, text).map_err(reported)
    } else {
        document.put(field, &Setting::plain(text)).map_err(reported)
    }
}

fn take_away(document: &mut Document, field: &str) -> Result<(), String> {
    if document.has(field) {
        document.remove(field).map_err(|error| error.to_string())
    } else {
        Ok(())
    }
}

fn revive(document: &mut Document) -> Result<(), String> {
    for (field, usual) in TO_LIVE {
        if !document.has(field) {
            put(document, field, usual)?;
        }
    }
    Ok(())
}

/// Path of the field that says how far the mouth is open at the start: in the pilot's entry at time
/// zero, or in a new entry.
pub fn mouth_field(documents: &Documents) -> String {
    let count = documents.count(Documents::SCENARIO, LIST);
    let at = |index: usize| {
        documents
            .field(Documents::SCENARIO, &pilot_program::path(index, "at"))
            .and_then(|text| parse(&text, Quantity::Time).ok())
    };
    let first = (0..count).find(|index| at(*index) == Some(0.0)).unwrap_or(count);
    pilot_program::path(first, "mouth")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_come_with_a_period_and_go_as_a_whole() {
        let mut document = Document::parse("duration = \"9 s\"\n").unwrap();
        set_field(&mut document, "waves.height", "1.2 m").unwrap();
        assert_eq!(document.get("waves.period").as_deref(), Some("6 s"));
        set_field(&mut document, "waves.period", "8 s").unwrap();
        set_field(&mut document, "waves.height", "1.5 m").unwrap();
        assert_eq!(document.get("waves.period").as_deref(), Some("8 s"), "what was typed stays");
        set_field(&mut document, "waves.height", " ").unwrap();
        assert!(!document.has("waves"), "{}", document.text());
    }

    #[test]
    fn a_length_takes_the_place_of_an_age_and_a_number_stays_a_number() {
        let mut document =
            Document::parse("[whale]\nitem = \"right-whale\"\nlength = \"13 m\"\n").unwrap();
        set_field(&mut document, "whale.age", "2 yr").unwrap();
        assert!(!document.has("whale.length"));
        set_field(&mut document, "whale.condition", "0.9").unwrap();
        assert!(document.text().contains("condition = 0.9"), "{}", document.text());
    }

    #[test]
    fn a_law_for_one_surface_stands_in_the_list() {
        let mut document = Document::parse("[friction]\nmodel = \"a\"\n").unwrap();
        add_friction_law(&mut document, "baleen", "b").unwrap();
        let read = |field: &str| document.get(&format!("{FRICTION_LAWS}.0.{field}")).unwrap();
        assert_eq!([read("model"), read("surfaces.0")], ["b", "baleen"]);
    }

    #[test]
    fn another_law_of_friction_begins_without_the_attributes_of_the_one_before() {
        let text = "[friction]\nmodel = \"a\" # law\nattributes = { scale = 2 }\n\n[[friction.on]]\nsurfaces = [\"baleen\"]\nmodel = \"b\"\nattributes = { pull = \"5 N\" }\n";
        let mut document = Document::parse(text).unwrap();
        set_field(&mut document, "friction.attributes.scale", "3").unwrap();
        set_field(&mut document, "friction.on.0.model", "c").unwrap();
        assert!(
            document.text().contains("scale = 3") && document.text().contains("# law"),
            "{}",
            document.text()
        );
        assert!(
            !document.has("friction.on.0.attributes")
                && document.get("friction.on.0.model").as_deref() == Some("c")
        );
        set_field(&mut document, "friction.model", "d").unwrap();
        assert!(
            !document.has("friction.attributes") && document.has("friction.on.0"),
            "{}",
            document.text()
        );
    }

    #[test]
    fn a_dead_whale_neither_swims_nor_is_steered_and_one_alive_swims_again() {
        let text = "[whale]\nitem = \"x\"\nspeed = \"1 m/s\"\nmotion = \"m\"\n[whale.attributes]\ncruise_speed = \"1 m/s\"\n[[whale.pilot]]\nat = \"0 s\"\nspeed = 1.0\n";
        let mut document = Document::parse(text).unwrap();
        set_field(&mut document, "whale.state", "dead").unwrap();
        assert!(
            ["speed", "motion", "attributes", "pilot"]
                .iter()
                .all(|key| !document.has(&format!("whale.{key}"))),
            "{}",
            document.text()
        );
        set_field(&mut document, "whale.state", "").unwrap();
        assert_eq!(document.get("whale.motion").as_deref(), Some("org.endline.motion.swim"));
    }
}
