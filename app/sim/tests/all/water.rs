//! Rope and bodies in waves, in a turning tide and on a sloping seabed, against closed forms and invariants.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says what it needs")]

use core::f64::consts::{PI, TAU};

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::model::{
    Body, BodyRole, Float, Form, Joint, JointKind, Passing, Seabed, Settings, WaterPlane,
};
use endline_sim::water::current::Tide;
use endline_sim::water::waves::{Spectrum, WaveKind, Waves, wave_number};
use endline_sim::water::{Current, Water};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, settle, step};

fn regular(height_m: f64, period_s: f64, ramp_s: f64) -> Waves {
    Waves {
        toward: DVec3::X,
        ramp_s,
        kind: WaveKind::Regular { height_m, period_s, phase_rad: 0.0 },
    }
}

fn irregular() -> Waves {
    let spectrum = Spectrum { significant_height_m: 1.0, peak_period_s: 5.0, gamma: 3.3 };
    Waves { toward: DVec3::X, ramp_s: 5.0, kind: WaveKind::Jonswap { spectrum, components: 30 } }
}

/// A float of 20 L, half under at rest, with its heave far quicker than the waves.
fn float(place: DVec3) -> Body {
    Body {
        added_mass_kg: DVec3::splat(5.0),
        drag_area_m2: DVec3::splat(0.04),
        floats: vec![Float::level(DVec3::ZERO, 0.02, 0.3)],
        wetted_drag: true,
        ..weight("float", 10.25, place, None)
    }
}

fn run(model: &Model, state: &mut State, until_s: f64, mut see: impl FnMut(&State)) {
    let mut workspace = Workspace::new(model);
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        see(state);
    }
}

/// Response amplitude 1, in heave against the surface over the float and in surge against the water's own orbit.
#[test]
fn a_free_float_follows_a_long_wave() {
    let sea = Water {
        waves: Some(regular(1.0, 12.0, 24.0)),
        rope_dries: true,
        depth_m: 60.0,
        ..water(1025.0, 0.0)
    };
    let settings = Settings { step_s: 0.02, ..Settings::default() };
    let model = model(sea, Vec::new(), Vec::new(), vec![float(DVec3::ZERO)], settings);
    let mut state = State::start(&model);
    let (mut highest, mut worst, mut fastest, mut slip) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    run(&model, &mut state, 72.0, |state| {
        if state.time_s > 36.0 {
            let (body, at) =
                (&state.bodies[0], model.sea.at(state.bodies[0].position, state.time_s));
            highest = highest.max(body.position.z);
            worst = worst.max((body.position.z - at.surface_m).abs());
            fastest = fastest.max(body.velocity.x);
            slip = slip.max((body.velocity.x - at.velocity_m_s.x).abs());
        }
    });
    println!(
        "heave {highest:.4} m for 0.5 m, off the surface by {worst:.4} m; surge {fastest:.4} m/s, slip {slip:.4} m/s"
    );
    assert!((highest / 0.5 - 1.0).abs() < 0.02 && worst < 0.01);
    // The orbit's speed at the surface is a ω coth kd.
    let orbit = 0.5 * TAU / 12.0 / libm::tanh(wave_number(TAU / 12.0, 60.0, 9.81) * 60.0);
    assert!((fastest / orbit - 1.0).abs() < 0.03 && slip < 0.03 * orbit);
}

