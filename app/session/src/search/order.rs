//! How far the order in which a strand passes the whale is from the order that was seen.
//!
//! The distance is the least number of places to put in, leave out or exchange that turns one order into the other
//! (Levenshtein 1966), read from either end of the strand. Places agree where their sites do, and their sides where both have one.
//! Places of sites that were hidden are left out of the strand, and neighbours that the order does not tell apart are one.

use endline_gear::{PathPlace, Site};

/// Edits from a strand's places to the order seen, from whichever end is less.
pub(super) fn edits(seen: &[PathPlace], strand: &[PathPlace], hidden: &[Site]) -> usize {
    let told = told_apart(seen, strand, hidden);
    let turned: Vec<PathPlace> = told.iter().rev().copied().collect();
    levenshtein(seen, &told).min(levenshtein(seen, &turned))
}

/// The strand as coarse as the order seen: no hidden sites, no sides where a site has none in that order.
fn told_apart(seen: &[PathPlace], strand: &[PathPlace], hidden: &[Site]) -> Vec<PathPlace> {
    let is_hidden = |site: Site| hidden.iter().any(|hidden| hidden.singles().contains(&site));
    let has_side = |site: Site| seen.iter().any(|place| place.site == site && place.side.is_some());
    let mut told: Vec<PathPlace> = strand
        .iter()
        .filter(|place| !is_hidden(place.site))
        .map(|place| PathPlace { side: place.side.filter(|_| has_side(place.site)), ..*place })
        .collect();
    told.dedup();
    told
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
    use super::*;

    fn order(text: &str) -> Vec<PathPlace> {
        text.split_whitespace().map(|place| PathPlace::named(place).unwrap()).collect()
    }

    #[test]
    fn edits_by_hand() {
        for (seen, strand, hidden, edits_wanted) in [
            ("mouth:left head mouth:right", "mouth:left head mouth:right", "", 0),
            // Read from the other end.
            ("mouth:left head mouth:right", "mouth:right head mouth:left", "", 0),
            ("mouth:left head mouth:right", "mouth:left mouth:right", "", 1),
            // A side that was not told is any side, and both sides of it are one place.
            ("mouth body", "mouth:left body:left body:right", "", 0),
            ("flipper body", "left_flipper body:right", "", 0),
            ("left_flipper body", "right_flipper body", "", 1),
            ("body", "body right_flipper", "flipper", 0),
            ("body", "", "", 1),
            ("left_fluke peduncle right_fluke", "body head", "", 3),
        ] {
            let hidden: Vec<Site> = hidden.split_whitespace().filter_map(Site::named).collect();
            let found = edits(&order(seen), &order(strand), &hidden);
            assert_eq!(found, edits_wanted, "{seen} | {strand}");
        }
    }
}
