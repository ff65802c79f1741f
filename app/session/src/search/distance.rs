//! The distance of an ending from an observation: a sum of terms, each with its reason.
//!
//! ```text
//! D = sum of 3 |2p - 1|   over sites seen with rope (p > 1/2) and without it now, or the reverse
//!   + sum of e / 0.5      e: wraps, and turns of twist, beyond the range seen [turns]
//!   + sum of |c|          c: strands that lie across a site without a turn, beyond the range seen
//!   + sum of 0.5          over sites tight instead of slack, or the reverse
//!   + 1.5 n               n: edits from the nearest strand's order of places to that seen
//!   + |ln(L / L')| / 0.4  L': the nearer end of the range of rope seen behind the whale [m]
//!   + 1                   for each end of rope seen that no strand has
//! ```
//!
//! The edits of an order are the least number of places to insert, delete or exchange that turn one order into the other (Levenshtein
//! 1966), read from either end of the strand. Places agree if their sites do, and their sides if both have one. Only places at sites
//! that the order names count, since rope elsewhere has its own terms. Neighbouring places that the order does not distinguish
//! are one, and so is a place near the midplane beside one on a side.
//!
//! `p` is how sure it is that rope was there. Hidden sites cost nothing. An unreported site counts as free with `p` = 0.35, unless
//! rope seen at its neighbour passes it. `D` up to 1 is *like* the observation. The weights are choices,
//! not measurements: 1 is a wrap off by half a turn, or less than one edit.

use endline_gear::{Observation, PathPlace, SeenSite, Site};

use super::ending::{AtSite, Ending};

/// An ending up to this far from an observation is like it.
pub const LIKE: f64 = 1.0;

/// Cost of a false positive or false negative at a site observed with certainty.
const PRESENCE: f64 = 3.0;

/// Probability of rope at an unreported site.
const UNREPORTED: f64 = 0.35;

/// Turns beyond the range seen that cost 1.
const TURNS: f64 = 0.5;

/// Cost of a strand too many or too few that lies across a site.
const ACROSS: f64 = 1.0;

/// Cost of tight rope at a site with slack rope, or the reverse.
const TIGHTNESS: f64 = 0.5;

/// Cost of an edit of the order of places.
const EDIT: f64 = 1.5;

/// Difference of the logarithms of lengths that costs 1.
const LENGTHS: f64 = 0.4;

/// Shortest rope behind a whale that an observer would report [m].
const LEAST_M: f64 = 0.5;

/// The distance of an ending from an observation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distance {
    /// Its terms; those of zero are omitted.
    pub terms: Vec<Term>,
    /// Whether it is that of the ending's mirror image.
    pub mirrored: bool,
}

/// A term of a distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Its share of the distance.
    pub cost: f64,
    /// Its reason.
    pub says: String,
}

impl Distance {
    /// From an observation to an ending, or to its mirror image where that counts as well and is nearer.
    pub fn of(observation: &Observation, ending: &Ending) -> Self {
        let straight = Self { terms: terms(observation, ending), mirrored: false };
        if !observation.mirrored {
            return straight;
        }
        let mirrored = Self { terms: terms(observation, &ending.mirrored()), mirrored: true };
        if mirrored.sum() < straight.sum() { mirrored } else { straight }
    }

    /// The sum of its terms.
    pub fn sum(&self) -> f64 {
        self.terms.iter().fold(0.0, |sum, term| sum + term.cost)
    }
}

fn terms(seen: &Observation, ending: &Ending) -> Vec<Term> {
    let mut terms = Vec::new();
    for site in &seen.sites {
        reported_site(site, ending.at(site.site), &mut terms);
    }
    unreported_sites(seen, ending, &mut terms);
    twist(seen, ending, &mut terms);
    order(seen, ending, &mut terms);
    behind(seen, ending, &mut terms);
    terms.retain(|term| term.cost > 0.0);
    terms
}

