//! Fields that priors set, and drawn values written into a scenario and a library.

use endline_gear::{Document, EditError, Prior, Setting, Sources, Target};

use crate::error::Error;

use super::Drawn;

/// The field of the scenario or library item that a prior sets in the first place.
pub(crate) fn field_of(prior: &Prior) -> &str {
    match &prior.target {
        Target::Scenario(field) | Target::Library(_, field) => field,
        Target::Known => known_field(&prior.name.value).unwrap_or("whale.position"),
    }
}

/// That field as an option names it.
fn path_of(prior: &Prior) -> String {
    if let Target::Library(..) = prior.target {
        prior.name.value.clone()
    } else {
        field_of(prior).to_owned()
    }
}

/// The scenario field of a known prior; `None` where it is not one field.
fn known_field(name: &str) -> Option<&'static str> {
    Some(match name {
        "age" => "whale.age",
        "answer" => "whale.answer_to_touch",
        "answer_above" => "whale.answer_above",
        "behaviour" => "whale.pilot.0.act",
        "condition" => "whale.condition",
        "depth" => "whale.depth",
        "flipper_raise" => "whale.pilot.0.flipper_raise",
        "flipper_sweep" => "whale.pilot.0.flipper_sweep",
        "flipper_twist" => "whale.pilot.0.flipper_twist",
        "gape" => "whale.pilot.0.mouth",
        "length" => "whale.length",
        "pitch" => "whale.pitch",
        "roll" => "whale.roll",
        "speed" => "whale.speed",
        "tide" => "current.speed",
        _ => return None,
    })
}

/// Writes drawn values into a scenario and library, except for fields that the option sets and for the whale's place.
pub(crate) fn put_drawn<'a>(
    scenario: &mut Document,
    sources: &mut Sources,
    drawn: impl Iterator<Item = (&'a Prior, &'a Drawn)>,
    own: &[String],
) -> Result<(), Error> {
    for (prior, drawn) in drawn.filter(|(prior, _)| !own.contains(&path_of(prior))) {
        put_one(scenario, sources, prior, drawn)
            .map_err(|error| prior.name.place.error(error.message, ""))?;
    }
    Ok(())
}

fn put_one(
    scenario: &mut Document,
    sources: &mut Sources,
    prior: &Prior,
    drawn: &Drawn,
) -> Result<(), EditError> {
    match &prior.target {
        Target::Scenario(field) => scenario.put(field, &drawn.setting()),
        Target::Library(file, field) => {
            let missing = EditError { message: format!("the library has no file {file}") };
            let mut item = Document::parse(sources.get(file).ok_or(missing)?)?;
            item.put(field, &drawn.setting())?;
            let text = item.text();
            sources.set(file.clone(), text);
            Ok(())
        }
        Target::Known => put_known(scenario, drawn),
    }
}

fn put_known(scenario: &mut Document, drawn: &Drawn) -> Result<(), EditError> {
    let Some(field) = known_field(&drawn.name) else { return Ok(()) };
    if field.starts_with("whale.pilot.0.") && !scenario.has("whale.pilot.0") {
        scenario.put("whale.pilot.0.at", &Setting::text("0 s"))?;
        scenario.put("whale.pilot.0.speed", &Setting::number(1.0))?;
    }
    match (drawn.name.as_str(), drawn.text.as_str()) {
        ("behaviour", "swim") => return forget(scenario, field),
        ("age", _) => forget(scenario, "whale.length")?,
        ("length", _) => forget(scenario, "whale.age")?,
        ("speed", _) => scenario.put("whale.attributes.cruise_speed", &drawn.setting())?,
        _ => {}
    }
    scenario.put(field, &drawn.setting())
}

fn forget(scenario: &mut Document, field: &str) -> Result<(), EditError> {
    if scenario.has(field) { scenario.remove(field) } else { Ok(()) }
}
