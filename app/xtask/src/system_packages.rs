//! System packages: which are needed, which are missing, and how to install them.

use std::process::{Command, Stdio};

use crate::Outcome;
use crate::workspace::announce;

/// To compile: the C linker, and libudev for the gamepad.
const BUILD: [&str; 4] = ["gcc", "libc6-dev", "pkg-config", "libudev-dev"];

/// To draw, on a screen or without one.
const DRAW: [&str; 2] = ["libegl1", "libgl1-mesa-dri"];

/// To open a window on X11; they are loaded only when the window opens.
const WINDOW: [&str; 5] = ["libx11-6", "libxcursor1", "libxi6", "libxkbcommon-x11-0", "libudev1"];

/// Ensures the packages for building, drawing and opening a window.
/// Errors: when a package needed to compile is missing and cannot be installed.
pub fn ensure_for_run() -> Outcome {
    ensure(&[DRAW.as_slice(), &WINDOW].concat())
}

/// Ensures the packages for building and testing; tests draw but open no window.
/// Errors: when a package needed to compile is missing and cannot be installed.
pub fn ensure_for_test() -> Outcome {
    ensure(&DRAW)
}

/// Installs missing packages, or prints the command that does. Packages of `later` may remain missing.
fn ensure(later: &[&'static str]) -> Outcome {
    if !on_path("dpkg-query") {
        eprintln!(
            "this is not Debian: install the equivalents of its packages {} {}",
            BUILD.join(" "),
            later.join(" ")
        );
        return Ok(());
    }
    let (build, later) = (missing(&BUILD), missing(later));
    let all = [build.as_slice(), &later].concat();
    if all.is_empty() {
        return Ok(());
    }
    eprintln!("missing system packages: {}", all.join(" "));
    if let Some(prefix) = administrator() {
        return install(prefix, &all);
    }
    eprintln!(
        "no permission to install them; run this command, then the former one again:\n\n    sudo apt-get {INSTALL} {}\n",
        all.join(" ")
    );
    if build.is_empty() { Ok(()) } else { Err(format!("cannot build without {}", build.join(" "))) }
}

fn missing(packages: &[&'static str]) -> Vec<&'static str> {
    packages.iter().filter(|name| !is_present(name)).copied().collect()
}

fn is_present(name: &str) -> bool {
    // Any compiler driver and any pkg-config is sufficient; dpkg reports libraries.
    match name {
        "gcc" if on_path("cc") => return true,
        "pkg-config" if on_path("pkg-config") => return true,
        _ => {}
    }
    let answer = Command::new("dpkg-query")
        .args(["--show", "--showformat=${db:Status-Status}\\n", name])
        .stderr(Stdio::null())
        .output();
    // One line for each architecture that knows the package.
    answer.is_ok_and(|answer| {
        String::from_utf8_lossy(&answer.stdout).lines().any(|status| status == "installed")
    })
}

/// Whether there is a program of this name.
pub fn on_path(command: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&folders).any(|folder| folder.join(command).is_file())
}

/// Whether all programs that `what` needs are installed; prints the first missing one, with the Debian packages.
pub fn are_here(what: &str, programs: &[&str], packages: &str) -> bool {
    let missing = programs.iter().find(|program| !on_path(program));
    if let Some(missing) = missing {
        eprintln!("skipped: {what} needs {missing}; Debian: apt-get install {packages}");
    }
    missing.is_none()
}

/// Returns the prefix of a command with administrator rights: nothing for root, `sudo -n` if it needs no password.
fn administrator() -> Option<&'static [&'static str]> {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|answer| answer.stdout == b"0\n");
    if is_root {
        return Some(&[]);
    }
    let sudo = Command::new("sudo")
        .args(["-n", "true"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    sudo.is_ok_and(|status| status.success()).then_some(&["sudo", "-n"])
}

const INSTALL: &str = "install --yes --no-install-recommends";

fn install(prefix: &[&str], packages: &[&str]) -> Outcome {
    // A new machine has no package lists, and stale lists name files that no longer exist.
    if let Err(message) = apt_get(prefix, &["update", "--quiet"]) {
        eprintln!("{message}; the present package lists are used");
    }
    let install: Vec<&str> = INSTALL.split(' ').chain(packages.iter().copied()).collect();
    apt_get(prefix, &install)
}

fn apt_get(prefix: &[&str], arguments: &[&str]) -> Outcome {
    // `env` inside sudo, because sudo clears the environment.
    let words = [prefix, &["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"], arguments].concat();
    announce(words[0], &words[1..]);
    let status = Command::new(words[0])
        .args(&words[1..])
        .status()
        .map_err(|error| format!("cannot start {}: {error}", words[0]))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("`apt-get {}` failed, see above", arguments.join(" ")))
    }
}
