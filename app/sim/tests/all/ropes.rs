//! Rope against rope: what crossed ropes press, that they never pass each other, that twists stay.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::f64::consts::TAU;

use endline_fixtures::gear::{fixed, line, model, water};
use endline_sim::geometry::crossing::first_crossing;
use endline_sim::geometry::sweep::SweptSegment;
use endline_sim::model::{Joint, JointKind, Line, RopeOnRope, Settings};
use endline_sim::water::Water;
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Sum of the radii of the common rope [m].
const REACH: f64 = 0.010;
/// Length of the ropes that are drawn taut, as a share of the way between their ends.
const SLACK: f64 = 0.998;
/// Axial stiffness of the common rope [N].
const EA: f64 = 1e5;

fn vacuum() -> Water {
    Water { gravity_m_s2: 0.0, ..water(0.0, 0.0) }
}

fn settings(friction: f64, step_s: f64) -> Settings {
    let law = RopeOnRope { friction, ..RopeOnRope::default() };
    Settings { step_s, rope_on_rope: Some(law), as_placed: true, ..Settings::default() }
}

fn driven(id: &str, position_m: DVec3, velocity_m_s: DVec3, until_s: f64) -> Joint {
    Joint {
        id: id.into(),
        kind: JointKind::Driven { velocity_m_s, from_s: 0.0, until_s },
        position_m,
    }
}

/// A straight line between two joints, `slack` times as long as they are apart.
fn straight(
    id: &str,
    joints: &[Joint],
    [from, to]: [usize; 2],
    segments: usize,
    slack: f64,
) -> Line {
    let whole = (joints[to].position_m - joints[from].position_m).length() * slack;
    Line { from, to, ..line(id, whole, segments) }
}

