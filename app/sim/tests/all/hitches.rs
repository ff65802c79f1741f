//! Rope made fast to a post: turns hold as the capstan law says, half hitches by what crosses over them.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use std::f64::consts::TAU;

use endline_fixtures::gear::{line, model_with, obstacle, water};
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{Joint, JointKind, RopeOnRope, Settings};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, step};

/// Radius of the rope's centre line on the post [m].
const RADIUS: f64 = 0.055;
/// Diameter of the common rope [m].
const THICK: f64 = 0.010;
/// Friction of rope on the post.
const FRICTION: f64 = 0.25;
/// Pull on the tail [N].
const TAIL_N: f64 = 5.0;
/// Straight rope at either end, where a way says nothing else of its tail [m].
const STRAIGHT: f64 = 0.25;
/// Friction of a slippery rope on itself and on the post.
const SLIPPERY: f64 = 0.05;
/// Speed of the hand [m/s].
const SPEED: f64 = 0.05;

/// A way round a post that stands along z: place at an angle, which grows along the rope.
struct Way {
    turn: f64,
    height: fn(f64, f64) -> f64,
    radius: fn(f64, f64) -> f64,
    /// Straight rope at its tail [m].
    tail_m: f64,
}

/// 0 before `from`, 1 after `to`, smooth between.
fn rise(at: f64, from: f64, to: f64) -> f64 {
    let share = ((at - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Turns beside each other.
fn round_turns(turns: f64) -> Way {
    Way {
        turn: TAU * turns,
        height: |angle, _| 1.2 * THICK * angle / TAU,
        radius: |_, _| RADIUS,
        tail_m: STRAIGHT,
    }
}

/// Two half hitches on the post: a turn below, over its own beginning to a turn above, and the tail under what crosses.
fn two_half_hitches() -> Way {
    Way {
        turn: 2.0 * TAU,
        height: |angle, turn| {
            let (beside, apart) = (0.6 * THICK, 2.2 * THICK);
            let begin = beside - (beside + apart) * rise(angle, 0.5, 2.0);
            let across = 2.0 * apart * rise(angle, 0.5 * turn - 1.2, 0.5 * turn + 1.2);
            begin + across - (beside + apart) * rise(angle, turn - 2.0, turn - 0.5)
        },
        radius: |angle, turn| {
            let off = (angle - 0.5 * turn).abs();
            RADIUS + 1.05 * THICK * (1.0 - rise(off, 0.6, 1.5))
        },
        tail_m: STRAIGHT,
    }
}

impl Way {
    /// The whole way with its straight ends, in small steps.
    fn fine(&self) -> Vec<DVec3> {
        let count = 4000;
        let at = |angle: f64| {
            let (radius, height) =
                ((self.radius)(angle, self.turn), (self.height)(angle, self.turn));
            DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), height)
        };
        let ahead = |angle: f64| DVec3::new(-libm::sin(angle), libm::cos(angle), 0.0);
        let mut way: Vec<DVec3> = (1..=50)
            .rev()
            .map(|k| at(0.0) - ahead(0.0) * (STRAIGHT * f64::from(k) / 50.0))
            .collect();
        way.extend((0..=count).map(|k| at(self.turn * f64::from(k) / f64::from(count))));
        way.extend(
            (1..=50)
                .map(|k| at(self.turn) + ahead(self.turn) * (self.tail_m * f64::from(k) / 50.0)),
        );
        way
    }

    /// A slippery rope laid along it with a knot of this radius at its tail, drawn twice as fast.
    fn slippery(&self, segments: usize, knot_m: f64) -> Model {
        let mut spec = self.model(segments).spec;
        spec.lines[0].knots_m = [0.0, knot_m];
        spec.obstacles[0].friction = SLIPPERY;
        spec.settings.rope_on_rope =
            Some(RopeOnRope { friction: SLIPPERY, ..RopeOnRope::default() });
        if let JointKind::Driven { velocity_m_s, .. } = &mut spec.joints[0].kind {
            *velocity_m_s *= 2.0;
        }
        Model::new(spec).expect("the same with a knot")
    }

    /// A rope laid along it, with the hand at its beginning driven away and the tail at its end pulled.
    fn model(&self, segments: usize) -> Model {
        let way = self.fine();
        let mut along = vec![0.0];
        for pair in way.windows(2) {
            along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
        }
        let whole = along[along.len() - 1];
        let at = |length: f64| {
            let next = along.partition_point(|here| *here < length).clamp(1, way.len() - 1);
            way[next - 1]
                .lerp(way[next], (length - along[next - 1]) / (along[next] - along[next - 1]))
        };
        let nodes: Vec<DVec3> =
            (0..=segments).map(|k| at(whole * k as f64 / segments as f64)).collect();
        let out = (nodes[0] - nodes[1]).normalize();
        let tail = (nodes[segments] - nodes[segments - 1]).normalize() * TAIL_N;
        let joints = vec![
            Joint {
                id: "hand".into(),
                kind: JointKind::Driven {
                    velocity_m_s: out * SPEED,
                    from_s: 0.0,
                    until_s: f64::INFINITY,
                },
                position_m: nodes[0],
            },
            Joint {
                id: "tail".into(),
                kind: JointKind::Pulled { force_n: tail, from_s: -1.0 },
                position_m: nodes[segments],
            },
        ];
        let mut rope = line("rope", whole, segments);
        rope.segments_m = nodes.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
        rope.start_m = nodes;
        let shape = SolidShape::Cylinder { radius_m: RADIUS - 0.5 * THICK, half_length_m: 0.3 };
        let post = obstacle(shape, DVec3::ZERO, DQuat::IDENTITY, FRICTION);
        let settings = Settings {
            step_s: 0.002,
            rope_on_rope: Some(RopeOnRope::default()),
            as_placed: true,
            ..Settings::default()
        };
        let mut sea = water(1025.0, 0.0);
        sea.gravity_m_s2 = 0.0;
        model_with(sea, joints, vec![rope], Vec::new(), settings, vec![post])
    }
}

/// A rope on its post while the hand draws.
struct Pull {
    model: Model,
    state: State,
    workspace: Workspace,
    from: DVec3,
    /// Direction in which the tail is pulled.
    tail: DVec3,
}

impl Pull {
    fn begin(model: Model) -> Self {
        let (state, workspace) = (State::start(&model), Workspace::new(&model));
        let from = state.rope.position[model.node_count - 1];
        let JointKind::Pulled { force_n, .. } = model.spec.joints[1].kind else {
            panic!("the tail is pulled")
        };
        Self { model, state, workspace, from, tail: force_n.normalize() }
    }

    fn step(&mut self) {
        step(&self.model, &Input::default(), &mut self.state, &mut self.workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }

    /// The hand's pull over the tail's.
    fn ratio(&self) -> f64 {
        self.state.rope.tension[0] / TAIL_N
    }

    /// How far the tail has been drawn in from where it began [m].
    fn came(&self) -> f64 {
        (self.from - self.state.rope.position[self.model.node_count - 1]).dot(self.tail)
    }

    /// Draws for so long; the mean ratio over the last third.
    fn draw(&mut self, seconds: f64) -> f64 {
        let steps = (seconds / self.model.spec.settings.step_s).round() as usize;
        let mut sum = 0.0;
        for k in 0..steps {
            self.step();
            sum += if k >= steps - steps / 3 { self.ratio() } else { 0.0 };
        }
        sum / (steps / 3) as f64
    }

    /// Draws until the ratio is reached, holds the hand there and waits: the ratio then, and how far the tail came in the last
    /// half of that time [m].
    fn hold(&mut self, ratio: f64, seconds: f64) -> (f64, f64) {
        while self.ratio() < ratio {
            assert!(self.state.time_s < 3.0, "it never held {ratio}: {}", self.ratio());
            self.step();
        }
        let mut spec = self.model.spec.clone();
        spec.joints[0] = Joint {
            kind: JointKind::Fixed,
            position_m: self.state.rope.position[0],
            ..spec.joints[0].clone()
        };
        self.model = Model::new(spec).expect("the same with the hand at rest");
        self.draw(0.5 * seconds);
        let before = self.came();
        let held = self.draw(0.5 * seconds);
        (held, (self.came() - before).abs())
    }
}

/// Load over the tail's pull that is asked of every hitch: eight times what one turn holds.
const ASKED: f64 = 40.0;

#[test]
fn one_turn_and_two_slip_where_the_capstan_law_says() {
    for (turns, seconds) in [(1.0, 1.0), (2.0, 1.5)] {
        let mut pull = Pull::begin(round_turns(turns).model((60.0 + 30.0 * turns) as usize));
        let ratio = pull.draw(seconds);
        let expected = libm::exp(FRICTION * TAU * turns);
        println!(
            "{turns} turns: {ratio:.3} for {expected:.3}, tail came {:.1} mm, {:?}",
            1e3 * pull.came(),
            pull.workspace.audit
        );
        assert!(
            expected < ASKED && (ratio / expected - 1.0).abs() < 0.03,
            "{ratio} for {expected}"
        );
        assert!(pull.came() > 0.01);
    }
}

#[test]
fn three_turns_hold_it() {
    let mut pull = Pull::begin(round_turns(3.0).model(150));
    let (held, crept) = pull.hold(ASKED, 1.0);
    println!("three turns: {held:.2}, crept {:.2e} m", crept);
    assert!(held > 0.95 * ASKED && crept < 1e-5, "{held}, {crept}");
}

/// Two half hitches have the wrap angle of two turns, which slip at 23 times the tail's pull. The strand on top presses on the one
/// below and holds it.
#[test]
fn two_half_hitches_hold_it_too() {
    let mut pull = Pull::begin(two_half_hitches().model(150));
    let (held, crept) = pull.hold(ASKED, 1.0);
    println!("two half hitches: {held:.2}, crept {:.2e} m, {:?}", crept, pull.workspace.audit);
    assert!(held > 0.95 * ASKED && crept < 1e-5, "{held}, {crept}");
    assert!(
        pull.workspace.rope_touches.iter().map(|touch| touch.normal_force_n).fold(0.0, f64::max)
            > TAIL_N
    );
    assert_eq!((pull.workspace.audit.ropes_crossed, pull.workspace.audit.ropes_through), (0, 0));
}

/// Without contact of rope on rope the hitches slip: the crossing strands hold them.
#[test]
fn without_rope_on_rope_the_hitches_slip() {
    let mut spec = two_half_hitches().model(150).spec;
    spec.settings.rope_on_rope = None;
    let mut pull = Pull::begin(Model::new(spec).expect("a sound model"));
    let ratio = pull.draw(1.5);
    println!("two half hitches through each other: {ratio:.2}");
    assert!(ratio < 0.75 * ASKED, "{ratio}");
}

/// A slippery rope runs out of its hitches at twice the pull on its tail. A knot at the tail has to lift what crosses over it.
#[test]
fn a_knot_is_held_by_what_crosses_over_it() {
    let way = Way { tail_m: 0.02, ..two_half_hitches() };
    let [bare, knotted] = [0.0, 0.02].map(|knot_m| {
        let mut pull = Pull::begin(way.slippery(100, knot_m));
        let mut most = 0.0_f64;
        while pull.came() < 0.06 {
            pull.step();
            most = most.max(pull.ratio());
        }
        println!("knot {knot_m} m: {most:.2}, {:?}", pull.workspace.audit);
        assert_eq!(pull.workspace.audit.ropes_crossed, 0);
        most
    });
    assert!(bare < 2.5 && knotted > 1.6 * bare, "{bare}, with a knot {knotted}");
}
