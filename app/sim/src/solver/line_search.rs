//! Step length of an iteration of statics: where the forces along the step balance.
//!
//! `g(s) = -F(x + s δ)·δ` is the slope of the incremental potential along the step `δ`; it is negative at `s = 0`.
//! The whole step is taken if `g` does not exceed half of its first magnitude; else the zero of `g` is found by regula falsi
//! (Illinois). Tension and the contact of rope on solids are evaluated at each trial, so that neither the barrier nor the kink where rope
//! stops sliding is overshot. Inertia, weight, drag, seabed and bodies are linear along the step by their assembled blocks.
//! Reference: Nocedal and Wright 2006, Numerical Optimization, section 3.5 (doi:10.1007/978-0-387-40065-5).

use crate::model::Model;
use crate::solver::Solver;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// Share of the first slope at which a trial is good enough.
const ENOUGH: f64 = 0.5;
/// Largest number of trials along a step.
const MOST_TRIALS: usize = 14;

/// The share, at most `longest`, at which a slope that begins below zero is near enough to zero.
fn balance(longest: f64, mut slope: impl FnMut(f64) -> f64) -> f64 {
    let last = slope(longest);
    if last <= 0.0 {
        return longest;
    }
    let first = slope(0.0);
    if first.is_nan() || first >= 0.0 || last <= -ENOUGH * first {
        return longest;
    }
    let (mut low, mut high) = ((0.0, first), (longest, last));
    for _ in 0..MOST_TRIALS {
        let width = high.0 - low.0;
        let share = (low.0 - low.1 * width / (high.1 - low.1))
            .clamp(low.0 + 0.1 * width, high.0 - 0.1 * width);
        let here = slope(share);
        if here.abs() <= -ENOUGH * first {
            return share;
        }
        if here < 0.0 {
            low = (share, here);
            high.1 *= 0.5;
        } else {
            high = (share, here);
            low.1 *= 0.5;
        }
    }
    if low.0 > 0.0 { low.0 } else { high.0 }
}

impl Solver {
    /// Share of the solved step to take without a whale, at most `longest`.
    pub(crate) fn line_search_free(&self, context: &StepContext<'_>, longest: f64) -> f64 {
        balance(longest, |share| self.free_slope(context, share))
    }

    fn free_slope(&self, context: &StepContext<'_>, share: f64) -> f64 {
        let StepContext { model, scheme, .. } = *context;
        let Self { plan, trial, system, .. } = self;
        self.linear_slope(share)
            + self.rope_slope(model, scheme, share)
            + self.forces.bending_slope(model, (trial, system), share)
            + self.contacts.rope_on_solid.slope(context, (plan, trial, system), share)
    }

    /// Slope of the terms that are linear along the step: inertia, weight, drag, seabed, bodies.
    fn linear_slope(&self, share: f64) -> f64 {
        let nodes: f64 = (self
            .linear_part
            .force
            .iter()
            .zip(&self.linear_part.diagonal)
            .zip(&self.system.rope.step))
        .map(|((force, diagonal), step)| step.dot(*diagonal * *step) * share - force.dot(*step))
        .sum();
        nodes
            + self.linear_part.interface.slope(
                &self.system.interface.step,
                &self.plan.body_block,
                share,
            )
    }

    /// Slope of the energy of stretched rope.
    fn rope_slope(&self, model: &Model, scheme: &Scheme, share: f64) -> f64 {
        let mut slope = 0.0;
        for index in 0..model.spec.lines.len() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index]
                .clone()
                .enumerate()
                .filter(|(_, segment)| !self.forces.cut[*segment])
            {
                let at = (&self.trial, &self.system);
                let pull = self.forces.pull_moved(segment, first_node + k, scheme, at, share);
                slope +=
                    pull.tension.max(0.0) * pull.stretch(&self.system.rope.step, first_node + k);
            }
        }
        slope
    }
}
