//! Creeping: the sure way to rest, for gear whose shape is far from the first guess.
//!
//! Each stride minimises, as far as forces have a potential, `E(x) + ½ (x - x₀)ᵀ σM (x - x₀)` with `x₀` where the stride
//! began (the proximal point method; a step of length `1/σ` of backward Euler down the slope of the energy, solved
//! until it balances). However slack and stiff the rope, which segments are taut is settled within a stride, and rope
//! that has come to lie on the seabed is gripped where it lies after it. `σ` is each line's and each body's own: where a
//! stride does not balance, or turns a segment too far, it is made again with a greater `σ` for those that kept it from
//! balancing; one that balances soon lets all `σ` fall, and at the end strides are Newton passes.
//! Reference: Rockafellar 1976, Monotone operators and the proximal point algorithm (doi:10.1137/0314056).

use super::newton::{Attempt, FAR, Newton, PSEUDO_MASS, Reached, TOLERANCE_N, Way};
use super::trail::Trail;
use crate::model::Model;
use crate::solver::WorstAt;

/// Most passes of a stride.
const STRIDE_PASSES: usize = 8;
/// Share of a stride's first residual at which it has balanced.
const BALANCED: f64 = 0.1;
/// Turn of a segment in a stride above which it is made again [rad].
const SHARP_TURN: f64 = 0.7;
/// Change of the pseudo-mass where a stride is made again.
const GROWTH: f64 = 6.0;

/// How a stride ended.
enum Stride {
    /// Balanced after so many passes.
    Balanced(usize),
    /// Not.
    Lost,
}

/// Pseudo-masses of the gear's parts: lines, then bodies.
struct Burdens<'a> {
    model: &'a Model,
    /// Pseudo-mass of each part [1/s²].
    mass: Vec<f64>,
}

impl<'a> Burdens<'a> {
    /// One pseudo-mass for all parts; the solver's own pseudo-mass is one from here on.
    fn new(model: &'a Model, pseudo_mass: f64, newton: &mut Newton) -> Self {
        let mut burdens =
            Self { model, mass: vec![1.0; model.spec.lines.len() + model.spec.bodies.len()] };
        burdens.change(newton, pseudo_mass, |_| true);
        burdens
    }

    /// Multiplies the pseudo-masses of some parts.
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

    /// Parts that kept a stride from balancing; all where none is found.
    fn culprits(&self, newton: &Newton, enough_n: f64) -> Vec<bool> {
        let (spec, solver) = (&self.model.spec, &newton.solver);
        let sharp = |turn: f64| turn > 0.5 * SHARP_TURN;
        let line = |line| {
            solver.left_in_line(self.model, line) > enough_n
                || sharp(solver.turn_of_line(self.model, line))
        };
        let mut culprits: Vec<bool> = (0..spec.lines.len()).map(line).collect();
        culprits.extend((0..spec.bodies.len()).map(|body| sharp(solver.turn_of_body(body))));
        match solver.worst(self.model).filter(|(_, force_n)| *force_n > enough_n) {
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

/// Finds a state at rest from an attempt's guess.
pub(super) fn creep(
    model: &Model,
    attempt: &Attempt,
    most_passes: usize,
    trail: &mut Trail,
) -> Reached {
    let mut newton = Newton::new(model, &Attempt { pseudo_mass: 1.0, ..*attempt }).anchored();
    let mut burdens = Burdens::new(model, FAR, &mut newton);
    let last = trail.passes() + most_passes;
    let mut tension = Vec::new();
    loop {
        newton.solver.anchor();
        let residual_n = newton.balance_at_rest();
        trail.pass(model, residual_n);
        if residual_n < TOLERANCE_N
            || !residual_n.is_finite()
            || trail.passes() >= last
            || trail.is_spent()
        {
            return newton.reached(residual_n);
        }
        tension.clear();
        tension.extend_from_slice(newton.solver.tension());
        let enough_n = (BALANCED * residual_n).max(0.5 * TOLERANCE_N);
        match stride(&mut newton, model, enough_n, trail) {
            Stride::Balanced(passes) => {
                newton.regrip();
                burdens.change(&mut newton, change(passes), |_| true);
            }
            Stride::Lost => {
                let culprits = burdens.culprits(&newton, enough_n);
                newton.solver.return_to_anchor(model, &tension);
                burdens.change(&mut newton, GROWTH, |part| culprits[part]);
            }
        }
    }
}

/// Passes from where the trial was anchored until it balances.
fn stride(newton: &mut Newton, model: &Model, enough_n: f64, trail: &mut Trail) -> Stride {
    let mut turned = 0.0;
    for pass in 1..=STRIDE_PASSES {
        turned += newton.solve();
        if turned.is_nan() || turned > SHARP_TURN {
            return Stride::Lost;
        }
        let share = newton.solver.share_past_solids(1.0);
        newton.solver.advance(model, share);
        newton.solver.measure_flow(model);
        let residual_n = newton.balance(Way::Predicted);
        trail.pass(model, residual_n);
        if residual_n < enough_n {
            return Stride::Balanced(pass);
        }
    }
    Stride::Lost
}

/// Change of the pseudo-mass after a stride of so many passes.
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
