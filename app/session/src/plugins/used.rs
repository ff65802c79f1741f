//! Which plugins a model runs on.

use serde::{Deserialize, Serialize};

/// A plugin a model runs on.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct PluginUsed {
    /// Id, such as `org.endline.friction.coulomb`.
    pub id: String,
    /// Version.
    pub version: String,
    /// BLAKE3 of the file it was loaded from, hexadecimal; empty where it is linked in.
    pub file_hash: String,
}
