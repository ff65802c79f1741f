//! Weak inserts and sleeves: where they lie along a line, and the pieces they cut it into.

use endline_sdk::LineEnd;

use crate::diagnostic::At;
use crate::limits;
use crate::line::{Insert, Inserts};
use crate::strength::StrengthFigure;

/// Least length of a piece [m].
const LEAST_PIECE_M: f64 = 0.01;

/// What holds an end of a rope.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tied {
    /// Share of the rope's strength left there [1].
    pub strength_left: f64,
    /// Its breadth over the rope's diameter; zero where there is none [1].
    pub bulk: f64,
    /// The knot's name, and the figure behind the share; `None` where rope goes on whole.
    pub source: Option<(String, StrengthFigure)>,
}

impl Tied {
    /// Rope that goes on whole.
    pub const WHOLE: Self = Self { strength_left: 1.0, bulk: 0.0, source: None };
}

/// A stretch of a line between ends, inserts and sleeves.
pub(super) struct Piece<'a> {
    /// Id in the spec.
    pub id: String,
    /// Id of its rope.
    pub rope: &'a At<String>,
    /// Unstretched length [m].
    pub length_m: f64,
    /// What holds each end; `None` where it is usual for the rope.
    pub ends: [Option<Tied>; 2],
    /// Whether it is of the line's own rope.
    pub own: bool,
    /// Weak link at its `to` end: id and item.
    pub sleeve: Option<(String, &'a At<String>)>,
}

/// Where inserts begin, from end A, in order [m].
pub(super) fn starts_from_a(inserts: &Inserts, line_m: f64) -> Vec<f64> {
    let own_m = insert_length(inserts);
    let last_m = (inserts.within * line_m).min(line_m - LEAST_PIECE_M) - own_m + 1e-9;
    let mut starts = Vec::new();
    let mut near_m = inserts.first_m;
    while near_m <= last_m && starts.len() < limits::PARTS.most as usize {
        starts.push(near_m);
        near_m += inserts.every_m;
    }
    if inserts.counted_from == LineEnd::B {
        starts.iter_mut().for_each(|near_m| *near_m = line_m - *near_m - own_m);
        starts.reverse();
    }
    starts
}

fn insert_length(inserts: &Inserts) -> f64 {
    match &inserts.what {
        Insert::Rope { length_m, .. } => *length_m,
        Insert::Sleeve(_) => 0.0,
    }
}

/// A whole line cut at its inserts: own rope and inserts by turns.
pub(super) fn cut_at<'l>(
    whole: &Piece<'l>,
    inserts: &'l Inserts,
    starts: &[f64],
    at_insert: Option<Tied>,
) -> Vec<Piece<'l>> {
    let id = &whole.id;
    // A sleeve is slid over the cut ends: it takes no strength from them.
    let at_insert = if matches!(inserts.what, Insert::Sleeve(_)) {
        at_insert.or(Some(Tied::WHOLE))
    } else {
        at_insert
    };
    let own = |number: usize, length_m: f64, ends: [Option<Tied>; 2]| Piece {
        id: format!("{id}.{number}"),
        rope: whole.rope,
        length_m,
        ends,
        own: true,
        sleeve: None,
    };
    let (mut pieces, mut done_m, mut left) = (Vec::new(), 0.0, whole.ends[0].clone());
    for (number, start_m) in (1..).zip(starts) {
        let mut piece = own(number, start_m - done_m, [left, at_insert.clone()]);
        done_m = start_m + insert_length(inserts);
        left = at_insert.clone();
        match &inserts.what {
            Insert::Sleeve(item) => {
                piece.sleeve = Some((format!("{id}.sleeve-{number}"), item));
                pieces.push(piece);
            }
            Insert::Rope { rope, length_m } => {
                pieces.push(piece);
                let id = format!("{id}.insert-{number}");
                // An insert is rated as made up: its own ends take nothing off.
                pieces.push(Piece {
                    id,
                    rope,
                    length_m: *length_m,
                    ends: [const { Some(Tied::WHOLE) }; 2],
                    own: false,
                    sleeve: None,
                });
            }
        }
    }
    pieces.push(own(starts.len() + 1, whole.length_m - done_m, [left, whole.ends[1].clone()]));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::{Fields, Problems};
    use crate::line::LineMake;

    /// Inserts every 60 ft, as a file has them.
    fn sixty_feet(counted_from: &str, first: &str, within: f64) -> Inserts {
        let text = format!(
            "[inserts]\nrope = \"weak\"\nlength = \"3 ft\"\nevery = \"60 ft\"\ncounted_from = \"{counted_from}\"\nfirst = \"{first}\"\nwithin = {within}\n"
        );
        let (node, problems) =
            (crate::tree::read("test.toml", &text).expect("a TOML text"), Problems::default());
        LineMake::read(&Fields::of(&node, &problems)).inserts.expect("inserts")
    }

    #[test]
    fn inserts_lie_whole_within_their_share_from_the_end_they_are_counted_from() {
        let starts = starts_from_a(&sixty_feet("to", "12 ft", 0.75), 60.0);
        // Near edges from the buoy: 3.6576, 21.9456, 40.2336; the next would lie beyond 45 m.
        let expected = [60.0 - 40.2336 - 0.9144, 60.0 - 21.9456 - 0.9144, 60.0 - 3.6576 - 0.9144];
        assert_eq!(starts.len(), 3);
        for (start, expected) in starts.iter().zip(expected) {
            assert!((start - expected).abs() < 1e-9, "{starts:?}");
        }
        assert!(
            (starts_from_a(&sixty_feet("from", "12 ft", 0.75), 60.0)[0] - 3.6576).abs() < 1e-12
        );
        assert!(starts_from_a(&sixty_feet("from", "60 ft", 0.3), 60.0).is_empty());
    }
}
