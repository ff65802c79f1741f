//! The kinetic whale with rope made fast to it: momentum, energy, thrust against a tether, gear under tow.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use endline_fixtures::gear::{fixed, line, on_body, weight};
use endline_fixtures::whale::{bursts, kinetic, spec, spindle_whale, swimming, swims};
use endline_sdk::Controls;
use endline_sim::model::{Body, Hitch, Joint, JointKind, ModelSpec, Whale};
use endline_sim::whale::Kinetic;
use endline_sim::whale::kinetic::Effort;
use endline_sim::{DVec3, Input, Model, State, Workspace, step};

/// Eg 2212: 12.35 m; mass by length, diameter by photogrammetry.
fn eg_2212() -> Kinetic {
    kinetic(12.35, 22_350.0, 2.98)
}

/// Usual distance of the joint at the tail from skin [m].
const STAND_OFF_M: f64 = 0.05;

/// The joint at the tip of the tail.
fn tail(length_m: f64, stand_off_m: f64) -> Joint {
    let hitch = Hitch { triangle: 1, barycentric: [1.0, 0.0, 0.0], stand_off_m };
    Joint {
        id: "whale:tail".into(),
        kind: JointKind::Whale(hitch),
        position_m: DVec3::new(-0.5 * length_m - stand_off_m, 0.0, -12.0),
    }
}

/// A whale with `length_m` of rope from its tail to a joint so far behind it.
fn towing(
    whale: Whale,
    density_kg_m3: f64,
    rope: (f64, usize),
    end: impl Fn(DVec3) -> (Joint, Vec<Body>),
) -> ModelSpec {
    towing_at(STAND_OFF_M, whale, density_kg_m3, rope, end)
}

/// A spec as that of `towing`, with the rope fast at a distance from skin.
fn towing_at(
    stand_off_m: f64,
    whale: Whale,
    density_kg_m3: f64,
    (length_m, segments): (f64, usize),
    end: impl Fn(DVec3) -> (Joint, Vec<Body>),
) -> ModelSpec {
    let mut spec = spec(whale, density_kg_m3);
    let tail = tail(spec.whale.as_ref().map_or(0.0, |whale| whale.length_m), stand_off_m);
    let (end, bodies) = end(tail.position_m - DVec3::X * length_m);
    spec.joints = vec![tail, end];
    spec.bodies = bodies;
    spec.lines = vec![line("tow", length_m, segments)];
    spec.ropes[0].axial_damping_n_s = 0.0;
    spec
}

fn run(model: &Model, controls: Controls, time_s: f64, mut look: impl FnMut(&State)) -> State {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    while state.time_s < time_s - 1e-9 {
        step(model, &Input { controls }, &mut state, &mut workspace).expect("a step");
        look(&state);
    }
    state
}

fn speed(state: &State) -> f64 {
    state.whale.as_ref().expect("a whale").speed_m_s
}

/// A whale glides into a tether without drag and is thrown back: `peak = U √(k m)`, and it leaves as fast as it came.
#[test]
fn a_tether_gives_back_the_energy_it_took() {
    for step_s in [0.01, 0.0025] {
        let kinetic = eg_2212();
        let (mass, stiffness) = (kinetic.whole_mass_kg().x, 1e5 / 10.0);
        let whale = spindle_whale(kinetic, 1.0, swimming(0.0, [0.0; 3]));
        let mut spec = towing(whale, 0.0, (10.0, 8), |end| (fixed("post", end), Vec::new()));
        spec.water.gravity_m_s2 = 0.0;
        spec.settings.step_s = step_s;
        let model = Model::new(spec).expect("a sound model");
        let mut peak = 0.0_f64;
        let swing_s = std::f64::consts::PI * libm::sqrt(mass / stiffness);
        let state = run(&model, Controls::default(), swing_s + 0.5, |state| {
            peak = peak.max(state.rope.tension[0])
        });
        let foretold = libm::sqrt(stiffness * mass);
        assert!((peak / foretold - 1.0).abs() < 5e-3, "step {step_s}: {peak} against {foretold} N");
        assert!((speed(&state) + 1.0).abs() < 2e-3, "step {step_s}: left at {} m/s", speed(&state));
    }
}

/// Near skin and beyond the margin in which skin is searched for.
#[test]
fn whale_and_what_it_pulls_keep_their_momentum() {
    for stand_off_m in [STAND_OFF_M, 0.12] {
        momentum_is_kept(stand_off_m);
    }
}

