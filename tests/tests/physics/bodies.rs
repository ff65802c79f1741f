//! Traps, buoys and bridles of the library at work, against hand calculations.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, root};
use endline_gear::{Library, Options, Scenario, Sources, assemble, buoy_floats};

use endline_sim::model::Shape;
use endline_sim::{DQuat, DVec3, Input, Model, ModelSpec, State, Workspace, settle, step};

use std::f64::consts::PI;

const DENSITY: f64 = 1025.0;
const GRAVITY: f64 = 9.81;

/// A scenario in 15 m of still water with one body of the library placed at a share of the depth, and further text.
fn spec(kind: &str, item: &str, height: f64, further: &str) -> ModelSpec {
    let assembly = format!(
        "format = 1\nkind = \"assembly\"\nname = \"One\"\n[[body]]\nid = \"it\"\nkind = \"{kind}\"\nitem = \"{item}\"\nheight = {height}\n"
    );
    let mut sources = Sources::from_folder(&root()).unwrap();
    sources.set("assemblies/one.toml", assembly);
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    let text = format!(
        "format = 1\nkind = \"scenario\"\nname = \"Bodies\"\nduration = \"60 s\"\nsegment = \"0.25 m\"\n[site]\nitem = \"cape-cod-bay\"\n\
         depth = \"15 m\"\n[current]\nspeed = \"0 m/s\"\n[[gear]]\nassembly = \"one\"\n{further}"
    );
    let scenario = Scenario::read("bodies.toml", &text)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    assemble(&scenario, &library, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)))
}

/// Steps until a time, looking at the state after each step.
fn run(model: &Model, state: &mut State, until_s: f64, mut look: impl FnMut(&State)) {
    let mut workspace = Workspace::new(model);
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        look(state);
    }
}

fn upright(state: &State) -> f64 {
    (state.bodies[0].orientation * DVec3::Z).z
}

/// A trap let go aslant falls flat at `√(2W/ρ C_d A)`, lands and stays on its runners.
#[test]
fn a_dropped_trap_falls_flat_and_lands_on_its_runners() {
    let library = library();
    let trap = library.traps.iter().find(|trap| trap.entry.id == "wire-lobster-3ft").unwrap();
    let mut spec = spec("trap", "wire-lobster-3ft", 0.9, "");
    spec.bodies[0].orientation = DQuat::from_rotation_x(0.4) * DQuat::from_rotation_y(0.3);
    let area = 2.0 * trap.drag_coefficient * trap.solidity[2] * trap.size_m[0] * trap.size_m[1];
    let terminal = (2.0 * trap.wet_weight_n / (DENSITY * area)).sqrt();
    let model = Model::new(spec).unwrap();
    let mut state = State::start(&model);
    run(&model, &mut state, 12.0, |_| ());
    let (speed, flat) = (-state.bodies[0].velocity.z, upright(&state));
    println!("falls at {speed:.4} m/s for {terminal:.4}, axis {flat:.5} upright");
    assert!((speed / terminal - 1.0).abs() < 0.01 && flat > 0.999);
    run(&model, &mut state, 40.0, |_| ());
    let lowest = model.spec.bodies[0]
        .feet_m
        .iter()
        .map(|foot| (state.bodies[0].position + state.bodies[0].orientation * *foot).z);
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    assert!((lowest + 15.0).abs() < 0.02 && upright(&state) > 0.9999, "{lowest} m");
    assert!(state.bodies[0].velocity.length() < 1e-4 && state.bodies[0].spin.length() < 1e-4);
}

/// Drawn up slowly, a trap that has rested holds with its wet weight and its break-out force, then with its wet weight.
#[test]
fn a_trap_breaks_out_of_the_seabed_once() {
    let further = "[[fixture]]\nid = \"hook\"\nposition = [\"0 m\", \"0 m\", \"-10 m\"]\nvelocity = [\"0 m/s\", \"0 m/s\", \"0.03 m/s\"]\n\
        [[line]]\nid = \"warp\"\nrope = \"sink-3-8\"\nfrom = \"it:top\"\nto = \"hook\"\nlength = \"4.7 m\"\n";
    let model = Model::new(spec("trap", "wire-lobster-3ft", 0.0, further)).unwrap();
    let settled = settle(&model);
    assert!(settled.converged);
    let mut state = settled.state;
    let (mut peak, mut late, mut count) = (0.0_f64, 0.0, 0.0);
    run(&model, &mut state, 30.0, |state| {
        peak = peak.max(state.rope.tension[0]);
        if state.time_s > 20.0 {
            late += state.rope.tension[0];
            count += 1.0;
        }
    });
    println!("breaks out at {peak:.1} N for 130 + 91, hangs at {:.1} N", late / count);
    assert!((peak / (130.0 + 91.0) - 1.0).abs() < 0.05);
    assert!((late / count / 130.0 - 1.0).abs() < 0.02);
}

