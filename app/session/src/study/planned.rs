//! What a study will run, as JSON: schema `endline.study_plan/1`.

use schemars::JsonSchema;
use serde::Serialize;

use super::folder::BLOCK;
use super::open::Opened;

/// Name and version of the form.
const SCHEMA: &str = "endline.study_plan/1";

/// What a study will run.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Plan<'a> {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// Id of the study.
    study: &'a str,
    /// Hash of all that defines its runs.
    hash: &'a str,
    /// Number of encounters.
    encounters: u64,
    /// Number of blocks of encounters that are run and kept as one.
    blocks: u64,
    /// Ids of the options, in order.
    options: Vec<&'a str>,
    /// Id of the option that the others are compared with.
    baseline: &'a str,
    /// Options that share their runs until something parts.
    families: Vec<Vec<&'a str>>,
}

impl Opened {
    /// One line of JSON.
    #[must_use]
    pub fn plan_json(&self) -> String {
        let plan = Plan {
            schema: SCHEMA,
            study: &self.study.id,
            hash: &self.hash,
            encounters: self.study.encounters,
            blocks: self.study.encounters.div_ceil(u64::from(BLOCK)),
            options: self.options.iter().map(|option| option.id.as_str()).collect(),
            baseline: &self.options[self.baseline].id,
            families: self.families(),
        };
        // Structs of numbers and strings always serialise.
        serde_json::to_string(&plan).unwrap_or_default()
    }
}
