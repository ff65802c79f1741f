//! Ropes as tubes coloured by tension or in their own colour, with their knots.
//!
//! Between nodes the tube follows a cubic through them (Hermite, with tangents by finite differences), in more pieces where it bends more.
//! Every node stays where it is.

use endline_sim::{DVec3, Frame, Model};
use glam::Vec3;

use super::colour::{PARTED, ROPE, WEAK, tension_colour};
use super::mesh::{Colour, Mesh, single};

/// Sides of a rope's tube.
const SIDES: usize = 6;

/// Radius of the mark of a weak place over its rope's diameter.
const WEAK_PLACE: f64 = 0.9;

/// Every line as one tube for each whole stretch; a cut segment is a gap whose ends are marked. Rope is coloured by its tension against
/// `scale_n`, the tension at the top of the scale [N]; without a scale it has its own colour, and the ends of gaps are not marked.
pub fn lines(model: &Model, frame: &Frame, scale_n: Option<f64>) -> Mesh {
    let mut mesh = Mesh::default();
    for (index, line) in model.spec.lines.iter().enumerate() {
        let (nodes, segments) =
            (model.line_nodes[index].clone(), model.line_segments[index].clone());
        let whole = frame.nodes.len() >= nodes.end
            && frame.tension_n.len() >= segments.end
            && frame.cut.len() >= segments.end;
        if whole {
            let radius = (model.spec.ropes[line.rope].diameter_m * 0.5) as f32;
            let rope = Rope {
                nodes: &frame.nodes[nodes],
                tension_n: &frame.tension_n[segments.clone()],
                cut: &frame.cut[segments],
                radius,
            };
            rope.draw(&mut mesh, scale_n);
        }
    }
    knots(model, frame, scale_n, &mut mesh);
    // A knot has no lay: its grain is the same all over.
    mesh.grain.resize(mesh.place.len(), Vec3::Y);
    mesh
}

/// Knots, splices and links as balls on the rope, in its colour.
fn knots(model: &Model, frame: &Frame, scale_n: Option<f64>, mesh: &mut Mesh) {
    for knot in &model.knots {
        let line = model.segment_line[knot.segment];
        let node = model.line_nodes[line].start + knot.segment - model.line_segments[line].start;
        let length = frame.segment_length_m.get(knot.segment);
        let tension = frame.tension_n.get(knot.segment);
        let (Some(length), Some(tension), Some([from, to])) =
            (length, tension, frame.nodes.get(node..node + 2))
        else {
            continue;
        };
        let place = from.lerp(*to, knot.fraction(*length));
        mesh.ball(single(place), knot.radius_m as f32, tint(*tension, scale_n), 6);
    }
}

/// Colour of rope under a tension [N].
fn tint(tension_n: f64, scale_n: Option<f64>) -> Colour {
    scale_n.map_or(ROPE, |scale_n| tension_colour(tension_n / scale_n))
}

/// A ball at every weak place of a line; none where the line has parted.
pub fn weak_places(model: &Model, frame: &Frame) -> Mesh {
    let mut mesh = Mesh::default();
    for (index, line) in model.spec.lines.iter().enumerate() {
        let radius = (model.spec.ropes[line.rope].diameter_m * WEAK_PLACE) as f32;
        for place in &line.weak_places {
            if let Some(place) = along(model, frame, index, place.at_m) {
                mesh.ball(single(place), radius, WEAK, 6);
            }
        }
    }
    mesh
}

/// Place at an unstretched length from end A of a line [m]; `None` in a cut segment, or without a line there.
pub fn along(model: &Model, frame: &Frame, line: usize, at_m: f64) -> Option<DVec3> {
    let segments = model.line_segments.get(line)?.clone();
    let first_node = model.line_nodes[line].start;
    let mut left_m = at_m;
    for (number, segment) in segments.clone().enumerate() {
        let length_m = *frame.segment_length_m.get(segment)?;
        if left_m > length_m && segment + 1 < segments.end {
            left_m -= length_m;
            continue;
        }
        let node = first_node + number;
        let [from, to] = [*frame.nodes.get(node)?, *frame.nodes.get(node + 1)?];
        let is_cut = frame.cut.get(segment).copied().unwrap_or(false);
        return (!is_cut).then(|| from.lerp(to, (left_m / length_m).clamp(0.0, 1.0)));
    }
    None
}

/// A curve through nodes: more places where it bends, each with its colour.
fn smooth(nodes: &[Vec3], colours: &[Colour]) -> (Vec<Vec3>, Vec<Colour>) {
    let (mut places, mut tints) = (Vec::with_capacity(nodes.len()), Vec::new());
    let slopes: Vec<Vec3> = (0..nodes.len()).map(|node| slope(nodes, node)).collect();
    for (at, ends) in nodes.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        let length = from.distance(to);
        let pieces = pieces(to - from, [slopes[at], slopes[at + 1]]);
        for piece in 0..pieces {
            let share = piece as f32 / pieces as f32;
            places.push(hermite(
                [from, to],
                [slopes[at], slopes[at + 1]].map(|it| it * length),
                share,
            ));
            tints.push(std::array::from_fn(|part| {
                colours[at][part] + (colours[at + 1][part] - colours[at][part]) * share
            }));
        }
    }
    places.extend(nodes.last());
    tints.extend(colours.last());
    (places, tints)
}

