//! The weak link at the buoy.

use super::super::candidate::{Candidate, Step};
use super::Lever;
use super::scene::Scene;

/// The strongest weak link of the library that a limit allows, at the buoy of every endline of the rule.
pub(super) fn at_buoy(scene: &Scene<'_>, most_n: f64) -> Lever {
    let fits = |rating_n: f64| rating_n <= most_n * (1.0 + 1e-9);
    let links = scene.library.weak_links.iter().filter(|link| fits(link.rating_n));
    let Some(link) = links.max_by(|one, other| one.rating_n.total_cmp(&other.rating_n)) else {
        return Vec::new();
    };
    let id = link.entry.id.as_str();
    let mut edit = Candidate::new(format!("Put the weak link `{id}` between buoy and line."));
    if scene.attribute("weak_link").is_some() {
        return vec![vec![edit.put("attributes.weak_link", id)]];
    }
    for endline in scene.endlines() {
        let Some(top) = Scene::lines(endline).into_iter().next() else { continue };
        let end = if top.from_to { "to" } else { "from" };
        let at = |index: &usize| {
            let read = |key: &str| scene.document.get(&format!("link.{index}.{key}"));
            read("line").as_ref() == Some(&top.line) && read("end").as_deref() == Some(end)
        };
        match (0..scene.document.count("link")).find(at) {
            Some(index) => edit = edit.put(format!("link.{index}.item"), id),
            None => edit.steps.push(Step::Add(
                "link",
                vec![
                    ("id", format!("{}-link", endline.id)),
                    ("item", id.to_owned()),
                    ("line", top.line),
                    ("end", end.to_owned()),
                ],
            )),
        }
    }
    vec![vec![edit]]
}
