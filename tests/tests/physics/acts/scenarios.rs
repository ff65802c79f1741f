//! The scenarios that show acts, run as a user runs them: a whale alone, its pilot program asking for one act after the other.

use endline_sim::state::WhaleState;
use endline_sim::whale::acts::attitude;
use endline_sim::{Input, State, Workspace, step};

use crate::linked::model;

/// Runs a shipped scenario to its end; the whale at each of these times [s].
fn run(name: &str, times: &[f64]) -> Vec<WhaleState> {
    let model = model(name, &[]);
    let (mut state, mut workspace, mut seen) =
        (State::start(&model), Workspace::new(&model), Vec::new());
    let pilot = &model.spec.whale.as_ref().unwrap().pilot;
    while state.time_s < model.spec.settings.duration_s - 1e-9 {
        let input = Input { controls: pilot.at(&state) };
        step(&model, &input, &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{name}: {stop:?}"));
        if times.iter().any(|time_s| (state.time_s - time_s).abs() < 1e-6) {
            seen.push(state.whale.clone().unwrap());
        }
    }
    assert_eq!(seen.len(), times.len(), "{name}");
    seen
}

/// Bank and climb [degrees].
fn bank_and_climb(whale: &WhaleState) -> [f64; 2] {
    let [_, bank, climb] = attitude(whale.orientation).map(f64::to_degrees);
    [bank, climb]
}

/// Ten tagged dives went down at -58 ± 6 and up at 54 ± 8 degrees.
#[test]
fn a_foraging_dive_has_the_pitch_of_tagged_ones() {
    let [down, feeding, up] =
        <[_; 3]>::try_from(run("foraging-dive.toml", &[21.0, 42.0, 54.0])).unwrap();
    let [_, descent] = bank_and_climb(&down);
    let [_, ascent] = bank_and_climb(&up);
    assert!(
        (descent + 58.0).abs() < 6.0 && (ascent - 54.0).abs() < 8.0,
        "{descent} and {ascent} degrees"
    );
    assert!(
        feeding.posture.jaw > 0.2
            && bank_and_climb(&feeding)[1].abs() < 2.0
            && down.position.z < -8.0
    );
}

#[test]
fn skim_feeding_is_upright_then_on_either_side_and_ends_with_a_closed_mouth() {
    let whales = run("skim-feeding.toml", &[20.0, 42.0, 62.0, 74.0]);
    for (whale, (bank, jaw)) in whales.iter().zip([(0.0, 15.0), (90.0, 15.0), (-90.0, 15.0)]) {
        let [banked, climb] = bank_and_climb(whale);
        assert!((banked - bank).abs() < 2.0 && climb.abs() < 2.0, "bank {banked}, climb {climb}");
        assert!((whale.posture.jaw.to_degrees() - jaw).abs() < 1.0, "{}", whale.posture.jaw);
    }
    assert!(whales[3].posture.jaw.abs() < 1e-9 && whales[3].posture.lips[0].abs() < 1e-9);
}

#[test]
fn the_barrel_roll_comes_round_and_the_flippers_and_the_group_play_to_their_end() {
    for whale in run("barrel-roll.toml", &[23.5, 48.0]) {
        let [bank, climb] = bank_and_climb(&whale);
        assert!(bank.abs() < 1.0 && climb.abs() < 1.0, "bank {bank}, climb {climb}");
    }
    let [over] = <[_; 1]>::try_from(run("barrel-roll.toml", &[13.0])).unwrap();
    assert!(bank_and_climb(&over)[0].abs() > 150.0, "on its back half way round");
    let flippers = run("flippers.toml", &[10.0, 16.0, 22.0, 28.0, 34.0, 40.0]);
    let degrees = |whale: &WhaleState| {
        [
            whale.posture.flipper_raise[0],
            whale.posture.flipper_twist[0],
            whale.posture.flipper_sweep[0],
        ]
        .map(f64::to_degrees)
    };
    let [abduct, adduct, pronate, supinate, sweep, tuck] = <[_; 6]>::try_from(flippers).unwrap();
    assert!(
        degrees(&abduct)[0] > 24.0
            && degrees(&adduct)[0] < -54.0
            && degrees(&pronate)[1] > 29.0
            && degrees(&supinate)[1] < -29.0
    );
    assert!(degrees(&sweep)[2] < -34.0 && degrees(&tuck)[2] > 39.0);
    let [back] = <[_; 1]>::try_from(run("surface-active.toml", &[20.0])).unwrap();
    assert!(bank_and_climb(&back)[0].abs() > 175.0, "belly up");
}
