//! Files that came with the program are never written over: an edited one is saved as a copy of the user's own.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use endline_gear::{Document, EditError, Setting};

use super::documents::Documents;
use super::figures;
use super::library_table::id_of;
use super::option::gather;
use super::saving::free_file;

/// Fields whose texts are never the id of another file.
const NO_IDS: [&str; 9] =
    ["id", "name", "notes", "source", "confidence", "kind", "from", "to", "gear_type"];

/// A file that came with the program, and the user's copy of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnCopy {
    /// Key of the text: its path in the library, or that of the scenario, the study or the observation.
    pub from: String,
    /// Key of the copy's text.
    pub to: String,
    /// Id of the original.
    pub id: String,
    /// File of the copy.
    pub file: PathBuf,
}

impl Documents {
    /// Whether the file of a text is as it came with the program.
    pub fn is_bundled(&self, key: &str) -> bool {
        let Some(saved) = self.saved_text(key) else { return false };
        let path = self.path_in_library(key);
        self.bundled.iter().any(|(own, bytes)| path == *own && *bytes == saved.as_bytes())
    }

    /// Path of a text's file in the library's folder, with `/` between its parts.
    fn path_in_library(&self, key: &str) -> String {
        let Some(file) = self.file_outside(key) else { return key.to_owned() };
        let inside = file.strip_prefix(&self.root).unwrap_or(file);
        let parts = inside.components().map(|part| part.as_os_str().to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    }

    /// Puts each edited text whose file came with the program under a name of the user's own, and names the copy wherever the
    /// design names the original: in unsaved texts, in the scenario and in the assemblies that it places. One undo reverts the
    /// texts.
    /// Errors: a text that is not TOML, or a name that is not free.
    pub(super) fn copy_bundled(&mut self) -> Result<Vec<OwnCopy>, String> {
        let copied = self.bundled_to_copy();
        if copied.is_empty() {
            return Ok(Vec::new());
        }
        let mut copies = Vec::new();
        for from in &copied {
            copies.push(self.own_copy(from)?);
        }
        let mut texts = Vec::new();
        for copy in &copies {
            let original = self.saved_text(&copy.from).unwrap_or_default().to_owned();
            texts.push((copy.to.clone(), Some(self.copy_text(copy, &original, &copies)?)));
            if copy.to != copy.from {
                texts.push((copy.from.clone(), Some(original)));
            }
        }
        for key in self.design().into_iter().filter(|key| !copied.contains(key)) {
            let mut document = self.document(&key)?;
            if name_copies(&mut document, &copies).map_err(|error| error.to_string())? {
                texts.push((key, Some(document.text())));
            }
        }
        for copy in copies.iter().filter(|copy| copy.to == copy.from) {
            self.move_outside(&copy.to, copy.file.clone());
        }
        self.restore(texts);
        Ok(copies)
    }

    /// Texts to be copied: those that are edited, and those of the design that name one to be copied.
    fn bundled_to_copy(&self) -> BTreeSet<String> {
        let edited = |key: &&String| self.text(key).is_some() && self.is_bundled(key);
        let mut copied: BTreeSet<String> = self.unsaved().iter().filter(edited).cloned().collect();
        let design = self.design();
        loop {
            let names_one = |key: &&String| {
                let document = self.document(key).ok();
                document.is_some_and(|document| names_any(&document, &copied))
            };
            let next = design.iter().filter(|key| !copied.contains(*key) && self.is_bundled(key));
            let more: Vec<String> = next.filter(names_one).cloned().collect();
            if copied.is_empty() || more.is_empty() {
                return copied;
            }
            copied.extend(more);
        }
    }

    /// Texts that are edited, the scenario, and the assemblies that it places.
    fn design(&self) -> BTreeSet<String> {
        let placed = self.placed_assemblies().map(|id| format!("assemblies/{id}.toml"));
        let all = self.unsaved().iter().cloned().chain([Self::SCENARIO.to_owned()]).chain(placed);
        all.filter(|key| self.text(key).is_some()).collect()
    }

    /// Key and file of the user's copy of a text.
    fn own_copy(&self, from: &str) -> Result<OwnCopy, String> {
        let file = self.file_of(from);
        let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = file.parent().unwrap_or(&self.root);
        let free = free_file(folder, &format!("{stem}-mine"));
        let file = free.ok_or_else(|| format!("{}: there are 1000 copies", file.display()))?;
        let to = match from.rsplit_once('/') {
            Some((folder, _)) => {
                format!("{folder}/{}", file.file_name().unwrap_or_default().to_string_lossy())
            }
            None => from.to_owned(),
        };
        Ok(OwnCopy { from: from.to_owned(), to, id: stem, file })
    }

    fn copy_text(
        &self,
        copy: &OwnCopy,
        original: &str,
        copies: &[OwnCopy],
    ) -> Result<String, String> {
        let failed = |error: EditError| format!("{}: {error}", copy.from);
        let mut document = self.document(&copy.from)?;
        let original = Document::parse(original).map_err(failed)?;
        if copy.to != copy.from {
            figures::mark_copied(&mut document, &copy.id, &original).map_err(failed)?;
        }
        let name = document.get("name").unwrap_or_default();
        if original.get("name").as_ref() == Some(&name) {
            let name = Setting::text(&format!("{name} (mine)"));
            document.put("name", &name).map_err(failed)?;
        }
        name_copies(&mut document, copies).map_err(failed)?;
        Ok(document.text())
    }
}

/// The folder of the library that the id in a field is looked for in; "" for any that is not named here.
fn folder_of_field(field: &str) -> &'static str {
    match field {
        "assembly" => "assemblies",
        "scenario" => "scenarios",
        "encounters" => "studies",
        _ => "",
    }
}

