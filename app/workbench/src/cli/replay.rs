//! `endline replay`: run a recording again; with `--verify` compare every step. `endline pilot`: a recording as a pilot program.

use std::process::ExitCode;

use endline_session::recording::program::program;
use endline_session::recording::replay::{self, ReplayOptions, Verdict};
use endline_session::{Recording, Report, Run};
use schemars::JsonSchema;
use serde::Serialize;

use super::args::{PilotArgs, ReplayArgs};
use super::output::Progress;
use super::{Failure, host, output, table};

/// Name and version of the JSON form.
pub(super) const SCHEMA: &str = "endline.replay/1";

/// The JSON of the command.
#[derive(JsonSchema, Serialize)]
pub(super) struct ReplayReport {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// File of the recording.
    recording: String,
    /// Version of Endline that recorded it.
    recorded_with: String,
    /// Steps recorded.
    steps: u64,
    /// `null` where nothing was compared.
    verified: Option<bool>,
    /// The first difference; null where there is none.
    differs: Option<Difference>,
    /// The damaged part of the file; null where none is.
    damage: Option<String>,
    /// Summary of the run.
    run: Report,
}

/// The first difference from a recording.
#[derive(Clone, Copy, JsonSchema, Serialize)]
struct Difference {
    /// Number of the step.
    step: u64,
    /// Its moment [s].
    time_s: f64,
    /// The part of the state that differs.
    part: &'static str,
}

pub(super) fn replay(args: &ReplayArgs) -> Result<ExitCode, Failure> {
    let recording = Recording::load(&args.recording)?;
    tell_version(&recording);
    let (run, verdict) = again(args, &recording)?;
    let difference = match verdict {
        Some(Verdict::Differs { step, time_s, part }) => Some(Difference { step, time_s, part }),
        _ => None,
    };
    output::print(&if args.json {
        json(args, &recording, &run, verdict.as_ref(), difference)
    } else {
        words(&run, verdict.as_ref())
    })?;
    match difference {
        None if verdict.is_none()
            && is_bound(args, &recording)
            && !replay::ends_as_recorded(&recording, &run) =>
        {
            Err(Failure::failed(format!(
                "{}: the run ends in another state than the recorded one; --verify names the first step that differs",
                args.recording.display()
            )))
        }
        None => Ok(ExitCode::SUCCESS),
        Some(difference) => Err(Failure::failed(difference_words(args, &recording, difference))),
    }
}

fn again(args: &ReplayArgs, recording: &Recording) -> Result<(Run, Option<Verdict>), Failure> {
    let host = host::load();
    let options = ReplayOptions { other_plugins: args.other_plugins, frames_hz: 0.0 };
    let progress = Progress::new(if args.verify { "verifying" } else { "replaying" });
    let report = |step, steps| {
        progress.at(step, steps);
        true
    };
    if args.verify {
        let (run, verdict) = replay::verify(recording, &host, options, report)?;
        return Ok((run, Some(verdict)));
    }
    Ok((replay::replay(recording, &host, options, report)?, None))
}

/// Whether the bits are promised: by this version, with the recorded plugins.
fn is_bound(args: &ReplayArgs, recording: &Recording) -> bool {
    recording.header.program == endline_session::VERSION && !args.other_plugins
}

/// Bits are promised for one program only; a warning names another version.
pub(super) fn tell_version(recording: &Recording) {
    let (recorded, here) = (&recording.header.program, endline_session::VERSION);
    if recorded != here {
        output::warn(&format!(
            "recorded with Endline {recorded}, this is {here}: the bits may differ"
        ));
    }
}

fn difference_words(args: &ReplayArgs, recording: &Recording, difference: Difference) -> String {
    let Difference { step, time_s, part } = difference;
    let damage =
        recording.damage.as_ref().map(|damage| format!("\n  {damage}")).unwrap_or_default();
    format!(
        "{}: step {step} ({time_s:.3} s): {part} differs from the recording{damage}",
        args.recording.display()
    )
}

fn words(run: &Run, verdict: Option<&Verdict>) -> String {
    let compared = match verdict {
        None => String::new(),
        Some(Verdict::Same { steps }) => {
            format!("verified: {steps} steps gave the recorded bits\n")
        }
        Some(Verdict::Differs { .. }) => return String::new(),
    };
    table::summary(&Report::from_run(run)) + &compared
}

fn json(
    args: &ReplayArgs,
    recording: &Recording,
    run: &Run,
    verdict: Option<&Verdict>,
    differs: Option<Difference>,
) -> String {
    let report = ReplayReport {
        schema: SCHEMA,
        recording: args.recording.display().to_string(),
        recorded_with: recording.header.program.clone(),
        steps: recording.steps() as u64,
        verified: verdict.map(|verdict| matches!(verdict, Verdict::Same { .. })),
        differs,
        damage: recording.damage.clone(),
        run: Report::from_run(run),
    };
    // Structs of numbers and strings always serialise.
    serde_json::to_string(&report).unwrap_or_default() + "\n"
}

pub(super) fn pilot(args: &PilotArgs) -> Result<ExitCode, Failure> {
    output::not_its_own_input(&args.recording, &args.out)?;
    let recording = Recording::load(&args.recording)?;
    let program = program(&recording, &host::load(), args.thin)?;
    let out = args.out.display();
    endline_session::save::atomically(&args.out, program.scenario.as_bytes())
        .map_err(|error| Failure::failed(format!("{out}: cannot be written: {error}")))?;
    let (entries, steps) = (program.entries, recording.inputs.len());
    output::print(&format!(
        "{out}: {entries} entries of a pilot for {steps} steps\nrun with: endline run {out}{}\n",
        program.options
    ))?;
    Ok(ExitCode::SUCCESS)
}