/// Presence, wraps and tightness at a reported site.
fn reported_site(seen: &SeenSite, at: Option<AtSite>, terms: &mut Vec<Term>) {
    let name = words(seen.site);
    let cost = PRESENCE * (2.0 * seen.present - 1.0).abs();
    match (seen.present > 0.5, at) {
        (true, None) => terms.push(Term { cost, says: format!("no rope at {name}") }),
        (false, Some(_)) => terms.push(Term { cost, says: format!("rope at {name}") }),
        _ => {}
    }
    if let Some(range) = seen.wraps {
        let wraps = at.map_or(0.0, |at| at.wraps);
        let says = format!("{wraps:.2} wraps about {name}, seen {} to {}", range[0], range[1]);
        terms.push(Term { cost: beyond(wraps, range) / TURNS, says });
    }
    if let Some(range) = seen.across {
        #[expect(clippy::cast_precision_loss, reason = "a count of strands")]
        let across = at.map_or(0.0, |at| at.across as f64);
        let strands = if at.is_some_and(|at| at.across == 1) { "strand" } else { "strands" };
        let says = format!("{across} {strands} across {name}, seen {} to {}", range[0], range[1]);
        terms.push(Term { cost: ACROSS * beyond(across, range), says });
    }
    if let (Some(tight), Some(at)) = (seen.tight, at)
        && tight != at.tight
    {
        let now = if at.tight { "tight" } else { "slack" };
        terms.push(Term { cost: TIGHTNESS, says: format!("rope at {name} is {now}") });
    }
}

/// Rope at unreported sites that are not beside a site with rope.
fn unreported_sites(seen: &Observation, ending: &Ending, terms: &mut Vec<Term>) {
    let is_reported =
        |site: Site| seen.sites.iter().any(|seen| seen.site.singles().contains(&site));
    let hidden = |site: Site| seen.hidden.iter().any(|hidden| hidden.singles().contains(&site));
    let with_rope = |site: Site| {
        let here = |seen: &&SeenSite| seen.present > 0.5 && seen.site.singles().contains(&site);
        seen.sites.iter().any(|seen| here(&seen))
    };
    for at in &ending.sites {
        let passes = neighbours(at.site).iter().any(|site| with_rope(*site));
        if is_reported(at.site) || hidden(at.site) || passes {
            continue;
        }
        let cost = PRESENCE * (2.0 * UNREPORTED - 1.0).abs();
        terms.push(Term {
            cost,
            says: format!("rope at {}, which was not reported", words(at.site)),
        });
    }
}

/// Sites whose rope passes a site as well.
fn neighbours(site: Site) -> &'static [Site] {
    match site {
        Site::Head => &[Site::Mouth],
        Site::Body => &[Site::Head, Site::LeftFlipper, Site::RightFlipper, Site::Peduncle],
        Site::Peduncle => &[Site::LeftFluke, Site::RightFluke],
        Site::LeftFluke | Site::RightFluke => &[Site::Peduncle],
        _ => &[],
    }
}

fn twist(seen: &Observation, ending: &Ending, terms: &mut Vec<Term>) {
    let Some(range) = seen.twist else { return };
    let says = format!("{:.2} twists, seen {} to {}", ending.twist, range[0], range[1]);
    terms.push(Term { cost: beyond(ending.twist, range) / TURNS, says });
}

fn order(seen: &Observation, ending: &Ending, terms: &mut Vec<Term>) {
    if seen.path.is_empty() {
        return;
    }
    let strands = ending.strands.iter().map(|strand| edits(&seen.path, &strand.places));
    let least = strands.min().unwrap_or(seen.path.len());
    let count = if least == 1 { "one place".to_owned() } else { format!("{least} places") };
    let says = format!("{count} of the rope's path off");
    #[expect(clippy::cast_precision_loss, reason = "a path has few places")]
    terms.push(Term { cost: EDIT * least as f64, says });
}

/// Rope behind the whale, and what is at its ends.
fn behind(seen: &Observation, ending: &Ending, terms: &mut Vec<Term>) {
    let Some(trailing) = &seen.trailing else { return };
    if let Some([least, most]) = trailing.length_m {
        let now = ending.behind_m.max(LEAST_M);
        let nearer = now.clamp(least.max(LEAST_M), most.max(LEAST_M));
        let says =
            format!("{:.1} m behind the whale, seen {least:.1} to {most:.1} m", ending.behind_m);
        terms.push(Term { cost: libm::log(now / nearer).abs() / LENGTHS, says });
    }
    let mut left: Vec<_> = ending.strands.iter().flat_map(|strand| strand.ends).flatten().collect();
    for end in &trailing.ends {
        match left.iter().position(|other| other == end) {
            Some(place) => drop(left.swap_remove(place)),
            None => {
                terms.push(Term { cost: 1.0, says: format!("no rope that ends {}", end.words()) });
            }
        }
    }
}

/// By how much a value lies outside a range.
fn beyond(value: f64, [least, most]: [f64; 2]) -> f64 {
    (least - value).max(value - most).max(0.0)
}

/// A site in words.
fn words(site: Site) -> String {
    format!("the {}", site.name().replace('_', " "))
}

