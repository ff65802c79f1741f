//! Cuts lines into segments and lays them in their initial shape.
//!
//! # Number of nodes with `[resolution]`
//!
//! Rope along the whole length `L` of a whale needs `L / near` segments. Of it, at most the share [`ALONG_EDGES`] of `L` lies
//! along thin edges and needs `1 / edges` segments per metre. The rest has segments of the far length, with a gradual
//! transition. The whale may touch any line, so each line gets this number. It depends on gear and whale only; therefore
//! options of a study that differ in strength have equal meshes.

use endline_sim::DVec3;
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{JointKind, Resolution};

use crate::diagnostic::{At, Place};
use crate::limits;
use crate::scenario::LineStart;

use super::builder::{Builder, Part};
use super::line_shapes::{Around, Catenary, along, hitched, length};

/// Default total of rope nodes without a resolution.
const USUAL_NODES: u64 = 500;

/// Allowed relative difference between the length of a hitched line and its path.
const MISFIT: f64 = 0.02;

impl Builder<'_> {
    /// Cuts every line: by `chosen` total nodes, the scenario's count, or its longest segment.
    pub fn cut_lines(&mut self, chosen: Option<u64>) {
        if self.uncut.is_empty() || self.problems.any_error() {
            return;
        }
        self.check_segments();
        let lengths: Vec<f64> = self.uncut.iter().map(|line| line.length_m).collect();
        let (wanted, place) = match (&self.scenario.rope_nodes, chosen) {
            (_, Some(nodes)) => (Some(nodes), &self.scenario.place),
            (Some(nodes), None) => (Some(nodes.value), &nodes.place),
            (None, None) => (None, &self.scenario.place),
        };
        let counts = match (wanted, &self.scenario.segment_m) {
            (None, Some(longest)) => match self.counts_of_segments(&lengths, longest) {
                Some(counts) => counts,
                None => return,
            },
            (nodes, _) => {
                match share_out(nodes.unwrap_or_else(|| self.needed_nodes(&lengths)), &lengths) {
                    Some(counts) => counts,
                    None => return self.too_few(&place.clone(), lengths.len()),
                }
            }
        };
        for (index, count) in counts.into_iter().enumerate() {
            self.spec.lines[index].segments_m = vec![lengths[index] / count as f64; count];
            self.shape_start(index);
        }
    }

    /// Segments of every line, each at most of the longest length; `None` if they are too many, which is reported.
    fn counts_of_segments(&self, lengths: &[f64], longest: &At<f64>) -> Option<Vec<usize>> {
        let longest_m = |index: usize| self.own_segment(index).unwrap_or(longest.value);
        let shares: Vec<f64> =
            lengths.iter().enumerate().map(|(index, length)| length / longest_m(index)).collect();
        let nodes = shares.iter().sum::<f64>() + 2.0 * lengths.len() as f64;
        match limits::check_nodes(nodes) {
            Ok(()) => Some(shares.into_iter().map(at_least_one).collect()),
            Err(beyond) => self.problems.refuse(beyond.at(&longest.place)),
        }
    }

    /// Longest segment of a line, if the scenario sets one for it [m].
    fn own_segment(&self, index: usize) -> Option<f64> {
        let id = &self.spec.lines[index].id;
        let own = self.scenario.line_segments.iter().rev().find(|segments| segments.are_of(id));
        own.map(|segments| segments.longest_m)
    }

    /// Reports `[[segments]]` of an unknown line.
    fn check_segments(&self) {
        for segments in self.scenario.line_segments.iter().filter(|segments| segments.name_one()) {
            if !self.spec.lines.iter().any(|line| segments.are_of(&line.id)) {
                self.unknown("line", &segments.line, |part| matches!(part, Part::Line { .. }));
            }
        }
    }

    /// Default number of nodes.
    fn needed_nodes(&self, lengths: &[f64]) -> u64 {
        match (&self.spec.settings.resolution, &self.spec.whale) {
            (Some(resolution), Some(whale)) => needed(lengths, whale.length_m, resolution),
            _ => USUAL_NODES.max(2 * lengths.len() as u64),
        }
    }

    fn too_few(&self, place: &Place, lines: usize) {
        let help = format!("{lines} lines need at least {} nodes: two each", 2 * lines);
        self.problems.push(place.error("`rope_nodes` is too small for this gear", help));
    }

    /// Lays a line in its initial shape.
    fn shape_start(&mut self, index: usize) {
        if !self.uncut[index].laid_m.is_empty() {
            return self.lay(index);
        }
        match self.uncut[index].start.clone() {
            LineStart::Straight => {}
            LineStart::Catenary => self.lay_catenary(index),
            LineStart::Around { obstacle, turns, hitched } => {
                self.lay_around(index, &obstacle, turns, hitched)
            }
            LineStart::Wrapped(wraps) => {
                let longest =
                    self.spec.lines[index].segments_m.first().copied().unwrap_or(f64::INFINITY);
                self.lay_wrapped(index, &wraps, longest);
            }
        }
    }

    fn lay_catenary(&mut self, index: usize) {
        let line = &self.spec.lines[index];
        let rope = &self.spec.ropes[line.rope];
        let water = &self.spec.water;
        let weight =
            (rope.mass_kg_m - water.density_kg_m3 * rope.displaced_m3_m) * water.gravity_m_s2;
        let (from, to) = (self.joint_place(line.from), self.joint_place(line.to));
        let length = self.uncut[index].length_m;
        let Some(catenary) = Catenary::between(to - from, length, weight, rope.axial_stiffness_n)
        else {
            let message = format!("there is no catenary for line `{}` between its ends", line.id);
            self.problems.push(self.uncut[index].place.error(
                message,
                "correct its length or the places of its ends, or write start = \"straight\"",
            ));
            return;
        };
        self.lay_along(index, |share| from + catenary.at(length * share));
    }

    fn lay_around(&mut self, index: usize, id: &At<String>, turns: f64, is_hitched: bool) {
        let Some(Part::Obstacle(obstacle)) = self.part(&id.value) else {
            return self.unknown("obstacle", id, |part| matches!(part, Part::Obstacle(_)));
        };
        let obstacle = &self.spec.obstacles[obstacle];
        let SolidShape::Cylinder { radius_m, .. } = obstacle.shape else {
            let help = "rope can only start round an obstacle with shape = \"cylinder\"";
            return self
                .problems
                .push(id.place.error(format!("`{}` is not a cylinder", id.value), help));
        };
        let line = &self.spec.lines[index];
        let thick = self.spec.ropes[line.rope].diameter_m;
        let radius = radius_m + 0.5 * thick;
        let ends = [self.joint_place(line.from), self.joint_place(line.to)];
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| obstacle.orientation * axis);
        match Around::between(ends, obstacle.position_m, axes, radius, turns) {
            Some(path) if is_hitched => self.lay_way(index, &hitched(&path, thick)),
            Some(path) => self.lay_along(index, |share| path.at(share)),
            None => {
                let message = format!("an end of line `{}` is inside `{}`", line.id, id.value);
                self.problems.push(id.place.error(message, "move both ends outside"));
            }
        }
    }

    /// Lays a line along a path that crosses itself and therefore must have the length of the line.
    fn lay_way(&mut self, index: usize, way: &[DVec3]) {
        let (long, own) = (length(way), self.uncut[index].length_m);
        if (own / long - 1.0).abs() > MISFIT {
            let message = format!(
                "line `{}` is {own:.4} m long, its path with two half hitches {long:.4} m",
                self.spec.lines[index].id
            );
            self.problems.push(
                self.uncut[index]
                    .place
                    .error(message, format!("write length = \"{long:.4} m\", or move its ends")),
            );
        }
        self.lay_along(index, |share| along(way, share));
    }

    /// Lays the nodes of a line along a path; the ends are at their joints.
    fn lay_along(&mut self, index: usize, path: impl Fn(f64) -> DVec3) {
        let line = &self.spec.lines[index];
        let (from, to) = (self.joint_place(line.from), self.joint_place(line.to));
        let count = line.segments_m.len();
        let node = |k: usize| match k {
            0 => from,
            k if k == count => to,
            k => path(k as f64 / count as f64),
        };
        self.spec.lines[index].start_m = (0..=count).map(node).collect();
    }

    /// Lays the nodes of a line evenly along the path of its gear type.
    fn lay(&mut self, index: usize) {
        let line = &self.spec.lines[index];
        let (from, to) = (self.joint_place(line.from), self.joint_place(line.to));
        let mut way = std::mem::take(&mut self.uncut[index].laid_m);
        if let [first, .., last] = way.as_mut_slice() {
            (*first, *last) = (from, to);
        }
        let count = line.segments_m.len();
        self.spec.lines[index].start_m =
            (0..=count).map(|k| along(&way, k as f64 / count as f64)).collect();
    }

    /// Initial place of a joint [m].
    pub fn joint_place(&self, joint: usize) -> DVec3 {
        let joint = &self.spec.joints[joint];
        match joint.kind {
            JointKind::Body { body, offset_m } => {
                let body = &self.spec.bodies[body];
                body.position_m + body.orientation * offset_m
            }
            _ => joint.position_m,
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "lengths are positive and bounded by the reader"
)]
fn at_least_one(count: f64) -> usize {
    (count - 1e-9).ceil().max(1.0) as usize
}

