//! Rope near solids in one step: pairs of segment and solid, and the contact points at which they may touch.
//!
//! A node of rope near a solid is a contact point. A segment has up to two more, where an edge, or a surface bent more sharply
//! than the segment is long, lies nearer than its nodes; they follow the nearest point in the first passes of a step
//! and then stay, so that Newton can finish. On a smooth drum nodes alone touch, which gives the polygon's capstan law.

use std::ops::Range;

use glam::DVec3;

use super::along::{least, nearest_stretch};
use super::broad::Boxes;
use super::{Carrier, Pose, Solid, of_model};
use crate::model::{JointKind, Model};
use crate::state::{SolidGrip, State};

/// How far beyond its radius rope is gathered [m].
pub(crate) const MARGIN_M: f64 = 0.05;
/// The same in statics, where a pass moves rope far [m].
const STATIC_MARGIN_M: f64 = 2.0;
/// Rope that comes this near in a step may touch [m].
const TOUCH_M: f64 = 2e-3;
/// Length of rope that bears at a point within a segment, for its stiffness [m].
const EDGE_M: f64 = 0.05;
/// Stretch along a flat face from which on rope bears at both of its ends [m].
const TWO_POINTS_M: f64 = 0.02;
/// Share of a segment next to its nodes that its nodes answer for.
const NODES_SHARE: f64 = 0.01;
/// Length of a line next to its body that does not touch that body [m].
const SPARED_M: f64 = 0.1;
/// How far a grip within a segment may move along the rope in a step [m].
const FOLLOWED_M: f64 = 0.05;
/// Greatest stiffness of all that touches a body, as a share of its mass over the step squared: rope and body answer each
/// other from pass to pass, which closes in on the balance the faster the softer the contact is.
const BODY_SHARE: f64 = 0.3;
/// Passes in which contact points within segments follow the nearest point.
const FOLLOWING_PASSES: usize = 4;

/// A point of rope that may touch a solid.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SolidContactPoint {
    pub solid: usize,
    pub line: usize,
    pub segment: usize,
    /// First node of the segment, or the node itself.
    pub node: usize,
    /// Fraction along the segment; `None` at the node itself.
    pub fraction: Option<f64>,
    /// Half the rope's diameter [m].
    pub radius_m: f64,
    /// Whether there is anything to touch here.
    pub open: bool,
    /// Stretch of the grip when the step began, in the solid's frame [m].
    pub kept: DVec3,
    /// Depth that is forgiven: rope that began deep inside is pushed out softly [m].
    pub forgiven_m: f64,
    /// Stiffness [N/m].
    pub stiffness: f64,
    /// Normal force that the last solve predicted [N].
    pub predicted_n: f64,
    /// Normal force at the places of the last assembly, below zero where there is a gap [N].
    pub push_n: f64,
    /// Direction out of the solid there.
    pub normal: DVec3,
}

impl SolidContactPoint {
    /// A quantity given at nodes, at this point of the rope.
    pub fn on_rope(&self, at: impl Fn(usize) -> DVec3) -> DVec3 {
        match self.fraction {
            None => at(self.node),
            Some(fraction) => at(self.node).lerp(at(self.node + 1), fraction),
        }
    }
}

/// A segment near a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub solid: usize,
    pub segment: usize,
    pub line: usize,
    pub node: usize,
    /// Fractions between which it may touch.
    range: (f64, f64),
    pub inner: [SolidContactPoint; 2],
}

/// A line's end made fast to a body, and the length of it that does not touch that body.
#[derive(Clone, Copy, Debug)]
struct Spared {
    line: usize,
    solid: usize,
    at_start: bool,
    /// Unstretched length of it [m].
    length_m: f64,
}