/// Two legs from the middles of the end edges to one point: each bears `W / 2 cos a`.
#[test]
fn a_bridles_legs_share_the_weight() {
    let further = "[[fixture]]\nid = \"ring\"\nposition = [\"0 m\", \"0 m\", \"-5 m\"]\n\
        [[line]]\nid = \"one\"\nrope = \"sink-3-8\"\nfrom = \"it:end\"\nto = \"ring\"\nlength = \"1 m\"\n\
        [[line]]\nid = \"other\"\nrope = \"sink-3-8\"\nfrom = \"it:far-end\"\nto = \"ring\"\nlength = \"1 m\"\n";
    let model = Model::new(spec("trap", "wire-lobster-3ft", 0.55, further)).unwrap();
    let settled = settle(&model);
    assert!(settled.converged, "{} N", settled.residual_n);
    let half: f64 = 0.5 * 36.0 * 0.0254;
    let tension = |line: usize| settled.state.rope.tension[model.line_segments[line].start];
    // The legs stretch by a share of a percent under this load.
    let expected = 130.0 / (2.0 * (1.0 - half * half).sqrt());
    println!("legs {:.2} and {:.2} N for {expected:.2}", tension(0), tension(1));
    assert!((tension(0) / expected - 1.0).abs() < 0.015 && (tension(0) - tension(1)).abs() < 0.01);
}

/// Draft of a ball against the root of `π d² (3R - d)/3 = m/ρ`.
#[test]
fn a_ball_floats_at_the_root_of_its_cubic() {
    let library = library();
    let ball = library.buoys.iter().find(|buoy| buoy.entry.id == "polyball-a3").unwrap();
    let model = Model::new(spec("buoy", "polyball-a3", 1.0, "")).unwrap();
    let settled = settle(&model);
    assert!(settled.converged);
    let radius = ball.diameter_m / 2.0;
    let own = ball.volume_m3 / (4.0 / 3.0 * PI * radius * radius * radius);
    let (mut low, mut high) = (0.0_f64, 2.0 * radius);
    for _ in 0..60 {
        let draft: f64 = 0.5 * (low + high);
        let displaced = own * PI * draft * draft * (3.0 * radius - draft) / 3.0;
        if displaced * DENSITY < ball.mass_kg { low = draft } else { high = draft }
    }
    let draft = radius - settled.state.bodies[0].position.z;
    assert!((draft - low).abs() < 1e-5, "{draft} for {low}");
}

/// A bullet's slices against the capsule cut into thin strips: within 1 % of its diameter in draft, upright and lying.
#[test]
fn a_bullets_draft_is_that_of_its_capsule() {
    let library = library();
    let buoy = library.buoys.iter().find(|buoy| buoy.entry.id == "bullet-6x14").unwrap();
    let (radius, half) = (buoy.diameter_m / 2.0, buoy.length_m / 2.0);
    let strips = 4000_u32;
    let thick = 2.0 * half / f64::from(strips);
    // Radius of the capsule at a place along it.
    let outline = |x: f64| -> f64 {
        let over = (x.abs() - (half - radius)).max(0.0_f64);
        (radius * radius - over * over).max(0.0).sqrt()
    };
    let along = |strip: u32| -half + (f64::from(strip) + 0.5) * thick;
    let whole: f64 =
        (0..strips).map(|strip| PI * outline(along(strip)) * outline(along(strip)) * thick).sum();
    // Area of a circle below a height above its middle.
    let segment = |r: f64, z: f64| -> f64 {
        let q: f64 = (z / r.max(1e-12)).clamp(-1.0, 1.0);
        r * r * (q * (1.0 - q * q).sqrt() + q.asin() + PI / 2.0)
    };
    for (axis, reach) in [(DVec3::Z, half), (DVec3::X, radius)] {
        let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
        for part in [-0.8, -0.3, 0.2, 0.7] {
            let level = part * reach;
            let wet = |strip: u32, level: f64| match axis.z > 0.5 {
                true if along(strip) < level => PI * outline(along(strip)) * outline(along(strip)),
                true => 0.0,
                false => segment(outline(along(strip)), level),
            };
            let volume = |level: f64| {
                (0..strips).map(|strip| wet(strip, level) * thick).sum::<f64>() / whole
            };
            let slices: f64 = buoy_floats(buoy)
                .iter()
                .map(|f| f.volume_m3 * f.form.wet((turn * f.offset_m).z - level, axis).share)
                .sum();
            let (share, d) = (slices / buoy.volume_m3, 1e-3 * reach);
            let by_draft = (volume(level + d) - volume(level - d)) / (2.0 * d);
            let off = (share - volume(level)) / by_draft;
            assert!(off.abs() < 0.01 * buoy.diameter_m, "{axis} {part}: {:.2} mm", 1e3 * off);
        }
    }
}

