//! The command line: its arguments, and the dispatch to commands.
//!
//! Exit codes: 0 done, 1 the run or check failed, 2 wrong use of the command line, 128 and the signal's number where a signal ended
//! it.

mod args;
mod check;
mod export;
mod haul;
mod host;
mod interrupt;
mod mill;
mod output;
mod picture;
mod player;
mod plugins;
mod quantity;
mod render;
mod replay;
mod rules;
mod run;
mod schema;
mod search;
mod sheet;
mod study;
mod table;
mod validate;
mod whale;

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use endline_session::shipped;

use crate::embedded;
use args::Command;

pub use args::Args;
pub use output::Failure;

/// Runs the command line.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Result<ExitCode, Failure> {
    let args = match Args::try_parse_from(arguments) {
        Ok(args) => args,
        Err(message) => return Ok(output::usage(&message)),
    };
    let library = args.library.as_deref();
    output::set_verbosity(args.verbosity());
    host::allow(args.allow_plugins);
    shipped::carry(embedded::GEAR_LIBRARY, output::note);
    match &args.command {
        None => open(library),
        Some(Command::Run(args)) => run::run(args, library),
        Some(Command::Settle(args)) => run::settle(args, library),
        Some(Command::Replay(args)) => replay::replay(args),
        Some(Command::Pilot(args)) => replay::pilot(args),
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
        Some(Command::Docs { document }) => schema::docs(document.as_deref()),
        Some(Command::Completions { shell }) => Ok(schema::completions(*shell)),
        Some(Command::Man { out }) => schema::man(out),
        Some(Command::Plugins { what }) => plugins::plugins(what),
    }
}

/// Opens the workbench, or names the reason and the alternative.
#[cfg(feature = "gui")]
fn open(library: Option<&Path>) -> Result<ExitCode, Failure> {
    if !has_display() {
        return Err(Failure::failed(
            "there is no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); use `endline run SCENARIO`, or see `endline --help`",
        ));
    }
    let plugins = host::folders();
    let options = crate::gui::Options {
        library: library.map(Path::to_path_buf),
        plugins,
        ..Default::default()
    };
    crate::gui::open(options).map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(feature = "gui")]
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// A build without a screen refuses.
#[cfg(not(feature = "gui"))]
fn open(_library: Option<&Path>) -> Result<ExitCode, Failure> {
    Err(Failure::failed(
        "this program was built without its workbench; use `endline run SCENARIO`, or see `endline --help`",
    ))
}
