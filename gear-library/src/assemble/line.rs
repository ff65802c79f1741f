//! Adds lines to the spec: their ends, and pieces of rope between ends, inserts and sleeves.
//!
//! A line without inserts is one line of the spec with its own id. Inserts divide it into pieces, counted from its
//! `from` end: `endline-top.1`, `endline-top.insert-1`, `endline-top.2` …, which meet at free joints `endline-top.join-1` ….
//! A sleeve is the weak link `endline-top.sleeve-1` at the `to` end of the piece before it. The id of the line then
//! names all pieces: its `from` end is that of the first, its `to` end that of the last.
//!
//! An end names a joint, a body (`trap-1`, at its default point), a point of a body (`trap-1:bridle-port`) or a spot on
//! the whale's skin (`whale:peduncle`). Lines at one point share a joint.

use endline_sdk::LineEnd;
use endline_sim::DVec3;
use endline_sim::model::{Joint, JointKind, Line, Strength};

use crate::diagnostic::{At, Diagnostic, hint};
use crate::items::USUAL_BULK;
use crate::limits;
use crate::line::{Insert, Inserts, LineMake, WeakPlaces, WeakPositions};
use crate::scenario::LineStart;
use crate::strength::StrengthFigure;

use super::builder::{Builder, Part, Scale, Uncut};
use super::line_shapes::{along, part_of};

/// A line to be added to the spec.
pub(super) struct NewLine<'a> {
    /// Id.
    pub id: At<String>,
    /// Id of its rope.
    pub rope: At<String>,
    /// Joints at its ends; `None` for a missing one, which is reported.
    pub ends: (Option<usize>, Option<usize>),
    /// Unstretched length [m].
    pub length_m: f64,
    /// The shape it starts in.
    pub start: LineStart,
    /// Initial path with its ends; empty for a straight line [m].
    pub laid_m: Vec<DVec3>,
    /// Its make.
    pub make: &'a LineMake,
}

impl Builder<'_> {
    /// Adds a line, which is cut into segments later; returns its first and last piece.
    pub fn add_line(&mut self, line: &NewLine<'_>) -> [usize; 2] {
        if !(line.length_m.is_finite() && line.length_m > 0.0) {
            let message = format!("line `{}` is {} m long", line.id.value, line.length_m);
            self.problems.push(line.id.place.error(message, "write a length above zero"));
        }
        // A missing joint prevents the run; index 0 keeps the other indices valid.
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
        if let Some(weak) = &line.make.weak_places {
            let message = format!("line `{}` has both inserts and weak places", line.id.value);
            let help = "keep one of them: inserts are pieces of another rope or weak links, weak places change nothing but strength";
            self.problems.push(weak.place.error(message, help));
        }
        if matches!(line.start, LineStart::Catenary | LineStart::Wrapped(_)) {
            let message = "a line that starts as a catenary or in wraps cannot have inserts";
            self.problems.push(
                inserts.place.error(message, "remove the inserts, or write start = \"straight\""),
            );
        }
        let starts = insert_starts(inserts, line.length_m).unwrap_or_else(|number| {
            let message = format!("line `{}` has {number:.0} inserts", line.id.value);
            let help =
                format!("at most {} are possible: write a longer `every`", limits::PARTS.most);
            self.problems.push(inserts.place.error(message, help));
            Vec::new()
        });
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

    /// The initial path of a line, from joint to joint.
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
        let weak_places = rope.map_or_else(Vec::new, |rope| self.weak_places(rope, line));
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
            weak_places,
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

/// Minimum length of a piece [m].
const LEAST_PIECE_M: f64 = 0.01;

/// The connection at an end of a rope.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tied {
    /// Strength of the rope there, as a share [1].
    pub strength_left: f64,
    /// Breadth over the rope's diameter; zero for continuous rope [1].
    pub bulk: f64,
    /// The knot's name and the figure of the share; `None` for continuous rope.
    pub source: Option<(String, StrengthFigure)>,
}

impl Tied {
    /// Continuous rope.
    pub const WHOLE: Self = Self { strength_left: 1.0, bulk: 0.0, source: None };
}

/// A piece of a line between ends, inserts and sleeves.
pub(super) struct Piece<'a> {
    /// Id in the spec.
    pub id: String,
    /// Id of its rope.
    pub rope: &'a At<String>,
    /// Unstretched length [m].
    pub length_m: f64,
    /// Connection at each end; `None` for the rope's default.
    pub ends: [Option<Tied>; 2],
    /// Whether it consists of the line's own rope.
    pub own: bool,
    /// Weak link at its `to` end: id and item.
    pub sleeve: Option<(String, &'a At<String>)>,
}

