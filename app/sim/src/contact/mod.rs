//! Contact: rope and bodies on the whale, on each other and on obstacles.
//!
//! Each kind of contact is one folder and implements [`ContactKind`], one method for each stage of a solver step.
//! [`Contacts`] owns the kinds in a fixed order and runs each stage over all of them; the solver calls only these loops.
//!
//! | stage | method |
//! |---|---|
//! | find what may touch in the step | [`find`](ContactKind::find) |
//! | move the predictor out of contact | [`project_guess`](ContactKind::project_guess) |
//! | open contact points | [`open`](ContactKind::open), [`open_more`](ContactKind::open_more) |
//! | evaluate gap, normal force and friction | [`measure`](ContactKind::measure) |
//! | add to the linear system | [`assemble_on_rope`](ContactKind::assemble_on_rope), [`assemble_on_bodies`](ContactKind::assemble_on_bodies) |
//! | store the forces of the solution | [`store_solution`](ContactKind::store_solution), [`store_iteration`](ContactKind::store_iteration) |
//! | error of those forces | [`error`](ContactKind::error) |
//! | check the path of the step | [`check_path`](ContactKind::check_path) |
//! | accept the step | [`accept`](ContactKind::accept), [`store`](ContactKind::store) |
//! | forces of each source, for the balance | [`source_forces`](ContactKind::source_forces) |
//!
//! The order of the kinds and of [`Order`] is the order of the sums in the matrix. To change it changes the last bits of every run.

pub mod body_on_body;
pub mod body_on_skin;
pub(crate) mod failure;
pub(crate) mod law;
mod near_whale;
pub mod rope_on_rope;
pub mod rope_on_skin;
pub mod rope_on_solid;

pub use body_on_body::bodies_touching;

use endline_sdk::Region;
use glam::DVec3;

use crate::balance::source_forces::SourceForces;
use crate::broad_phase::pieces::Pieces;
use crate::cost::{CostClock, CostPart};
use crate::model::Model;
use crate::state::{RopeState, State};
use crate::system::LinearSystem;
use crate::trial::plan::Plan;
use crate::trial::scheme::Scheme;
use crate::trial::{BodyTrial, StepContext, Trial};
use crate::whale::drive::EndPose;
use body_on_body::BodyOnBody;
use body_on_skin::{BodyContact, BodyOnSkin};
use failure::{ContactFailure, Kind};
use rope_on_rope::RopeTouch;
use rope_on_rope::near::RopeOnRope;
use rope_on_skin::RopeOnSkin;
use rope_on_solid::RopeOnSolid;

/// One place where rope presses on skin, at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPoint {
    /// Index of the line.
    pub line: usize,
    /// Index of the segment in the model's layout.
    pub segment: usize,
    /// Where on the segment, 0 at its first node, 1 at its second.
    pub fraction: f64,
    /// Index of the skin triangle.
    pub triangle: usize,
    /// Barycentric place on the triangle.
    pub barycentric: [f64; 3],
    /// Region of the triangle.
    pub region: Region,
    /// Place on the rope's centre line [m].
    pub position: DVec3,
    /// Unit normal from skin to rope.
    pub normal: DVec3,
    /// Distance of the centre line from the skin [m].
    pub distance_m: f64,
    /// Length of rope that it represents [m].
    pub length_m: f64,
    /// Whether it is a knot, splice or link that presses.
    pub is_knot: bool,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Friction force of skin on rope [N].
    pub friction_n: DVec3,
    /// Slip of rope over skin in the last solver step [m].
    pub slip_m: DVec3,
    /// Length of that solver step [s].
    pub dt_s: f64,
}

/// Tolerance divisor of rope on rope and rope on obstacles: residual error makes elastic grips drift.
pub(crate) const GRIP_STRICTER: f64 = 10.0;
/// Tolerance divisor of rope on bodies of the rig: rope and body respond to each other from iteration to iteration, and their
/// difference is lost momentum.
pub(crate) const ANSWER_STRICTER: f64 = 100.0;

/// Error of contact after an iteration.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactError {
    /// Greatest difference between the force that was solved for and the force by the law at the trial [N].
    pub gap_n: f64,
    /// Greatest force of a contact [N].
    pub greatest_n: f64,
}

impl ContactError {
    /// The larger of two errors.
    pub fn and(self, other: Self) -> Self {
        Self {
            gap_n: self.gap_n.max(other.gap_n),
            greatest_n: self.greatest_n.max(other.greatest_n),
        }
    }
}

