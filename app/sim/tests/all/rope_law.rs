//! Rope law: damping named as a ratio, the toe's energy, bending against analytic answers.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::f64::consts::PI;

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::model::{Rope, Settings};
use endline_sim::{DVec3, Input, Model, State, Workspace, settle, step};

/// Returns the model with another rope.
fn with_rope(model: &Model, change: impl Fn(&mut Rope)) -> Model {
    let mut spec = model.spec.clone();
    change(&mut spec.ropes[0]);
    Model::new(spec).expect("a sound model")
}

fn advance(model: &Model, state: &mut State, workspace: &mut Workspace) {
    step(model, &Input::default(), state, workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
}

/// Times and values of the greatest swings of a series about zero, by a parabola through each peak's three points.
fn peaks(series: &[f64], step_s: f64) -> Vec<[f64; 2]> {
    let found = series
        .windows(3)
        .enumerate()
        .filter(|(_, near)| near[1] > near[0] && near[1] >= near[2] && near[1] > 0.0);
    let fitted = found.map(|(index, near)| {
        let (slope, curve) = (0.5 * (near[2] - near[0]), near[2] - 2.0 * near[1] + near[0]);
        let shift = -slope / curve;
        [(index as f64 + 1.0 + shift) * step_s, near[1] + 0.5 * slope * shift]
    });
    fitted.collect()
}

/// A weight of 20 kg on 1 m of rope in four segments, bounced: stiffness EA/l, dashpot BA/l.
///
/// Bounce `ω = √(EA/(l M))`; ratio `ζ = BA ω/(2 EA)`, with a number BA as with a ratio of a segment's critical damping,
/// `BA = 2 ζ_s (l/4) √(EA m)`; the logarithmic decrement is `2π ζ/√(1 - ζ²)`.
#[test]
fn damping_gives_the_logarithmic_decrement_it_names() {
    let (stiffness, mass, heavy, damping) = (1e5_f64, 0.06_f64, 20.0_f64, 60.0_f64);
    let bounced = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
        vec![line("rope", 1.0, 4)],
        vec![weight("weight", heavy, DVec3::Z * -1.002, None)],
        Settings { step_s: 2e-4, ..Settings::default() },
    );
    // The ratio that gives the same BA.
    let ratio = damping / (2.0 * 0.25 * (stiffness * mass).sqrt());
    for (named, ratio_named) in [(damping, 0.0), (0.0, ratio), (0.5 * damping, 0.5 * ratio)] {
        let model = with_rope(&bounced, |rope| {
            (rope.axial_damping_n_s, rope.axial_damping_ratio) = (named, ratio_named)
        });
        let mut state = settle(&model).state;
        let rest = state.bodies[0].position.z;
        // The swing is a third of the stretch at rest, so the rope stays taut.
        state.bodies[0].velocity = DVec3::Z * 0.045;
        let mut workspace = Workspace::new(&model);
        let mut heights = Vec::new();
        while state.time_s < 0.5 {
            advance(&model, &mut state, &mut workspace);
            heights.push(state.bodies[0].position.z - rest);
        }
        let swings = peaks(&heights, 2e-4);
        let measured = libm::log(swings[0][1] / swings[4][1]) / 4.0;
        let bounce = (stiffness / (heavy + mass / 3.0)).sqrt();
        let share = damping * bounce / (2.0 * stiffness);
        let expected = 2.0 * PI * share / (1.0 - share * share).sqrt();
        let period = (swings[4][0] - swings[0][0]) / 4.0;
        println!(
            "BA {named} N s, ratio {ratio_named:.3}: decrement {measured:.5} for {expected:.5}, period {period:.5} s"
        );
        assert!((measured / expected - 1.0).abs() < 0.02, "{measured} against {expected}");
        assert!((period * bounce / (2.0 * PI) - 1.0).abs() < 0.005, "{period}");
    }
}

/// A weight let fall on the soft toe stretches it until the toe's energy is the fall's:
/// `M g (h + L ε) = L (EA ε²/2 + EA2 ε³/3)`.
#[test]
fn the_toe_takes_up_the_energy_of_a_fall() {
    let (stiffness, stiffening, heavy, length, drop) = (17_300.0, 145_000.0, 40.0, 10.0, 0.5);
    let start = DVec3::Z * (drop - length);
    let dropped = model(
        water(0.0, 0.0),
        vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
        vec![line("rope", length, 20)],
        vec![weight("weight", heavy, start, None)],
        Settings { step_s: 5e-4, ..Settings::default() },
    );
    let model = with_rope(&dropped, |rope| {
        (rope.axial_stiffness_n, rope.axial_stiffening_n, rope.axial_damping_n_s) =
            (stiffness, stiffening, 0.0);
        rope.mass_kg_m = 1e-3;
    });
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    let mut lowest = 0.0_f64;
    while state.time_s < 1.0 {
        advance(&model, &mut state, &mut workspace);
        lowest = lowest.min(state.bodies[0].position.z);
    }
    let strain = -lowest / length - 1.0;
    let taken =
        length * (stiffness * strain * strain / 2.0 + stiffening * strain * strain * strain / 3.0);
    let fallen = heavy * 9.81 * (drop + length * strain);
    println!("strain {strain:.5}: taken {taken:.2} J of {fallen:.2} J");
    assert!((taken / fallen - 1.0).abs() < 0.01);
}

