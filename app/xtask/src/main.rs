//! The house's own chores, run as `cargo xtask <chore>` from anywhere in the workspace.
//!
//! Standard library only: this is the first thing a newcomer compiles, before any system package is there.

mod packages;
mod plugins;
mod run;
mod test;
mod window;
mod workspace;

use std::process::ExitCode;

use workspace::{Profile, Workspace};

/// What every chore gives: nothing, or a sentence for the user.
type Outcome<T = ()> = Result<T, String>;

const USAGE: &str = "\
usage: cargo xtask run [-- ARGUMENTS]    install what is missing, build in release, open the workbench
                                         (with no display: simulate the bundled encounter and draw it);
                                         ARGUMENTS, where given, go to the program instead
       cargo xtask test                  install what is missing, then run the whole test suite; where Xvfb, xdotool and
                                         imagemagick are, drive the window too
       cargo xtask window                only drive the window that was built
       cargo xtask plugins [--release]   build the plugins that ship with Endline and put them beside the program";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["run"] => Workspace::find().and_then(|workspace| run::run(&workspace)),
        ["run", "--", program @ ..] => {
            Workspace::find().and_then(|workspace| run::run_with(&workspace, program))
        }
        ["test"] => Workspace::find().and_then(|workspace| test::test(&workspace)),
        ["window"] => Workspace::find().and_then(|workspace| window::drive(&workspace)),
        ["plugins"] => {
            Workspace::find().and_then(|workspace| plugins::build(&workspace, Profile::Dev))
        }
        ["plugins", "--release"] => {
            Workspace::find().and_then(|workspace| plugins::build(&workspace, Profile::Release))
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}
