//! Newton for the gear at rest, by pseudo-transient continuation.
//!
//! The matrix carries a pseudo-mass `σM`: a pass is then a backward Euler step of length `1/σ` along the way that
//! forces push. Tension is a multiplier of its own: a segment is judged taut, and stiffened across, by what the last
//! linear solve foretold, so the strain of a rope far from its shape does not count. What limits a pass is how
//! far it turns any segment: a pass that turns one too far is made again with a greater `σ`, one that turns little lets
//! `σ` fall. While `σ` is great slack rope resists a pass too: rope that lies slack would else go taut and slack by turns.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use glam::DVec3;

use crate::model::Model;
use crate::solver::{Scheme, Solver, WorstAt, is_laid};
use crate::state::State;

/// Residual at which the rig is at rest [N].
pub(super) const TOLERANCE_N: f64 = 1e-4;
/// First pseudo-mass: a free node then moves about `g/σ` in a pass [1/s²].
const FIRST_PSEUDO_MASS: f64 = 10.0;
/// Range of the pseudo-mass [1/s²].
const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);
/// Turn of a segment in a pass above which the pass is cut, and below which the pseudo-mass falls [rad].
const SHARP_TURN: f64 = 0.6;
const SLIGHT_TURN: f64 = 0.3;
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

/// What holds the gear besides itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Bodies that were laid stay as they lie.
    Laid,
    /// They are tethered with this stiffness, zero for not at all [N/m].
    Tethered(f64),
}

/// How a pass is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Rope is judged taut or slack by the last solve, and whole steps are taken.
    Foretold,
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

/// An attempt in progress: gear that was laid as in `laid`, and where it is tried.
pub(super) struct Newton<'a> {
    model: &'a Model,
    laid: &'a State,
    tether: f64,
    pseudo_mass: f64,
    pub solver: Solver,
    pub scheme: Scheme,
}

impl<'a> Newton<'a> {
    /// Begins at a guess.
    pub fn new(model: &'a Model, laid: &'a State, guess: &State, hold: Hold, pseudo_mass: f64) -> Self {
        let tether = if let Hold::Tethered(stiffness) = hold { stiffness } else { 0.0 };
        let (mut solver, scheme) = (Solver::new(model), Scheme::statics(pseudo_mass, tether));
        solver.begin(model, laid, &scheme);
        if hold == Hold::Laid {
            solver.hold_laid(model);
        }
        solver.start_at(model, guess);
        Self { model, laid, tether, pseudo_mass, solver, scheme }
    }

    /// Assembles forces and matrix at the trial places; the residual [N].
    pub fn balance(&mut self, way: Way) -> f64 {
        match way {
            Way::Foretold => self.solver.assemble(self.model, self.laid, &self.scheme),
            Way::Searched => self.solver.assemble_searchable(self.model, self.laid, &self.scheme),
        }
        self.solver.residual(self.model)
    }

    /// Lets slack rope resist while the pseudo-mass is great.
    fn stiffen_slack(&mut self) {
        let share = SLACK_STIFFNESS * self.pseudo_mass / (self.pseudo_mass + SLACK_MASS);
        self.solver.stiffen_slack(self.model, share);
    }

    /// Changes the pseudo-mass by a factor, within its range.
    pub fn change_mass(&mut self, factor: f64) {
        self.pseudo_mass = (self.pseudo_mass * factor).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
        self.scheme = Scheme::statics(self.pseudo_mass, self.tether);
    }

    /// Ends the attempt where it was last assembled.
    pub fn reached(self, residual_n: f64) -> Reached {
        let worst = self.solver.worst(self.model);
        let laid = (0..self.model.spec.bodies.len()).filter(|body| is_laid(self.model, *body));
        let load_n = laid.map(|body| self.solver.load_on(self.model, body)).collect();
        let mut state = self.laid.clone();
        if residual_n.is_finite() {
            self.solver.keep(self.model, &self.scheme, &mut state);
            state.rest();
        }
        Reached { state, residual_n, worst, load_n }
    }
}

/// Newton from `guess` for gear that was laid as in `laid`.
pub(super) fn descend(model: &Model, laid: &State, guess: &State, hold: Hold, most_passes: usize, trace_n: &mut Vec<f64>) -> Reached {
    let mut newton = Newton::new(model, laid, guess, hold, FIRST_PSEUDO_MASS);
    let longest_line = model.spec.lines.iter().map(|line| line.segments_m.iter().sum::<f64>()).fold(1.0, f64::max);
    let mut before = Vec::new();
    let mut residual_n = f64::INFINITY;
    for _ in 0..most_passes {
        residual_n = newton.balance(Way::Foretold);
        if residual_n < TOLERANCE_N {
            // What was foretold may call a segment slack that is not.
            residual_n = newton.balance(Way::Searched);
        }
        trace_n.push(residual_n);
        if residual_n < TOLERANCE_N || !residual_n.is_finite() {
            break;
        }
        newton.stiffen_slack();
        newton.solver.solve(model);
        let turn = newton.solver.sharpest_turn(model).max(SHARP_TURN * newton.solver.longest() / (LONGEST_MOVE * longest_line));
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
