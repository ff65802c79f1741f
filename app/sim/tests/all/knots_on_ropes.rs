//! A knot drawn through other rope: it holds up to the force that spreads the ropes it lies between, and passes above; the bare rope
//! runs freely.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{fixed, line, model, water};
use endline_sim::metrics::{EventKind, Metrics};
use endline_sim::model::{Joint, JointKind, Line, RopeOnRope, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Radius of the common rope [m].
const ROPE_M: f64 = 0.005;
/// Half the length of the ropes across, and their tension [m], [N].
const HALF_M: f64 = 0.25;
const ACROSS_N: f64 = 500.0;
/// Pull on the rope behind the knot [N].
const BACK_N: f64 = 5.0;
/// Where the knot has passed [m].
const PAST_M: f64 = 0.06;
/// Speed of the hand [m/s].
const SPEED: f64 = 0.1;

fn pulled(id: String, place: DVec3, force_n: DVec3) -> Joint {
    Joint { id, kind: JointKind::Pulled { force_n, from_s: -1.0 }, position_m: place }
}

/// Adds a rope along z at a place of the plane z = 0, fast below and drawn up with `ACROSS_N`, which does not hold it aside.
fn across(joints: &mut Vec<Joint>, lines: &mut Vec<Line>, place: DVec3) {
    let (first, name) = (joints.len(), format!("across {}", lines.len()));
    joints.push(fixed(&format!("below {name}"), place - DVec3::Z * HALF_M));
    joints.push(pulled(format!("above {name}"), place + DVec3::Z * HALF_M, DVec3::Z * ACROSS_N));
    let mut rope = line(&name, 2.0 * HALF_M, 20);
    (rope.from, rope.to) = (first, first + 1);
    lines.push(rope);
}

/// Rope along x with a knot of this radius at a place, drawn on against `BACK_N` past ropes across at these places.
fn drawn(knot_m: f64, from_m: f64, hand: JointKind, friction: f64, places: &[DVec3]) -> Model {
    let at = |x: f64| DVec3::X * x;
    let mut joints = vec![
        pulled("back".into(), at(from_m - 0.3), at(-BACK_N)),
        Joint { id: "knot".into(), kind: JointKind::Free, position_m: at(from_m) },
        Joint { id: "hand".into(), kind: hand, position_m: at(from_m + 0.7) },
    ];
    let mut lines = vec![line("before", 0.3, 12), line("behind", 0.7, 28)];
    (lines[0].from, lines[0].to, lines[1].from, lines[1].to) = (0, 1, 1, 2);
    lines[0].knots_m = [0.0, knot_m];
    places.iter().for_each(|place| across(&mut joints, &mut lines, *place));
    let mut sea = water(1025.0, 0.0);
    (sea.gravity_m_s2, sea.depth_m) = (0.0, 1000.0);
    let law = RopeOnRope { friction, ..RopeOnRope::default() };
    let settings = Settings {
        step_s: 0.002,
        contact_step_s: 0.001,
        as_placed: true,
        rope_on_rope: Some(law),
        ..Settings::default()
    };
    model(sea, joints, lines, Vec::new(), settings)
}

/// A hand that draws with a force more than what pulls back.
fn weighed(force_n: f64) -> JointKind {
    JointKind::Pulled { force_n: DVec3::X * (force_n + BACK_N), from_s: -1.0 }
}

/// A hand that moves at `SPEED` and stops.
fn driven(until_s: f64) -> JointKind {
    JointKind::Driven { velocity_m_s: DVec3::X * SPEED, from_s: 0.0, until_s }
}

/// Two ropes across with this gap between them.
fn gap(gap_m: f64) -> [DVec3; 2] {
    [-1.0, 1.0].map(|side| DVec3::Y * (side * (0.5 * gap_m + ROPE_M)))
}

/// A run with its metrics.
struct Run {
    model: Model,
    state: State,
    workspace: Workspace,
    metrics: Metrics,
}

impl Run {
    fn begin(model: Model) -> Self {
        let (state, workspace) = (State::start(&model), Workspace::new(&model));
        Self { metrics: Metrics::new(&model), state, workspace, model }
    }

    /// Steps for so long, or until the knot has passed; the greatest force on the knot from behind and before [N].
    fn until(&mut self, until_s: f64) -> f64 {
        let mut greatest_n = 0.0_f64;
        while self.state.time_s < until_s - 1e-9 && self.knot_m() < PAST_M {
            step(&self.model, &Input::default(), &mut self.state, &mut self.workspace)
                .unwrap_or_else(|stop| panic!("at {} s: {stop:?}", self.state.time_s));
            self.metrics.fold_step(&self.model, &self.state, &self.workspace);
            let behind = self.model.line_segments[1].start;
            let tension = &self.state.rope.tension;
            greatest_n = greatest_n.max(tension[behind] - tension[behind - 1]);
        }
        let audit = &self.workspace.audit;
        assert_eq!((audit.ropes_crossed, audit.ropes_through, audit.unconverged), (0, 0, 0));
        greatest_n
    }

    /// Where the knot is along x.
    fn knot_m(&self) -> f64 {
        self.state.rope.position[self.model.line_nodes[1].start].x
    }
}

/// Position at which a knot touches two ropes [m].
fn touches_m(knot_m: f64, gap_m: f64) -> f64 {
    let (reach, aside) = (knot_m + ROPE_M, 0.5 * gap_m + ROPE_M);
    -libm::sqrt((reach * reach - aside * aside).max(0.0))
}

/// Greatest force of two ropes that a knot spreads, without friction (`app/sim/src/broad_phase/knots.rs`).
fn spreading_n(knot_m: f64, gap_m: f64) -> f64 {
    let (reach, aside) = (knot_m + ROPE_M, 0.5 * gap_m + ROPE_M);
    if reach < aside {
        return 0.0;
    }
    let stiffness = ACROSS_N / HALF_M;
    let apart = libm::cbrt(reach * aside * aside);
    2.0 * stiffness * libm::sqrt(apart * apart - aside * aside) * (reach / apart - 1.0)
}

/// Drawn slowly, a knot needs the force that spreads the ropes, and one that is narrower than the gap needs none.
#[test]
fn a_knot_passes_between_two_ropes_at_the_force_that_spreads_them() {
    for (gap_m, knot_m) in
        [(0.016, 0.013), (0.016, 0.010), (0.020, 0.016), (0.016, 0.0075), (0.016, 0.0)]
    {
        let from_m = touches_m(knot_m, gap_m) - 0.005;
        let mut run = Run::begin(drawn(knot_m, from_m, driven(10.0), 0.0, &gap(gap_m)));
        let (force_n, expected_n) = (run.until(2.0), spreading_n(knot_m, gap_m));
        println!("gap {gap_m} m, knot {knot_m} m: {force_n:.3} N for {expected_n:.3} N");
        assert!(run.knot_m() >= PAST_M, "gap {gap_m} m, knot {knot_m} m");
        assert!((force_n - expected_n).abs() < 0.03 * expected_n + 0.1, "{force_n} {expected_n}");
    }
}

/// Under less than half of that force, which a sudden pull at most doubles, it holds; under more it passes.
#[test]
fn a_knot_holds_under_less() {
    for (gap_m, knot_m) in [(0.016, 0.013), (0.024, 0.016)] {
        for share in [0.4, 1.2] {
            let force_n = share * spreading_n(knot_m, gap_m);
            let from_m = touches_m(knot_m, gap_m) - 1e-4;
            let mut run = Run::begin(drawn(knot_m, from_m, weighed(force_n), 0.0, &gap(gap_m)));
            run.until(1.0);
            println!("gap {gap_m} m, knot {knot_m} m, {force_n:.2} N: at {:.4} m", run.knot_m());
            assert_eq!(run.knot_m() < 0.0, share < 1.0, "{force_n} N: {} m", run.knot_m());
        }
    }
}

/// A knot that is drawn up to two ropes and held there has jammed; rope alone has not, and runs through.
#[test]
fn a_knot_held_by_other_rope_has_jammed() {
    for (knot_m, jams) in [(0.013, 1), (0.0, 0)] {
        let mut run = Run::begin(drawn(knot_m, -0.03, driven(0.2), 0.15, &gap(0.016)));
        run.until(6.0);
        let jammed =
            run.metrics.events().iter().filter(|event| event.kind == EventKind::JammedKnot).count();
        println!("knot {knot_m} m: at {:.4} m, {:?}", run.knot_m(), run.metrics.events());
        assert_eq!(jammed, jams, "knot {knot_m} m");
    }
}

/// A short rope with a knot, thrown at two ropes that are fast at both ends.
fn thrown(knot_m: f64, gap_m: f64, speed_m_s: f64) -> Run {
    let mut spec = drawn(knot_m, -0.1, weighed(-BACK_N), 0.15, &gap(gap_m)).spec.clone();
    spec.joints[0].kind = weighed(-BACK_N);
    (spec.joints[0].position_m, spec.joints[2].position_m) = (DVec3::X * -0.15, DVec3::X * -0.05);
    spec.lines[..2].iter_mut().for_each(|line| line.segments_m = vec![0.025; 2]);
    for line in &mut spec.lines[2..] {
        for joint in [line.from, line.to] {
            spec.joints[joint].kind = JointKind::Fixed;
        }
        line.segments_m.iter_mut().for_each(|length_m| *length_m /= 1.02);
    }
    let mut run = Run::begin(Model::new(spec).expect("a sound model"));
    let nodes = run.model.line_nodes[0].start..run.model.line_nodes[1].end;
    run.state.rope.velocity[nodes].fill(DVec3::X * speed_m_s);
    run
}

#[test]
fn a_thrown_knot_flies_through_no_narrow_gap() {
    for speed_m_s in [5.0, 20.0, 80.0] {
        let mut run = thrown(0.04, 0.016, speed_m_s);
        let mut most_m = -1.0_f64;
        for k in 1..=30 {
            run.until(0.002 * f64::from(k));
            most_m = most_m.max(run.knot_m());
        }
        println!("{speed_m_s} m/s: at most at {most_m:.4} m, {:?}", run.workspace.audit);
        assert!(most_m < 0.0 && most_m > -0.05, "{speed_m_s} m/s: {most_m} m");
    }
}

/// Of many knots thrown as fast as 60 to 90 m/s none passes, and nearly all steps converge.
#[test]
fn fast_knots_fly_through_no_narrow_gap_and_their_steps_converge() {
    let mut unconverged = 0;
    for k in 0..60 {
        let speed_m_s = 60.0 + 0.5 * f64::from(k);
        let mut run = thrown(0.04, 0.016, speed_m_s);
        while run.state.time_s < 0.06 - 1e-9 {
            step(&run.model, &Input::default(), &mut run.state, &mut run.workspace).unwrap_or_else(
                |stop| panic!("{speed_m_s} m/s at {} s: {stop:?}", run.state.time_s),
            );
            assert!(run.knot_m() < 0.0, "{speed_m_s} m/s: {} m", run.knot_m());
        }
        let audit = &run.workspace.audit;
        assert_eq!((audit.ropes_crossed, audit.ropes_through), (0, 0), "{speed_m_s} m/s");
        unconverged += audit.unconverged;
    }
    assert_eq!(unconverged, 0, "steps without convergence");
}

/// A small knot passes; it spreads the ropes, though it would fly past them within one step.
#[test]
fn a_knot_that_flies_past_within_a_step_pushes() {
    for speed_m_s in [40.0, 60.0, 80.0] {
        let mut run = thrown(0.013, 0.016, speed_m_s);
        let middle = run.model.line_nodes[2].start + 10;
        let at = |run: &Run| run.state.rope.position[middle].y;
        let (began_m, mut most_m) = (at(&run), 0.0_f64);
        for _ in 0..10 {
            run.until(run.state.time_s + 0.002);
            most_m = most_m.max((at(&run) - began_m).abs());
        }
        println!("{speed_m_s} m/s: aside by {:.2} mm, {:?}", 1e3 * most_m, run.workspace.audit);
        assert!(most_m > 1e-3, "{speed_m_s} m/s: aside by {most_m} m");
    }
}

/// Two ropes along z, each fast below and drawn up with `ACROSS_N`, with knots of these radii at half height. The second is brought up to the first
/// from the side until its lower end is this far from that of the first, without friction.
fn brought_up(knots_m: [f64; 2], from_m: f64, apart_m: f64) -> Model {
    let until_s = (from_m - apart_m) / SPEED;
    let hand = JointKind::Driven { velocity_m_s: -DVec3::Y * SPEED, from_s: 0.0, until_s };
    let mut joints = vec![fixed("first", -DVec3::Z * HALF_M)];
    joints.push(Joint {
        id: "second".into(),
        kind: hand,
        position_m: DVec3::new(0.0, from_m, -HALF_M),
    });
    let mut lines = Vec::new();
    for (rope, knot_m) in knots_m.into_iter().enumerate() {
        let (first, place) = (joints.len(), joints[rope].position_m + DVec3::Z * HALF_M);
        joints.push(Joint { id: format!("knot {rope}"), kind: JointKind::Free, position_m: place });
        joints.push(pulled(
            format!("above {rope}"),
            place + DVec3::Z * HALF_M,
            DVec3::Z * ACROSS_N,
        ));
        let mut halves = ["below", "over"].map(|half| line(&format!("{half} {rope}"), HALF_M, 10));
        (halves[0].from, halves[0].to, halves[1].from, halves[1].to) =
            (rope, first, first, first + 1);
        halves[0].knots_m = [0.0, knot_m];
        lines.extend(halves);
    }
    let mut sea = water(1025.0, 0.0);
    (sea.gravity_m_s2, sea.depth_m) = (0.0, 1000.0);
    let law = RopeOnRope { friction: 0.0, ..RopeOnRope::default() };
    let settings = Settings {
        step_s: 0.002,
        contact_step_s: 0.001,
        as_placed: true,
        rope_on_rope: Some(law),
        ..Settings::default()
    };
    model(sea, joints, lines, Vec::new(), settings)
}

/// Two knots keep the sum of their radii apart. What draws each rope up does not hold it aside, so that a knot `u` aside of its lower end, `l` away
/// from it, is pressed by `T u/l`; the push on both is one. Where one of them is bare rope, that keeps its own radius.
#[test]
fn two_knots_lean_on_each_other_by_the_sum_of_their_radii() {
    for knots_m in [[0.013, 0.013], [0.016, 0.010], [0.013, 0.0]] {
        let h_m: f64 = knots_m.iter().map(|knot_m| f64::max(*knot_m, ROPE_M)).sum();
        let mut run = Run::begin(brought_up(knots_m, h_m + 0.002, 0.012));
        run.until(2.0);
        let at = |line: usize, node: usize| {
            run.state.rope.position[run.model.line_nodes[line].start + node]
        };
        let [mine, other] = [0, 2].map(|line| at(line, 10));
        let pushes_n = [0, 2].map(|line| {
            let below = at(line, 10) - at(line, 0);
            ACROSS_N * below.y.abs() / below.length()
        });
        let touches: Vec<_> =
            run.workspace.rope_touches.iter().filter(|touch| touch.normal_force_n > 0.0).collect();
        println!("{knots_m:?}: {pushes_n:?} N, {touches:?}");
        // Bare rope is touched on both sides of its middle node.
        let are_knots = knots_m.map(|knot_m| knot_m > 0.0);
        assert!(touches.len() == 1 || !are_knots[1], "{touches:?}");
        assert!(touches.iter().all(|touch| touch.knots.map(|knot| knot.is_some()) == are_knots));
        let push_n: f64 = touches.iter().map(|touch| touch.normal_force_n).sum();
        assert!(pushes_n.iter().all(|n| (n - push_n).abs() < 0.01 * push_n), "{pushes_n:?}");
        // The push is linear at first: at this depth it has hardly begun to stiffen.
        let depth_m = push_n / (RopeOnRope::default().stiffness_n_m2 * h_m);
        let distance_m = (other - mine).length();
        assert!((h_m - depth_m - distance_m).abs() < 0.1 * depth_m, "{distance_m} m of {h_m} m");
    }
}
