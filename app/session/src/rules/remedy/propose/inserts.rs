//! Weak inserts of rope, and sleeves: put into endlines, moved, or made of another product.

use endline_gear::{Document, Library};

use super::super::super::gear::{Endline, Gear};
use super::super::demand::{Demand, Limit};
use super::super::trials::Candidate;
use super::{Lever, OfEndline, Scene, make_of, metres, written};
use crate::units::METRES_PER_FOOT;

/// Length of an insert of rope: the least that is approved [m], as it is written.
const INSERT: (f64, &str) = (0.9144, "3 ft");

/// From the buoy to the first of inserts at even distances, kept out of the surface system [m], as it is written.
const FIRST: (f64, &str) = (3.6576, "12 ft");

/// Rope of which the usual inserts are.
const USUAL: &str = "weak-1700-3-8";

/// From one of the usual inserts to the next: 60 ft [m].
const USUAL_EVERY_M: f64 = 18.288;

/// Room between an insert and the end of its line [m].
const ROOM_M: f64 = 0.05;

/// Strengths this close to a limit are approved as that limit [1].
const CLOSE: f64 = 0.1;

/// A weak insert or sleeve.
#[derive(Clone, Debug)]
struct Product {
    /// Id of a rope, or of a weak link.
    item: String,
    /// Whether it is a sleeve, which adds no length.
    is_sleeve: bool,
}

impl Product {
    fn length_m(&self) -> f64 {
        if self.is_sleeve { 0.0 } else { INSERT.0 }
    }

    /// In words, one of it or several.
    fn words(&self, count: usize) -> String {
        let s = if count == 1 { "" } else { "s" };
        if self.is_sleeve {
            format!("sleeve{s} `{}`", self.item)
        } else {
            format!("{} insert{s} of `{}`", INSERT.1, self.item)
        }
    }
}

/// A weak place near each share of the endline that the rule asks for.
pub(super) fn at_places(scene: &Scene<'_>) -> Lever {
    let mut shares: Vec<f64> = Vec::new();
    let mut strength = None;
    for demand in &scene.demands {
        if let Demand::WeakAt { share, strength_n } = demand {
            shares.push(*share);
            strength = Some(*strength_n);
        }
    }
    let Some(strength_n) = strength else { return Vec::new() };
    shares.sort_by(f64::total_cmp);
    vec![at_shares(scene, &shares, strength_n)]
}

/// One weak place at the middle of each endline.
pub(super) fn one(scene: &Scene<'_>, strength_n: f64) -> Lever {
    vec![at_shares(scene, &[0.5], strength_n)]
}

fn at_shares(scene: &Scene<'_>, shares: &[f64], strength_n: f64) -> Vec<Candidate> {
    let in_words: Vec<String> =
        shares.iter().map(|share| format!("{} %", written(100.0 * share))).collect();
    let at = |product: &Product| {
        let says = format!("Put {} at {} of", product.words(shares.len()), in_words.join(" and "));
        let place = |whole_m: f64| {
            shares.iter().map(|share| share * whole_m - 0.5 * product.length_m()).collect()
        };
        in_endlines(scene.document, &scene.endlines(), product, &says, &place)
    };
    products(scene, strength_n).iter().filter_map(at).collect()
}

/// Weak places at even distances over the upper part of each endline.
pub(super) fn every(scene: &Scene<'_>, spacing: &Limit, top: f64, strength_n: f64) -> Lever {
    let first_m = if FIRST.0 < spacing.si { FIRST.0 } else { 0.5 * spacing.si };
    let one = |product: &Product| {
        let says = format!(
            "Put {} every {} into the top {} % of",
            product.words(2),
            spacing.text,
            written(100.0 * top)
        );
        let place = |whole_m: f64| evenly(first_m, spacing.si, top * whole_m - product.length_m());
        in_endlines(scene.document, &scene.endlines(), product, &says, &place)
    };
    vec![products(scene, strength_n).iter().filter_map(one).collect()]
}

/// The usual inserts of rope along every endline: every 60 ft over the top three quarters, across all lines that it is made of.
pub(in super::super) fn usual(document: &Document, gear: &Gear) -> Option<Candidate> {
    let product = Product { item: USUAL.to_owned(), is_sleeve: false };
    let says = format!("Put {} every 60 ft into the top 75 % of", product.words(2));
    let place = |whole_m: f64| evenly(FIRST.0, USUAL_EVERY_M, 0.75 * whole_m - product.length_m());
    in_endlines(document, &gear.endlines.iter().collect::<Vec<_>>(), &product, &says, &place)
}

