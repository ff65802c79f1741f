//! Strategies of statics, tried in turn until one converges, and coarse gear as a start.
//!
//! Fast strategies are first. The comments of the lists state how often each converged of the attempts that it was needed for,
//! for 300 randomly drawn rigs.
//!
//! Coarse gear: the cost of a pass is proportional to the number of nodes, but the number of passes depends on the distance of
//! the initial guess, not on the number of segments. Neighbouring segments are therefore joined, the coarse gear is settled,
//! and its shape is transferred: positions, tensions and grips are interpolated linearly between its nodes.
//! Reference: Brandt and Livne 2011, Multigrid Techniques, section 1.5 (nested iteration; doi:10.1137/1.9781611970753).

use super::damped_relaxation::relax_damped;
use super::newton::{Attempt, Hold, IterationLog, Reached, descend};
use super::{continuation, guess};
use crate::model::{Line, Model};
use crate::state::State;

/// A strategy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Strategy {
    /// Newton's method controlled by the turn of segments, with this number of passes.
    NewtonByTurn(usize),
    /// Newton's method controlled by the residual.
    NewtonByResidual,
    /// Newton's method controlled by the residual, from straight lines.
    NewtonFromStraight,
    /// The proximal point method.
    DampedRelaxation,
    /// Soft rope that is stiffened.
    StiffnessContinuation,
    /// Newton's method with laid bodies that first slide upright and then may turn.
    SlideThenTurn,
}

/// With laid bodies held, from the initial guess: 223 of 328, 24 of 105, 5 of 81, 58 of 60.
pub(super) const HELD: [Strategy; 4] = [
    Strategy::NewtonByTurn(80),
    Strategy::NewtonFromStraight,
    Strategy::NewtonByResidual,
    Strategy::StiffnessContinuation,
];

/// With bodies released, from their held state; the last two only if friction exceeds the load. With refinement: 376 of 531,
/// 90 of 155, 27 of 47, 8 of 10.
pub(super) const RELEASED: [Strategy; 4] = [
    Strategy::NewtonByTurn(80),
    Strategy::NewtonByResidual,
    Strategy::DampedRelaxation,
    Strategy::StiffnessContinuation,
];

/// From the shape of coarser gear.
pub(super) const REFINED: [Strategy; 3] =
    [Strategy::NewtonByTurn(15), Strategy::NewtonByResidual, Strategy::DampedRelaxation];

/// With laid bodies that slide upright.
const SLIDING: [Strategy; 2] = [Strategy::NewtonByTurn(80), Strategy::NewtonByResidual];

/// With laid bodies released after sliding.
const RELEASED_FROM_SLIDING: [Strategy; 2] =
    [Strategy::NewtonByTurn(120), Strategy::DampedRelaxation];

/// Initial pseudo-mass where bodies are released: a trap then turns by less than the depth of its feet in the seabed [1/s²].
const FIRM: f64 = 1e4;

/// Greatest number of passes of the proximal point method.
const RELAXATION_PASSES: usize = 600;

/// Passes of Newton's method after stiffness continuation.
const POLISH_PASSES: usize = 200;

/// Tries strategies in turn until one converges; returns the result with the smallest residual.
pub(super) fn try_all(
    strategies: &[Strategy],
    model: &Model,
    attempt: &Attempt,
    log: &mut IterationLog,
) -> Reached {
    debug_assert!(!strategies.is_empty(), "at least one strategy is required");
    let mut best = apply(strategies[0], model, attempt, log);
    for strategy in &strategies[1..] {
        if best.at_rest() || log.is_spent() {
            break;
        }
        let reached = apply(*strategy, model, attempt, log);
        if reached.residual_n < best.residual_n {
            best = reached;
        }
    }
    best
}

/// Applies one strategy.
pub(super) fn apply(
    strategy: Strategy,
    model: &Model,
    attempt: &Attempt,
    log: &mut IterationLog,
) -> Reached {
    match strategy {
        Strategy::NewtonByTurn(most_passes) => descend(model, attempt, most_passes, log),
        Strategy::NewtonByResidual => continuation::newton_by_residual(model, attempt, log),
        Strategy::NewtonFromStraight => {
            let laid = straight(model, attempt.hold);
            continuation::newton_by_residual(
                model,
                &Attempt { laid: &laid, guess: &laid, ..*attempt },
                log,
            )
        }
        Strategy::DampedRelaxation => relax_damped(model, attempt, RELAXATION_PASSES, log),
        Strategy::StiffnessContinuation => stiffen_from_soft(model, attempt, log),
        Strategy::SlideThenTurn => slide(model, attempt, log),
    }
}

