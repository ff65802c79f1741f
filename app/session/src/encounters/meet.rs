//! The start from which a whale meets a line at a depth with a part of its body.
//!
//! A whale that keeps its heading and its speed `v` through the water moves over the ground with `u = v f + c`, where `f` is the unit vector
//! ahead and `c` the current at the place of contact. Gear at rest stays where it is. A point `p` of the skin, counted from mid-body, is at the place
//! `a` of the line after the time `t` if mid-body starts at `a - p - u t`.
//!
//! Which part meets rope first follows from the picture seen along `u`: skin and rope that lie over each other there meet, and the pair with
//! the greatest lead along `u` meets first. Of the vertices of the wanted part, the one is used with which that part has the greatest lead
//! over the others. The body keeps its posture at the start; its beat moves the place of contact by decimetres.

use std::collections::BTreeMap;

use endline_gear::hint;
use endline_sdk::BodyPart;
use endline_sim::frame::WhaleFrame;
use endline_sim::model::Whale;
use endline_sim::whale::{pose, skin_all};
use endline_sim::{DVec3, Frame, Model};
use serde_json::{Value, json};

use super::aim::lines_named;
use crate::error::Error;

/// Width of the cells in which rope and skin seen along the path are compared [m].
const CELL_M: f64 = 0.1;

/// Lead over other parts beyond which more is no better [m].
const ENOUGH_M: f64 = 0.5;

/// Vertices of the wanted part that are tried at most.
const TRIED: usize = 200;

/// Usual distance over the ground before the foremost skin reaches the line [m].
pub const USUAL_GAP_M: f64 = 3.0;

/// The place that a whale is to meet, and the part of its body.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Id of the line; a line made of pieces is all its pieces.
    pub line: String,
    /// Depth of the place on the line [m].
    pub depth_m: f64,
    /// Part of the body.
    pub part: BodyPart,
    /// Distance over the ground before the foremost skin reaches the line [m].
    pub gap_m: f64,
}

/// A start, and the contact that follows from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Start of mid-body: east, north, up [m].
    pub start_m: DVec3,
    /// Place of the line that is met [m].
    pub place_m: DVec3,
    /// Time of the contact [s].
    pub after_s: f64,
}

impl Met {
    /// The fields of a scenario that make the whale start here, to millimetres.
    pub fn fields(&self) -> [(String, Value); 2] {
        let text = |length_m: f64| format!("{:.3} m", length_m + 0.0);
        let position = [self.start_m.x, self.start_m.y].map(text);
        [
            ("whale.position".to_owned(), json!(position)),
            ("whale.depth".to_owned(), json!(text(-self.start_m.z))),
        ]
    }
}

/// The straight path of a whale over the ground, and where it passes gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Velocity over the ground [m/s].
    pub velocity_m_s: DVec3,
    /// The nearest rope on the path; `None` if there is none ahead.
    pub nearest: Option<Nearest>,
}

/// The place of rope that mid-body passes at the least distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// Index of its line.
    pub line: usize,
    /// Its place [m].
    pub place_m: DVec3,
    /// Distance of mid-body from it [m].
    pub distance_m: f64,
    /// Time until then [s].
    pub after_s: f64,
}

/// The path of a whale that starts at a place with a heading [rad], and the rope of a moment on it; `None` without a whale.
pub fn path(model: &Model, rest: &Frame, place_m: DVec3, heading: f64) -> Option<Path> {
    let whale = model.spec.whale.as_ref()?;
    let ahead = whale.orientation * DVec3::X;
    let level = ahead.truncate().length();
    let ahead = DVec3::new(level * libm::sin(heading), level * libm::cos(heading), ahead.z);
    let velocity_m_s = ahead * whale.speed_m_s + model.sea.current(place_m, 0.0);
    let squared = velocity_m_s.length_squared();
    let mut nearest: Option<Nearest> = None;
    for (line, nodes) in model.line_nodes.iter().enumerate() {
        for node in &rest.nodes[nodes.clone()] {
            let after_s = (*node - place_m).dot(velocity_m_s) / squared;
            let distance_m = (place_m + velocity_m_s * after_s).distance(*node);
            if after_s > 0.0 && nearest.as_ref().is_none_or(|least| distance_m < least.distance_m) {
                nearest = Some(Nearest { line, place_m: *node, distance_m, after_s });
            }
        }
    }
    Some(Path { velocity_m_s, nearest })
}