/// Segments of each line in proportion to its length, at least one each, for a total of `nodes`, by the largest remainder
/// method.
fn share_out(nodes: u64, lengths: &[f64]) -> Option<Vec<usize>> {
    let spare = usize::try_from(nodes).ok()?.checked_sub(2 * lengths.len())?;
    let total: f64 = lengths.iter().sum();
    let shares: Vec<f64> = lengths.iter().map(|length| spare as f64 * length / total).collect();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "shares are positive and below `spare`"
    )]
    let mut counts: Vec<usize> = shares.iter().map(|share| 1 + share.floor() as usize).collect();
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    order.sort_by(|a, b| shares[*b].fract().total_cmp(&shares[*a].fract()).then(a.cmp(b)));
    let left = (nodes as usize).checked_sub(counts.iter().map(|count| count + 1).sum())?;
    for index in order.iter().cycle().take(left) {
        counts[*index] += 1;
    }
    Some(counts)
}

/// Length of thin edges (both edges of two flippers and of the flukes) over the length of the whale.
const ALONG_EDGES: f64 = 0.6;
/// Segments of the transition over the logarithm of its length ratio: growth by 30 % of the distance, on both sides.
const BETWEEN: f64 = 2.0 / 0.3;
/// Greatest automatic number of nodes.
const MOST_NODES: u64 = 2_000;

