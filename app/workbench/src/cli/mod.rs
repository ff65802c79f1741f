//! The command line: what it takes, and which file does it.
//!
//! Exit codes: 0 done, 1 the run or check failed, 2 wrong use of the command line, 128 and the signal's number where a signal ended
//! it.

mod args;
mod check;
mod docs;
mod export;
mod failure;
mod film;
mod harmless;
mod haul;
mod host;
mod interrupt;
mod manual;
mod mill;
mod output;
mod picture;
mod pilot;
mod player;
mod plugins;
mod progress;
mod quantity;
mod render;
mod replay;
mod rules;
mod run;
mod scenario;
mod schema;
mod search;
mod settle;
mod sheet;
mod study;
mod table;
mod validate;
mod whale;
mod workbench;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;
use endline_session::shipped;

use crate::embedded;

pub use args::Args;
use args::Command;
pub use failure::Failure;

/// Does what the command line says.
///
/// # Errors
/// With what to tell the user and the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Result<ExitCode, Failure> {
    let args = match Args::try_parse_from(arguments) {
        Ok(args) => args,
        Err(message) => return Ok(output::usage(&message)),
    };
    let library = args.library.as_deref();
    output::tell(args.told());
    host::allow(args.allow_plugins);
    shipped::carry(embedded::GEAR_LIBRARY, output::note);
    match &args.command {
        None => workbench::open(library),
        Some(Command::Run(args)) => run::run(args, library),
        Some(Command::Settle(args)) => settle::settle(args, library),
        Some(Command::Replay(args)) => replay::replay(args),
        Some(Command::Pilot(args)) => pilot::pilot(args),
        Some(Command::Render(args)) => render::render(args, library),
        Some(Command::Export(args)) => export::export(args, library),
        Some(Command::Validate(args)) => validate::validate(args, library),
        Some(Command::Check(args)) => check::check(args, library),
        Some(Command::Whale { what }) => whale::whale(what, library),
        Some(Command::Study { what }) => study::study(what, library),
        Some(Command::Search(args)) => search::search(args, library),
        Some(Command::Rules { what }) => rules::rules(what, library),
        Some(Command::Mill(args)) => mill::mill(args),
        Some(Command::Haul(args)) => haul::haul_gear(args, library),
        Some(Command::Sheet(args)) => sheet::sheet(args, library),
        Some(Command::Schema { form }) => schema::schema(form.as_deref()),
        Some(Command::Docs { document }) => docs::docs(document.as_deref()),
        Some(Command::Completions { shell }) => Ok(manual::completions(*shell)),
        Some(Command::Man { out }) => manual::man(out),
        Some(Command::Plugins { what }) => plugins::plugins(what),
    }
}