/// The start from which the whale of a model meets a line; `rest` is the gear at rest with the whale in its first posture.
/// Errors: no whale, no such line, a whale at rest over the ground, a part that another part precedes, or a start above the sea or in
/// the seabed.
pub fn meet(model: &Model, rest: &Frame, meeting: &Meeting) -> Result<Met, Error> {
    let wrong = |message: &str| Err(Error::Message(message.to_owned()));
    let (Some(whale), Some(posed)) = (&model.spec.whale, &rest.whale) else {
        return wrong("the scenario has no whale; add one");
    };
    let lines = lines_named(model, &meeting.line);
    if lines.is_empty() {
        let known = model.spec.lines.iter().map(|line| line.id.as_str());
        let hint = hint(&meeting.line, known);
        return wrong(&format!("the gear has no line `{}`; {hint}", meeting.line));
    }
    let place_m = place_on(model, rest, &lines, meeting.depth_m)?;
    let body = Body::of(whale, posed);
    let water = model.sea.current(place_m, 0.0);
    let velocity_m_s = posed.orientation * DVec3::X * whale.speed_m_s + water;
    if velocity_m_s.length() < 0.05 {
        return wrong(
            "the whale is at rest over the ground; increase `speed`, or turn it with the current",
        );
    }
    let seen = Seen::along(velocity_m_s.normalize(), model, rest, place_m);
    let point = body.first_to_meet(&seen, meeting.part)?;
    let front_m = body.places.iter().map(|skin| skin.dot(seen.ahead)).fold(f64::MIN, f64::max);
    let way_m = meeting.gap_m + front_m - point.dot(seen.ahead);
    let start_m = place_m - point - seen.ahead * way_m;
    body.check_depth(model, start_m)?;
    Ok(Met { start_m, place_m, after_s: way_m / velocity_m_s.length() })
}

/// The place of the first of these lines that crosses a depth.
/// Errors: the lines lie elsewhere.
fn place_on(model: &Model, rest: &Frame, lines: &[usize], depth_m: f64) -> Result<DVec3, Error> {
    let nodes = |line: &usize| &rest.nodes[model.line_nodes[*line].clone()];
    let crossing = lines.iter().flat_map(|line| nodes(line).windows(2)).find_map(|pair| {
        let [above, below] = [pair[0].z + depth_m, pair[1].z + depth_m];
        ((above < 0.0) != (below < 0.0)).then(|| pair[0].lerp(pair[1], above / (above - below)))
    });
    crossing.ok_or_else(|| {
        let depths = || lines.iter().flat_map(nodes).map(|node| -node.z);
        let (least_m, most_m) =
            (depths().fold(f64::INFINITY, f64::min), depths().fold(f64::NEG_INFINITY, f64::max));
        Error::Message(format!(
            "the line lies {:.1} m to {most_m:.1} m deep at rest; choose a depth in this range",
            least_m.max(0.0)
        ))
    })
}

/// The skin of a whale in its posture, about mid-body.
struct Body {
    /// Places of the vertices from mid-body [m].
    places: Vec<DVec3>,
    /// Parts of the triangles around each vertex.
    parts: Vec<Vec<BodyPart>>,
}