/// Places at even distances, from the first to the last that is allowed [m]; the first always.
fn evenly(first_m: f64, every_m: f64, last_m: f64) -> Vec<f64> {
    let mut places = vec![first_m];
    while places[places.len() - 1] + every_m <= last_m {
        places.push(places[places.len() - 1] + every_m);
    }
    places
}

/// One edit that puts a product into endlines, at places counted from the buoy [m].
fn in_endlines(
    document: &Document,
    endlines: &[&Endline],
    product: &Product,
    says: &str,
    places: &dyn Fn(f64) -> Vec<f64>,
) -> Option<Candidate> {
    let (mut edit, mut places_of) = (Candidate::new(String::new()), Vec::new());
    for endline in endlines {
        let lines = Scene::lines(endline);
        let whole_m: f64 = lines.iter().map(|line| line.length_m).sum();
        let wanted = places(whole_m);
        for line in &lines {
            let own = within(line, &wanted, product.length_m());
            if !own.is_empty() {
                edit = into_line(document, edit, line, product, &own)?;
            }
        }
        let at: Vec<String> = wanted.iter().map(|place_m| written(*place_m)).collect();
        places_of.push(format!("{} ({} m from the buoy)", endline.id, at.join(", ")));
    }
    edit.says = format!("{says} {}.", places_of.join(" and "));
    (!edit.steps.is_empty()).then_some(edit)
}

/// The places that lie in a line, from its end nearer to the buoy [m].
fn within(line: &OfEndline, places_m: &[f64], length_m: f64) -> Vec<f64> {
    let last_m = line.length_m - length_m - ROOM_M;
    let inside = |place: &&f64| (line.start_m..line.start_m + line.length_m).contains(*place);
    let own =
        places_m.iter().filter(inside).map(|place| (place - line.start_m).clamp(ROOM_M, last_m));
    own.filter(|place| *place > 0.0).collect()
}

/// Puts a product into a line at places at even distances; `None` where they are not even.
fn into_line(
    document: &Document,
    edit: Candidate,
    line: &OfEndline,
    product: &Product,
    at_m: &[f64],
) -> Option<Candidate> {
    let first_m = *at_m.first()?;
    let every_m = if at_m.len() > 1 { at_m[1] - first_m } else { line.length_m };
    let is_even = |pair: &[f64]| (pair[1] - pair[0] - every_m).abs() < 1e-6;
    if !at_m.windows(2).all(is_even) || every_m < product.length_m() + ROOM_M {
        return None;
    }
    let make = make_of(document, &line.line)?;
    // A line has either inserts or weak places.
    let edit = edit.remove(format!("{make}.weak_places"));
    let inserts = format!("{make}.inserts");
    let end_m = at_m[at_m.len() - 1] + product.length_m();
    // One more would lie within the line: its share of the line ends behind the last.
    let is_open = end_m + every_m + ROOM_M > line.length_m;
    let share = ((end_m + ROOM_M) / line.length_m * 1e4).ceil() / 1e4;
    let (given, other) = if product.is_sleeve { ("sleeve", "rope") } else { ("rope", "sleeve") };
    let edit = edit.remove(format!("{inserts}.{other}"));
    let edit = edit.put(format!("{inserts}.{given}"), product.item.as_str());
    let edit = if product.is_sleeve {
        edit.remove(format!("{inserts}.length"))
    } else {
        edit.put(format!("{inserts}.length"), INSERT.1)
    };
    let edit = edit.put(format!("{inserts}.first"), length(first_m));
    let edit = edit.put(format!("{inserts}.every"), length(every_m));
    let edit = if is_open {
        edit.remove(format!("{inserts}.within"))
    } else {
        edit.put(format!("{inserts}.within"), format!("{share}"))
    };
    Some(if line.from_to {
        edit.remove(format!("{inserts}.counted_from"))
    } else {
        edit.put(format!("{inserts}.counted_from"), "from")
    })
}

/// A length in feet where it is a whole number of them, as fishers measure, else in metres.
fn length(length_m: f64) -> String {
    let feet = length_m / METRES_PER_FOOT;
    if (feet - feet.round()).abs() < 1e-6 { format!("{feet:.0} ft") } else { metres(length_m) }
}

