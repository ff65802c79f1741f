//! The implicit solve: one linear system for ropes, joints and bodies, solved directly.
//!
//! Newton on `M (v - v̂)/h = F(x, v)` with `v = (x - x̂)/h` (`scheme.rs`): each `pass`
//! assembles forces and their derivatives at the trial places, eliminates every line down to its ends
//! (`block_tridiagonal.rs`), solves the interface system (`interface.rs`) and moves the trial. Cost is linear in the number of nodes;
//! no stiffness or mass ratio limits the step.

mod assemble;
mod axial;
mod begin;
mod bending;
mod block_tridiagonal;
mod body;
mod body_pairs;
mod body_skin;
mod columns;
mod condensed;
mod context;
mod dense;
mod elastic_grip;
mod forces;
mod given;
mod in_lanes;
mod interface;
mod keep;
mod lanes;
mod lengths;
mod line_search;
mod newton;
mod plan;
mod pulled;
mod residual;
mod rope;
mod rope_on_rope;
mod scheme;
mod seabed;
mod skin;
mod solid;
mod solve;
mod statics;
mod stopping;
mod suction;
mod tilt;
mod trial;
mod water;
mod woodbury;

use glam::{DMat3, DVec3};

use crate::contact::bodies::BodySkin;
use crate::contact::body_pairs::{BodyPairs, Coupled};
use crate::contact::pieces::Pieces;
use crate::contact::ropes::near::RopeWorkspace;
use crate::cost::{CostClock, CostPart};
use crate::model::Model;
use crate::solids::workspace::SolidWorkspace;
use crate::state::State;
use crate::water::WaterAt;
use crate::water::field::Walk;
use crate::whale::hitch::Hitches;
pub(crate) use axial::Axial;
pub(crate) use bending::bending_energy;
use block_tridiagonal::BlockTridiagonal;
pub(crate) use context::StepContext;
pub(crate) use elastic_grip::{Grip, Push};
pub(crate) use given::SkinTouches;
use interface::{Attachment, InterfaceSystem};
use lanes::Lanes;
use lengths::Lengths;
pub(crate) use newton::{NewtonEnd, Skin, Solved};
use plan::Plan;
use rope::Pull;
pub(crate) use rope::outer;
pub(crate) use scheme::{FIRST_SHARE, Scheme};
pub(crate) use statics::{WorstAt, is_laid};
pub(crate) use stopping::ContactMissed;
pub(crate) use suction::LOOSE_M;
pub(crate) use trial::BodyTrial;
use trial::Trial;
use woodbury::Woodbury;

/// Scratch of the solver for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Solver {
    pub(crate) plan: Plan,
    pub(crate) trial: Trial,
    lengths: Lengths,
    tridiagonal: BlockTridiagonal,
    lanes: Lanes,
    /// Whether the step is solved in the lanes.
    in_lanes: bool,
    /// Whether rope may touch skin, rope, obstacles or bodies in the step.
    in_contact: bool,
    /// Whether rope may touch the seabed in a step of free rope.
    near_seabed: bool,
    interface: InterfaceSystem,
    pull: Vec<Pull>,
    cut: Vec<bool>,
    /// What the pseudo-mass of each line is multiplied by in anchored passes of statics.
    pseudo_mass_scale: Vec<f64>,
    linear_part: LinearPart,
    /// Velocity of the water at each node: current and waves [m/s].
    flow: Vec<DVec3>,
    /// Acceleration of the water at each node; empty where there are no waves [m/s²].
    flow_acceleration: Vec<DVec3>,
    /// Height of the surface above each node's z = 0; empty where there are no waves [m].
    surface: Vec<f64>,
    /// What the water's acceleration does to each node through pressure and added mass; empty where there are no waves [N].
    push: Vec<DVec3>,
    /// The water at each body.
    flow_bodies: Vec<WaterAt>,
    wave_walk: Walk,
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
    coupled: Vec<Coupled>,
    woodbury: Woodbury,
    /// Rope and bodies before a move.
    before: Vec<DVec3>,
    bodies_before: Vec<BodyTrial>,
    /// Attachment and arm of each joint, for a solve again.
    attachments: Vec<(Attachment, DVec3)>,
    /// What the time of the step goes to.
    pub(crate) cost: CostClock,
}

/// Forces and blocks that the search along a step holds linear.
#[derive(Clone, Debug, Default)]
struct LinearPart {
    diagonal: Vec<DMat3>,
    force: Vec<DVec3>,
    interface: InterfaceSystem,
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
        let interface = plan.interface(model, &[]);
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
