//! Gear hauled over a block: rope goes aboard at the hauler's speed, and trap after trap with it.
//!
//! The hauler takes in the length `V dt` of rope in each step. The node of a line at the block is the piece of rope that
//! reaches the block as the step ends: it begins the step `V dt` below the block and is driven up to it. With `x` its place,
//! `n` the next node, `c = |n - x|` and `l` the chord and the unstretched length of the segment between them:
//!
//! `f = V dt / max(c, l)`,  `x ← x + f (n - x)`,  `l ← (1 - f) l`,  `v = (P - x)/dt`
//!
//! with `P` the block at the end of the step. The strain stays, so that pieces of rope meet no jump at the block, and the rest is
//! the solver's own ([`step`](fn@crate::step)): weight, drag at the speed of the rope, added mass of lifted traps, seabed, break-out.
//! Where `f ≥ 1` the next node has come to the block, and the segment goes aboard; where it was the last of its line, the joint
//! has, and all other lines that meet there are taken in together. A body that comes to the block is aboard and pulls no more.
//! What is aboard is no part of the model any longer: each passage makes a new one from the rest (`layout.rs`).
//!
//! Not in it: contact of the gear with itself, slip on the sheave, bending over it, and a hauler that slows under load.
//! The boat: `boat.rs`. Sources and defaults: docs/hauling.md.

mod boat;
mod layout;
mod setup;
mod take;

use endline_sdk::LineEnd;
use glam::DVec3;

use crate::model::Model;
use crate::state::State;
use crate::step::{Input, Stop, Workspace, step};
use boat::Boat;
use layout::Origin;

pub use setup::endlines;

/// Rise at which a body is off the seabed: more than that of a trap that is tipped on its end [m].
pub const LIFTED_M: f64 = 0.5;

/// How gear is hauled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hauling {
    /// Rope taken in by the hauler, over the block [m/s].
    pub speed_m_s: f64,
    /// Time in which the hauler comes up to its speed [s].
    pub start_s: f64,
    /// Height of the block above the sea surface [m].
    pub block_m: f64,
    /// Heave of the block over that of the surface below it [1].
    pub heave: f64,
    /// Angle of the line at the block from the vertical at which the boat keeps pace with the hauler; `None` for a boat
    /// that does not follow the line [rad].
    pub lead_rad: Option<f64>,
    /// Drift of the boat besides [m/s].
    pub drift_m_s: DVec3,
}

/// Something that came up in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Came {
    /// This line of the gear begins to go over the block.
    Line(usize),
    /// This body of the gear rose by [`LIFTED_M`].
    OffSeabed(usize),
    /// This body of the gear is aboard.
    Aboard(usize),
}

/// What the hauler and the line feel at the end of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Felt {
    /// Greatest pull of all rope on the block over the step [N].
    pub load_n: f64,
    /// Angle of the line at the block from the vertical [rad].
    pub lead_rad: f64,
    /// Work of the hauler in the step: pull times rope taken in [J].
    pub work_j: f64,
    /// What came up.
    pub came: Vec<Came>,
}

/// A line's end at the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct End {
    line: usize,
    at: LineEnd,
    joint: usize,
}

/// Gear on its way aboard. Lines, segments and bodies are numbered as in the model it began with.
#[derive(Clone)]
pub struct Haul {
    how: Hauling,
    model: Model,
    state: State,
    work: Workspace,
    ends: Vec<End>,
    boat: Boat,
    origin: Origin,
    /// Height of each body of the gear as the haul began [m].
    began_m: Vec<f64>,
    hauled_m: f64,
    felt: Felt,
}

impl Haul {
    /// Takes the step; `false` once everything is aboard.
    ///
    /// # Errors
    /// Where the solver cannot go on.
    pub fn advance(&mut self) -> Result<bool, Stop> {
        if self.ends.is_empty() {
            return Ok(false);
        }
        self.felt = Felt::default();
        let rope_m = self.boat.rope_m(&self.how, self.state.time_s, self.step_s());
        let way = self.way();
        let block =
            self.boat.advance(&self.how, &self.model.sea, way, self.state.time_s, self.step_s());
        self.take_in(rope_m, block);
        if self.ends.is_empty() {
            return Ok(false);
        }
        let were = self.lifted();
        step(&self.model, &Input::default(), &mut self.state, &mut self.work)?;
        self.feel(rope_m, &were);
        self.hauled_m += rope_m;
        Ok(true)
    }

    /// Length of a step [s].
    #[must_use]
    pub fn step_s(&self) -> f64 {
        self.model.spec.settings.step_s
    }

    /// What the last step brought.
    #[must_use]
    pub fn felt(&self) -> &Felt {
        &self.felt
    }

    /// Rope taken in so far [m].
    #[must_use]
    pub fn hauled_m(&self) -> f64 {
        self.hauled_m
    }

    /// What is not aboard yet.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The gear that is not aboard yet.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Counters of the steps since something last went aboard.
    #[must_use]
    pub fn unconverged(&self) -> u64 {
        self.origin.unconverged + self.work.audit.unconverged
    }

    /// Greatest tension of each segment that is not aboard over the last step: its number in the gear, tension [N].
    pub fn tensions(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.origin.segments.iter().copied().zip(self.work.peak_tension_n.iter().copied())
    }

    /// Bodies that are not aboard: number in the gear, rise since the haul began [m].
    pub fn risen(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let bodies = self.origin.bodies.iter().copied().zip(&self.state.bodies);
        bodies.map(|(body, at)| (body, at.position.z - self.began_m[body]))
    }

    /// Direction of the pull of all lines at the block, away from the boat.
    fn way(&self) -> DVec3 {
        let pull = |end: &End| {
            let (tip, inner, segment) = self.tip(end);
            let way = self.state.rope.position[inner] - self.state.rope.position[tip];
            way.normalize_or_zero() * self.state.rope.tension[segment].max(0.0)
        };
        self.ends.iter().map(pull).sum::<DVec3>().normalize_or(DVec3::NEG_Z)
    }

    /// First node, second node and segment of a line's end.
    fn tip(&self, end: &End) -> (usize, usize, usize) {
        let nodes = &self.model.line_nodes[end.line];
        let segments = &self.model.line_segments[end.line];
        match end.at {
            LineEnd::A => (nodes.start, nodes.start + 1, segments.start),
            LineEnd::B => (nodes.end - 1, nodes.end - 2, segments.end - 1),
        }
    }

    /// Whether each body is off the seabed.
    fn lifted(&self) -> Vec<bool> {
        self.risen().map(|(_, risen_m)| risen_m > LIFTED_M).collect()
    }

    /// Reads what a step brought.
    fn feel(&mut self, rope_m: f64, were_lifted: &[bool]) {
        let pull = |end: &End| self.work.peak_tension_n[self.tip(end).2];
        let load_n: f64 = self.ends.iter().map(pull).sum();
        let at_end = |end: &End| self.state.rope.tension[self.tip(end).2].max(0.0);
        let work_j = rope_m * self.ends.iter().map(at_end).sum::<f64>();
        let lead_rad = self.way().angle_between(DVec3::NEG_Z);
        let lifted = self.lifted().into_iter().zip(were_lifted).zip(&self.origin.bodies);
        let off = lifted.filter(|((now, before), _)| *now && !**before);
        let off: Vec<Came> = off.map(|(_, body)| Came::OffSeabed(*body)).collect();
        self.felt.came.extend(off);
        (self.felt.load_n, self.felt.lead_rad, self.felt.work_j) = (load_n, lead_rad, work_j);
    }
}