/// Starts of the inserts from end A, in order [m]: all that lie entirely within their share of the line.
/// `Err` is their number if it exceeds the limit of a scenario.
fn insert_starts(inserts: &Inserts, line_m: f64) -> Result<Vec<f64>, f64> {
    let own_m = insert_length(inserts);
    let last_m = (inserts.within * line_m).min(line_m - LEAST_PIECE_M) - own_m + 1e-9;
    let number = ((last_m - inserts.first_m) / inserts.every_m).floor() + 1.0;
    if number > limits::PARTS.most {
        return Err(number);
    }
    let mut starts = Vec::new();
    let mut near_m = inserts.first_m;
    while near_m <= last_m {
        starts.push(near_m);
        near_m += inserts.every_m;
    }
    if inserts.counted_from == LineEnd::B {
        starts.iter_mut().for_each(|near_m| *near_m = line_m - *near_m - own_m);
        starts.reverse();
    }
    Ok(starts)
}

/// Lengths of weak places from end A of a line of this length, in order [m].
/// Errors: none is on the line, one is beyond it, or there are too many.
pub(super) fn weak_lengths(
    weak: &WeakPlaces,
    line: &str,
    line_m: f64,
) -> Result<Vec<f64>, Box<Diagnostic>> {
    match &weak.positions {
        WeakPositions::Spaced { every_m, first_m } => {
            let number = ((line_m - first_m) / every_m).ceil();
            if number > limits::PARTS.most {
                let message = format!("line `{line}` has {number:.0} weak places");
                let help =
                    format!("at most {} are possible: write a longer `every`", limits::PARTS.most);
                return Err(Box::new(weak.place.error(message, help)));
            }
            let lengths = (0..).map(|index| first_m + f64::from(index) * every_m);
            let lengths: Vec<f64> = lengths.take_while(|at_m| *at_m < line_m).collect();
            if lengths.is_empty() {
                let message = format!("no weak place is on the {line_m:.2} m of line `{line}`");
                let help = "write a shorter `first` or `every`";
                return Err(Box::new(weak.place.error(message, help)));
            }
            Ok(lengths)
        }
        WeakPositions::Listed(at) => {
            if let Some(beyond) = at.iter().find(|at| at.value >= line_m) {
                let message = format!(
                    "a weak place at {:.2} m is beyond the {line_m:.2} m of line `{line}`",
                    beyond.value
                );
                let help = "write a length from the `from` end that is less than the line's";
                return Err(Box::new(beyond.place.error(message, help)));
            }
            let mut lengths: Vec<f64> = at.iter().map(|at| at.value).collect();
            lengths.sort_by(f64::total_cmp);
            Ok(lengths)
        }
    }
}

fn insert_length(inserts: &Inserts) -> f64 {
    match &inserts.what {
        Insert::Rope { length_m, .. } => *length_m,
        Insert::Sleeve(_) => 0.0,
    }
}

/// Cuts a line at its inserts: own rope and inserts alternate.
pub(super) fn cut_at<'l>(
    whole: &Piece<'l>,
    inserts: &'l Inserts,
    starts: &[f64],
    at_insert: Option<Tied>,
) -> Vec<Piece<'l>> {
    let id = &whole.id;
    // A sleeve joins the cut ends without loss of strength.
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
                // The rating of an insert includes its ends.
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

/// The name of the whale in an end.
pub(super) const WHALE: &str = "whale";

/// The part named by an end, and the point, if any.
pub(super) fn split(end: &str) -> (&str, Option<&str>) {
    end.rsplit_once(':').map_or((end, None), |(part, point)| (part, Some(point)))
}

