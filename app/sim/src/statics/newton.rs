//! Newton's method for gear at rest, by pseudo-transient continuation, and the log of its iterations.
//!
//! A pass solves `(σM + K) Δx = F` with `F` the forces [N], `K = -∂F/∂x` the stiffness [N/m], `M` the mass [kg] and `σ` the
//! pseudo-mass [1/s²]; it is a backward Euler step of the gradient flow `M dx/ds = F` with the length `1/σ`. Tension is a
//! separate multiplier:
//! the last linear solution predicts whether a segment is taut and its transverse stiffness, so that the strain far from
//! equilibrium has no effect. The greatest turn of a segment limits a pass: a pass that turns one too far is repeated with a
//! greater `σ`, and a small turn decreases `σ`. While `σ` is great, slack rope resists a pass as well; it would otherwise
//! alternate between taut and slack.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use glam::DVec3;

use crate::model::Model;
use crate::solver::{Solver, WorstAt, is_laid};
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// Residual below which gear is at rest [N].
pub(super) const TOLERANCE_N: f64 = 1e-4;

/// Initial pseudo-mass where the guess may be far from rest [1/s²].
pub(super) const FAR: f64 = 10.0;

/// Initial pseudo-mass where the guess is near rest [1/s²].
pub(super) const NEAR: f64 = 0.01;

/// Range of the pseudo-mass [1/s²].
pub(super) const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);

/// Turn of a segment above which a pass is shortened [rad].
const SHARP_TURN: f64 = 0.6;

/// Turn of a segment below which the pseudo-mass decreases [rad].
const SLIGHT_TURN: f64 = 0.3;

/// Half of the passes without exact derivatives after the first pass that failed with them.
const WARY_PASSES: usize = 5;

/// Turn below which bodies are near equilibrium [rad].
const NEAR_TURN: f64 = 0.1;

/// Factors of the pseudo-mass after a sharp, a slight and a very slight turn.
const GROWTH: f64 = 3.0;

const SHRINKAGE: f64 = 0.3;

const QUICK_SHRINKAGE: f64 = 0.1;

/// Greatest factor of the pseudo-mass where a pass is repeated.
const GREATEST_GROWTH: f64 = 1e3;

/// Share of its stiffness with which slack rope resists a pass at infinite pseudo-mass.
const SLACK_STIFFNESS: f64 = 1e-2;

/// Pseudo-mass at which that share is half [1/s²].
const SLACK_MASS: f64 = 100.0;

/// Longest move of a node in one pass, as a share of the longest line.
const LONGEST_MOVE: f64 = 0.2;

/// Height above the seabed at which rope releases its grip [m].
const LIFTED_M: f64 = 0.05;

/// Constraint of laid bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// They do not move.
    Laid,
    /// They may slide on the seabed, but do not turn.
    Upright,
    /// They may slide and turn.
    Released,
}

/// Start of an attempt.
#[derive(Clone, Copy)]
pub(super) struct Attempt<'a> {
    /// State from which grips on the seabed are measured.
    pub laid: &'a State,
    /// Initial guess.
    pub guess: &'a State,
    /// Constraint of laid bodies.
    pub hold: Hold,
    /// Contact stiffness of bodies under rope, per length of rope; `None` if rope passes through them [N/m²].
    pub on_bodies_n_m2: Option<f64>,
    /// Initial pseudo-mass `σ`: a free node moves by about `g/σ` in the first pass [1/s²].
    pub pseudo_mass: f64,
}

/// Kind of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PassKind {
    /// The last solution determines whether rope is taut or slack; steps are not shortened.
    Predicted,
    /// The current position determines whether rope is taut or slack; a line search shortens steps.
    Searched,
}

/// Result of an attempt.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    pub state: State,
    pub residual_n: f64,
    pub worst: Option<(WorstAt, f64)>,
    /// Force on each laid body except that of the seabed on its feet [N].
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
    /// State from which grips on the seabed are measured.
    laid: State,
    pseudo_mass: f64,
    /// Passes without exact derivatives after a pass that failed with them, and the number that remains.
    wary: usize,
    wait: usize,
    pub solver: Solver,
    pub scheme: Scheme,
}

