//! Lines put into the spec: pieces of rope between ends, inserts and sleeves, each with the strength it keeps.
//!
//! A line without inserts is one line of the spec under its own id. With inserts it becomes pieces, counted from its
//! `from` end: `endline-top.1`, `endline-top.insert-1`, `endline-top.2` …, which meet at free joints `endline-top.join-1` …;
//! a sleeve is the weak link `endline-top.sleeve-1` at the `to` end of the piece before it. The line's own id then
//! means all of them: its `from` end is that of the first piece, its `to` end that of the last.

use endline_sdk::LineEnd;
use endline_sim::DVec3;
use endline_sim::model::{Joint, JointKind, Line, Strength};

use crate::diagnostic::At;
use crate::items::USUAL_BULK;
use crate::line::LineMake;
use crate::scenario::LineStart;

use super::builder::{Builder, Part, Scale, Uncut};
use super::inserts::{Piece, Tied, cut_at, starts_from_a};
use super::way::{along, part_of};

/// A line to be put into the spec.
pub(super) struct NewLine<'a> {
    /// Id.
    pub id: At<String>,
    /// Id of its rope.
    pub rope: At<String>,
    /// Joints at its ends; `None` where one is missing, which is reported.
    pub ends: (Option<usize>, Option<usize>),
    /// Unstretched length [m].
    pub length_m: f64,
    /// The shape it starts in.
    pub start: LineStart,
    /// The way it starts along, ends included; empty for a straight line [m].
    pub laid_m: Vec<DVec3>,
    /// How it is made up.
    pub make: &'a LineMake,
}

impl Builder<'_> {
    /// Puts a line into the spec, to be cut into segments later; answers its first and last piece.
    pub fn add_line(&mut self, line: &NewLine<'_>) -> [usize; 2] {
        if !(line.length_m.is_finite() && line.length_m > 0.0) {
            let message = format!("line `{}` is {} m long", line.id.value, line.length_m);
            self.problems.push(line.id.place.error(message, "a line has a length above zero"));
        }
        // Where something is missing the run never starts; index 0 keeps the later parts in step.
        let (mut from, to) = (line.ends.0.unwrap_or(0), line.ends.1.unwrap_or(0));
        let (pieces, way) = (self.pieces(line), self.way(line));
        let scale = self.scale_to_deliver(line, &pieces);
        let first = self.spec.lines.len();
        let (count, mut along_m) = (pieces.len(), 0.0);
        for (index, piece) in pieces.into_iter().enumerate() {
            let begin_m = along_m;
            along_m += piece.length_m;
            let end = if index + 1 == count {
                to
            } else {
                self.add_join(line, index + 1, along(&way, along_m / line.length_m))
            };
            let laid_m = if line.laid_m.is_empty() {
                Vec::new()
            } else {
                part_of(&way, [begin_m, along_m].map(|m| m / line.length_m))
            };
            self.add_piece(line, piece, scale, (from, end), laid_m);
            from = end;
        }
        let last = self.spec.lines.len() - 1;
        if last > first {
            self.name(line.id.value.clone(), Part::Line { first, last }, &line.id.place);
        }
        [first, last]
    }

    /// The pieces of a line from its `from` end.
    fn pieces<'l>(&mut self, line: &'l NewLine<'_>) -> Vec<Piece<'l>> {
        let ends = [&line.make.from_knot, &line.make.to_knot]
            .map(|knot| knot.as_ref().and_then(|knot| self.knot(knot)));
        let whole = Piece {
            id: line.id.value.clone(),
            rope: &line.rope,
            length_m: line.length_m,
            ends,
            own: true,
            sleeve: None,
        };
        let Some(inserts) = &line.make.inserts else { return vec![whole] };
        if matches!(line.start, LineStart::Catenary | LineStart::Wrapped(_)) {
            let message = "a line that starts in its catenary or in wraps takes no inserts";
            self.problems.push(
                inserts.place.error(message, "take the inserts out, or write start = \"straight\""),
            );
        }
        let starts = starts_from_a(inserts, line.length_m);
        if starts.is_empty() {
            let message = format!(
                "no insert fits into the {:.2} m of line `{}`",
                line.length_m, line.id.value
            );
            self.problems.push(
                inserts
                    .place
                    .error(message, "write a shorter `first` or `every`, or a greater `within`"),
            );
        }
        let at_insert = inserts.knot.as_ref().and_then(|knot| self.knot(knot));
        cut_at(&whole, inserts, &starts, at_insert)
    }

    /// The way a line starts along, from joint to joint.
    fn way(&self, line: &NewLine<'_>) -> Vec<DVec3> {
        let place = |end: Option<usize>| end.map_or(DVec3::ZERO, |joint| self.joint_place(joint));
        let ends = [place(line.ends.0), place(line.ends.1)];
        let mut way = line.laid_m.clone();
        match way.as_mut_slice() {
            [first, .., last] => (*first, *last) = (ends[0], ends[1]),
            _ => way = ends.to_vec(),
        }
        way
    }

    /// A free joint between two pieces.
    fn add_join(&mut self, line: &NewLine<'_>, number: usize, position_m: DVec3) -> usize {
        let id = format!("{}.join-{number}", line.id.value);
        self.name(id.clone(), Part::Joint(self.spec.joints.len()), &line.id.place);
        self.spec.joints.push(Joint { id, kind: JointKind::Free, position_m });
        self.spec.joints.len() - 1
    }

    fn add_piece(
        &mut self,
        line: &NewLine<'_>,
        piece: Piece<'_>,
        scale: Option<Scale>,
        (from, to): (usize, usize),
        laid_m: Vec<DVec3>,
    ) {
        let condition = self.condition(line.make);
        let rope = self.rope(piece.rope, &condition, scale.filter(|_| piece.own));
        let strength = rope.map_or_else(Strength::default, |rope| {
            self.piece_strength(rope, &piece, line.make, scale)
        });
        let index = self.spec.lines.len();
        self.name(piece.id.clone(), Part::Line { first: index, last: index }, &line.id.place);
        let (id, length_m) = (piece.id, piece.length_m);
        let radius_m = rope.map_or(0.0, |rope| 0.5 * self.stock[rope].diameter_m);
        let bulk = |tied: &Option<Tied>| tied.as_ref().map_or(USUAL_BULK, |tied| tied.bulk);
        let knots_m = [0, 1].map(|end| radius_m * bulk(&piece.ends[end]));
        let rope = rope.unwrap_or(0);
        self.spec.lines.push(Line {
            id,
            rope,
            from,
            to,
            segments_m: Vec::new(),
            strength,
            knots_m,
            start_m: Vec::new(),
        });
        self.uncut.push(Uncut {
            length_m,
            start: line.start.clone(),
            laid_m,
            place: line.id.place.clone(),
        });
        if let Some((id, item)) = piece.sleeve {
            let rating = self.rating(item, &id);
            self.add_link_to(
                &At { value: id, place: item.place.clone() },
                rating,
                index,
                LineEnd::B,
            );
        }
    }
}
