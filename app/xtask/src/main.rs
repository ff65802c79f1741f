//! Chores of the repository, run as `cargo xtask <chore>` from anywhere in the workspace.
//!
//! Standard library only: this is the first thing a newcomer compiles, before any system package is there.
#![allow(clippy::disallowed_methods, reason = "chores read the repository")]

mod driven;
mod instructions;
mod package;
mod plugins;
mod python;
mod run;
mod system_packages;
mod test;
mod workspace;

use std::process::ExitCode;

use workspace::{Profile, Workspace};

/// Result of a chore: nothing, or an error message for the user.
type Outcome<T = ()> = Result<T, String>;

const USAGE: &str = "\
usage: cargo xtask run [-- ARGUMENTS]    install what is missing, build in release, open the workbench
                                         (with no display: simulate the bundled encounter and draw it);
                                         ARGUMENTS, if any, are passed to the program instead
       cargo xtask test                  install what is missing, then run the whole test suite; drive the window
                                         too if Xvfb, xdotool and imagemagick are installed
       cargo xtask test --quick          only formatting, lints, the tests inside the crates, the rules of the
                                         workspace, the golden states and calls of the program
       cargo xtask golden                rewrite the table of golden states after an intended change of the
                                         physics
       cargo xtask instructions          count the instructions of simulated sections under Callgrind, if valgrind is
                                         installed, and compare them with the table of counts
       cargo xtask instructions --write REASON
                                         add these counts to the table, with the reason of the change
       cargo xtask fuzz --hours N        feed damaged files to every reader, and damaged scenarios to the solver, for
                                         N hours; print inputs, panics, hangs and memory
       cargo xtask soak --hours N        run random sessions of the window for N hours, with faults and kills, and check
                                         after each that nothing is lost or broken
       cargo xtask window                only drive the built window
       cargo xtask slurm                 as root, start a Slurm of one node and run a study on it, if Slurm is installed
       cargo xtask windows               build for Windows and run it under Wine, if Wine and mingw-w64 are installed;
                                         hashes and tables must equal those of this system
       cargo xtask processors            run the golden states on older x86-64 processors and on ARM, emulated by qemu,
                                         if that is installed
       cargo xtask plugins [--release]   build the plugins that ship with Endline and put them beside the program
       cargo xtask package               build a portable archive and a Debian package of the release
       cargo xtask python [--release]    build the Python package as a wheel, install it in a virtual environment and
                                         run its tests
       cargo xtask wheel                 build this wheel in release, without installing it";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let Some(chore) = chore(&words) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match Workspace::find().and_then(|workspace| chore(&workspace)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// A chore, applied to the workspace.
type Chore<'a> = Box<dyn Fn(&Workspace) -> Outcome + 'a>;

/// Returns the chore that the arguments name; `None` if there is no such chore.
fn chore<'a>(words: &'a [&'a str]) -> Option<Chore<'a>> {
    Some(match words {
        ["run"] => Box::new(run::run),
        ["run", "--", program @ ..] => Box::new(|workspace| run::run_with(workspace, program)),
        ["test"] => Box::new(test::test),
        ["test", "--quick"] => Box::new(test::quick),
        ["instructions"] => Box::new(instructions::compare),
        ["instructions", "--write", reason] => {
            Box::new(|workspace| instructions::write(workspace, reason))
        }
        ["golden"] => Box::new(test::write_golden),
        [which @ ("fuzz" | "soak"), "--hours", hours] => {
            let hours: f64 = hours.parse().ok().filter(|hours| *hours > 0.0)?;
            let test = if *which == "fuzz" { test::fuzz } else { test::soak };
            Box::new(move |workspace| test(workspace, hours))
        }
        ["window"] => Box::new(driven::window),
        ["package"] => Box::new(package::package),
        ["slurm"] => Box::new(driven::slurm),
        ["windows"] => Box::new(driven::windows),
        ["processors"] => Box::new(driven::emulate),
        ["plugins"] => Box::new(|workspace| plugins::build(workspace, Profile::Dev)),
        ["plugins", "--release"] => {
            Box::new(|workspace| plugins::build(workspace, Profile::Release))
        }
        ["python"] => Box::new(|workspace| python::test(workspace, Profile::Dev)),
        ["python", "--release"] => Box::new(|workspace| python::test(workspace, Profile::Release)),
        ["wheel"] => Box::new(|workspace| python::build(workspace, Profile::Release)),
        _ => return None,
    })
}
