//! `endline completions` and `endline man`: what shells complete, and manual pages, made from the declared arguments.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::Shell;

use super::args::Args;
use super::{Failure, output};

/// Prints the script by which a shell completes this program's arguments.
pub(super) fn completions(shell: Shell) -> ExitCode {
    clap_complete::generate(shell, &mut Args::command(), "endline", &mut io::stdout());
    ExitCode::SUCCESS
}

/// Writes a manual page for the program and each of its commands into a folder.
pub(super) fn man(folder: &Path) -> Result<ExitCode, Failure> {
    let failed = |error: io::Error| {
        Failure::failed(format!("{}: the pages cannot be written: {error}", folder.display()))
    };
    std::fs::create_dir_all(folder).map_err(failed)?;
    clap_mangen::generate_to(Args::command(), folder).map_err(failed)?;
    output::note(&format!("read them with `man -l {}/endline.1`", folder.display()));
    Ok(ExitCode::SUCCESS)
}
