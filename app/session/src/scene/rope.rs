//! Ropes as tubes coloured by tension, with their knots.

use endline_sim::{DVec3, Frame, Model};
use glam::Vec3;

use super::colour::{PARTED, tension_colour};
use super::mesh::{Colour, Mesh, single};

/// Sides of a rope's tube.
const SIDES: usize = 6;

/// Every line as one tube for each whole stretch; a cut segment is a gap whose ends are marked.
pub fn lines(model: &Model, frame: &Frame, scale_n: f64) -> Mesh {
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
    mesh
}

/// Knots, splices and links as balls on the rope, coloured as it is.
fn knots(model: &Model, frame: &Frame, scale_n: f64, mesh: &mut Mesh) {
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
        mesh.ball(single(place), knot.radius_m as f32, tension_colour(tension / scale_n), 6);
    }
}

/// One line in a frame.
struct Rope<'a> {
    nodes: &'a [DVec3],
    tension_n: &'a [f64],
    cut: &'a [bool],
    radius: f32,
}

impl Rope<'_> {
    fn draw(&self, mesh: &mut Mesh, scale_n: f64) {
        let mut first = 0;
        for segment in 0..=self.cut.len() {
            let ends = segment == self.cut.len();
            if !ends && !self.cut[segment] {
                continue;
            }
            self.stretch(mesh, first, segment, scale_n);
            if !ends {
                self.mark_cut(mesh, segment);
            }
            first = segment + 1;
        }
    }

    /// The tube from node `first` to node `last`.
    fn stretch(&self, mesh: &mut Mesh, first: usize, last: usize, scale_n: f64) {
        let centres: Vec<Vec3> = self.nodes[first..=last].iter().copied().map(single).collect();
        let colours: Vec<Colour> =
            (first..=last).map(|node| self.colour(node, first, last, scale_n)).collect();
        mesh.tube(&centres, self.radius, &colours, SIDES);
    }

    /// Colour at a node: the greater tension of the segments that meet there.
    fn colour(&self, node: usize, first: usize, last: usize, scale_n: f64) -> Colour {
        let before = if node > first { self.tension_n[node - 1] } else { 0.0 };
        let after = if node < last { self.tension_n[node] } else { 0.0 };
        tension_colour(before.max(after) / scale_n)
    }

    fn mark_cut(&self, mesh: &mut Mesh, segment: usize) {
        for node in [segment, segment + 1] {
            mesh.ball(single(self.nodes[node]), 3.0 * self.radius, PARTED, 6);
        }
    }
}
