//! A text plugin: a folder with `plugin.toml`, motion clips in `acts/` and gear types in `gear-types/`.
//!
//! ```text
//! plugin.toml            format, kind = "plugin", id, version, name, notes, source
//! acts/*.toml, *.glb     acts as in a gear library: docs/motions.md
//! gear-types/*.toml      attributes, and parts with lengths that are expressions of them: docs/gear-types.md
//! ```

mod attributes;
mod expression;
mod gear;

use std::fs;
use std::path::Path;
use std::sync::Arc;

use endline_sdk::{Act, GearType};

use crate::diagnostic::Diagnostic;
use crate::fields::{Fields, Problems};
use crate::library::Library;
use crate::schema::Kind;
use crate::sources::Sources;
use crate::tree::{self, Node};
use crate::{entry, read};

pub use gear::TextGear;

/// The file that identifies the folder of a text plugin.
pub const PLUGIN_FILE: &str = "plugin.toml";

/// Folder of gear types in a plugin.
const GEAR_TYPES: &str = "gear-types";

/// A text plugin.
#[derive(Clone)]
pub struct TextPlugin {
    /// Reverse-domain id.
    pub id: String,
    /// Version.
    pub version: String,
    /// Name shown in menus.
    pub name: String,
    /// One sentence of help.
    pub help: String,
    /// Author, and sources of its figures.
    pub about: String,
    /// Acts by id, with those of their mirror images.
    pub acts: Vec<Act>,
    /// The files of the acts, such as `acts/spy-hop.toml`.
    pub clips: Sources,
    /// Gear types.
    pub gear: Vec<Arc<dyn GearType>>,
    /// All its files, for a hash.
    pub bytes: Vec<u8>,
}

/// The heading of a plugin.
struct Head {
    id: String,
    version: String,
    name: String,
    help: String,
    about: String,
}

impl TextPlugin {
    /// Whether a folder contains a text plugin.
    pub fn is_in(folder: &Path) -> bool {
        folder.join(PLUGIN_FILE).is_file()
    }

    /// Reads a folder.
    pub fn from_folder(folder: &Path) -> Result<Self, Vec<Diagnostic>> {
        let (problems, mut bytes) = (Problems::default(), Vec::new());
        let head = text(folder, PLUGIN_FILE, &mut bytes, &problems)
            .and_then(|node| head(&node, &problems));
        let version = head.as_ref().map_or("", |head| head.version.as_str());
        let mut gear: Vec<Arc<dyn GearType>> = Vec::new();
        for path in toml_files(folder, GEAR_TYPES) {
            let Some(node) = text(folder, &path, &mut bytes, &problems) else { continue };
            gear.extend(
                TextGear::read(&node, version, &problems)
                    .map(|gear| Arc::new(gear) as Arc<dyn GearType>),
            );
        }
        let (clips, acts) = clips(folder, &mut bytes, &problems);
        if acts.is_empty() && gear.is_empty() && !problems.any_error() {
            let help = "add acts in acts/, or gear types in gear-types/";
            problems.push(Diagnostic::of_file(PLUGIN_FILE, "this plugin is empty", help));
        }
        match head {
            Some(Head { id, version, name, help, about }) if !problems.any_error() => {
                Ok(Self { id, version, name, help, about, acts, clips, gear, bytes })
            }
            _ => Err(problems.into_sorted()),
        }
    }
}

fn head(node: &Node, problems: &Problems) -> Option<Head> {
    let fields = Fields::of(node, problems);
    let (name, help, file) = entry::header(&fields, "plugin", problems);
    let id = fields.need_text("id", "write a reverse-domain id such as \"org.example.our-whales\"");
    let version = fields.need_text("version", "write a version such as \"0.1.0\"");
    fields.finish();
    Some(Head {
        id: id?.value,
        version: version?.value,
        name,
        help,
        about: file.source.unwrap_or_default(),
    })
}

/// Reads a TOML file of the folder; problems are reported with its path in the folder.
fn text(folder: &Path, path: &str, bytes: &mut Vec<u8>, problems: &Problems) -> Option<Node> {
    let text = match read::text(&folder.join(path)) {
        Ok(text) => text,
        Err(error) => {
            let help = "a plugin's file is text in UTF-8 that you may read";
            return problems.refuse(Diagnostic::of_file(
                path,
                format!("cannot be read: {error}"),
                help,
            ));
        }
    };
    add(path, text.as_bytes(), bytes);
    tree::read(path, &text).map_err(|problem| problems.push(*problem)).ok()
}

/// Adds path, length and content of a file, so that different sets of files have different bytes.
fn add(path: &str, content: &[u8], bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(format!("{path} {}\n", content.len()).as_bytes());
    bytes.extend_from_slice(content);
}

/// Paths of the TOML files of a folder within the plugin, sorted.
fn toml_files(folder: &Path, inner: &str) -> Vec<String> {
    let files = fs::read_dir(folder.join(inner))
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut files: Vec<String> = files
        .filter(|name| name.ends_with(".toml"))
        .map(|name| format!("{inner}/{name}"))
        .collect();
    files.sort();
    files
}

/// The acts and their files.
fn clips(folder: &Path, bytes: &mut Vec<u8>, problems: &Problems) -> (Sources, Vec<Act>) {
    if !folder.join(Kind::Act.folder()).is_dir() {
        return (Sources::default(), Vec::new());
    }
    let sources = match Sources::from_folder(folder) {
        Ok(sources) => sources.of_folder(Kind::Act.folder()),
        Err(found) => {
            problems.extend(found);
            return (Sources::default(), Vec::new());
        }
    };
    sources.iter().for_each(|(path, text)| add(path, text.as_bytes(), bytes));
    sources.meshes().for_each(|(path, mesh)| add(path, mesh, bytes));
    let (library, found) = Library::read(&sources);
    problems.extend(found);
    let act = |clip: &endline_sim::whale::acts::Clip| Act {
        id: clip.id.clone().into(),
        name: clip.name.clone().into(),
        help: clip.help.clone().into(),
    };
    let acts = library.acts.iter().flat_map(|item| item.clips.iter().map(act)).collect();
    (sources, acts)
}