/// Rope near solids in one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct SolidWorkspace {
    pub solids: Vec<Solid>,
    pub pairs: Vec<Pair>,
    pub nodes: Vec<SolidContactPoint>,
    /// Whether rope may touch a solid in this step.
    pub touching: bool,
    boxes: Boxes,
    spared: Vec<Spared>,
    /// Nodes and segments of each line.
    lines: Vec<(Range<usize>, Range<usize>)>,
    /// Unstretched length of each segment [m].
    lengths: Vec<f64>,
    /// Unstretched length from the line's start to each node [m].
    along_m: Vec<f64>,
    /// Half the diameter of the rope of each line [m].
    radius_m: Vec<f64>,
    passes: usize,
    /// What the last pass of statics predicted: solid and node, normal force [N].
    predicted: Vec<((usize, usize), f64)>,
    /// Length of the step [s].
    dt: f64,
}

/// Where solids are over a step: when it begins and by their drift.
fn poses_of(solid: &Solid, state: &State, dt: f64) -> [Pose; 2] {
    match solid.carrier {
        Carrier::World(pose) => [pose, pose],
        Carrier::Body(body) => {
            let body = &state.bodies[body];
            let from = Pose { place: body.position, orientation: body.orientation };
            [from, Pose { place: body.position + body.velocity * dt, ..from }]
        }
    }
}

