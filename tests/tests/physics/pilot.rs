//! The pilot program: each trigger at its place and time by hand, holds and ramps, and what is wrong in a file.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use crate::linked::{Linked, library, report, root};
use endline_fixtures::hooks::{Motion, descriptor};
use endline_gear::{Hooks, Options, Scenario, assemble};
use endline_sdk::{Act, Controls, Descriptor, FrictionModel, GearType, MotionOutput, WhaleMotion};
use endline_sim::model::Trigger;
use endline_sim::{Input, Model, State, Workspace, settle, step};

/// Speed of the plain motion at full control [m/s], and its turn rates [rad/s].
const SPEED_M_S: f64 = 2.0;
const TURN_RAD_S: f64 = 0.1;
/// The whale starts here, heading east towards a rope at x = 20 [m].
const DEPTH_M: f64 = 12.0;
const LENGTH_M: f64 = 10.0;
const ROPE_M: f64 = 20.0;
const STEP_S: f64 = 0.01;

/// Returns a motion that follows the controls without delay; it declares two acts and performs neither.
fn plain() -> Arc<dyn WhaleMotion> {
    let acts = vec![Act::new("wiggle", "Wiggle", ""), Act::new("spin", "Spin", "")];
    let descriptor = Descriptor { acts, ..descriptor("org.example.plain") };
    Motion::new(descriptor, |input| {
        let Controls { speed, pitch, yaw, .. } = input.controls;
        let turn_rate_rad_s = [0.0, -TURN_RAD_S * pitch, TURN_RAD_S * yaw];
        MotionOutput { speed_m_s: SPEED_M_S * speed, turn_rate_rad_s, ..MotionOutput::default() }
    })
}

struct WithPlain;

impl Hooks for WithPlain {
    fn motion(&self, _: &str) -> Option<Arc<dyn WhaleMotion>> {
        Some(plain())
    }
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        Linked.friction(id)
    }
    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        Linked.gear(id)
    }
    fn ids(&self) -> Vec<String> {
        Linked.ids()
    }
}

/// A taut rope from top to bottom at x = 20 m, and a whale that swims east at it; then these entries.
fn text(pilot: &str) -> String {
    format!(
        r#"format = 1
kind = "scenario"
name = "A rope to swim into"
duration = "60 s"
rope_nodes = 31
[site]
depth = "40 m"
density = "1025 kg/m3"
seabed = false
rope_dries = false
[[fixture]]
id = "top"
position = ["{ROPE_M} m", "0 m", "-1 m"]
[[fixture]]
id = "bottom"
position = ["{ROPE_M} m", "0 m", "-31 m"]
[[line]]
id = "rope"
rope = "pp-3-8"
from = "top"
to = "bottom"
length = "29.9 m"
[friction]
model = "org.endline.friction.coulomb"
[whale]
item = "right-whale"
length = "{LENGTH_M} m"
position = ["0 m", "0 m"]
depth = "{DEPTH_M} m"
heading = "90 deg"
speed = "{SPEED_M_S} m/s"
motion = "org.example.plain"
[[whale.pilot]]
at = "0 s"
id = "start"
speed = 1.0
{pilot}"#
    )
}

fn read(pilot: &str) -> Result<Model, String> {
    read_text(&text(pilot))
}

fn read_text(text: &str) -> Result<Model, String> {
    let scenario = Scenario::read("pilot.toml", text).map_err(|problems| report(&problems))?;
    let spec = assemble(&scenario, &library(), &WithPlain, &Options::default())
        .map_err(|problems| report(&problems))?;
    Model::new(spec).map_err(|errors| format!("{errors:?}"))
}

fn model(pilot: &str) -> Model {
    read(pilot).unwrap_or_else(|problems| panic!("{problems}"))
}

