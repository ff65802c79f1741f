//! The separate gears of a model: lines and bodies that joints connect. A field of traps has one for each endline.

use std::ops::Range;

use super::{Body, JointKind, Line, Model, ModelSpec};

/// Which gear each line and each body belongs to; gears are numbered in the order of their first line, then of their first body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gears {
    /// Gear of each line.
    pub of_line: Vec<usize>,
    /// Gear of each body.
    pub of_body: Vec<usize>,
    /// Number of gears; 1 for a model without lines and bodies.
    pub count: usize,
}

impl Gears {
    /// Finds the gears of a spec.
    pub(crate) fn of(spec: &ModelSpec) -> Self {
        let (lines, bodies) = (spec.lines.len(), spec.bodies.len());
        // Each part is connected to itself at first: lines, bodies, joints.
        let mut parent: Vec<usize> = (0..lines + bodies + spec.joints.len()).collect();
        let mut connect = |one: usize, other: usize| {
            let [one, other] = [one, other].map(|part| root(&parent, part));
            parent[one.max(other)] = one.min(other);
        };
        for (index, line) in spec.lines.iter().enumerate() {
            for joint in [line.from, line.to] {
                connect(index, lines + bodies + joint);
            }
        }
        for (index, joint) in spec.joints.iter().enumerate() {
            if let JointKind::Body { body, .. } = joint.kind {
                connect(lines + body, lines + bodies + index);
            }
        }
        let mut roots: Vec<usize> = Vec::new();
        let mut gear_of = |part: usize| {
            let root = root(&parent, part);
            roots.iter().position(|known| *known == root).unwrap_or_else(|| {
                roots.push(root);
                roots.len() - 1
            })
        };
        let of_line = (0..lines).map(&mut gear_of).collect();
        let of_body = (lines..lines + bodies).map(&mut gear_of).collect();
        Self { of_line, of_body, count: roots.len().max(1) }
    }
}

fn root(parent: &[usize], mut part: usize) -> usize {
    while parent[part] != part {
        part = parent[part];
    }
    part
}

/// Some of the gears of a model, as a model of their own.
#[derive(Clone)]
pub(crate) struct Selection {
    /// The gears, in rising order.
    pub gears: Vec<usize>,
    /// The model of them.
    pub model: Model,
    /// Their lines in the whole model.
    pub lines: Vec<usize>,
    /// Their bodies in the whole model.
    pub bodies: Vec<usize>,
    /// Their links in the whole model.
    pub links: Vec<usize>,
    /// Their knots in the whole model.
    pub knots: Vec<usize>,
    /// Parts of their bodies in the whole model, where parts are numbered body after body.
    pub parts: Vec<usize>,
}

impl Selection {
    /// Selects gears of a model without obstacles. The selection has no gear types and no probes: they act on the whole model.
    pub(crate) fn new(whole: &Model, gears: Vec<usize>) -> Self {
        let spec = &whole.spec;
        debug_assert!(spec.obstacles.is_empty(), "solids are the parts of bodies");
        debug_assert!(gears.is_sorted(), "gears in rising order");
        let is_in = |gear: &usize| gears.binary_search(gear).is_ok();
        let chosen = |of: &[usize]| -> Vec<usize> {
            (0..of.len()).filter(|part| is_in(&of[*part])).collect()
        };
        let (lines, bodies) = (chosen(&whole.gears.of_line), chosen(&whole.gears.of_body));
        let has_end = |joint: &usize| {
            lines.iter().any(|line| {
                let Line { from, to, .. } = spec.lines[*line];
                from == *joint || to == *joint
            })
        };
        let joints: Vec<usize> = (0..spec.joints.len()).filter(has_end).collect();
        let links: Vec<usize> =
            (0..spec.links.len()).filter(|link| lines.contains(&spec.links[*link].line)).collect();
        // Every index is in its list: a gear has all joints and bodies of its lines.
        let place = |list: &[usize], index: usize| list.binary_search(&index).unwrap_or_default();
        let line = |index: &usize| {
            let own = &spec.lines[*index];
            Line { from: place(&joints, own.from), to: place(&joints, own.to), ..own.clone() }
        };
        let joint = |index: &usize| {
            let mut own = spec.joints[*index].clone();
            if let JointKind::Body { body, .. } = &mut own.kind {
                *body = place(&bodies, *body);
            }
            own
        };
        let link = |index: &usize| {
            let mut own = spec.links[*index].clone();
            own.line = place(&lines, own.line);
            own
        };
        let model = whole.with_gear(ModelSpec {
            lines: lines.iter().map(line).collect(),
            joints: joints.iter().map(joint).collect(),
            bodies: bodies.iter().map(|body| spec.bodies[*body].clone()).collect(),
            links: links.iter().map(link).collect(),
            gear: Vec::new(),
            probes: Vec::new(),
            ..spec.clone()
        });
        let is_chosen =
            |knot: &usize| lines.contains(&whole.segment_line[whole.knots[*knot].segment]);
        let knots = (0..whole.knots.len()).filter(is_chosen).collect();
        let parts = bodies.iter().flat_map(|body| parts_of(&spec.bodies, *body)).collect();
        Self { gears, model, lines, bodies, links, knots, parts }
    }

    /// Ranges of the nodes of each line: in the selection, and in the whole model.
    pub(crate) fn nodes<'a>(
        &'a self,
        whole: &'a Model,
    ) -> impl Iterator<Item = (Range<usize>, Range<usize>)> + 'a {
        let own = self.model.line_nodes.iter().cloned();
        own.zip(self.lines.iter().map(|line| whole.line_nodes[*line].clone()))
    }

    /// Ranges of the segments of each line: in the selection, and in the whole model.
    pub(crate) fn segments<'a>(
        &'a self,
        whole: &'a Model,
    ) -> impl Iterator<Item = (Range<usize>, Range<usize>)> + 'a {
        let own = self.model.line_segments.iter().cloned();
        own.zip(self.lines.iter().map(|line| whole.line_segments[*line].clone()))
    }

    /// Segment of the whole model that is a segment of the selection.
    pub(crate) fn segment_in(&self, whole: &Model, segment: usize) -> usize {
        let line = self.model.segment_line[segment];
        let from_start = segment - self.model.line_segments[line].start;
        whole.line_segments[self.lines[line]].start + from_start
    }

    /// Segment of the selection that is a segment of the whole model; `None` for one of another gear.
    pub(crate) fn segment_of(&self, whole: &Model, segment: usize) -> Option<usize> {
        let own = whole.segment_line[segment];
        let line = self.line_of(own)?;
        Some(self.model.line_segments[line].start + segment - whole.line_segments[own].start)
    }

    /// Line of the selection that is a line of the whole model.
    pub(crate) fn line_of(&self, line: usize) -> Option<usize> {
        self.lines.binary_search(&line).ok()
    }

    /// Part of a body of the selection that is a part of the whole model.
    pub(crate) fn part_of(&self, part: usize) -> Option<usize> {
        self.parts.binary_search(&part).ok()
    }

    /// Knot of the selection that is a knot of the whole model.
    pub(crate) fn knot_of(&self, knot: usize) -> Option<usize> {
        self.knots.binary_search(&knot).ok()
    }
}

/// Numbers of the parts of a body.
fn parts_of(bodies: &[Body], body: usize) -> Range<usize> {
    let start = bodies[..body].iter().map(|body| body.parts.len()).sum();
    start..start + bodies[body].parts.len()
}
