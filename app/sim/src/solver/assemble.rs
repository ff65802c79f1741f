//! Assembles forces and matrix at the trial places.

use crate::contact::rope_on_solid::kind::ActiveSet;
use crate::forces::{body, tilt};
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::trial::plan::Attachment;
use crate::trial::scheme::Scheme;

impl Solver {
    /// Assembles forces and matrix at the trial places.
    pub(crate) fn assemble(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.tridiagonal.clear();
        self.interface.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_solids(state, scheme, ActiveSet::Predicted);
        self.add_ropes(state);
        self.add_pulled(model, scheme);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_bodies(model, state, scheme);
        self.add_end_turns(model, scheme);
    }

    /// Assembles forces and matrix with every segment taut or slack by its tension where it is. What is linear along the
    /// step is kept apart for the line search.
    pub(crate) fn assemble_searchable(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.tridiagonal.clear();
        self.interface.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_pulled(model, scheme);
        self.add_bodies(model, state, scheme);
        self.linear_part.diagonal.clone_from(&self.tridiagonal.diagonal);
        self.linear_part.force.clone_from(&self.tridiagonal.force);
        self.linear_part.interface.copy_values(&self.interface);
        self.measure_tension(model, scheme);
        self.add_solids(state, scheme, ActiveSet::AtTrial);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_end_turns(model, scheme);
    }

    /// Takes the tension of every segment at the trial places as it is.
    fn measure_tension(&mut self, model: &Model, scheme: &Scheme) {
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (node, segment) in (first_node..).zip(segments.clone()) {
                self.trial.tension[segment] = if self.cut[segment] {
                    0.0
                } else {
                    self.pull_of(segment, node, scheme).tension
                };
            }
        }
    }

    /// Keeps the turning stiffness of rope pulling on bodies (see [`body::turn_stiffness`]).
    pub(crate) fn add_end_turns(&mut self, model: &Model, scheme: &Scheme) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let segments = &model.line_segments[index];
            for (joint, segment, sign) in
                [(line.from, segments.start, 1.0), (line.to, segments.end - 1, -1.0)]
            {
                let attachment = self.plan.attachments[joint];
                let Attachment::Body { block, .. } = attachment else { continue };
                let force =
                    self.pull[segment].direction * (sign * self.trial.tension[segment].max(0.0));
                let turning = if scheme.exact { tilt::turning } else { body::turn_stiffness };
                let stiffness = turning(self.arm(attachment), force);
                *self.interface.at(block + 1, block + 1) += stiffness;
            }
        }
    }
}
