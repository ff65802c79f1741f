//! Ropes that touch, in the linear system: lines cut at the touched nodes.
//!
//! A coupling of two ropes acts on the relative move `W δ` of its two points (four nodes) by a block `B`, not symmetric because
//! of friction; it adds `Wᵀ B W` to the matrix. It couples nodes far apart, which the block-tridiagonal systems of the lines cannot hold.
//! Each line is therefore cut at its touched nodes. Every span from one of them to the next is eliminated down to its two ends
//! (`block_tridiagonal.rs`). What is left, touched nodes, free joints and bodies, is one sparse system (`interface.rs`, `sparse.rs`).
//!
//! With rope as lanes, each line is also cut where two pieces meet, and the spans are eliminated by the sweeps (`lanes/kept.rs`).
//!
//! A layout of that system serves all couplings of a solver step: it grows by those that are new. A new step begins with no couplings, so
//! that no bit of a step depends on the steps before.

use std::ops::Range;

use glam::{DMat3, DVec3};

use crate::model::Model;
use crate::system::block_tridiagonal::{BlockTridiagonal, Ends};
use crate::system::interface::{InterfaceSystem, parts};
use crate::system::join;
use crate::system::lanes::Lanes;
use crate::system::sparse::Place;
use crate::trial::plan::{Attachment, Attachments};

/// A coupling as the linear system sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactBlock {
    /// The two segments.
    pub segments: [usize; 2],
    /// First nodes of the two segments.
    pub nodes: [usize; 2],
    /// Fractions along them.
    pub fractions: [f64; 2],
    /// `-d force / d move`, of the first point relative to the second [N/m].
    pub block: DMat3,
}

impl ContactBlock {
    /// Weights of its four nodes.
    pub fn weights(&self) -> [(usize, f64); 4] {
        let ([a, b], [s, t]) = (self.nodes, self.fractions);
        [(a, 1.0 - s), (a + 1, s), (b, t - 1.0), (b + 1, -t)]
    }

    /// `W` of the moves of nodes.
    #[cfg(test)]
    fn relative(&self, at: &[DVec3]) -> DVec3 {
        self.weights().into_iter().map(|(node, weight)| at[node] * weight).sum()
    }
}

/// Where a node is in the system: an end of a line at its attachment, a touched node as a free joint.
type At = (Attachment, DVec3);

/// Part of a line from a touched node, or its end A, to the next, or its end B.
#[derive(Clone, Debug)]
struct Span {
    nodes: Range<usize>,
    segments: Range<usize>,
    ends: [SpanEnd; 2],
    /// Places of its blocks, row after row, if both ends are touched nodes.
    places: Option<[Place; 4]>,
    /// What its elimination left.
    left: Ends,
}

/// The four nodes of a pair.
#[derive(Clone, Copy, Debug)]
struct PairEnds {
    ends: [SpanEnd; 4],
    /// Places of their blocks, row after row, if all are touched nodes.
    places: Option<[Place; 16]>,
}

/// An end of a span.
#[derive(Clone, Copy, Debug)]
enum SpanEnd {
    /// An end of a line, at this joint.
    Joint(usize),
    /// A touched node, as this unknown.
    Touched(usize),
}

impl SpanEnd {
    fn at(self, attachments: &Attachments) -> At {
        match self {
            Self::Joint(joint) => attachments[joint],
            Self::Touched(unknown) => (Attachment::Free(unknown), DVec3::ZERO),
        }
    }
}

/// All couplings of ropes, and the system of what they leave.
#[derive(Clone, Debug, Default)]
pub(crate) struct CoupledRopes {
    pub couplings: Vec<ContactBlock>,
    /// Pairs of first nodes of all couplings of this solver step, in order.
    pairs: Vec<[usize; 2]>,
    /// The pairs of the layout.
    laid_out: Vec<[usize; 2]>,
    /// Its nodes at which lines are cut although no rope touches there, in rising order.
    cuts: Vec<usize>,
    /// Touched nodes and cuts that are no ends of lines, in order; the unknowns after those of the interface.
    touched: Vec<usize>,
    spans: Vec<Span>,
    /// Where the nodes of each pair of the layout are.
    ends: Vec<PairEnds>,
    system: InterfaceSystem,
    /// Scratch: coupled unknowns.
    unknowns: Vec<(usize, usize)>,
}

