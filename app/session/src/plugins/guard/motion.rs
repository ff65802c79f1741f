//! Guard of a whale motion.

use std::f64::consts::PI;
use std::sync::Arc;

use endline_sdk::{Descriptor, HookError, MotionInput, MotionOutput, Posture, WhaleMotion};

use super::{expect_finite, expect_len, fault, named};

/// No whale swims faster than this [m/s].
const GREATEST_SPEED_M_S: f64 = 30.0;

/// No whale turns faster than this [rad/s].
const GREATEST_TURN_RAD_S: f64 = 10.0;

pub(super) struct Guarded(pub Arc<dyn WhaleMotion>);

impl WhaleMotion for Guarded {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        self.watched(attributes, input, state).map_err(named(&self.descriptor().id))
    }
}

impl Guarded {
    fn watched(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        expect_len("attribute values", attributes.len(), self.descriptor().attributes.len())?;
        expect_len("floats of state", state.len(), self.descriptor().state_len)?;
        let out = self.0.step(attributes, input, state)?;
        expect_finite("a float of its state", state)?;
        expect_within("the speed", &[out.speed_m_s], GREATEST_SPEED_M_S, "m/s")?;
        expect_within("a turn rate", &out.turn_rate_rad_s, GREATEST_TURN_RAD_S, "rad/s")?;
        check_posture(&out.posture)?;
        Ok(out)
    }
}

fn check_posture(posture: &Posture) -> Result<(), HookError> {
    for (what, angles) in posture.groups() {
        expect_within(what, angles, PI, "rad")?;
    }
    Ok(())
}

fn expect_within(what: &str, values: &[f64], most: f64, unit: &str) -> Result<(), HookError> {
    expect_finite(what, values)?;
    match values.iter().find(|value| value.abs() > most) {
        None => Ok(()),
        Some(value) => fault(format!("it gave {value} {unit} for {what}, beyond {most} {unit}")),
    }
}
