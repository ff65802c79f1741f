//! Force laws of rope, bodies, water and seabed, each with its contribution to the linear system.

pub(crate) mod axial;
pub(crate) mod bending;
pub(crate) mod body;
pub(crate) mod laws;
pub(crate) mod pulled;
pub(crate) mod rope;
pub(crate) mod seabed;
pub(crate) mod suction;
pub(crate) mod tilt;
pub(crate) mod water;

use glam::DVec3;

use crate::model::Model;
use crate::trial::Trial;
use rope::{Lengths, Pull};
use water::WaterAtGear;

/// What the force laws of a step read, and the axial law of each segment as last evaluated.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    pub lengths: Lengths,
    /// Axial law of each segment at the trial places of the last assembly.
    pub pull: Vec<Pull>,
    /// Whether each segment is cut.
    pub cut: Vec<bool>,
    /// Factor on the pseudo-mass of each line in anchored iterations of statics.
    pub pseudo_mass_scale: Vec<f64>,
    pub water: WaterAtGear,
    /// Scratch: nodes at which a change of the segments that pull changed forces.
    changed: Vec<bool>,
}

impl Forces {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        Self {
            lengths: Lengths::default(),
            pull: vec![Pull::default(); model.segment_count],
            cut: vec![false; model.segment_count],
            pseudo_mass_scale: vec![1.0; model.spec.lines.len()],
            water: WaterAtGear::new(model.node_count),
            changed: Vec::new(),
        }
    }

    /// Pull of a line on its end node `tip`: the solved tension of the end segment, toward its other node `inner` [N].
    pub fn pull_at(&self, trial: &Trial, [tip, inner, segment]: [usize; 3]) -> DVec3 {
        if self.cut[segment] {
            return DVec3::ZERO;
        }
        let along = trial.place[inner] - trial.place[tip];
        along.normalize_or_zero() * trial.tension[segment].max(0.0)
    }
}