impl CoupledRopes {
    /// Begins a solver step.
    pub fn begin(&mut self) {
        self.couplings.clear();
        self.pairs.clear();
    }

    /// Discards the layout, as that of the interface has changed.
    pub fn discard_layout(&mut self) {
        self.laid_out.clear();
    }

    /// Solves the assembled system of lines, interface and couplings; the moves are in `rope.step` and `interface.step`. If only some
    /// nodes have `changed` since the last solution, spans without them keep their elimination.
    pub fn solve(
        &mut self,
        model: &Model,
        rope: &mut BlockTridiagonal,
        interface: &mut InterfaceSystem,
        attachments: &Attachments,
        mut changed: Option<&[bool]>,
    ) {
        if self.prepare(model, interface, attachments, std::iter::empty()) {
            changed = None;
        }
        for Span { nodes, segments, ends, left, .. } in &mut self.spans {
            if changed.is_none_or(|changed| changed[nodes.clone()].contains(&true)) {
                let (a, _) = ends[0].at(attachments);
                let owns_a = matches!(ends[0], SpanEnd::Joint(_));
                *left = rope.eliminate(nodes, segments, a != Attachment::Fixed, owns_a);
            }
        }
        self.solve_spans(interface, attachments);
        for Span { nodes, segments, ends, .. } in &self.spans {
            let [step_a, step_b] = self.steps_of(*ends, attachments);
            let (a, _) = ends[0].at(attachments);
            rope.substitute(nodes, segments, a != Attachment::Fixed, step_a, step_b);
        }
    }

    /// Solves the assembled system of lanes that are reduced to the ends of spans, interface and couplings; the moves are in `lanes` and
    /// `interface.step`.
    pub fn solve_lanes(
        &mut self,
        lanes: &mut Lanes,
        interface: &mut InterfaceSystem,
        attachments: &Attachments,
    ) {
        for span in &mut self.spans {
            span.left = lanes.span_ends(span.segments.end - 1);
        }
        self.solve_spans(interface, attachments);
        for Span { segments, ends, .. } in &self.spans {
            lanes.move_span(segments, self.steps_of(*ends, attachments));
        }
    }

    /// Lays out the system for the pairs of this step and further cuts of the lines, in rising order, unless it has that layout; returns
    /// whether it was laid out.
    pub fn prepare(
        &mut self,
        model: &Model,
        interface: &InterfaceSystem,
        attachments: &Attachments,
        cuts: impl Iterator<Item = usize> + Clone,
    ) -> bool {
        self.add_new_pairs();
        let is_laid_out = self.pairs == self.laid_out && self.cuts.iter().copied().eq(cuts.clone());
        if !is_laid_out {
            self.cuts.clear();
            self.cuts.extend(cuts);
            self.lay_out(model, interface, attachments);
        }
        !is_laid_out
    }

    /// Nodes at which lines are cut, in rising order.
    pub fn touched(&self) -> &[usize] {
        &self.touched
    }

    /// Moves of the ends of a span.
    fn steps_of(&self, ends: [SpanEnd; 2], attachments: &Attachments) -> [DVec3; 2] {
        ends.map(|end| end.at(attachments)).map(|(at, arm)| self.system.step_of(at, arm))
    }

    /// Solves the system of spans that are eliminated, interface and couplings.
    fn solve_spans(&mut self, interface: &mut InterfaceSystem, attachments: &Attachments) {
        let Self { system, spans, .. } = self;
        system.clear();
        system.add_all(interface);
        for Span { ends, places, left, .. } in spans {
            match (*places, *ends) {
                (Some(places), [SpanEnd::Touched(a), SpanEnd::Touched(b)]) => {
                    let blocks = [left.aa, left.ab, left.ba, left.bb];
                    places.into_iter().zip(blocks).for_each(|(place, block)| {
                        system.add_at(place, block);
                    });
                    system.force[a] += left.force_a;
                    system.force[b] += left.force_b;
                }
                _ => join(system, ends.map(|end| end.at(attachments)), left),
            }
        }
        self.add_couplings(attachments);
        self.system.solve();
        let blocks = interface.blocks();
        interface.step.copy_from_slice(&self.system.step[..blocks]);
    }

