//! Lines made shorter.

use endline_gear::units::{Quantity, parse};

use super::super::candidate::Candidate;
use super::super::demand::Limit;
use super::Lever;
use super::scene::{Scene, metres, written};

/// A length is cut a little below its limit, so that rounding does not bring it back above.
const BELOW: f64 = 0.999;

/// The rope to a second buoy.
pub(super) fn of_surface_line(scene: &Scene<'_>, most: &Limit) -> Lever {
    let edit = Candidate::new(format!("Shorten the rope between the buoys to {}.", most.text));
    if scene.attribute("high_flyer_length").is_some() {
        return vec![vec![edit.put("attributes.high_flyer_length", most.text.clone())]];
    }
    let read = |index: usize, key: &str| scene.document.get(&format!("line.{index}.{key}"));
    let is_buoy = |end: Option<String>| {
        let part = end.as_deref().and_then(|end| end.split(':').next()).map(str::to_owned);
        let place = part.and_then(|part| scene.place_in("body", &part));
        place.and_then(|place| scene.document.get(&format!("{place}.kind"))).as_deref()
            == Some("buoy")
    };
    let too_long = |index: &usize| {
        let length = read(*index, "length").and_then(|text| parse(&text, Quantity::Length).ok());
        length.is_some_and(|length_m| length_m > most.si)
            && is_buoy(read(*index, "from"))
            && is_buoy(read(*index, "to"))
    };
    let lines: Vec<usize> = (0..scene.document.count("line")).filter(too_long).collect();
    let put = |edit: Candidate, index: &usize| {
        edit.put(format!("line.{index}.length"), most.text.clone())
    };
    if lines.is_empty() { Vec::new() } else { vec![vec![lines.iter().fold(edit, put)]] }
}

/// Endlines: by the scope of their gear type, or by their longest line.
pub(super) fn of_endline(scene: &Scene<'_>, most_m: f64) -> Lever {
    let lengths = |endline| Scene::lines(endline).iter().map(|line| line.length_m).sum::<f64>();
    let longest_m = scene.endlines().into_iter().map(lengths).fold(0.0, f64::max);
    if let Some(scope) = scene.number("scope", Quantity::Ratio) {
        let shorter = written((scope * most_m / longest_m * BELOW * 1e2).floor() / 1e2);
        let edit = Candidate::new(format!("Shorten the endline to a scope of {shorter}."));
        return vec![vec![edit.put("attributes.scope", shorter)]];
    }
    let mut edit = Candidate::new(format!("Shorten the endline to {}.", metres(most_m)));
    for endline in scene.endlines() {
        let over_m = lengths(endline) - most_m * BELOW;
        let lines = Scene::lines(endline);
        let longest = lines.iter().max_by(|one, other| one.length_m.total_cmp(&other.length_m));
        let Some((line, place)) =
            longest.and_then(|line| Some((line, scene.place_in("line", &line.line)?)))
        else {
            continue;
        };
        if over_m > 0.0 && line.length_m > over_m {
            edit = edit.put(format!("{place}.length"), metres(line.length_m - over_m));
        }
    }
    if edit.steps.is_empty() { Vec::new() } else { vec![vec![edit]] }
}

/// Groundlines: by the spacing of their gear type, or each by the same share.
pub(super) fn of_trawl(scene: &Scene<'_>, most_m: f64) -> Lever {
    let whole_m: f64 = scene.gear.groundlines.iter().map(|line| line.length_m).sum();
    let share = BELOW * most_m / whole_m;
    if let Some(spacing_m) = scene.number("spacing", Quantity::Length) {
        let shorter = metres((spacing_m * share * 1e2).floor() / 1e2);
        let edit = Candidate::new(format!("Set the traps {shorter} apart."));
        return vec![vec![edit.put("attributes.spacing", shorter)]];
    }
    let says = format!("Shorten each groundline to {} % of its length.", written(100.0 * share));
    let put = |edit: Candidate, line: &super::super::super::gear::Piece| match scene
        .place_in("line", &line.line)
    {
        Some(place) => edit.put(format!("{place}.length"), metres(line.length_m * share)),
        None => edit,
    };
    let edit = scene.gear.groundlines.iter().fold(Candidate::new(says), put);
    if scene.gear_type.is_some() || edit.steps.is_empty() { Vec::new() } else { vec![vec![edit]] }
}