/// Sag of a rope of 2 m held at both ends under tension, with weight and bending, and the beam equation's.
///
/// `EI y⁗ - T y″ = -w` with `y = y″ = 0` at both ends has
/// `y = -(w/T) [x (L - x)/2 - (1 - cosh(k(x - L/2))/cosh(kL/2))/k²]`, `k = √(T/EI)`.
fn taut_beam(segments: usize, bending: f64) -> (f64, f64) {
    let (length, stiffness, mass, stretch) = (2.0, 2e4, 0.06, 1.001);
    let bent = model(
        water(0.0, 0.0),
        vec![fixed("left", DVec3::ZERO), fixed("right", DVec3::X * length * stretch)],
        vec![line("rope", length, segments)],
        Vec::new(),
        Settings::default(),
    );
    let model = with_rope(&bent, |rope| {
        (rope.axial_stiffness_n, rope.mass_kg_m, rope.bending_stiffness_n_m2) =
            (stiffness, mass, bending)
    });
    let settled = settle(&model);
    println!("residual {:.1e} N after {} passes", settled.residual_n, settled.trace_n.len());
    assert!(settled.converged);
    let tension = settled.state.rope.tension[segments / 2];
    let (span, load) = (length * stretch, mass * 9.81 / stretch);
    let k = (tension / bending).sqrt();
    let sag =
        load / tension * (span * span / 8.0 - (1.0 - 1.0 / libm::cosh(k * span / 2.0)) / (k * k));
    (-settled.state.rope.position[segments / 2].z, sag)
}

/// Bending over `√(EI/T)`, a twelfth of the span [N m²].
const BENDING: f64 = 0.55;

#[test]
fn a_taut_rope_that_resists_bending_sags_as_the_beam_equation_says() {
    let errors = [10, 20, 40].map(|segments| {
        let (sag, expected) = taut_beam(segments, BENDING);
        println!("{segments} segments: sag {:.5} mm for {:.5} mm", 1e3 * sag, 1e3 * expected);
        (sag / expected - 1.0).abs()
    });
    let without = taut_beam(40, 1e-9).0;
    println!("without bending {:.5} mm", 1e3 * without);
    assert!(without > 1.04 * taut_beam(40, BENDING).1, "bending carries a part of the load");
    // Statics ends at 0.1 mN out of balance at a node; at 40 segments a node weighs 30 mN.
    assert!(errors.iter().all(|error| *error < 1.5e-3), "{errors:?}");
}

/// A rod between two pins swings as a beam: `ω = π² √(EI/m)/L²`. It hardly stretches, so there is no tension to speak of.
#[test]
fn a_pinned_rod_swings_with_the_frequency_of_a_beam() {
    let (length, bending, mass, segments) = (1.0_f64, 0.01_f64, 0.06_f64, 20);
    let rod = model(
        water(0.0, 0.0),
        vec![fixed("left", DVec3::ZERO), fixed("right", DVec3::X * length)],
        vec![line("rod", length, segments)],
        Vec::new(),
        Settings { step_s: 2e-3, ..Settings::default() },
    );
    let mut spec = rod.spec.clone();
    let rope = &mut spec.ropes[0];
    (rope.axial_stiffness_n, rope.axial_damping_n_s, rope.mass_kg_m, rope.bending_stiffness_n_m2) =
        (1.0, 0.0, mass, bending);
    spec.water.gravity_m_s2 = 0.0;
    let model = Model::new(spec).expect("a sound model");
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    for (node, velocity) in state.rope.velocity.iter_mut().enumerate() {
        *velocity = DVec3::Z * 0.02 * libm::sin(PI * node as f64 / segments as f64);
    }
    let mut heights = Vec::new();
    while state.time_s < 9.0 {
        advance(&model, &mut state, &mut workspace);
        heights.push(state.rope.position[segments / 2].z);
    }
    let swings = peaks(&heights, 2e-3);
    let (first, last) = (swings[0], swings[swings.len() - 1]);
    let swing = 2.0 * PI * (swings.len() - 1) as f64 / (last[0] - first[0]);
    let expected = PI * PI * (bending / mass).sqrt() / (length * length);
    let passes = workspace.audit.passes as f64 / workspace.audit.solver_steps as f64;
    println!(
        "{swing:.4} rad/s for {expected:.4}; the last of {} swings is {:.4} of the first; {passes:.2} passes a step",
        swings.len(),
        last[1] / first[1]
    );
    assert!((swing / expected - 1.0).abs() < 0.005, "{swing} against {expected}");
    assert!((last[1] / first[1] - 1.0).abs() < 0.02);
}

/// However stiff against bending, however coarse the step, a rope with a weight falls and whips about without blowing up.
#[test]
fn no_bending_stiffness_blows_up() {
    for bending in [1e-3, 1.0, 100.0] {
        let thrown = model(
            water(0.0, 0.0),
            vec![fixed("pin", DVec3::ZERO), on_body("weight", 0)],
            vec![line("rope", 5.0, 50)],
            vec![weight("weight", 1.0, DVec3::X * 5.0, None)],
            Settings { step_s: 0.02, ..Settings::default() },
        );
        let model = with_rope(&thrown, |rope| rope.bending_stiffness_n_m2 = bending);
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let (mut fastest, mut lowest) = (0.0_f64, 0.0_f64);
        while state.time_s < 2.0 {
            advance(&model, &mut state, &mut workspace);
            fastest = state
                .rope
                .velocity
                .iter()
                .map(|velocity| velocity.length())
                .fold(fastest, f64::max);
            lowest = state.rope.position.iter().map(|place| place.z).fold(lowest, f64::min);
        }
        println!(
            "EI {bending} N m2: at most {fastest:.2} m/s, lowest {lowest:.3} m, {} passes",
            workspace.audit.passes
        );
        // A weight that falls by its rope's length goes at √(2 g L) = 9.9 m/s; rope whipped about it at a few times that.
        assert!(fastest < 40.0 && lowest > -5.5);
    }
}
