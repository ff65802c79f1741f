//! Running a recording again: the same bits, or the first step and part that differ; a run that continues a recording.
//!
//! To continue a recording under another pilot, its inputs are stepped through again up to a moment and every step is compared,
//! so that the states before are the recorded ones, to the bit; then the scenario's own pilot program steers.

use std::sync::Arc;

use endline_sim::{Frame, Input};

use super::Recording;
use crate::error::Error;
use crate::hash::{PART_NAMES, input_hash};
use crate::plugins::{PluginHost, PluginUsed};
use crate::run::{Run, RunOptions};
use crate::source::Prepared;

/// How a recording is run again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReplayOptions {
    /// Accept plugins of another version or another file than recorded.
    pub other_plugins: bool,
    /// Frames kept for each simulated second; 0 keeps none.
    pub frames_hz: f64,
}

/// The result of comparing a replay with its recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Every step gave the recorded bits.
    Same {
        /// Steps compared.
        steps: u64,
    },
    /// The first step that did not.
    Differs {
        /// The step; 0 is the settled state.
        step: u64,
        /// Time at its end [s].
        time_s: f64,
        /// The part of the state, or `end of the run` where one run stopped and the other went on.
        part: &'static str,
    },
}

/// Prepares the recorded model again and settles it.
pub fn start(
    recording: &Recording,
    host: &PluginHost,
    options: ReplayOptions,
) -> Result<Run, Error> {
    let prepared = recording.source.clone().prepare(host)?;
    check_header(recording, &prepared)?;
    if !options.other_plugins {
        check_plugins(&recording.header.plugins, &prepared.plugins)?;
    }
    Run::new(
        prepared,
        RunOptions { unsettled: recording.header.unsettled, frames_hz: options.frames_hz },
    )
}

/// The head of a recording must agree with its own files.
fn check_header(recording: &Recording, prepared: &Prepared) -> Result<(), Error> {
    let (header, settings) = (&recording.header, &prepared.model.spec.settings);
    let differ = [
        ("step", header.dt_s.to_bits() != settings.step_s.to_bits()),
        ("seed", header.seed != settings.seed),
        ("hash of the model", header.model_hash != recording.source.hash()),
    ];
    let wrong: Vec<&str> = differ.iter().filter(|(_, is)| *is).map(|(what, _)| *what).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    Err(Error::Message(format!(
        "the recording contradicts itself: its {} is not that of the scenario and library in it; it was altered",
        wrong.join(", its ")
    )))
}

/// Whether a run that was taken through a recording ends in the recorded state.
pub fn ends_as_recorded(recording: &Recording, run: &Run) -> bool {
    let at = usize::try_from(run.state().step).unwrap_or(usize::MAX);
    recording.hashes.get(at) == Some(&run.state_hash())
}

/// Runs a recording again to its end; `progress` receives the steps taken and in all, and returns whether to continue.
pub fn replay(
    recording: &Recording,
    host: &PluginHost,
    options: ReplayOptions,
    mut progress: impl FnMut(u64, u64) -> bool,
) -> Result<Run, Error> {
    refuse_damage(recording)?;
    let mut run = start(recording, host, options)?;
    for controls in &recording.inputs {
        if run.step_raw(*controls).is_err() || !progress(run.state().step, recording.steps() as u64)
        {
            break;
        }
    }
    Ok(run)
}

/// Runs a recording again and compares every step, up to the first that differs; `progress` hears the steps taken and in all
/// and returns whether to continue.
pub fn verify(
    recording: &Recording,
    host: &PluginHost,
    options: ReplayOptions,
    mut progress: impl FnMut(u64, u64) -> bool,
) -> Result<(Run, Verdict), Error> {
    let mut run = start(recording, host, options)?;
    let verdict = compare(recording, &mut run, recording.inputs.len(), &mut |run, steps| {
        progress(run.state().step, steps)
    });
    Ok((run, verdict))
}