fn momentum_is_kept(stand_off_m: f64) {
    let kinetic = eg_2212();
    let mass = kinetic.whole_mass_kg().x;
    let whale = spindle_whale(kinetic, 1.5, swimming(0.0, [0.0; 3]));
    let mut spec = towing_at(stand_off_m, whale, 0.0, (10.0, 8), |end| {
        (on_body("load", 0), vec![weight("load", 2_000.0, end, None)])
    });
    spec.water.gravity_m_s2 = 0.0;
    let model = Model::new(spec).expect("a sound model");
    let momentum = |state: &State| {
        let whale = state.whale.as_ref().expect("a whale");
        let rope: DVec3 = (1..8).map(|node| state.rope.velocity[node] * (0.06 * 10.0 / 8.0)).sum();
        let end = state.rope.velocity[8] * (0.06 * 10.0 / 16.0);
        whale.orientation * DVec3::X * (mass * whale.speed_m_s)
            + rope
            + end
            + state.bodies[0].velocity * 2_000.0
    };
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let state = run(&model, Controls::default(), 5.0, |state| {
        least = least.min(momentum(state).x);
        greatest = greatest.max(momentum(state).x);
    });
    assert!(
        state.bodies[0].velocity.x > 0.5,
        "the load is under way: {}",
        state.bodies[0].velocity.x
    );
    let start = 1.5 * mass;
    assert!(
        ((least - start) / start).abs() < 1e-5 && ((greatest - start) / start).abs() < 1e-5,
        "{stand_off_m} m: {least} and {greatest} against {start}"
    );
}

/// Thrust against a post: what it sustains, and in a burst Arthur's greatest force.
#[test]
fn held_at_a_post_it_pulls_with_what_its_length_allows() {
    for (controls, strength) in [(swims(), 99.0), (bursts(), 401.0)] {
        let mut kinetic = eg_2212();
        kinetic.muscle.effort = Effort::Speed;
        let whale = spindle_whale(kinetic, 0.0, swimming(1.3, [0.0; 3]));
        let mut spec = towing(whale, 1025.0, (10.0, 8), |end| (fixed("post", end), Vec::new()));
        // Rope that takes up the swing at once, so that the pull is the steady one.
        spec.ropes[0].axial_damping_n_s = 3e5;
        spec.settings.contact_step_s = 0.01;
        let model = Model::new(spec).expect("a sound model");
        let state = run(&model, controls, 25.0, |_| ());
        let pull = strength * libm::pow(12.35, 1.56);
        assert!(
            (state.rope.tension[0] / pull - 1.0).abs() < 0.01,
            "{} against {pull} N",
            state.rope.tension[0]
        );
    }
}

/// Gear of set 1 of van der Hoop et al. 2016 (trap and line, 201.9 N at 1 m/s) behind Eg 2212: she slows until `(D + G) u` is
/// what `D u` was, and pays for her speed by `(D + G)/D` where she keeps it.
#[test]
fn gear_under_tow_slows_a_whale_by_the_power_ratio() {
    let drag_area = 201.9 / (0.5 * 1025.0);
    let asked = 1.23;
    let clean = eg_2212();
    let resisted = |u: f64| clean.drag.drag_n(1025.0, u) + 0.5 * 1025.0 * drag_area * u * u;
    let clean_power = clean.drag.drag_n(1025.0, asked) * asked;
    let (mut low, mut high) = (0.1, asked);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if resisted(middle) * middle > clean_power { high = middle } else { low = middle }
    }
    for (effort, expected) in [(Effort::Power, low), (Effort::Speed, asked)] {
        let mut kinetic = clean.clone();
        kinetic.muscle.effort = effort;
        let whale = spindle_whale(kinetic, expected + 0.01, swimming(asked, [0.0; 3]));
        let mut spec = towing(whale, 1025.0, (24.0, 6), |end| {
            let mut load = weight("load", 20.0, end, None);
            load.drag_area_m2 = DVec3::splat(drag_area);
            (on_body("load", 0), vec![load])
        });
        spec.water.gravity_m_s2 = 0.0;
        spec.ropes[0].drag_normal = 0.0;
        spec.ropes[0].drag_tangential = 0.0;
        spec.ropes[0].axial_damping_n_s = 3e4;
        spec.settings.contact_step_s = 0.01;
        let model = Model::new(spec).expect("a sound model");
        let state = run(&model, swims(), 60.0, |_| ());
        let now = state.whale.as_ref().expect("a whale");
        assert!(
            (now.speed_m_s / expected - 1.0).abs() < 0.01,
            "{effort:?}: {} against {expected} m/s",
            now.speed_m_s
        );
        let power = now.exertion.power_w * clean.muscle.efficiency;
        let needed = resisted(now.speed_m_s) * now.speed_m_s;
        assert!((power / needed - 1.0).abs() < 0.03, "{effort:?}: {power} W against {needed} W");
        let ratio = power / clean_power;
        let paid = if effort == Effort::Speed {
            resisted(asked) / clean.drag.drag_n(1025.0, asked)
        } else {
            1.0
        };
        assert!(
            (ratio / paid - 1.0).abs() < 0.03,
            "{effort:?}: power {ratio} times that of a clean whale, against {paid}"
        );
    }
}
