//! The implicit solver: Newton's method on the balance of forces of a solver step.
//!
//! Newton on `M (v - v̂)/h = F(x, v)` with `v = (x - x̂)/h` (`trial/scheme.rs`): each iteration assembles forces (`forces`), contact
//! (`contact`) and their derivatives at the trial places into the linear system (`system`), solves it, and moves the trial.
//!
//! | file | subject |
//! |---|---|
//! | `step.rs` | begin, assemble, solve, move and store a step |
//! | `newton.rs` | the iterations of a step |
//! | `stopping.rs` | convergence and the number of iterations |
//! | `lanes.rs` | an iteration with rope held as lanes |
//! | `statics.rs`, `line_search.rs` | what statics needs besides |

mod lanes;
mod line_search;
pub(crate) mod newton;
mod statics;
mod step;
pub(crate) mod stopping;
#[cfg(test)]
pub(crate) mod tests;

use glam::{DMat3, DVec3};

use crate::contact::Contacts;
use crate::cost::CostClock;
use crate::forces::Forces;
use crate::model::Model;
use crate::system::LinearSystem;
use crate::system::interface::InterfaceSystem;
use crate::trial::plan::Plan;
use crate::trial::{BodyTrial, Trial};
use crate::whale::hitch::Hitches;
pub(crate) use newton::{NewtonEnd, Solved};
pub(crate) use statics::{WorstAt, is_laid};
pub(crate) use step::SkinTouches;

/// Scratch of the solver for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Solver {
    pub plan: Plan,
    pub trial: Trial,
    pub contacts: Contacts,
    /// What the computing time of the step is spent on.
    pub cost: CostClock,
    forces: Forces,
    pub(crate) system: LinearSystem,
    linear_part: LinearPart,
    /// Whether anything may touch in the step.
    in_contact: bool,
    /// Whether rope may touch the seabed in a step with rope held as lanes.
    near_seabed: bool,
    /// Rope and bodies before a move.
    before: Vec<DVec3>,
    bodies_before: Vec<BodyTrial>,
}

/// Forces and blocks that the line search of statics treats as linear.
#[derive(Clone, Debug, Default)]
struct LinearPart {
    diagonal: Vec<DMat3>,
    force: Vec<DVec3>,
    interface: InterfaceSystem,
}

/// Tolerances for a small rig or short segments, below the usual ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Move of the last iteration [m].
    pub move_m: f64,
    /// Difference between solved and true tension [N].
    pub gap_n: f64,
}

/// Move of the last iteration, as a share of the shortest segment.
const FINE_MOVE_SHARE: f64 = 0.02;
/// Difference of tension, as a share of the weight of all gear.
const FINE_GAP_SHARE: f64 = 0.02;

impl Solver {
    /// Scratch for a model.
    pub fn new(model: &Model) -> Self {
        let plan = Plan::new(model);
        let system = LinearSystem::new(model, &plan);
        Self {
            linear_part: LinearPart {
                interface: system.interface.clone(),
                ..LinearPart::default()
            },
            trial: Trial { hitches: Hitches::new(model), ..Trial::default() },
            contacts: Contacts::new(model),
            cost: CostClock::default(),
            forces: Forces::new(model),
            system,
            plan,
            in_contact: false,
            near_seabed: false,
            before: Vec::new(),
            bodies_before: Vec::new(),
        }
    }

    /// The tolerances for this gear.
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance {
            move_m: FINE_MOVE_SHARE * self.forces.lengths.shortest,
            gap_n: FINE_GAP_SHARE * self.plan.weight_n,
        }
    }
}
