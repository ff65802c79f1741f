//! The fluke beat of a whale that pulls gear follows its thrust: compared with a tagged whale, and with the law of a free whale.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{built, scenario_text, spec_of};
use endline_sim::metrics::{BeatSummary, Metrics};
use endline_sim::{Input, Model, State, Workspace, step};

/// Beat from `from_s` to `to_s`, and the mean thrust [N] and speed [m/s] in that time.
fn beat(model: &Model, from_s: f64, to_s: f64) -> (BeatSummary, f64, f64) {
    let (mut state, mut workspace) = (State::start(model), Workspace::new(model));
    let mut metrics = Metrics::new(model);
    let mut means = [0.0; 3];
    while state.time_s < to_s {
        let input = Input { controls: model.spec.whale.as_ref().unwrap().pilot.at(&state) };
        step(model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
        if state.time_s > from_s {
            metrics.fold_step(model, &state, &workspace);
            let whale = state.whale.as_ref().unwrap();
            for (mean, value) in
                means.iter_mut().zip([1.0, whale.exertion.thrust_n, whale.speed_m_s])
            {
                *mean += value;
            }
        }
    }
    let beat = metrics.summary(model, &state).whale.unwrap().beat.unwrap();
    (beat, means[1] / means[0], means[2] / means[0])
}

fn scenario(file: &str, changes: &[(&str, &str)]) -> Model {
    let mut text = scenario_text(file);
    for (from, to) in changes {
        assert!(text.contains(from), "the scenario says {from}");
        text = text.replace(from, to);
    }
    built(spec_of(file, &text))
}

/// Tag of Eg 3911, a right whale of 10 m: 3.7 to 4.5 s between fluke strokes with her gear, 0.22 to 0.27 Hz, by two series of marks on
/// its record (repository of van der Hoop et al. 2017, doi:10.3354/esr00781). Her speed was not measured; 1.23 m/s is the upper end of
/// tracked speeds. The line is made fast to the belly here, so that the flukes are free to beat.
#[test]
fn eg_3911_beats_as_fast_as_her_tag_recorded() {
    let still = "beat_amplitude = 0.02\nstrouhal = 0.1\n";
    let towing = scenario("eg-3911.toml", &[(still, ""), ("whale:peduncle", "whale:belly")]);
    let (beat, thrust_n, speed_m_s) = beat(&towing, 40.0, 110.0);
    let drag = &towing.spec.whale.as_ref().unwrap().kinetic.as_ref().unwrap().drag;
    let body_n = drag.drag_n(1025.0, speed_m_s);
    println!("{beat:?}; thrust {thrust_n:.0} N, body {body_n:.0} N");
    assert!((beat.frequency_hz / 0.245 - 1.0).abs() < 0.15, "{} Hz", beat.frequency_hz);
    assert!((speed_m_s / 1.23 - 1.0).abs() < 0.01, "{speed_m_s} m/s");
    let free_hz = 0.3 * 1.23 / 2.0;
    assert!(beat.frequency_hz > 1.1 * free_hz, "a free whale beats {free_hz} times a second");
}

/// A whale that is held fast has no speed, and its thrust needs flukes as fast as those of a free whale with that drag.
#[test]
fn a_whale_that_is_held_fast_beats_by_its_thrust() {
    let attributes = "cruise_speed = \"2.2 m/s\"\nbeat_amplitude = 0.02\nstrouhal = 0.1\n";
    let held = scenario(
        "part-rope-10m.toml",
        &[
            (attributes, "cruise_speed = \"1.23 m/s\"\n"),
            ("whale:peduncle", "whale:belly"),
            ("\"-9.2 m\"", "\"-14 m\""),
            ("length = \"26 m\"", "length = \"31 m\""),
        ],
    );
    let (beat, thrust_n, speed_m_s) = beat(&held, 40.0, 69.0);
    let drag = &held.spec.whale.as_ref().unwrap().kinetic.as_ref().unwrap().drag;
    let beat_m_s = (thrust_n / drag.drag_n(1025.0, 1.0)).powf(1.0 / 1.8);
    let flukes_m_s = beat.frequency_hz * beat.excursion_m;
    println!("{beat:?}; {speed_m_s:.3} m/s, thrust {thrust_n:.0} N, beat of {beat_m_s:.2} m/s");
    assert!(speed_m_s.abs() < 0.1, "it is held: {speed_m_s} m/s");
    assert!(beat_m_s > 1.5, "it pulls more than its drag at 1.23 m/s: {thrust_n} N");
    // The tips of the flukes move somewhat further than their hinge, which the setting describes.
    assert!(
        (1.0..1.15).contains(&(flukes_m_s / (0.3 * beat_m_s))),
        "flukes {flukes_m_s} m/s, 0.3 of {beat_m_s} m/s"
    );
}
