//! Rope on skin within a step: contact points measured and their friction asked for where the trial stands.

use crate::contact::law::barrier::CRUSHED_SHARE;
use crate::contact::rope_on_skin::ContactWorkspace;
use crate::cost::CostPart;
use crate::solver::Solver;
use crate::solver::newton::NewtonEnd;
use crate::trial::StepContext;

impl Solver {
    /// Measures every contact point where the trial stands, and asks for its friction.
    pub(crate) fn measure_skin(
        &mut self,
        context: &StepContext<'_>,
        work: &mut ContactWorkspace,
    ) -> Result<(), NewtonEnd> {
        let StepContext { model, state, scheme } = *context;
        self.cost.enter(CostPart::Detection);
        work.near.follow(&state.rope.position, &self.trial.place);
        work.points.measure(&work.near, &self.trial.place);
        self.cost.enter(CostPart::Contact);
        if let Some((segment, triangle)) = work.nearer_than(CRUSHED_SHARE) {
            return Err(NewtonEnd::Crushed(segment, triangle));
        }
        let Some(friction) = &model.spec.friction else { return Ok(()) };
        work.touching.collect(model, &work.near, &work.points, state);
        work.touching.arrays.respond(friction, scheme.dt).map_err(NewtonEnd::Plugin)
    }
}
