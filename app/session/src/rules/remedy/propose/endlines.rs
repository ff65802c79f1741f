//! Endlines and floats taken off, high-flyers put on.

use super::super::super::gear::Endline;
use super::super::candidate::{Candidate, Step};
use super::Lever;
use super::scene::Scene;

/// Length of a high-flyer's line where the gear says none.
const FLYER_LINE: &str = "2 fathom";

/// So many endlines at most.
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
    let along_m = endline_gear::units::parse(&text, endline_gear::units::Quantity::Length);
    format!("[\"{}\", \"0 m\"]", super::scene::metres(along_m.unwrap_or(0.0) + 3.0))
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
