//! A whale motion, tried out.

use endline_sdk::{BodyPart, Controls, HookError, MotionInput, WhaleMotion};

use super::{Play, Random, Trial, bits, defaults, drawn, numbers, on_threads, plays_again};

/// Sets of attributes, and steps with each.
const SETS: u64 = 24;
const STEPS: usize = 40;

pub(super) fn run(motion: &dyn WhaleMotion, trial: &mut Trial<'_>) {
    if !trial
        .check("defaults", || once(motion).map(|()| String::new()).map_err(|error| error.message))
    {
        return;
    }
    let mut first = None;
    let tried = trial.check("ranges", || {
        for set in 0..SETS {
            first.get_or_insert(play(motion, set, None).map_err(|error| error.message)?);
        }
        Ok(format!("{} steps at attributes drawn within their ranges", SETS as usize * STEPS))
    });
    let (true, Some(first)) = (tried, first) else { return };
    plays_again(trial, &first, |restored| play(motion, 0, restored));
    trial.check("threads", || on_threads(&first, || play(motion, 0, None)));
    trial.time("a step", STEPS, || play(motion, 0, None).map(drop));
}

fn once(motion: &dyn WhaleMotion) -> Result<(), HookError> {
    let attributes = numbers(&defaults(&motion.descriptor().attributes));
    let mut state = vec![0.0; motion.descriptor().state_len];
    let drawing = Drawing::new(&mut Random(1), motion.descriptor().acts.len());
    let controls = Controls { speed: 1.0, yaw: 0.5, ..Controls::default() };
    motion
        .step(&attributes, &MotionInput { controls, time_s: 0.0, ..drawing.input(0) }, &mut state)
        .map(drop)
}

/// One set of attributes and its steps; from floats saved half way where some are given.
fn play(motion: &dyn WhaleMotion, set: u64, restored: Option<&[f64]>) -> Result<Play, HookError> {
    let descriptor = motion.descriptor();
    let mut random = Random(set);
    let attributes = numbers(&drawn(&descriptor.attributes, &mut random));
    let drawings: Vec<_> =
        (0..STEPS).map(|_| Drawing::new(&mut random, descriptor.acts.len())).collect();
    Play::of(&drawings, descriptor.state_len, restored, |step, drawing, state| {
        let out = motion.step(&attributes, &drawing.input(step), state)?;
        let rest = [out.speed_m_s].into_iter().chain(out.turn_rate_rad_s);
        Ok(bits(out.posture.angles().chain(rest).chain(state.iter().copied())).collect())
    })
}

/// The input of one step.
struct Drawing {
    dt_s: f64,
    length_m: f64,
    speed_m_s: f64,
    position_m: [f64; 3],
    controls: Controls,
    contact_force_n: [f64; BodyPart::ALL.len()],
    contact_port_m: [f64; BodyPart::ALL.len()],
    thrust_speed_m_s: Option<f64>,
}

impl Drawing {
    fn new(random: &mut Random, acts: usize) -> Self {
        let mut axis = || random.between(-1.0, 1.0);
        let mut controls = Controls {
            speed: axis().max(0.0),
            pitch: axis(),
            roll: axis(),
            yaw: axis(),
            burst: f64::from(u8::from(axis() > 0.7)),
            mouth: axis().max(0.0),
            flipper_raise: axis(),
            flipper_twist: axis(),
            flipper_sweep: axis(),
            act: 0.0,
        };
        controls.act = random.below(acts + 2) as f64;
        Self {
            dt_s: random.order(-4.0, -1.5),
            length_m: random.between(4.0, 30.0),
            speed_m_s: random.between(0.0, 8.0),
            position_m: random.vector(100.0),
            controls,
            contact_force_n: std::array::from_fn(|_| random.between(-2e3, 1e3).max(0.0)),
            contact_port_m: std::array::from_fn(|_| random.between(-2.0, 2.0)),
            thrust_speed_m_s: (random.below(2) == 1).then(|| random.between(0.0, 10.0)),
        }
    }

    fn input(&self, step: usize) -> MotionInput<'_> {
        MotionInput {
            time_s: step as f64 * 0.1,
            dt_s: self.dt_s,
            length_m: self.length_m,
            speed_m_s: self.speed_m_s,
            position_m: self.position_m,
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls: self.controls,
            contact_force_n: &self.contact_force_n,
            contact_port_m: &self.contact_port_m,
            thrust_speed_m_s: self.thrust_speed_m_s,
        }
    }
}
