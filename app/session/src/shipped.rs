//! The gear library that comes inside the program: written to the user's data folder where no other is found.
//!
//! What is written is the user's to edit. A later version of the program brings its own files up to date and leaves alone those
//! that were edited: `.shipped` beside them lists the BLAKE3 of every file as it was written.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use endline_gear::read;

use crate::error::Error;
use crate::plugins::data_folder;
use crate::save;

/// Name of the list of the files written.
const WRITTEN: &str = ".shipped";

/// Files of a library, by their path in it with `/` between.
pub type Files = &'static [(&'static str, &'static [u8])];

/// The files inside the program, and the function that receives a line for the user.
struct Carried {
    files: Files,
    note: fn(&str),
}

static CARRIED: OnceLock<Carried> = OnceLock::new();

/// The folder that this process has written to, or seen to be up to date.
static FOLDER: OnceLock<Result<PathBuf, String>> = OnceLock::new();

/// Sets once, before a library is searched for, the files that the program carries, and the function that receives a line for the user when they
/// are written. A second call has no effect.
pub fn carry(files: Files, note: fn(&str)) {
    // Said before in this process, it stays as it was.
    let _ = CARRIED.set(Carried { files, note });
}

/// Files of the library that the program carries; none where it carries none.
pub(crate) fn carried() -> Files {
    CARRIED.get().map_or(&[], |carried| carried.files)
}

/// The user's copy of the library that the program carries, brought up to date; none where it carries none, or the user has no
/// data folder.
pub(crate) fn library() -> Option<Result<PathBuf, String>> {
    let Carried { files, note } = CARRIED.get()?;
    let folder = data_folder()?.join("gear-library");
    let unpacked = || {
        let done = unpack(files, &folder).map_err(|error| error.to_string())?;
        done.iter().for_each(|done| note(done));
        Ok(folder)
    };
    Some(FOLDER.get_or_init(unpacked).clone())
}

/// Writes files to a folder; those of them that somebody has edited stay. Returns a line for the user where anything was written.
fn unpack(files: Files, folder: &Path) -> Result<Option<String>, Error> {
    let list = folder.join(WRITTEN);
    let new = listed(files);
    let old = save::text_if_there(&list)?.unwrap_or_default();
    if old == new {
        return Ok(None);
    }
    let before: BTreeMap<&str, &str> = old
        .lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(hash, path)| (path, hash))
        .collect();
    let (mut written, mut kept) = (0, Vec::new());
    for (path, bytes) in files {
        let file = folder.join(path);
        let there = read::bytes(&file).ok();
        if there.as_deref() == Some(*bytes) {
            continue;
        }
        let edited = there.is_some_and(|there| before.get(path) != Some(&hash(&there).as_str()));
        if edited {
            kept.push(*path);
            continue;
        }
        write(&file, bytes)?;
        written += 1;
    }
    write(&list, new.as_bytes())?;
    Ok(Some(summary(folder, written, &kept)))
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), Error> {
    let folder = file.parent().map_or(Ok(()), fs::create_dir_all);
    folder
        .and_then(|()| save::atomically(file, bytes))
        .map_err(Error::on(file, "cannot be written"))
}

/// The list of files as `.shipped` keeps it: a line each, hash and path.
fn listed(files: Files) -> String {
    files.iter().map(|(path, bytes)| format!("{} {path}\n", hash(bytes))).collect()
}

fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

fn summary(folder: &Path, written: usize, kept: &[&str]) -> String {
    let mut text = format!(
        "the gear library that comes with Endline was written to {} ({written} files); it is yours to edit",
        folder.display()
    );
    if !kept.is_empty() {
        text += &format!("; edited by you and left as they are: {}", kept.join(", "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: Files = &[("ropes/a.toml", b"a = 1"), ("ropes/b.toml", b"b = 1")];
    const NEW: Files =
        &[("ropes/a.toml", b"a = 2"), ("ropes/b.toml", b"b = 2"), ("ropes/deep/c.toml", b"c = 2")];

    #[test]
    fn a_newer_program_brings_its_files_up_to_date_and_leaves_edited_ones() {
        let folder = std::env::temp_dir().join(format!("endline-shipped-{}", std::process::id()));
        let read = |path: &str| fs::read_to_string(folder.join(path)).unwrap();
        assert!(unpack(OLD, &folder).unwrap().unwrap().contains("(2 files)"));
        assert_eq!(unpack(OLD, &folder).unwrap(), None, "written once");

        fs::write(folder.join("ropes/b.toml"), "b = 7").unwrap();
        fs::write(folder.join("ropes/mine.toml"), "mine").unwrap();
        let done = unpack(NEW, &folder).unwrap().unwrap();
        assert!(
            done.contains("(2 files)") && done.ends_with("left as they are: ropes/b.toml"),
            "{done}"
        );
        let found =
            ["ropes/a.toml", "ropes/b.toml", "ropes/deep/c.toml", "ropes/mine.toml"].map(read);
        assert_eq!(found, ["a = 2", "b = 7", "c = 2", "mine"]);

        // What was edited stays the user's in the version after that, too.
        let done = unpack(OLD, &folder).unwrap().unwrap();
        assert!(done.ends_with("left as they are: ropes/b.toml"), "{done}");
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_folder_that_cannot_be_written_is_named() {
        let file =
            std::env::temp_dir().join(format!("endline-shipped-file-{}", std::process::id()));
        fs::write(&file, "no folder").unwrap();
        let error = unpack(OLD, &file.join("gear-library")).unwrap_err().to_string();
        assert!(error.contains(&file.display().to_string()), "{error}");
        fs::remove_file(&file).unwrap();
    }
}