/// Runs a model; `each` sees every state with the one before.
fn walk(
    model: &Model,
    state: &mut State,
    until_s: f64,
    mut each: impl FnMut(&State, &State),
) -> Workspace {
    let mut workspace = Workspace::new(model);
    while state.time_s < until_s - 1e-9 {
        let before = state.clone();
        step(model, &Input::default(), state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        each(&before, state);
    }
    workspace
}

/// Two strings at right angles, their ends drawn past each other by `past` and held: by symmetry each dips by
/// `d = (past + gap)/2` in its middle, `gap` the distance at which the law of contact gives the force of a string so dipped,
/// `N = 2 T d/s`, `T = EA (s/l - 1)`, `s² = l² + d²` with `l` half of its length.
///
/// Where a segment is touched in its middle it stays level, and the sides are shorter by half of it: `flat` is its length.
fn force_by_hand(past: f64, half: f64, flat: f64, stiffness: f64) -> (f64, f64) {
    let force_of_string = |dip: f64| {
        let run = half - 0.5 * flat;
        let side = (run * run + dip * dip).sqrt();
        2.0 * EA * ((side + 0.5 * flat) / (SLACK * half) - 1.0) * dip / side
    };
    let room = 0.75 * REACH;
    let force_of_law = |gap: f64| stiffness * (REACH - gap) / (1.0 - (REACH - gap) / room);
    let (mut low, mut high) = (0.2501 * REACH, REACH);
    for _ in 0..200 {
        let gap = 0.5 * (low + high);
        if force_of_law(gap) > force_of_string(0.5 * (past + gap)) { low = gap } else { high = gap }
    }
    (force_of_law(high), high)
}

#[test]
fn crossed_ropes_press_as_the_strings_that_they_are() {
    let (half, past) = (1.0, 0.1);
    for segments in [20_u32, 21, 40] {
        let flat = if segments % 2 == 1 { 2.0 * half / f64::from(segments) } else { 0.0 };
        let start = REACH + 0.002;
        let joints = vec![
            fixed("a", DVec3::new(-half, 0.0, 0.0)),
            fixed("b", DVec3::new(half, 0.0, 0.0)),
            driven("c", DVec3::new(0.0, -half, start), -DVec3::Z, start + past),
            driven("d", DVec3::new(0.0, half, start), -DVec3::Z, start + past),
        ];
        let lines = vec![
            straight("low", &joints, [0, 1], segments as usize, SLACK),
            straight("high", &joints, [2, 3], segments as usize, SLACK),
        ];
        let model = model(vacuum(), joints, lines, Vec::new(), settings(0.0, 0.01));
        let mut state = State::start(&model);
        let workspace = walk(&model, &mut state, 3.0, |_, _| {});
        let law = RopeOnRope::default();
        let (expected, gap) = force_by_hand(past, half, flat, law.stiffness_n_m2 * REACH);
        let got: f64 = workspace.rope_touches.iter().map(|touch| touch.normal_force_n).sum();
        println!(
            "{segments} segments: {got:.3} N for {expected:.3} N, gap {:.3} mm, {:?}",
            1e3 * gap,
            workspace.rope_touches
        );
        println!("{:?}", workspace.audit);
        assert!((got / expected - 1.0).abs() < 0.01, "{got} N for {expected} N");
    }
}

/// Random numbers from 0 to 1: Knuth's multiplicative congruences, upper bits.
fn draw(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Crossings of the two lines seen from above, each by how they turn and which is over: it changes only where they pass
/// through each other, as long as their ends stay clear.
fn overs(model: &Model, nodes: &[DVec3]) -> i32 {
    let flat = |at: DVec3| DVec3::new(at.x, at.y, 0.0);
    let mut sum = 0;
    let pairs =
        |line: usize| model.line_nodes[line].clone().zip(model.line_nodes[line].clone().skip(1));
    for (a, b) in pairs(0) {
        for (c, d) in pairs(1) {
            let (u, v, w) = (nodes[b] - nodes[a], nodes[d] - nodes[c], nodes[c] - nodes[a]);
            let turn = flat(u).cross(flat(v)).z;
            let (s, t) = (flat(w).cross(flat(v)).z / turn, flat(w).cross(flat(u)).z / turn);
            if (0.0..1.0).contains(&s) && (0.0..1.0).contains(&t) {
                let over = (nodes[a] + u * s).z > (nodes[c] + v * t).z;
                sum += if (turn > 0.0) == over { 1 } else { -1 };
            }
        }
    }
    sum
}

/// Pairs of segments of the two lines that cross on the straight way from one state to the next, by the exact test.
fn crossed(model: &Model, before: &State, after: &State) -> usize {
    let swept = |node: usize| SweptSegment {
        a0: before.rope.position[node],
        b0: before.rope.position[node + 1],
        a1: after.rope.position[node],
        b1: after.rope.position[node + 1],
    };
    let segments = |line: usize| model.line_nodes[line].start..model.line_nodes[line].end - 1;
    segments(0)
        .map(|one| {
            segments(1)
                .filter(|other| first_crossing(&swept(one), &swept(*other)).is_some())
                .count()
        })
        .sum()
}

#[test]
fn ropes_thrown_at_each_other_never_pass() {
    let mut seed = 11;
    let (mut crossings, mut changed, mut counted, mut unconverged, mut steps, mut greatest) =
        (0, 0, 0, 0, 0, 0.0_f64);
    let runs = 300;
    for run in 0..runs {
        let speed = 2.0 + 18.0 * draw(&mut seed);
        let (turn, height) = (TAU * (0.1 + 0.15 * draw(&mut seed)), 0.05 + 0.2 * draw(&mut seed));
        let (across, slide) =
            (DVec3::new(libm::cos(turn), libm::sin(turn), 0.0), 0.3 * (draw(&mut seed) - 0.5));
        let velocity =
            DVec3::new(draw(&mut seed) - 0.5, draw(&mut seed) - 0.5, -1.0).normalize() * speed;
        let until = height / speed + 0.25 / speed;
        let aside = DVec3::X * slide;
        let joints = vec![
            fixed("a", -DVec3::X),
            fixed("b", DVec3::X),
            driven("c", aside - across + DVec3::Z * height, velocity, until),
            driven("d", aside + across + DVec3::Z * height, velocity, until),
        ];
        let count = |seed: &mut u64| 10 + (30.0 * draw(seed)) as usize;
        let lines = vec![
            straight("low", &joints, [0, 1], count(&mut seed), 0.99 + 0.06 * draw(&mut seed)),
            straight("high", &joints, [2, 3], count(&mut seed), 0.99 + 0.06 * draw(&mut seed)),
        ];
        let model =
            model(vacuum(), joints, lines, Vec::new(), settings(0.3 * draw(&mut seed), 0.01));
        let mut state = State::start(&model);
        for velocity_of in model.line_nodes[1].clone() {
            state.rope.velocity[velocity_of] = velocity;
        }
        let began = overs(&model, &state.rope.position);
        let mut here = 0;
        let workspace = walk(&model, &mut state, until + 0.05, |before, after| {
            here += crossed(&model, before, after)
        });
        crossings += here;
        let ended = overs(&model, &state.rope.position);
        if ended != began {
            println!("run {run}: {speed:.1} m/s: {began} became {ended}, {:?}", workspace.audit);
        }
        changed += usize::from(ended != began);
        counted += workspace.audit.ropes_crossed;
        unconverged += workspace.audit.unconverged;
        steps += workspace.audit.rope_steps;
        greatest = greatest.max(
            workspace.rope_touches.iter().map(|touch| touch.normal_force_n).fold(0.0, f64::max),
        );
    }
    println!(
        "{runs} runs, {steps} steps on rope, {unconverged} unconverged, {greatest:.0} N at most: {crossings} crossings by chords, {counted} by moves, {changed} changed"
    );
    assert_eq!((crossings, counted, changed), (0, 0, 0));
    assert!(steps > 20 * runs);
}

/// Two ropes side by side along x, turned `turns` times about each other in the middle, their ends drawn apart along x and
/// shaken across it.
fn twisted(turns: f64, seed: &mut u64) -> Model {
    let (half, segments) = (0.5, 80);
    let wide = |x: f64| 0.501 * REACH + 0.02 * ((x.abs() - 0.3) / 0.2).clamp(0.0, 1.0);
    let angle = |x: f64| TAU * turns * ((x + 0.3) / 0.6).clamp(0.0, 1.0);
    let at = |x: f64, side: f64| {
        DVec3::new(x, side * wide(x) * libm::cos(angle(x)), side * wide(x) * libm::sin(angle(x)))
    };
    let (mut joints, mut lines) = (Vec::new(), Vec::new());
    for (index, side) in [1.0, -1.0].into_iter().enumerate() {
        let nodes: Vec<DVec3> = (0..=segments)
            .map(|k| at(half * (2.0 * k as f64 / segments as f64 - 1.0), side))
            .collect();
        let shake = DVec3::new(0.0, draw(seed) - 0.5, draw(seed) - 0.5) * 0.6;
        joints.push(driven("left", nodes[0], shake - DVec3::X * 0.05, 0.3));
        joints.push(driven("right", nodes[segments], shake + DVec3::X * 0.05, 0.3));
        let mut rope = line("rope", 1.0, segments);
        (rope.from, rope.to) = (2 * index, 2 * index + 1);
        rope.segments_m = nodes.windows(2).map(|pair| 1.01 * pair[0].distance(pair[1])).collect();
        rope.start_m = nodes;
        lines.push(rope);
    }
    model(
        Water { gravity_m_s2: 0.0, ..water(1025.0, 0.0) },
        joints,
        lines,
        Vec::new(),
        settings(0.15, 0.002),
    )
}

#[test]
fn a_twist_stays_twisted() {
    let mut seed = 5;
    for turns in [1, 3] {
        let model = twisted(f64::from(turns), &mut seed);
        let mut state = State::start(&model);
        let began = overs(&model, &state.rope.position);
        let mut here = 0;
        let workspace =
            walk(&model, &mut state, 0.3, |before, after| here += crossed(&model, before, after));
        let tension = state.rope.tension.iter().copied().fold(0.0, f64::max);
        println!(
            "{turns} turns: {began}, {tension:.0} N, {} touches, {:?}",
            workspace.rope_touches.len(),
            workspace.audit
        );
        assert_eq!(began.abs(), 2 * turns, "two crossings a turn");
        assert_eq!(
            (overs(&model, &state.rope.position), here, workspace.audit.ropes_crossed),
            (began, 0, 0)
        );
        assert!(tension > 100.0 && workspace.rope_touches.len() > 3);
    }
}

/// Scratch thrown away in the middle changes no bit, and the same run again is the same run.
#[test]
fn rope_on_rope_repeats_to_the_bit_whatever_the_scratch() {
    let model = twisted(2.0, &mut 9);
    let run = |thrown_away: bool| {
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        for k in 0..60 {
            if thrown_away && k % 7 == 3 {
                workspace = Workspace::new(&model);
            }
            step(&model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{stop:?}"));
        }
        assert!(!state.rope.rope_grips.is_empty());
        state
    };
    assert!(run(false) == run(true));
}

/// Ropes that lie in each other when the run begins stay as they are, and those whose centre lines cross are reported. Once they have
/// been drawn apart, they touch as any others do.
#[test]
fn ropes_that_lie_in_each_other_at_the_start_stay_until_they_are_drawn_apart() {
    for (apart, through) in [(0.0, 1), (0.3 * REACH, 0)] {
        let model = crossing(apart);
        let mut state = State::start(&model);
        let mut fastest = 0.0_f64;
        let audit = walk(&model, &mut state, 3.0, |_, state| {
            let speeds = state.rope.velocity.iter().map(|velocity| velocity.length());
            fastest = speeds.fold(fastest, f64::max);
        })
        .audit;
        assert_eq!((audit.ropes_through, audit.ropes_crossed), (through, 0));
        assert!(fastest < 1e-3, "{apart}: {fastest} m/s");
        assert!((gap(&state) - apart).abs() < 0.05 * REACH, "{apart}: {}", gap(&state));
    }

    let model = crossing(0.3 * REACH);
    let mut state = State::start(&model);
    for up in [1.0, -1.0] {
        for node in 23..43 {
            state.rope.velocity[node] = DVec3::Z * (0.3 * up);
        }
        walk(&model, &mut state, 2.0, |_, _| {});
        let crushed = 0.9 * REACH;
        assert!(gap(&state) > crushed, "{up}: {} m, thrown at each other at 0.3 m/s", gap(&state));
    }
}

/// Two slack ropes across each other, their centre lines this far apart [m].
fn crossing(apart: f64) -> Model {
    let (x, y) = (DVec3::X, DVec3::Y);
    let lift = DVec3::Z * apart;
    let joints = vec![fixed("a", -x), fixed("b", x), fixed("c", lift - y), fixed("d", lift + y)];
    let lines = vec![
        straight("low", &joints, [0, 1], 21, 1.02),
        straight("high", &joints, [2, 3], 21, 1.02),
    ];
    let water = Water { gravity_m_s2: 0.0, ..water(1025.0, 0.0) };
    model(water, joints, lines, Vec::new(), settings(0.0, 0.01))
}

/// How far the second of them lies above the first in the middle [m].
fn gap(state: &State) -> f64 {
    let at = &state.rope.position;
    0.5 * (at[32] + at[33] - at[10] - at[11]).z
}
