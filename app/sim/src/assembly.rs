//! Makes models: checks a spec, and lays out its nodes and segments.

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::LineEnd;

use crate::model::{JointKind, Knot, Line, Model, ModelError, ModelSpec, Settings, Strength};
use crate::model_check::check;
use crate::water::Sea;
use crate::whale::tree::SkinTree;

impl Model {
    /// Checks a spec and lays out nodes and segments.
    ///
    /// # Errors
    /// Everything wrong with it, all at once.
    pub fn new(spec: ModelSpec) -> Result<Self, Vec<ModelError>> {
        let errors = check(&spec);
        if !errors.is_empty() {
            return Err(errors);
        }
        let skin_tree =
            spec.whale.as_ref().map(|whale| Arc::new(SkinTree::new(whale.skin.clone())));
        let sea = Sea::new(&spec.water, spec.seabed.as_ref(), spec.settings.seed);
        Ok(Self::laid_out(spec, skin_tree, sea))
    }

    /// Lays out nodes and segments.
    fn laid_out(spec: ModelSpec, skin_tree: Option<Arc<SkinTree>>, sea: Sea) -> Self {
        let (mut line_nodes, mut line_segments) = (Vec::new(), Vec::new());
        let (mut node_count, mut segment_count) = (0, 0);
        for line in &spec.lines {
            let segments = line.segments_m.len();
            line_nodes.push(node_count..node_count + segments + 1);
            line_segments.push(segment_count..segment_count + segments);
            node_count += segments + 1;
            segment_count += segments;
        }
        let segment_line = spec
            .lines
            .iter()
            .enumerate()
            .flat_map(|(index, line)| std::iter::repeat_n(index, line.segments_m.len()))
            .collect();
        let segment_strength_n = spec
            .lines
            .iter()
            .flat_map(|line| strengths(line, spec.ropes[line.rope].strength_n))
            .collect();
        let knots = knots(&spec, &line_segments);
        Self {
            knots,
            spec,
            line_nodes,
            line_segments,
            node_count,
            segment_count,
            segment_line,
            segment_strength_n,
            skin_tree,
            sea,
        }
    }

    /// This gear in this sea with other lines, and without whale, plugins, links and probes.
    pub(crate) fn with_lines(&self, lines: Vec<Line>) -> Self {
        let spec = &self.spec;
        let alone = ModelSpec {
            water: spec.water.clone(),
            seabed: spec.seabed.clone(),
            ropes: spec.ropes.clone(),
            joints: spec.joints.clone(),
            lines,
            bodies: spec.bodies.clone(),
            links: Vec::new(),
            gear: Vec::new(),
            whale: None,
            friction: None,
            obstacles: spec.obstacles.clone(),
            probes: Vec::new(),
            settings: Settings { resolution: None, ..spec.settings.clone() },
        };
        Self::laid_out(alone, None, self.sea.clone())
    }

    /// Another spec without a whale in this sea, with its waves as they were drawn.
    pub(crate) fn with_spec(&self, spec: ModelSpec) -> Self {
        Self::laid_out(spec, None, self.sea.clone())
    }

    /// This gear alone in a share of its current.
    pub(crate) fn with_current_times(&self, share: f64) -> Self {
        let mut weaker = self.with_lines(self.spec.lines.clone());
        weaker.spec.water.current.surface_m_s *= share;
        weaker.sea.weaken_current(share);
        weaker
    }
}

/// Knots at the ends of lines: where lines meet at a joint one, the greatest, around it; at a body or fixture each beside it.
fn knots(spec: &ModelSpec, line_segments: &[Range<usize>]) -> Vec<Knot> {
    let mut knots: Vec<(usize, Knot)> = Vec::new();
    for (line, segments) in spec.lines.iter().zip(line_segments) {
        let ends =
            [(LineEnd::A, line.from, segments.start), (LineEnd::B, line.to, segments.end - 1)];
        for ((end, joint, segment), radius_m) in ends.into_iter().zip(line.knots_m) {
            let is_free = matches!(spec.joints[joint].kind, JointKind::Free);
            let from_end_m = if is_free { 0.0 } else { radius_m };
            let knot = Knot { segment, end, from_end_m, radius_m };
            let other = knots.iter_mut().find(|(of, _)| is_free && *of == joint);
            match other {
                Some((_, other)) if other.radius_m < radius_m => *other = knot,
                None if radius_m > 0.0 => knots.push((joint, knot)),
                _ => {}
            }
        }
    }
    let mut knots: Vec<Knot> = knots.into_iter().map(|(_, knot)| knot).collect();
    knots.sort_by_key(|knot| knot.segment);
    knots
}

/// Strength of each segment of a line: an end's factor weakens the segment at that end.
fn strengths(line: &Line, rope_n: f64) -> Vec<f64> {
    let Strength { all, end_a, end_b } = line.strength;
    let mut strengths = vec![rope_n * all; line.segments_m.len()];
    let last = strengths.len() - 1;
    strengths[0] *= end_a;
    strengths[last] = strengths[last].min(rope_n * all * end_b);
    strengths
}
