//! Figures of a plugin of the model.

use super::{Figure, Quantity};
use crate::plugins::PluginUsed;

/// Figures of a plugin of the model.
pub static PLUGIN: &[Figure<PluginUsed>] = &[
    Figure::new("id", "plugin", "Id of the plugin.", Quantity::Id, |plugin: &PluginUsed| {
        (&plugin.id).into()
    }),
    Figure::new(
        "version",
        "version",
        "Version of the plugin.",
        Quantity::Id,
        |plugin: &PluginUsed| (&plugin.version).into(),
    ),
    Figure::new(
        "file_hash",
        "file hash",
        "BLAKE3 of the file it was loaded from; empty if it is linked.",
        Quantity::Id,
        |plugin: &PluginUsed| (&plugin.file_hash).into(),
    ),
];
