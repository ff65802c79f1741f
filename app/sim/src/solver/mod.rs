//! The implicit solve: one linear system for ropes, joints and bodies, solved directly.
//!
//! Newton on `M (v - v̂)/h = F(x, v)` with `v = (x - x̂)/h` (`scheme.rs`): each `pass`
//! assembles forces and their derivatives at the trial places, eliminates every line down to its ends
//! (`block_tridiagonal.rs`), solves the interface system (`interface.rs`) and moves the trial. Cost is linear in the number of nodes;
//! no stiffness or mass ratio limits the step.

mod assemble;
mod begin;
mod given;
pub(crate) mod in_lanes;
mod keep;
mod line_search;
pub(crate) mod newton;
mod residual;
mod solve;
mod statics;
pub(crate) mod stopping;

use glam::{DMat3, DVec3};

use crate::broad_phase::pieces::Pieces;
use crate::contact::body_on_body::{BodyPairs, Coupled};
use crate::contact::body_on_skin::BodySkin;
use crate::contact::rope_on_rope::near::RopeWorkspace;
use crate::contact::rope_on_solid::SolidWorkspace;
use crate::cost::{CostClock, CostPart};
use crate::forces::lengths::Lengths;
use crate::forces::rope::Pull;
use crate::model::Model;
use crate::state::State;
use crate::system::block_tridiagonal::BlockTridiagonal;
use crate::system::interface::InterfaceSystem;
use crate::system::lanes::Lanes;
use crate::system::woodbury::Woodbury;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::scheme::Scheme;
use crate::trial::{BodyTrial, Trial};
use crate::water::WaterAt;
use crate::water::field::Walk;
use crate::whale::hitch::Hitches;
pub(crate) use given::SkinTouches;
pub(crate) use newton::{NewtonEnd, Skin, Solved};
pub(crate) use statics::{WorstAt, is_laid};

/// Scratch of the solver for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Solver {
    pub(crate) plan: Plan,
    pub(crate) trial: Trial,
    pub(crate) lengths: Lengths,
    pub(crate) tridiagonal: BlockTridiagonal,
    pub(crate) lanes: Lanes,
    /// Whether the step is solved in the lanes.
    pub(crate) in_lanes: bool,
    /// Whether rope may touch skin, rope, obstacles or bodies in the step.
    pub(crate) in_contact: bool,
    /// Whether rope may touch the seabed in a step of free rope.
    pub(crate) near_seabed: bool,
    pub(crate) interface: InterfaceSystem,
    pub(crate) pull: Vec<Pull>,
    pub(crate) cut: Vec<bool>,
    /// What the pseudo-mass of each line is multiplied by in anchored passes of statics.
    pub(crate) pseudo_mass_scale: Vec<f64>,
    pub(crate) linear_part: LinearPart,
    /// Velocity of the water at each node: current and waves [m/s].
    pub(crate) flow: Vec<DVec3>,
    /// Acceleration of the water at each node; empty where there are no waves [m/s²].
    pub(crate) flow_acceleration: Vec<DVec3>,
    /// Height of the surface above each node's z = 0; empty where there are no waves [m].
    pub(crate) surface: Vec<f64>,
    /// What the water's acceleration does to each node through pressure and added mass; empty where there are no waves [N].
    pub(crate) push: Vec<DVec3>,
    /// The water at each body.
    pub(crate) flow_bodies: Vec<WaterAt>,
    pub(crate) wave_walk: Walk,
    /// Rope in pieces, measured over the step.
    pub(crate) pieces: Pieces,
    /// Rope near obstacles and bodies.
    pub(crate) solid: SolidWorkspace,
    /// Rope near rope.
    pub(crate) ropes: RopeWorkspace,
    /// Bodies near skin.
    pub(crate) body_skin: Option<Box<BodySkin>>,
    /// Bodies near each other, and those that the interface couples for it.
    pub(crate) body_pairs: BodyPairs,
    pub(crate) coupled: Vec<Coupled>,
    pub(crate) woodbury: Woodbury,
    /// Rope and bodies before a move.
    pub(crate) before: Vec<DVec3>,
    pub(crate) bodies_before: Vec<BodyTrial>,
    /// Attachment and arm of each joint, for a solve again.
    pub(crate) attachments: Vec<(Attachment, DVec3)>,
    /// What the time of the step goes to.
    pub(crate) cost: CostClock,
}