/// Lets laid bodies slide before they may turn, so that taut rope moves them to where it is slack and does not overturn them.
fn slide(model: &Model, attempt: &Attempt, log: &mut IterationLog) -> Reached {
    let slid = try_all(&SLIDING, model, &Attempt { hold: Hold::Upright, ..*attempt }, log);
    try_all(
        &RELEASED_FROM_SLIDING,
        model,
        &Attempt { guess: &slid.state, pseudo_mass: FIRM, ..*attempt },
        log,
    )
}

/// Stiffens soft rope, then applies Newton's method to the result.
fn stiffen_from_soft(model: &Model, attempt: &Attempt, log: &mut IterationLog) -> Reached {
    let laid = straight(model, attempt.hold);
    let relaxed = continuation::continue_in_stiffness(model, &laid, attempt.hold, log);
    if relaxed.at_rest() {
        return relaxed;
    }
    let polished = descend(
        model,
        &Attempt { laid: &laid, guess: &relaxed.state, ..*attempt },
        POLISH_PASSES,
        log,
    );
    if polished.residual_n < relaxed.residual_n { polished } else { relaxed }
}

/// Initial state with straight lines; laid bodies are at their equilibrium depth in the seabed if held.
fn straight(model: &Model, hold: Hold) -> State {
    if hold == Hold::Laid { guess::straight(model) } else { State::start(model) }
}

/// Number of segments joined to one.
const JOINED: usize = 4;

/// Least number of segments of a coarsened line.
const LEAST: usize = 4;

/// Number of segments of the longest line below which gear is not coarsened further.
const COARSEST: usize = 40;

/// Gear with fewer segments.
pub(super) struct Coarse {
    pub model: Model,
    /// Node of the fine gear at each coarse node.
    kept: Vec<usize>,
}

impl Coarse {
    /// Coarsens gear; `None` if its longest line has too few segments.
    pub fn of(model: &Model) -> Option<Self> {
        let longest = model.spec.lines.iter().map(|line| line.segments_m.len()).max()?;
        if longest < COARSEST {
            return None;
        }
        let (mut lines, mut kept) = (Vec::new(), Vec::new());
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            let ends = ends_of(line.segments_m.len());
            lines.push(joined(line, &ends));
            kept.extend(ends.iter().map(|end| nodes.start + end));
        }
        Some(Self { model: model.with_lines(lines), kept })
    }

    /// Transfers a state of the coarse gear to the fine gear.
    pub fn carry(&self, fine: &Model, state: &State) -> State {
        let mut carried = State::start(fine);
        for (nodes, segments) in self.model.line_nodes.iter().zip(&self.model.line_segments) {
            for (node, segment) in (nodes.start..).zip(segments.clone()) {
                self.carry_segment(state, node, segment, &mut carried);
            }
        }
        carried.bodies.clone_from(&state.bodies);
        carried
    }

    fn carry_segment(&self, state: &State, node: usize, segment: usize, carried: &mut State) {
        let (first, last) = (self.kept[node], self.kept[node + 1]);
        debug_assert!(first < last, "a coarse segment joins at least one segment");
        let first_segment = first - self.model.segment_line[segment];
        let (rope, from) = (&mut carried.rope, &state.rope);
        let mut along = 0.0;
        for place in first..=last {
            let share = along / from.segment_length[segment];
            rope.position[place] = from.position[node].lerp(from.position[node + 1], share);
            rope.seabed_grip[place] =
                from.seabed_grip[node].lerp(from.seabed_grip[node + 1], share);
            if place < last {
                rope.tension[first_segment + place - first] = from.tension[segment];
                along += rope.segment_length[first_segment + place - first];
            }
        }
    }
}

/// Nodes of a line with this number of segments that the coarse line has, including both ends.
fn ends_of(segments: usize) -> Vec<usize> {
    let count = segments.div_ceil(JOINED).max(segments.min(LEAST));
    (0..=count).map(|end| end * segments / count).collect()
}

/// The line with the segments between those nodes joined.
fn joined(line: &Line, ends: &[usize]) -> Line {
    Line {
        segments_m: ends
            .windows(2)
            .map(|pair| line.segments_m[pair[0]..pair[1]].iter().sum())
            .collect(),
        start_m: if line.start_m.is_empty() {
            Vec::new()
        } else {
            ends.iter().map(|end| line.start_m[*end]).collect()
        },
        ..line.clone()
    }
}
