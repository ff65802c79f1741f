//! Ropes as tubes coloured by tension, and marks where they press on skin.

use endline_sim::contact::ContactPoint;
use endline_sim::contact::bodies::BodyContact;
use endline_sim::{DVec3, Frame, Model};
use glam::Vec3;

use super::colour::{CONTACT, FORCE, PARTED, tension_colour};
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
    mesh
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

/// Length of the arrow of the greatest force [m].
const LONGEST_M: f64 = 1.5;
/// Forces below this share of the greatest have no arrow.
const LEAST: f64 = 0.02;

/// Greatest force of rope or a body on skin at one place in a frame [N].
#[must_use]
pub fn greatest_n(frame: &Frame) -> f64 {
    on_skin(frame).map(|(_, force)| force.length()).fold(0.0, f64::max)
}

/// Places where rope and bodies press on skin, with their force on it: they press against the normal, and drag along the skin [m], [N].
fn on_skin(frame: &Frame) -> impl Iterator<Item = (DVec3, DVec3)> {
    let force = |normal: DVec3, push_n: f64, friction: DVec3| {
        (push_n > 0.0).then(|| -normal * push_n - friction)
    };
    let rope = frame.contacts.iter().filter_map(move |contact| {
        let ContactPoint { position, normal, normal_force_n, friction_n, .. } = *contact;
        Some((position, force(normal, normal_force_n, friction_n)?))
    });
    let bodies = frame.body_contacts.iter().filter_map(move |contact| {
        let BodyContact { position, normal, normal_force_n, friction_n, .. } = *contact;
        Some((position, force(normal, normal_force_n, friction_n)?))
    });
    rope.chain(bodies)
}

/// An arrow for each force of rope and bodies on skin, its tip at the contact; its length goes with the force, the greatest of the frame
/// being 1.5 m.
pub fn forces(frame: &Frame) -> Mesh {
    let mut mesh = Mesh::default();
    let greatest_n = greatest_n(frame);
    for (position, force) in on_skin(frame) {
        if force.length() > LEAST * greatest_n {
            let shaft = force * (LONGEST_M / greatest_n);
            mesh.arrow(single(position - shaft), single(shaft), 0.012, FORCE);
        }
    }
    mesh
}

/// A ball at every place where rope or a body presses on skin.
pub fn contacts(frame: &Frame) -> Mesh {
    let mut mesh = Mesh::default();
    for (position, _) in on_skin(frame) {
        mesh.ball(single(position), 0.03, CONTACT, 6);
    }
    mesh
}