impl Body {
    fn of(whale: &Whale, posed: &WhaleFrame) -> Self {
        let skin = &whale.skin;
        let (mut bones, mut places) = (Vec::new(), Vec::new());
        pose(skin, DVec3::ZERO, posed.orientation, &posed.posture, &mut bones);
        skin_all(skin, &bones, &mut places);
        let mut parts = vec![Vec::new(); places.len()];
        for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
            for vertex in triangle {
                let around: &mut Vec<BodyPart> = &mut parts[*vertex as usize];
                if !around.contains(&region.part()) {
                    around.push(region.part());
                }
            }
        }
        Self { places, parts }
    }

    /// The vertex with which a part meets rope with the greatest lead over other parts, from mid-body [m].
    /// Errors: another part always meets it first.
    fn first_to_meet(&self, seen: &Seen, part: BodyPart) -> Result<DVec3, Error> {
        let own: Vec<DVec3> = self
            .places
            .iter()
            .zip(&self.parts)
            .filter(|(_, parts)| parts[..] == [part])
            .map(|(place, _)| *place)
            .collect();
        let middle = own.iter().sum::<DVec3>() / own.len().max(1) as f64;
        let mut best: Option<(f64, DVec3)> = None;
        let mut before: BTreeMap<BodyPart, usize> = BTreeMap::new();
        for point in own.iter().step_by(own.len().div_ceil(TRIED).max(1)) {
            let [ahead, others] = self.leads(seen, part, *point, &mut before);
            // A lead of the part's own skin over the point moves the contact away from the place.
            let score = (-others).min(ENOUGH_M) - 0.5 * ahead - 0.05 * point.distance(middle);
            if others < 0.0 && best.is_none_or(|(most, _)| score > most) {
                best = Some((score, *point));
            }
        }
        best.map(|(_, point)| point).ok_or_else(|| {
            let first = before.iter().max_by_key(|(_, count)| **count);
            let first = first.map_or_else(|| "another part".to_owned(), |(part, _)| in_words(*part));
            Error::Message(format!(
                "with this heading, the {first} meets the line before the {}; choose another part, heading or depth",
                in_words(part)
            ))
        })
    }

    /// With a point of the skin at the place of the line: the greatest lead over that point of skin that meets rope, of the part and of
    /// other parts, which are counted in `before` [m].
    fn leads(
        &self,
        seen: &Seen,
        part: BodyPart,
        point: DVec3,
        before: &mut BTreeMap<BodyPart, usize>,
    ) -> [f64; 2] {
        let (mut own, mut others) = (0.0_f64, (f64::NEG_INFINITY, None));
        for (place, parts) in self.places.iter().zip(&self.parts) {
            let Some(lead) = seen.lead(*place - point) else { continue };
            if parts.contains(&part) {
                own = own.max(lead);
            } else if lead > others.0 {
                others = (lead, parts.first());
            }
        }
        if let (true, Some(first)) = (others.0 >= 0.0, others.1) {
            *before.entry(*first).or_default() += 1;
        }
        [own, others.0]
    }

    /// Errors: the whale would start above the surface or in the seabed.
    fn check_depth(&self, model: &Model, start_m: DVec3) -> Result<(), Error> {
        let wrong = |message: String| Err(Error::Message(message));
        if start_m.z > 0.0 {
            return wrong(format!(
                "the whale would start {:.1} m above the surface; choose a deeper place on the line",
                start_m.z
            ));
        }
        let Some(seabed) = &model.spec.seabed else { return Ok(()) };
        let below = |place: &DVec3| seabed.height_at(*place + start_m) - (place.z + start_m.z);
        let deepest_m = self.places.iter().map(below).fold(f64::MIN, f64::max);
        if deepest_m > 0.0 {
            return wrong(format!(
                "the whale would start {deepest_m:.1} m in the seabed; choose a shallower place on the line"
            ));
        }
        Ok(())
    }
}

fn in_words(part: BodyPart) -> String {
    part.name().replace('_', " ")
}

/// Rope of gear at rest, seen along the path of the whale, from a place on it.
struct Seen {
    /// Unit vector along the path.
    ahead: DVec3,
    /// Two unit vectors across it.
    across: [DVec3; 2],
    /// Least distance along the path of the rope in each cell [m].
    rope: BTreeMap<[i64; 2], f64>,
}

impl Seen {
    fn along(ahead: DVec3, model: &Model, rest: &Frame, place_m: DVec3) -> Self {
        let across = ahead.any_orthonormal_pair();
        let mut seen = Self { ahead, across: [across.0, across.1], rope: BTreeMap::new() };
        for nodes in &model.line_nodes {
            for pair in rest.nodes[nodes.clone()].windows(2) {
                let pieces = (pair[0].distance(pair[1]) / CELL_M).ceil().clamp(1.0, 1e4) as u32;
                for piece in 0..=pieces {
                    let rope =
                        pair[0].lerp(pair[1], f64::from(piece) / f64::from(pieces)) - place_m;
                    let (cell, along_m) = (seen.cell(rope), rope.dot(ahead));
                    let least_m = seen.rope.entry(cell).or_insert(along_m);
                    *least_m = least_m.min(along_m);
                }
            }
        }
        seen
    }

    fn cell(&self, place: DVec3) -> [i64; 2] {
        self.across.map(|axis| (place.dot(axis) / CELL_M).floor() as i64)
    }

    /// Lead of skin at a place over skin at the place of the line, if it meets rope [m].
    fn lead(&self, place: DVec3) -> Option<f64> {
        let [first, second] = self.cell(place);
        let around =
            (-1..=1).flat_map(|side| (-1..=1).map(move |height| [first + side, second + height]));
        let rope = around.filter_map(|cell| self.rope.get(&cell)).copied().reduce(f64::min)?;
        Some(place.dot(self.ahead) - rope)
    }
}
