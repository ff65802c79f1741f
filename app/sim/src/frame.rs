//! Frames: snapshots of a state for display and export, independent of the solver.

use endline_sdk::Posture;
use glam::{DQuat, DVec3};

use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::state::State;
use crate::whale::Exertion;

/// A snapshot of a run at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Simulated time [s].
    pub time_s: f64,
    /// Number of steps taken.
    pub step: u64,
    /// Position of each node, in the model's layout [m].
    pub nodes: Vec<DVec3>,
    /// Unstretched length of each segment [m].
    pub segment_length_m: Vec<f64>,
    /// Tension of each segment, zero where it is slack [N].
    pub tension_n: Vec<f64>,
    /// Whether each segment is cut.
    pub cut: Vec<bool>,
    /// Position and orientation of each body.
    pub bodies: Vec<(DVec3, DQuat)>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleFrame>,
    /// Contacts of rope with skin.
    pub contacts: Vec<ContactPoint>,
    /// Contacts of bodies with skin.
    pub body_contacts: Vec<BodyContact>,
}

/// The whale in a [`Frame`].
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleFrame {
    /// Position of the whale frame's origin [m].
    pub position: DVec3,
    /// Orientation, whale to world.
    pub orientation: DQuat,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Joint angles.
    pub posture: Posture,
    /// Effort of the whale and forces on it.
    pub exertion: Exertion,
}

impl Frame {
    /// A snapshot of a state with the contacts of its last step.
    pub fn of(state: &State, contacts: &[ContactPoint], body_contacts: &[BodyContact]) -> Self {
        Self {
            time_s: state.time_s,
            step: state.step,
            nodes: state.rope.position.clone(),
            segment_length_m: state.rope.segment_length.clone(),
            tension_n: state.rope.tension.iter().map(|tension| tension.max(0.0)).collect(),
            cut: state.rope.cut.clone(),
            bodies: state.bodies.iter().map(|body| (body.position, body.orientation)).collect(),
            whale: state.whale.as_ref().map(|whale| WhaleFrame {
                position: whale.position,
                orientation: whale.orientation,
                speed_m_s: whale.speed_m_s,
                posture: whale.posture,
                exertion: whale.exertion,
            }),
            contacts: contacts.to_vec(),
            body_contacts: body_contacts.to_vec(),
        }
    }
}