    /// Adds the pairs of nodes that no coupling of this step had before.
    fn add_new_pairs(&mut self) {
        for coupling in &self.couplings {
            if let Err(at) = self.pairs.binary_search(&coupling.nodes) {
                self.pairs.insert(at, coupling.nodes);
            }
        }
    }

    /// Cuts the lines at the touched nodes, and lays out the system.
    fn lay_out(&mut self, model: &Model, interface: &InterfaceSystem, attachments: &Attachments) {
        self.laid_out.clone_from(&self.pairs);
        self.cut_lines(model, interface.blocks());
        self.find_ends(model, interface.blocks());
        self.unknowns.clear();
        self.unknowns.extend(interface.pairs());
        let mut couple = |one: SpanEnd, other: SpanEnd| {
            let [one, other] = [one, other].map(|end| end.at(attachments));
            for (row, _) in parts(one.0, one.1) {
                self.unknowns.extend(parts(other.0, other.1).map(|(column, _)| (row, column)));
            }
        };
        for span in &self.spans {
            couple(span.ends[0], span.ends[1]);
        }
        for PairEnds { ends, .. } in &self.ends {
            for (place, one) in ends.iter().enumerate() {
                ends[place + 1..].iter().for_each(|other| couple(*one, *other));
            }
        }
        let unknowns = interface.blocks() + self.touched.len();
        self.system.lay_out(unknowns, self.unknowns.iter().copied());
        let Self { system, spans, ends, .. } = self;
        spans.iter_mut().for_each(|span| span.places = places(system, span.ends));
        ends.iter_mut().for_each(|pair| pair.places = places(system, pair.ends));
    }

    /// Lists touched nodes and spans.
    fn cut_lines(&mut self, model: &Model, first_unknown: usize) {
        self.touched.clear();
        let nodes = self.pairs.iter().flat_map(|[a, b]| [*a, a + 1, *b, b + 1]);
        self.touched.extend(nodes);
        self.touched.extend_from_slice(&self.cuts);
        self.touched.sort_unstable();
        self.touched.dedup();
        self.touched.retain(|node| {
            let within = |line: &Range<usize>| line.start < *node && *node + 1 < line.end;
            model.line_nodes.iter().any(within)
        });
        self.spans.clear();
        let lines = model.spec.lines.iter().zip(&model.line_nodes).zip(&model.line_segments);
        for ((line, nodes), segments) in lines {
            let first = self.touched.partition_point(|node| *node < nodes.start);
            let (mut from, mut end) = (nodes.start, SpanEnd::Joint(line.from));
            let inside = self.touched.iter().enumerate().skip(first);
            let inside = inside.take_while(|(_, node)| **node < nodes.end);
            let inside = inside.map(|(at, node)| (*node, SpanEnd::Touched(first_unknown + at)));
            for (to, next) in inside.chain([(nodes.end - 1, SpanEnd::Joint(line.to))]) {
                let segment = |node: usize| segments.start + (node - nodes.start);
                self.spans.push(Span {
                    nodes: from..to + 1,
                    segments: segment(from)..segment(to),
                    ends: [end, next],
                    places: None,
                    left: Ends::default(),
                });
                (from, end) = (to, next);
            }
        }
    }

    /// Finds where the four nodes of each pair are in the system.
    fn find_ends(&mut self, model: &Model, first_unknown: usize) {
        let end = |node: usize| {
            if let Ok(at) = self.touched.binary_search(&node) {
                return SpanEnd::Touched(first_unknown + at);
            }
            let line = model.line_nodes.partition_point(|nodes| nodes.end <= node);
            let (line, nodes) = (&model.spec.lines[line], &model.line_nodes[line]);
            debug_assert!(
                node == nodes.start || node + 1 == nodes.end,
                "{node} is an end of a line"
            );
            SpanEnd::Joint(if node == nodes.start { line.from } else { line.to })
        };
        self.ends.clear();
        self.ends.extend(
            self.pairs
                .iter()
                .map(|[a, b]| PairEnds { ends: [*a, a + 1, *b, b + 1].map(end), places: None }),
        );
    }

