//! Scratch of a run, and the results of its last step for readers.

use super::audit::Audit;
use super::moving::{Choice, Moving};
use super::peaks::{SpikeWatch, raise};
use super::stages::Stages;
use crate::balance::Balance;
use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::contact::body_on_skin::sums::BodySums;
use crate::contact::rope_on_rope::RopeTouch;
use crate::contact::rope_on_skin::step_sums::StepSums;
use crate::cost::{Clock, Cost};
use crate::gear_hook::GearWorkspace;
use crate::model::Model;
use crate::remesh::RemeshWorkspace;
use crate::solver::Solver;
use crate::state::{State, WhaleState};
use crate::whale::drive::DriveScratch;
use crate::whale::jaws::MouthLoad;
use crate::whale::kinetic::RopeImpulse;

/// Scratch of the solver, and the results of the last step for readers; dropping it between two steps changes no bit.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Places where rope pressed on skin at the end of the last step.
    pub contacts: Vec<ContactPoint>,
    /// Greatest tension of each segment over the solver steps of the last step that converged; zero where none did [N].
    pub peak_tension_n: Vec<f64>,
    /// Greatest tension of each segment over the solver steps that did not converge; zero if all did [N].
    pub unconverged_peak_n: Vec<f64>,
    pub(super) spikes: SpikeWatch,
    /// Forces of rope on skin, summed over the solver steps of the last step.
    pub sums: StepSums,
    /// Places where bodies pressed on skin at the end of the last step.
    pub body_contacts: Vec<BodyContact>,
    /// Forces of bodies on skin, summed over the solver steps of the last step.
    pub body_sums: BodySums,
    /// Load that opens a mouth which closes with a limited strength.
    pub(super) mouth: Option<MouthLoad>,
    /// Places where rope pressed on rope at the end of the last step.
    pub rope_touches: Vec<RopeTouch>,
    /// Counters of the run so far.
    pub audit: Audit,
    /// Momentum and energy of the gear so far, if the model asks for them ([`Settings::balance`](crate::model::Settings::balance)).
    pub balance: Balance,
    pub(crate) solver: Solver,
    pub(super) before: Option<State>,
    pub(super) stages: Stages,
    pub(super) gear: GearWorkspace,
    pub(super) remesh: Option<RemeshWorkspace>,
    /// The whale at the start and at the end of the step.
    pub(super) whale: Option<Box<[WhaleState; 2]>>,
    /// Scratch for the motion of the whale.
    pub(super) drive: DriveScratch,
    /// Impulse of rope on the whale over the solver steps of the step.
    pub(super) pulled: RopeImpulse,
    /// The choice of the gears in the step, of several.
    pub(super) choice: Choice,
    /// The gears in the step, if others are held.
    pub(super) moving: Option<Box<Moving>>,
}

impl Workspace {
    /// Scratch for a model.
    pub fn new(model: &Model) -> Self {
        Self {
            contacts: Vec::new(),
            sums: StepSums::default(),
            peak_tension_n: vec![0.0; model.segment_count],
            unconverged_peak_n: vec![0.0; model.segment_count],
            spikes: SpikeWatch::new(model),
            body_contacts: Vec::new(),
            body_sums: BodySums::new(model.spec.bodies.len()),
            mouth: mouth_of(model),
            rope_touches: Vec::new(),
            audit: Audit::default(),
            balance: Balance::default(),
            solver: Solver::new(model),
            before: None,
            stages: Stages::new(model),
            gear: GearWorkspace::default(),
            remesh: RemeshWorkspace::new(model),
            whale: None,
            drive: DriveScratch::new(model),
            pulled: RopeImpulse::default(),
            choice: Choice::default(),
            moving: None,
        }
    }

    /// Clears the results of the last step.
    pub(super) fn begin_step(&mut self) {
        self.peak_tension_n.fill(0.0);
        self.unconverged_peak_n.fill(0.0);
        self.contacts.clear();
        self.body_contacts.clear();
        self.body_sums.clear();
        self.sums = StepSums::default();
        self.mouth.iter_mut().for_each(MouthLoad::clear);
        self.pulled = RopeImpulse::default();
    }

    /// Drops the scratch of steps in which some gear was held.
    pub(super) fn leave_moving(&mut self, model: &Model) {
        if self.moving.take().is_some() {
            self.spikes = SpikeWatch::new(model);
        }
    }

    /// Records the tensions at the end of a solver step [N].
    pub(super) fn take_tensions(&mut self, model: &Model, tension_n: &[f64], converged: bool) {
        let peaks_n =
            if converged { &mut self.peak_tension_n } else { &mut self.unconverged_peak_n };
        raise(peaks_n, tension_n);
        self.audit.spikes += self.spikes.take(model, tension_n);
    }

    /// Sets the clock with which steps measure their computing time; no result depends on it.
    pub fn lend_clock(&mut self, clock: Clock) {
        self.solver.cost.clock = Some(clock);
    }

    /// Computing time of the last step by part; zero without a clock.
    pub fn cost(&self) -> &Cost {
        &self.solver.cost.cost
    }
}

fn mouth_of(model: &Model) -> Option<MouthLoad> {
    let whale = model.spec.whale.as_ref().filter(|whale| whale.jaws.is_some())?;
    Some(MouthLoad::new(&whale.skin))
}
