//! Files and tables of a gear library in lists on screen.

use std::path::{Path, PathBuf};

use endline_gear::{Document, Kind};
use endline_session::locate;
pub use endline_session::locate::{scenarios, studies};

/// File and name of each observation of a library.
pub fn observations(root: &Path) -> Vec<(PathBuf, String)> {
    let named = |path: PathBuf| {
        let text = endline_gear::read::text(&path).ok();
        let name = text.and_then(|text| Document::parse(&text).ok()?.get("name"));
        let name = name.unwrap_or_else(|| stem(&path));
        (path, name)
    };
    locate::observations(root).into_iter().map(named).collect()
}

/// Name of a file without folder and extension.
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Shows a folder in the file manager of the system, or opens a file with its default program.
pub fn open_folder(folder: &Path) -> Result<(), String> {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let opened = std::process::Command::new(program).arg(folder).spawn();
    opened
        .map(|_| ())
        .map_err(|error| format!("{}: {program} cannot show it: {error}", folder.display()))
}

/// Kinds with a table and the title of its tab, in the order of the tabs.
pub const KINDS: [(Kind, &str); 9] = [
    (Kind::Rope, "Ropes"),
    (Kind::Trap, "Traps"),
    (Kind::Buoy, "Buoys"),
    (Kind::WeakLink, "Weak links"),
    (Kind::Knot, "Knots"),
    (Kind::Anchor, "Anchors"),
    (Kind::Site, "Sites"),
    (Kind::Friction, "Friction"),
    (Kind::Whale, "Whales"),
];
