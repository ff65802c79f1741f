//! The program `endline`: the command line, or the window of the workbench if no command is given.

use std::process::ExitCode;

use endline_workbench::cli;

fn main() -> ExitCode {
    match cli::run(std::env::args_os()) {
        Ok(code) => code,
        Err(failure) => failure.print(),
    }
}
