//! Ropes of lines: the most similar rope of the library that meets the rule; lengths of lines; weak links.

use endline_gear::Rope;
use endline_gear::units::{Quantity, parse};

use super::super::demand::Limit;
use super::super::trials::{Candidate, Step};
use super::{Lever, Scene, metres, written};

/// Sea water that rope sinks in [kg/m³].
pub(super) const SEA_WATER_KG_M3: f64 = 1025.0;

/// A tenth of this density counts like a tenth of the diameter [kg/m³].
const DENSITY_KG_M3: f64 = 1000.0;

/// Lines or attributes changed together at most.
const MOST_TOGETHER: usize = 4;

/// Properties by which two ropes differ: diameter, density, strength.
pub(super) type Counts = [f64; 3];

/// A weak rope is to be like the strong one but for its strength.
pub(super) const UNLIKE_STRENGTH: Counts = [1.0, 1.0, 0.0];
const UNLIKE_DIAMETER: Counts = [1.0, 1.0, 0.5];
const UNLIKE_DENSITY: Counts = [1.0, 1.0, 1.0];

/// A place of the file that names a rope.
struct Named {
    field: String,
    /// The line, or the attribute in words.
    of: String,
    rope: String,
}

/// Rope of another material handles otherwise: it counts like half as thick a rope again [1].
const OTHER_MATERIAL: f64 = 0.4;

/// How unlike two ropes are [1].
pub(super) fn distance(one: &Rope, other: &Rope, counts: &Counts) -> f64 {
    let ratio = |a: f64, b: f64| (a / b).ln().abs();
    counts[0] * ratio(one.diameter_m, other.diameter_m)
        + counts[1] * (one.density_kg_m3 - other.density_kg_m3).abs() / DENSITY_KG_M3
        + counts[2] * ratio(one.strength_n, other.strength_n)
        + if one.material == other.material { 0.0 } else { OTHER_MATERIAL }
}

/// Rope of at most a strength, the strongest of those first.
pub(super) fn weak(scene: &Scene<'_>, strength_n: f64) -> Lever {
    let fits = |rope: &Rope| rope.strength_n <= strength_n * (1.0 + 1e-9);
    let strongest = scene.library.ropes.iter().filter(|rope| fits(rope));
    let strongest_n = strongest.map(|rope| rope.strength_n).fold(0.0, f64::max);
    let serves = |rope: &Rope| fits(rope) && rope.strength_n >= 0.9 * strongest_n;
    swapped(scene, &serves, &fits, &UNLIKE_STRENGTH)
}

/// Rope of at most a diameter.
pub(super) fn thin(scene: &Scene<'_>, most_m: f64) -> Lever {
    let fits = |rope: &Rope| rope.diameter_m <= most_m * (1.0 + 1e-9);
    swapped(scene, &fits, &fits, &UNLIKE_DIAMETER)
}

/// Rope of at least a density that sinks.
pub(super) fn sinking(scene: &Scene<'_>, least_kg_m3: f64) -> Lever {
    let least_kg_m3 = least_kg_m3.max(SEA_WATER_KG_M3);
    let fits = |rope: &Rope| rope.density_kg_m3 > least_kg_m3 * (1.0 + 1e-6);
    swapped(scene, &fits, &fits, &UNLIKE_DENSITY)
}

/// Ropes that fail replaced by the most similar that meets the rule: one of them, two together, and so on.
fn swapped(
    scene: &Scene<'_>,
    serves: &dyn Fn(&Rope) -> bool,
    fits: &dyn Fn(&Rope) -> bool,
    counts: &Counts,
) -> Lever {
    let ropes = &scene.library.ropes;
    let swap = |named: Named| {
        let old = ropes.iter().find(|rope| rope.entry.id == named.rope)?;
        // Rope of nets is no rope for lines.
        let is_of_net = |rope: &Rope| rope.entry.id.starts_with("gillnet-");
        let others = ropes.iter().filter(|rope| serves(rope) && !is_of_net(rope));
        let away = |rope: &Rope| distance(old, rope, counts);
        let new = others.min_by(|one, other| away(one).total_cmp(&away(other)))?;
        (!fits(old)).then(|| (named, new.entry.id.clone()))
    };
    let swaps: Vec<(Named, String)> = named(scene).into_iter().filter_map(swap).collect();
    let most = swaps.len().min(MOST_TOGETHER);
    let mut lever: Lever = (1..=most).map(|size| together(&swaps, size)).collect();
    if swaps.len() > MOST_TOGETHER {
        let all: Vec<usize> = (0..swaps.len()).collect();
        lever.push(vec![edit(&swaps, &all)]);
    }
    lever
}

/// Every edit with this number of swaps.
fn together(swaps: &[(Named, String)], size: usize) -> Vec<Candidate> {
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..size {
        let longer = |set: &Vec<usize>| {
            let from = set.last().map_or(0, |last| last + 1);
            let next = (from..swaps.len()).map(|index| [set.clone(), vec![index]].concat());
            next.collect::<Vec<_>>()
        };
        sets = sets.iter().flat_map(longer).collect();
    }
    sets.iter().map(|set| edit(swaps, set)).collect()
}

fn edit(swaps: &[(Named, String)], set: &[usize]) -> Candidate {
    let one = |index: &usize| {
        let (named, new) = &swaps[*index];
        format!("{} of `{new}` instead of `{}`", named.of, named.rope)
    };
    let says: Vec<String> = set.iter().map(one).collect();
    let edit = Candidate::new(format!("Make {}.", says.join(", ")));
    set.iter().fold(edit, |edit, index| {
        let (named, new) = &swaps[*index];
        edit.put(named.field.clone(), new.clone())
    })
}

/// Places of the file that name the ropes of the rule's lines: attributes of a gear type, or the lines themselves.
fn named(scene: &Scene<'_>) -> Vec<Named> {
    if scene.gear_type.is_some() {
        let attributes = scene.items_of("ropes").into_iter().filter(|(_, rope)| !rope.is_empty());
        let named = |(key, rope): (String, String)| Named {
            field: format!("attributes.{key}"),
            of: key.replace('_', " "),
            rope,
        };
        return attributes.map(named).collect();
    }
    let own = |line: String| {
        let field = format!("{}.rope", scene.place_in("line", &line)?);
        let rope = scene.document.get(&field)?;
        Some(Named { field, of: line, rope })
    };
    scene.lines_of_rule().into_iter().filter_map(own).collect()
}

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
