//! A new plugin project: a few files that build, and pass the check. A project in Rust has its own copy of the crate `endline-sdk`, so
//! that the program alone is enough to write it.

use std::path::{Path, PathBuf};
use std::{env, fs};

use super::info::PluginKind;

/// The whole C interface, as it ships.
const HEADER: &str = include_str!("../../../../../plugins/sdk/include/endline_plugin.h");

/// Language of a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Rust, on the crate `endline-sdk`.
    Rust,
    /// C, on the header alone.
    C,
    /// No language: text that the program reads, for motion clips and gear types.
    Text,
}

/// A project that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Project {
    /// Id of its plugin.
    pub id: String,
    /// Command that builds it.
    pub build: Vec<String>,
    /// Library that the command makes.
    pub library: PathBuf,
}

/// Path and text of a file of a project.
type Written = (&'static str, String);

/// Folder of the copy of `endline-sdk` within a project.
const SDK_FOLDER: &str = "endline-sdk";

/// Paths and texts of files of `plugins/sdk`, each in [`SDK_FOLDER`].
macro_rules! of_sdk {
    ($($path:literal),* $(,)?) => {
        &[$((
            concat!("endline-sdk/", $path),
            include_str!(concat!("../../../../../plugins/sdk/", $path)),
        )),*]
    };
}

/// Sources of `endline-sdk`, as they ship.
const SDK: &[(&str, &str)] = of_sdk![
    "src/abi/export/describe.rs",
    "src/abi/export/friction.rs",
    "src/abi/export/gear.rs",
    "src/abi/export/guard.rs",
    "src/abi/export/mod.rs",
    "src/abi/export/motion.rs",
    "src/abi/export/pointers.rs",
    "src/abi/mod.rs",
    "src/abi/table/friction.rs",
    "src/abi/table/gear.rs",
    "src/abi/table/mod.rs",
    "src/abi/table/motion.rs",
    "src/controls.rs",
    "src/friction.rs",
    "src/gear.rs",
    "src/hook.rs",
    "src/lib.rs",
    "src/motion.rs",
    "src/whale/mod.rs",
    "src/whale/posture.rs",
    "src/whale/skin.rs",
];

/// Writes a project into a new folder; the folder's name becomes the plugin's. `sdk` is a folder of `endline-sdk` on which a project in
/// Rust depends instead of a copy of its own.
pub fn write_project(
    folder: &Path,
    kind: PluginKind,
    language: Language,
    sdk: Option<&Path>,
) -> Result<Project, String> {
    if folder.exists() {
        return Err(format!("{} is there already; name another folder", folder.display()));
    }
    let name = name_of(folder)?;
    let kind = if language == Language::Text && kind == PluginKind::Motion {
        PluginKind::Clips
    } else {
        kind
    };
    let id = format!("org.example.{}.{name}", kind.word());
    let files = match language {
        Language::Text => in_text(kind, &name, &id)?,
        Language::Rust => in_rust(kind, &name, &id, sdk)?,
        Language::C => in_c(kind, &name, &id),
    };
    for (path, text) in &files {
        let path = folder.join(path);
        let written =
            path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&path, text));
        written.map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let library = if language == Language::Text {
        folder.to_path_buf()
    } else {
        folder.join(library(language, &name))
    };
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    let build = match language {
        Language::Rust => words(&[
            "cargo",
            "build",
            "--release",
            "--manifest-path",
            &folder.join("Cargo.toml").to_string_lossy(),
        ]),
        Language::C => words(&["make", "-C", &folder.to_string_lossy()]),
        Language::Text => Vec::new(),
    };
    Ok(Project { id, build, library })
}

/// Name of crate and plugin: the folder's.
fn name_of(folder: &Path) -> Result<String, String> {
    let name =
        folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
    if begins && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-') {
        return Ok(name);
    }
    Err(format!(
        "`{name}` is no name for a plugin; take small letters, digits and hyphens, such as slow-turn"
    ))
}

/// The folder of the crate `endline-sdk` that is named.
fn named_sdk(folder: &Path) -> Result<PathBuf, String> {
    let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_path_buf());
    let is_sdk =
        whole.join("Cargo.toml").is_file() && whole.join("include/endline_plugin.h").is_file();
    is_sdk
        .then_some(whole)
        .ok_or_else(|| format!("{} is not the folder of endline-sdk", folder.display()))
}

