//! Steady swimming: fluke beat, steering, flippers and mouth.
//!
//! Symbols: `U` speed through the water, `L` body length, `A` peak-to-peak excursion of the flukes,
//! `f` beat frequency, `phi` phase of the beat, `x` distance aft of the snout over `L`,
//! `tau` smoothing time, `c` a control, `c~` the smoothed control, `T` thrust, `D` drag of the body,
//! `V` speed of the beat, `V~` the smoothed one.
//!
//! ```text
//! controls   d c~/dt = (c - c~)/tau   speed, pitch, roll, yaw, burst
//!            |d c~/dt| <= 1/time      mouth, flippers
//! speed      target = cruise c~speed + (burst - cruise c~speed) c~burst,  -braking <= dU/dt <= acceleration
//! turning    roll, pitch, yaw rate = greatest rate times its smoothed control
//! beat       f = St V~ / A   within its limits, the upper one as L^-0.53;  d phi/dt = 2 pi f
//!            D(V) = T            kinetic whale;  d V~^2/dt = (V^2 - V~^2)/tau
//!            V~ = max(target, U) kinematic whale
//! body wave  y(x) = A/2 e(x) sin(phi - 2 pi x L/lambda)                     see `wave`
//! flukes     pitch with the heave velocity, a quarter period from the heave: atan(pi St) less the
//!            angle of attack                                                see `wave`
//! ```
//!
//! The thrust of oscillating flukes grows with the square of their speed, `T ~ (f A)^2` (Floryan et al. 2017), and the drag of
//! the body nearly with that of `U`. A whale that pulls gear therefore beats as a free whale does at the speed `V` at which its
//! drag equals the thrust: `f A / U` rises above `St`, and the flukes of a whale that is held fast still move.
//!
//! At the lower limit of `f`, `A` decreases instead, so that `f A / V` is constant down to rest; at
//! the upper limit it decreases. A gliding whale (speed control 0) returns to the rest posture within a few `tau`.
//!
//! The whale's frame at mid-body moves straight: its small heave is neglected.
//!
//! References: Strouhal target 0.2-0.4 and `A = 0.2 L`: van der Hoop et al., "Swimming kinematics
//! and efficiency of entangled North Atlantic right whales", Endangered Species Research 32 (2017)
//! 1-17; speeds 1.1-1.5 m/s: van der Hoop et al. 2019; fluke pitch amplitude 20-35 degrees and
//! phase near 90 degrees: Hover, Haugsdal and Triantafyllou, Journal of Fluids and Structures 19
//! (2004) 37-47; flippers swept aft in cruise, forward in turns: observers of right whales.
//! greatest beat by length: Gough et al., Journal of Experimental Biology 222 (2019) jeb204172.
//! Thrust of oscillating foils: Floryan, Van Buren, Rowley and Smits, Journal of Fluid Mechanics 822
//! (2017) 386-397. Burst speed, turn rates, rates of mouth and flippers are estimates.

mod settings;
mod wave;

use std::f64::consts::TAU;

use endline_sdk::{Controls, Descriptor, HookError, MotionInput, MotionOutput, WhaleMotion};

use settings::Settings;
use wave::Beat;

/// The steady-swim motion.
#[derive(Clone, Debug)]
pub struct Swim {
    descriptor: Descriptor,
}

impl Swim {
    /// The motion with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Swim {
    fn default() -> Self {
        Self::new()
    }
}

impl WhaleMotion for Swim {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let settings = Settings::read(attributes)?;
        check(input)?;
        let mut floats = Floats::read(state)?;
        floats.follow(&settings, &input.controls, input.dt_s);
        let target = target_speed(&settings, &floats);
        let speed_m_s = next_speed(&settings, target, input);
        let beat_speed_m_s = match input.thrust_speed_m_s {
            Some(thrust_speed_m_s) => floats.follow_thrust(&settings, thrust_speed_m_s, input.dt_s),
            None => target.max(speed_m_s),
        };
        let beat = Beat::of(&settings, &floats, beat_speed_m_s, input.length_m);
        floats.advance_phase(beat.frequency_hz, input.dt_s);
        let posture = wave::posture(&settings, &floats, &beat);
        floats.write(state);
        Ok(MotionOutput { speed_m_s, turn_rate_rad_s: turn_rates(&settings, &floats), posture })
    }
}

fn descriptor() -> Descriptor {
    Descriptor {
        id: "org.endline.motion.swim".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Swim".into(),
        help: "Steady swimming with fluke beat; steered by speed, pitch, roll and yaw.".into(),
        attributes: settings::attributes(),
        state_len: LEN,
        acts: Vec::new(),
    }
}

fn check(input: &MotionInput<'_>) -> Result<(), HookError> {
    if !(input.dt_s > 0.0 && input.length_m > 0.0 && input.speed_m_s.is_finite()) {
        return Err(HookError::new(format!(
            "cannot swim with a step of {} s, a body length of {} m and a speed of {} m/s",
            input.dt_s, input.length_m, input.speed_m_s
        )));
    }
    Ok(())
}

/// Target speed of the smoothed controls [m/s].
fn target_speed(settings: &Settings, floats: &Floats) -> f64 {
    let cruise = settings.cruise_speed_m_s * floats.speed.clamp(0.0, 1.0);
    let burst = settings.burst_speed_m_s.max(settings.cruise_speed_m_s);
    cruise + (burst - cruise) * floats.burst.clamp(0.0, 1.0)
}

