//! The texts and meshes of a library, in memory, so that a recording can carry them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::diagnostic::Diagnostic;
use crate::limits::LIBRARY_BYTES;
use crate::read;
use crate::schema::Kind;
use crate::whale::gltf::Form;

/// Library files by path relative to the library's folder, such as `ropes/pp-3-8.toml`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sources {
    files: BTreeMap<String, String>,
    /// Whales' own meshes and acts' animations by path, such as `whales/my-whale.glb`.
    meshes: BTreeMap<String, Vec<u8>>,
}

impl Sources {
    /// Reads every library file under a folder: `ropes/*.toml`, `traps/*.toml` and so on.
    ///
    /// # Errors
    /// For a folder that is not there or holds no library, and for each file that cannot be read.
    pub fn from_folder(root: &Path) -> Result<Self, Vec<Diagnostic>> {
        let (mut files, mut meshes) = (BTreeMap::new(), BTreeMap::new());
        let mut problems = Vec::new();
        for kind in Kind::ALL {
            read_folder(root, kind.folder(), &mut files, &mut problems);
        }
        for kind in [Kind::Whale, Kind::Act] {
            read_meshes(root, kind.folder(), &mut meshes, &mut problems);
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

    /// The meshes and animations that lie beside a library file, such as `whales/right-whale.toml`, without any text; and a problem
    /// for each one that cannot be read.
    #[must_use]
    pub fn beside(file: &Path) -> (Self, Vec<Diagnostic>) {
        let folder = file.parent().unwrap_or(Path::new(""));
        let root = folder.parent().unwrap_or(Path::new(""));
        let name = folder.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
        let (mut meshes, mut problems) = (BTreeMap::new(), Vec::new());
        read_meshes(root, &name, &mut meshes, &mut problems);
        (Self { files: BTreeMap::new(), meshes }, problems)
    }

    /// Refuses more than a recording can carry.
    fn too_large(&self, root: &Path) -> Option<Diagnostic> {
        let bytes = self.files.values().map(String::len).chain(self.meshes.values().map(Vec::len));
        let (whole, most) = (bytes.sum::<usize>() as u64 >> 20, LIBRARY_BYTES >> 20);
        (whole > most).then(|| {
            let message = format!("the files of this library come to {whole} MiB");
            let help = format!(
                "at most {most} MiB are read, because a recording carries them; take meshes out"
            );
            Diagnostic::of_file(root.display().to_string(), message, help)
        })
    }

    /// From texts by path, without meshes.
    #[must_use]
    pub fn from_map(files: BTreeMap<String, String>) -> Self {
        Self { files, meshes: BTreeMap::new() }
    }

    /// These with the meshes of another set.
    #[must_use]
    pub fn with_meshes_of(mut self, other: &Self) -> Self {
        self.meshes.clone_from(&other.meshes);
        self
    }

    /// These with another set laid over them: its files take the place of those of the same path.
    #[must_use]
    pub fn overlay(mut self, over: Self) -> Self {
        self.files.extend(over.files);
        self.meshes.extend(over.meshes);
        self
    }

    /// Only the files of one folder, such as `acts`.
    #[must_use]
    pub fn of_folder(&self, folder: &str) -> Self {
        fn kept<T: Clone>(all: &BTreeMap<String, T>, folder: &str) -> BTreeMap<String, T> {
            let inside =
                |path: &String| path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'));
            all.iter()
                .filter(|(path, _)| inside(path))
                .map(|(path, content)| (path.clone(), content.clone()))
                .collect()
        }
        Self { files: kept(&self.files, folder), meshes: kept(&self.meshes, folder) }
    }

    /// These files with a folder put before every path.
    #[must_use]
    pub fn under(&self, folder: &str) -> Self {
        fn moved<T: Clone>(all: &BTreeMap<String, T>, folder: &str) -> BTreeMap<String, T> {
            all.iter()
                .map(|(path, content)| (format!("{folder}/{path}"), content.clone()))
                .collect()
        }
        Self { files: moved(&self.files, folder), meshes: moved(&self.meshes, folder) }
    }

    /// Only the files of these paths, such as a model was made from.
    #[must_use]
    pub fn only(&self, paths: &[String]) -> Self {
        fn kept<T: Clone>(all: &BTreeMap<String, T>, paths: &[String]) -> BTreeMap<String, T> {
            all.iter()
                .filter(|(path, _)| paths.contains(path))
                .map(|(path, content)| (path.clone(), content.clone()))
                .collect()
        }
        Self { files: kept(&self.files, paths), meshes: kept(&self.meshes, paths) }
    }

    /// Paths and texts, by path.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }

    /// The text of a file.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&str> {
        self.files.get(path).map(String::as_str)
    }

    /// Paths and bytes of the meshes, by path.
    pub fn meshes(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.meshes.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice()))
    }

    /// The bytes of a mesh.
    #[must_use]
    pub fn mesh(&self, path: &str) -> Option<&[u8]> {
        self.meshes.get(path).map(Vec::as_slice)
    }

    /// Puts a mesh in the place of another, or adds it.
    pub fn set_mesh(&mut self, path: impl Into<String>, bytes: Vec<u8>) {
        self.meshes.insert(path.into(), bytes);
    }

    /// Puts a text in the place of a file's, or adds it.
    pub fn set(&mut self, path: impl Into<String>, text: impl Into<String>) {
        self.files.insert(path.into(), text.into());
    }
}

fn read_folder(
    root: &Path,
    folder: &str,
    files: &mut BTreeMap<String, String>,
    problems: &mut Vec<Diagnostic>,
) {
    let Ok(entries) = fs::read_dir(root.join(folder)) else { return };
    for path in entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
    {
        let name =
            path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        match read::text(&path) {
            Ok(text) => {
                files.insert(format!("{folder}/{name}"), text);
            }
            Err(error) => {
                let help = "a library file is text in UTF-8 that you may read";
                problems.push(Diagnostic::of_file(
                    format!("{folder}/{name}"),
                    format!("cannot be read: {error}"),
                    help,
                ));
            }
        }
    }
}

/// Whales' meshes and acts' animations, `whales/*.glb`, `acts/*.glb` and the same as `.gltf`.
fn read_meshes(
    root: &Path,
    folder: &str,
    meshes: &mut BTreeMap<String, Vec<u8>>,
    problems: &mut Vec<Diagnostic>,
) {
    let Ok(entries) = fs::read_dir(root.join(folder)) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name =
            path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if Form::of_file(&name).is_none() {
            continue;
        }
        match read::mesh(&path) {
            Ok(bytes) => {
                meshes.insert(format!("{folder}/{name}"), bytes);
            }
            Err(error) => {
                problems.push(Diagnostic::of_file(
                    format!("{folder}/{name}"),
                    format!("cannot be read: {error}"),
                    "a mesh is a file you may read",
                ));
            }
        }
    }
}
