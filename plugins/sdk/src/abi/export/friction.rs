//! The functions of a friction model.

use std::ffi::c_void;

use super::guard::guarded;
use super::pointers::{array, array_mut, known_part, size};
use crate::abi::table::*;
use crate::friction::{Contacts, FrictionModel, FrictionResponse};

/// The functions of every friction model of this library.
pub(super) static TABLE: AbiFriction = AbiFriction {
    struct_size: size::<AbiFriction>(),
    respond: Some(friction_respond),
    advance: Some(friction_advance),
};

/// # Safety
/// As [`AbiFriction::respond`] promises.
unsafe extern "C" fn friction_respond(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    contacts: *const AbiContacts,
    out: *mut FrictionResponse,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn FrictionModel>>(), known_part(contacts));
            plugin.respond(
                array(attributes, attribute_count),
                &friction_contacts(&raw),
                array_mut(out, raw.count),
            )
        }
    })
}

/// # Safety
/// As [`AbiFriction::advance`] promises.
unsafe extern "C" fn friction_advance(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    contacts: *const AbiContacts,
    out: *mut f64,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn FrictionModel>>(), known_part(contacts));
            let out = array_mut(out, raw.count * raw.state_len);
            plugin.advance(array(attributes, attribute_count), &friction_contacts(&raw), out)
        }
    })
}

/// # Safety
/// The arrays have the lengths that `raw` says.
unsafe fn friction_contacts(raw: &AbiContacts) -> Contacts<'_> {
    // SAFETY: guaranteed by the caller.
    unsafe {
        Contacts {
            dt_s: raw.dt_s,
            normal_force_n: array(raw.normal_force_n, raw.count),
            normal: array(raw.normal, raw.count),
            grain: array(raw.grain, raw.count),
            along: array(raw.along, raw.count),
            slip_m: array(raw.slip_m, raw.count),
            length_m: array(raw.length_m, raw.count),
            coefficient: array(raw.coefficient, raw.count),
            region: array(raw.region, raw.count),
            rope: array(raw.rope, raw.count),
            state: array(raw.state, raw.count * raw.state_len),
        }
    }
}
