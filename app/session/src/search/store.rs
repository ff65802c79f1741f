//! Runs kept by their number: a file for each part of a round that a shard ran, whole or not there.
//!
//! `net.128-136.0of2` holds what the first of two shards ran of the runs 128 to 135 of the net.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::campaign::Shard;
use crate::campaign::folder;
use crate::error::Error;
use crate::save;

use super::ended::Ended;

/// Runs of one search, or of the encounters that several share.
#[derive(Clone, Debug)]
pub(super) struct Store {
    path: PathBuf,
    hash: String,
}

/// Runs by their number, with what they belong to; the file ends with the hash of what stands before it.
#[derive(Serialize, Deserialize)]
struct Part {
    hash: String,
    runs: BTreeMap<u32, Ended>,
}

impl Store {
    /// Runs in a folder that belong to `hash`.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub(super) fn open(path: &Path, hash: String) -> Result<Self, Error> {
        folder::make(path)?;
        Ok(Self { path: path.to_path_buf(), hash })
    }

    /// Runs of a name that are kept, whichever shards ran them and with which others.
    ///
    /// # Errors
    /// A file of that name that is damaged or belongs to something else.
    pub(super) fn read(
        &self,
        name: &str,
        numbers: &Range<u32>,
    ) -> Result<BTreeMap<u32, Ended>, Error> {
        let mut runs = BTreeMap::new();
        for entry in fs::read_dir(&self.path).into_iter().flatten().flatten() {
            let file = entry.file_name();
            let kept = file.to_str().and_then(|file| range(file, name));
            if kept.is_some_and(|kept| kept.start < numbers.end && numbers.start < kept.end) {
                runs.extend(self.part(&entry.path())?);
            }
        }
        runs.retain(|number, _| numbers.contains(number));
        Ok(runs)
    }

    fn part(&self, file: &Path) -> Result<BTreeMap<u32, Ended>, Error> {
        let bytes =
            fs::read(file).map_err(|error| Error::at(file, format!("cannot be read: {error}")))?;
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

    /// Keeps runs, whole or not at all.
    ///
    /// # Errors
    /// Where the folder cannot be written.
    pub(super) fn write(
        &self,
        name: &str,
        numbers: &Range<u32>,
        shard: Shard,
        runs: BTreeMap<u32, Ended>,
    ) -> Result<(), Error> {
        let Range { start, end } = numbers;
        let file = self.path.join(format!("{name}.{start}-{end}.{}of{}", shard.part, shard.of));
        let part = Part { hash: self.hash.clone(), runs };
        let mut bytes = postcard::to_allocvec(&part)
            .map_err(|error| Error::at(&file, format!("cannot be put together: {error}")))?;
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        save::atomically(&file, &bytes).map_err(|error| {
            Error::at(
                &file,
                format!("cannot be written: {error}; the rounds that are there are whole, and the same command goes on from them"),
            )
        })
    }
}

/// The numbers of a file's runs, where it has that name: of `net.128-136.0of2`, 128 to 135.
fn range(file: &str, name: &str) -> Option<Range<u32>> {
    let (numbers, part) = file.strip_prefix(name)?.strip_prefix('.')?.split_once('.')?;
    let (start, end) = numbers.split_once('-')?;
    let (part, of) = part.split_once("of")?;
    let [start, end, _, _] = [start, end, part, of].map(|number| number.parse::<u32>().ok());
    Some(start?..end?)
}