impl<'a> Newton<'a> {
    /// Starts at the guess of an attempt.
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

    /// Assembles forces and matrix at the trial positions; returns the residual [N].
    pub fn balance(&mut self, kind: PassKind) -> f64 {
        let context = StepContext { model: self.model, state: &self.laid, scheme: &self.scheme };
        match kind {
            PassKind::Predicted => self.solver.assemble(&context),
            PassKind::Searched => self.solver.assemble_searchable(&context),
        }
        self.solver.residual(self.model)
    }

    /// Residual with the predicted active set [N]. If it is below the tolerance, it is computed again with the actual tensions,
    /// because the prediction may treat a taut segment as slack.
    pub fn balance_at_rest(&mut self) -> f64 {
        let residual_n = self.balance(PassKind::Predicted);
        if residual_n < TOLERANCE_N { self.balance(PassKind::Searched) } else { residual_n }
    }

    /// Solves the assembled system; returns the greatest turn of a segment or body [rad]. After a small turn the next pass uses
    /// exact derivatives for bodies.
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

    /// Anchors the pseudo-mass at the start of the passes.
    pub fn anchored(mut self) -> Self {
        self.scheme.anchored = true;
        self
    }

    /// Share of the solved step to take, at most `longest`, by line search.
    pub fn line_search(&self, longest: f64) -> f64 {
        let context = StepContext { model: self.model, state: &self.laid, scheme: &self.scheme };
        self.solver.line_search_free(&context, longest)
    }

    /// Adds stiffness to slack rope while the pseudo-mass is great.
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

    /// Starts grips where rope has settled on the seabed, and releases those of lifted rope.
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

    /// Ends the attempt at the last assembled position.
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

/// Newton's method controlled by the turn of segments, with the initial pseudo-mass of the attempt.
pub(super) fn descend(
    model: &Model,
    attempt: &Attempt,
    most_passes: usize,
    log: &mut IterationLog,
) -> Reached {
    let mut newton = Newton::new(model, attempt);
    let longest_line =
        model.spec.lines.iter().map(|line| line.segments_m.iter().sum::<f64>()).fold(1.0, f64::max);
    let mut before = Vec::new();
    let mut residual_n = f64::INFINITY;
    for _ in 0..most_passes {
        residual_n = newton.balance_at_rest();
        log.pass(model, residual_n);
        if residual_n < TOLERANCE_N || !residual_n.is_finite() || log.is_spent() {
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

/// Factor of the pseudo-mass after a pass with this greatest turn.
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

/// Budget of statics in nodes times passes: eight seconds of a core at 0.4 µs each, for gear of any size.
const MOST_NODE_PASSES: usize = 20_000_000;

/// Log of iterations: residuals and budget.
#[derive(Debug)]
pub(super) struct IterationLog {
    /// Residual after each pass [N].
    pub residual_n: Vec<f64>,
    node_passes: usize,
    /// Budget of node-passes.
    most: usize,
}

impl Default for IterationLog {
    fn default() -> Self {
        Self { residual_n: Vec::new(), node_passes: 0, most: MOST_NODE_PASSES }
    }
}

impl IterationLog {
    /// Adds a pass over a model.
    pub fn pass(&mut self, model: &Model, residual_n: f64) {
        self.residual_n.push(residual_n);
        self.node_passes += model.node_count;
    }

    /// Number of passes.
    pub fn passes(&self) -> usize {
        self.residual_n.len()
    }

    /// A log with a quarter of the budget.
    pub fn short() -> Self {
        Self { most: MOST_NODE_PASSES / 4, ..Self::default() }
    }

    /// Appends the passes of another log.
    pub fn add(&mut self, other: Self) {
        self.residual_n.extend(other.residual_n);
        self.node_passes += other.node_passes;
    }

    /// Whether the budget is exhausted.
    pub fn is_spent(&self) -> bool {
        self.node_passes >= self.most
    }
}
