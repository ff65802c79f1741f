//! How many traps are on a set.

use endline_gear::units::{Quantity, parse};
use endline_sdk::{AttributeKind, GearType};

use super::super::candidate::{Candidate, Step};
use super::Lever;
use super::scene::{Scene, metres};

/// Groundline from trap to trap where the gear has none to go by.
const USUAL_GROUNDLINE: (&str, &str) = ("sink-3-8", "12 fathom");

/// At least so many traps.
pub(super) fn added(scene: &Scene<'_>, least: f64) -> Lever {
    if scene.fishing.traps.is_some() {
        return Vec::new();
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of traps")]
    let least = least.ceil() as usize;
    match (&scene.gear_type, &scene.trawl) {
        (Some(gear), _) if counts_traps(gear.as_ref()) => vec![vec![
            Candidate::new(format!("Fish {least} traps on a trawl."))
                .put("attributes.traps", least.to_string()),
        ]],
        (Some(_), Some(trawl)) => vec![vec![as_trawl(scene, trawl.as_ref(), least)]],
        (Some(_), None) => Vec::new(),
        (None, _) => behind_the_last(scene, least).map_or_else(Vec::new, |edit| vec![vec![edit]]),
    }
}

/// Fewer traps on a trawl that is too long: as many as its spacing allows.
pub(super) fn taken_off(scene: &Scene<'_>, most_m: f64) -> Lever {
    let Some(gear) = scene.gear_type.as_ref().filter(|gear| counts_traps(gear.as_ref())) else {
        return Vec::new();
    };
    let whole_m: f64 = scene.gear.groundlines.iter().map(|line| line.length_m).sum();
    #[expect(clippy::cast_precision_loss, reason = "a count of traps")]
    let share = (scene.gear.traps as f64 * most_m / whole_m).floor();
    let fewer = |less: u8| (share - f64::from(less)).max(2.0);
    let edit = |less: u8| {
        Candidate::new(format!("Fish {} traps on a trawl.", fewer(less)))
            .put("attributes.traps", fewer(less).to_string())
    };
    // Lines to anchors do not shrink with the number of traps.
    if gear.descriptor().attributes.is_empty() {
        Vec::new()
    } else {
        (0..4).map(|less| vec![edit(less)]).collect()
    }
}

fn counts_traps(gear: &dyn GearType) -> bool {
    let counts = |kind: &AttributeKind| matches!(kind, AttributeKind::Count { .. });
    gear.descriptor().attributes.iter().any(|one| one.key == "traps" && counts(&one.kind))
}

/// Gear of few traps as a trawl of the same parts.
fn as_trawl(scene: &Scene<'_>, trawl: &dyn GearType, traps: usize) -> Candidate {
    let edit =
        Candidate::new(format!("Fish {traps} traps as a trawl of the same trap, buoy and rope."))
            .put("gear_type", trawl.descriptor().id.to_string());
    let known = |key: &String| trawl.descriptor().attributes.iter().any(|one| one.key == *key);
    let foreign = scene.document.keys("attributes").into_iter().filter(|key| !known(key));
    let edit = foreign.fold(edit, |edit, key| edit.remove(format!("attributes.{key}")));
    edit.put("attributes.traps", traps.to_string())
}

/// Traps and groundlines behind the last trap of gear that is written out part by part.
fn behind_the_last(scene: &Scene<'_>, least: usize) -> Option<Candidate> {
    let document = scene.document;
    let read = |index: usize, key: &str| document.get(&format!("body.{index}.{key}"));
    let is_trap = |index: &usize| read(*index, "kind").as_deref() == Some("trap");
    let last = (0..document.count("body")).rfind(is_trap)?;
    let (item, mut foot) = (read(last, "item")?, read(last, "id")?);
    let (rope, length) = scene
        .gear
        .groundlines
        .first()
        .and_then(|line| scene.place_in("line", &line.line))
        .and_then(|line| {
            let read = |key: &str| document.get(&format!("{line}.{key}"));
            Some((read("rope")?, read("length")?))
        })
        .unwrap_or_else(|| (USUAL_GROUNDLINE.0.to_owned(), USUAL_GROUNDLINE.1.to_owned()));
    let along_m = read(last, "position.0").and_then(|text| parse(&text, Quantity::Length).ok());
    let spacing_m = parse(&length, Quantity::Length).ok()?;
    let mut edit = Candidate::new(format!(
        "Add traps up to {least} behind `{foot}`, {length} of `{rope}` from trap to trap."
    ));
    let mut at_m = along_m.unwrap_or(0.0);
    for number in scene.gear.traps + 1..=least {
        let id = format!("added-trap-{number}");
        at_m -= 0.97 * spacing_m;
        edit.steps.push(Step::Add(
            "body",
            vec![
                ("id", id.clone()),
                ("kind", "trap".to_owned()),
                ("item", item.clone()),
                ("position", format!("[\"{}\", \"0 m\"]", metres(at_m))),
                ("height", "0".to_owned()),
            ],
        ));
        edit.steps.push(Step::Add(
            "line",
            vec![
                ("id", format!("added-groundline-{number}")),
                ("rope", rope.clone()),
                ("from", foot),
                ("to", id.clone()),
                ("length", length.clone()),
            ],
        ));
        foot = id;
    }
    Some(edit)
}
