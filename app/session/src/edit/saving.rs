//! Saving the texts: each file whole or not at all, and none over what someone else wrote since it was read.

use std::path::{Path, PathBuf};

use endline_gear::save_text;

use super::documents::Documents;
use super::slug::free_file;
use crate::save::text_if_there;

/// What becomes of a file that was changed on disk since it was read, and of the edits of it here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The edits: they replace what is on disk.
    Mine,
    /// What is on disk: it replaces the edits, and one undo brings them back.
    Theirs,
    /// Both: the edits go to a file of their own beside the other.
    Both,
    /// Nothing is decided: the file stays as it is, and the edits stay unsaved.
    Undecided,
}

impl Documents {
    /// Writes every changed text to its file, each whole or not at all; returns how many.
    ///
    /// # Errors
    /// With the files that could not be written, and those that were changed on disk since they were read
    /// ([`newer`](Self::newer)); the others are saved.
    pub fn save(&mut self) -> Result<usize, String> {
        let (mut count, mut failed) = (0, Vec::new());
        self.newer.clear();
        for path in self.texts.unsaved().to_vec() {
            match self.save_one(&path) {
                Ok(()) => count += 1,
                Err(error) => failed.push(error),
            }
        }
        self.texts.refresh();
        if failed.is_empty() { Ok(count) } else { Err(failed.join("\n")) }
    }

    /// Files that the last save found changed on disk since they were read, by path, with their text on disk.
    pub fn newer(&self) -> impl Iterator<Item = (&str, &str)> {
        self.newer.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }

    /// Decides what becomes of a file that is [`newer`](Self::newer) and of the edits of it here; says what was done.
    ///
    /// # Errors
    /// A file that cannot be written, or that has changed once more.
    pub fn reconcile(&mut self, path: &str, keep: Keep) -> Result<String, String> {
        let Some(theirs) = self.newer.remove(path) else {
            return Err(format!("{} is not known to have changed on disk", self.shown_name(path)));
        };
        let name = self.shown_name(path);
        match keep {
            Keep::Mine => {
                self.texts.read(path, Some(theirs));
                let saved = self.save_one(path);
                self.texts.refresh();
                saved.map(|()| format!("saved {name}"))
            }
            Keep::Theirs => {
                self.take_in(path, theirs, None);
                Ok(format!("{name} is as on disk; Undo brings your edits back"))
            }
            Keep::Both => {
                let mine = self.texts.get(path).unwrap_or_default().to_owned();
                let file = self.file_for_mine(path)?;
                write(&file, Some(&mine))?;
                let said = format!("your edits are in {}", file.display());
                self.take_in(path, theirs, Some((file, mine)));
                Ok(said)
            }
            Keep::Undecided => Ok(format!("{name} is not saved")),
        }
    }

    /// Puts the text on disk in the place of the edits, which stand in a file of their own if they were kept.
    fn take_in(&mut self, path: &str, theirs: String, mine: Option<(PathBuf, String)>) {
        self.texts.read(path, Some(theirs.clone()));
        let mut texts = vec![(path.to_owned(), Some(theirs))];
        // A file beside the scenario, study or observation is none of the open texts.
        if let (Some((file, mine)), None) = (mine, self.file_outside(path))
            && let Ok(own) = file.strip_prefix(&self.root)
        {
            let own = own.to_string_lossy().into_owned();
            self.texts.read(&own, Some(mine.clone()));
            texts.push((own, Some(mine)));
        }
        self.change(texts);
    }

    /// A file for edits beside the one they are of; none is there.
    fn file_for_mine(&self, path: &str) -> Result<PathBuf, String> {
        let file = self.file_of(path);
        let stem = file.file_stem().map(|stem| stem.to_string_lossy()).unwrap_or_default();
        let folder = file.parent().unwrap_or(&self.root);
        let free = free_file(folder, &format!("{stem}-mine"));
        free.ok_or_else(|| format!("{}: there are 1000 copies already", file.display()))
    }

    fn save_one(&mut self, path: &str) -> Result<(), String> {
        let file = self.file_of(path);
        let on_disk = text_if_there(&file).map_err(|error| error.to_string())?;
        let present = self.texts.get(path);
        // A file that is gone has nothing to be lost.
        if let Some(theirs) = &on_disk
            && Some(theirs.as_str()) != self.texts.saved(path)
            && Some(theirs.as_str()) != present
        {
            self.newer.insert(path.to_owned(), theirs.clone());
            return Err(format!("{} was changed on disk since it was read", file.display()));
        }
        if on_disk.as_deref() != present {
            write(&file, present)?;
        }
        self.texts.mark_saved(path);
        Ok(())
    }

    /// The file of a text.
    fn file_of(&self, path: &str) -> PathBuf {
        self.file_outside(path).map_or_else(|| self.root.join(path), Path::to_owned)
    }

    /// Writes the scenario to another file and continues with that file; the earlier file stays as
    /// it was saved.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn save_scenario_as(&mut self, path: &Path) -> Result<(), String> {
        write(path, Some(self.texts.get(Self::SCENARIO).unwrap_or_default()))?;
        self.scenario_path = path.to_owned();
        self.texts.mark_saved(Self::SCENARIO);
        self.read_all();
        Ok(())
    }
}

