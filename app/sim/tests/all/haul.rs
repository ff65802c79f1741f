//! Gear hauled over a block: load at rest, drag at speed, convergence, energy, and what goes aboard when.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::f64::consts::PI;

use endline_sim::haul::{Haul, HaulEvent, Hauling, endlines};
use endline_sim::model::{Body, BodyRole, Line, Rope, Seabed, Settings};
use endline_sim::water::waves::{WaveKind, Waves};
use endline_sim::water::{Current, Water};
use endline_sim::{DVec3, Model, State};

use endline_fixtures::gear::{line, model, on_body, rope, water, weight};

const G: f64 = 9.81;
const DENSITY: f64 = 1025.0;
const TRAP_KG: f64 = 12.0;
const DRAG_AREA: f64 = 0.4;

/// The hauler of these tests: over a block at the height of the buoy, from a boat that stays where it is.
fn hauling(speed_m_s: f64) -> Hauling {
    Hauling {
        speed_m_s,
        start_s: 1.0,
        block_m: 0.0,
        heave: 1.0,
        lead_rad: None,
        drift_m_s: DVec3::ZERO,
    }
}

fn sinking() -> Rope {
    Rope { displaced_m3_m: 4e-5, ..rope() }
}

fn rope_weight_n_m() -> f64 {
    (sinking().mass_kg_m - DENSITY * sinking().displaced_m3_m) * G
}

fn buoy() -> Body {
    Body { role: BodyRole::Buoy, ..weight("buoy", 1.0, DVec3::ZERO, None) }
}

/// A trap that is all weight and drag: what it weighs in air it weighs in water.
fn trap(id: &str, place: DVec3) -> Body {
    let drag_area_m2 = DVec3::splat(DRAG_AREA);
    Body { role: BodyRole::Trap, drag_area_m2, ..weight(id, TRAP_KG, place, None) }
}

/// A buoy, a straight line and a trap at its lower end in still water without a bed.
fn single(depth_m: f64, segments: usize, step_s: f64) -> Model {
    let bodies = vec![buoy(), trap("trap", DVec3::NEG_Z * depth_m)];
    let joints = vec![on_body("a", 0), on_body("b", 1)];
    let lines = vec![line("endline", depth_m, segments)];
    let settings = Settings { step_s, ..Settings::default() };
    let mut spec = model(water(DENSITY, 0.0), joints, lines, bodies, settings).spec;
    spec.ropes = vec![sinking()];
    Model::new(spec).expect("a sound model")
}

fn begin(model: &Model, how: Hauling) -> Haul {
    let from = endlines(model);
    Haul::begin(model, &State::start(model), from[0], how).expect("gear to haul")
}

/// Hauls until something says stop; answers loads by rope hauled.
fn haul_until(haul: &mut Haul, mut stop: impl FnMut(&Haul) -> bool) {
    while haul.advance().unwrap_or_else(|stop| panic!("{stop:?}")) {
        if stop(haul) {
            return;
        }
    }
}

/// Mean load between two lengths of rope hauled [N].
fn mean_load(model: &Model, how: Hauling, between_m: [f64; 2]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    let mut haul = begin(model, how);
    haul_until(&mut haul, |haul| {
        if (between_m[0]..between_m[1]).contains(&haul.hauled_m()) {
            sum += haul.last_step().load_n;
            count += 1.0;
        }
        haul.hauled_m() > between_m[1]
    });
    sum / count
}

/// Load at the block with `left_m` of rope out that goes up at a speed: the half segment at the block counts for none.
fn by_hand(left_m: f64, speed: f64) -> f64 {
    let rope = sinking();
    let along = 0.5 * DENSITY * rope.drag_tangential * PI * rope.diameter_m * speed * speed;
    let body = 0.5 * DENSITY * DRAG_AREA * speed * speed;
    TRAP_KG * G + body + (rope_weight_n_m() + along) * left_m
}