/// Speed at the end of the step: towards the target, within acceleration and braking [m/s].
fn next_speed(settings: &Settings, target: f64, input: &MotionInput<'_>) -> f64 {
    let change = target - input.speed_m_s;
    input.speed_m_s
        + change.clamp(-settings.braking_m_s2 * input.dt_s, settings.acceleration_m_s2 * input.dt_s)
}

/// Turn rates about the whale's x, y and z [rad/s]: roll to starboard is positive about x and yaw to port about z, as in the
/// controls; nose up is negative about y.
fn turn_rates(settings: &Settings, floats: &Floats) -> [f64; 3] {
    [
        settings.roll_rate_rad_s * floats.roll,
        -settings.pitch_rate_rad_s * floats.pitch,
        settings.yaw_rate_rad_s * floats.yaw,
    ]
}

/// Number of floats.
const LEN: usize = 12;

/// The floats by name; zero for a whale at rest.
struct Floats {
    /// Phase of the beat, 0 to 2 pi [rad].
    pub phase: f64,
    /// Intensity of the beat: 0 gliding, 1 swimming.
    pub effort: f64,
    /// Smoothed speed control, 0 to 1.
    pub speed: f64,
    /// Smoothed pitch, -1 to 1.
    pub pitch: f64,
    /// Smoothed roll, -1 to 1.
    pub roll: f64,
    /// Smoothed yaw, -1 to 1.
    pub yaw: f64,
    /// Smoothed burst, 0 to 1.
    pub burst: f64,
    /// Opening of the mouth, 0 to 1.
    pub mouth: f64,
    /// Raise of the flippers, -1 to 1.
    pub flipper_raise: f64,
    /// Twist of the flippers, -1 to 1.
    pub flipper_twist: f64,
    /// Sweep of the flippers, -1 to 1.
    pub flipper_sweep: f64,
    /// Square of the speed at which the drag equals the thrust, smoothed [m²/s²].
    pub thrust_speed_squared: f64,
}

impl Floats {
    /// The floats of a call.
    ///
    /// # Errors
    /// Where there are more or fewer than [`LEN`].
    fn read(state: &[f64]) -> Result<Self, HookError> {
        let &[
            phase,
            effort,
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            thrust_speed_squared,
        ] = state
        else {
            return Err(HookError::new(format!(
                "expected {LEN} floats of state, got {}",
                state.len()
            )));
        };
        Ok(Self {
            phase,
            effort,
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            thrust_speed_squared,
        })
    }

    /// Writes the floats back.
    fn write(&self, state: &mut [f64]) {
        let all = [
            self.phase,
            self.effort,
            self.speed,
            self.pitch,
            self.roll,
            self.yaw,
            self.burst,
            self.mouth,
            self.flipper_raise,
            self.flipper_twist,
            self.flipper_sweep,
            self.thrust_speed_squared,
        ];
        state.copy_from_slice(&all);
    }

    /// Advances the smoothed controls by one step.
    fn follow(&mut self, settings: &Settings, controls: &Controls, dt_s: f64) {
        let share = -libm::expm1(-dt_s / settings.smoothing_s);
        let swims = controls.speed > 0.0 || controls.burst > 0.0;
        for (value, wanted) in [
            (&mut self.effort, f64::from(u8::from(swims))),
            (&mut self.speed, controls.speed.clamp(0.0, 1.0)),
            (&mut self.pitch, controls.pitch.clamp(-1.0, 1.0)),
            (&mut self.roll, controls.roll.clamp(-1.0, 1.0)),
            (&mut self.yaw, controls.yaw.clamp(-1.0, 1.0)),
            (&mut self.burst, controls.burst.clamp(0.0, 1.0)),
        ] {
            *value += share * (wanted - *value);
        }
        let flipper = dt_s / settings.flipper_time_s;
        approach(&mut self.mouth, controls.mouth.clamp(0.0, 1.0), dt_s / settings.mouth_time_s);
        approach(&mut self.flipper_raise, controls.flipper_raise.clamp(-1.0, 1.0), flipper);
        approach(&mut self.flipper_twist, controls.flipper_twist.clamp(-1.0, 1.0), flipper);
        approach(&mut self.flipper_sweep, controls.flipper_sweep.clamp(-1.0, 1.0), flipper);
    }

    /// Advances the smoothed speed of the beat by one step and returns it [m/s]. The square is smoothed, because the thrust is
    /// nearly proportional to it.
    fn follow_thrust(&mut self, settings: &Settings, thrust_speed_m_s: f64, dt_s: f64) -> f64 {
        let share = -libm::expm1(-dt_s / settings.smoothing_s);
        self.thrust_speed_squared +=
            share * (thrust_speed_m_s * thrust_speed_m_s - self.thrust_speed_squared);
        self.thrust_speed_squared.sqrt()
    }

    /// Advances the phase of the beat by one step.
    fn advance_phase(&mut self, frequency_hz: f64, dt_s: f64) {
        self.phase = (self.phase + TAU * frequency_hz * dt_s) % TAU;
    }
}

/// Moves a value towards another by at most `most`.
fn approach(value: &mut f64, wanted: f64, most: f64) {
    *value += (wanted - *value).clamp(-most, most);
}
