//! A whale motion: a glide that drag slows down, `dU/dt = -U²/l`, over one step exactly `U/(1 + U dt/l)`.

use endline_sdk::{Attribute, Descriptor, HookError, MotionInput, MotionOutput, WhaleMotion};

struct Glide(Descriptor);

impl Glide {
    fn new() -> Self {
        let length = Attribute::number("glide_length", "m", [1.0, 10000.0], 150.0, "Way over which a glide loses its speed.");
        let turn = Attribute::number("turn_rate", "rad/s", [0.0, 1.0], 0.1, "How fast it turns at full yaw.");
        Self(Descriptor::new("@id@", "@title@", "Glides, slowed by drag alone.").with_attributes(vec![length, turn]))
    }
}

impl WhaleMotion for Glide {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn step(&self, attributes: &[f64], input: &MotionInput<'_>, _state: &mut [f64]) -> Result<MotionOutput, HookError> {
        let (length_m, turn_rate, speed) = (attributes[0], attributes[1], input.speed_m_s);
        let mut out = MotionOutput { speed_m_s: speed / (1.0 + speed * input.dt_s / length_m), ..MotionOutput::default() };
        out.turn_rate_rad_s[2] = turn_rate * input.controls.yaw;
        out.posture.spine_yaw = [-0.05 * input.controls.yaw; 8];
        Ok(out)
    }
}

endline_sdk::export_plugin! {
    about: "Who made this, and where its figures come from.";
    motion: Glide::new()
}
