//! A whale motion, tried out.

use endline_sdk::{BodyPart, Controls, HookError, MotionInput, MotionOutput, WhaleMotion};

use super::Random;
use super::{Bits, Play, Trial, bits, defaults, drawn, numbers, on_threads, plays_again};

/// Sets of attributes, and steps with each.
const SETS: u64 = 24;
const STEPS: usize = 40;

pub(super) fn run(motion: &dyn WhaleMotion, trial: &mut Trial<'_>) {
    if !trial
        .check("defaults", || once(motion).map(|()| String::new()).map_err(|error| error.message))
    {
        return;
    }
    let plays: Result<Vec<_>, _> = {
        let mut took = None;
        trial.check("ranges", || {
            let plays: Result<Vec<Play>, HookError> =
                (0..SETS).map(|set| play(motion, set, None)).collect();
            let range = plays.as_ref().map(|_| {
                format!("{} steps at attributes drawn within their ranges", SETS as usize * STEPS)
            });
            let range = range.map_err(|error| error.message.clone());
            took = Some(plays);
            range
        });
        took.unwrap_or_else(|| Ok(Vec::new()))
    };
    let Ok(plays) = plays else { return };
    let Some(first) = plays.first() else { return };
    plays_again(trial, first, || play(motion, 0, None), |floats| play(motion, 0, Some(floats)));
    trial.check("threads", || on_threads(first, || play(motion, 0, None)));
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
    let mut state = restored.map_or_else(|| vec![0.0; descriptor.state_len], <[f64]>::to_vec);
    let mut half_way = state.clone();
    let mut answers = Vec::with_capacity(STEPS);
    for (step, drawing) in
        drawings.iter().enumerate().skip(if restored.is_some() { STEPS / 2 } else { 0 })
    {
        if step == STEPS / 2 {
            half_way.clone_from(&state);
        }
        let out = motion.step(&attributes, &drawing.input(step), &mut state)?;
        answers.push(output_bits(&out, &state));
    }
    Ok(Play { answers, half_way })
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
        }
    }
}

fn output_bits(out: &MotionOutput, state: &[f64]) -> Bits {
    let rest = [out.speed_m_s].into_iter().chain(out.turn_rate_rad_s);
    bits(out.posture.angles().chain(rest).chain(state.iter().copied())).collect()
}
