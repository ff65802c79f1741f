//! Statics: shape and tensions at rest, before any dynamics.
//!
//! Statics solves `F(x) = 0` for the positions `x` of nodes and bodies [m], with `F` the sum of all forces on them [N].
//! It proceeds by continuation from a simpler problem, with coarse gear first ([`strategy`]):
//!
//! 1. *Held*: laid bodies keep their position on the seabed, and lines find their shape from arcs of their own length ([`guess`]).
//! 2. *Released*: the bodies move until their grip on the seabed balances the load.
//! 3. *Refined*: the shape is transferred to the full number of segments.
//!
//! Each stage tries several strategies in turn, the fastest first: Newton's method ([`newton`]), the proximal point method
//! ([`damped_relaxation`]), and soft rope that is stiffened ([`continuation`]). If none converges, the gear is first settled in
//! a weaker current ([`continuation`]). If gear does not reach rest, the load on its held bodies compared with their friction
//! shows whether it drags ([`Drag`]). In all stages rope passes through bodies. Afterwards rope inside a body is lifted out,
//! and overlapping ropes are separated ([`overlap`]).
//! References: in the modules.

mod continuation;
mod damped_relaxation;
mod guess;
mod newton;
mod overlap;
mod strategy;

use std::fmt;

use glam::DVec3;

use crate::model::{JointKind, Model};
use crate::solver::{WorstAt, is_laid};
use crate::state::State;
use crate::whale::pilot;
use newton::{Attempt, FAR, Hold, IterationLog, NEAR, Reached};
use strategy::{Coarse, HELD, REFINED, RELEASED, Strategy};

/// Gear at rest, or the nearest state that was found.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The state to start dynamics from.
    pub state: State,
    /// Outcome.
    pub outcome: Outcome,
    /// Greatest residual force at any node or body [N].
    pub residual_n: f64,
    /// Location of that residual.
    pub worst: Option<Worst>,
    /// Whether the gear is at rest.
    pub converged: bool,
    /// Residual after each pass, including those of coarser gear [N].
    pub trace_n: Vec<f64>,
}

impl Settled {
    /// Returns the same gear at rest with the whale of another model.
    ///
    /// Gear, water and seabed of that model must be equal to this one's, except for the strengths of ropes and links, and no
    /// line may be attached to the whale: statics then do not depend on it.
    pub fn with_whale_of(&self, model: &Model) -> Self {
        let mut settled = self.clone();
        let start = State::start(model);
        (settled.state.whale, settled.state.link_parted_s) = (start.whale, start.link_parted_s);
        pilot::begin(model, &mut settled.state);
        settled
    }

    /// Message with the outcome and the location of the greatest residual.
    pub fn why(&self) -> String {
        match (&self.outcome, &self.worst) {
            (Outcome::NotFound(_), Some(worst)) => {
                format!(
                    "{}; the residual is {:.3e} N at {}",
                    self.outcome, worst.force_n, worst.part
                )
            }
            (outcome, _) => outcome.to_string(),
        }
    }
}

/// Finds the state at rest under the model's water at time zero.
pub fn settle(model: &Model) -> Settled {
    let mut log = IterationLog::default();
    let mut found = find(model, &mut log);
    if matches!(found.outcome, Outcome::NotFound(_)) {
        found = continuation::continue_in_current(model, &mut log).unwrap_or(found);
    }
    overlap::lift(model, &mut found, &mut log);
    overlap::separate(model, &mut found);
    settled(model, found, log)
}

/// Result for one resolution.
struct Found {
    /// Initial guess; grips are measured from it while bodies are held.
    first: State,
    /// State with bodies held; grips are measured from it after they are released.
    held: State,
    /// Final state: with bodies released if at rest, with bodies held if the gear drags.
    end: Reached,
    outcome: Outcome,
}

