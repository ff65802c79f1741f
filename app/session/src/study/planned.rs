//! What a study will run, as JSON: schema `endline.study_plan/1`.

use serde::Serialize;

use super::folder::BLOCK;
use super::open::Opened;

#[derive(Serialize)]
struct Plan<'a> {
    schema: &'static str,
    study: &'a str,
    hash: &'a str,
    encounters: u64,
    blocks: u64,
    options: Vec<&'a str>,
    baseline: &'a str,
    /// Options that share their runs until something parts.
    families: Vec<Vec<&'a str>>,
}

impl Opened {
    /// One line of JSON.
    #[must_use]
    pub fn plan_json(&self) -> String {
        let plan = Plan {
            schema: "endline.study_plan/1",
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
