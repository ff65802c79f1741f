//! Endlines and floats removed, high-flyers added, traps added or removed.

use endline_gear::units::{Quantity, parse};
use endline_sdk::{AttributeKind, GearType};

use super::super::super::gear::Endline;
use super::super::trials::{Candidate, Step};
use super::{Lever, Scene, metres};

/// Length of a high-flyer's line where the gear has none.
const FLYER_LINE: &str = "2 fathom";

/// At most this many endlines.
pub(super) fn taken_off(scene: &Scene<'_>, most: f64) -> Lever {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count of endlines"
    )]
    let most = most as usize;
    if scene.attribute("endlines").is_some() {
        let edit = Candidate::new(format!("Fish {most} endline."));
        return vec![vec![edit.put("attributes.endlines", most.to_string())]];
    }
    if scene.gear_type.is_some() {
        return Vec::new();
    }
    let spare = scene.gear.endlines.iter().skip(most);
    let ids: Vec<&str> = spare.clone().map(|endline| endline.id.as_str()).collect();
    let edit = Candidate::new(format!("Take {} off, with its buoy.", ids.join(" and ")));
    vec![vec![spare.fold(edit, |edit, endline| without(scene, edit, endline))]]
}

/// Takes an endline out with its buoy, its splices and the weak links in it.
fn without(scene: &Scene<'_>, mut edit: Candidate, endline: &Endline) -> Candidate {
    let lines: Vec<String> = Scene::lines(endline).into_iter().map(|line| line.line).collect();
    for line in &lines {
        edit = without_line(scene, edit, line);
    }
    let ends = |line: &String| {
        let place = scene.place_in("line", line);
        let end = |key: &str| scene.document.get(&format!("{}.{key}", place.as_ref()?));
        [end("from"), end("to")].into_iter().flatten().collect::<Vec<_>>()
    };
    let mut joints: Vec<String> = lines.iter().flat_map(ends).collect();
    joints.sort();
    joints.dedup();
    let between = joints.into_iter().filter(|joint| scene.place_in("joint", joint).is_some());
    // A branch that other lines meet at stays.
    let own = between.filter(|joint| !others_meet(scene, joint, &lines));
    edit.steps.extend(own.map(|joint| Step::Drop("joint", joint)));
    edit.steps.push(Step::Drop("body", endline.buoy.clone()));
    edit
}

fn without_line(scene: &Scene<'_>, mut edit: Candidate, line: &str) -> Candidate {
    let links = 0..scene.document.count("link");
    let read = |index: usize, key: &str| scene.document.get(&format!("link.{index}.{key}"));
    let own = links.filter(|index| read(*index, "line").as_deref() == Some(line));
    edit.steps.extend(own.filter_map(|index| read(index, "id")).map(|id| Step::Drop("link", id)));
    edit.steps.push(Step::Drop("line", line.to_owned()));
    edit
}

fn others_meet(scene: &Scene<'_>, part: &str, lines: &[String]) -> bool {
    let read = |index: usize, key: &str| scene.document.get(&format!("line.{index}.{key}"));
    let meets = |index: usize| {
        let is_own = read(index, "id").is_some_and(|id| lines.contains(&id));
        let ends = [read(index, "from"), read(index, "to")];
        !is_own && ends.iter().flatten().any(|end| end.split(':').next() == Some(part))
    };
    (0..scene.document.count("line")).any(meets)
}

/// A high-flyer with a radar reflector beyond the buoy of every endline.
pub(super) fn with_reflectors(scene: &Scene<'_>) -> Lever {
    let reflects = |buoy: &&endline_gear::Buoy| {
        buoy.entry.pieces.iter().any(|piece| piece.name == "radar reflector")
    };
    let Some(flyer) = scene.library.buoys.iter().find(reflects) else { return Vec::new() };
    let item = flyer.entry.id.as_str();
    let mut edit = Candidate::new(format!(
        "Put the high-flyer `{item}` with a radar reflector beyond each buoy."
    ));
    if scene.attribute("high_flyer").is_some() {
        return vec![vec![edit.put("attributes.high_flyer", item)]];
    }
    if scene.gear_type.is_some() {
        return Vec::new();
    }
    for endline in &scene.gear.endlines {
        let Some(top) = Scene::lines(endline).into_iter().next() else { continue };
        let id = format!("{}-flyer", endline.buoy);
        edit.steps.push(Step::Add(
            "body",
            vec![
                ("id", id.clone()),
                ("kind", "buoy".to_owned()),
                ("item", item.to_owned()),
                ("position", beyond(scene, &endline.buoy)),
                ("height", "1".to_owned()),
            ],
        ));
        edit.steps.push(Step::Add(
            "line",
            vec![
                ("id", format!("{}-flyer-line", endline.id)),
                ("rope", top.rope),
                ("from", format!("{}:side", endline.buoy)),
                ("to", id),
                ("length", FLYER_LINE.to_owned()),
            ],
        ));
    }
    vec![vec![edit]]
}

/// A first guess of a place three metres beyond a buoy.
fn beyond(scene: &Scene<'_>, buoy: &str) -> String {
    let place = scene.place_in("body", buoy).unwrap_or_default();
    let text = scene.document.get(&format!("{place}.position.0")).unwrap_or_default();
    let along_m = parse(&text, Quantity::Length);
    format!("[\"{}\", \"0 m\"]", metres(along_m.unwrap_or(0.0) + 3.0))
}

/// Floats of the groundline taken off, with the lines that hold them.
pub(super) fn without_floats(scene: &Scene<'_>) -> Lever {
    if scene.gear_type.is_some() || scene.gear.floats.is_empty() {
        return Vec::new();
    }
    let mut edit = Candidate::new(format!("Take {} off.", scene.gear.floats.join(" and ")));
    for float in &scene.gear.floats {
        let read = |index: usize, key: &str| scene.document.get(&format!("line.{index}.{key}"));
        let holds = |index: &usize| {
            let ends = [read(*index, "from"), read(*index, "to")];
            ends.iter().flatten().any(|end| end.split(':').next() == Some(float))
        };
        let held = (0..scene.document.count("line")).filter(holds);
        for line in held.filter_map(|index| read(index, "id")).collect::<Vec<_>>() {
            edit = without_line(scene, edit, &line);
        }
        edit.steps.push(Step::Drop("body", float.clone()));
    }
    vec![vec![edit]]
}

/// Groundline from trap to trap where the gear has none to go by.
const USUAL_GROUNDLINE: (&str, &str) = ("sink-3-8", "12 fathom");

/// At least this many traps.
pub(super) fn traps_added(scene: &Scene<'_>, least: f64) -> Lever {
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
pub(super) fn traps_taken_off(scene: &Scene<'_>, most_m: f64) -> Lever {
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
