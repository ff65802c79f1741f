//! A whale flown by a motion alone: no rope, no water, the turns integrated.

use std::sync::Arc;

use endline_sdk::{BodyPart, Controls, MotionInput, MotionOutput, WhaleMotion};
use endline_sim::whale::acts::{Acting, Answers, Clip, attitude};
use endline_sim::{DQuat, DVec3};
use endline_whale_motions::Swim;

use crate::linked::library;

/// A flight: the motion with its floats, the whale's place in the world.
pub struct Flight {
    pub acting: Acting,
    attributes: Vec<f64>,
    state: Vec<f64>,
    pub dt_s: f64,
    pub length_m: f64,
    pub time_s: f64,
    pub speed_m_s: f64,
    pub orientation: DQuat,
    pub forces: [f64; BodyPart::ALL.len()],
    pub port_m: [f64; BodyPart::ALL.len()],
}

/// Every clip of the shipped library.
pub fn clips() -> Vec<Clip> {
    library().acts.iter().flat_map(|act| act.clips.iter().cloned()).collect()
}

impl Flight {
    /// A whale of 13.7 m at cruise, with all the library's acts and the named one as its answer to touch.
    pub fn new(answer: Option<&str>) -> Self {
        let clips = clips();
        let answers = answer.map(|id| Answers {
            first: clips.iter().position(|clip| clip.id == id).map(|at| 1 + at),
            above_n: 1.0,
            again_s: f64::INFINITY,
            drawn: None,
        });
        let acting = Acting::new(Arc::new(Swim::new()), clips, answers);
        let descriptor = acting.descriptor();
        Self {
            attributes: descriptor
                .attributes
                .iter()
                .map(|attribute| attribute.default_value().number().unwrap())
                .collect(),
            state: vec![0.0; descriptor.state_len],
            acting,
            dt_s: 0.01,
            length_m: 13.7,
            time_s: 0.0,
            speed_m_s: 1.23,
            orientation: DQuat::IDENTITY,
            forces: [0.0; BodyPart::ALL.len()],
            port_m: [0.0; BodyPart::ALL.len()],
        }
    }

    /// Sets an attribute of the swim.
    pub fn set(&mut self, key: &str, value: f64) {
        let index = self
            .acting
            .descriptor()
            .attributes
            .iter()
            .position(|attribute| attribute.key == key)
            .unwrap();
        self.attributes[index] = value;
    }

    /// The number of an act by its id; 0 for the empty id.
    pub fn act(&self, id: &str) -> f64 {
        if id.is_empty() {
            return 0.0;
        }
        let acts = &self.acting.descriptor().acts;
        1.0 + acts.iter().position(|act| act.id == id).unwrap_or_else(|| panic!("no act {id}"))
            as f64
    }

    /// One step.
    pub fn step(&mut self, controls: Controls) -> MotionOutput {
        let input = MotionInput {
            time_s: self.time_s,
            dt_s: self.dt_s,
            length_m: self.length_m,
            speed_m_s: self.speed_m_s,
            position_m: [0.0; 3],
            orientation: self.orientation.to_array(),
            controls,
            contact_force_n: &self.forces,
            contact_port_m: &self.port_m,
            thrust_speed_m_s: None,
        };
        let out = self.acting.step(&self.attributes, &input, &mut self.state).unwrap();
        self.orientation = (self.orientation
            * DQuat::from_scaled_axis(DVec3::from_array(out.turn_rate_rad_s) * self.dt_s))
        .normalize();
        self.speed_m_s = out.speed_m_s;
        self.time_s += self.dt_s;
        out
    }

    /// Asks for an act at cruise for a time; every step.
    pub fn play(&mut self, id: &str, seconds: f64) -> Vec<MotionOutput> {
        let controls = Controls { speed: 1.0, act: self.act(id), ..Controls::default() };
        (0..(seconds / self.dt_s).round() as usize).map(|_| self.step(controls)).collect()
    }

    /// Heading, bank and climb now [degrees].
    pub fn attitude(&self) -> [f64; 3] {
        attitude(self.orientation).map(f64::to_degrees)
    }
}