/// Solves for coarse gear first, then for full resolution.
fn find(model: &Model, log: &mut IterationLog) -> Found {
    let Some(coarse) = Coarse::of(model) else { return find_from_guess(model, log) };
    let found = find(&coarse.model, log);
    if log.is_spent() {
        return carry(model, &coarse, found, log);
    }
    refine(model, &coarse, &found, log).unwrap_or_else(|| find_from_guess(model, log))
}

/// Solves from the result for coarser gear; `None` if that does not converge.
fn refine(model: &Model, coarse: &Coarse, found: &Found, log: &mut IterationLog) -> Option<Found> {
    let [first, held, guess] =
        [&found.first, &found.held, &found.end.state].map(|state| coarse.carry(model, state));
    let (laid, hold) = match found.outcome {
        Outcome::AtRest => (&held, Hold::Released),
        Outcome::Drags(_) => (&first, Hold::Laid),
        Outcome::NotFound(_) => return None,
    };
    let end = strategy::try_all(
        &REFINED,
        model,
        &Attempt { laid, guess: &guess, hold, on_bodies_n_m2: None, pseudo_mass: NEAR },
        log,
    );
    if !end.at_rest() {
        return None;
    }
    let outcome =
        if hold == Hold::Laid { Outcome::Drags(drags(model, &end)?) } else { Outcome::AtRest };
    Some(Found { first, held, end, outcome })
}

/// Transfers the result for coarser gear when the budget of iterations is exhausted.
fn carry(model: &Model, coarse: &Coarse, found: Found, log: &mut IterationLog) -> Found {
    let [first, held, guess] =
        [&found.first, &found.held, &found.end.state].map(|state| coarse.carry(model, state));
    let (laid, hold) = if matches!(found.outcome, Outcome::Drags(_)) {
        (&first, Hold::Laid)
    } else {
        (&held, Hold::Released)
    };
    let attempt = Attempt { laid, guess: &guess, hold, on_bodies_n_m2: None, pseudo_mass: NEAR };
    let end = newton::descend(model, &attempt, 1, log);
    let outcome = match found.outcome {
        Outcome::AtRest if !end.at_rest() => Outcome::NotFound(Unfound::Fine),
        outcome => outcome,
    };
    Found { first, held, end, outcome }
}

/// Solves from the initial guess.
fn find_from_guess(model: &Model, log: &mut IterationLog) -> Found {
    let first = guess::first_guess(model);
    let held = strategy::try_all(
        &HELD,
        model,
        &Attempt {
            laid: &first,
            guess: &first,
            hold: Hold::Laid,
            on_bodies_n_m2: None,
            pseudo_mass: FAR,
        },
        log,
    );
    let attempt = Attempt {
        laid: &held.state,
        guess: &held.state,
        hold: Hold::Released,
        on_bodies_n_m2: None,
        pseudo_mass: FAR,
    };
    if !held.at_rest() {
        let end = strategy::apply(Strategy::StiffnessContinuation, model, &attempt, log);
        let outcome =
            if end.at_rest() { Outcome::AtRest } else { Outcome::NotFound(Unfound::Held) };
        return Found { first, held: held.state, end, outcome };
    }
    let grip = grip(model, &held);
    let drag = grip.clone().filter(Drag::is_lost);
    // If the load exceeds the friction, there is most often no equilibrium: the fast strategies are sufficient.
    let strategies = if drag.is_some() { &RELEASED[..2] } else { &RELEASED };
    let released = release(strategies, model, &attempt, log);
    let (outcome, end) = match drag {
        _ if released.at_rest() => (Outcome::AtRest, released),
        Some(drag) => (Outcome::Drags(drag), held.clone()),
        None => (Outcome::NotFound(Unfound::Released(grip)), released),
    };
    Found { first, held: held.state, end, outcome }
}