/// Change of place with length along the rope at a node, from its neighbours [1].
fn slope(nodes: &[Vec3], node: usize) -> Vec3 {
    let along = |from: usize, to: usize| (nodes[to] - nodes[from], nodes[from].distance(nodes[to]));
    let per = |(way, length): (Vec3, f32)| way / length.max(1e-6);
    match (node.checked_sub(1), (node + 1 < nodes.len()).then_some(node + 1)) {
        (Some(before), Some(after)) => {
            let (in_way, out_way) = (along(before, node), along(node, after));
            // The slope of the parabola through the three: the shorter side counts more.
            let whole = (in_way.1 + out_way.1).max(1e-6);
            (per(in_way) * out_way.1 + per(out_way) * in_way.1) / whole
        }
        (Some(before), None) => per(along(before, node)),
        (None, Some(after)) => per(along(node, after)),
        (None, None) => Vec3::ZERO,
    }
}

/// In how many pieces a segment is drawn: one for each 8 degrees that it turns.
fn pieces(way: Vec3, slopes: [Vec3; 2]) -> usize {
    const TURN: f32 = 0.14;
    let turns = slopes.map(|slope| slope.angle_between(way));
    let turn: f32 = turns.into_iter().filter(|turn| turn.is_finite()).sum();
    ((turn / TURN) as usize + 1).min(8)
}

fn hermite([from, to]: [Vec3; 2], [out, into]: [Vec3; 2], share: f32) -> Vec3 {
    let (two, three) = (share * share, share * share * share);
    from * (2.0 * three - 3.0 * two + 1.0)
        + out * (three - 2.0 * two + share)
        + to * (3.0 * two - 2.0 * three)
        + into * (three - two)
}

/// One line in a frame.
struct Rope<'a> {
    nodes: &'a [DVec3],
    tension_n: &'a [f64],
    cut: &'a [bool],
    radius: f32,
}

impl Rope<'_> {
    fn draw(&self, mesh: &mut Mesh, scale_n: Option<f64>) {
        let mut first = 0;
        for segment in 0..=self.cut.len() {
            let ends = segment == self.cut.len();
            if !ends && !self.cut[segment] {
                continue;
            }
            self.stretch(mesh, first, segment, scale_n);
            if !ends && scale_n.is_some() {
                self.mark_cut(mesh, segment);
            }
            first = segment + 1;
        }
    }

    /// The tube from node `first` to node `last`.
    fn stretch(&self, mesh: &mut Mesh, first: usize, last: usize, scale_n: Option<f64>) {
        let nodes: Vec<Vec3> = self.nodes[first..=last].iter().copied().map(single).collect();
        let colours: Vec<Colour> =
            (first..=last).map(|node| self.colour(node, first, last, scale_n)).collect();
        let (centres, colours) = smooth(&nodes, &colours);
        mesh.rope(&centres, self.radius, &colours, SIDES);
    }

    /// Colour at a node: the greater tension of the segments that meet there.
    fn colour(&self, node: usize, first: usize, last: usize, scale_n: Option<f64>) -> Colour {
        let before = if node > first { self.tension_n[node - 1] } else { 0.0 };
        let after = if node < last { self.tension_n[node] } else { 0.0 };
        tint(before.max(after), scale_n)
    }

    fn mark_cut(&self, mesh: &mut Mesh, segment: usize) {
        for node in [segment, segment + 1] {
            mesh.ball(single(self.nodes[node]), 3.0 * self.radius, PARTED, 6);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drawn_curve_goes_through_every_node_and_along_a_circle() {
        let node = |index: usize| {
            let angle = index as f32 * 30.0_f32.to_radians();
            Vec3::new(angle.cos(), angle.sin(), 0.0)
        };
        let nodes: Vec<Vec3> = (0..9).map(node).collect();
        let (places, colours) = smooth(&nodes, &[[0.5; 4]; 9]);
        assert_eq!(places.len(), colours.len());
        assert!(places.len() > 3 * nodes.len(), "a bent rope has more places: {}", places.len());
        for node in &nodes {
            assert!(places.iter().any(|place| place.distance(*node) < 1e-6), "{node}");
        }
        // Chords of 30 degrees leave the circle by 3.4 %; the curve, away from its ends, by a tenth of that.
        let inner = places.iter().filter(|place| place.y > 0.6);
        let off = inner.map(|place| (place.length() - 1.0).abs()).fold(0.0, f32::max);
        assert!(off < 0.0034, "{off}");
    }

    #[test]
    fn a_straight_rope_gains_no_places() {
        let nodes = [0.0, 0.1, 2.0, 2.05].map(|x| Vec3::new(x, 0.0, 0.0));
        assert_eq!(smooth(&nodes, &[[1.0; 4]; 4]).0, nodes);
    }
}
