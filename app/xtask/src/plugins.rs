//! Builds the plugins that ship with Endline as libraries, in the folder where the program finds plugins.

use std::fs;
use std::path::Path;

use crate::Outcome;
use crate::workspace::{Profile, Workspace};

/// The crates; each is one library.
const CRATES: [&str; 3] =
    ["endline-whale-motions", "endline-friction-models", "endline-gear-types"];

/// The symbol that every plugin library exports if built with its feature `entry`.
const ENTRY: &str = "endline_plugin_entry";

/// Builds the plugins and copies them to `<target>/<profile>/plugins`.
///
/// This is a separate cargo call: with `entry`, each library exports the same symbol. A build of the whole workspace would
/// link them together into tests.
/// Errors: when cargo fails, or a library cannot be copied.
pub fn build(workspace: &Workspace, profile: Profile) -> Outcome {
    let mut arguments = vec!["build", profile.flag(), "--lib", "--features", "entry"];
    arguments.extend(CRATES.iter().flat_map(|name| ["--package", name]));
    workspace.cargo(&arguments)?;
    let products = workspace.products(profile);
    let folder = products.join("plugins");
    fs::create_dir_all(&folder)
        .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    for name in CRATES {
        let library = format!(
            "{}{}{}",
            std::env::consts::DLL_PREFIX,
            name.replace('-', "_"),
            std::env::consts::DLL_SUFFIX
        );
        place(&products.join(&library), &folder.join(&library))?;
    }
    eprintln!("{} plugins in {}", CRATES.len(), folder.display());
    Ok(())
}

/// Copies a library by a temporary file and a rename, so that a program that has the old one open keeps a complete file.
fn place(from: &Path, to: &Path) -> Outcome {
    let bytes =
        fs::read(from).map_err(|error| format!("cannot read {}: {error}", from.display()))?;
    if !bytes.windows(ENTRY.len()).any(|window| window == ENTRY.as_bytes()) {
        return Err(format!(
            "{} does not export {ENTRY}: build its crate with the feature `entry`",
            from.display()
        ));
    }
    let beside = to.with_extension("new");
    fs::write(&beside, bytes)
        .and_then(|()| fs::rename(&beside, to))
        .map_err(|error| format!("cannot write {}: {error}", to.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_is_placed_if_it_exports_the_entry() {
        let folder = std::env::temp_dir().join(format!("endline-xtask-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (built, placed) = (folder.join("built.so"), folder.join("placed.so"));
        fs::write(&placed, "the old library").unwrap();

        fs::write(&built, "a library without").unwrap();
        assert!(
            place(&built, &placed).unwrap_err().contains("does not export endline_plugin_entry")
        );
        assert_eq!(fs::read(&placed).unwrap(), b"the old library");

        fs::write(&built, "a library with endline_plugin_entry in it").unwrap();
        place(&built, &placed).unwrap();
        assert_eq!(fs::read(&placed).unwrap(), fs::read(&built).unwrap());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "the temporary file is gone");
        fs::remove_dir_all(&folder).unwrap();
    }
}
