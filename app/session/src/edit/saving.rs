//! Saving the texts: each file whole or not at all, and none over what someone else wrote since it was read.

use std::path::{Path, PathBuf};

use super::bundled::OwnCopy;
use super::documents::Documents;
use crate::save::{self, text_if_there};

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

/// Files that were written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Saved {
    /// Every file written or deleted.
    pub files: Vec<PathBuf>,
    /// Those of them that are copies of files which came with the program.
    pub copies: Vec<OwnCopy>,
}

impl Saved {
    /// What was saved and where, in a sentence or two.
    pub fn sentence(&self) -> String {
        /// Names listed at most.
        const LISTED: usize = 4;
        let name =
            |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut text = match &self.files[..] {
            [file] => format!("saved {}", file.display()),
            files => {
                let names: Vec<String> = files.iter().take(LISTED).map(name).collect();
                let more = if files.len() > LISTED { ", …" } else { "" };
                let mut folders = files.iter().filter_map(|file| file.parent()?.parent());
                let place = folders.next().map(|folder| format!(" in {}", folder.display()));
                let place = place.unwrap_or_default();
                format!("saved {} files{place}: {}{more}", files.len(), names.join(", "))
            }
        };
        if !self.copies.is_empty() {
            let originals: Vec<&str> = self.copies.iter().map(|copy| copy.id.as_str()).collect();
            text += &format!(
                ". {} came with Endline and stays as it was; your edits are in your own copy",
                originals.join(", ")
            );
        }
        text
    }
}

impl Documents {
    /// Writes every changed text to its file, each whole or not at all. A file that came with the program is never written over:
    /// its text is saved as a copy of the user's own, which the design then names.
    /// Errors: with the files that could not be written, and those that were changed on disk since they were read
    /// ([`newer`](Self::newer)); the others are saved.
    pub fn save(&mut self) -> Result<Saved, String> {
        let copies = self.copy_bundled()?;
        let mut saved = Saved { files: Vec::new(), copies };
        let mut failed = Vec::new();
        self.newer.clear();
        for path in self.texts.unsaved().to_vec() {
            if self.text(&path).is_none() && self.is_bundled(&path) {
                failed.push(format!(
                    "{path} came with Endline and is not deleted; undo brings it back"
                ));
                continue;
            }
            match self.save_one(&path) {
                Ok(()) => saved.files.push(self.file_of(&path)),
                Err(error) => failed.push(error),
            }
        }
        self.texts.refresh();
        if failed.is_empty() { Ok(saved) } else { Err(failed.join("\n")) }
    }

    /// Files that the last save found changed on disk since they were read, by path, with their text on disk.
    pub fn newer(&self) -> impl Iterator<Item = (&str, &str)> {
        self.newer.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }

    /// Resolves the conflict of a file that is [`newer`](Self::newer) with its edits here; returns a description of the result.
    /// Errors: a file that cannot be written, or that has changed once more.
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
    pub(super) fn file_of(&self, path: &str) -> PathBuf {
        self.file_outside(path).map_or_else(|| self.root.join(path), Path::to_owned)
    }

    /// Writes the scenario to another file and continues with that file; the earlier file stays as
    /// it was saved.
    /// Errors: where the file cannot be written.
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
        Some(text) => save::atomically(file, text.as_bytes()),
        None => std::fs::remove_file(file),
    };
    written.map_err(|error| format!("{}: {error}", file.display()))
}

/// A name as the stem of a file: lower case, words joined by dashes.
pub fn slug(name: &str) -> String {
    let words: String = name
        .to_lowercase()
        .chars()
        .map(|letter| if letter.is_ascii_alphanumeric() { letter } else { ' ' })
        .collect();
    let joined = words.split_whitespace().collect::<Vec<_>>().join("-");
    if joined.is_empty() { "entry".to_owned() } else { joined }
}

/// A file of a folder that is not there: `stem.toml`, else `stem-2.toml` and so on; none where a thousand are.
pub fn free_file(folder: &Path, stem: &str) -> Option<PathBuf> {
    let named = |number: u32| match number {
        1 => folder.join(format!("{stem}.toml")),
        number => folder.join(format!("{stem}-{number}.toml")),
    };
    (1..=1000).map(named).find(|path| !path.exists())
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
        documents.save().expect("theirs is known now");

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
        documents.save().unwrap();
        documents.set(ROPE, "diameter", "13 mm").unwrap();
        fs::remove_file(place.0.join(ROPE)).unwrap();
        documents.save().unwrap();
        assert!(place.on_disk(ROPE).contains("13 mm"));
    }

    #[test]
    fn a_file_that_came_with_the_program_is_saved_as_a_copy_that_the_design_names() {
        const ONE: &str = "name = \"one\"\n[[gear]]\nassembly = \"gear\"\n";
        const GEAR: &str = "name = \"gear\"\n[[line]]\nid = \"rope\"\nrope = \"rope\"\n";
        const MEASURED: &str = "name = \"rope\"\ndiameter = \"10 mm\"\nsource = \"a mill\"\nconfidence = \"measured\"\n";
        const BUNDLED: crate::shipped::Files = &[
            (ROPE, MEASURED.as_bytes()),
            ("assemblies/gear.toml", GEAR.as_bytes()),
            ("assemblies/other.toml", GEAR.as_bytes()),
            ("scenarios/one.toml", ONE.as_bytes()),
        ];
        let place = Place::new("bundled");
        fs::create_dir_all(place.0.join("assemblies")).unwrap();
        for (path, bytes) in BUNDLED {
            fs::write(place.0.join(path), bytes).unwrap();
        }
        let mut documents = Documents::open(&place.0, &place.0.join("scenarios/one.toml")).unwrap();
        documents.bundled = BUNDLED;
        documents.set(ROPE, "diameter", "12 mm").unwrap();
        let saved = documents.save().unwrap();
        for (path, bytes) in BUNDLED {
            assert_eq!(place.on_disk(path).as_bytes(), *bytes, "{path} stays");
        }
        let rope = place.on_disk("ropes/rope-mine.toml");
        assert!(rope.contains("12 mm") && rope.contains("rope (mine)"), "{rope}");
        assert!(rope.contains("copied from rope") && !rope.contains("measured"), "{rope}");
        let gear = place.on_disk("assemblies/gear-mine.toml");
        assert!(gear.contains("rope = \"rope-mine\"") && gear.contains("id = \"rope\""), "{gear}");
        assert!(place.on_disk("scenarios/one-mine.toml").contains("assembly = \"gear-mine\""));
        assert!(
            !place.0.join("assemblies/other-mine.toml").exists(),
            "the design does not have it"
        );
        assert_eq!((saved.files.len(), saved.copies.len()), (3, 3));
        let said = saved.sentence();
        for part in [&place.0.display().to_string(), "one-mine.toml", "came with Endline"] {
            assert!(said.contains(part), "{said}");
        }
        assert!(documents.unsaved().is_empty());
        assert!(documents.scenario_path().ends_with("scenarios/one-mine.toml"));

        // The copies are the user's: the next edit goes to the same files.
        documents.set("ropes/rope-mine.toml", "diameter", "13 mm").unwrap();
        assert_eq!(documents.save().unwrap().files, [place.0.join("ropes/rope-mine.toml")]);
        documents.remove("assemblies/other.toml");
        assert!(documents.save().unwrap_err().contains("not deleted"));
        assert!(place.0.join("assemblies/other.toml").exists());
    }

    #[test]
    fn a_name_becomes_a_stem() {
        assert_eq!(slug("3/8 in Poly (mill)"), "3-8-in-poly-mill");
        assert_eq!(slug("***"), "entry");
    }
}
