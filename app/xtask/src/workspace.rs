//! Paths of the workspace, and calls of cargo and the program.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

use crate::Outcome;

/// One of the two builds.
#[derive(Clone, Copy)]
pub enum Profile {
    /// `dev`: quick to build, used by the tests.
    Dev,
    /// `release`: what a user runs.
    Release,
}

impl Profile {
    /// Returns its folder below the target folder.
    fn folder(self) -> &'static str {
        match self {
            Self::Dev => "debug",
            Self::Release => "release",
        }
    }

    /// Returns cargo's argument for the profile.
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
    /// Cargo's target folder.
    pub target: PathBuf,
}

impl Workspace {
    /// Finds both: the root from this crate's folder, which cargo reports, and the target folder from the path of this
    /// executable (`<target>/<profile>/xtask`), which honours every setting of cargo.
    /// Errors: when not started through cargo.
    pub fn find() -> Outcome<Self> {
        let crate_folder = std::env::var_os("CARGO_MANIFEST_DIR")
            .ok_or("start this program as `cargo xtask`, which reports the workspace's folder")?;
        let root = Path::new(&crate_folder)
            .ancestors()
            .nth(2)
            .ok_or("app/xtask is not inside a workspace")?
            .to_path_buf();
        let executable = std::env::current_exe()
            .map_err(|error| format!("cannot find the path of this program: {error}"))?;
        let target = executable
            .ancestors()
            .nth(2)
            .ok_or("this program is in no target folder; start it as `cargo xtask`")?
            .to_path_buf();
        Ok(Self { root, target })
    }

    /// Returns the folder of the libraries and programs of a profile.
    pub fn products(&self, profile: Profile) -> PathBuf {
        self.target.join(profile.folder())
    }

    /// Returns the path of the program.
    pub fn program(&self, profile: Profile) -> PathBuf {
        self.products(profile).join(format!("endline{}", std::env::consts::EXE_SUFFIX))
    }

    /// Runs the program in the workspace root, on the user's terminal.
    /// Errors: when it cannot be started.
    pub fn call_program(&self, profile: Profile, arguments: &[&str]) -> Outcome<ExitStatus> {
        let program = self.program(profile);
        announce("endline", arguments);
        Command::new(&program)
            .args(arguments)
            .current_dir(&self.root)
            .status()
            .map_err(|error| format!("cannot start {}: {error}", program.display()))
    }

    /// Runs cargo in the workspace root.
    /// Errors: when cargo fails; cargo prints the reason.
    pub fn cargo(&self, arguments: &[&str]) -> Outcome {
        self.cargo_with(arguments, &[])
    }

    /// Runs cargo with additional environment variables.
    /// Errors: when cargo fails; cargo prints the reason.
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

    /// Builds a benchmark; returns the path of its program.
    /// Errors: when it does not compile.
    pub fn bench(&self, package: &str, name: &str) -> Outcome<PathBuf> {
        let arguments =
            ["bench", "-p", package, "--bench", name, "--no-run", "--message-format=json"];
        announce("cargo", &arguments);
        let output = self.cargo_command(&arguments).stderr(Stdio::inherit()).output();
        let output = output.map_err(|error| format!("cannot start cargo: {error}"))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let ours = format!("\"name\":\"{name}\"");
        text.lines()
            .filter(|line| line.contains(&ours))
            .find_map(|line| line.split_once("\"executable\":\"")?.1.split('"').next())
            .filter(|_| output.status.success())
            .map(PathBuf::from)
            .ok_or_else(|| format!("`cargo {}` built no program", arguments.join(" ")))
    }

    /// Whether a cargo call succeeds; prints nothing.
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

/// Prints a command before it runs, so that every step can be repeated by hand.
pub fn announce(program: &str, arguments: &[&str]) {
    eprintln!("$ {program} {}", arguments.join(" "));
}