/// Nodes for lines of these lengths [m] near a whale of this length [m], at most [`MOST_NODES`].
fn needed(lengths: &[f64], whale_m: f64, resolution: &Resolution) -> u64 {
    let all: f64 = lengths.iter().map(|length| of_line(*length, whale_m, resolution)).sum();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and bounded by `MOST_NODES`"
    )]
    let nodes = all.min(MOST_NODES as f64).ceil() as u64;
    nodes.max(2 * lengths.len() as u64)
}

/// Nodes for one line.
fn of_line(length_m: f64, whale_m: f64, resolution: &Resolution) -> f64 {
    let along_edges = (ALONG_EDGES * whale_m).min(length_m);
    let near = (whale_m - along_edges).min(length_m - along_edges);
    let far = length_m - along_edges - near;
    let between = BETWEEN * libm::log(resolution.far_m / resolution.edge_m);
    let graded = far / resolution.far_m + between.min(far / resolution.near_m);
    along_edges / resolution.edge_m + near / resolution.near_m + graded + 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Resolution = Resolution { near_m: 0.05, edge_m: 0.0125, far_m: 2.0 };

    #[test]
    fn a_short_line_is_cut_to_the_edge_length() {
        assert_eq!(needed(&[5.0], 13.7, &FINE), 401);
    }

    #[test]
    fn a_long_line_has_near_segments_for_the_whale_and_far_segments_for_the_rest() {
        let of = |length| needed(&[length], 10.0, &FINE);
        // 6 m along edges, 4 m near.
        assert!((561..640).contains(&of(30.0)), "{}", of(30.0));
        assert_eq!(of(230.0) - of(30.0), 100);
    }

    #[test]
    fn coarse_resolution_needs_few_nodes_and_the_number_is_limited() {
        let coarse = Resolution { near_m: 0.5, edge_m: 0.5, far_m: 2.0 };
        assert!(needed(&[30.0], 13.7, &coarse) < 60);
        assert_eq!(needed(&[40.0; 9], 13.7, &FINE), MOST_NODES);
    }
}
