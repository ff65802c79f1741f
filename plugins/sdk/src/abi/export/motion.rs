//! The functions of a whale motion.

use std::ffi::c_void;

use super::guard::guarded;
use super::pointers::{array, array_mut, known_part, size};
use crate::abi::table::*;
use crate::hook::HookError;
use crate::motion::{MotionInput, MotionOutput, WhaleMotion};
use crate::whale::BodyPart;

/// The functions of every whale motion of this library.
pub(super) static TABLE: AbiMotion =
    AbiMotion { struct_size: size::<AbiMotion>(), step: Some(motion_step) };

/// # Safety
/// As [`AbiMotion::step`] promises: arrays of the lengths given, `context` from a descriptor.
unsafe extern "C" fn motion_step(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    input: *const AbiMotionInput,
    state: *mut f64,
    state_len: usize,
    out: *mut MotionOutput,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn WhaleMotion>>(), known_part(input));
            let parts = |what: &str, of: *const f64| {
                let given = array(of, raw.body_part_count);
                <&[f64; BodyPart::ALL.len()]>::try_from(given).map_err(|_| {
                    HookError::new(format!(
                        "expected {what} of {} body parts, got {}",
                        BodyPart::ALL.len(),
                        given.len()
                    ))
                })
            };
            let (force, port) =
                (parts("forces", raw.contact_force_n)?, parts("places", raw.contact_port_m)?);
            let input = motion_input(&raw, force, port);
            *out = plugin.step(
                array(attributes, attribute_count),
                &input,
                array_mut(state, state_len),
            )?;
        }
        Ok(())
    })
}

fn motion_input<'a>(
    raw: &AbiMotionInput,
    contact_force_n: &'a [f64; BodyPart::ALL.len()],
    contact_port_m: &'a [f64; BodyPart::ALL.len()],
) -> MotionInput<'a> {
    MotionInput {
        time_s: raw.time_s,
        dt_s: raw.dt_s,
        length_m: raw.length_m,
        speed_m_s: raw.speed_m_s,
        position_m: raw.position_m,
        orientation: raw.orientation,
        controls: raw.controls,
        contact_force_n,
        contact_port_m,
        thrust_speed_m_s: (raw.has_thrust != 0).then_some(raw.thrust_speed_m_s),
    }
}
