//! Newton for the gear at rest, by pseudo-transient continuation.
//!
//! The matrix carries a pseudo-mass `σM`: a pass is then a backward Euler step of length `1/σ` along the way that
//! forces push. Tension is a multiplier of its own: a segment is judged taut, and stiffened across, by what the last
//! linear solve predicted, so the strain of a rope far from its shape does not count. What limits a pass is how
//! far it turns any segment: a pass that turns one too far is made again with a greater `σ`, one that turns little lets
//! `σ` fall. While `σ` is great slack rope resists a pass too: rope that lies slack would else go taut and slack by turns.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use glam::DVec3;

use super::trail::Trail;
use crate::model::Model;
use crate::solver::{Solver, WorstAt, is_laid};
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// Residual at which the rig is at rest [N].
pub(super) const TOLERANCE_N: f64 = 1e-4;
/// First pseudo-mass where the guess may be far from rest [1/s²].
pub(super) const FAR: f64 = 10.0;
/// First pseudo-mass where the guess is near rest [1/s²].
pub(super) const NEAR: f64 = 0.01;
/// Range of the pseudo-mass [1/s²].
pub(super) const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);
/// Turn of a segment in a pass above which the pass is cut, and below which the pseudo-mass falls [rad].
const SHARP_TURN: f64 = 0.6;
const SLIGHT_TURN: f64 = 0.3;
/// Half of the passes to wait after the first that was led astray.
const WARY_PASSES: usize = 5;
/// Turn below which bodies are near their balance [rad].
const NEAR_TURN: f64 = 0.1;
/// Change of the pseudo-mass after a sharp, slight, very slight pass.
const GROWTH: f64 = 3.0;
const SHRINKAGE: f64 = 0.3;
const QUICK_SHRINKAGE: f64 = 0.1;
/// Greatest growth of the pseudo-mass where a pass is made again.
const GREATEST_GROWTH: f64 = 1e3;
/// Share of its stiffness with which slack rope resists a pass at the greatest pseudo-mass, and the one where it is half.
const SLACK_STIFFNESS: f64 = 1e-2;
const SLACK_MASS: f64 = 100.0;
/// Longest move of a node in one pass as a share of the gear's longest line.
const LONGEST_MOVE: f64 = 0.2;

/// Height above the seabed at which rope is no longer where it lay [m].
const LIFTED_M: f64 = 0.05;

/// What holds the gear besides itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// Bodies that were laid stay as they lie.
    Laid,
    /// They hold by their own grip on the seabed, but do not turn.
    Upright,
    /// They hold by their own grip on the seabed.
    Released,
}

/// From where to look for rest.
#[derive(Clone, Copy)]
pub(super) struct Attempt<'a> {
    /// Gear as it was laid: what the seabed's grips are measured from.
    pub laid: &'a State,
    /// Where to begin.
    pub guess: &'a State,
    pub hold: Hold,
    /// Stiffness of bodies under rope, by its length; it passes through them where there is none [N/m²].
    pub on_bodies_n_m2: Option<f64>,
    /// Pseudo-mass of the first pass: a free node then moves about `g/σ` in it [1/s²].
    pub pseudo_mass: f64,
}

/// How a pass is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Rope is judged taut or slack by the last solve, and whole steps are taken.
    Predicted,
    /// Rope is judged where it lies, and each step is searched for balance.
    Searched,
}

/// Where an attempt ended.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    pub state: State,
    pub residual_n: f64,
    pub worst: Option<(WorstAt, f64)>,
    /// Force on each laid body besides its feet's push [N].
    pub load_n: Vec<DVec3>,
}

impl Reached {
    /// Whether it is at rest.
    pub fn at_rest(&self) -> bool {
        self.residual_n < TOLERANCE_N
    }
}

/// An attempt in progress.
pub(super) struct Newton<'a> {
    model: &'a Model,
    /// What the seabed's grips are measured from.
    laid: State,
    pseudo_mass: f64,
    /// Passes to wait after forces on bodies as they are led one astray, in a place that a body would leave; what is left of them.
    wary: usize,
    wait: usize,
    pub solver: Solver,
    pub scheme: Scheme,
}

impl<'a> Newton<'a> {
    /// Begins at a guess.
    pub fn new(model: &'a Model, attempt: &Attempt) -> Self {
        let (mut solver, scheme) = (Solver::new(model), Scheme::statics(attempt.pseudo_mass));
        solver.contacts.rope_on_solid.at_rest_n_m2 = attempt.on_bodies_n_m2;
        solver.begin(model, attempt.laid, &scheme);
        match attempt.hold {
            Hold::Laid => solver.hold_laid(model),
            Hold::Upright => solver.keep_upright(model),
            Hold::Released => {}
        }
        solver.start_at(model, attempt.guess);
        Self {
            model,
            laid: attempt.laid.clone(),
            pseudo_mass: attempt.pseudo_mass,
            wary: 0,
            wait: 0,
            solver,
            scheme,
        }
    }