/// What the search for contact reads at the start of a solver step.
pub(crate) struct Search<'a> {
    pub model: &'a Model,
    pub state: &'a State,
    /// Rope in pieces, measured over the step.
    pub pieces: &'a Pieces,
    /// Length of the solver step [s].
    pub dt: f64,
    /// Share of the model's step at which the solver step ends.
    pub goal: f64,
}

/// Length of the step from which on the search has its whole margin [s], and the least share of the margin in shorter steps. Where
/// Newton's method moves rope so far that it may have left the margin, the search is repeated ([`Contacts::find_more`]).
const WHOLE_MARGIN_S: f64 = 0.01;
const LEAST_MARGIN_SHARE: f64 = 0.2;

impl Search<'_> {
    /// Margin of the search beyond contact in this step [m]; `whole_m` is that of long steps.
    pub fn margin_m(&self, whole_m: f64) -> f64 {
        whole_m * (self.dt / WHOLE_MARGIN_S).clamp(LEAST_MARGIN_SHARE, 1.0)
    }
}

/// How a contact point is judged to press.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ActiveSet {
    /// By the normal force that the last solution predicted.
    Predicted,
    /// By its depth at the trial.
    AtTrial,
}

/// When a kind adds to the linear system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// Before tension, bending and the forces on bodies.
    First,
    /// After them.
    Last,
}

/// What contact reads as it adds to the linear system.
#[derive(Clone, Copy)]
pub(crate) struct Assembly<'a> {
    pub context: StepContext<'a>,
    pub plan: &'a Plan,
    pub trial: &'a Trial,
    pub active_set: ActiveSet,
}

/// A solution of the linear system.
#[derive(Clone, Copy)]
pub(crate) enum Solution<'a> {
    /// The solved step, of which a share is taken next.
    Step { system: &'a LinearSystem, plan: &'a Plan, share: f64 },
    /// The trial has moved from these places, by this share of the solved step.
    Moved { rope: &'a [DVec3], bodies: &'a [BodyTrial], share: f64 },
}

/// A step that is accepted.
#[derive(Clone, Copy)]
pub(crate) struct Accepted<'a> {
    pub model: &'a Model,
    pub scheme: &'a Scheme,
    pub trial: &'a Trial,
    /// Whether rope is held as lanes, where the trial has its places only if rope touched something.
    pub in_lanes: bool,
}

/// Lists of contact at the end of an accepted step, for readers.
pub(crate) struct Reports<'a> {
    pub rope_on_skin: &'a mut Vec<ContactPoint>,
    pub body_on_skin: &'a mut Vec<BodyContact>,
    pub rope_on_rope: &'a mut Vec<RopeTouch>,
}

/// One kind of contact: its workspace, which keeps nothing that a step depends on, and one method for each stage of a solver step.
pub(crate) trait ContactKind {
    /// Its name.
    fn kind(&self) -> Kind;

    /// Finds what may touch in a solver step.
    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure>;

    /// Whether anything may touch in the solver step.
    fn is_touching(&self) -> bool;

    /// Whether it may add forces on rope in the solver step, other than couplings of rope on rope.
    fn adds_on_rope(&self) -> bool {
        false
    }

    /// Whether [`check_path`](Self::check_path) reads the places of rope; rope held as lanes is then copied to the trial.
    fn checks_path_of_rope(&self) -> bool {
        false
    }

    /// Adds the pairs of bodies that the linear system must couple.
    fn add_couplings(&self, _coupled: &mut Vec<[usize; 2]>) {}

    /// Moves the predictor of a step out of contact.
    fn project_guess(&self, _state: &State, _trial: &mut Trial) {}

