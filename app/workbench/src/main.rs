//! The program `endline`: the command line, and the workbench where none is given.

use std::process::ExitCode;

use endline_workbench::cli;

fn main() -> ExitCode {
    match cli::run(std::env::args_os()) {
        Ok(code) => code,
        Err(failure) => failure.tell(),
    }
}
