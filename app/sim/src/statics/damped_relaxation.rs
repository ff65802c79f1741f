//! Damped relaxation by the proximal point method, for gear far from the initial guess.
//!
//! Each stride minimises `E(x) + ½ (x - x₀)ᵀ σM (x - x₀)`, as far as forces have a potential `E` [J], with `x₀` the positions
//! at the start of the stride [m], `M` the mass [kg] and `σ` the pseudo-mass [1/s²]. It is a converged backward Euler step of
//! length `1/σ` of the gradient flow. For any slack or stiffness of rope, the set of taut segments is found within a stride,
//! and rope that has settled on the seabed is gripped after it. Each line and body has its own `σ`. A stride that does not
//! converge, or turns a segment too far, is repeated with a greater `σ` for the parts that caused it; one that converges in few
//! passes decreases all `σ`. The last strides are Newton passes.
//! Reference: Rockafellar 1976, Monotone operators and the proximal point algorithm (doi:10.1137/0314056).

use super::newton::{
    Attempt, FAR, IterationLog, Newton, PSEUDO_MASS, PassKind, Reached, TOLERANCE_N,
};
use crate::model::Model;
use crate::solver::WorstAt;

/// Greatest number of passes of a stride.
const STRIDE_PASSES: usize = 8;

/// Share of its initial residual at which a stride has converged.
const BALANCED: f64 = 0.1;

/// Turn of a segment above which a stride is repeated [rad].
const SHARP_TURN: f64 = 0.7;

/// Factor of the pseudo-mass for a repeated stride.
const GROWTH: f64 = 6.0;

/// Result of a stride.
enum Stride {
    /// Converged after this number of passes.
    Converged(usize),
    /// Not converged.
    Failed,
}

/// Pseudo-masses of the gear's parts: lines, then bodies.
struct PseudoMasses<'a> {
    model: &'a Model,
    /// Pseudo-mass of each part [1/s²].
    mass: Vec<f64>,
}

impl<'a> PseudoMasses<'a> {
    /// Sets one pseudo-mass for all parts; that of the scheme is 1.
    fn new(model: &'a Model, pseudo_mass: f64, newton: &mut Newton) -> Self {
        let mut masses =
            Self { model, mass: vec![1.0; model.spec.lines.len() + model.spec.bodies.len()] };
        masses.change(newton, pseudo_mass, |_| true);
        masses
    }

    /// Multiplies the pseudo-masses of the parts that `of` selects.
    fn change(&mut self, newton: &mut Newton, factor: f64, of: impl Fn(usize) -> bool) {
        let lines = self.model.spec.lines.len();
        for (part, mass) in self.mass.iter_mut().enumerate().filter(|(part, _)| of(*part)) {
            let next = (*mass * factor).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
            match part.checked_sub(lines) {
                None => newton.solver.scale_pseudo_mass_of_line(part, next / *mass),
                Some(body) => newton.solver.scale_pseudo_mass_of_body(body, next / *mass),
            }
            *mass = next;
        }
    }

    /// Returns the parts that prevented convergence of a stride, or all if none is found.
    fn culprits(&self, newton: &Newton, target_n: f64) -> Vec<bool> {
        let (spec, solver) = (&self.model.spec, &newton.solver);
        let sharp = |turn: f64| turn > 0.5 * SHARP_TURN;
        let line = |line| {
            solver.left_in_line(self.model, line) > target_n
                || sharp(solver.turn_of_line(self.model, line))
        };
        let mut culprits: Vec<bool> = (0..spec.lines.len()).map(line).collect();
        culprits.extend((0..spec.bodies.len()).map(|body| sharp(solver.turn_of_body(body))));
        match solver.worst(self.model).filter(|(_, force_n)| *force_n > target_n) {
            Some((WorstAt::Body(body), _)) => culprits[spec.lines.len() + body] = true,
            Some((WorstAt::Joint(joint), _)) => {
                spec.lines
                    .iter()
                    .zip(&mut culprits)
                    .for_each(|(line, is)| *is |= line.from == joint || line.to == joint);
            }
            _ => {}
        }
        if !culprits.contains(&true) {
            culprits.fill(true);
        }
        culprits
    }
}

/// Solves from the guess of an attempt.
pub(super) fn relax_damped(
    model: &Model,
    attempt: &Attempt,
    most_passes: usize,
    log: &mut IterationLog,
) -> Reached {
    let mut newton = Newton::new(model, &Attempt { pseudo_mass: 1.0, ..*attempt }).anchored();
    let mut masses = PseudoMasses::new(model, FAR, &mut newton);
    let last = log.passes() + most_passes;
    let mut tension = Vec::new();
    loop {
        newton.solver.anchor();
        let residual_n = newton.balance_at_rest();
        log.pass(model, residual_n);
        if residual_n < TOLERANCE_N
            || !residual_n.is_finite()
            || log.passes() >= last
            || log.is_spent()
        {
            return newton.reached(residual_n);
        }
        tension.clear();
        tension.extend_from_slice(newton.solver.tension());
        let target_n = (BALANCED * residual_n).max(0.5 * TOLERANCE_N);
        match stride(&mut newton, model, target_n, log) {
            Stride::Converged(passes) => {
                newton.regrip();
                masses.change(&mut newton, change(passes), |_| true);
            }
            Stride::Failed => {
                let culprits = masses.culprits(&newton, target_n);
                newton.solver.return_to_anchor(model, &tension);
                masses.change(&mut newton, GROWTH, |part| culprits[part]);
            }
        }
    }
}

/// Passes from the anchor until convergence.
fn stride(newton: &mut Newton, model: &Model, target_n: f64, log: &mut IterationLog) -> Stride {
    let mut turned = 0.0;
    for pass in 1..=STRIDE_PASSES {
        turned += newton.solve();
        if turned.is_nan() || turned > SHARP_TURN {
            return Stride::Failed;
        }
        let share = newton.solver.share_past_solids(1.0);
        newton.solver.advance(model, share);
        newton.solver.measure_flow(model);
        let residual_n = newton.balance(PassKind::Predicted);
        log.pass(model, residual_n);
        if residual_n < target_n {
            return Stride::Converged(pass);
        }
    }
    Stride::Failed
}

/// Factor of the pseudo-mass after a stride with this number of passes.
fn change(passes: usize) -> f64 {
    match passes {
        1 => 0.1,
        2 => 0.2,
        3 => 0.25,
        4 => 0.4,
        5 => 0.6,
        6 => 0.8,
        _ => 1.5,
    }
}
