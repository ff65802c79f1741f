//! Forces of bodies on skin over a step of the model: impulse, greatest normal force and work of each, over its solver steps.

use endline_sdk::BodyPart;
use glam::DVec3;

use crate::contact::body_on_skin::BodyContact;

const PARTS: usize = BodyPart::ALL.len();

/// Sums of one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodySum {
    /// Impulse of the body on the whale [N s].
    pub impulse_n_s: DVec3,
    /// Impulse of its pushes on each part of the whale [N s].
    pub push_n_s: [f64; PARTS],
    /// Greatest sum of its pushes at the end of a solver step [N].
    pub peak_n: f64,
    /// Work done against friction [J].
    pub friction_work_j: f64,
}

/// Sums over the solver steps of a step of the model, body by body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodySums {
    /// One for each body of the model; zero where it touches nothing.
    pub bodies: Vec<BodySum>,
}

impl BodySums {
    /// Sums of a number of bodies.
    pub(crate) fn new(bodies: usize) -> Self {
        Self { bodies: vec![BodySum::default(); bodies] }
    }

    pub(crate) fn clear(&mut self) {
        self.bodies.fill(BodySum::default());
    }

    /// Adds the contacts of a solver step of `dt_s`, in order of body within each friction law.
    pub(crate) fn take(&mut self, contacts: &[BodyContact], dt_s: f64) {
        for contact in contacts {
            let push = contact.normal * contact.normal_force_n;
            let sum = &mut self.bodies[contact.body];
            sum.impulse_n_s -= (push + contact.friction_n) * dt_s;
            sum.push_n_s[contact.region.part() as usize] += contact.normal_force_n * dt_s;
            sum.friction_work_j -= contact.friction_n.dot(contact.slip_m);
        }
        for (body, sum) in self.bodies.iter_mut().enumerate() {
            let mine = contacts.iter().filter(|contact| contact.body == body);
            sum.peak_n = sum.peak_n.max(mine.map(|contact| contact.normal_force_n).sum());
        }
    }
}

impl BodySum {
    /// The part that it pressed on most, if any.
    pub fn part(&self) -> Option<BodyPart> {
        let parts = BodyPart::ALL.iter().zip(self.push_n_s).filter(|(_, push)| *push > 0.0);
        parts.max_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(part, _)| *part)
    }
}
