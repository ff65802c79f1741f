//! The search with a list of neighbours for several steps against a new search in each step, and against all pairs.

use glam::DVec3;

use crate::bits::unit;
use crate::broad_phase::pieces::{Piece, Pieces};
use crate::broad_phase::ropes::{Moves, Reach, Rope};
use crate::contact::Search;
use crate::contact::rope_on_rope::near::*;
use crate::metrics::tests::{model, spec};
use crate::model::Joint;
use crate::whale::Bounds;

/// Number of steps, and their length [s].
const STEPS: u64 = 400;
const DT_S: f64 = 0.01;
/// Segments of each of three lines, not a multiple of those in a piece, and their length [m].
const SEGMENTS: usize = 37;
const LENGTH_M: f64 = 0.1;

/// Three lines with knots at their ends.
fn three_lines() -> Model {
    let mut spec = spec(vec![LENGTH_M; SEGMENTS]);
    spec.settings.rope_on_rope = Some(crate::model::RopeOnRope::default());
    spec.lines[0].knots_m = [0.06, 0.02];
    for id in ["second", "third"] {
        let mut line = spec.lines[0].clone();
        (line.id, line.from, line.to) = (id.into(), spec.joints.len(), spec.joints.len() + 1);
        spec.lines.push(line);
        let ends = spec.joints[..2].to_vec();
        spec.joints.extend(ends.into_iter().map(|end| Joint { id: end.id + id, ..end }));
    }
    model(spec)
}

fn vector(seed: u64, index: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| 2.0 * unit(seed, 3 * index as u64 + axis) - 1.0))
}

/// Lines in waves about each other, some straight; they go about at a speed that is now slow, now fast, and once in a while are elsewhere.
fn go(state: &mut State, step: u64) {
    let (nodes, jumps) = (SEGMENTS + 1, step.is_multiple_of(97));
    let speed_m_s = [0.05, 0.5, 3.0, 60.0][(step / 40 % 4) as usize];
    for node in 0..state.rope.position.len() {
        let (line, along) = (node / nodes, (node % nodes) as f64 * LENGTH_M);
        let bends = if line == 0 { 0.0 } else { 0.3 };
        if jumps {
            let turn = vector(step, 1000 + line);
            let wave = DVec3::Y * (bends * libm::sin(6.0 * along + turn.x));
            state.rope.position[node] =
                (turn + DVec3::X * 0.3).normalize() * (along - 0.2) + wave + 0.1 * turn;
        } else {
            state.rope.position[node] += state.rope.velocity[node] * DT_S;
        }
        let wild = if line == 2 { 0.3 } else { 0.01 };
        state.rope.velocity[node] =
            speed_m_s * (vector(step / 10, 2000 + line) + wild * vector(step, node));
    }
}

fn drift(state: &State, node: usize) -> DVec3 {
    state.rope.position[node] + state.rope.velocity[node] * DT_S
}

/// Segments and knots of a pair, bits of its distance, and whether it may touch.
type FoundPair = ([usize; 2], [Option<usize>; 2], u64, bool);

fn pairs_of(work: &RopeOnRope) -> Vec<FoundPair> {
    let found = |pair: &Pair| (pair.segments, pair.knots, pair.first.to_bits(), pair.may_touch);
    work.pairs.iter().map(found).collect()
}

/// To the bit; the list holds for more than one step if rope is slow.
#[test]
fn a_kept_list_gathers_what_a_new_one_gathers() {
    let model = three_lines();
    let mut state = State::start(&model);
    let (mut kept, mut kept_pieces) = (RopeOnRope::new(&model), Pieces::new(&model));
    let mut counts = [0; 3];
    for step in 0..STEPS {
        go(&mut state, step);
        if step == 250 {
            state.rope.segment_length[5] *= 1.5;
        }
        let (mut new, mut pieces) = (RopeOnRope::new(&model), Pieces::new(&model));
        for (work, pieces) in [(&mut kept, &mut kept_pieces), (&mut new, &mut pieces)] {
            pieces.measure(
                &state.rope.position,
                |node| drift(&state, node),
                &state.rope.segment_length,
            );
            work.gather(&model, &state, pieces, (DT_S, MARGIN_M));
        }
        let pairs = pairs_of(&kept);
        assert_eq!(pairs, pairs_of(&new), "step {step}");
        assert_eq!((kept.touching, kept.count_through()), (new.touching, new.count_through()));
        counts[0] += pairs.len();
        counts[1] += pairs.iter().filter(|pair| pair.1 != [None; 2]).count();
        counts[2] += pairs.iter().filter(|pair| pair.1[1].is_some()).count();
    }
    println!("{counts:?} pairs, with a knot, and of knots; {} lists", kept_pieces.holding);
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    let holding = kept_pieces.holding;
    assert!(holding > 10 && holding < STEPS / 2, "{holding} lists in {STEPS} steps");
}

/// Which piece a segment belongs to, and the box around its way.
fn segments_of<'a>(pieces: &'a Pieces, state: &State) -> Vec<(&'a Piece, Bounds)> {
    let of = |piece: &'a Piece| {
        let nodes = piece.nodes.clone().zip(piece.nodes.clone().skip(1));
        nodes.map(move |(node, next)| {
            let at = [node, next].map(|node| [state.rope.position[node], drift(state, node)]);
            (piece, Bounds::around(at.as_flattened()))
        })
    };
    pieces.pieces.iter().flat_map(of).collect()
}

/// Whether two segments of two pieces, or of one, are left out: of one straight run, or of pieces apart and never to touch.
fn is_left_out([one, other]: [&Piece; 2], may_touch: bool) -> bool {
    if one.segments == other.segments {
        one.is_straight
    } else if one.follows(other) {
        one.runs_on(other)
    } else {
        !may_touch
    }
}

