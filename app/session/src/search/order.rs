//! How far the order in which a strand passes the whale is from the order that was seen.
//!
//! The distance is the least number of places to put in, leave out or exchange that turns one order into the other
//! (Levenshtein 1966), read from either end of the strand. Places agree where their sites do, and their sides where both have one.
//! Of the strand only places of sites that the order names count: rope elsewhere has terms of its own. Neighbours that the order does
//! not tell apart are one, and so is a place near the midplane beside one on a side.

use endline_gear::{PathPlace, Site};

/// Edits from a strand's places to the order seen, from whichever end is less.
pub(super) fn edits(seen: &[PathPlace], strand: &[PathPlace]) -> usize {
    let told = told_apart(seen, strand);
    let turned: Vec<PathPlace> = told.iter().rev().copied().collect();
    levenshtein(seen, &told).min(levenshtein(seen, &turned))
}

/// The strand as coarse as the order seen.
fn told_apart(seen: &[PathPlace], strand: &[PathPlace]) -> Vec<PathPlace> {
    let is_named = |site: Site| seen.iter().any(|place| place.site.singles().contains(&site));
    let has_side = |site: Site| seen.iter().any(|place| place.site == site && place.side.is_some());
    let mut told: Vec<PathPlace> = strand
        .iter()
        .filter(|place| is_named(place.site))
        .map(|place| PathPlace { side: place.side.filter(|_| has_side(place.site)), ..*place })
        .collect();
    told.dedup();
    let is_between = |index: usize| {
        let place = told[index];
        let beside = [index.checked_sub(1), Some(index + 1)].into_iter().flatten();
        let mut beside = beside.filter_map(|index| told.get(index));
        place.side.is_none() && beside.any(|other| other.site == place.site)
    };
    let kept: Vec<usize> = (0..told.len()).filter(|index| !is_between(*index)).collect();
    let mut told: Vec<PathPlace> = kept.into_iter().map(|index| told[index]).collect();
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
        for (seen, strand, edits_wanted) in [
            ("mouth:left head mouth:right", "mouth:left head mouth:right", 0),
            // Read from the other end.
            ("mouth:left head mouth:right", "mouth:right head mouth:left", 0),
            ("mouth:left head mouth:right", "mouth:left mouth:right", 1),
            // A side that was not told is any side, and both sides of it are one place.
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
            assert_eq!(edits(&order(seen), &order(strand)), edits_wanted, "{seen} | {strand}");
        }
    }
}