#[test]
fn a_slow_haul_bears_the_wet_weight_of_the_rope_out_and_of_the_trap() {
    let slow = 0.05;
    let load = mean_load(&single(10.0, 40, 0.02), hauling(slow), [2.0, 3.0]);
    let wanted = by_hand(7.5 - 0.0625, slow);
    assert!((load / wanted - 1.0).abs() < 1e-3, "{load} N against {wanted} N");
}

#[test]
fn a_trap_lifted_at_a_steady_speed_adds_its_drag_and_that_along_the_rope() {
    for speed in [0.6, 1.2, 1.8] {
        let load = mean_load(&single(40.0, 80, 0.01), hauling(speed), [15.0, 20.0]);
        let wanted = by_hand(22.5 - 0.125, speed);
        assert!((load / wanted - 1.0).abs() < 3e-3, "{speed} m/s: {load} N against {wanted} N");
    }
}

/// The greatest load of a haul from a rising boat, at a step and number of segments [N].
fn peak(segments: usize, step_s: f64) -> f64 {
    let mut spec = single(20.0, segments, step_s).spec;
    let kind = WaveKind::Regular { height_m: 1.0, period_s: 5.0, phase_rad: 0.0 };
    spec.water.waves = Some(Waves { toward: DVec3::X, ramp_s: 1.0, kind });
    let model = Model::new(spec).expect("a sound model");
    let mut peak = 0.0_f64;
    let mut haul = begin(&model, hauling(0.5));
    haul_until(&mut haul, |haul| {
        if haul.hauled_m() > 2.0 {
            peak = peak.max(haul.last_step().load_n);
        }
        haul.hauled_m() > 12.0
    });
    peak
}

#[test]
fn the_greatest_load_in_waves_converges_in_step_and_segment() {
    let peaks = [peak(10, 0.02), peak(20, 0.01), peak(40, 0.005), peak(80, 0.0025)];
    println!("{peaks:?}");
    let [coarse, usual, fine, finest] = peaks;
    assert!((usual / finest - 1.0).abs() < 0.01, "{peaks:?}");
    assert!((fine - finest).abs() < (coarse - finest).abs(), "{peaks:?}");
    // It is more than weight and drag: the boat heaves by 0.5 m at 1.26 rad/s.
    assert!(finest > 1.05 * by_hand(18.0, 0.5), "{peaks:?}");
}

/// The hauler's work is the rise of rope and trap, their drag and their motion.
#[test]
fn the_work_of_the_hauler_is_potential_energy_drag_and_motion() {
    let (speed, depth) = (1.0, 30.0);
    let mut haul = begin(&single(depth, 60, 0.005), hauling(speed));
    let (mut work, mut drag) = (0.0, 0.0);
    let rope = sinking();
    let of_rope = 0.5 * DENSITY * rope.drag_tangential * PI * rope.diameter_m;
    haul_until(&mut haul, |haul| {
        let at = haul.state();
        let trap = at.bodies[0].velocity.length();
        let length: f64 = at.rope.segment_length.iter().sum();
        let up = at.rope.velocity.iter().map(|velocity| velocity.length()).sum::<f64>()
            / at.rope.velocity.len() as f64;
        work += haul.last_step().work_j;
        drag += (0.5 * DENSITY * DRAG_AREA * trap * trap * trap + of_rope * length * up * up * up)
            * 0.005;
        haul.hauled_m() > 20.0
    });
    let (hauled, w) = (haul.hauled_m(), rope_weight_n_m());
    // Rope that is aboard rose by the mean of what it came from; what is out rose by all that was hauled.
    let rise = TRAP_KG * G * hauled + w * (depth - hauled) * hauled + 0.5 * w * hauled * hauled;
    let motion = 0.5 * (TRAP_KG + rope.mass_kg_m * depth) * speed * speed;
    let wanted = rise + drag + motion;
    println!("work {work:.1} J, rise {rise:.1} J, drag {drag:.1} J, motion {motion:.1} J");
    assert!((work / wanted - 1.0).abs() < 0.01, "{work} J against {wanted} J");
}