impl SolidWorkspace {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let solids = of_model(model);
        let spared = spared(model, &solids);
        let radius_m = model
            .spec
            .lines
            .iter()
            .map(|line| 0.5 * model.spec.ropes[line.rope].diameter_m)
            .collect();
        let lines =
            model.line_nodes.iter().cloned().zip(model.line_segments.iter().cloned()).collect();
        let along_m = vec![0.0; model.node_count];
        Self {
            boxes: Boxes::new(model),
            solids,
            spared,
            lines,
            along_m,
            radius_m,
            ..Self::default()
        }
    }

    /// Takes over the lengths of segments, where they are not those there are.
    fn measure_lengths(&mut self, segment_length: &[f64]) {
        if self.lengths == segment_length {
            return;
        }
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

    /// Gathers rope near solids for a step of length `dt` (zero in statics) that starts at `from`.
    pub fn gather(&mut self, state: &State, from: &[DVec3], dt: f64) {
        // Statics gathers anew in every pass, and goes on with what the last solve predicted.
        self.predicted.clear();
        if dt <= 0.0 {
            self.predicted.extend(
                self.nodes.iter().map(|point| ((point.solid, point.node), point.predicted_n)),
            );
        }
        self.pairs.clear();
        self.nodes.clear();
        self.touching = false;
        (self.passes, self.dt) = (0, dt);
        // Obstacles come first.
        let any = if dt > 0.0 {
            !self.solids.is_empty()
        } else {
            self.solids.first().is_some_and(|solid| solid.mass_kg.is_infinite())
        };
        if !any {
            return;
        }
        self.measure_lengths(&state.rope.segment_length);
        let drift = |node: usize| from[node] + state.rope.velocity[node] * dt;
        let margin = if dt > 0.0 { MARGIN_M } else { STATIC_MARGIN_M };
        self.add_pairs(state, from, drift, dt, margin, false);
    }

    /// Adds pairs that rope has come near to beyond what was gathered; whether there are any.
    pub fn gather_more(&mut self, state: &State, to: &[DVec3], dt: f64) -> bool {
        if self.solids.is_empty() {
            return false;
        }
        let before = self.pairs.len();
        self.add_pairs(state, &state.rope.position, |node| to[node], dt, 0.0, true);
        self.pairs.len() > before
    }

    fn add_pairs(
        &mut self,
        state: &State,
        from: &[DVec3],
        to: impl Fn(usize) -> DVec3,
        dt: f64,
        margin: f64,
        again: bool,
    ) {
        let (mut boxes, solids) =
            (std::mem::take(&mut self.boxes), std::mem::take(&mut self.solids));
        boxes.measure(from, &to);
        let widest = self.radius_m.iter().copied().fold(0.0, f64::max);
        // Statics has no friction and moves far: there bodies do not push rope.
        for (index, solid) in solids
            .iter()
            .enumerate()
            .filter(|(_, solid)| dt > 0.0 || matches!(solid.carrier, Carrier::World(_)))
        {
            let poses = poses_of(solid, state, dt);
            for (segment, node, line) in boxes.near(solid, &poses, widest + margin) {
                let places = [from[node], from[node + 1], to(node), to(node + 1)];
                let reach = self.radius_m[line] + margin;
                let known = again
                    && self.pairs.iter().any(|pair| pair.solid == index && pair.segment == segment);
                if !known && may_reach(&solid.shape, &poses, &places, reach) {
                    self.add_pair(
                        state,
                        solid,
                        (index, segment, node, line),
                        &places,
                        &poses,
                        again,
                    );
                }
            }
        }
        (self.boxes, self.solids) = (boxes, solids);
    }

    fn add_pair(
        &mut self,
        state: &State,
        thing: &Solid,
        (solid, segment, node, line): (usize, usize, usize, usize),
        places: &[DVec3; 4],
        poses: &[Pose; 2],
        again: bool,
    ) {
        let (range, radius_m) = (self.range_of(solid, line, node), self.radius_m[line]);
        let follows = self.pairs.last().is_some_and(|last| {
            last.solid == solid && last.segment + 1 == segment && last.line == line
        });
        for (end, node) in [(0, node), (1, node + 1)] {
            let there = (end == 0 && follows)
                || (again
                    && self.nodes.iter().any(|point| point.solid == solid && point.node == node));
            if there || self.is_spared(solid, line, self.along_m[node]) {
                continue;
            }
            let point = SolidContactPoint {
                solid,
                line,
                segment,
                node,
                radius_m,
                open: true,
                ..SolidContactPoint::default()
            };
            let point =
                self.begin_point(state, thing, point, [places[end], places[2 + end]], poses);
            self.nodes.push(point);
        }
        let inner = [SolidContactPoint {
            solid,
            line,
            segment,
            node,
            radius_m,
            ..SolidContactPoint::default()
        }; 2];
        let mut pair = Pair { solid, segment, line, node, range, inner };
        for (places, pose) in [(&places[..2], &poses[0]), (&places[2..], &poses[1])] {
            self.follow(state, thing, &mut pair, [places[0], places[1]], pose);
        }
        for point in pair.inner.iter_mut().filter(|point| point.open) {
            let at = |ends: &[DVec3]| ends[0].lerp(ends[1], point.fraction.unwrap_or(0.0));
            *point =
                self.begin_point(state, thing, *point, [at(&places[..2]), at(&places[2..])], poses);
        }
        self.pairs.push(pair);
    }

    /// Stiffness, grip and first normal force of a contact point whose rope goes from one place to another.
    fn begin_point(
        &mut self,
        state: &State,
        solid: &Solid,
        point: SolidContactPoint,
        places: [DVec3; 2],
        poses: &[Pose; 2],
    ) -> SolidContactPoint {
        let radius = point.radius_m;
        let depths = [0, 1].map(|k| radius - solid.shape.distance(poses[k].inward(places[k])));
        self.touching |= depths[0].max(depths[1]) > -TOUCH_M;
        let forgiven_m = (depths[0] - radius).max(0.0);
        let point = SolidContactPoint { forgiven_m, ..self.regrip(state, solid, point) };
        let here_n = point.stiffness * (depths[1] - forgiven_m);
        let known =
            self.predicted.binary_search_by_key(&(point.solid, point.node), |(key, _)| *key).ok();
        let predicted_n = match known.filter(|_| point.fraction.is_none()) {
            Some(known) => self.predicted[known].1,
            None if point.predicted_n > 0.0 => point.predicted_n,
            None => here_n,
        };
        SolidContactPoint { predicted_n, ..point }
    }

    /// Stiffness of a contact point, and the grip that it continues.
    fn regrip(
        &self,
        state: &State,
        solid: &Solid,
        mut point: SolidContactPoint,
    ) -> SolidContactPoint {
        let along_m = self.along_of(&point);
        let length = match point.fraction {
            None => self.node_length(point.node),
            Some(_) => self.length_of(point.node).min(EDGE_M),
        };
        point.stiffness = solid.stiffness_n_m2 * length;
        if solid.mass_kg.is_finite() {
            let held =
                state.rope.solid_grips.iter().filter(|grip| grip.solid == point.solid).count();
            let most = BODY_SHARE * solid.mass_kg / (self.dt * self.dt * (held + 1) as f64);
            point.stiffness = point.stiffness.min(most);
        }
        let farthest = if point.fraction.is_some() { FOLLOWED_M } else { 1e-9 };
        let mine = |grip: &&SolidGrip| {
            grip.solid == point.solid
                && grip.line == point.line
                && grip.at_node == point.fraction.is_none()
                && (grip.along_m - along_m).abs() <= farthest
        };
        let nearest = state
            .rope
            .solid_grips
            .iter()
            .filter(mine)
            .min_by(|a, b| (a.along_m - along_m).abs().total_cmp(&(b.along_m - along_m).abs()));
        if let Some(grip) = nearest {
            (point.kept, point.predicted_n) = (grip.stretch, grip.push_n);
        }
        point
    }

    /// Unstretched length that hangs on a node [m].
    fn node_length(&self, node: usize) -> f64 {
        let before = if node > 0 && self.along_m[node] > 0.0 {
            self.along_m[node] - self.along_m[node - 1]
        } else {
            0.0
        };
        let after =
            self.along_m.get(node + 1).map_or(0.0, |next| (next - self.along_m[node]).max(0.0));
        0.5 * (before + after)
    }

    /// Fractions of a segment between which it may touch a solid.
    fn range_of(&self, solid: usize, line: usize, node: usize) -> (f64, f64) {
        let (start, length) = (self.along_m[node], self.length_of(node));
        let (mut low, mut high) = (NODES_SHARE, 1.0 - NODES_SHARE);
        for spared in
            self.spared.iter().filter(|spared| spared.solid == solid && spared.line == line)
        {
            let end = (self.spared_end(spared) - start) / length;
            if spared.at_start {
                low = low.max(end);
            } else {
                high = high.min(end);
            }
        }
        (low, high)
    }

    fn is_spared(&self, solid: usize, line: usize, along_m: f64) -> bool {
        let here = |spared: &Spared| (along_m <= self.spared_end(spared)) == spared.at_start;
        self.spared
            .iter()
            .any(|spared| spared.solid == solid && spared.line == line && here(spared))
    }

    /// Where along its line a spared length ends [m].
    fn spared_end(&self, spared: &Spared) -> f64 {
        let last = self.lines[spared.line].0.end - 1;
        if spared.at_start { spared.length_m } else { self.along_m[last] - spared.length_m }
    }

    /// Lets the contact points within segments follow the nearest points, in the first passes of a step.
    pub fn follow_all(&mut self, state: &State, places: &[DVec3], pose: impl Fn(&Carrier) -> Pose) {
        self.passes += 1;
        if self.passes > FOLLOWING_PASSES {
            return;
        }
        let mut pairs = std::mem::take(&mut self.pairs);
        for pair in &mut pairs {
            let solid = &self.solids[pair.solid];
            let pose = pose(&solid.carrier);
            self.follow(state, solid, pair, [places[pair.node], places[pair.node + 1]], &pose);
        }
        self.pairs = pairs;
    }

    /// Lets them follow once more.
    pub fn follow_again(&mut self) {
        self.passes = 0;
    }

    fn follow(
        &self,
        state: &State,
        solid: &Solid,
        pair: &mut Pair,
        places: [DVec3; 2],
        pose: &Pose,
    ) {
        let fractions = self.inner_points(solid, pair, places, pose);
        for (point, fraction) in pair.inner.iter_mut().zip(fractions) {
            let was_open = point.open;
            point.open = fraction.is_some();
            if fraction.is_some() {
                point.fraction = fraction;
            }
            if point.open && !was_open {
                *point = self.regrip(
                    state,
                    solid,
                    SolidContactPoint { predicted_n: 0.0, kept: DVec3::ZERO, ..*point },
                );
            }
        }
    }

    /// Fractions of a segment at which it touches a solid between its nodes.
    fn inner_points(
        &self,
        solid: &Solid,
        pair: &Pair,
        [a, b]: [DVec3; 2],
        pose: &Pose,
    ) -> [Option<f64>; 2] {
        let length = self.length_of(pair.node);
        let (low, high) = pair.range;
        if low >= high || solid.radius_m.is_infinite() {
            return [None; 2];
        }
        let (a, b) = (pose.inward(a), pose.inward(b));
        let (at_a, at_b) = (solid.shape.distance(a), solid.shape.distance(b));
        if 0.5 * (at_a + at_b - (b - a).length()) > self.radius_m[pair.line] + TOUCH_M {
            return [None; 2];
        }
        let stretch = nearest_stretch(|at| solid.shape.distance(a.lerp(b, at)), pair.range);
        if solid.shape.bend_radius(a.lerp(b, stretch.at)) >= length {
            return [None; 2];
        }
        let within = |at: f64| (at > low + 1e-6 && at < high - 1e-6).then_some(at);
        let (first, last) = stretch.ends;
        if (last - first) * length > TWO_POINTS_M {
            [within(first), within(last)]
        } else {
            [within(stretch.at), None]
        }
    }

    /// Every contact point that is open.
    pub fn open_points(&self) -> impl Iterator<Item = &SolidContactPoint> {
        self.nodes
            .iter()
            .chain(self.pairs.iter().flat_map(|pair| &pair.inner))
            .filter(|point| point.open)
    }

    /// Every contact point that is open, to be changed.
    pub fn open_points_mut(&mut self) -> impl Iterator<Item = (&[Solid], &mut SolidContactPoint)> {
        let solids = &self.solids[..];
        let inner = self.pairs.iter_mut().flat_map(|pair| &mut pair.inner);
        self.nodes
            .iter_mut()
            .chain(inner)
            .filter(|point| point.open)
            .map(move |point| (solids, point))
    }
}