/// Lines of the rule's endlines that have inserts, with the path of those.
fn with_inserts(scene: &Scene<'_>) -> Vec<(OfEndline, String)> {
    let lines = scene.endlines().into_iter().flat_map(Scene::lines);
    let path = |line: OfEndline| {
        let inserts = format!("{}.inserts", scene.make_of(&line.line)?);
        scene.document.has(&inserts).then_some((line, inserts))
    };
    lines.filter_map(path).collect()
}

/// The first insert at the least distance from the buoy, the others behind it.
pub(super) fn moved_down(scene: &Scene<'_>, clear: &Limit) -> Lever {
    let mut edit =
        Candidate::new(format!("Move the first insert {} down from the buoy.", clear.text));
    for (line, inserts) in with_inserts(scene).into_iter().take(1) {
        let first_m = clear.si - line.start_m;
        let text =
            if line.start_m > 0.0 { metres(first_m.max(ROOM_M)) } else { clear.text.clone() };
        edit = edit.put(format!("{inserts}.first"), text);
    }
    tier(edit)
}

/// Inserts of the least length.
pub(super) fn longer(scene: &Scene<'_>, least: &Limit) -> Lever {
    let mut edit = Candidate::new(format!("Put in inserts of {}.", least.text));
    for (_, inserts) in with_inserts(scene) {
        edit = edit.put(format!("{inserts}.length"), least.text.clone());
    }
    tier(edit)
}

/// Inserts of another product of about the strength that the weakest has.
pub(super) fn of_other_strength(scene: &Scene<'_>) -> Lever {
    let pieces = scene.endlines().into_iter().flat_map(|endline| &endline.pieces);
    let weakest_n = pieces.map(|piece| piece.rated_n).fold(f64::INFINITY, f64::min);
    let near = [1.0, 1.0 + CLOSE, 1.0 + 2.0 * CLOSE];
    let mut products: Vec<Product> =
        near.iter().flat_map(|times| products(scene, times * weakest_n)).collect();
    products.dedup_by(|one, other| one.item == other.item);
    let other = |product: &Product| {
        let (given, gone) = if product.is_sleeve { ("sleeve", "rope") } else { ("rope", "sleeve") };
        let mut edit = Candidate::new(format!("Make the inserts {}.", product.words(2)));
        for (_, inserts) in with_inserts(scene) {
            edit = edit.remove(format!("{inserts}.{gone}"));
            edit = edit.put(format!("{inserts}.{given}"), product.item.as_str());
            edit = match (product.is_sleeve, scene.document.has(&format!("{inserts}.length"))) {
                (true, _) => edit.remove(format!("{inserts}.length")),
                (false, true) => edit,
                (false, false) => edit.put(format!("{inserts}.length"), INSERT.1),
            };
        }
        edit
    };
    let edits = products.iter().map(other).filter(|edit| !edit.steps.is_empty());
    vec![edits.collect()]
}

fn tier(edit: Candidate) -> Lever {
    if edit.steps.is_empty() { Vec::new() } else { vec![vec![edit]] }
}

/// Sleeves and ropes of the library that are weak enough and close to it: the rope nearest to that of the endlines.
fn products(scene: &Scene<'_>, strength_n: f64) -> Vec<Product> {
    let library: &Library = scene.library;
    let fits = |rated_n: f64| {
        rated_n <= strength_n * (1.0 + 1e-9) && rated_n >= strength_n * (1.0 - CLOSE)
    };
    let links = library
        .weak_links
        .iter()
        .filter(|link| fits(link.rating_n) && !link.entry.id.ends_with("release"));
    let sleeves = links.map(|link| Product { item: link.entry.id.clone(), is_sleeve: true });
    let host = scene.endlines().into_iter().flat_map(Scene::lines).next().map(|line| line.rope);
    let host = host.and_then(|id| library.ropes.iter().find(|rope| rope.entry.id == id));
    let ropes = library.ropes.iter().filter(|rope| fits(rope.strength_n));
    let nearest = ropes.min_by(|one, other| {
        let away = |rope| {
            host.map_or(0.0, |host| {
                super::ropes::distance(host, rope, &super::ropes::UNLIKE_STRENGTH)
            })
        };
        away(one).total_cmp(&away(other))
    });
    sleeves
        .chain(nearest.map(|rope| Product { item: rope.entry.id.clone(), is_sleeve: false }))
        .collect()
}