/// Writes a text to its file; one that is `None` is removed.
fn write(file: &Path, text: Option<&str>) -> Result<(), String> {
    let written = match text {
        Some(text) => save_text(file, text),
        None => std::fs::remove_file(file),
    };
    written.map_err(|error| format!("{}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const ROPE: &str = "ropes/rope.toml";

    /// A library with one rope, and a scenario, in a folder of the test's own.
    struct Place(PathBuf);

    impl Place {
        fn new(name: &str) -> Self {
            let folder =
                std::env::temp_dir().join(format!("endline-{name}-{}", std::process::id()));
            fs::create_dir_all(folder.join("ropes")).unwrap();
            fs::create_dir_all(folder.join("scenarios")).unwrap();
            fs::write(folder.join(ROPE), "name = \"rope\"\ndiameter = \"10 mm\" # mine\n").unwrap();
            fs::write(folder.join("scenarios/one.toml"), "name = \"one\"\n").unwrap();
            Self(folder)
        }

        /// The library open, with an edit of the rope, which someone else changes on disk meanwhile.
        fn changed_by_two(&self) -> Documents {
            let mut documents =
                Documents::open(&self.0, &self.0.join("scenarios/one.toml")).unwrap();
            documents.set(ROPE, "diameter", "12 mm").unwrap();
            let theirs = self.on_disk(ROPE).replace("10 mm", "11 mm").replace("# mine", "# theirs");
            fs::write(self.0.join(ROPE), theirs).unwrap();
            documents
        }

        fn on_disk(&self, path: &str) -> String {
            fs::read_to_string(self.0.join(path)).unwrap()
        }
    }

    impl Drop for Place {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_file_that_someone_else_changed_is_not_written_over_and_all_others_are_saved() {
        let place = Place::new("newer");
        let mut documents = place.changed_by_two();
        documents.set(Documents::SCENARIO, "name", "two").unwrap();
        let error = documents.save().unwrap_err();
        assert!(error.contains("rope.toml was changed on disk"), "{error}");
        assert!(place.on_disk(ROPE).contains("11 mm") && place.on_disk(ROPE).contains("# theirs"));
        assert!(place.on_disk("scenarios/one.toml").contains("two"));
        assert_eq!(documents.newer().map(|(path, _)| path).collect::<Vec<_>>(), [ROPE]);
        documents.reconcile(ROPE, Keep::Undecided).unwrap();
        assert!(documents.newer().next().is_none() && documents.is_unsaved(ROPE));
        assert!(documents.save().is_err(), "it asks again");
    }

    #[test]
    fn mine_theirs_or_both_are_kept_and_nothing_else_is_lost() {
        let place = Place::new("mine");
        let mut documents = place.changed_by_two();
        documents.save().unwrap_err();
        documents.reconcile(ROPE, Keep::Mine).unwrap();
        assert!(place.on_disk(ROPE).contains("12 mm") && !documents.is_unsaved(ROPE));

        let place = Place::new("theirs");
        let mut documents = place.changed_by_two();
        documents.save().unwrap_err();
        documents.reconcile(ROPE, Keep::Theirs).unwrap();
        assert_eq!(documents.field(ROPE, "diameter").as_deref(), Some("11 mm"));
        assert!(documents.unsaved().is_empty() && place.on_disk(ROPE).contains("11 mm"));
        assert!(documents.undo(), "the edits come back");
        assert_eq!(documents.field(ROPE, "diameter").as_deref(), Some("12 mm"));
        assert_eq!(documents.save(), Ok(1), "theirs is known now");

        let place = Place::new("both");
        let mut documents = place.changed_by_two();
        documents.save().unwrap_err();
        documents.reconcile(ROPE, Keep::Both).unwrap();
        assert!(place.on_disk(ROPE).contains("11 mm"));
        assert!(place.on_disk("ropes/rope-mine.toml").contains("12 mm"));
        assert_eq!(documents.field("ropes/rope-mine.toml", "diameter").as_deref(), Some("12 mm"));
        assert!(documents.unsaved().is_empty());
    }

    #[test]
    fn a_file_changed_once_more_is_asked_for_again() {
        let place = Place::new("again");
        let mut documents = place.changed_by_two();
        documents.save().unwrap_err();
        fs::write(place.0.join(ROPE), "name = \"rope\"\ndiameter = \"9 mm\"\n").unwrap();
        documents.reconcile(ROPE, Keep::Mine).unwrap_err();
        assert!(place.on_disk(ROPE).contains("9 mm") && documents.newer().count() == 1);
        // What both wrote alike is saved, and a file that is gone is written anew.
        fs::write(place.0.join(ROPE), documents.text(ROPE).unwrap()).unwrap();
        assert_eq!(documents.save(), Ok(1));
        documents.set(ROPE, "diameter", "13 mm").unwrap();
        fs::remove_file(place.0.join(ROPE)).unwrap();
        assert_eq!(documents.save(), Ok(1));
        assert!(place.on_disk(ROPE).contains("13 mm"));
    }
}
