//! What the choice of solver steps keeps from step to step.

use crate::in_place::clone_in_place;

/// What kept a solver step from being longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LimitedBy {
    /// Nothing but the rhythm of inputs.
    #[default]
    Inputs,
    /// Error of place.
    Accuracy,
    /// Error of tension: it rises or falls fast.
    Snap,
    /// Rope near the whale.
    Contact,
    /// Something about to part, or just parted.
    Parting,
    /// A balance of forces was found at a shorter step only.
    Convergence,
}

impl LimitedBy {
    /// Every limit, in the order of its number.
    pub const ALL: [Self; 6] =
        [Self::Inputs, Self::Accuracy, Self::Snap, Self::Contact, Self::Parting, Self::Convergence];

    /// Its name, as key of the summary.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["inputs", "accuracy", "snap", "contact", "parting", "convergence"][self as usize]
    }

    /// What limited most of the steps counted, and how many of them.
    #[must_use]
    pub fn mostly(counts: &[u64; Self::ALL.len()]) -> (Self, u64) {
        Self::ALL
            .into_iter()
            .zip(*counts)
            .fold((Self::Inputs, 0), |most, next| if next.1 > most.1 { next } else { most })
    }

    /// A description in plain words, for reports.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Inputs => "nothing but the step between inputs",
            Self::Accuracy => "how fast rope and bodies swerve",
            Self::Snap => "tension that rises or falls fast",
            Self::Contact => "rope near the whale",
            Self::Parting => "rope or links that part",
            Self::Convergence => "forces that balance only in a shorter step",
        }
    }
}

/// Where the choice of steps stands; part of the state, so that a run replays.
#[derive(Debug, Default, PartialEq)]
pub struct StepControl {
    /// Length of the next solver step, if nothing else limits it [s]; zero where none is chosen yet.
    pub step_s: f64,
    /// What limits it.
    pub limit: LimitedBy,
    /// Length of the next solver step where rope may touch the whale [s]; zero where none is chosen yet.
    pub contact_step_s: f64,
    /// Greatest tension of each line after the last two solver steps, the later one first [N].
    pub tension_n: Vec<[f64; 2]>,
    /// How many of the two are known.
    pub known: u32,
}

clone_in_place!(StepControl { step_s, limit, contact_step_s, tension_n, known });

impl StepControl {
    /// Nothing chosen yet, for a model of so many lines.
    pub(crate) fn new(lines: usize) -> Self {
        Self {
            step_s: 0.0,
            limit: LimitedBy::Inputs,
            contact_step_s: 0.0,
            tension_n: vec![[0.0; 2]; lines],
            known: 0,
        }
    }

    /// Whether free rope takes the next step in two stages.
    pub(crate) fn in_two_stages(&self) -> bool {
        self.step_s > 0.0 && matches!(self.limit, LimitedBy::Accuracy | LimitedBy::Snap)
    }

    /// Begins anew with this step.
    pub(crate) fn restart(&mut self, step_s: f64, limit: LimitedBy) {
        (self.step_s, self.limit, self.known) = (step_s, limit, 0);
    }
}
