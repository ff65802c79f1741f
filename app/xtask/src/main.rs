//! The house's own chores, run as `cargo xtask <chore>` from anywhere in the workspace.
//!
//! Standard library only: this is the first thing a newcomer compiles, before any system package is there.

mod driven;
mod long_tests;
mod materials;
mod package;
mod plugins;
mod processors;
mod python;
mod run;
mod shape;
mod system_packages;
mod test;
mod workspace;

use std::process::ExitCode;

use shape::Part;
use workspace::{Profile, Workspace};

/// What every chore gives: nothing, or a sentence for the user.
type Outcome<T = ()> = Result<T, String>;

const USAGE: &str = "\
usage: cargo xtask run [-- ARGUMENTS]    install what is missing, build in release, open the workbench
                                         (with no display: simulate the bundled encounter and draw it);
                                         ARGUMENTS, where given, go to the program instead
       cargo xtask test                  install what is missing, then run the whole test suite; where Xvfb,
                                         xdotool and imagemagick are, drive the window too
       cargo xtask test --quick          only formatting, lints, the tests inside the crates, the rules of the
                                         workspace, the golden states and calls of the program
       cargo xtask golden                write the table of golden states anew, after the physics was changed
                                         on purpose
       cargo xtask fuzz --hours N        feed damaged files to every reader, and damaged scenarios to the solver, for
                                         N hours; print inputs, panics, hangs and memory
       cargo xtask soak --hours N        run random sessions of the window for N hours, with faults and kills, and look
                                         after each for what is lost or broken
       cargo xtask window                only drive the window that was built
       cargo xtask slurm                 run a study on a Slurm of one node begun for it, as root, where Slurm is installed
       cargo xtask windows               build for Windows and run it under Wine, where Wine and mingw-w64 are installed;
                                         hashes and tables must be those of this system
       cargo xtask processors            run the golden states on older x86-64 processors and on ARM, emulated by qemu,
                                         where that is installed
       cargo xtask plugins [--release]   build the plugins that ship with Endline and put them beside the program
       cargo xtask package               build a portable archive and a Debian package of the release
       cargo xtask python [--release]    build the Python package as a wheel, install it in a virtual environment and
                                         run its tests
       cargo xtask shape [all | sizes | circles] [PACKAGE]
                                         print how large files and functions are, and which files name each
                                         other in circles; PACKAGE is the folder of one, such as sim";

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

/// What is done in the workspace.
type Chore<'a> = Box<dyn Fn(&Workspace) -> Outcome + 'a>;

/// The chore that these words ask for; `None` where there is no such chore.
fn chore<'a>(words: &'a [&'a str]) -> Option<Chore<'a>> {
    Some(match words {
        ["run"] => Box::new(run::run),
        ["run", "--", program @ ..] => Box::new(|workspace| run::run_with(workspace, program)),
        ["test"] => Box::new(test::test),
        ["test", "--quick"] => Box::new(test::quick),
        ["golden"] => Box::new(test::write_golden),
        [which @ ("fuzz" | "soak"), "--hours", hours] => {
            let hours: f64 = hours.parse().ok().filter(|hours| *hours > 0.0)?;
            let test = if *which == "fuzz" { long_tests::fuzz } else { long_tests::soak };
            Box::new(move |workspace| test(workspace, hours))
        }
        ["window"] => Box::new(driven::window),
        ["package"] => Box::new(package::package),
        ["slurm"] => Box::new(driven::slurm),
        ["windows"] => Box::new(driven::windows),
        ["processors"] => Box::new(processors::emulate),
        ["plugins"] => Box::new(|workspace| plugins::build(workspace, Profile::Dev)),
        ["plugins", "--release"] => {
            Box::new(|workspace| plugins::build(workspace, Profile::Release))
        }
        ["python"] => Box::new(|workspace| python::test(workspace, Profile::Dev)),
        ["python", "--release"] => Box::new(|workspace| python::test(workspace, Profile::Release)),
        ["shape"] => Box::new(|workspace| shape::print(workspace, Part::All, None)),
        ["shape", part, package @ ..] if package.len() < 2 => {
            let part = Part::named(part)?;
            Box::new(move |workspace| shape::print(workspace, part, package.first().copied()))
        }
        _ => return None,
    })
}