/// With some segments excluded, as those that never touch.
#[test]
fn what_is_found_is_all_that_comes_within_reach() {
    let model = three_lines();
    let knots: Vec<Ball> =
        Ball::all(&model).into_iter().map(|ball| Ball { fraction: 0.4, ..ball }).collect();
    let may_touch = |[one, other]: [usize; 2], _: Option<usize>| (one + other) % 5 != 0;
    let farthest = Reach { ropes_m: 0.06, knots_m: 0.1 };
    let (mut state, mut pieces) = (State::start(&model), Pieces::new(&model));
    let (mut broad, mut found, mut counts) = (Broad::default(), Found::default(), [0; 2]);
    for step in 0..STEPS {
        go(&mut state, step);
        let reach = if step % 3 == 0 { farthest } else { Reach { ropes_m: 0.02, knots_m: 0.03 } };
        let to = |node: usize| drift(&state, node);
        pieces.measure(&state.rope.position, to, &state.rope.segment_length);
        let rope = Rope { pieces: &pieces, knots: &knots, may_touch: &may_touch };
        let moves = Moves { from: &state.rope.position, to };
        broad.collect(rope, &moves, reach, farthest, &mut found);
        let segments = segments_of(&pieces, &state);
        let (mut expected, half_m) = (Found::default(), 0.5 * reach.ropes_m);
        for (one, (piece, bounds)) in segments.iter().enumerate() {
            let later = segments.iter().enumerate().skip(one + 1);
            let near = later.filter(|(index, (other, beside))| {
                bounds.grown(half_m).meets(&beside.grown(half_m))
                    && !is_left_out([piece, other], may_touch([one, *index], None))
            });
            expected.segments.extend(near.map(|(other, _)| [one, other]));
        }
        for (knot, ball) in knots.iter().enumerate() {
            let way = [ball.middle(|node| state.rope.position[node]), ball.middle(to)];
            let around = Bounds::around(&way).grown(reach.knots_m);
            let near = segments.iter().enumerate().filter(|(segment, (piece, bounds))| {
                let pieces = [segments[ball.segment].0, *piece];
                *segment != ball.segment
                    && around.meets(bounds)
                    && !is_left_out(pieces, may_touch([ball.segment, *segment], Some(knot)))
            });
            expected.knots.extend(near.map(|(segment, _)| [knot, segment]));
        }
        assert_eq!(found.segments, expected.segments, "step {step}");
        assert_eq!(found.knots, expected.knots, "step {step}");
        counts[0] += found.segments.len();
        counts[1] += found.knots.len();
    }
    println!("{counts:?} pairs of segments, and of a knot and a segment; {} lists", pieces.holding);
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}

/// Least distance beyond contact of two segments of different lines that were not gathered, when both leave their drift by `away_m`, towards
/// each other and steadily over the step [m].
fn least_room_m(work: &RopeOnRope, state: &State, dt: f64, away_m: f64) -> f64 {
    let gathered: Vec<[usize; 2]> = work.pairs.iter().map(|pair| pair.segments).collect();
    let at = |segment: usize, share: f64| {
        let node = work.homes[segment].node;
        [node, node + 1]
            .map(|node| state.rope.position[node] + state.rope.velocity[node] * (share * dt))
    };
    let mut least = f64::INFINITY;
    for one in 0..work.homes.len() {
        for other in one + 1..work.homes.len() {
            let is_known = gathered.contains(&[one, other]) || work.through.contains(&[one, other]);
            if work.homes[one].line == work.homes[other].line || is_known {
                continue;
            }
            let contact_m = work.contact_distance([one, other], [None; 2]);
            for share in [0.25, 0.5, 0.75, 1.0] {
                let apart_m = nearest(at(one, share), at(other, share)).distance;
                least = least.min(apart_m - 2.0 * share * away_m - contact_m);
            }
        }
    }
    least
}

/// In steps of all lengths, whose margins differ; some of the rope that is not gathered comes within twice the margin.
#[test]
fn rope_near_its_drift_meets_nothing_that_was_not_gathered() {
    let model = three_lines();
    for (dt, expected_mm) in [(5e-4, 6.0), (0.002, 6.0), (0.004, 12.0), (DT_S, 30.0), (0.02, 30.0)]
    {
        let (mut state, mut work) = (State::start(&model), RopeOnRope::new(&model));
        let (mut pieces, mut least_mm) = (Pieces::new(&model), f64::INFINITY);
        for step in 0..STEPS {
            go(&mut state, step);
            if !step.is_multiple_of(8) {
                continue;
            }
            let rope = &state.rope;
            let to = |node: usize| rope.position[node] + rope.velocity[node] * dt;
            pieces.measure(&rope.position, to, &rope.segment_length);
            let search = Search { model: &model, state: &state, pieces: &pieces, dt, goal: 1.0 };
            let margin_m = search.margin_m(MARGIN_M);
            assert!((1e3 * margin_m - expected_mm).abs() < 1e-9, "{margin_m} m in {dt} s");
            work.gather(&model, &state, &pieces, (dt, margin_m));
            let room_m = least_room_m(&work, &state, dt, work.unwatched_m());
            assert!(
                room_m > TOUCH_M - 1e-12,
                "{room_m} m beside each other in step {step}, {dt} s"
            );
            least_mm = least_mm.min(1e3 * least_room_m(&work, &state, dt, 0.0));
        }
        println!("{dt} s: {least_mm} mm beyond contact, margin {expected_mm} mm");
        assert!(least_mm < 2.0 * expected_mm, "{least_mm} mm: all rope nearby was gathered");
    }
}