/// Steps by the program until a number of entries have begun; returns the state and the controls of every step.
fn flown(model: &Model, entries: usize) -> (State, Vec<Controls>) {
    let (mut state, mut workspace, mut controls) =
        (settle(model).state, Workspace::new(model), Vec::new());
    let pilot = &model.spec.whale.as_ref().unwrap().pilot;
    while state.pilot.begun.len() < entries {
        assert!(state.time_s < 60.0, "never began: {:?}", state.pilot);
        controls.push(pilot.at(&state));
        let input = Input { controls: pilot.at(&state) };
        step(model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
    }
    (state, controls)
}

/// When the second entry began [s].
fn second_began_s(pilot: &str) -> f64 {
    let (state, _) = flown(&model(pilot), 2);
    assert_eq!(state.pilot.begun[1].entry, 1);
    state.pilot.begun[1].at_s
}

/// Whether an entry began at the end of the first step at or after `expected_s`.
fn is_next_step(began_s: f64, expected_s: f64) {
    assert!(
        (-1e-6..STEP_S + 1e-6).contains(&(began_s - expected_s)),
        "began at {began_s} s, expected {expected_s} s"
    );
}

#[test]
fn a_distance_is_met_where_the_snout_comes_that_near() {
    for (of, nearest_m) in [("", ROPE_M), ("of = \"rope\"", ROPE_M), ("of = \"bottom\"", ROPE_M)] {
        // The fixture lies 19 m below the whale's axis; the rope beside it.
        let below_m: f64 = if of.contains("bottom") { 31.0 - DEPTH_M } else { 0.0 };
        let within_m: f64 = if of.contains("bottom") { 20.0 } else { 5.0 };
        let ahead_m = nearest_m - (within_m.powi(2) - below_m.powi(2)).sqrt();
        let began_s =
            second_began_s(&format!("[[whale.pilot]]\nwithin = \"{within_m} m\"\n{of}\nyaw = 1.0"));
        is_next_step(began_s, (ahead_m - 0.5 * LENGTH_M) / SPEED_M_S);
    }
}

/// A whale that swims at a distance to starboard of the rope, or to port of it if that is negative [m].
fn beside(starboard_m: f64, pilot: &str) -> Model {
    let text = text(pilot)
        .replace("\"0 m\", \"0 m\"]\ndepth", &format!("\"0 m\", \"{} m\"]\ndepth", -starboard_m));
    read_text(&text).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The distance is from the nearer eye; steering and act are reversed for rope on the starboard side.
#[test]
fn rope_is_seen_from_the_nearer_eye_and_turned_away_from() {
    let library = library();
    let whale = library.whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap();
    let eye = whale.eye_m(LENGTH_M);
    // Mouth 0.2345 L - 0.184 m, half of a head some 0.19 L wide.
    assert!(
        (eye.x - (0.5 * LENGTH_M - 2.161)).abs() < 1e-9 && (0.8..1.1).contains(&eye.y),
        "{eye}"
    );
    let entry = "[[whale.pilot]]\nsees = \"3.85 m\"\nyaw = -1.0\nroll = 0.5\nspeed = 0.5\nact = \"veer-from-left\"";
    for (starboard_m, side, act) in [(2.0, 1.0, "veer-from-left"), (-2.0, -1.0, "veer-from-right")]
    {
        let model = beside(starboard_m, entry);
        let (state, _) = flown(&model, 2);
        let ahead_m = (3.85_f64.powi(2) - (2.0 - eye.y).powi(2)).sqrt();
        is_next_step(state.pilot.begun[1].at_s, (ROPE_M - ahead_m - eye.x) / SPEED_M_S);
        let whale = model.spec.whale.as_ref().unwrap();
        let controls = whale.pilot.at(&state);
        let acts = &whale.motion.descriptor().acts;
        let number = 1 + acts.iter().position(|known| known.id == act).unwrap();
        let expected = [-side, 0.5 * side, 0.5, number as f64];
        assert_eq!(
            [controls.yaw, controls.roll, controls.speed, controls.act].map(f64::to_bits),
            expected.map(f64::to_bits)
        );
    }
}

/// A whale that would brush the rope with a flipper misses it if it sees the rope.
#[test]
fn a_whale_that_sees_the_rope_veers_past_it() {
    let file = std::fs::read_to_string(root().join("scenarios/rope-mimic.toml")).unwrap();
    for (sees, is_touched) in [("0 m", true), ("3.85 m", false)] {
        let text = file
            .replace("[\"0 m\", \"-14 m\"]", "[\"2 m\", \"-14 m\"]")
            .replace("sees = \"3.85 m\"", &format!("sees = \"{sees}\""))
            .replace("sees_deviation = \"1.6 m\"", "sees_deviation = \"0 m\"");
        let scenario = Scenario::read("rope-mimic.toml", &text).unwrap();
        let spec = assemble(&scenario, &library(), &Linked, &Options::default()).unwrap();
        let model = Model::new(spec).unwrap();
        let (mut state, mut workspace) = (settle(&model).state, Workspace::new(&model));
        let mut touched = false;
        while state.time_s < 25.0 {
            let input = Input { controls: model.spec.whale.as_ref().unwrap().pilot.at(&state) };
            step(&model, &input, &mut state, &mut workspace).unwrap();
            touched |= !workspace.contacts.is_empty();
        }
        assert_eq!(touched, is_touched, "sees at {sees}");
    }
}

/// Rope right ahead is beyond the field of both eyes once it is nearer than `eye.y / sin 15°`.
#[test]
fn rope_right_ahead_is_seen_from_afar_only() {
    let entry = |sees: &str| format!("[[whale.pilot]]\nsees = \"{sees}\"\nmouth = 1.0");
    let eye = library()
        .whales
        .iter()
        .find(|whale| whale.entry.id == "right-whale")
        .unwrap()
        .eye_m(LENGTH_M);
    let ahead_m = (4.5_f64.powi(2) - eye.y.powi(2)).sqrt();
    is_next_step(second_began_s(&entry("4.5 m")), (ROPE_M - ahead_m - eye.x) / SPEED_M_S);
    for unseen in ["3 m", "0 m"] {
        let model = model(&format!("{}\n[[whale.pilot]]\nat = \"12 s\"\nyaw = 0.0", entry(unseen)));
        let (state, _) = flown(&model, 2);
        assert_eq!(state.pilot.begun[1].entry, 2, "{unseen}: {:?}", state.pilot);
    }
}

/// Distances of many seeds have the mean and deviation of the entry.
#[test]
fn the_distance_at_which_rope_is_seen_varies_from_run_to_run() {
    let entry = "[[whale.pilot]]\nsees = \"3.85 m\"\nsees_deviation = \"1.6 m\"\nyaw = -1.0";
    let distances: Vec<f64> = (0..400)
        .map(|seed| {
            let text =
                text(entry).replace("rope_nodes = 31", &format!("rope_nodes = 31\nseed = {seed}"));
            let model = read_text(&text).unwrap();
            match &model.spec.whale.unwrap().pilot.entries[1].trigger {
                Trigger::Sees(sight) => sight.distance_m,
                other => panic!("{other:?}"),
            }
        })
        .collect();
    let mean = distances.iter().sum::<f64>() / 400.0;
    let variance = distances.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / 399.0;
    // Standard errors: 1.6/√400 = 0.08 of the mean, 1.6/√800 = 0.06 of the deviation.
    assert!((mean - 3.85).abs() < 0.25, "{mean}");
    assert!((variance.sqrt() - 1.6).abs() < 0.18, "{variance}");
}

#[test]
fn a_depth_and_a_heading_are_met_where_they_are_passed() {
    // Nose down at a steady rate: z falls as the sine's integral, v/w (1 - cos(w t)).
    let dive = "[[whale.pilot]]\ndepth = \"14 m\"\nmouth = 1.0\n[[whale.pilot]]\nat = \"1 s\"\npitch = -1.0";
    let (state, _) = flown(&model(dive), 3);
    let diving_s = (1.0 - 2.0 * TURN_RAD_S / SPEED_M_S).acos() / TURN_RAD_S;
    let began = state.pilot.begun.iter().find(|begun| begun.entry == 1).unwrap();
    is_next_step(began.at_s, 1.0 + diving_s);

    // East to 30 degrees west of north, to port: two thirds of half a turn. It turns through north, not the far side.
    let turn = "[[whale.pilot]]\nheading = \"-30 deg\"\nmouth = 1.0\n[[whale.pilot]]\nat = \"1 s\"\nspeed = 0.2\nyaw = 1.0";
    let (state, _) = flown(&model(turn), 3);
    let began = state.pilot.begun.iter().find(|begun| begun.entry == 1).unwrap();
    is_next_step(began.at_s, 1.0 + 4.0 / 3.0 * FRAC_PI_2 / TURN_RAD_S);
}

#[test]
fn the_first_touch_is_met_when_rope_presses_and_an_entry_follows_another() {
    let entries = "[[whale.pilot]]\ntouch = \"any\"\nid = \"felt\"\ndelay = \"0.5 s\"\nspeed = 0.0\n\
        [[whale.pilot]]\nafter = \"felt\"\ndelay = \"0.25 s\"\nyaw = -1.0\n[[whale.pilot]]\ntouch = \"left_fluke\"\nmouth = 1.0";
    let model = model(entries);
    let (state, controls) = flown(&model, 3);
    let [_, felt, after] = state.pilot.begun[..] else { panic!("{:?}", state.pilot) };
    assert_eq!((felt.entry, after.entry), (1, 2));
    // The foremost point of the skin meets the rope, or the sides of a head that tapers do a little later.
    let met_s = felt.at_s - 0.5;
    let reach_s = (ROPE_M - 0.5 * LENGTH_M) / SPEED_M_S;
    assert!(
        (reach_s - 0.05..reach_s + 0.25).contains(&met_s),
        "touched at {met_s} s, the snout is there at {reach_s} s"
    );
    assert!((after.at_s - felt.at_s - 0.25).abs() < 1e-12);
    let swimming = controls.iter().take_while(|controls| controls.speed > 0.5).count();
    is_next_step(swimming as f64 * STEP_S, felt.at_s);
    assert!(state.pilot.seen[3].met_s.is_none(), "the fluke was not touched");
}

/// Layers by hand: yaw 0.4 from the start; from 1 s for 1 s a yaw of -0.6 with ramps of half a second, and an act.
#[test]
fn holds_and_ramps_give_the_written_curve_and_then_let_go() {
    let model = model(
        "yaw = 0.4\n[[whale.pilot]]\nat = \"1 s\"\nhold = \"1 s\"\nramp = \"0.5 s\"\nyaw = -0.6\nact = \"spin\"\n[[whale.pilot]]\nat = \"3 s\"\nact = \"none\"",
    );
    let (_, controls) = flown(&model, 3);
    for (index, controls) in controls.iter().enumerate() {
        let t = index as f64 * STEP_S;
        let weight = if t < 2.0 {
            ((t - 1.0) / 0.5).clamp(0.0, 1.0)
        } else {
            (1.0 - (t - 2.0) / 0.5).clamp(0.0, 1.0)
        };
        assert!((controls.yaw - (0.4 - weight)).abs() < 1e-6, "{t} s: {controls:?}");
        assert!((controls.speed - 1.0).abs() < 1e-12);
        let act = if (1.0 - 1e-9..2.0 - 1e-9).contains(&t) { 2.0 } else { 0.0 };
        assert!((controls.act - act).abs() < 1e-12, "{t} s: {controls:?}");
    }
}

#[test]
fn a_snapshot_continues_like_the_run_it_was_taken_from() {
    let model = model(
        "[[whale.pilot]]\nheading = \"60 deg\"\nyaw = 0.0\nspeed = 0.1\n[[whale.pilot]]\nat = \"1 s\"\nyaw = 1.0",
    );
    let (mut kept, mut workspace) = (settle(&model).state, Workspace::new(&model));
    let pilot = &model.spec.whale.as_ref().unwrap().pilot;
    let go = |state: &mut State, workspace: &mut Workspace| {
        let input = Input { controls: pilot.at(state) };
        step(&model, &input, state, workspace).unwrap();
    };
    (0..300).for_each(|_| go(&mut kept, &mut workspace));
    let (mut taken, mut fresh) = (kept.clone(), Workspace::new(&model));
    for _ in 0..400 {
        go(&mut kept, &mut workspace);
        go(&mut taken, &mut fresh);
    }
    assert_eq!(kept, taken);
    assert_eq!(kept.pilot.begun.len(), 3);
}

#[test]
fn a_mistake_is_reported_with_its_place() {
    let entry = |lines: &str| read(&format!("[[whale.pilot]]\n{lines}")).err().unwrap_or_default();
    for (lines, wanted) in [
        ("yaw = 1.0", "this entry of the pilot has no trigger"),
        ("at = \"1 s\"\ntouch = \"any\"\nyaw = 1.0", "two triggers, `at` and `touch`"),
        ("at = \"1 s\"", "the entry sets no control"),
        ("at = \"1 s\"\nyow = 1.0", "unknown field `yow`"),
        ("at = \"1 s\"\nyaw = 2.0", "it must be between -1 and 1"),
        ("at = \"1 s\"\ndelay = \"1 s\"\nyaw = 1.0", "an entry with `at` has no `delay`"),
        ("at = \"1 s\"\nof = \"rope\"\nyaw = 1.0", "`of` without `within` or `sees`"),
        ("at = \"1 s\"\nsees_deviation = \"1 m\"\nyaw = 1.0", "`sees_deviation` without `sees`"),
        ("at = \"0 s\"\nyaw = 1.0", "not in rising order of `at`"),
        ("touch = \"left_flippers\"\nyaw = 1.0", "did you mean `left_flipper`?"),
        ("within = \"5 m\"\nof = \"ropes\"\nyaw = 1.0", "there is no line, body or joint `ropes`"),
        ("within = \"5 s\"\nyaw = 1.0", "`within`"),
        ("after = \"begin\"\nyaw = 1.0", "no earlier entry has the id `begin`"),
        ("at = \"1 s\"\nid = \"start\"\nyaw = 1.0", "there are two entries with the id `start`"),
        ("sees = \"3 m\"\nact = \"turn-away\"", "`turn-away` turns by the side that was touched"),
        ("at = \"1 s\"\nact = \"rol-away\"", "has no act `rol-away`"),
        ("at = \"1 s\"\nact = \"rol-away\"", "did you mean `roll-away`?"),
        ("at = \"1 s\"\nhold = \"0 s\"\nyaw = 1.0", "it must be above zero"),
    ] {
        let said = entry(lines);
        assert!(said.contains(wanted) && said.contains("pilot.toml:"), "{lines}: {said}");
    }
}
