//! `endline pilot`: a recorded run as a scenario whose pilot program flies it again.

use std::process::ExitCode;

use endline_session::Recording;
use endline_session::recording::program::program;

use super::args::PilotArgs;
use super::{Failure, host, output};

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