/// Whether a segment that goes from two places to two others may come within reach of a shape.
fn may_reach(
    shape: &super::SolidShape,
    poses: &[Pose; 2],
    places: &[DVec3; 4],
    reach: f64,
) -> bool {
    let middles = [0.5 * (places[0] + places[1]), 0.5 * (places[2] + places[3])];
    let half = 0.5 * (places[1] - places[0]).length().max((places[3] - places[2]).length());
    let (from, to) = (poses[0].inward(middles[0]), poses[1].inward(middles[1]));
    let nearest = shape.distance(from).min(shape.distance(to));
    nearest - half - 0.5 * (to - from).length() <= reach
}

/// The least distance of a segment from a solid, ends included.
pub(crate) fn least_distance(solid: &Solid, pose: &Pose, a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (pose.inward(a), pose.inward(b));
    least(|at| solid.shape.distance(a.lerp(b, at)), (0.0, 1.0))
        .min(solid.shape.distance(a))
        .min(solid.shape.distance(b))
}

/// Ends of lines made fast to bodies.
fn spared(model: &Model, solids: &[Solid]) -> Vec<Spared> {
    let obstacles = model.spec.obstacles.len();
    let mut list = Vec::new();
    if !model.spec.settings.rope_on_bodies {
        return list;
    }
    for (index, line) in model.spec.lines.iter().enumerate() {
        for (joint, at_start) in [(line.from, true), (line.to, false)] {
            let JointKind::Body { body, offset_m } = model.spec.joints[joint].kind else {
                continue;
            };
            let solid = obstacles + body;
            let length_m = SPARED_M.max(-2.0 * solids[solid].shape.distance(offset_m));
            list.push(Spared { line: index, solid, at_start, length_m });
        }
    }
    list
}
