//! A new plugin project: a few files that build, and pass the check.

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

/// Writes a project into a new folder; the folder's name becomes the plugin's. `sdk` is the folder of `endline-sdk`.
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
        Language::Rust => in_rust(kind, &name, &id, &find_sdk(sdk)?),
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

/// Folder of the crate `endline-sdk`: the one named, or that of Endline's source around the program or the working folder.
fn find_sdk(given: Option<&Path>) -> Result<PathBuf, String> {
    let is_sdk = |folder: &Path| {
        folder.join("Cargo.toml").is_file() && folder.join("include/endline_plugin.h").is_file()
    };
    if let Some(folder) = given {
        let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_path_buf());
        return if is_sdk(&whole) {
            Ok(whole)
        } else {
            Err(format!("{} is not the folder of endline-sdk", folder.display()))
        };
    }
    let program = env::current_exe().and_then(fs::canonicalize).ok();
    let starts: Vec<PathBuf> = program.into_iter().chain(env::current_dir().ok()).collect();
    let found = starts
        .iter()
        .flat_map(|start| start.ancestors())
        .map(|folder| folder.join("plugins/sdk"))
        .find(|folder| is_sdk(folder));
    let help = "no endline-sdk found above the program or the working folder; name it with --sdk FOLDER (plugins/sdk in Endline's source)";
    found.ok_or_else(|| help.to_owned())
}

fn in_rust(kind: PluginKind, name: &str, id: &str, sdk: &Path) -> Vec<Written> {
    let source = match kind {
        PluginKind::Motion | PluginKind::Clips => include_str!("templates/motion.rs"),
        PluginKind::Friction => include_str!("templates/friction.rs"),
        PluginKind::Gear => include_str!("templates/gear.rs"),
    };
    let manifest = include_str!("templates/Cargo.toml.txt")
        .replace("@sdk@", &sdk.display().to_string().replace('\\', "/"));
    vec![
        ("Cargo.toml", manifest.replace("@name@", name)),
        ("src/lib.rs", named(source, name, id)),
        (".gitignore", "/target\n".to_owned()),
    ]
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
