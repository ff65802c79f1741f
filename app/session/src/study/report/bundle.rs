//! The folder that reproduces a study: its file, scenario and library as they were.

use std::fs;
use std::path::Path;

use endline_gear::names;

use crate::error::Error;
use crate::save::atomically;
use crate::study::prepared::PreparedStudy;

/// Commands that reproduce a report, in the folder above the bundle.
pub(super) const COMMANDS: &str = "endline study run bundle/study.toml --library bundle/gear-library --out again\n\
    endline study merge bundle/study.toml --library bundle/gear-library --out again";

/// Writes the bundle.
pub(super) fn write(opened: &PreparedStudy, folder: &Path) -> Result<(), Error> {
    let library = folder.join("gear-library");
    let named = &opened.study.scenario.value;
    let scenario = match named.ends_with(".toml") {
        true => folder.join(named),
        false => library.join("scenarios").join(format!("{named}.toml")),
    };
    // A library is known by these two folders, whatever is in them.
    for needed in ["ropes", "scenarios"] {
        let path = library.join(needed);
        fs::create_dir_all(&path).map_err(Error::on(&path, "cannot be made"))?;
    }
    put(&folder.join("study.toml"), opened.text.as_bytes())?;
    // Reading a study makes sure of it; nothing is ever written elsewhere than here.
    if named.ends_with(".toml") && !names::stays_below(named) {
        return Err(Error::at(folder, format!("the scenario {named:?} leads out of the bundle")));
    }
    put(&scenario, opened.options[opened.baseline].scenario.text().as_bytes())?;
    for (path, text) in opened.sources.iter() {
        put(&library.join(path), text.as_bytes())?;
    }
    for (path, bytes) in opened.sources.meshes() {
        put(&library.join(path), bytes)?;
    }
    put(&folder.join("README.txt"), readme(opened).as_bytes())
}

fn readme(opened: &PreparedStudy) -> String {
    format!(
        "{}\n\nStudy hash {}, seed {}, Endline {}.\nIn the folder above this one:\n\n{COMMANDS}\n\nThe table has the same bytes where program and plugins are the same.\n",
        opened.study.name,
        opened.hash,
        opened.study.seed,
        crate::VERSION
    )
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(Error::on(parent, "cannot be made"))?;
    atomically(path, bytes).map_err(Error::on(path, "cannot be written"))
}
