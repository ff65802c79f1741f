//! A search's folder: which search it belongs to, and its rounds.
//!
//! | file | what |
//! |---|---|
//! | `search.json` | which search this is: observation, study, hash, version |
//! | `round-00007.0of2` | trials of a round that one shard ran, whole or not there |
//! | `stories.json` | what was found |

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::save;
use crate::study::Shard;

use super::question::Question;
use super::trial::Trial;

/// Name of the schema of `search.json`.
const SCHEMA: &str = "endline.search/1";

/// Name of the file that says which search it is.
const LABEL: &str = "search.json";

/// Which search a folder belongs to.
#[derive(Debug, Serialize, Deserialize)]
struct Label {
    schema: String,
    observation: String,
    encounters: String,
    hash: String,
    version: String,
}

/// Trials of a round by their number, with the search that they belong to.
#[derive(Serialize, Deserialize)]
struct Part {
    hash: String,
    trials: BTreeMap<u32, Trial>,
}

/// A folder of one search.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Where.
    pub path: PathBuf,
    hash: String,
}

impl Folder {
    /// Where the folder of a search is under a root: the observation's id and the head of the search's hash.
    #[must_use]
    pub fn path_under(root: &Path, question: &Question) -> PathBuf {
        let hash = question.hash.get(..8).unwrap_or(&question.hash);
        root.join(format!("{}-{hash}", question.observation.id))
    }

    /// Whether a folder has a search.
    #[must_use]
    pub fn is_there(path: &Path) -> bool {
        path.join(LABEL).is_file()
    }

    /// Opens a folder for a search, made where it is not there.
    ///
    /// # Errors
    /// A folder that belongs to another search, or cannot be written.
    pub fn open(path: &Path, question: &Question) -> Result<Self, Error> {
        fs::create_dir_all(path)
            .map_err(|error| Error::at(path, format!("cannot be made: {error}")))?;
        let file = path.join(LABEL);
        let label = Label {
            schema: SCHEMA.into(),
            observation: question.observation.id.clone(),
            encounters: question.opened.study.id.clone(),
            hash: question.hash.clone(),
            version: crate::VERSION.into(),
        };
        match fs::read_to_string(&file) {
            Ok(text) => same(&file, &text, &label)?,
            Err(_) => {
                let text = serde_json::to_string_pretty(&label).unwrap_or_default() + "\n";
                save::atomically(&file, text.as_bytes())
                    .map_err(|error| Error::at(&file, format!("cannot be written: {error}")))?;
            }
        }
        Ok(Self { path: path.to_path_buf(), hash: question.hash.clone() })
    }

    /// Trials of a round that are kept, whichever shards ran them.
    ///
    /// # Errors
    /// A file of that round that is damaged or belongs to another search.
    pub(super) fn read(&self, round: &str) -> Result<BTreeMap<u32, Trial>, Error> {
        let mut trials = BTreeMap::new();
        for entry in fs::read_dir(&self.path).into_iter().flatten().flatten() {
            let file = entry.path();
            let is_own = file.file_stem().is_some_and(|stem| stem == round)
                && file.extension().is_some_and(|ending| ending.to_string_lossy().contains("of"));
            if is_own {
                trials.extend(self.part(&file)?);
            }
        }
        Ok(trials)
    }

    fn part(&self, file: &Path) -> Result<BTreeMap<u32, Trial>, Error> {
        let bytes =
            fs::read(file).map_err(|error| Error::at(file, format!("cannot be read: {error}")))?;
        let part: Part = postcard::from_bytes(&bytes).map_err(|error| {
            Error::at(file, format!("is damaged: {error}; delete it and search again"))
        })?;
        if part.hash != self.hash {
            return Err(Error::at(file, "belongs to another search; delete it and search again"));
        }
        Ok(part.trials)
    }

    /// Keeps trials of a round, whole or not at all.
    ///
    /// # Errors
    /// Where the folder cannot be written.
    pub(super) fn write(
        &self,
        round: &str,
        shard: Shard,
        trials: BTreeMap<u32, Trial>,
    ) -> Result<(), Error> {
        let file = self.path.join(format!("{round}.{}of{}", shard.part, shard.of));
        let part = Part { hash: self.hash.clone(), trials };
        let bytes = postcard::to_allocvec(&part)
            .map_err(|error| Error::at(&file, format!("cannot be put together: {error}")))?;
        save::atomically(&file, &bytes).map_err(|error| {
            Error::at(
                &file,
                format!("cannot be written: {error}; the rounds that are there are whole, and the same command goes on from them"),
            )
        })
    }
}

fn same(file: &Path, text: &str, label: &Label) -> Result<(), Error> {
    let found: Label = serde_json::from_str(text)
        .map_err(|error| Error::at(file, format!("is damaged: {error}")))?;
    if found.hash == label.hash {
        return Ok(());
    }
    let message = format!(
        "belongs to a search for `{}` among `{}` (Endline {}): observation, study, library, plugins or program have changed; choose another folder with --out",
        found.observation, found.encounters, found.version
    );
    Err(Error::at(file, message))
}
