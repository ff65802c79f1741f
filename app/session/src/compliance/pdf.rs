//! A page as PDF, printed by a browser that is installed: Chromium, Chrome or Edge without a window.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::error::Error;

/// Names under which browsers are installed, those looked for first.
const BROWSERS: [&str; 6] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "microsoft-edge",
];

/// Names the browser to use, by its program.
const CHOICE: &str = "ENDLINE_BROWSER";

/// Prints an HTML file.
///
/// # Errors
/// No browser, or one that writes no file.
pub fn print(html: &Path, pdf: &Path) -> Result<(), Error> {
    let browser = browser().ok_or_else(|| {
        Error::at(
            pdf,
            format!(
                "cannot be made: no browser was found; install one of {}, name its program in {CHOICE}, or print {} from any browser",
                BROWSERS.join(", "),
                html.display()
            ),
        )
    })?;
    let failed =
        |why: String| Error::at(pdf, format!("cannot be made: {}: {why}", browser.display()));
    let whole = |path: &Path| std::path::absolute(path).map_err(|error| failed(error.to_string()));
    let (from, to) = (whole(html)?, whole(pdf)?);
    // A file from before must not pass for the new one.
    if to.exists() {
        std::fs::remove_file(&to).map_err(|error| failed(error.to_string()))?;
    }
    let mut option = OsString::from("--print-to-pdf=");
    option.push(&to);
    let mut command = Command::new(&browser);
    command.args(["--headless", "--disable-gpu", "--no-pdf-header-footer"]);
    if runs_as_root() {
        // Chromium's sandbox refuses root, as in a container; the page holds no script.
        command.arg("--no-sandbox");
    }
    command.arg(option).arg(from).stdout(Stdio::null()).stderr(Stdio::piped());
    let output = command.output().map_err(|error| failed(error.to_string()))?;
    if to.is_file() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(failed(format!("{}: {}", output.status, said.lines().last().unwrap_or("it said nothing"))))
}

/// The browser chosen, or the first that is installed.
fn browser() -> Option<PathBuf> {
    if let Some(chosen) = std::env::var_os(CHOICE) {
        return Some(chosen.into());
    }
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    BROWSERS.iter().find_map(|name| {
        folders.iter().map(|folder| folder.join(name)).find(|program| program.is_file())
    })
}

#[cfg(unix)]
fn runs_as_root() -> bool {
    rustix::process::geteuid().is_root()
}

#[cfg(not(unix))]
fn runs_as_root() -> bool {
    false
}
