use std::sync::Arc;
use std::time::{Duration, Instant};

use super::*;
use crate::run::Run;
use crate::source::sample::hanging_rope;

/// Waits until the view is as wanted; a live run that never gets there fails.
fn until(live: &Live, what: &str, wanted: impl Fn(&LiveView) -> bool) -> Arc<LiveView> {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(20) {
        let view = live.latest();
        if wanted(&view) {
            return view;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    panic!(
        "did not happen: {what}; last {:?} at {} s",
        live.latest().status,
        live.latest().newest_s
    );
}

fn open(duration_s: f64) -> Live {
    let options = RunOptions { unsettled: true, ..RunOptions::default() };
    Live::open(hanging_rope(duration_s), Arc::new(PluginHost::empty()), options, || {}).unwrap()
}

#[test]
fn a_run_is_started_stepped_sought_and_reset() {
    let live = open(5.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    assert!(live.send(RunCommand::Step));
    let view = until(&live, "one step", |view| view.frame.step == 1);
    assert_eq!(view.status, Status::Paused);

    assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
    let view = until(&live, "the end", |view| view.status == Status::Finished);
    assert!((view.newest_s - 5.0).abs() < 1e-6, "{}", view.newest_s);
    assert!(view.tension.len() > 100 && view.summary.is_some());

    assert!(live.send(RunCommand::Seek(2.5)));
    let view = until(&live, "the middle", |view| view.sought);
    assert!((view.frame.time_s - 2.5).abs() < 0.02, "{}", view.frame.time_s);

    assert!(live.send(RunCommand::Shift(1)));
    let after = until(&live, "one moment on", |later| later.frame.step > view.frame.step);
    assert!(live.send(RunCommand::Shift(-1)));
    until(&live, "and back", |earlier| earlier.frame.step == view.frame.step);
    assert!(after.sought && after.history.len() == after.tension.len());
    assert!(live.send(RunCommand::Seek(f64::MAX)));
    until(&live, "the newest", |view| {
        !view.sought && (view.frame.time_s - view.newest_s).abs() < 1e-12
    });

    assert!(live.send(RunCommand::Reset));
    let view = until(&live, "the start", |view| view.frame.step == 0 && !view.sought);
    assert_eq!(view.status, Status::Paused);
}

#[test]
fn the_envelope_along_a_line_reaches_its_peak_and_no_further() {
    let live = open(3.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
    let view = until(&live, "the end", |view| view.status == Status::Finished);
    let summary = view.summary.as_ref().unwrap();
    for (line, of) in view.envelope.lines.iter().zip(&summary.lines) {
        let top = line.greatest_n.iter().copied().fold(0.0, f64::max);
        assert!(
            (top - of.peak_tension_n).abs() < 1e-9 * of.peak_tension_n.max(1.0),
            "{top} N, {} N",
            of.peak_tension_n
        );
        assert!(
            line.least_n.iter().zip(&line.greatest_n).all(|(least, greatest)| least <= greatest),
            "{line:?}"
        );
    }
}

#[test]
fn a_run_continues_from_the_moment_shown_in_another_model_to_the_same_bits() {
    let live = open(2.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
    let end = until(&live, "the end", |view| view.status == Status::Finished);
    assert!(live.send(RunCommand::Seek(1.0)));
    until(&live, "the middle", |view| view.sought);
    assert!(live.send(RunCommand::Rerun(Box::new(hanging_rope(2.0)))));
    let again = until(&live, "the end again", |view| {
        !Arc::ptr_eq(&view.model, &end.model) && view.status == Status::Finished
    });
    assert_eq!(again.state_hash, end.state_hash);
    assert!(live.send(RunCommand::Program(0.0)));
    let view = until(&live, "an answer", |view| view.program.is_some());
    // The sample is no scenario of a library, and has no whale: nothing to fly again, and it says why.
    assert!(view.program.as_ref().unwrap().as_ref().as_ref().is_err_and(|why| !why.is_empty()));
}

#[test]
fn real_time_is_kept() {
    let live = open(60.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    let start = Instant::now();
    assert!(live.send(RunCommand::Speed(2.0)) && live.send(RunCommand::Start));
    let view = until(&live, "one simulated second", |view| view.newest_s >= 1.0);
    let wall_s = start.elapsed().as_secs_f64();
    // Never early; how late depends on the machine.
    assert!(wall_s > 0.45 * view.newest_s, "{} s in {wall_s} s", view.newest_s);
    assert!(live.send(RunCommand::Pause));
    let paused = until(&live, "a pause", |view| view.status == Status::Paused);
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(live.latest().frame.step, paused.frame.step);
}

#[test]
fn a_recording_is_saved_with_the_pilots_controls() {
    let path = std::env::temp_dir().join(format!("endline-live-{}.endline", std::process::id()));
    let live = open(60.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    let controls = Controls { speed: 0.5, yaw: -1.0, ..Controls::default() };
    assert!(live.send(RunCommand::Controls(controls)) && live.send(RunCommand::Step));
    assert!(live.send(RunCommand::Autopilot) && live.send(RunCommand::Step));
    assert!(live.send(RunCommand::SaveRecording(path.clone())));
    until(&live, "a message", |view| {
        view.message.as_ref().is_some_and(|message| message.starts_with("saved"))
    });
    let recording = crate::Recording::load(&path).unwrap();
    assert_eq!(recording.inputs, [controls, Controls::default()]);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn dropping_a_run_ends_its_thread() {
    let live = open(1e6);
    assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
    until(&live, "running", |view| view.status == Status::Running);
    let start = Instant::now();
    drop(live);
    assert!(start.elapsed() < Duration::from_secs(5));
}

#[test]
fn half_speed_waits_twice_as_long_and_lateness_is_forgotten() {
    let start = Instant::now();
    let mut pace = Pace::new(0.5, start, 10.0);
    assert_eq!(pace.wait(start, 10.5), Duration::from_secs(1));
    let late = start + Duration::from_secs(5);
    assert_eq!(pace.wait(late, 10.5), Duration::ZERO);
    assert_eq!(pace.wait(late, 11.0), Duration::from_secs(1));
    assert_eq!(Pace::new(f64::INFINITY, start, 0.0).wait(start, 100.0), Duration::ZERO);
}

/// A run goes back to a moment from the last state kept before it, with the bits of a run from the start; its history ends there.
#[test]
fn a_moment_is_reached_again_with_the_same_bits() {
    let live = open(12.0);
    until(&live, "settled", |view| view.status == Status::Paused);
    assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
    until(&live, "the end", |view| view.status == Status::Finished);
    for time_s in [11.5, 7.1, 7.1, 1.0] {
        assert!(live.send(RunCommand::Seek(time_s)));
        let sought = until(&live, "the moment", |view| view.sought);
        let step = sought.frame.step;
        assert!(live.send(RunCommand::Branch));
        let view = until(&live, "the moment again", |view| {
            view.status == Status::Paused && !view.sought && view.frame.step == step
        });
        let options = RunOptions { unsettled: true, ..RunOptions::default() };
        let mut alone = Run::new(hanging_rope(12.0), options).unwrap();
        (0..step).for_each(|_| alone.step(alone.pilot()).unwrap());
        assert_eq!(view.state_hash, alone.state_hash().hex(), "{time_s} s");
        assert_eq!(view.history.len(), view.tension.len());
        let last_s = view.tension.samples(0).last().map_or(0.0, |(time_s, _)| time_s);
        assert!((last_s - view.newest_s).abs() < 0.1, "{last_s} s, {} s", view.newest_s);
        assert!(live.send(RunCommand::Speed(f64::INFINITY)) && live.send(RunCommand::Start));
        until(&live, "the end", |view| view.status == Status::Finished);
    }
}
