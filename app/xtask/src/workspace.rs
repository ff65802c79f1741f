//! Where things are, and how cargo and the program are called.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

use crate::Outcome;

/// Which of the two builds.
#[derive(Clone, Copy)]
pub enum Profile {
    /// `dev`: quick to build, used by the tests.
    Dev,
    /// `release`: what a user runs.
    Release,
}

impl Profile {
    /// Its folder under the target folder.
    fn folder(self) -> &'static str {
        match self {
            Self::Dev => "debug",
            Self::Release => "release",
        }
    }

    /// What to tell cargo.
    pub fn flag(self) -> &'static str {
        match self {
            Self::Dev => "--profile=dev",
            Self::Release => "--release",
        }
    }
}

/// The checkout and its target folder.
pub struct Workspace {
    /// Folder of the workspace's Cargo.toml.
    pub root: PathBuf,
    /// Cargo's target folder, wherever the user's settings put it.
    pub target: PathBuf,
}

impl Workspace {
    /// Finds both: the root from the place cargo says this crate has, the target folder from the place of
    /// this very executable (`<target>/<profile>/xtask`), which honours every setting cargo knows.
    ///
    /// # Errors
    /// When not started through cargo.
    pub fn find() -> Outcome<Self> {
        let crate_folder = std::env::var_os("CARGO_MANIFEST_DIR")
            .ok_or("start me as `cargo xtask`, so that I know where the workspace is")?;
        let root = Path::new(&crate_folder)
            .ancestors()
            .nth(2)
            .ok_or("app/xtask is not inside a workspace")?
            .to_path_buf();
        let executable = std::env::current_exe()
            .map_err(|error| format!("cannot tell where I run from: {error}"))?;
        let target = executable
            .ancestors()
            .nth(2)
            .ok_or("I do not run from a target folder; start me as `cargo xtask`")?
            .to_path_buf();
        Ok(Self { root, target })
    }

    /// Folder of the libraries and programs of a profile.
    pub fn products(&self, profile: Profile) -> PathBuf {
        self.target.join(profile.folder())
    }

    /// The program.
    pub fn program(&self, profile: Profile) -> PathBuf {
        self.products(profile).join(format!("endline{}", std::env::consts::EXE_SUFFIX))
    }

    /// Runs the program in the workspace root, on the user's own terminal.
    ///
    /// # Errors
    /// When it cannot be started.
    pub fn call_program(&self, profile: Profile, arguments: &[&str]) -> Outcome<ExitStatus> {
        let program = self.program(profile);
        announce("endline", arguments);
        Command::new(&program)
            .args(arguments)
            .current_dir(&self.root)
            .status()
            .map_err(|error| format!("cannot start {}: {error}", program.display()))
    }

    /// Runs cargo in the workspace root and insists that it succeeds.
    ///
    /// # Errors
    /// When cargo fails; it has said why itself.
    pub fn cargo(&self, arguments: &[&str]) -> Outcome {
        self.cargo_with(arguments, &[])
    }

    /// Runs cargo with these variables in its environment, and insists that it succeeds.
    ///
    /// # Errors
    /// When cargo fails; it has said why itself.
    pub fn cargo_with(&self, arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
        announce("cargo", arguments);
        let status = self
            .cargo_command(arguments)
            .envs(variables.iter().copied())
            .status()
            .map_err(|error| format!("cannot start cargo: {error}"))?;
        if status.success() {
            Ok(())
        } else {
            Err(format!("`cargo {}` failed, see above", arguments.join(" ")))
        }
    }

    /// Whether a cargo call succeeds; shows nothing.
    pub fn quiet_cargo(&self, arguments: &[&str]) -> bool {
        let quiet =
            self.cargo_command(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status();
        quiet.is_ok_and(|status| status.success())
    }

    fn cargo_command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.args(arguments).current_dir(&self.root).env("CARGO_TARGET_DIR", &self.target);
        command
    }
}

/// Shows a command before it runs, so that every step can be repeated by hand.
pub fn announce(program: &str, arguments: &[&str]) {
    eprintln!("$ {program} {}", arguments.join(" "));
}