    /// Assembles forces and matrix at the trial places; the residual [N].
    pub fn balance(&mut self, way: Way) -> f64 {
        let context = StepContext { model: self.model, state: &self.laid, scheme: &self.scheme };
        match way {
            Way::Predicted => self.solver.assemble(&context),
            Way::Searched => self.solver.assemble_searchable(&context),
        }
        self.solver.residual(self.model)
    }

    /// Residual with the active set that the last solve predicted. Where that residual says the gear is at rest, it is
    /// computed again with the tensions as they are, for a prediction may call a segment slack that is not [N].
    pub fn balance_at_rest(&mut self) -> f64 {
        let residual_n = self.balance(Way::Predicted);
        if residual_n < TOLERANCE_N { self.balance(Way::Searched) } else { residual_n }
    }

    /// Solves what was assembled; how far that turns any segment or body [rad]. After a slight turn bodies are near their
    /// balance.
    pub fn solve(&mut self) -> f64 {
        self.solver.solve(self.model);
        let turn = self.solver.sharpest_turn(self.model);
        if self.scheme.exact && turn > SHARP_TURN {
            self.wary = 2 * self.wary.max(WARY_PASSES);
            self.wait = self.wary;
        }
        self.wait = self.wait.saturating_sub(1);
        self.scheme.exact = self.wait == 0 && turn < NEAR_TURN;
        turn
    }

    /// Lets the pseudo-mass pull back to where passes begin.
    pub fn anchored(mut self) -> Self {
        self.scheme.anchored = true;
        self
    }

    /// Share of the solved step to take, at most `longest`.
    pub fn line_search(&self, longest: f64) -> f64 {
        let context = StepContext { model: self.model, state: &self.laid, scheme: &self.scheme };
        self.solver.line_search_free(&context, longest)
    }

    /// Lets slack rope resist while the pseudo-mass is great.
    fn stiffen_slack(&mut self) {
        let share = SLACK_STIFFNESS * self.pseudo_mass / (self.pseudo_mass + SLACK_MASS);
        self.solver.stiffen_slack(self.model, share);
    }

    /// Changes the pseudo-mass by a factor, within its range.
    pub fn change_mass(&mut self, factor: f64) {
        self.pseudo_mass = (self.pseudo_mass * factor).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
        let (anchored, exact) = (self.scheme.anchored, self.scheme.exact);
        self.scheme = Scheme { anchored, exact, ..Scheme::statics(self.pseudo_mass) };
    }

    /// Lets the seabed grip rope that has come to lie on it where it lies now, and let go of rope that was lifted off.
    pub fn regrip(&mut self) {
        let Some(seabed) = &self.model.spec.seabed else { return };
        let rope = &mut self.laid.rope;
        for (node, place) in self.solver.places().iter().enumerate() {
            let (now, then) = (seabed.depth_of(*place), seabed.depth_of(rope.position[node]));
            if (now > 0.0 && then <= 0.0) || (now < -LIFTED_M && then > 0.0) {
                rope.position[node] = *place;
                rope.seabed_grip[node] = DVec3::ZERO;
            }
        }
    }

    /// Ends the attempt where it was last assembled.
    pub fn reached(mut self, residual_n: f64) -> Reached {
        let worst = self.solver.worst(self.model);
        let laid = (0..self.model.spec.bodies.len()).filter(|body| is_laid(self.model, *body));
        let load_n = laid.map(|body| self.solver.load_on(self.model, body)).collect();
        let mut state = self.laid;
        if residual_n.is_finite() {
            self.solver.store(self.model, &self.scheme, &mut state);
            state.rest();
        }
        Reached { state, residual_n, worst, load_n }
    }
}

/// Newton, begun with the pseudo-mass of the attempt.
pub(super) fn descend(
    model: &Model,
    attempt: &Attempt,
    most_passes: usize,
    trail: &mut Trail,
) -> Reached {
    let mut newton = Newton::new(model, attempt);
    let longest_line =
        model.spec.lines.iter().map(|line| line.segments_m.iter().sum::<f64>()).fold(1.0, f64::max);
    let mut before = Vec::new();
    let mut residual_n = f64::INFINITY;
    for _ in 0..most_passes {
        residual_n = newton.balance_at_rest();
        trail.pass(model, residual_n);
        if residual_n < TOLERANCE_N || !residual_n.is_finite() || trail.is_spent() {
            break;
        }
        newton.stiffen_slack();
        let turn = newton
            .solve()
            .max(SHARP_TURN * newton.solver.longest() / (LONGEST_MOVE * longest_line));
        if turn > 2.0 * SHARP_TURN {
            newton.change_mass((turn / SHARP_TURN).min(GREATEST_GROWTH));
        } else {
            let share = newton.solver.share_past_solids((SHARP_TURN / turn).min(1.0));
            newton.solver.advance_at_rest(model, share, &mut before);
            newton.change_mass(change(turn));
        }
    }
    newton.reached(residual_n)
}

/// Change of the pseudo-mass after a pass that turned a segment so far.
fn change(turn: f64) -> f64 {
    if turn > SHARP_TURN {
        GROWTH
    } else if turn > SLIGHT_TURN {
        1.0
    } else if turn > 0.1 * SLIGHT_TURN {
        SHRINKAGE
    } else {
        QUICK_SHRINKAGE
    }
}