impl Builder<'_> {
    /// The joint of a line's end.
    pub fn end(&mut self, end: &At<String>) -> Option<usize> {
        let (part, point) = split(&end.value);
        if part == WHALE && self.part(part).is_none() {
            return self.whale_joint(point, end);
        }
        match (self.part(part), point) {
            (Some(Part::Joint(joint)), None) => Some(joint),
            (Some(Part::Joint(_)), Some(point)) => {
                let message = format!("joint `{part}` has no point `{point}`");
                self.problems.refuse(end.place.error(
                    message,
                    "only a body has points; remove the colon and the text after it",
                ))
            }
            (Some(Part::Body(body)), point) => self.body_joint(body, point, end),
            _ => {
                let wanted = At { value: part.to_owned(), place: end.place.clone() };
                self.unknown("body or joint", &wanted, |part| {
                    matches!(part, Part::Body(_) | Part::Joint(_))
                });
                None
            }
        }
    }

    /// The joint at a point of a body, shared by all lines there.
    fn body_joint(&mut self, body: usize, point: Option<&str>, end: &At<String>) -> Option<usize> {
        let points = &self.points[body];
        let found = match point {
            Some(name) => points.iter().position(|(known, _)| known == name),
            None => Some(0),
        };
        let holder = &self.spec.bodies[body];
        let Some(found) = found else {
            let name = point.unwrap_or_default();
            let known = points.iter().map(|(name, _)| name.as_str());
            let message = format!("body `{}` has no point `{name}`", holder.id);
            return self.problems.refuse(end.place.error(message, hint(name, known)));
        };
        let (name, offset_m) = &points[found];
        let (id, offset_m) = (
            if found == 0 { holder.id.clone() } else { format!("{}:{name}", holder.id) },
            *offset_m,
        );
        let at_point = |joint: &Joint| {
            matches!(joint.kind, JointKind::Body { body: of, .. } if of == body) && joint.id == id
        };
        if let Some(joint) = self.spec.joints.iter().position(at_point) {
            return Some(joint);
        }
        let position_m: DVec3 = holder.position_m + holder.orientation * offset_m;
        self.spec.joints.push(Joint { id, kind: JointKind::Body { body, offset_m }, position_m });
        Some(self.spec.joints.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use crate::fields::{Fields, Problems};
    use crate::line::LineMake;

    use super::*;

    /// Inserts every 60 ft.
    fn sixty_feet(counted_from: &str, first: &str, within: f64) -> Inserts {
        let text = format!(
            "[inserts]\nrope = \"weak\"\nlength = \"3 ft\"\nevery = \"60 ft\"\ncounted_from = \"{counted_from}\"\nfirst = \"{first}\"\nwithin = {within}\n"
        );
        let (node, problems) =
            (crate::tree::read("test.toml", &text).expect("a TOML text"), Problems::default());
        LineMake::read(&Fields::of(&node, &problems)).inserts.expect("inserts")
    }

    #[test]
    fn inserts_lie_entirely_within_their_share_of_the_line() {
        let starts = insert_starts(&sixty_feet("to", "12 ft", 0.75), 60.0).unwrap();
        // Near edges from the buoy: 3.6576, 21.9456, 40.2336; the next would lie beyond 45 m.
        let expected = [60.0 - 40.2336 - 0.9144, 60.0 - 21.9456 - 0.9144, 60.0 - 3.6576 - 0.9144];
        assert_eq!(starts.len(), 3);
        for (start, expected) in starts.iter().zip(expected) {
            assert!((start - expected).abs() < 1e-9, "{starts:?}");
        }
        let first = insert_starts(&sixty_feet("from", "12 ft", 0.75), 60.0).unwrap()[0];
        assert!((first - 3.6576).abs() < 1e-12);
        assert!(insert_starts(&sixty_feet("from", "60 ft", 0.3), 60.0).unwrap().is_empty());
        // 10,001 inserts: 3.6576 m + 10,000 · 18.288 m + 0.9144 m.
        let line_m = 3.6576 + 10_000.0 * 18.288 + 0.9144 + 0.02;
        assert_eq!(insert_starts(&sixty_feet("from", "12 ft", 1.0), line_m), Err(10_001.0));
        assert_eq!(
            insert_starts(&sixty_feet("from", "12 ft", 1.0), line_m - 1.0).unwrap().len(),
            10_000
        );
    }

    /// Lengths of weak places on a line, or the message and its help.
    fn weak(text: &str, line_m: f64) -> Result<Vec<f64>, String> {
        let text = format!("[weak_places]\nstrength = \"1700 lbf\"\n{text}\n");
        let (node, problems) =
            (crate::tree::read("test.toml", &text).expect("a TOML text"), Problems::default());
        let make = LineMake::read(&Fields::of(&node, &problems));
        let weak = make.weak_places.expect("weak places");
        weak_lengths(&weak, "warp", line_m).map_err(|problem| problem.to_string())
    }

    #[test]
    fn weak_places_lie_at_equal_distances_or_as_listed() {
        // 60 ft are 18.288 m; the first lies at half of it.
        let feet = |feet: f64| 0.3048 * feet;
        let cases: [(&str, f64, &[f64]); 5] = [
            ("every = \"60 ft\"", 60.0, &[feet(30.0), feet(90.0), feet(150.0)]),
            ("every = \"60 ft\"\nfirst = \"12 ft\"", 30.0, &[feet(12.0), feet(72.0)]),
            // A place at the end of the line is none.
            ("every = \"10 m\"\nfirst = \"10 m\"", 30.0, &[10.0, 20.0]),
            ("every = \"100 m\"\nfirst = \"7 m\"", 30.0, &[7.0]),
            ("at = [\"25 m\", \"10 m\"]", 30.0, &[10.0, 25.0]),
        ];
        for (text, line_m, expected) in cases {
            let found = weak(text, line_m).unwrap();
            let is_near = |(one, other): (&f64, &f64)| (one - other).abs() < 1e-9;
            assert!(
                found.len() == expected.len() && found.iter().zip(expected).all(is_near),
                "{text}: {found:?}"
            );
        }
        for (text, line_m, part) in [
            ("every = \"60 ft\"", 9.0, "no weak place is on the 9.00 m of line `warp`"),
            ("every = \"1 cm\"", 200.0, "has 20000 weak places"),
            ("at = [\"10 m\", \"30 m\"]", 30.0, "at 30.00 m is beyond the 30.00 m of line `warp`"),
        ] {
            let message = weak(text, line_m).unwrap_err();
            assert!(message.contains(part) && message.contains("write"), "{message}");
        }
    }
}