    /// Opens contact points at the predictor.
    fn open(&mut self, _context: &StepContext<'_>, _trial: &Trial) {}

    /// Opens contact points where rope is closer now than at its contact points; returns whether there were any.
    fn open_more(&mut self, _context: &StepContext<'_>, _trial: &Trial) -> bool {
        false
    }

    /// Evaluates contact at the trial.
    fn measure(
        &mut self,
        _context: &StepContext<'_>,
        _trial: &Trial,
        _cost: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        Ok(())
    }

    /// Begins an iteration at the trial.
    fn begin_iteration(&mut self, _context: &StepContext<'_>, _trial: &Trial) {}

    /// Adds forces on rope and their blocks.
    fn assemble_on_rope(
        &mut self,
        _order: Order,
        _assembly: &Assembly<'_>,
        _system: &mut LinearSystem,
    ) {
    }

    /// Adds forces on bodies and their blocks.
    fn assemble_on_bodies(
        &self,
        _order: Order,
        _assembly: &Assembly<'_>,
        _system: &mut LinearSystem,
    ) {
    }

    /// Stores the forces of a solution, before the trial moves if rope is held as lines.
    fn store_solution(&mut self, _trial: &Trial, _solution: &Solution<'_>) {}

    /// Difference between the normal force of the last solution and the law, where an iteration solves again without a new evaluation.
    fn law_error(&self, _trial: &Trial) -> ContactError {
        ContactError::default()
    }

    /// Makes the normal force linear about that of the last solution.
    fn linearise_at_solution(&mut self, _trial: &Trial) {}

    /// Stores the forces of the last solution of an iteration.
    fn store_iteration(&mut self, _trial: &Trial) {}

    /// Error of the forces of the last iteration at the trial.
    fn error(&mut self, context: &StepContext<'_>, trial: &Trial) -> ContactError;

    /// Checks the straight path from the start of the step to the trial; returns the number of crossings that an exact test finds.
    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure>;

    /// Returns to the start of a rejected solver step.
    fn reject(&mut self) {}

    /// Advances friction by an accepted step, and reports contact. The state still holds the places at the start of the step.
    fn accept(
        &mut self,
        _accepted: &Accepted<'_>,
        _state: &mut State,
        _reports: &mut Reports<'_>,
    ) -> Result<(), ContactFailure> {
        Ok(())
    }

    /// Writes elastic grips into the state, which still holds the places at the start of the step.
    fn store(&self, _accepted: &Accepted<'_>, _state: &mut State) {}

    /// Adds the forces of contact to those of each source.
    fn source_forces(&self, _sources: &mut SourceForces<'_>) {}
}

/// All kinds of contact of one model.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    /// Rope on the whale's skin, in a model with a whale.
    pub rope_on_skin: Option<RopeOnSkin>,
    /// Bodies on the whale's skin, in a model with both.
    pub body_on_skin: Option<Box<BodyOnSkin>>,
    /// Rope on obstacles and bodies.
    pub rope_on_solid: RopeOnSolid,
    /// Rope on rope.
    pub rope_on_rope: RopeOnRope,
    /// Bodies on each other and on obstacles.
    pub body_on_body: BodyOnBody,
    /// Rope in pieces, measured over the step.
    pub pieces: Pieces,
    /// Bones of the whale at the start and the end of the model's step.
    pub poses: [EndPose; 2],
    /// Pairs of bodies that may touch in the solver step.
    coupled: Vec<[usize; 2]>,
}

impl Contacts {
    /// Workspaces for a model.
    pub fn new(model: &Model) -> Self {
        Self {
            rope_on_skin: RopeOnSkin::new(model),
            body_on_skin: BodyOnSkin::new(model).map(Box::new),
            rope_on_solid: RopeOnSolid::new(model),
            rope_on_rope: RopeOnRope::new(model),
            body_on_body: BodyOnBody::new(model),
            pieces: Pieces::new(model),
            poses: Default::default(),
            coupled: Vec::new(),
        }
    }

    /// The kinds, in the order of the sums.
    fn kinds(&self) -> impl Iterator<Item = &dyn ContactKind> {
        let Self { rope_on_skin, body_on_skin, rope_on_solid, rope_on_rope, body_on_body, .. } =
            self;
        [
            rope_on_skin.as_ref().map(|kind| kind as &dyn ContactKind),
            body_on_skin.as_deref().map(|kind| kind as &dyn ContactKind),
            Some(rope_on_solid),
            Some(rope_on_rope),
            Some(body_on_body),
        ]
        .into_iter()
        .flatten()
    }

    /// The kinds, to be changed.
    fn kinds_mut(&mut self) -> impl Iterator<Item = &mut dyn ContactKind> {
        let Self { rope_on_skin, body_on_skin, rope_on_solid, rope_on_rope, body_on_body, .. } =
            self;
        [
            rope_on_skin.as_mut().map(|kind| kind as &mut dyn ContactKind),
            body_on_skin.as_deref_mut().map(|kind| kind as &mut dyn ContactKind),
            Some(rope_on_solid),
            Some(rope_on_rope),
            Some(body_on_body),
        ]
        .into_iter()
        .flatten()
    }

    /// Finds what may touch in a solver step of length `dt` that ends at the share `goal` of the model's step.
    pub fn find(
        &mut self,
        model: &Model,
        state: &State,
        dt: f64,
        goal: f64,
    ) -> Result<(), ContactFailure> {
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.measure_drift(state, dt);
        let search = Search { model, state, pieces: &pieces, dt, goal };
        let found = self.kinds_mut().try_for_each(|kind| kind.find(&search));
        self.pieces = pieces;
        found
    }

    /// Finds rope on solids at the trial of an iteration of statics.
    pub fn find_at_rest(&mut self, state: &State, trial: &Trial) {
        let poses = trial.bodies.iter().map(BodyTrial::pose);
        self.rope_on_solid.gather_at_rest(state, &mut self.pieces, &trial.place, poses);
    }

    /// Whether anything may touch in the solver step.
    pub fn is_touching(&self) -> bool {
        self.kinds().any(ContactKind::is_touching)
    }

    /// Whether rope may touch skin in the solver step.
    pub fn rope_touches_skin(&self) -> bool {
        self.rope_on_skin.as_ref().is_some_and(|kind| kind.touching)
    }

    /// Whether anything but rope on rope may touch in the solver step.
    pub fn is_touching_besides_ropes(&self) -> bool {
        self.kinds().any(|kind| kind.kind() != Kind::RopeOnRope && kind.is_touching())
    }

    /// Whether any kind may add forces on rope in the solver step, other than couplings of rope on rope.
    pub fn adds_on_rope(&self) -> bool {
        self.kinds().any(ContactKind::adds_on_rope)
    }

    /// Whether the check of paths reads the places of rope.
    pub fn checks_path_of_rope(&self) -> bool {
        self.kinds().any(ContactKind::checks_path_of_rope)
    }

    /// Pairs of bodies that the linear system must couple in the solver step.
    pub fn coupled(&mut self) -> &[[usize; 2]] {
        let mut coupled = std::mem::take(&mut self.coupled);
        coupled.clear();
        self.kinds().for_each(|kind| kind.add_couplings(&mut coupled));
        self.coupled = coupled;
        &self.coupled
    }

    /// Moves the predictor of a step out of contact.
    pub fn project_guess(&self, state: &State, trial: &mut Trial) {
        self.kinds().for_each(|kind| kind.project_guess(state, trial));
    }

    /// Opens contact points at the predictor.
    pub fn open(&mut self, context: &StepContext<'_>, trial: &Trial) {
        self.kinds_mut().for_each(|kind| kind.open(context, trial));
    }

    /// Opens contact points where rope is closer now than at its contact points; returns whether there were any.
    pub fn open_more(&mut self, context: &StepContext<'_>, trial: &Trial) -> bool {
        let mut opened = false;
        for kind in self.kinds_mut() {
            opened |= kind.open_more(context, trial);
        }
        opened
    }

    /// Evaluates contact at the trial.
    pub fn measure(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
        cost: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        self.kinds_mut().try_for_each(|kind| kind.measure(context, trial, cost))?;
        cost.enter(CostPart::Contact);
        Ok(())
    }

    /// Begins an iteration at the trial.
    pub fn begin_iteration(&mut self, context: &StepContext<'_>, trial: &Trial) {
        self.kinds_mut().for_each(|kind| kind.begin_iteration(context, trial));
    }

    /// Adds the forces on rope of the kinds that add in this order.
    pub fn assemble_on_rope(
        &mut self,
        order: Order,
        assembly: &Assembly<'_>,
        system: &mut LinearSystem,
    ) {
        self.kinds_mut().for_each(|kind| kind.assemble_on_rope(order, assembly, system));
    }

    /// Adds the forces on bodies of the kinds that add in this order.
    pub fn assemble_on_bodies(
        &self,
        order: Order,
        assembly: &Assembly<'_>,
        system: &mut LinearSystem,
    ) {
        self.kinds().for_each(|kind| kind.assemble_on_bodies(order, assembly, system));
    }

    /// Stores the forces of a solution.
    pub fn store_solution(&mut self, trial: &Trial, solution: &Solution<'_>) {
        self.kinds_mut().for_each(|kind| kind.store_solution(trial, solution));
    }

    /// Difference between the normal forces of the last solution and the laws.
    pub fn law_error(&self, trial: &Trial) -> ContactError {
        let errors = self.kinds().map(|kind| kind.law_error(trial));
        errors.fold(ContactError::default(), ContactError::and)
    }

    /// Makes normal forces linear about those of the last solution.
    pub fn linearise_at_solution(&mut self, trial: &Trial) {
        self.kinds_mut().for_each(|kind| kind.linearise_at_solution(trial));
    }

    /// Stores the forces of the last solution of an iteration.
    pub fn store_iteration(&mut self, trial: &Trial) {
        self.kinds_mut().for_each(|kind| kind.store_iteration(trial));
    }

    /// Error of the forces of the last iteration at the trial.
    pub fn error(&mut self, context: &StepContext<'_>, trial: &Trial) -> ContactError {
        let errors = self.kinds_mut().map(|kind| kind.error(context, trial));
        errors.fold(ContactError::default(), ContactError::and)
    }

    /// Checks the path of the step; adds the crossings that an exact test finds to those of each kind, in the order of [`Kind`].
    pub fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
        crossings: &mut [u64; Kind::COUNT],
    ) -> Result<(), ContactFailure> {
        self.kinds_mut().try_for_each(|kind| {
            crossings[kind.kind() as usize] += kind.check_path(context, trial)?;
            Ok(())
        })
    }

    /// Returns to the start of a rejected solver step.
    pub fn reject(&mut self) {
        self.kinds_mut().for_each(ContactKind::reject);
    }

    /// Advances friction by an accepted step, and reports contact.
    pub fn accept(
        &mut self,
        accepted: &Accepted<'_>,
        state: &mut State,
        reports: &mut Reports<'_>,
    ) -> Result<(), ContactFailure> {
        self.kinds_mut().try_for_each(|kind| kind.accept(accepted, state, reports))
    }

    /// Writes elastic grips into the state.
    pub fn store_grips(&self, accepted: &Accepted<'_>, state: &mut State) {
        self.kinds().for_each(|kind| kind.store(accepted, state));
    }

    /// Adds the forces of contact to those of each source.
    pub fn source_forces(&self, sources: &mut SourceForces<'_>) {
        self.kinds().for_each(|kind| kind.source_forces(sources));
    }

    /// Whether rope whose iterations moved it by `moved_m` in all reached rope, obstacles or bodies that the search by its drift did not
    /// find; they are found from now on. Rope that stayed near its drift has reached nothing else.
    pub fn find_more(&mut self, context: &StepContext<'_>, moved_m: f64, places: &[DVec3]) -> bool {
        let StepContext { model, state, scheme } = *context;
        let beyond_ropes = self.may_move_beyond_ropes(moved_m);
        let beyond_solids = self.may_move_beyond_solids(moved_m);
        if !beyond_solids && !beyond_ropes {
            return false;
        }
        let (rope, to) = (&state.rope, places);
        let from_drift_m = distance_from_drift_m(rope, scheme.dt, to);
        let beyond_solids = beyond_solids && from_drift_m > self.rope_on_solid.unwatched_m();
        let beyond_gathered = beyond_ropes && from_drift_m > self.rope_on_rope.unwatched_m();
        if beyond_solids || beyond_gathered {
            self.pieces.measure(&rope.position, |node| to[node], &rope.segment_length);
        }
        let Self { rope_on_solid, rope_on_rope, pieces, .. } = self;
        let on_solid = beyond_solids && rope_on_solid.gather_more(state, pieces, to, scheme.dt);
        let on_rope = match (rope_on_rope.touching, beyond_gathered) {
            _ if !beyond_ropes => false,
            (true, true) => rope_on_rope.gather_more(model, state, pieces, to),
            (true, false) => false,
            (false, true) => rope_on_rope.met(model, state, pieces, to),
            (false, false) => rope_on_rope.met_known(&rope.position, to),
        };
        on_solid || on_rope
    }

    /// Whether [`find_more`](Self::find_more) reads the places of rope after iterations that moved it by `moved_m` in all.
    pub fn reads_places(&self, moved_m: f64) -> bool {
        self.may_move_beyond_ropes(moved_m) || self.may_move_beyond_solids(moved_m)
    }

    fn may_move_beyond_ropes(&self, moved_m: f64) -> bool {
        let ropes = &self.rope_on_rope;
        ropes.law.is_some() && (!ropes.pairs.is_empty() || moved_m > ropes.unwatched_m())
    }

    fn may_move_beyond_solids(&self, moved_m: f64) -> bool {
        self.rope_on_solid.touching || moved_m > self.rope_on_solid.margin_m
    }
}

/// Greatest distance of nodes at these places from where their velocities would have brought them in a step [m].
fn distance_from_drift_m(rope: &RopeState, dt: f64, to: &[DVec3]) -> f64 {
    let drift = rope.position.iter().zip(&rope.velocity).map(|(place, speed)| *place + *speed * dt);
    drift.zip(to).map(|(drift, to)| drift.distance_squared(*to)).fold(0.0, f64::max).sqrt()
}
