//! Rope near solids in one step: pairs of segment and solid, and the contact points at which they may touch.
//!
//! A node of rope near a solid is a contact point. A segment has up to two more, where an edge, or a surface bent more sharply
//! than the segment is long, lies nearer than its nodes; they follow the nearest point in the first passes of a step
//! and then stay, so that Newton can finish. On a smooth drum nodes alone touch, which gives the polygon's capstan law.

mod excluded;
mod follow;
mod gather;
pub(crate) mod kind;
mod points;
mod ray;

use std::ops::Range;

use glam::DVec3;

use crate::broad_phase::pieces::Pieces;
use crate::broad_phase::solids::Neighbours;
use crate::geometry::Pose;
use crate::geometry::along::least;
use crate::model::{Knot, Line, Model};
use crate::solids::{Solid, of_model};
use crate::state::RopeWithin;
use excluded::{Spared, spared};
pub(crate) use points::SolidContactPoint;

/// Distance from a solid beyond its radius within which rope is gathered for long steps [m].
pub(crate) const MARGIN_M: f64 = 0.05;

/// Rope no farther from its drift than this share of the margin has reached no solid for which it was not gathered: in the bound of the
/// search, distance and half length change by no more than that, and half the path by half of it, together by less than the margin.
const UNWATCHED_SHARE: f64 = 0.35;

/// A segment near a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub solid: usize,
    pub segment: usize,
    pub line: usize,
    pub node: usize,
    /// Fractions between which it may touch.
    pub range: (f64, f64),
    pub inner: [SolidContactPoint; 2],
}

/// Rope near solids in one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct RopeOnSolid {
    pub solids: Vec<Solid>,
    /// The body that each of them is a part of.
    body_of: Vec<Option<usize>>,
    /// Distance from a solid beyond its radius within which rope was gathered [m].
    pub margin_m: f64,
    pub pairs: Vec<Pair>,
    pub nodes: Vec<SolidContactPoint>,
    /// Knots near solids.
    pub knots: Vec<SolidContactPoint>,
    /// Whether rope may touch a solid in this step.
    pub touching: bool,
    spared: Vec<Spared>,
    /// Nodes and segments of each line.
    lines: Vec<(Range<usize>, Range<usize>)>,
    /// Unstretched length of each segment [m], and which lengths of the pieces these are.
    lengths: Vec<f64>,
    lengths_number: u64,
    /// Unstretched length from the line's start to each node [m].
    along_m: Vec<f64>,
    /// Half the diameter of the rope of each line [m].
    radius_m: Vec<f64>,
    /// Knots of the model, and the greatest radius of rope and knots [m].
    all_knots: Vec<Knot>,
    widest_m: f64,
    passes: usize,
    /// Rope within bodies when the step begins.
    within: Vec<RopeWithin>,
    /// Stiffness of bodies under rope in statics, per length; `None`: rope passes through them [N/m²].
    pub at_rest_n_m2: Option<f64>,
    /// Where bodies are when the step begins.
    bodies: Vec<Pose>,
    /// Normal forces predicted by the last iteration of statics: solid and node, force [N].
    predicted: Vec<((usize, usize), f64)>,
    /// Length of the step [s].
    dt: f64,
    /// Where solids are when the step begins, and by their drift.
    poses: Vec<[Pose; 2]>,
    neighbours: Neighbours,
}

impl RopeOnSolid {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let solids = of_model(model);
        let spared = spared(model, &solids);
        let body_of = solids.iter().map(|solid| solid.carrier.body()).collect();
        let radius = |line: &Line| 0.5 * model.spec.ropes[line.rope].diameter_m;
        let radius_m: Vec<f64> = model.spec.lines.iter().map(radius).collect();
        let knots_m = model.knots.iter().map(|knot| knot.radius_m);
        let widest_m = radius_m.iter().copied().chain(knots_m).fold(0.0, f64::max);
        let lines =
            model.line_nodes.iter().cloned().zip(model.line_segments.iter().cloned()).collect();
        let along_m = vec![0.0; model.node_count];
        let all_knots = model.knots.clone();
        let sizes = Self { lines, along_m, radius_m, widest_m, ..Self::default() };
        Self { solids, body_of, spared, all_knots, ..sizes }
    }

    /// Distance of rope from its drift up to which it has reached no solid for which it was not gathered [m].
    pub fn unwatched_m(&self) -> f64 {
        UNWATCHED_SHARE * self.margin_m
    }

    /// Copies the lengths of segments for which pieces were measured, if they have changed.
    fn take_lengths(&mut self, pieces: &Pieces, segment_length: &[f64]) {
        if self.lengths_number != pieces.lengths_number {
            self.lengths_number = pieces.lengths_number;
            self.measure_lengths(segment_length);
        }
    }

    /// Copies the lengths of segments.
    fn measure_lengths(&mut self, segment_length: &[f64]) {
        self.lengths.clear();
        self.lengths.extend_from_slice(segment_length);
        for (nodes, segments) in &self.lines {
            let mut along = 0.0;
            for (node, length) in (nodes.start..).zip(&segment_length[segments.clone()]) {
                self.along_m[node] = along;
                along += length;
            }
            self.along_m[nodes.end - 1] = along;
        }
    }

    /// Unstretched length of a segment [m].
    fn length_of(&self, node: usize) -> f64 {
        self.along_m[node + 1] - self.along_m[node]
    }

    /// Unstretched length from the line's start to a contact point [m].
    pub fn along_of(&self, point: &SolidContactPoint) -> f64 {
        self.along_m[point.node]
            + point.fraction.map_or(0.0, |fraction| fraction * self.length_of(point.node))
    }

    /// Every contact point that is open.
    pub fn open_points(&self) -> impl Iterator<Item = &SolidContactPoint> {
        self.nodes
            .iter()
            .chain(&self.knots)
            .chain(self.pairs.iter().flat_map(|pair| &pair.inner))
            .filter(|point| point.open)
    }

    /// Every contact point that is open, to be changed.
    pub fn open_points_mut(&mut self) -> impl Iterator<Item = (&[Solid], &mut SolidContactPoint)> {
        let solids = &self.solids[..];
        let inner = self.pairs.iter_mut().flat_map(|pair| &mut pair.inner);
        self.nodes
            .iter_mut()
            .chain(&mut self.knots)
            .chain(inner)
            .filter(|point| point.open)
            .map(move |point| (solids, point))
    }
}

/// The least distance of a segment from a solid, ends included.
pub(crate) fn least_distance(solid: &Solid, pose: &Pose, a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (pose.inward(a), pose.inward(b));
    least(|at| solid.shape.distance(a.lerp(b, at)), (0.0, 1.0))
        .min(solid.shape.distance(a))
        .min(solid.shape.distance(b))
}
