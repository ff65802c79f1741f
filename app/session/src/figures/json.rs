//! The summary of a run as JSON, schema `endline.run/1`: keys in the order of the lists of figures.

use serde::{Serialize, Serializer};

use super::{RUN, object};
use crate::report::Report;

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        object(RUN, self).serialize(serializer)
    }
}

impl Report {
    /// One line of JSON.
    #[must_use]
    pub fn json(&self) -> String {
        // Numbers and texts always serialise; the empty string would fail every reader at once.
        serde_json::to_string(self).unwrap_or_default()
    }
}
