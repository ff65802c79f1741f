//! Guard of a friction model: its forces are finite, lie across the normal and cannot drive the rope.
//!
//! A law of friction may give back what its bristles stored, so force along slip alone proves
//! nothing. Two things do: a contact that stores nothing (all floats zero) may not push the way it
//! slips, and no contact may pull harder than [`GREATEST_RATIO`] times coefficient times normal force.

use std::sync::Arc;

use endline_sdk::{Contacts, Descriptor, FrictionModel, FrictionResponse, HookError};

use super::{expect_finite, expect_len, fault, named};

/// Greatest friction force over coefficient times normal force that passes for friction [1].
const GREATEST_RATIO: f64 = 10.0;

/// Share of rounding that is forgiven [1].
const ROUNDING: f64 = 1e-9;

/// No number: what a place for an answer holds before the call, and no arithmetic gives.
pub(in crate::plugins) const BLANK: f64 = f64::from_bits(0x7ff8_5eed_0e4d_11e5);
/// An answer of such numbers.
pub(in crate::plugins) const UNWRITTEN: FrictionResponse =
    FrictionResponse { force_n: [BLANK; 3], by_slip: [[BLANK; 3]; 3], by_normal_force: [BLANK; 3] };

pub(super) struct Guarded(pub Arc<dyn FrictionModel>);

impl FrictionModel for Guarded {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        self.watched_respond(attributes, contacts, out).map_err(named(&self.descriptor().id))
    }

    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        self.watched_advance(attributes, contacts, out).map_err(named(&self.descriptor().id))
    }
}

impl Guarded {
    fn watched_respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        self.check_input(attributes, contacts)?;
        expect_len("places for answers", out.len(), contacts.len())?;
        out.fill(UNWRITTEN);
        self.0.respond(attributes, contacts, out)?;
        if out.iter().any(is_unwritten) {
            return fault(format!(
                "it wrote fewer answers than the {} contacts it was asked about",
                contacts.len()
            ));
        }
        let floats = self.descriptor().state_len;
        for (index, answer) in out.iter().enumerate() {
            let fresh = contacts.state[floats * index..floats * (index + 1)]
                .iter()
                .all(|float| *float == 0.0);
            check_answer(answer, contacts, index, fresh)
                .map_err(|error| HookError::new(format!("contact {index}: {}", error.message)))?;
        }
        Ok(())
    }

    fn watched_advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        self.check_input(attributes, contacts)?;
        expect_len("places for floats", out.len(), contacts.len() * self.descriptor().state_len)?;
        out.fill(BLANK);
        self.0.advance(attributes, contacts, out)?;
        if out.iter().any(|float| float.to_bits() == BLANK.to_bits()) {
            return fault(format!("it wrote fewer than the {} floats of its contacts", out.len()));
        }
        expect_finite("a float of its state", out)
    }

    fn check_input(&self, attributes: &[f64], contacts: &Contacts<'_>) -> Result<(), HookError> {
        expect_len("attribute values", attributes.len(), self.descriptor().attributes.len())?;
        let count = contacts.len();
        for got in [
            contacts.normal.len(),
            contacts.grain.len(),
            contacts.along.len(),
            contacts.slip_m.len(),
            contacts.length_m.len(),
            contacts.coefficient.len(),
            contacts.region.len(),
            contacts.rope.len(),
        ] {
            expect_len("entries in each array of contacts", got, count)?;
        }
        expect_len("floats of state", contacts.state.len(), count * self.descriptor().state_len)
    }
}

fn is_unwritten(answer: &FrictionResponse) -> bool {
    answer.force_n.iter().all(|force| force.to_bits() == BLANK.to_bits())
}

fn check_answer(
    answer: &FrictionResponse,
    contacts: &Contacts<'_>,
    index: usize,
    fresh: bool,
) -> Result<(), HookError> {
    expect_finite("the force", &answer.force_n)?;
    expect_finite("the derivative by slip", answer.by_slip.as_flattened())?;
    expect_finite("the derivative by normal force", &answer.by_normal_force)?;
    let (force, slip) = (answer.force_n, contacts.slip_m[index]);
    let (size, way) = (dot(force, force).sqrt(), dot(slip, slip).sqrt());
    let limit = contacts.coefficient[index] * contacts.normal_force_n[index];
    if dot(force, contacts.normal[index]).abs() > 1e-6 * (size + limit) {
        return fault(format!(
            "its force {force:?} N does not lie across the normal {:?}",
            contacts.normal[index]
        ));
    }
    if fresh && dot(force, slip) > ROUNDING * size * way {
        return fault(format!(
            "its force {force:?} N pushes the way the rope slips, {slip:?} m: friction may not create energy"
        ));
    }
    let most = GREATEST_RATIO * limit;
    if size > most * (1.0 + ROUNDING) + f64::MIN_POSITIVE {
        return fault(format!(
            "its force of {size} N is beyond {GREATEST_RATIO} times coefficient times normal force, {most} N"
        ));
    }
    Ok(())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
