//! Forces of rope and bodies on skin: arrows, and marks where they press.

use endline_sim::contact::ContactPoint;
use endline_sim::contact::body_on_skin::BodyContact;
use endline_sim::{DVec3, Frame};

use super::colour::{CONTACT, FORCE};
use super::mesh::{Mesh, single};

/// Length of the arrow of the greatest force [m].
const LONGEST_M: f64 = 1.5;
/// Forces below this share of the greatest have no arrow.
const LEAST: f64 = 0.02;

/// The source of a force on skin, by its index in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presser {
    /// Among the contacts of rope.
    Rope(usize),
    /// Among the contacts of bodies.
    Body(usize),
}

/// A force on skin at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinForce {
    /// The source.
    pub of: Presser,
    /// Where [m].
    pub place: DVec3,
    /// On the skin, friction included [N].
    pub force_n: DVec3,
}

impl SkinForce {
    /// Its arrow from tail to tip, the tip at the place, where the greatest force of the frame is so great; `None` where it is too small to
    /// be drawn [m].
    pub fn shaft(&self, greatest_n: f64) -> Option<DVec3> {
        (self.force_n.length() > LEAST * greatest_n)
            .then(|| self.force_n * (LONGEST_M / greatest_n))
    }
}

/// Greatest force of rope or a body on skin at one place in a frame [N].
pub fn greatest_n(frame: &Frame) -> f64 {
    on_skin(frame).map(|force| force.force_n.length()).fold(0.0, f64::max)
}

/// Places where rope and bodies press on skin, with their force on it: they press against the normal, and drag along the skin.
pub fn on_skin(frame: &Frame) -> impl Iterator<Item = SkinForce> {
    let rope = frame.contacts.iter().enumerate().filter_map(|(index, contact)| {
        let ContactPoint { position, normal, normal_force_n, friction_n, .. } = *contact;
        pressing(Presser::Rope(index), position, normal * normal_force_n, friction_n)
    });
    let bodies = frame.body_contacts.iter().enumerate().filter_map(|(index, contact)| {
        let BodyContact { position, normal, normal_force_n, friction_n, .. } = *contact;
        pressing(Presser::Body(index), position, normal * normal_force_n, friction_n)
    });
    rope.chain(bodies)
}

/// The force on skin from the normal force and friction of a contact; `None` where there is no normal force.
fn pressing(of: Presser, place: DVec3, push: DVec3, friction: DVec3) -> Option<SkinForce> {
    (push != DVec3::ZERO).then(|| SkinForce { of, place, force_n: -push - friction })
}

/// An arrow for each force of rope and bodies on skin, its tip at the contact; its length is proportional to the force, the greatest of the frame
/// being 1.5 m. Shafts, and heads.
pub fn forces(frame: &Frame) -> [Mesh; 2] {
    let [mut shafts, mut heads] = <[Mesh; 2]>::default();
    let greatest_n = greatest_n(frame);
    for force in on_skin(frame) {
        if let Some(shaft) = force.shaft(greatest_n) {
            let tip = single(force.place);
            shafts.bar(single(force.place - shaft), tip, 0.012, FORCE);
            heads.head(tip, single(shaft).normalize_or_zero(), 0.1, FORCE);
        }
    }
    [shafts, heads]
}

/// A ball at every place where rope or a body presses on skin.
pub fn contacts(frame: &Frame) -> Mesh {
    let mut mesh = Mesh::default();
    for force in on_skin(frame) {
        mesh.ball(single(force.place), 0.03, CONTACT, 6);
    }
    mesh
}