/// Float, staff, counterweight and reflector, each at its height over the common centre of mass: by hand, with masses of 1.8, 2.9, 7 and 0.8 kg
/// at 0, 0.1, -1.62 and 1.7 m.
#[test]
fn a_high_flyer_has_four_parts_at_their_heights() {
    let body = &spec("buoy", "high-flyer", 1.0, "").bodies[0];
    let middle = -(2.9 * 0.1 - 7.0 * 1.62 + 0.8 * 1.7) / 12.5;
    let wanted = [(0.15, 0.2, 0.0), (0.01905, 1.8, 0.1), (0.05, 0.075, -1.62), (0.11, 0.125, 1.7)];
    assert_eq!(body.parts.len(), wanted.len());
    for (part, (radius, half, height)) in body.parts.iter().zip(wanted) {
        let Shape::Cylinder { radius_m, half_length_m } = part.shape else {
            panic!("{part:?} has no flat ends")
        };
        assert!((radius_m - radius).abs() < 1e-9 && (half_length_m - half).abs() < 1e-9);
        assert!((part.middle_m - DVec3::Z * (middle + height)).length() < 1e-9, "{part:?}");
    }
}

/// A high-flyer pitches in still water with the period its metacentric height gives.
#[test]
fn a_high_flyer_pitches_by_its_metacentric_height() {
    let library = library();
    let flyer = library.buoys.iter().find(|buoy| buoy.entry.id == "high-flyer").unwrap();
    let mut spec = spec("buoy", "high-flyer", 1.0, "");
    spec.settings.step_s = 0.005;
    let body = &mut spec.bodies[0];
    body.turn_drag_m5 = DVec3::ZERO;
    body.floats.iter_mut().for_each(|float| float.drag_area_m2 = DVec3::ZERO);
    let body = body.clone();
    let model = Model::new(spec).unwrap();
    let settled = settle(&model);
    assert!(settled.converged && upright(&settled.state) > 0.999_999);
    // By hand, heights above the middle of the float: waterline, wet volumes and their middles.
    let water = -(settled.state.bodies[0].position
        + settled.state.bodies[0].orientation * body.middle_m())
    .z;
    let mut parts = vec![(0.0, flyer.length_m, flyer.volume_m3, flyer.diameter_m)];
    parts.extend(
        flyer
            .pieces
            .iter()
            .map(|piece| (piece.at_m, piece.length_m, piece.volume_m3, piece.diameter_m)),
    );
    let (mut volume, mut moment, mut plane) = (0.0, 0.0, 0.0);
    for (at, length, whole, diameter) in parts {
        let (low, high) =
            (at - length / 2.0, (at + length / 2.0).min(water).max(at - length / 2.0));
        volume += whole * (high - low) / length;
        moment += whole * (high - low) / length * 0.5 * (low + high);
        if high > low && high < at + length / 2.0 {
            plane += whole / length * diameter * diameter / 16.0;
        }
    }
    assert!((volume * DENSITY / flyer.whole_mass_kg() - 1.0).abs() < 1e-6);
    let height = (moment + plane) / volume + body.middle_m().z;
    let all: f64 = body.floats.iter().map(|float| float.volume_m3).sum();
    let inertia = body.inertia_kg_m2.x + body.added_inertia_kg_m2.x * volume / all;
    let period = 2.0 * PI * (inertia / (flyer.whole_mass_kg() * GRAVITY * height)).sqrt();
    let mut state = settled.state;
    state.bodies[0].orientation = DQuat::from_rotation_x(0.03) * state.bodies[0].orientation;
    let (mut crossings, mut before) = (Vec::new(), 1.0);
    run(&model, &mut state, 4.2 * period, |state| {
        let tilt = -(state.bodies[0].orientation * DVec3::Z).y;
        if tilt * before < 0.0 {
            crossings.push(state.time_s);
        }
        before = tilt;
    });
    let measured =
        2.0 * (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    println!("metacentric height {height:.3} m, period {measured:.3} s for {period:.3} s");
    assert!(height > 0.3 && (measured / period - 1.0).abs() < 0.02);
}

/// Laid over, a high-flyer comes back; towed by its foot it leans and comes back when let be.
#[test]
fn a_high_flyer_stands_up_again() {
    let model = Model::new(spec("buoy", "high-flyer", 1.0, "")).unwrap();
    let mut state = settle(&model).state;
    state.bodies[0].orientation = DQuat::from_rotation_x(1.2) * state.bodies[0].orientation;
    run(&model, &mut state, 60.0, |_| ());
    assert!(upright(&state) > 0.999, "{}", upright(&state));
    let further = "[[fixture]]\nid = \"boat\"\nposition = [\"20 m\", \"0 m\", \"-1.5 m\"]\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\n\
        from = \"0 s\"\nuntil = \"30 s\"\n[[line]]\nid = \"tow\"\nrope = \"sink-3-8\"\nfrom = \"it\"\nto = \"boat\"\nlength = \"20 m\"\n";
    let model = Model::new(spec("buoy", "high-flyer", 1.0, further)).unwrap();
    let mut state = settle(&model).state;
    run(&model, &mut state, 30.0, |_| ());
    let (lean, place) = (upright(&state).min(1.0).acos().to_degrees(), state.bodies[0].position);
    run(&model, &mut state, 90.0, |_| ());
    println!(
        "towed at 1 m/s it leans {lean:.1} deg, left alone {:.2} deg",
        upright(&state).min(1.0).acos().to_degrees()
    );
    assert!(place.x > 20.0 && (3.0..60.0).contains(&lean), "{place}");
    assert!(upright(&state) > 0.99);
}

/// Rope drawn taut over a trap in steps of 4 ms, which then become steps of 0.25 ms: its tension stays.
///
/// Contact on a body is softer the longer the step, so that the rope lies deeper in the trap than it would in short steps.
#[test]
fn rope_on_a_trap_bears_the_same_when_steps_become_shorter() {
    let end = |id: &str, y: f64| {
        format!(
            "[[fixture]]\nid = \"{id}\"\nposition = [\"0 m\", \"{y} m\", \"-14.3 m\"]\nvelocity = [\"0 m/s\", \"0 m/s\", \"-0.05 m/s\"]\n"
        )
    };
    let further = format!(
        "{}{}[[line]]\nid = \"warp\"\nrope = \"sink-3-8\"\nfrom = \"left\"\nto = \"right\"\nlength = \"2.1 m\"\n[[segments]]\nline = \"warp\"\nlongest = \"5 cm\"\n",
        end("left", -1.0),
        end("right", 1.0),
    );
    let with_step = |step_s: f64| {
        let mut spec = spec("trap", "wire-lobster-3ft", 0.02, &further);
        spec.settings.step_s = step_s;
        spec.settings.auto_step = false;
        Model::new(spec).unwrap()
    };
    let greatest = |state: &State| state.rope.tension.iter().copied().fold(0.0, f64::max);
    let (long, short) = (with_step(4e-3), with_step(2.5e-4));
    let mut state = State::start(&long);
    let mut workspace = Workspace::new(&long);
    while greatest(&state) < 600.0 {
        assert!(state.time_s < 20.0, "taut at {} N", greatest(&state));
        step(&long, &Input::default(), &mut state, &mut workspace).unwrap();
    }
    let (before, grips) = (greatest(&state), state.rope.solid_grips.len());
    let peaks = [(&long, 4e-3), (&short, 2.5e-4)].map(|(model, step_s)| {
        let (mut state, mut peak) = (state.clone(), 0.0_f64);
        state.step = (state.time_s / step_s).round() as u64;
        let until_s = state.time_s + 0.02;
        run(model, &mut state, until_s, |state| peak = peak.max(greatest(state)));
        peak
    });
    println!("{before:.0} N at {grips} contact points, then at most {peaks:.0?} N");
    assert!(grips > 0 && peaks[1] < 1.05 * peaks[0], "{before} N, then {peaks:?} N");
}