/// Drag and inertia as large as each other, from below the troughs down: the pull at both ends of a taut rope half a metre
/// thick against Morison's integrals in closed form.
#[test]
fn a_fixed_rope_bears_morisons_force() {
    let (diameter, top, bottom, period) = (0.5, -2.0, -20.0, 8.0);
    let sea = Water { waves: Some(regular(2.0, period, 8.0)), ..water(1025.0, 0.0) };
    let ends = vec![
        fixed("bottom", DVec3::new(0.0, 0.0, bottom)),
        fixed("top", DVec3::new(0.0, 0.0, top)),
    ];
    let settings = Settings { step_s: 0.02, ..Settings::default() };
    let mut spec = model(
        sea,
        ends,
        vec![line("pile", (top - bottom) * (1.0 - 1e-4), 120)],
        Vec::new(),
        settings,
    )
    .spec;
    let rope = &mut spec.ropes[0];
    (rope.diameter_m, rope.mass_kg_m, rope.displaced_m3_m) =
        (diameter, 201.3, PI / 4.0 * diameter * diameter);
    (rope.axial_stiffness_n, rope.drag_normal, rope.added_mass_normal) = (1e11, 1.2, 0.8);
    let model = Model::new(spec).expect("a sound model");
    let (mut state, last) = (settle(&model).state, model.node_count - 1);
    let number = wave_number(TAU / period, 30.0, 9.81);
    // The outermost half segments hang on the fixtures.
    let half = 0.5 * (top - bottom) / 120.0;
    let sinh = libm::sinh(number * 30.0);
    let along = |z: f64| libm::sinh(number * (z + 30.0)) / (number * sinh);
    let squared = |z: f64| {
        (libm::sinh(2.0 * number * (z + 30.0)) / (4.0 * number) + 0.5 * (z + 30.0)) / (sinh * sinh)
    };
    let (reach, reach_squared) =
        (along(top - half) - along(bottom + half), squared(top - half) - squared(bottom + half));
    let speed = TAU / period;
    let closed = |time: f64| {
        let (sine, cosine) = libm::sincos(-speed * time);
        let drag =
            0.5 * 1025.0 * 1.2 * diameter * speed * speed * reach_squared * cosine * cosine.abs();
        drag + 1025.0 * PI / 4.0 * diameter * diameter * 1.8 * speed * speed * reach * sine
    };
    let (mut greatest, mut worst) = (0.0_f64, 0.0_f64);
    run(&model, &mut state, 24.0, |state| {
        if state.time_s > 16.0 {
            let pull = |segment: usize| {
                let between = state.rope.position[segment + 1] - state.rope.position[segment];
                between.x / between.length() * state.rope.tension[segment]
            };
            let force = pull(0) - pull(last - 1);
            greatest = greatest.max(closed(state.time_s).abs());
            worst = worst.max((force - closed(state.time_s)).abs());
        }
    });
    println!("greatest force {greatest:.1} N, off by {worst:.2} N at most");
    assert!(worst < 0.01 * greatest, "{worst} of {greatest}");
}

/// A float on a tether in current and waves.
fn moored(tide: Tide, waves: Option<Waves>, step_s: f64) -> Model {
    let current = Current { tide, ..Current::power(DVec3::X * 0.4, 1.0 / 7.0) };
    let sea = Water { current, waves, rope_dries: true, ..water(1025.0, 0.0) };
    let joints = vec![fixed("anchor", DVec3::new(0.0, 0.0, -30.0)), on_body("float", 0)];
    let settings = Settings { step_s, ..Settings::default() };
    model(
        sea,
        joints,
        vec![line("endline", 39.0, 60)],
        vec![float(DVec3::new(10.0, 0.0, 0.0))],
        settings,
    )
}

/// The start is that of still water, to the bit, and the first steps move away from it gently.
#[test]
fn dynamics_in_waves_starts_from_statics_without_them() {
    let (with, without) =
        (moored(Tide::Steady, Some(irregular()), 0.02), moored(Tide::Steady, None, 0.02));
    let (calm, mut state) = (settle(&without), settle(&with).state);
    assert!(calm.converged && state == calm.state);
    let tension = calm.state.rope.tension[59];
    for (until_s, share) in [(0.02, 1e-3), (0.1, 0.02), (0.2, 0.05)] {
        run(&with, &mut state, until_s, |_| ());
        let (now, speed) = (state.rope.tension[59], state.bodies[0].velocity.length());
        println!("{until_s} s: {now:.3} N after {tension:.3} N, {speed:.1e} m/s");
        assert!(
            (now - tension).abs() < share * tension && speed < share,
            "{now} N after {tension} N, {speed} m/s"
        );
    }
}

