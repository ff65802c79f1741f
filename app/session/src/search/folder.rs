//! A search's folder: its label, and its runs by number, in a file for each part of a round that a shard ran.
//!
//! | file | what |
//! |---|---|
//! | `search.json` | which search this is: observation, study, hash, version |
//! | `round-00007.0-36.0of2` | runs of the local searches' round that one shard ran |
//! | `net.128-136.0of2` | runs 128 to 135 of the net that the first of two shards ran, here or in a folder that searches share |
//! | `stories.json` | the stories found |
//!
//! A file of runs is complete or missing.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::campaign::folder;
use crate::campaign::pool::Shard;
use crate::error::Error;
use crate::save;

use super::ending::RunEnding;
use super::question::Question;

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

/// A folder of one search.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Where.
    pub path: PathBuf,
    /// Runs that local searches asked for, and neighbours.
    pub(super) rounds: Store,
    /// Draws from the priors, which no observation changes.
    pub(super) net: Store,
}

impl Folder {
    /// Where the folder of a search is under a root: the observation's id and the head of the search's hash.
    pub fn path_under(root: &Path, question: &Question) -> PathBuf {
        folder::path_under(root, &question.observation.id, &question.hash)
    }

    /// Whether a folder has a search.
    pub fn is_there(path: &Path) -> bool {
        path.join(LABEL).is_file()
    }

    /// Opens a folder for a search, and makes it unless it exists. Runs of the net are stored in it, or in `shared` under a name for
    /// their encounters.
    /// Errors: a folder that belongs to another search, or cannot be written.
    pub fn open(path: &Path, shared: Option<&Path>, question: &Question) -> Result<Self, Error> {
        folder::make(path)?;
        let file = path.join(LABEL);
        let label = Label {
            schema: SCHEMA.into(),
            observation: question.observation.id.clone(),
            encounters: question.opened.study.id.clone(),
            hash: question.hash.clone(),
            version: crate::VERSION.into(),
        };
        match folder::read_label(&file)? {
            Some(found) => same(&file, &found, &label)?,
            None => folder::write_label(&file, &label)?,
        }
        let of_encounters = || format!("{}-{}", question.opened.study.id, &question.net_hash[..12]);
        let net = shared.map_or_else(|| path.to_path_buf(), |shared| shared.join(of_encounters()));
        Ok(Self {
            path: path.to_path_buf(),
            rounds: Store::open(path, question.hash.clone())?,
            net: Store::open(&net, question.net_hash.clone())?,
        })
    }
}

fn same(file: &Path, found: &Label, label: &Label) -> Result<(), Error> {
    if found.hash == label.hash {
        return Ok(());
    }
    let message = format!(
        "belongs to a search for `{}` among `{}` (Endline {}): observation, study, library, plugins or program have changed; choose another folder with --out",
        found.observation, found.encounters, found.version
    );
    Err(Error::at(file, message))
}

/// Runs of one search, or of the encounters that several share.
#[derive(Clone, Debug)]
pub(super) struct Store {
    path: PathBuf,
    hash: String,
}

/// Runs by their number, with the hash of the search. The file ends with the hash of all bytes before.
#[derive(Serialize, Deserialize)]
struct Part {
    hash: String,
    runs: BTreeMap<u32, RunEnding>,
}

impl Store {
    /// Runs in a folder that belong to `hash`.
    /// Errors: a folder that cannot be made.
    pub(super) fn open(path: &Path, hash: String) -> Result<Self, Error> {
        folder::make(path)?;
        Ok(Self { path: path.to_path_buf(), hash })
    }

    /// Stored runs of a name, of all shards and parts.
    /// Errors: a file of that name that is damaged or belongs to something else.
    pub(super) fn read(
        &self,
        name: &str,
        numbers: &Range<u32>,
    ) -> Result<BTreeMap<u32, RunEnding>, Error> {
        let mut runs = BTreeMap::new();
        for entry in fs::read_dir(&self.path).into_iter().flatten().flatten() {
            let file = entry.file_name();
            let stored = file.to_str().and_then(|file| range(file, name));
            let meets = |own: Range<u32>| own.start < numbers.end && numbers.start < own.end;
            if stored.is_some_and(meets) {
                runs.extend(self.part(&entry.path())?);
            }
        }
        runs.retain(|number, _| numbers.contains(number));
        Ok(runs)
    }

    fn part(&self, file: &Path) -> Result<BTreeMap<u32, RunEnding>, Error> {
        let bytes = endline_gear::read::bytes(file).map_err(Error::on(file, "cannot be read"))?;
        let damaged =
            |why: &str| Error::at(file, format!("is damaged: {why}; delete it and search again"));
        let (runs, hash) = bytes.split_last_chunk().ok_or_else(|| damaged("it is cut off"))?;
        if blake3::hash(runs) != blake3::Hash::from_bytes(*hash) {
            return Err(damaged("its bytes are not those that were written"));
        }
        let part: Part = postcard::from_bytes(runs).map_err(|error| damaged(&error.to_string()))?;
        if part.hash != self.hash {
            return Err(Error::at(file, "belongs to another search; delete it and search again"));
        }
        Ok(part.runs)
    }

    /// Stores runs, all or none.
    /// Errors: where the folder cannot be written.
    pub(super) fn write(
        &self,
        name: &str,
        numbers: &Range<u32>,
        shard: Shard,
        runs: BTreeMap<u32, RunEnding>,
    ) -> Result<(), Error> {
        let Range { start, end } = numbers;
        let file = self.path.join(format!("{name}.{start}-{end}.{}of{}", shard.part, shard.of));
        let part = Part { hash: self.hash.clone(), runs };
        let mut bytes =
            postcard::to_allocvec(&part).map_err(Error::on(&file, "cannot be put together"))?;
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        save::atomically(&file, &bytes).map_err(|error| {
            Error::at(
                &file,
                format!("cannot be written: {error}; stored rounds are complete, and the same command continues from them"),
            )
        })
    }
}

/// The numbers of the runs in a file of this name: of `net.128-136.0of2`, 128 to 135.
fn range(file: &str, name: &str) -> Option<Range<u32>> {
    let (numbers, part) = file.strip_prefix(name)?.strip_prefix('.')?.split_once('.')?;
    let (start, end) = numbers.split_once('-')?;
    let (part, of) = part.split_once("of")?;
    let [start, end, _, _] = [start, end, part, of].map(|number| number.parse::<u32>().ok());
    Some(start?..end?)
}
