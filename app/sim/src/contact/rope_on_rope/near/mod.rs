//! Rope near rope in one step: pairs of segments, the points at which they may press, and how far rope may move without crossing.

mod gather;
mod moves;
mod open;
#[cfg(test)]
mod tests;

use glam::DVec3;

pub(crate) use gather::MARGIN_M;

use crate::broad_phase::knots::Ball;
use crate::broad_phase::ropes::{Broad, Found};
use crate::contact::rope_on_rope::points::RopeContactPoint;
use crate::geometry::segment_pair::nearest;
use crate::geometry::sweep::SweptSegment;
use crate::model::{Model, RopeOnRope as RopeLaw};
use crate::state::State;

/// Distance beyond contact within which ropes may touch in a step [m].
const TOUCH_M: f64 = 2e-3;

/// Ropes that may touch rest on each other where they move past each other by no more in a step of the model, as a share of their contact
/// distance.
const REST_SHARE: f64 = 0.1;

/// Where a segment belongs.
#[derive(Clone, Copy, Debug)]
struct Home {
    line: usize,
    node: usize,
    radius_m: f64,
}

/// Two segments that may touch, the first below the second; or a knot on the first, and the second or a knot on that.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub segments: [usize; 2],
    /// Numbers of the knots that it is about, and where they lie on the segments.
    pub knots: [Option<usize>; 2],
    knots_at: [Option<f64>; 2],
    /// First node of each.
    pub nodes: [usize; 2],
    lines: [usize; 2],
    /// Sum of the radii of rope or knots that touch [m].
    pub contact_distance: f64,
    min_separation: f64,
    /// Distance when the step began [m].
    first: f64,
    /// Whether the two may touch in this step.
    may_touch: bool,
    pub points: [RopeContactPoint; 2],
}

/// Rope against rope in one model. A step depends on nothing that is stored here between steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct RopeOnRope {
    /// `None` if ropes pass through each other.
    pub law: Option<RopeLaw>,
    pub pairs: Vec<Pair>,
    /// Distance beyond contact within which they were gathered [m].
    margin_m: f64,
    /// Of each pair: its distance when the step began, beyond the contact distance [m].
    room_m: Vec<f64>,
    /// Pairs with open contact points, in order.
    pub(super) opened: Vec<usize>,
    /// Whether ropes may touch in this step.
    pub touching: bool,
    /// Pairs that pass through each other; some may be listed twice.
    through: Vec<[usize; 2]>,
    homes: Vec<Home>,
    /// Joints at the ends of each line, and its unstretched length [m].
    ends: Vec<([usize; 2], f64)>,
    /// Unstretched length of each segment, and from its line's start to it [m].
    lengths: Vec<f64>,
    /// Which lengths of the pieces these are.
    lengths_number: u64,
    along_m: Vec<f64>,
    widest_m: f64,
    shortest_m: f64,
    /// Knots in the model's order, and the greatest radius of them and of rope [m].
    knots: Vec<Ball>,
    widest_knot_m: f64,
    broad: Broad,
    found: Found,
    /// Assemblies of this step.
    assemblies: usize,
    /// Iterations since points were opened.
    pub(super) iterations: usize,
    /// Two segments at which more places are in contact than can be solved.
    pub crowded: Option<[usize; 2]>,
}

impl RopeOnRope {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let Some(law) = model.spec.settings.rope_on_rope else { return Self::default() };
        let mut homes = Vec::with_capacity(model.segment_count);
        for (line, nodes) in model.line_nodes.iter().enumerate() {
            let radius_m = 0.5 * model.spec.ropes[model.spec.lines[line].rope].diameter_m;
            homes.extend((nodes.start..nodes.end - 1).map(|node| Home { line, node, radius_m }));
        }
        let (knots, widest_m) =
            (Ball::all(model), homes.iter().map(|home| home.radius_m).fold(0.0, f64::max));
        Self {
            law: Some(law),
            widest_m,
            widest_knot_m: knots.iter().map(|ball| ball.radius_m).fold(widest_m, f64::max),
            knots,
            homes,
            ends: model.spec.lines.iter().map(|line| ([line.from, line.to], 0.0)).collect(),
            along_m: vec![0.0; model.segment_count],
            ..Self::default()
        }
    }

    /// Whether ropes that may touch in this step rest on each other.
    pub fn rest(&self, model: &Model, state: &State) -> bool {
        let step_s = model.spec.settings.step_s;
        let rests = |pair: &Pair| {
            let [one, other] = pair.shapes(|node| state.rope.position[node]);
            let [moving, past] = pair.shapes(|node| state.rope.velocity[node]);
            let speed_m_s = between(moving, past, nearest(one, other).fractions).1;
            speed_m_s * step_s <= REST_SHARE * pair.contact_distance
        };
        self.pairs.iter().filter(|pair| pair.may_touch).all(rests)
    }

    /// How many pairs run through each other.
    pub fn count_through(&mut self) -> u64 {
        self.through.sort_unstable();
        self.through.dedup();
        self.through.len() as u64
    }
}

impl Pair {
    /// Values of a quantity of nodes at the ends of both segments.
    pub fn places(&self, at: impl Fn(usize) -> DVec3) -> [[DVec3; 2]; 2] {
        self.nodes.map(|node| [at(node), at(node + 1)])
    }

    /// Values of a quantity of nodes at the parts that touch: a segment by its ends, a knot by its middle twice.
    pub fn shapes(&self, at: impl Fn(usize) -> DVec3) -> [[DVec3; 2]; 2] {
        let [one, other] = self.places(at);
        [shape(one, self.knots_at[0]), shape(other, self.knots_at[1])]
    }

    /// The parts that touch, over a move.
    fn sweeps(&self, from: &[DVec3], to: impl Fn(usize) -> DVec3) -> [SweptSegment; 2] {
        let ([one, other], [one_to, other_to]) = (self.shapes(|node| from[node]), self.shapes(to));
        [(one, one_to), (other, other_to)].map(|([a0, b0], [a1, b1])| SweptSegment {
            a0,
            b0,
            a1,
            b1,
        })
    }

    /// Whether a knot touches here, and not the rope.
    pub fn is_of_knot(&self) -> bool {
        self.knots[0].is_some()
    }

    /// Its key.
    fn key(&self) -> ([usize; 2], [Option<usize>; 2]) {
        (self.segments, self.knots)
    }
}

fn shape(segment: [DVec3; 2], knot_at: Option<f64>) -> [DVec3; 2] {
    knot_at.map_or(segment, |at| [segment[0].lerp(segment[1], at); 2])
}

/// From the point of the second segment to that of the first, and how long that is.
pub(crate) fn between(one: [DVec3; 2], other: [DVec3; 2], [s, t]: [f64; 2]) -> (DVec3, f64) {
    let gap = one[0].lerp(one[1], s) - other[0].lerp(other[1], t);
    (gap, gap.length())
}
