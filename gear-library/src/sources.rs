//! The texts and meshes of a library in memory; a recording contains them.

use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

use serde::{Deserialize, Serialize};

use crate::diagnostic::{At, Diagnostic, hint};
use crate::fields::Problems;
use crate::limits::LIBRARY_BYTES;
use crate::read;
use crate::schema::Kind;
use crate::whale::gltf::Form;

/// Library files by path relative to the library's folder, such as `ropes/pp-3-8.toml`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sources {
    files: BTreeMap<String, String>,
    /// Meshes of whales and animations of acts by path, such as `whales/my-whale.glb`.
    meshes: BTreeMap<String, Vec<u8>>,
}

impl Sources {
    /// Reads the library files under a folder: `ropes/*.toml`, `traps/*.toml` and so on. `Err` has a problem for each unreadable
    /// file, or for a folder without a library.
    pub fn from_folder(root: &Path) -> Result<Self, Vec<Diagnostic>> {
        let (mut files, mut meshes) = (BTreeMap::new(), BTreeMap::new());
        let mut problems = Vec::new();
        for kind in Kind::ALL.iter().copied() {
            files.extend(read_texts(root, kind.folder(), &mut problems));
        }
        for kind in [Kind::Whale, Kind::Act] {
            meshes.extend(read_meshes(root, kind.folder(), &mut problems));
        }
        if files.is_empty() && problems.is_empty() {
            let help = "a gear library has folders ropes, traps, buoys, weak-links, anchors, sites, friction, whales, assemblies";
            problems.push(Diagnostic::of_file(
                root.display().to_string(),
                "no gear library in this folder",
                help,
            ));
        }
        let sources = Self { files, meshes };
        problems.extend(sources.too_large(root));
        if problems.is_empty() { Ok(sources) } else { Err(problems) }
    }

    /// The meshes and animations beside a library file, such as `whales/right-whale.toml`, and a problem for each
    /// unreadable one.
    pub fn beside(file: &Path) -> (Self, Vec<Diagnostic>) {
        let folder = file.parent().unwrap_or(Path::new(""));
        let root = folder.parent().unwrap_or(Path::new(""));
        let name = folder.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
        let mut problems = Vec::new();
        let meshes = read_meshes(root, &name, &mut problems).into_iter().collect();
        (Self { files: BTreeMap::new(), meshes }, problems)
    }

    /// Reports a library that is too large for a recording.
    fn too_large(&self, root: &Path) -> Option<Diagnostic> {
        let bytes = self.files.values().map(String::len).chain(self.meshes.values().map(Vec::len));
        let (whole, most) = (bytes.sum::<usize>() as u64 >> 20, LIBRARY_BYTES >> 20);
        (whole > most).then(|| {
            let message = format!("the files of this library have {whole} MiB");
            let help = format!(
                "at most {most} MiB are read, because a recording contains them; remove meshes"
            );
            Diagnostic::of_file(root.display().to_string(), message, help)
        })
    }

    /// From texts by path, without meshes.
    pub fn from_map(files: BTreeMap<String, String>) -> Self {
        Self { files, meshes: BTreeMap::new() }
    }

    /// These files with the meshes of another set.
    pub fn with_meshes_of(mut self, other: &Self) -> Self {
        self.meshes.clone_from(&other.meshes);
        self
    }

    /// These files overridden by those of another set.
    pub fn overlay(mut self, over: Self) -> Self {
        self.files.extend(over.files);
        self.meshes.extend(over.meshes);
        self
    }

    /// Only the files of one folder, such as `acts`.
    pub fn of_folder(&self, folder: &str) -> Self {
        self.filtered(|path| path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/')))
    }

    /// These files with a folder before each path.
    pub fn under(&self, folder: &str) -> Self {
        fn moved<T: Clone>(all: &BTreeMap<String, T>, folder: &str) -> BTreeMap<String, T> {
            all.iter()
                .map(|(path, content)| (format!("{folder}/{path}"), content.clone()))
                .collect()
        }
        Self { files: moved(&self.files, folder), meshes: moved(&self.meshes, folder) }
    }

    /// Only the files of these paths.
    pub fn only(&self, paths: &[String]) -> Self {
        self.filtered(|path| paths.iter().any(|wanted| wanted == path))
    }

    fn filtered(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
        let (mut files, mut meshes) = (self.files.clone(), self.meshes.clone());
        files.retain(|path, _| is_wanted(path));
        meshes.retain(|path, _| is_wanted(path));
        Self { files, meshes }
    }

    /// Paths and texts, by path.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }

    /// The text of a file.
    pub fn get(&self, path: &str) -> Option<&str> {
        self.files.get(path).map(String::as_str)
    }

    /// Paths and bytes of the meshes, by path.
    pub fn meshes(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.meshes.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice()))
    }

    /// The bytes of a mesh.
    pub fn mesh(&self, path: &str) -> Option<&[u8]> {
        self.meshes.get(path).map(Vec::as_slice)
    }

    /// The bytes of a mesh that a file names; a missing one is reported.
    pub(crate) fn named_mesh(&self, path: &At<String>, problems: &Problems) -> Option<&[u8]> {
        let bytes = self.mesh(&path.value);
        if bytes.is_none() {
            let help = hint(&path.value, self.meshes.keys().map(String::as_str));
            problems.push(path.place.error(format!("there is no file `{}`", path.value), help));
        }
        bytes
    }

    /// Sets a mesh.
    pub fn set_mesh(&mut self, path: impl Into<String>, bytes: Vec<u8>) {
        self.meshes.insert(path.into(), bytes);
    }

    /// Sets the text of a file.
    pub fn set(&mut self, path: impl Into<String>, text: impl Into<String>) {
        self.files.insert(path.into(), text.into());
    }
}

/// Reads the texts of a folder, `*.toml`.
fn read_texts(root: &Path, folder: &str, problems: &mut Vec<Diagnostic>) -> Vec<(String, String)> {
    let help = "a library file is text in UTF-8 that you may read";
    read_files(root, folder, (|name| name.ends_with(".toml"), read::text), help, problems)
}

/// Reads the meshes of whales and the animations of acts in a folder, `*.glb` and `*.gltf`.
fn read_meshes(
    root: &Path,
    folder: &str,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(String, Vec<u8>)> {
    let is_mesh = |name: &str| Form::of_file(name).is_some();
    read_files(root, folder, (is_mesh, read::mesh), "a mesh is a file you may read", problems)
}

/// Reads the wanted files of a folder by path; an unreadable one is reported.
fn read_files<T>(
    root: &Path,
    folder: &str,
    (is_wanted, read): (impl Fn(&str) -> bool, impl Fn(&Path) -> io::Result<T>),
    help: &str,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(String, T)> {
    let Ok(entries) = fs::read_dir(root.join(folder)) else { return Vec::new() };
    let mut files = Vec::new();
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if !is_wanted(&name) {
            continue;
        }
        let path = format!("{folder}/{name}");
        match read(&entry.path()) {
            Ok(content) => files.push((path, content)),
            Err(error) => {
                problems.push(Diagnostic::of_file(path, format!("cannot be read: {error}"), help));
            }
        }
    }
    files
}
