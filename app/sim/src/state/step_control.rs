//! State of the step control, stored from step to step.

use crate::bits::clone_in_place;

/// The criterion that limited a solver step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LimitedBy {
    /// The step between inputs.
    #[default]
    Inputs,
    /// Error of position.
    Accuracy,
    /// Error of tension, where it changes rapidly.
    Snap,
    /// Rope near the whale.
    Contact,
    /// A rope or link that is about to part or has just parted.
    Parting,
    /// Convergence, reached with a shorter step only.
    Convergence,
}

impl LimitedBy {
    /// All criteria, in the order of their numbers.
    pub const ALL: [Self; 6] =
        [Self::Inputs, Self::Accuracy, Self::Snap, Self::Contact, Self::Parting, Self::Convergence];

    /// Name, a key of the summary.
    pub fn name(self) -> &'static str {
        ["inputs", "accuracy", "snap", "contact", "parting", "convergence"][self as usize]
    }

    /// Returns the criterion that limited most steps, and their number.
    pub fn mostly(counts: &[u64; Self::ALL.len()]) -> (Self, u64) {
        Self::ALL
            .into_iter()
            .zip(*counts)
            .fold((Self::Inputs, 0), |most, next| if next.1 > most.1 { next } else { most })
    }

    /// Description for reports.
    pub fn words(self) -> &'static str {
        match self {
            Self::Inputs => "the step between inputs only",
            Self::Accuracy => "acceleration of rope and bodies",
            Self::Snap => "rapid change of tension",
            Self::Contact => "rope near the whale",
            Self::Parting => "rope or links that part",
            Self::Convergence => "forces that converge only in a shorter step",
        }
    }
}

/// State of the step control; part of the state so that a run can be replayed.
#[derive(Debug, Default, PartialEq)]
pub struct StepControl {
    /// Length of the next solver step, if nothing else limits it [s]; zero before the first choice.
    pub step_s: f64,
    /// Criterion that limits it.
    pub limit: LimitedBy,
    /// Length of the next solver step where rope may touch the whale [s]; zero before the first choice.
    pub contact_step_s: f64,
    /// Greatest tension of each line after the last two solver steps, the later one first [N].
    pub tension_n: Vec<[f64; 2]>,
    /// Number of valid entries in each pair.
    pub known: u32,
    /// Number of steps of the model, up to the last, at whose end each gear stood still.
    pub still_steps: Vec<u32>,
}

clone_in_place!(StepControl { step_s, limit, contact_step_s, tension_n, known, still_steps });

impl StepControl {
    /// Initial state for a model with this number of lines and gears.
    pub(crate) fn new(lines: usize, gears: usize) -> Self {
        Self {
            step_s: 0.0,
            limit: LimitedBy::Inputs,
            contact_step_s: 0.0,
            tension_n: vec![[0.0; 2]; lines],
            known: 0,
            still_steps: vec![0; gears],
        }
    }

    /// Whether free rope takes the next step with the two-stage scheme.
    pub(crate) fn in_two_stages(&self) -> bool {
        self.step_s > 0.0 && matches!(self.limit, LimitedBy::Accuracy | LimitedBy::Snap)
    }

    /// Restarts the step control with this step.
    pub(crate) fn restart(&mut self, step_s: f64, limit: LimitedBy) {
        (self.step_s, self.limit, self.known) = (step_s, limit, 0);
    }
}