/// The folder of a text by its key, as [`folder_of_field`] has it.
fn folder_of(key: &str) -> &'static str {
    match key.split_once('/') {
        Some(("assemblies", _)) => "assemblies",
        Some(_) => "",
        None if key == Documents::SCENARIO => "scenarios",
        None => "studies",
    }
}

/// The name of a field in a path, such as `rope` in `line.0.rope`.
fn field_name(path: &str) -> &str {
    let mut parts = path.rsplit('.').filter(|part| part.parse::<usize>().is_err());
    parts.next().unwrap_or_default()
}

/// Fields of a document that hold the id of another file: path, folder and id.
fn ids(document: &Document) -> Vec<(String, &'static str, String)> {
    let mut leaves = Vec::new();
    gather(document, "", &mut leaves);
    let named = leaves.into_iter().filter(|leaf| !NO_IDS.contains(&field_name(leaf)));
    named
        .filter_map(|leaf| {
            let (folder, id) = (folder_of_field(field_name(&leaf)), document.get(&leaf)?);
            Some((leaf, folder, id))
        })
        .collect()
}

fn names_any(document: &Document, keys: &BTreeSet<String>) -> bool {
    let known: BTreeSet<(&str, &str)> = keys
        .iter()
        .filter(|key| key.contains('/'))
        .map(|key| (folder_of(key), id_of(key)))
        .collect();
    ids(document).iter().any(|(_, folder, id)| known.contains(&(*folder, id.as_str())))
}

/// Names the copies in the place of their originals; whether there was one.
fn name_copies(document: &mut Document, copies: &[OwnCopy]) -> Result<bool, EditError> {
    let stem = |file: &Path| file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let known: BTreeMap<(&str, &str), String> = copies
        .iter()
        .map(|copy| ((folder_of(&copy.from), copy.id.as_str()), stem(&copy.file)))
        .collect();
    let mut any = false;
    for (field, folder, id) in ids(document) {
        if let Some(own) = known.get(&(folder, id.as_str())) {
            document.set(&field, own)?;
            any = true;
        }
    }
    Ok(any)
}
