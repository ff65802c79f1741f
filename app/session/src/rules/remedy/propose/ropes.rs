//! Lines given another rope of the library: the one most like it that serves.

use endline_gear::Rope;

use super::super::candidate::Candidate;
use super::Lever;
use super::scene::Scene;

/// Sea water that rope sinks in [kg/m³].
pub(super) const SEA_WATER_KG_M3: f64 = 1025.0;

/// A tenth of this density counts like a tenth of the diameter [kg/m³].
const DENSITY_KG_M3: f64 = 1000.0;

/// Lines or attributes changed together at most.
const MOST_TOGETHER: usize = 4;

/// What counts in how unlike two ropes are: diameter, density, strength.
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
    let fits = |rope: &Rope| density_kg_m3(rope) > least_kg_m3 * (1.0 + 1e-6);
    swapped(scene, &fits, &fits, &UNLIKE_DENSITY)
}

/// Density of the rope as it displaces water [kg/m³].
fn density_kg_m3(rope: &Rope) -> f64 {
    rope.density_kg_m3
}

/// Ropes that do not fit replaced by the most alike that serves: one of them, two together, and so on.
fn swapped(
    scene: &Scene<'_>,
    serves: &dyn Fn(&Rope) -> bool,
    fits: &dyn Fn(&Rope) -> bool,
    counts: &Counts,
) -> Lever {
    let ropes = &scene.library.ropes;
    let swap = |named: Named| {
        let old = ropes.iter().find(|rope| rope.entry.id == named.rope)?;
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

/// Rope of nets is no rope for lines.
fn is_of_net(rope: &Rope) -> bool {
    rope.entry.id.starts_with("gillnet-")
}

/// Every edit that makes so many swaps.
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