fn seabed(depth_m: f64) -> Seabed {
    Seabed {
        depth_m,
        normal: DVec3::Z,
        foot_stiffness_n_m: 2e4,
        rope_stiffness_n_m2: 5e3,
        rope_friction: 0.5,
    }
}

/// A trawl of traps on a groundline, without gangions: what comes aboard comes in order, and more and more hangs.
#[test]
fn traps_leave_the_seabed_and_come_aboard_one_after_the_other() {
    let (depth, spacing, traps) = (20.0, 30.0, 3);
    let foot = |id: &str, x: f64| Body {
        feet_m: vec![DVec3::ZERO],
        foot_radius_m: vec![0.1],
        foot_break_out_n: 80.0,
        start_friction: 0.7,
        slide_friction: 0.5,
        ..trap(id, DVec3::new(x, 0.0, -depth + 0.095))
    };
    let mut bodies = vec![buoy()];
    bodies.extend((0..traps).map(|index| foot(&format!("trap-{index}"), -spacing * index as f64)));
    let joints = (0..=traps).map(|index| on_body(&format!("j{index}"), index)).collect();
    let mut lines = vec![line("endline", 1.02 * depth, 20)];
    lines.extend((1..traps).map(|index| Line {
        from: index,
        to: index + 1,
        ..line(&format!("groundline-{index}"), 1.01 * spacing, 30)
    }));
    let settings = Settings { step_s: 0.02, ..Settings::default() };
    let mut spec = model(water(DENSITY, 0.0), joints, lines, bodies, settings).spec;
    spec.water = Water { depth_m: depth, current: Current::uniform(DVec3::X * 0.1), ..spec.water };
    (spec.ropes, spec.seabed) = (vec![sinking()], Some(seabed(depth)));
    let model = Model::new(spec).expect("a sound model");
    let mut state = State::start(&model);
    for body in &mut state.bodies {
        body.lift_m.fill(0.0);
    }
    let how = Hauling { lead_rad: Some(0.3), block_m: 2.0, ..hauling(1.0) };
    let mut haul = Haul::begin(&model, &state, endlines(&model)[0], how).expect("gear to haul");
    let (mut came, mut greatest) = (Vec::new(), 0.0_f64);
    haul_until(&mut haul, |haul| {
        came.extend(
            haul.last_step()
                .events
                .iter()
                .copied()
                .filter(|came| !matches!(came, HaulEvent::Line(_))),
        );
        greatest = greatest.max(haul.last_step().load_n);
        haul.state().time_s > 200.0
    });
    came.extend(
        haul.last_step().events.iter().copied().filter(|came| !matches!(came, HaulEvent::Line(_))),
    );
    println!("{came:?}, {greatest:.0} N after {:.1} s", haul.state().time_s);
    let aboard: Vec<_> = came.iter().filter(|came| matches!(came, HaulEvent::Aboard(_))).collect();
    assert_eq!(aboard, [&HaulEvent::Aboard(1), &HaulEvent::Aboard(2), &HaulEvent::Aboard(3)]);
    for body in 1..=traps {
        let at = |wanted: HaulEvent| came.iter().position(|one| *one == wanted);
        assert!(at(HaulEvent::OffSeabed(body)) < at(HaulEvent::Aboard(body)), "{came:?}");
        assert!(at(HaulEvent::OffSeabed(body)).is_some(), "{came:?}");
    }
    assert!(haul.model().spec.bodies.is_empty() && haul.model().spec.lines.is_empty());
    // A trap that hangs, its drag and its break-out at the least, two that hang and their drag at the most.
    let one = by_hand(0.0, 1.0);
    assert!(greatest > one && greatest < 3.0 * one, "{greatest} N, of one trap {one} N");
}
