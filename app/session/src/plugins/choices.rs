//! The user's decisions about plugins: which libraries may be opened, each by the hash of its file, and which plugins are off.
//!
//! A library runs with the user's rights, so one that does not ship with the program is opened only after its user has allowed it, and
//! needs a new permission when its bytes change. An allowed library runs in a process of its own; a trusted one runs in
//! the program's. The decisions are in one text file of the user's data folder, a line each: `allow HASH FILE`,
//! `trust HASH FILE` and `off ID`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use endline_gear::read;

use crate::save;

/// Why a library waits for its user.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It was never allowed.
    New,
    /// It was allowed with other bytes.
    Changed,
}

/// A question about a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ask {
    /// BLAKE3 of the file, hexadecimal, to which the permission belongs.
    pub hash: String,
    /// Why it is asked.
    pub change: Change,
}

/// A user's decision about a library.
#[derive(Clone, Debug)]
struct Allowed {
    hash: String,
    /// Whether it may run in the program's own process.
    is_trusted: bool,
}

/// A user's decisions.
#[derive(Clone, Debug, Default)]
pub struct Choices {
    list: Option<PathBuf>,
    everything: bool,
    own: Vec<PathBuf>,
    allowed: BTreeMap<PathBuf, Allowed>,
    off: BTreeSet<String>,
}

impl Choices {
    /// Every library may be opened, no plugin is off, and no decision is stored: for programs that bring their own plugins.
    pub fn everything() -> Self {
        Self { everything: true, ..Self::default() }
    }

    /// The decisions of a file, which may not exist yet. Libraries in the folders `own` need none: they ship with the program.
    pub fn kept_in(list: Option<PathBuf>, own: &[PathBuf]) -> Self {
        let text = list.as_ref().and_then(|list| read::text(list).ok()).unwrap_or_default();
        let own = own.iter().map(|folder| whole(folder)).collect();
        let mut choices = Self { list, own, ..Self::default() };
        for line in text.lines() {
            match line.split_once(' ') {
                Some((word @ ("allow" | "trust"), rest)) => {
                    let is_trusted = word == "trust";
                    choices.allowed.extend(rest.split_once(' ').map(|(hash, file)| {
                        (PathBuf::from(file), Allowed { hash: hash.to_owned(), is_trusted })
                    }));
                }
                Some(("off", id)) => {
                    choices.off.insert(id.to_owned());
                }
                _ => {}
            }
        }
        choices
    }

    /// Whether decisions outlive this program.
    pub fn keeps(&self) -> Result<(), String> {
        if self.list.is_some() {
            return Ok(());
        }
        Err("nothing is changed: there is no folder to keep this choice in; set HOME or XDG_DATA_HOME".to_owned())
    }

    /// The question before a file of this hash is opened.
    pub fn ask(&self, file: &Path, hash: &str) -> Option<Ask> {
        let file = whole(file);
        if self.needs_no_leave(&file) {
            return None;
        }
        let change = match self.allowed.get(&file) {
            Some(allowed) if allowed.hash == hash => return None,
            Some(_) => Change::Changed,
            None => Change::New,
        };
        Some(Ask { hash: hash.to_owned(), change })
    }

    /// Whether a file runs in the program's own process: it ships with the program, or its user trusts it.
    pub fn is_trusted(&self, file: &Path) -> bool {
        let file = whole(file);
        self.needs_no_leave(&file) || self.allowed.get(&file).is_some_and(|known| known.is_trusted)
    }

    /// Whether a file, by its whole path, needs no permission.
    fn needs_no_leave(&self, file: &Path) -> bool {
        self.everything || self.own.iter().any(|folder| file.starts_with(folder))
    }

    /// Allows a file with these bytes, in a process of its own.
    pub fn allow(&mut self, file: &Path, hash: &str) -> Result<(), String> {
        self.decide(file, hash, false)
    }

    /// Allows a file with these bytes, in the program's own process.
    pub fn trust(&mut self, file: &Path, hash: &str) -> Result<(), String> {
        self.decide(file, hash, true)
    }

    fn decide(&mut self, file: &Path, hash: &str, is_trusted: bool) -> Result<(), String> {
        let file = whole(file);
        // A line break in a path would begin a line of its own, which allows another file.
        if file.to_str().is_none_or(|text| text.chars().any(char::is_control)) {
            return Err(format!(
                "{file:?}: a path with control characters, or that is not UTF-8, cannot be kept; give the file another name"
            ));
        }
        self.allowed.insert(file, Allowed { hash: hash.to_owned(), is_trusted });
        self.save()
    }

    /// Takes back that a file was allowed; false where it was not.
    pub fn forget(&mut self, file: &Path) -> Result<bool, String> {
        let known = self.allowed.remove(&whole(file)).is_some();
        self.save().map(|()| known)
    }

    /// Whether the user has switched a plugin off.
    pub fn is_off(&self, id: &str) -> bool {
        self.off.contains(id)
    }

    /// Switches a plugin off, or on again.
    pub fn switch(&mut self, id: &str, on: bool) -> Result<(), String> {
        if on {
            self.off.remove(id);
        } else {
            self.off.insert(id.to_owned());
        }
        self.save()
    }

    fn save(&self) -> Result<(), String> {
        let Some(list) = &self.list else { return Ok(()) };
        let allowed = self.allowed.iter().map(|(file, Allowed { hash, is_trusted })| {
            let word = if *is_trusted { "trust" } else { "allow" };
            format!("{word} {hash} {}\n", file.display())
        });
        let text: String = allowed.chain(self.off.iter().map(|id| format!("off {id}\n"))).collect();
        let kept = list
            .parent()
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| save::atomically(list, text.as_bytes()));
        kept.map_err(|error| format!("{}: cannot be written: {error}", list.display()))
    }
}

/// A path as the system knows it.
fn whole(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decisions_outlive_the_program_and_a_changed_file_is_asked_about_again() {
        let folder = std::env::temp_dir().join(format!("endline-choices-{}", std::process::id()));
        let (list, own, file) = (
            folder.join("data/plugins-chosen"),
            folder.join("own"),
            folder.join("lib with a space.so"),
        );
        fs::create_dir_all(&own).unwrap();
        let read = || Choices::kept_in(Some(list.clone()), std::slice::from_ref(&own));
        let change = |hash: &str| read().ask(&file, hash).map(|ask| ask.change);
        assert_eq!((change("1"), read().ask(&own.join("lib.so"), "1")), (Some(Change::New), None));
        read().allow(&file, "1").unwrap();
        read().switch("org.example.slow", false).unwrap();
        assert_eq!((change("1"), change("2")), (None, Some(Change::Changed)));
        assert!(!read().is_trusted(&file) && read().is_trusted(&own.join("lib.so")));
        read().trust(&file, "1").unwrap();
        assert!(read().is_trusted(&file) && change("1").is_none() && change("2").is_some());
        read().allow(&file, "1").unwrap();
        assert!(!read().is_trusted(&file), "the last word counts");
        assert!(read().is_off("org.example.slow") && !read().is_off("org.example.fast"));
        let hidden = folder.join("a\nallow 3 lib.so");
        assert!(read().allow(&hidden, "2").unwrap_err().contains("control characters"));
        assert!(!fs::read_to_string(&list).unwrap().contains("allow 3"));
        assert!(read().forget(&file).unwrap() && !read().forget(&file).unwrap());
        read().switch("org.example.slow", true).unwrap();
        assert_eq!((change("1"), read().is_off("org.example.slow")), (Some(Change::New), false));
        fs::remove_dir_all(&folder).unwrap();
    }
}