/// Takes a run from its start through the first `steps` of a recording, up to the first that differs; `progress` receives the run
/// after each step and the steps in all, and returns whether to continue.
pub fn compare(
    recording: &Recording,
    run: &mut Run,
    steps: usize,
    progress: &mut dyn FnMut(&Run, u64) -> bool,
) -> Verdict {
    let differs = |step: usize, part| Verdict::Differs {
        step: step as u64,
        time_s: step as f64 * recording.header.dt_s,
        part,
    };
    if let Some(part) =
        recording.hashes.first().and_then(|recorded| recorded.first_difference(&run.state_hash()))
    {
        return differs(0, part);
    }
    for (index, controls) in recording.inputs.iter().take(steps).enumerate() {
        let step = index + 1;
        if let Some(part) = step_and_compare(recording, run, step, Input { controls: *controls }) {
            return differs(step, part);
        }
        if !progress(run, steps as u64) {
            break;
        }
    }
    Verdict::Same { steps: run.state().step }
}

/// The moment nearest before a time, by running again up to it.
pub fn frame_at(
    recording: &Recording,
    host: &PluginHost,
    options: ReplayOptions,
    time_s: f64,
) -> Result<(Run, Arc<Frame>), Error> {
    refuse_damage(recording)?;
    let wanted = step_at(recording, time_s)?;
    let mut run = start(recording, host, options)?;
    for controls in &recording.inputs[..wanted] {
        run.step_raw(*controls).map_err(Error::Stopped)?;
    }
    let frame = run.frame();
    Ok((run, frame))
}

/// Steps once and names the part that differs. A changed input is found before it is stepped
/// with; the last input of a stopped run has no state to compare, only that it stops again.
fn step_and_compare(
    recording: &Recording,
    run: &mut Run,
    step: usize,
    input: Input,
) -> Option<&'static str> {
    let recorded = recording.hashes.get(step);
    if recorded.is_some_and(|recorded| recorded.parts[0] != input_hash(&input)) {
        return Some(PART_NAMES[0]);
    }
    let stopped = run.step_raw(input.controls).is_err();
    match recorded {
        Some(recorded) if !stopped => recorded.first_difference(&run.state_hash()),
        None if stopped => None,
        _ => Some("end of the run"),
    }
}

/// The step nearest before a time.
pub(super) fn step_at(recording: &Recording, time_s: f64) -> Result<usize, Error> {
    let last_s = recording.duration_s();
    // Half a step of grace, so that the last moment may be named rounded.
    if !(time_s >= 0.0 && time_s <= last_s + 0.5 * recording.header.dt_s) {
        return Err(Error::Message(format!(
            "{time_s} s is outside the recording; expected 0 to {last_s} s"
        )));
    }
    Ok(((time_s / recording.header.dt_s + 1e-6).floor() as usize).min(recording.steps()))
}

pub(super) fn refuse_damage(recording: &Recording) -> Result<(), Error> {
    match &recording.damage {
        Some(damage) => Err(Error::Message(format!(
            "{damage}; `endline replay --verify` names the first step that differs"
        ))),
        None => Ok(()),
    }
}

/// Every recorded plugin must be here, the same version from the same file.
pub fn check_plugins(recorded: &[PluginUsed], here: &[PluginUsed]) -> Result<(), Error> {
    let mut problems = Vec::new();
    for plugin in recorded {
        let id = &plugin.id;
        match here.iter().find(|found| found.id == *id) {
            None => {
                problems.push(format!("plugin {id}: recorded, but the model does not use it here"))
            }
            Some(found) if found.version != plugin.version => {
                problems.push(format!(
                    "plugin {id}: recorded with version {}, found version {}",
                    plugin.version, found.version
                ));
            }
            Some(found) if found.file_hash != plugin.file_hash => {
                let (was, is) = (short(&plugin.file_hash), short(&found.file_hash));
                problems.push(format!("plugin {id}: recorded with file {was}, found file {is}"));
            }
            Some(_) => {}
        }
    }
    for plugin in here.iter().filter(|plugin| recorded.iter().all(|known| known.id != plugin.id)) {
        problems.push(format!("plugin {}: used here, but not recorded", plugin.id));
    }
    if problems.is_empty() {
        return Ok(());
    }
    problems.push("restore the recorded plugins, or accept the others with --other-plugins".into());
    Err(Error::Message(problems.join("\n")))
}

/// The start of a file's hash, enough to distinguish two; files linked in have none.
fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or("(linked in)")
}