/// Releases laid bodies; if one overturns, tries again with bodies that slide before they turn.
fn release(
    strategies: &[Strategy],
    model: &Model,
    attempt: &Attempt,
    log: &mut IterationLog,
) -> Reached {
    let released = strategy::try_all(strategies, model, attempt, log);
    if released.at_rest() && !overturned(model, attempt.laid, &released.state) {
        return released;
    }
    let slid = strategy::apply(Strategy::SlideThenTurn, model, attempt, log);
    if slid.at_rest() { slid } else { released }
}

/// Converts a result to the public type.
fn settled(model: &Model, found: Found, log: IterationLog) -> Settled {
    let Found { mut end, outcome, .. } = found;
    let (worst, converged) = (worst(model, &end), outcome == Outcome::AtRest);
    pilot::begin(model, &mut end.state);
    Settled {
        state: end.state,
        outcome,
        residual_n: end.residual_n,
        worst,
        converged,
        trace_n: log.residual_n,
    }
}

/// Outcome of statics.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The gear is at rest.
    AtRest,
    /// No equilibrium exists: the gear drags. The state is that with the laid bodies held.
    Drags(Drag),
    /// No equilibrium was found: the state is the nearest to it.
    NotFound(Unfound),
}

/// Stage at which statics failed.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfound {
    /// Lines and buoys do not reach rest even with the laid bodies held.
    Held,
    /// At rest with the laid bodies held, but not after they are released; with the gear nearest to dragging, if any lies on a
    /// seabed.
    Released(Option<Drag>),
    /// At rest with coarser segments only.
    Fine,
}

/// Load on gear along the seabed and its friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Drag {
    /// The laid body with the greatest excess of load over friction.
    pub body: String,
    /// Total load along the seabed on all laid bodies of the gear [N].
    pub pull_n: f64,
    /// Their total friction, reduced by the lift of the lines [N].
    pub hold_n: f64,
}

impl Drag {
    /// Excess of load over friction; negative if the gear holds [N].
    pub fn excess_n(&self) -> f64 {
        self.pull_n - self.hold_n
    }

    /// Whether the load exceeds the friction.
    fn is_lost(&self) -> bool {
        self.excess_n() > 0.0
    }
}

/// The part with the greatest residual force.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The part, such as `line endline-top`.
    pub part: String,
    /// The force, or the torque on a body if its number is greater [N or N m].
    pub force_n: f64,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtRest => f.write_str("at rest"),
            Self::Drags(drag) => write!(
                f,
                "the gear drags: the load exceeds its hold on the seabed of {1:.1} N by {0:.1} N, most at `{2}`",
                drag.excess_n(),
                drag.hold_n,
                drag.body
            ),
            Self::NotFound(unfound) => write!(f, "no equilibrium was found{unfound}"),
        }
    }
}

impl fmt::Display for Unfound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Held => f.write_str(", even with all bodies on the seabed held in place"),
            Self::Released(None) => Ok(()),
            Self::Released(Some(Drag { body, pull_n, hold_n })) => {
                f.write_str(": the gear is at rest with all bodies on the seabed held in place, but not after they are released, ")?;
                write!(
                    f,
                    "with a load of {pull_n:.1} N for a hold of {hold_n:.1} N, most at `{body}`"
                )
            }
            Self::Fine => f.write_str(": the gear is at rest with coarser segments only"),
        }
    }
}

/// Returns the part with the greatest residual force.
fn worst(model: &Model, reached: &Reached) -> Option<Worst> {
    let (at, force_n) = reached.worst?;
    let part = match at {
        WorstAt::Line(line) => format!("line {}", model.spec.lines[line].id),
        WorstAt::Joint(joint) => format!("joint {}", model.spec.joints[joint].id),
        WorstAt::Body(body) => format!("body {}", model.spec.bodies[body].id),
    };
    Some(Worst { part, force_n })
}

/// Cosine of the tilt beyond which a laid body has overturned: 45 degrees.
const OVERTURNED: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// Whether a laid body has overturned.
fn overturned(model: &Model, laid: &State, now: &State) -> bool {
    let up = |state: &State, body: usize| state.bodies[body].orientation * DVec3::Z;
    (0..model.spec.bodies.len())
        .any(|body| is_laid(model, body) && up(laid, body).dot(up(now, body)) < OVERTURNED)
}

