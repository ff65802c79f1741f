//! A law of friction: the rope sticks on a bristle of stiffness `k` up to `mu N`, then slips.
//!
//! `z* = P (z + s)` is the trial bristle: `z` as the step began, `s` the slip since then, `P = I - n nᵀ` across the normal.
//! Stick: `f = -k z*`, `df/ds = -k P`. Slip, with `t = z*/|z*|`: `f = -mu N t`, `df/ds = -(mu N/|z*|) (P - t tᵀ)`, `df/dN = -mu t`.

use endline_sdk::{Attribute, Contacts, Descriptor, FrictionModel, FrictionResponse, HookError};

/// Floats that the program keeps for each contact: the bristle.
const FLOATS: usize = 3;

struct Sticky(Descriptor);

impl Sticky {
    fn new() -> Self {
        let stiffness = Attribute::number("stiffness", "N/m^2", [1e4, 1e10], 1e7, "How stiffly skin holds rope, per metre of rope.");
        let scale = Attribute::number("scale", "1", [0.0, 3.0], 1.0, "Multiplies the coefficients of the gear library.");
        let about = Descriptor::new("@id@", "@title@", "Sticks, then slips.");
        Self(about.with_attributes(vec![stiffness, scale]).with_state(FLOATS))
    }
}

/// Trial bristle, its length, its stiffness, the coefficient and the greatest force.
fn bristle(attributes: &[f64], contacts: &Contacts<'_>, i: usize) -> ([f64; 3], f64, f64, f64, f64) {
    let (n, s, z) = (contacts.normal[i], contacts.slip_m[i], &contacts.state[FLOATS * i..]);
    let moved = [z[0] + s[0], z[1] + s[1], z[2] + s[2]];
    let up = moved[0] * n[0] + moved[1] * n[1] + moved[2] * n[2];
    let trial: [f64; 3] = std::array::from_fn(|k| moved[k] - up * n[k]);
    let length = trial.iter().map(|z| z * z).sum::<f64>().sqrt();
    let mu = attributes[1] * contacts.coefficient[i];
    (trial, length, attributes[0] * contacts.length_m[i], mu, mu * contacts.normal_force_n[i])
}

impl FrictionModel for Sticky {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    /// Asked several times a step: changes nothing.
    fn respond(&self, attributes: &[f64], contacts: &Contacts<'_>, out: &mut [FrictionResponse]) -> Result<(), HookError> {
        for (i, answer) in out.iter_mut().enumerate() {
            let (z, length, k, mu, most) = bristle(attributes, contacts, i);
            let n = contacts.normal[i];
            let across = |a: usize, b: usize| f64::from(u8::from(a == b)) - n[a] * n[b];
            let sticks = k * length <= most;
            let t = z.map(|z| if sticks { 0.0 } else { z / length });
            let rate = if sticks { k } else { most / length };
            answer.force_n = z.map(|z| -rate * z);
            answer.by_slip = std::array::from_fn(|a| std::array::from_fn(|b| -rate * (across(a, b) - t[a] * t[b])));
            answer.by_normal_force = t.map(|t| -mu * t);
        }
        Ok(())
    }

    /// Asked once the step is accepted: the floats at its end.
    fn advance(&self, attributes: &[f64], contacts: &Contacts<'_>, out: &mut [f64]) -> Result<(), HookError> {
        for (i, floats) in out.chunks_exact_mut(FLOATS).enumerate() {
            let (z, length, k, _, most) = bristle(attributes, contacts, i);
            let share = if k * length <= most { 1.0 } else { most / (k * length) };
            floats.copy_from_slice(&z.map(|z| share * z));
        }
        Ok(())
    }
}

endline_sdk::export_plugin! {
    about: "Who made this, and where its figures come from.";
    friction: Sticky::new()
}