/// Forces and blocks that the search along a step holds linear.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinearPart {
    diagonal: Vec<DMat3>,
    force: Vec<DVec3>,
    pub(crate) interface: InterfaceSystem,
}

/// What is fine enough for a small rig or short segments, below the usual tolerances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Move of the last pass [m].
    pub move_m: f64,
    /// Difference between solved and true tension [N].
    pub gap_n: f64,
}

/// Move of the last pass, as a share of the shortest segment.
const FINE_MOVE_SHARE: f64 = 0.02;
/// Difference of tension, as a share of the weight of all gear.
const FINE_GAP_SHARE: f64 = 0.02;

impl Solver {
    /// Scratch for a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let plan = Plan::new(model);
        let interface = InterfaceSystem::of_model(&plan, model, &[]);
        Self {
            linear_part: LinearPart { interface: interface.clone(), ..LinearPart::default() },
            interface,
            plan,
            trial: Trial { hitches: Hitches::new(model), ..Trial::default() },
            lengths: Lengths::default(),
            tridiagonal: BlockTridiagonal::new(model.node_count, model.segment_count),
            lanes: Lanes::new(model),
            in_lanes: false,
            in_contact: false,
            near_seabed: false,
            pull: vec![Pull::default(); model.segment_count],
            cut: vec![false; model.segment_count],
            pseudo_mass_scale: vec![1.0; model.spec.lines.len()],
            flow: vec![DVec3::ZERO; model.node_count],
            flow_acceleration: Vec::new(),
            surface: Vec::new(),
            push: Vec::new(),
            flow_bodies: Vec::new(),
            wave_walk: Walk::default(),
            pieces: Pieces::new(model),
            solid: SolidWorkspace::new(model),
            ropes: RopeWorkspace::new(model),
            body_skin: BodySkin::new(model).map(Box::new),
            body_pairs: BodyPairs::new(model),
            coupled: Vec::new(),
            woodbury: Woodbury::new(),
            before: Vec::new(),
            bodies_before: Vec::new(),
            attachments: Vec::new(),
            cost: CostClock::default(),
        }
    }

    /// What is fine enough for the gear at hand.
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance {
            move_m: FINE_MOVE_SHARE * self.lengths.shortest,
            gap_n: FINE_GAP_SHARE * self.plan.weight_n,
        }
    }

    /// Begins a step from a state.
    pub(crate) fn begin(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.in_lanes = false;
        self.lengths.take(model, &state.rope.segment_length);
        self.trial.begin(model, &self.plan, state, scheme);
        self.cut.clone_from(&state.rope.cut);
        let outer = self.cost.enter(CostPart::Water);
        self.measure_flow(model);
        self.measure_push(model, state, scheme);
        self.cost.enter(outer);
    }

    /// Moves the trial by a share of the solved step; whether all moves are finite.
    pub(crate) fn advance(&mut self, model: &Model, share: f64) -> bool {
        let mut finite = true;
        self.predict_tension(model, share);
        self.predict_pushes(share);
        for (place, step) in self.trial.place.iter_mut().zip(&self.tridiagonal.step) {
            *place += *step * share;
            finite &= step.is_finite();
        }
        finite &= self.advance_bodies(share).1;
        self.trial.place_ends(model, &self.plan);
        finite
    }

    /// Tension of each segment at the end of the step being solved; below zero it is slack [N].
    pub(crate) fn tension(&mut self) -> &[f64] {
        if self.in_lanes {
            self.trial.tension.resize(self.lengths.segment.len(), 0.0);
            self.lanes.give_tension(&mut self.trial.tension);
        }
        &self.trial.tension
    }
}
