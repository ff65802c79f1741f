//! Hauling: rope is taken in over a block at the hauler's speed, and bodies come aboard with it.
//!
//! In each step `dt` the hauler takes in a length `V dt` of rope. The node of a line at the block is the material point that
//! reaches the block at the end of the step: it starts the step `V dt` below the block and is driven up to it. With `x` its
//! position, `n` the next node, `c = |n - x|` and `l` the chord and the unstretched length of the segment between them:
//!
//! `f = V dt / max(c, l)`,  `x ← x + f (n - x)`,  `l ← (1 - f) l`,  `v = (P - x)/dt`
//!
//! with `P` the position of the block at the end of the step. The strain is unchanged, so that the tension does not jump at the
//! block.
//! Weight, drag, added mass, seabed contact and suction follow from the solver ([`step`](fn@crate::step)).
//! If `f ≥ 1`, the next node has reached the block and the segment is aboard. If that was the last segment of its line, all
//! other lines at the joint are taken in together. A body that reaches the block is aboard and exerts no further force.
//! Gear that is aboard is removed: each passage makes a new model of the rest (`take_in.rs`).
//!
//! The line is first lifted from the surface to the block at the hauler's speed; then the hauler accelerates to its speed `V`.
//! The block moves with the sea surface `η` below it, `z = h + r η(x, y, t)`, with `h` its height and `r` the heave ratio. The
//! boat follows the line. With `θ` the angle of the line from the vertical and `θ₀` the angle at which the boat keeps pace, the
//! target speed is `V min(tan θ / tan θ₀, 1.5)` in the direction of the line; the actual speed approaches it with the time
//! constant [`HELM_S`]. A drift velocity is added. This law of following is an estimate.
//!
//! Lengths are in metres, times in seconds. Not included: contact of the gear with itself, slip and bending on the sheave, and
//! a hauler that slows under load. Sources and defaults: docs/hauling.md.

mod setup;
mod take_in;

use endline_sdk::LineEnd;
use glam::DVec3;

use crate::model::Model;
use crate::state::State;
use crate::step::{Input, Stop, Workspace, step};
use crate::water::Sea;
use take_in::Origin;

pub use setup::endlines;

/// Rise above which a body counts as off the seabed: more than the rise of a trap tipped on its end [m].
pub const LIFTED_M: f64 = 0.5;

/// Settings of a haul.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hauling {
    /// Speed of rope over the block [m/s].
    pub speed_m_s: f64,
    /// Time in which the hauler reaches its speed [s].
    pub start_s: f64,
    /// Height of the block above the sea surface [m].
    pub block_m: f64,
    /// Ratio of the heave of the block to that of the surface below it [1].
    pub heave: f64,
    /// Angle of the line from the vertical at which the boat keeps pace with the hauler; `None` for a boat that does not
    /// follow the line [rad].
    pub lead_rad: Option<f64>,
    /// Additional drift of the boat [m/s].
    pub drift_m_s: DVec3,
}

/// An event of a haul.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HaulEvent {
    /// The first rope of this line reaches the block.
    Line(usize),
    /// This body has risen by [`LIFTED_M`].
    OffSeabed(usize),
    /// This body is aboard.
    Aboard(usize),
}

/// Loads and events of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HaulStep {
    /// Greatest load of all rope on the block during the step [N].
    pub load_n: f64,
    /// Angle of the line at the block from the vertical [rad].
    pub lead_rad: f64,
    /// Work of the hauler in the step: load times rope taken in [J].
    pub work_j: f64,
    /// Events.
    pub events: Vec<HaulEvent>,
}

/// A line end at the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct End {
    line: usize,
    at: LineEnd,
    joint: usize,
}

/// A haul in progress. Lines, segments and bodies are numbered as in the initial model.
#[derive(Clone)]
pub struct Haul {
    how: Hauling,
    model: Model,
    state: State,
    work: Workspace,
    ends: Vec<End>,
    boat: Boat,
    origin: Origin,
    /// Height of each body at the start of the haul [m].
    began_m: Vec<f64>,
    hauled_m: f64,
    last_step: HaulStep,
}

impl Haul {
    /// Advances by a step; returns `false` when everything is aboard.
    /// Errors: reports why the solver cannot continue.
    pub fn advance(&mut self) -> Result<bool, Stop> {
        if self.ends.is_empty() {
            return Ok(false);
        }
        self.last_step = HaulStep::default();
        let rope_m = self.boat.rope_m(&self.how, self.state.time_s, self.step_s());
        let way = self.way();
        let block =
            self.boat.advance(&self.how, &self.model.sea, way, self.state.time_s, self.step_s());
        self.take_in(rope_m, block);
        if self.ends.is_empty() {
            return Ok(false);
        }
        let were_lifted = self.lifted();
        step(&self.model, &Input::default(), &mut self.state, &mut self.work)?;
        self.record(rope_m, &were_lifted);
        self.hauled_m += rope_m;
        Ok(true)
    }

    /// Length of a step [s].
    pub fn step_s(&self) -> f64 {
        self.model.spec.settings.step_s
    }

    /// Loads and events of the last step.
    pub fn last_step(&self) -> &HaulStep {
        &self.last_step
    }