fn in_rust(
    kind: PluginKind,
    name: &str,
    id: &str,
    sdk: Option<&Path>,
) -> Result<Vec<Written>, String> {
    let source = match kind {
        PluginKind::Motion | PluginKind::Clips => include_str!("templates/motion.rs"),
        PluginKind::Friction => include_str!("templates/friction.rs"),
        PluginKind::Gear => include_str!("templates/gear.rs"),
    };
    let sdk = sdk.map(named_sdk).transpose()?;
    let depends_on = sdk.as_deref().unwrap_or_else(|| Path::new(SDK_FOLDER)).display().to_string();
    let manifest =
        include_str!("templates/Cargo.toml.txt").replace("@sdk@", &depends_on.replace('\\', "/"));
    let mut files = vec![
        ("Cargo.toml", manifest.replace("@name@", name)),
        ("src/lib.rs", named(source, name, id)),
        (".gitignore", "/target\n".to_owned()),
    ];
    if sdk.is_none() {
        let manifest = include_str!("templates/sdk.toml.txt");
        files.push((
            "endline-sdk/Cargo.toml",
            manifest.replace("@version@", env!("CARGO_PKG_VERSION")),
        ));
        files.extend(SDK.iter().map(|(path, text)| (*path, (*text).to_owned())));
    }
    Ok(files)
}

fn in_c(kind: PluginKind, name: &str, id: &str) -> Vec<Written> {
    let source = match kind {
        PluginKind::Motion | PluginKind::Clips => include_str!("templates/motion.c"),
        PluginKind::Friction => include_str!("templates/friction.c"),
        PluginKind::Gear => include_str!("templates/gear.c"),
    };
    let makefile = include_str!("templates/Makefile.txt");
    let whole = source.replace("@entry@", include_str!("templates/entry.c").trim_end());
    vec![
        ("plugin.c", named(&whole, name, id)),
        ("endline_plugin.h", HEADER.to_owned()),
        ("Makefile", makefile.replace("@library@", &library(Language::C, name))),
    ]
}

fn in_text(kind: PluginKind, name: &str, id: &str) -> Result<Vec<Written>, String> {
    let (path, text) = match kind {
        PluginKind::Gear => ("gear-types/simple.toml", include_str!("templates/gear.toml")),
        PluginKind::Motion | PluginKind::Clips => {
            ("acts/bend.toml", include_str!("templates/act.toml"))
        }
        PluginKind::Friction => {
            return Err("a law of friction needs code; take --lang rust or --lang c".to_owned());
        }
    };
    // The folder's own id must differ from that of a gear type in it.
    let plugin = include_str!("templates/plugin.toml").replace("@id@", &id.replace(".gear.", "."));
    Ok(vec![("plugin.toml", named(&plugin, name, id)), (path, named(text, name, id))])
}

/// A source with the plugin's id and its name in menus.
fn named(source: &str, name: &str, id: &str) -> String {
    let (first, rest) = name.split_at(1);
    source.replace("@id@", id).replace("@title@", &(first.to_uppercase() + &rest.replace('-', " ")))
}

/// File of the library within the project.
fn library(language: Language, name: &str) -> String {
    match language {
        Language::Rust => format!(
            "target/release/{}{}{}",
            env::consts::DLL_PREFIX,
            name.replace('-', "_"),
            env::consts::DLL_SUFFIX
        ),
        Language::C => format!("{name}{}", env::consts::DLL_SUFFIX),
        Language::Text => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds the paths of files below a folder, relative to `top`.
    fn list(top: &Path, folder: &Path, found: &mut Vec<String>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                list(top, &path, found);
            } else {
                let path = path.strip_prefix(top).unwrap().display().to_string();
                found.push(path.replace('\\', "/"));
            }
        }
    }

    #[test]
    fn the_copy_of_the_sdk_is_complete() {
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../plugins/sdk");
        let mut files = Vec::new();
        list(&top, &top.join("src"), &mut files);
        files.sort_unstable();
        let copied = SDK.iter().map(|(path, _)| path.strip_prefix("endline-sdk/").unwrap());
        assert!(copied.eq(files.iter().map(String::as_str)), "{files:?}");
    }
}