    /// Adds `Wᵀ B W` of all couplings.
    fn add_couplings(&mut self, attachments: &Attachments) {
        for coupling in &self.couplings {
            let Ok(pair) = self.laid_out.binary_search(&coupling.nodes) else {
                debug_assert!(false, "the layout has no pair {:?}", coupling.nodes);
                continue;
            };
            let PairEnds { ends, places } = self.ends[pair];
            let weights = coupling.weights();
            if let Some(places) = places {
                for (row, (_, row_weight)) in weights.into_iter().enumerate() {
                    for (place, (_, weight)) in places[4 * row..].iter().zip(weights) {
                        self.system.add_at(*place, coupling.block * (row_weight * weight));
                    }
                }
                continue;
            }
            let at = ends.map(|end| end.at(attachments));
            for ((row, row_arm), (_, row_weight)) in at.into_iter().zip(weights) {
                for ((column, arm), (_, weight)) in at.into_iter().zip(weights) {
                    let block = coupling.block * (row_weight * weight);
                    self.system.add(row, row_arm, column, arm, block);
                }
            }
        }
    }
}

/// Places of the blocks of touched nodes with each other, row after row; `None` if one of them is at a joint.
fn places<const N: usize, const M: usize>(
    system: &InterfaceSystem,
    ends: [SpanEnd; N],
) -> Option<[Place; M]> {
    debug_assert!(M == N * N, "a place for each pair of {N} nodes");
    let mut unknowns = [0; N];
    for (unknown, end) in unknowns.iter_mut().zip(ends) {
        let SpanEnd::Touched(touched) = end else { return None };
        *unknown = touched;
    }
    Some(core::array::from_fn(|at| system.place_of(unknowns[at / N], unknowns[at % N])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::Solver;
    use crate::solver::tests::{model, moving};
    use crate::state::State;
    use crate::trial::StepContext;
    use crate::trial::scheme::Scheme;

    /// Touches within a line and between lines, at ends and inside, with blocks that are not symmetric.
    fn touches(model: &Model) -> Vec<ContactBlock> {
        let [low, high, tail] = [0, 1, 2].map(|line| model.line_nodes[line].start);
        [
            [low, high + 20],
            [low + 12, low + 40],
            [low + 13, high],
            [high + 35, tail],
            [low + 58, tail + 7],
        ]
        .into_iter()
        .zip([1e3, 1e4, 1e5, 1e6, 1e7])
        .map(|(nodes, size)| {
            let line = |node| model.line_nodes.partition_point(|nodes| nodes.end <= node);
            let segments = nodes.map(|node| node - line(node));
            let block = DMat3::from_cols_array(&[3.0, 0.2, -0.4, 0.9, 2.0, 0.1, -0.3, 0.5, 1.0]);
            ContactBlock { segments, nodes, fractions: [0.3, 0.8], block: block * size }
        })
        .collect()
    }

    /// The step of one assembled pass: its moves of nodes.
    fn solved(model: &Model, state: &State, prepare: impl FnOnce(&mut Solver)) -> Vec<DVec3> {
        let (mut solver, scheme) = (Solver::new(model), Scheme::bdf2(0.01, 0.01));
        solver.begin(model, state, &scheme);
        solver.assemble(&StepContext { model, state, scheme: &scheme });
        prepare(&mut solver);
        solver.solve(model);
        solver.system.rope.step
    }

    /// The forces of the couplings in the solution are applied as external forces; without couplings these give the same solution.
    #[test]
    fn touches_as_forces_give_the_same_moves() {
        let model = model(60.0, 0.7);
        let (state, touches) = (moving(&model), touches(&model));
        let free = solved(&model, &state, |_| ());
        let touched =
            solved(&model, &state, |solver| solver.system.ropes.couplings.clone_from(&touches));
        let forced = solved(&model, &state, |solver| {
            for touch in &touches {
                let force = touch.block * touch.relative(&touched);
                for (node, weight) in touch.weights() {
                    solver.system.rope.force[node] -= force * weight;
                }
            }
        });
        let apart = |one: &[DVec3], other: &[DVec3]| {
            one.iter().zip(other).map(|(one, other)| one.distance(*other)).fold(0.0, f64::max)
        };
        assert!(apart(&free, &touched) > 1e-4, "{}", apart(&free, &touched));
        let share = apart(&touched, &forced) / apart(&free, &touched);
        assert!(share < 1e-6, "{share}");
    }
}
