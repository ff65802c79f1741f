//! The whale of a model.

use std::sync::Arc;

use endline_sdk::{Posture, WhaleMotion};
use glam::{DQuat, DVec3};

use super::pilot::PilotProgram;
use crate::whale::jaws::JawStrength;
use crate::whale::joints::JointRanges;
use crate::whale::kinetic::Kinetic;
use crate::whale::measures::Measures;
use crate::whale::skin::Skin;

/// A whale in a model.
#[derive(Clone)]
pub struct Whale {
    /// Its body.
    pub skin: Arc<Skin>,
    /// How far its joints turn; a motion's posture is held within.
    pub joints: JointRanges,
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Mass, volume, wetted area, centre of mass and inertia at rest.
    pub measures: Measures,
    /// Greatest speed it can swim [m/s].
    pub burst_speed_m_s: f64,
    /// Start place of the whale frame's origin [m].
    pub position_m: DVec3,
    /// Start orientation, whale to world.
    pub orientation: DQuat,
    /// Start speed through the water [m/s].
    pub speed_m_s: f64,
    /// Its way of moving.
    pub motion: Arc<dyn WhaleMotion>,
    /// Attributes of the motion, SI, in the declared order.
    pub motion_attributes: Vec<f64>,
    /// Controls where no pilot flies.
    pub pilot: PilotProgram,
    /// Stiffness of skin and blubber under rope, per metre of rope [N/m²].
    pub contact_stiffness_n_m2: f64,
    /// How strongly its mouth closes; `None` where it closes whatever lies between.
    pub jaws: Option<JawStrength>,
    /// What makes it kinetic; `None` where it goes as its motion says, whatever the rope does.
    pub kinetic: Option<Kinetic>,
}

impl Whale {
    /// Joint angles it starts with.
    #[must_use]
    pub fn start_posture(&self) -> Posture {
        let dead = self.kinetic.as_ref().and_then(|kinetic| kinetic.dead.as_ref());
        dead.map_or_else(Posture::default, |dead| dead.posture)
    }
}