/// Edits from a strand's places to the order seen, from the end that needs fewer.
fn edits(seen: &[PathPlace], strand: &[PathPlace]) -> usize {
    let coarse = as_coarse_as(seen, strand);
    let turned: Vec<PathPlace> = coarse.iter().rev().copied().collect();
    levenshtein(seen, &coarse).min(levenshtein(seen, &turned))
}

/// The places of a strand that the order seen distinguishes.
fn as_coarse_as(seen: &[PathPlace], strand: &[PathPlace]) -> Vec<PathPlace> {
    let is_named = |site: Site| seen.iter().any(|place| place.site.singles().contains(&site));
    let has_side = |site: Site| seen.iter().any(|place| place.site == site && place.side.is_some());
    let mut coarse: Vec<PathPlace> = strand
        .iter()
        .filter(|place| is_named(place.site))
        .map(|place| PathPlace { side: place.side.filter(|_| has_side(place.site)), ..*place })
        .collect();
    coarse.dedup();
    let is_between = |index: usize| {
        let place = coarse[index];
        let beside = [index.checked_sub(1), Some(index + 1)].into_iter().flatten();
        let mut beside = beside.filter_map(|index| coarse.get(index));
        place.side.is_none() && beside.any(|other| other.site == place.site)
    };
    let places: Vec<usize> = (0..coarse.len()).filter(|index| !is_between(*index)).collect();
    let mut coarse: Vec<PathPlace> = places.into_iter().map(|index| coarse[index]).collect();
    coarse.dedup();
    coarse
}

fn agree(seen: PathPlace, place: PathPlace) -> bool {
    let sides = seen.side.is_none() || place.side.is_none() || seen.side == place.side;
    seen.site.singles().contains(&place.site) && sides
}

fn levenshtein(seen: &[PathPlace], places: &[PathPlace]) -> usize {
    let mut row: Vec<usize> = (0..=places.len()).collect();
    for (index, wanted) in seen.iter().enumerate() {
        let mut corner = std::mem::replace(&mut row[0], index + 1);
        for (column, place) in places.iter().enumerate() {
            let exchanged = corner + usize::from(!agree(*wanted, *place));
            corner = row[column + 1];
            row[column + 1] = exchanged.min(corner + 1).min(row[column] + 1);
        }
    }
    row[places.len()]
}

#[cfg(test)]
mod tests {
    use endline_gear::{PathPlace, RopeEnd};

    use super::super::ending::Strand;
    use super::*;

    const SEEN: &str = r#"
format = 1
kind = "observation"
name = "Seen"
source = "a test"
confidence = "measured"
mirrored = true
[[site]]
part = "left_flipper"
present = 0.9
wraps = [1, 2]
tight = true
[[site]]
part = "mouth"
present = 0.1
[path]
order = ["left_flipper", "body:left"]
[trailing]
length = ["20 m", "40 m"]
ends = ["buoy", "broken"]
[twist]
turns = [1, 2]
[hidden]
parts = ["fluke"]
"#;

    fn seen() -> Observation {
        Observation::read("seen.toml", SEEN).unwrap_or_else(|problems| panic!("{problems:?}"))
    }

    fn at(name: &str, wraps: f64, tight: bool) -> AtSite {
        AtSite { site: Site::named(name).unwrap(), wraps, tight, across: 0 }
    }

    fn ending(sites: Vec<AtSite>, places: &str, ends: [Option<RopeEnd>; 2]) -> Ending {
        let places = places.split_whitespace().map(|place| PathPlace::named(place).unwrap());
        let strand = Strand { places: places.collect(), ends };
        Ending { sites, strands: vec![strand], behind_m: 30.0, twist: 1.5 }
    }

    fn like() -> Ending {
        ending(
            vec![at("body", 0.1, false), at("left_flipper", 1.2, true)],
            "left_flipper body:left",
            [Some(RopeEnd::Broken), Some(RopeEnd::Buoy)],
        )
    }

