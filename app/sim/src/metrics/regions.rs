//! Rope on each part of the whale: length, force, pressure, work of friction.

use endline_sdk::BodyPart;

use crate::contact::ContactPoint;
use crate::model::Model;

const PARTS: usize = BodyPart::ALL.len();

/// Loads of every part.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    pub(super) parts: [Load; PARTS],
}

/// Load of one part, now and at its greatest.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Load {
    pub(super) length_m: f64,
    pub(super) normal_n: f64,
    /// Fastest slip of any contact [m/s].
    pub(super) slip_m_s: f64,
    pub(super) peak_length_m: f64,
    pub(super) peak_normal_n: f64,
    pub(super) peak_pressure_pa: f64,
    pub(super) work_j: f64,
    pub(super) peak_wraps: f64,
}

impl Loads {
    /// Takes in the contacts of a step of `dt_s`.
    pub(super) fn fold(&mut self, model: &Model, contacts: &[ContactPoint], dt_s: f64) {
        for load in &mut self.parts {
            (load.length_m, load.normal_n, load.slip_m_s) = (0.0, 0.0, 0.0);
        }
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let load = &mut self.parts[contact.region.part() as usize];
            load.length_m += contact.length_m;
            load.normal_n += contact.normal_force_n;
            load.slip_m_s = load.slip_m_s.max(slip_speed(contact));
            load.work_j += work(contact, dt_s);
            load.peak_pressure_pa = load.peak_pressure_pa.max(pressure(model, contact));
        }
        for load in &mut self.parts {
            load.peak_length_m = load.peak_length_m.max(load.length_m);
            load.peak_normal_n = load.peak_normal_n.max(load.normal_n);
        }
    }
}

/// Work done against friction at a contact over a step [J]: its power in the last solver step,
/// `-f·s/dt`, held for the whole step.
fn work(contact: &ContactPoint, step_s: f64) -> f64 {
    let solver_steps = if contact.dt_s > 0.0 { step_s / contact.dt_s } else { 1.0 };
    -contact.friction_n.dot(contact.slip_m) * solver_steps
}

/// Mean pressure of a contact under the rope's width [Pa].
fn pressure(model: &Model, contact: &ContactPoint) -> f64 {
    let width = model.spec.ropes[model.spec.lines[contact.line].rope].diameter_m;
    let area = contact.length_m * width;
    if area > 0.0 { contact.normal_force_n / area } else { 0.0 }
}

/// Speed of rope over skin in the last solver step [m/s].
fn slip_speed(contact: &ContactPoint) -> f64 {
    if contact.dt_s > 0.0 { contact.slip_m.length() / contact.dt_s } else { 0.0 }
}