/// Waves are a function of time and seed alone: scratch dropped at every step, and a model made anew, change no bit.
#[test]
fn a_run_in_waves_repeats_to_the_bit() {
    let model = moored(Tide::Steady, Some(irregular()), 0.02);
    let start = settle(&model).state;
    let (mut kept, mut dropped) = (start.clone(), start.clone());
    run(&model, &mut kept, 4.0, |_| ());
    let again = Model::new(model.spec.clone()).expect("a sound model");
    while dropped.time_s < 4.0 - 1e-9 {
        step(&again, &Input::default(), &mut dropped, &mut Workspace::new(&again))
            .unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    assert!(kept == dropped);
    let mut other = model.spec.clone();
    other.settings.seed += 1;
    let (other, mut elsewhere) = (Model::new(other).expect("a sound model"), start.clone());
    run(&other, &mut elsewhere, 4.0, |_| ());
    assert!(kept != elsewhere);
}

/// A constituent without residual runs against itself half a period later: so does all that hangs in it. The float stands
/// under water, so that the tether is never slack.
#[test]
fn a_tide_that_turns_mirrors_the_rig_half_a_period_later() {
    let period_s = 300.0;
    let mut spec = moored(
        Tide::Constituent { period_s, peak_s: 0.0, minor: 0.0, residual_m_s: DVec3::ZERO },
        None,
        0.05,
    )
    .spec;
    spec.lines[0].segments_m = vec![20.0 / 60.0; 60];
    spec.bodies[0].position_m = DVec3::NEG_Z * 10.0;
    let model = Model::new(spec).expect("a sound model");
    let mut state = settle(&model).state;
    let mut seen = Vec::new();
    run(&model, &mut state, 2.0 * period_s, |state| {
        let phase = (state.time_s / 25.0).round();
        if state.time_s > period_s && (state.time_s - 25.0 * phase).abs() < 1e-6 {
            seen.push((state.rope.position.clone(), state.rope.tension[59]));
        }
    });
    let (mut widest, mut off, mut apart) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ((before, tension), (after, later)) in seen.iter().zip(&seen[6..]) {
        for (one, other) in before.iter().zip(after) {
            widest = widest.max(one.x);
            off = off.max((*one - DVec3::new(-other.x, other.y, other.z)).length());
        }
        apart = apart.max((tension - later).abs());
    }
    println!("swings to {widest:.2} m, mirrored to {off:.5} m and {apart:.5} N");
    assert!(seen.len() == 12 && widest > 1.5 && off < 1e-3 && apart < 0.01);
}

/// A box of one by one by half a metre that stands on a slope.
fn on_slope(slope_deg: f64, density: f64) -> Model {
    let slope = slope_deg.to_radians();
    let normal = DVec3::new(libm::sin(slope), 0.0, libm::cos(slope));
    let tilt = DQuat::from_rotation_y(slope);
    let half = DVec3::new(0.5, 0.5, 0.25);
    let corner = |index: u32| {
        half * DVec3::from_array(
            [0, 1, 2].map(|axis| if index >> axis & 1 == 0 { -1.0 } else { 1.0 }),
        )
    };
    let trap = Body {
        inertia_kg_m2: DVec3::splat(3.0),
        floats: vec![Float::level(DVec3::ZERO, 0.004, 0.5)],
        feet_m: (0..8).map(corner).collect(),
        start_friction: 0.5,
        slide_friction: 0.4,
        orientation: tilt,
        // Sunk to where four feet of 20 kN/m bear its weight.
        ..weight("trap", 20.0, DVec3::NEG_Z * 30.0 + normal * 0.243, None)
    };
    let mut spec = model(
        Water { rope_dries: true, ..water(density, 0.0) },
        Vec::new(),
        Vec::new(),
        vec![trap],
        Settings::default(),
    )
    .spec;
    spec.seabed = Some(Seabed {
        depth_m: 30.0,
        normal,
        rope_stiffness_n_m2: 5e3,
        foot_stiffness_n_m: 2e4,
        rope_friction: 0.5,
    });
    Model::new(spec).expect("a sound model")
}

/// Start friction 0.5 holds up to 26.6 deg. Beyond, without water, it slides by `½ g (sin α - 0.4 cos α) t²`.
#[test]
fn a_trap_holds_on_a_gentle_slope_and_slides_down_a_steep_one() {
    for (slope_deg, density, holds) in [
        (5.0, 1025.0, true),
        (20.0, 1025.0, true),
        (20.0, 0.0, true),
        (30.0, 0.0, false),
        (35.0, 0.0, false),
    ] {
        let model = on_slope(slope_deg, density);
        let (mut state, mut start) =
            (if holds { settle(&model).state } else { State::start(&model) }, DVec3::ZERO);
        run(&model, &mut state, 2.0, |state| {
            if start == DVec3::ZERO && state.time_s >= 1.0 {
                start = state.bodies[0].position;
            }
        });
        let moved = (state.bodies[0].position - start).length();
        let (sine, cosine) = libm::sincos(slope_deg.to_radians());
        let pull = 9.81 * (sine - 0.4 * cosine);
        let expected = if holds { 0.0 } else { 0.5 * pull * (2.0 * 2.0 - 1.0) };
        println!(
            "{slope_deg} deg: moved {moved:.4} m in the second second, expected {expected:.4} m"
        );
        assert!((moved - expected).abs() < if holds { 1e-6 } else { 0.03 * expected });
    }
}

/// The current follows a sloping bed; the solver's table and the formula agree over a level one.
#[test]
fn the_current_follows_the_bed() {
    let steep = on_slope(30.0, 1025.0);
    let mut spec = steep.spec.clone();
    spec.water.current = Current::power(DVec3::X, 1.0 / 7.0);
    let over_slope = Model::new(spec.clone()).expect("a sound model");
    // Ten metres down the slope the bed is 5.77 m deeper.
    let bed = -30.0 - 10.0 * libm::tan(30_f64.to_radians());
    let at = |z: f64| over_slope.sea.current(DVec3::new(10.0, 3.0, z), 0.0).x;
    assert!(at(bed - 0.1) == 0.0 && at(0.5 * bed) > 0.9 && (at(0.0) - 1.0).abs() < 1e-12);
    assert!((at(0.5 * bed) - libm::pow(0.5, 1.0 / 7.0)).abs() < 1e-5);
    spec.seabed = None;
    let level = Model::new(spec).expect("a sound model");
    for z in [-29.999, -25.0, -12.3, -0.01, 2.0] {
        let place = DVec3::new(4.0, 5.0, z);
        assert!((level.sea.current(place, 0.0) - level.spec.water.velocity(place)).length() < 2e-5);
    }
}

#[test]
fn water_that_cannot_be_is_refused() {
    let refused = |change: fn(&mut Water)| {
        let mut spec = moored(Tide::Steady, Some(regular(1.0, 6.0, 0.0)), 0.02).spec;
        change(&mut spec.water);
        Model::new(spec).err().map_or_else(String::new, |errors| errors[0].message.clone())
    };
    assert!(refused(|water| water.waves = Some(regular(9.0, 6.0, 0.0))).contains("break"));
    assert!(refused(|water| water.waves = Some(regular(1.0, 0.0, 0.0))).contains("period"));
    assert!(
        refused(|water| water.waves = Some(regular(f64::NAN, 6.0, 0.0))).contains("out of range")
    );
    assert!(
        refused(|water| water.current.tide = Tide::Table(vec![(1.0, DVec3::X), (0.0, DVec3::X)]))
            .contains("do not increase")
    );
    assert!(
        refused(|water| water.current.surface_m_s.x = f64::NAN).contains("not a finite number")
    );
}

/// A ball of 0.4 m and 2 kg at the end of 20 m of rope, in a current at rest or towed through still water.
fn ball(current_m_s: f64, towed_m_s: f64) -> Model {
    let radius_m = 0.2;
    let volume_m3 = 4.0 / 3.0 * PI * radius_m * radius_m * radius_m;
    let form = Form::Spheroid { across_m: radius_m, along_m: radius_m };
    let ball = Body {
        role: BodyRole::Buoy,
        added_mass_kg: DVec3::splat(0.5 * 1025.0 * volume_m3),
        drag_area_m2: DVec3::splat(0.5 * PI * radius_m * radius_m),
        turn_drag_m5: DVec3::splat(1e-3),
        floats: vec![Float { form, ..Float::level(DVec3::ZERO, volume_m3, 1.0) }],
        wetted_drag: true,
        ..weight("ball", 2.0, DVec3::new(20.0, 0.0, 0.15), None)
    };
    let velocity_m_s = DVec3::X * -towed_m_s;
    let kind = JointKind::Driven { velocity_m_s, from_s: 0.0, until_s: 1e3 };
    let boat = Joint { kind, ..fixed("boat", DVec3::new(0.0, 0.0, -0.3)) };
    let boat = if towed_m_s > 0.0 { boat } else { fixed("boat", boat.position_m) };
    let settings = Settings::default();
    let lines = vec![line("tow", 20.0, 20)];
    model(water(1025.0, current_m_s), vec![boat, on_body("ball", 0)], lines, vec![ball], settings)
}

/// Statics in a current and a tow through still water agree, and the ball is deeper the faster the water passes. Drag takes power
/// from the tow.
#[test]
fn a_towed_ball_is_drawn_down_in_statics_and_in_dynamics() {
    let mut height = settle(&ball(0.0, 0.0)).state.bodies[0].position.z;
    for speed in [0.6, 1.2, 1.6] {
        let model = ball(speed, 0.0);
        let settled = settle(&model);
        assert!(settled.converged, "{speed} m/s");
        let (mut state, rest) = (settled.state.clone(), settled.state);
        run(&model, &mut state, 2.0, |_| ());
        let moved = (state.bodies[0].position - rest.bodies[0].position).length();
        assert!(moved < 1e-4, "{speed} m/s: {moved} m off its rest");
        assert!(rest.bodies[0].position.z < height - 1e-3, "{speed} m/s");
        height = rest.bodies[0].position.z;

        let towed = ball(0.0, speed);
        let mut state = State::start(&towed);
        run(&towed, &mut state, 40.0, |_| ());
        let (deep, pull) = (state.bodies[0].position.z - height, state.rope.tension[0]);
        println!("{speed} m/s: {height:.4} m, {deep:.1e} m deeper under tow, {pull:.2} N");
        assert!(deep.abs() < 2e-3 && (pull / rest.rope.tension[0] - 1.0).abs() < 0.02);
        assert!(rest.rope.tension[0] > 0.0);
    }
}

const SPHERE: Form = Form::Spheroid { across_m: 0.2, along_m: 0.2 };
const EGG: Form = Form::Spheroid { across_m: 0.16, along_m: 0.29 };
const STAFF: Form = Form::Cylinder { radius_m: 0.02, length_m: 3.4 };
const DRUM: Form = Form::Cylinder { radius_m: 0.15, length_m: 0.4 };

/// The axis of a float that heels by 0.4 rad.
fn heeled() -> DVec3 {
    DQuat::from_rotation_x(0.4) * DVec3::Z
}

/// Height of a heeled float's highest point above its centre [m].
fn reach(form: Form) -> f64 {
    let (upright, level) = (libm::cos(0.4), libm::sin(0.4));
    match form {
        Form::Spheroid { across_m, along_m } => libm::hypot(along_m * upright, across_m * level),
        Form::Cylinder { radius_m, length_m } => 0.5 * length_m * upright + radius_m * level,
        Form::Level { height_m } => 0.5 * height_m,
    }
}

/// Water-plane of a form at a height.
fn plane(form: Form, height: f64) -> WaterPlane {
    let float = Float { form, ..Float::level(DVec3::ZERO, 0.03, 1.0) };
    let mut plane = WaterPlane::default();
    plane.add(&float, &form.wet(height, heeled()));
    plane
}

fn passing(form: Form, height: f64, speed: f64) -> Passing {
    plane(form, height).in_flow(speed * speed, 1025.0, 9.81)
}

#[test]
fn water_that_rests_or_passes_off_the_surface_adds_nothing() {
    for form in [SPHERE, EGG, STAFF, DRUM] {
        let reach = reach(form);
        assert_eq!(passing(form, 0.1 * reach, 0.0), Passing::default());
        for beyond in [-1.0, -1.001, -30.0, 1.0, 1.001, 30.0] {
            assert_eq!(passing(form, beyond * reach, 1.5), Passing::default(), "{form:?}");
        }
    }
}

/// `11/16 · ½ρ U² π R²` in potential flow under a still surface.
#[test]
fn half_of_a_sphere_is_drawn_down_as_in_potential_flow() {
    let volume = 4.0 / 3.0 * PI * 0.2 * 0.2 * 0.2;
    let float = Float { form: SPHERE, ..Float::level(DVec3::ZERO, volume, 1.0) };
    let mut plane = WaterPlane::default();
    plane.add(&float, &SPHERE.wet(0.0, DVec3::Z));
    assert!((plane.area_m2 / (PI * 0.04) - 1.0).abs() < 1e-12);
    let (speed, dry) = (0.1, 1.0 - 1.0 / 256.0);
    let force = plane.in_flow(speed * speed, 1025.0, 9.81).pull_pa * plane.area_m2;
    let expected = 11.0 / 16.0 * 0.5 * 1025.0 * speed * speed * PI * 0.04 * dry;
    assert!((force / expected - 1.0).abs() < 1e-4, "{force} for {expected}");
}

/// Suction on half of a spheroid of axis ratio `r` that moves across its axis: the velocity on its skin is `(1 + k)` times
/// the tangential part of the flow.
#[test]
fn suction_is_that_of_spheroids_in_potential_flow() {
    let sum = |f: &dyn Fn(f64) -> f64| {
        (0..4000).map(|i| f((f64::from(i) + 0.5) / 4000.0) / 4000.0).sum::<f64>()
    };
    for ratio in [0.03_f64, 0.1, 0.3, 0.6, 1.0, 1.5, 2.0] {
        // Lamb's integral over `λ = t²/(1 - t²)`.
        let alpha = sum(&|t| {
            let (left, scale) = (1.0 - t * t, 2.0 * t / ((1.0 - t * t) * (1.0 - t * t)));
            ratio * left * left * scale / (ratio * ratio + t * t / left).sqrt()
        });
        let added = alpha / (2.0 - alpha);
        let normal = sum(&|p| p * p * p / (p * p + (1.0 - p * p) / (ratio * ratio)));
        let exact = (1.0 + added) * (1.0 + added) * (1.0 - normal) - 1.0;
        let whole = 4.0 / 3.0 * PI * ratio;
        let plane =
            WaterPlane { area_m2: PI, wet_m3: 0.5 * whole, whole_m3: whole, widening_m: 0.0 };
        let slow = 0.01;
        let pressure = 0.5 * 1025.0 * slow * slow * (1.0 - 1.0 / 256.0);
        let suction = plane.in_flow(slow * slow, 1025.0, 9.81).pull_pa / pressure;
        println!("{ratio}: {suction:.4} for {exact:.4}");
        assert!((suction / exact - 1.0).abs() < 0.03, "{ratio}: {suction} for {exact}");
    }
}

/// The matrix has the derivatives of the forces, within the bounds that keep it definite.
#[test]
fn slopes_of_the_forces_are_their_derivatives() {
    for form in [SPHERE, EGG, STAFF, DRUM] {
        let reach = reach(form);
        for part in [-0.9, -0.5, -0.1, 0.2, 0.6, 0.9] {
            let (height, d) = (part * reach, 1e-6 * reach);
            for speed in [0.3, 0.8, 1.5, 2.5] {
                let force = |height: f64, speed: f64| {
                    plane(form, height).area_m2 * passing(form, height, speed).pull_pa
                };
                let growth = (force(height - d, speed) - force(height + d, speed)) / (2.0 * d);
                let plane = plane(form, height);
                let bounds = [-1.0, 0.75].map(|share| share * 1025.0 * 9.81 * plane.area_m2);
                let growth = growth.clamp(bounds[0], bounds[1]);
                let now = passing(form, height, speed);
                let softening = now.softening_pa_m * plane.area_m2;
                assert!(
                    (softening - growth).abs() < 1e-4 * bounds[1],
                    "{form:?} {part} {speed}: {softening} for {growth}"
                );
                let waves = |factor: f64| passing(form, height, speed * factor).waves;
                let growth = (waves(1.0 + 1e-6) - waves(1.0 - 1e-6)) / 2e-6;
                assert!((now.waves_growth - growth).abs() < 1e-6, "{form:?} {part} {speed}");
            }
        }
    }
}

/// Both forces are those of drag and suction, never of thrust and lift, and have no steps in speed and draught.
#[test]
fn the_forces_are_smooth_and_never_negative() {
    for form in [SPHERE, EGG, STAFF, DRUM] {
        let reach = reach(form);
        let at = |row: i32, column: i32| {
            let (height, speed) = (f64::from(row - 5010) / 5000.0 * reach, f64::from(column) * 0.4);
            let now = passing(form, height, speed);
            let facing = form.wet(height, heeled()).facing;
            [now.pull_pa * plane(form, height).area_m2, now.waves * facing]
        };
        for column in 0..10 {
            let mut before = at(0, column);
            // Bounds of the force and of the wave drag over that of the whole float.
            let scale = [60.0 + 80.0 * f64::from(column * column), 0.4];
            for row in 1..10021 {
                let now = at(row, column);
                for (k, scale) in scale.iter().enumerate() {
                    let step = (now[k] - before[k]).abs();
                    assert!(now[k] >= 0.0 && now[k].is_finite(), "{form:?} {row} {column}");
                    assert!(step < 0.03 * scale, "{form:?} {row} {column}: {step} of {scale}");
                }
                before = now;
            }
        }
    }
}