    /// Every term by hand, one change at a time.
    #[test]
    fn terms_are_those_of_the_formula() {
        let changed = |change: &dyn Fn(&mut Ending)| {
            let mut ending = like();
            change(&mut ending);
            Distance { terms: terms(&seen(), &ending), mirrored: false }.sum()
        };
        let close =
            |got: f64, wanted: f64| assert!((got - wanted).abs() < 1e-12, "{got}, {wanted}");
        close(changed(&|_| {}), 0.0);
        // No rope at the flipper: 3 x 0.8 for presence, 1 turn short at 0.5 each. Rope on the body may be on its way there.
        close(
            changed(&|ending| {
                ending.sites.pop();
            }),
            2.4 + 2.0,
        );
        close(changed(&|ending| ending.sites[1].wraps = 2.3), 0.6);
        close(changed(&|ending| ending.sites[1].tight = false), 0.5);
        close(changed(&|ending| ending.sites.push(at("mouth", 0.0, false))), 2.4);
        close(changed(&|ending| ending.sites.push(at("peduncle", 0.0, false))), 0.9);
        close(changed(&|ending| ending.sites.push(at("left_fluke", 1.0, true))), 0.0);
        close(
            changed(&|ending| {
                ending.strands[0].places.pop();
            }),
            1.5,
        );
        close(changed(&|ending| ending.behind_m = 10.0), 2.0_f64.ln() / 0.4);
        close(changed(&|ending| ending.behind_m = 80.0), 2.0_f64.ln() / 0.4);
        close(changed(&|ending| ending.strands[0].ends[0] = Some(RopeEnd::Trap)), 1.0);
        close(changed(&|ending| ending.twist = 0.5), 1.0);
        // A released whale: flipper, wraps, path of two places, length from 0.5 m, two ends, twist.
        let free = 2.4 + 2.0 + 3.0 + 40.0_f64.ln() / 0.4 + 2.0 + 2.0;
        close(Distance { terms: terms(&seen(), &Ending::default()), mirrored: false }.sum(), free);
    }

    #[test]
    fn strands_across_a_part_cost_one_each_beyond_the_range_seen() {
        let text = SEEN.replace("tight = true", "tight = true\nacross = [1, 2]");
        let seen = Observation::read("seen.toml", &text).unwrap();
        let cost = |across: usize| {
            let mut ending = like();
            ending.sites[1].across = across;
            let mirrored = Distance::of(&seen, &ending.mirrored());
            let sum = Distance::of(&seen, &ending).sum();
            assert!((mirrored.sum() - sum).abs() < 1e-12, "{mirrored:?}");
            sum
        };
        for (across, wanted) in [(0, 1.0), (1, 0.0), (2, 0.0), (4, 2.0)] {
            assert!((cost(across) - wanted).abs() < 1e-12, "{across}: {}", cost(across));
        }
        let mut bare = like();
        bare.sites.pop();
        let says: Vec<String> =
            Distance::of(&seen, &bare).terms.into_iter().map(|term| term.says).collect();
        assert!(
            says.contains(&"0 strands across the left flipper, seen 1 to 2".to_owned()),
            "{says:?}"
        );
        let pair = Ending {
            sites: vec![
                AtSite { across: 3, ..at("right_flipper", 0.0, false) },
                AtSite { across: 1, ..at("left_flipper", 0.0, false) },
            ],
            ..Ending::default()
        };
        assert_eq!(pair.at(Site::Flipper).unwrap().across, 3);
    }

    #[test]
    fn a_mirror_image_counts_where_the_observation_says_so() {
        let mirrored = Distance::of(&seen(), &like().mirrored());
        assert!(mirrored.mirrored && mirrored.terms.is_empty(), "{mirrored:?}");
        assert_eq!(like().mirrored().mirrored(), like());
        let only = Observation { mirrored: false, ..seen() };
        let found = Distance::of(&only, &like().mirrored());
        // Flipper, wraps, tightness needs rope; two places of the path.
        assert!(!found.mirrored && found.sum() > 2.4 + 2.0, "{found:?}");
    }

    fn places(text: &str) -> Vec<PathPlace> {
        text.split_whitespace().map(|place| PathPlace::named(place).unwrap()).collect()
    }

    #[test]
    fn edits_by_hand() {
        for (seen, strand, edits_wanted) in [
            ("mouth:left head mouth:right", "mouth:left head mouth:right", 0),
            // Read from the other end.
            ("mouth:left head mouth:right", "mouth:right head mouth:left", 0),
            ("mouth:left head mouth:right", "mouth:left mouth:right", 1),
            // An unreported side is any side, and both sides of it are one place.
            ("mouth body", "mouth:left body:left body:right", 0),
            ("flipper body", "left_flipper body:right", 0),
            ("left_flipper body", "right_flipper body", 1),
            // Sites that are not named do not count, nor the midplane between two sides.
            ("mouth:left mouth:right", "head:left mouth:left mouth mouth:right head body:right", 0),
            ("body", "body right_flipper", 0),
            ("body:left", "peduncle body", 0),
            ("body", "", 1),
            ("left_fluke peduncle right_fluke", "body head", 3),
        ] {
            assert_eq!(edits(&places(seen), &places(strand)), edits_wanted, "{seen} | {strand}");
        }
    }
}
