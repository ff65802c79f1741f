//! Backward sweep: moves of the nodes from those of the ends, and the tension they predict.

use pulp::{Simd, WithSimd};

use crate::simd::real::{Lane, Real};
use crate::simd::rows::{Part, Row3};
use crate::simd::space::Vec3;
use crate::system::lanes::kept::{KeptRow, KeptRows};
use crate::system::lanes::rows::{MoveRows, NodeRow, SegmentRow, Solved};
use crate::system::lanes::sweep::GroupRows;

/// Backward sweep from the moves of the ends A and B.
pub(crate) struct Backward<'a> {
    pub group: GroupRows<'a>,
    pub kept: KeptRows<'a>,
    /// Moves of the ends A and B.
    pub ends: &'a [Row3; 2],
    /// Share of the solved step that is made.
    pub share: f64,
    pub moves: &'a mut MoveRows,
}

impl WithSimd for Backward<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for part in 0..Part::<S>::COUNT {
            let part = Part { simd, part };
            let share = Lane::new(simd, self.share);
            let Self { group, kept, ends, moves, .. } = &mut self;
            if group.anchored && kept.is_empty() {
                backward::<S, false>(part, (group, kept), ends, share, moves);
            } else {
                backward::<S, true>(part, (group, kept), ends, share, moves);
            }
        }
    }
}

/// Maxima over the nodes.
#[derive(Clone, Copy)]
struct Moved<R> {
    longest: R,
    gap: R,
    turned: R,
    flipped: R,
    greatest: R,
    finite: R,
}

#[inline(always)]
fn backward<S: Simd, const FILL: bool>(
    part: Part<S>,
    (group, kept): (&mut GroupRows<'_>, &mut KeptRows<'_>),
    ends: &[Row3; 2],
    share: Lane<S>,
    moves: &mut MoveRows,
) {
    let zero = Lane::new(part.simd, 0.0);
    let (mut step_a, step_b) = (part.get3(&ends[0]), part.get3(&ends[1]));
    let mut moved = Moved {
        longest: zero,
        gap: zero,
        turned: zero,
        flipped: zero,
        greatest: zero,
        finite: zero,
    };
    let mut next = step_b;
    let count = group.segments.len();
    for k in (group.shortest..count).rev() {
        let live = part.get(&group.live[k - group.shortest]);
        let step =
            Vec3::choose(live, inner_step::<S, FILL>(part, &group.solved[k], step_a, next), next);
        let (step, begin) = kept_step(part, kept.get(k), step, step_a);
        step_a = begin;
        // A lane whose piece ends before: its last node is moved by its end's own row.
        move_node(part, &mut group.nodes[k + 2], next.scale(share));
        moved = predict(
            part,
            &group.solved[k],
            &mut group.segments[k],
            [step, next, next.scale(share).sub(step.scale(share))],
            moved,
        );
        next = step;
    }
    for k in (1..group.shortest).rev() {
        let step = inner_step::<S, FILL>(part, &group.solved[k], step_a, next);
        let (step, begin) = kept_step(part, kept.get(k), step, step_a);
        step_a = begin;
        move_node(part, &mut group.nodes[k + 2], next.scale(share));
        moved = predict(
            part,
            &group.solved[k],
            &mut group.segments[k],
            [step, next, next.scale(share).sub(step.scale(share))],
            moved,
        );
        next = step;
    }
    move_node(part, &mut group.nodes[2], next.scale(share));
    move_node(part, &mut group.nodes[1], step_a.scale(share));
    moved = predict(
        part,
        &group.solved[0],
        &mut group.segments[0],
        [step_a, next, next.scale(share).sub(step_a.scale(share))],
        moved,
    );
    part.put(&mut moves.longest, moved.longest);
    part.put(&mut moves.gap, moved.gap);
    part.put(&mut moves.turned, moved.turned);
    part.put(&mut moves.flipped, moved.flipped);
    part.put(&mut moves.greatest, moved.greatest);
    part.put(&mut moves.finite, moved.finite);
}

#[inline(always)]
fn inner_step<S: Simd, const FILL: bool>(
    part: Part<S>,
    solved: &Solved,
    step_a: Vec3<Lane<S>>,
    next: Vec3<Lane<S>>,
) -> Vec3<Lane<S>> {
    let (g, x) = (part.get3(&solved.g), part.get9(&solved.x));
    let own = if FILL {
        let w = part.get9(&solved.w);
        g.less(w.x, step_a.x).less(w.y, step_a.y).less(w.z, step_a.z)
    } else {
        g
    };
    own.plus(x.x, next.x).plus(x.y, next.y).plus(x.z, next.z)
}

/// Move of a node, given in lanes in which it is kept, and that of the first node of its span, from there on of the span before.
#[inline(always)]
fn kept_step<S: Simd>(
    part: Part<S>,
    kept: Option<&mut KeptRow>,
    step: Vec3<Lane<S>>,
    step_a: Vec3<Lane<S>>,
) -> (Vec3<Lane<S>>, Vec3<Lane<S>>) {
    let Some(kept) = kept else { return (step, step_a) };
    let mask = part.get(&kept.mask);
    (
        Vec3::choose(mask, part.get3(&kept.step), step),
        Vec3::choose(mask, part.get3(&kept.before), step_a),
    )
}

#[inline(always)]
fn move_node<S: Simd>(part: Part<S>, row: &mut NodeRow, step: Vec3<Lane<S>>) {
    let place = part.get3(&row.place).add(step);
    part.put3(&mut row.place, place);
}

/// Tension of a segment by the linear solution, and how far that is from the tension at its place.
#[inline(always)]
fn predict<S: Simd>(
    part: Part<S>,
    solved: &Solved,
    row: &mut SegmentRow,
    [step, next, apart]: [Vec3<Lane<S>>; 3],
    moved: Moved<Lane<S>>,
) -> Moved<Lane<S>> {
    let zero = Lane::new(part.simd, 0.0);
    let stretch = part.get3(&solved.direction).dot(apart);
    let stiffness = part.get(&solved.stiffness);
    let change = stiffness * stretch;
    let tension = part.get(&solved.tension) + change;
    let across = (apart.dot(apart) - stretch * stretch).max(zero);
    let inverse_chord = part.get(&solved.inverse_chord);
    let missed = stiffness * inverse_chord * across * zero.splat(0.5);
    // The linear solution lets the pull turn without its change, and its change without the turn.
    let turn = across.sqrt() * inverse_chord;
    let turned = (change.abs() + tension.max(zero) * turn) * turn;
    // A segment that was assumed taut and is slack in the solution, or the reverse, has its whole tension as error.
    let was_taut = part.get(&row.tension);
    let flipped = was_taut.positive((-tension).max(zero), tension.max(zero));
    part.put(&mut row.tension, tension);
    Moved {
        longest: moved.longest.max(step.dot(step)).max(next.dot(next)),
        gap: moved.gap.max(missed),
        turned: moved.turned.max(turned),
        flipped: moved.flipped.max(flipped),
        greatest: moved.greatest.max(tension),
        finite: moved.finite + (tension + step.x + step.y + step.z) * zero,
    }
}