/// The recorded run up to a time, in a scenario that differs from the recorded one in its pilot program at most.
pub fn take_over(
    recording: &Recording,
    prepared: Prepared,
    options: RunOptions,
    time_s: f64,
    mut progress: impl FnMut(u64, u64),
) -> Result<Run, Error> {
    refuse_damage(recording)?;
    let steps = step_at(recording, time_s)?;
    let (recorded_s, here_s) = (recording.header.dt_s, prepared.model.spec.settings.step_s);
    if recorded_s.to_bits() != here_s.to_bits() {
        return Err(Error::Message(format!(
            "the recording has a step of {recorded_s} s, the scenario one of {here_s} s; give --dt {recorded_s}s"
        )));
    }
    let mut run = Run::new(prepared, options)?;
    let mut report = |run: &Run, steps| {
        progress(run.state().step, steps);
        true
    };
    match compare(recording, &mut run, steps, &mut report) {
        Verdict::Same { .. } => Ok(run),
        Verdict::Differs { step, time_s, part } => Err(Error::Message(format!(
            "the scenario is not the one recorded: at step {step} ({time_s:.3} s) its {part} differs from the recording\n\
             up to the moment taken over, nothing but [[whale.pilot]] may differ"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::sample::hanging_rope;
    use endline_sdk::Controls;

    fn run() -> Run {
        Run::new(hanging_rope(60.0), RunOptions { unsettled: true, frames_hz: 0.0 }).unwrap()
    }

    fn recorded(steps: u32) -> Recording {
        let mut run = run();
        for step in 0..steps {
            run.step(Controls { yaw: f64::from(step) / f64::from(steps), ..Controls::default() })
                .unwrap();
        }
        run.recording().unwrap()
    }

    fn verdict(recording: &Recording) -> Verdict {
        compare(recording, &mut run(), recording.inputs.len(), &mut |_, _| true)
    }

    #[test]
    fn the_same_steps_give_the_same_bits() {
        assert_eq!(verdict(&recorded(40)), Verdict::Same { steps: 40 });
    }

    #[test]
    fn a_changed_input_is_found_at_its_step_whatever_it_became() {
        for wrong in [0.123, -0.0, f64::NAN, f64::INFINITY] {
            let mut recording = recorded(40);
            recording.inputs[16].pitch = wrong;
            let Verdict::Differs { step, part, .. } = verdict(&recording) else {
                panic!("{wrong} was not found")
            };
            assert_eq!((step, part), (17, "input"));
        }
    }

    #[test]
    fn every_part_is_compared_at_every_step() {
        for (part, name) in PART_NAMES.iter().enumerate() {
            for step in [0, 1, 23, 40] {
                let mut recording = recorded(40);
                recording.hashes[step].parts[part] ^= 1;
                // Nothing is fed in to reach the settled state, but its hash is compared all the same.
                assert!(
                    matches!(verdict(&recording), Verdict::Differs { step: found, part, .. } if found == step as u64 && part == *name)
                );
            }
        }
    }

    #[test]
    fn a_run_that_continues_where_the_recorded_one_stopped_differs() {
        let mut recording = recorded(40);
        recording.header.stopped = Some("stopped at 0.400 s: line: reason".into());
        recording.inputs.push(Controls::default());
        assert!(matches!(
            verdict(&recording),
            Verdict::Differs { step: 41, part: "end of the run", .. }
        ));
    }

    fn plugin(version: &str, file_hash: &str) -> PluginUsed {
        PluginUsed {
            id: "org.example.motion".into(),
            version: version.into(),
            file_hash: file_hash.into(),
        }
    }

    #[test]
    fn another_plugin_is_refused_by_name() {
        let recorded = [plugin("1.0.0", "0123456789abcdef")];
        assert!(check_plugins(&recorded, &recorded).is_ok());
        for (here, word) in [
            (vec![], "does not use it"),
            (vec![plugin("1.0.1", "0123456789abcdef")], "version 1.0.1"),
            (vec![plugin("1.0.0", "fedcba9876543210")], "found file fedcba987654"),
        ] {
            let message = check_plugins(&recorded, &here).unwrap_err().to_string();
            assert!(message.contains("org.example.motion") && message.contains(word), "{message}");
        }
    }
}
