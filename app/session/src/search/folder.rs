//! A search's folder: which search it belongs to, and its runs.
//!
//! | file | what |
//! |---|---|
//! | `search.json` | which search this is: observation, study, hash, version |
//! | `round-00007.0-36.0of2` | runs of the local searches' round that one shard ran |
//! | `net.128-136.0of2` | runs of the net, here or in a folder that searches share |
//! | `stories.json` | what was found |

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::campaign::folder;
use crate::error::Error;

use super::question::Question;
use super::store::Store;

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
    #[must_use]
    pub fn path_under(root: &Path, question: &Question) -> PathBuf {
        folder::path_under(root, &question.observation.id, &question.hash)
    }

    /// Whether a folder has a search.
    #[must_use]
    pub fn is_there(path: &Path) -> bool {
        path.join(LABEL).is_file()
    }

    /// Opens a folder for a search, made where it is not there. Runs of the net are kept in it, or in `shared` below a name that tells
    /// their encounters.
    ///
    /// # Errors
    /// A folder that belongs to another search, or cannot be written.
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