/// Returns the gear with the greatest excess of load over friction, from the loads on its held bodies.
///
/// At rest, friction of the seabed must balance the total load along it, and is at most `Σ μN`. If the load exceeds this, the
/// gear drags at any position of its bodies.
fn grip(model: &Model, held: &Reached) -> Option<Drag> {
    let seabed = model.spec.seabed.as_ref()?;
    let laid: Vec<usize> =
        (0..model.spec.bodies.len()).filter(|body| is_laid(model, *body)).collect();
    let gear = connected_gear(model);
    let drag_of = |one: usize| {
        let mates: Vec<usize> =
            (0..laid.len()).filter(|other| gear[laid[*other]] == gear[laid[one]]).collect();
        let along = |index: usize| held.load_n[index].reject_from_normalized(seabed.normal);
        let hold = |index: usize| {
            model.spec.bodies[laid[index]].start_friction
                * (-held.load_n[index].dot(seabed.normal)).max(0.0)
        };
        let pull_n = mates.iter().map(|mate| along(*mate)).sum::<DVec3>().length();
        let hold_n = mates.iter().map(|mate| hold(*mate)).sum::<f64>();
        let most = mates.iter().copied().max_by(|a, b| {
            (along(*a).length() - hold(*a)).total_cmp(&(along(*b).length() - hold(*b)))
        });
        Drag {
            body: most.map_or_else(String::new, |mate| model.spec.bodies[laid[mate]].id.clone()),
            pull_n,
            hold_n,
        }
    };
    let free = (0..laid.len()).filter(|index| gear[laid[*index]] != FIXED);
    free.map(drag_of).max_by(|a, b| a.excess_n().total_cmp(&b.excess_n()))
}

/// Returns the gear that drags, if any.
fn drags(model: &Model, held: &Reached) -> Option<Drag> {
    grip(model, held).filter(Drag::is_lost)
}

/// Group of gear that a fixture or a held body keeps from dragging.
const FIXED: usize = usize::MAX;

/// Returns a group number for each body; bodies connected by lines have the same one.
fn connected_gear(model: &Model) -> Vec<usize> {
    let joints = &model.spec.joints;
    // Joints of one body are connected, and so are the ends of a line.
    let mut gear: Vec<usize> = (0..joints.len()).collect();
    let body_of = |joint: usize| {
        if let JointKind::Body { body, .. } = joints[joint].kind { Some(body) } else { None }
    };
    let pairs = model.spec.lines.iter().map(|line| (line.from, line.to));
    let same = (0..joints.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
    let same =
        same.filter(|(one, other)| body_of(*one).is_some() && body_of(*one) == body_of(*other));
    for (one, other) in pairs.chain(same) {
        let (from, to) = (gear[one], gear[other]);
        gear.iter_mut().filter(|gear| **gear == from).for_each(|gear| *gear = to);
    }
    let fixed = |joint: usize| match joints[joint].kind {
        JointKind::Fixed | JointKind::Driven { .. } | JointKind::Whale(_) => true,
        JointKind::Body { body, .. } => model.spec.bodies[body].held_until_s.is_some(),
        JointKind::Free | JointKind::Pulled { .. } => false,
    };
    let fixed_gear: Vec<usize> =
        (0..joints.len()).filter(|joint| fixed(*joint)).map(|joint| gear[joint]).collect();
    let of_body = |body: usize| {
        let joint = (0..joints.len()).find(|joint| body_of(*joint) == Some(body));
        match joint {
            Some(joint) if fixed_gear.contains(&gear[joint]) => FIXED,
            Some(joint) => gear[joint],
            None => FIXED,
        }
    };
    (0..model.spec.bodies.len()).map(of_body).collect()
}