    /// Rope taken in so far [m].
    pub fn hauled_m(&self) -> f64 {
        self.hauled_m
    }

    /// State of the gear that is not aboard.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Model of the gear that is not aboard.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Number of unconverged solver steps.
    pub fn unconverged(&self) -> u64 {
        self.origin.unconverged + self.work.audit.unconverged
    }

    /// Index and greatest tension over the last step of each segment that is not aboard [N].
    pub fn tensions(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.origin.segments.iter().copied().zip(self.work.peak_tension_n.iter().copied())
    }

    /// Index of each body that is not aboard, and its rise since the start of the haul [m].
    pub fn risen(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let bodies = self.origin.bodies.iter().copied().zip(&self.state.bodies);
        bodies.map(|(body, at)| (body, at.position.z - self.began_m[body]))
    }

    /// Direction of the total load of all lines at the block, away from the boat.
    fn way(&self) -> DVec3 {
        let pull = |end: &End| {
            let (tip, inner, segment) = self.tip(end);
            let way = self.state.rope.position[inner] - self.state.rope.position[tip];
            way.normalize_or_zero() * self.state.rope.tension[segment].max(0.0)
        };
        self.ends.iter().map(pull).sum::<DVec3>().normalize_or(DVec3::NEG_Z)
    }

    /// First node, second node and segment at a line end.
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

    /// Records the loads and events of a step.
    fn record(&mut self, rope_m: f64, were_lifted: &[bool]) {
        let pull = |end: &End| self.work.peak_tension_n[self.tip(end).2];
        let load_n: f64 = self.ends.iter().map(pull).sum();
        let at_end = |end: &End| self.state.rope.tension[self.tip(end).2].max(0.0);
        let work_j = rope_m * self.ends.iter().map(at_end).sum::<f64>();
        let lead_rad = self.way().angle_between(DVec3::NEG_Z);
        let lifted = self.lifted().into_iter().zip(were_lifted).zip(&self.origin.bodies);
        let off = lifted.filter(|((now, before), _)| *now && !**before);
        let off: Vec<HaulEvent> = off.map(|(_, body)| HaulEvent::OffSeabed(*body)).collect();
        let step = &mut self.last_step;
        step.events.extend(off);
        (step.load_n, step.lead_rad, step.work_j) = (load_n, lead_rad, work_j);
    }
}

/// Time constant of the boat's speed; an estimate [s].
const HELM_S: f64 = 3.0;

/// Greatest ratio of the boat's target speed to the hauler's; an estimate.
const MOST_PACE: f64 = 1.5;

/// Least vertical share of the line's direction at the block.
const LEAST_DROP: f64 = 0.02;

/// The boat.
#[derive(Clone, Copy, Debug)]
struct Boat {
    /// Position of the line end before it was lifted [m].
    from: DVec3,
    /// Position of the block without heave [m].
    block: DVec3,
    /// Speed of following the line [m/s].
    following_m_s: DVec3,
    /// Time of lifting the line to the block [s].
    lift_s: f64,
}

impl Boat {
    /// A boat above a line end.
    pub fn at(from: DVec3, how: &Hauling) -> Self {
        let lift_s = (how.block_m - from.z).max(0.0) / how.speed_m_s;
        Self { from, block: from, following_m_s: DVec3::ZERO, lift_s }
    }

    /// Length of rope that the hauler takes in during a step [m].
    pub fn rope_m(&self, how: &Hauling, time_s: f64, step_s: f64) -> f64 {
        let since = time_s + 0.5 * step_s - self.lift_s;
        how.speed_m_s * step_s * (since / how.start_s.max(step_s)).clamp(0.0, 1.0)
    }

    /// Advances by a step; returns the position of the block at its end [m].
    pub fn advance(
        &mut self,
        how: &Hauling,
        sea: &Sea,
        way: DVec3,
        time_s: f64,
        step_s: f64,
    ) -> DVec3 {
        let end_s = time_s + step_s;
        if end_s > self.lift_s {
            let wanted = follow(how, way);
            self.following_m_s += (wanted - self.following_m_s) * (step_s / HELM_S).min(1.0);
            self.block += (self.following_m_s + how.drift_m_s) * step_s;
        }
        let lifted = if self.lift_s > 0.0 { (end_s / self.lift_s).min(1.0) } else { 1.0 };
        self.block.z = self.from.z + (how.block_m - self.from.z) * lifted;
        let surface_m = sea.at(DVec3::new(self.block.x, self.block.y, 0.0), end_s).surface_m;
        self.block + DVec3::Z * (how.heave * lifted * surface_m)
    }
}

/// Target velocity of the boat to follow the line [m/s].
fn follow(how: &Hauling, way: DVec3) -> DVec3 {
    let Some(lead_rad) = how.lead_rad else { return DVec3::ZERO };
    let level = DVec3::new(way.x, way.y, 0.0);
    let slant = level.length() / (-way.z).max(LEAST_DROP);
    let pace = (slant / libm::tan(lead_rad)).min(MOST_PACE);
    level.normalize_or_zero() * (how.speed_m_s * pace)
}
