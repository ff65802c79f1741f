//! The JSON forms that commands print, each with its schema (JSON Schema, draft 2020-12).
//!
//! A form has a name with a version: keys may be added to a version, but none is renamed, left out or given another meaning.
//! Its schema is made from the type that is written, so that the two cannot differ.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};

use crate::haul::{HaulSheet, SweepRow};
use crate::mill::{MeansLaws, StrengthLaw};
use crate::report::Report;
use crate::rules::RuleSheet;
use crate::rules::packs::Listing;
use crate::rules::remedy::Remedies;
use crate::search::Stories;
use crate::settled::SettledShape;
use crate::study::prepared::Plan;
use crate::study::stats::Findings;
use crate::study::threat::Threats;

/// A JSON form.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// Name and version, such as `endline.run/1`.
    pub name: &'static str,
    /// The commands that print it with `--json`.
    pub commands: &'static [&'static str],
    /// Makes its schema.
    pub schema: fn() -> Schema,
}

impl Form {
    /// The schema, under the form's name.
    pub fn titled(&self) -> Schema {
        let mut schema = (self.schema)();
        schema.insert("title".into(), self.name.into());
        schema
    }
}

/// The schema of a type's JSON.
pub fn schema_of<T: JsonSchema>() -> Schema {
    SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<T>()
}

/// The forms that this package writes.
pub static FORMS: &[Form] = &[
    Form { name: "endline.run/1", commands: &["run", "study replay"], schema: schema_of::<Report> },
    Form { name: "endline.settle/1", commands: &["settle"], schema: schema_of::<SettledShape> },
    Form {
        name: "endline.study_plan/1",
        commands: &["study plan"],
        schema: schema_of::<Plan<'static>>,
    },
    Form { name: "endline.findings/2", commands: &["study report"], schema: schema_of::<Findings> },
    Form { name: "endline.threat/1", commands: &["study threat"], schema: schema_of::<Threats> },
    Form { name: "endline.stories/1", commands: &["search"], schema: schema_of::<Stories> },
    Form {
        name: "endline.rules.check/1",
        commands: &["rules check"],
        schema: schema_of::<RuleSheet>,
    },
    Form {
        name: "endline.rules.list/1",
        commands: &["rules list"],
        schema: schema_of::<Listing<'static>>,
    },
    Form { name: "endline.rules.fix/1", commands: &["rules fix"], schema: schema_of::<Remedies> },
    Form { name: "endline.haul/1", commands: &["haul"], schema: schema_of::<HaulSheet> },
    Form {
        name: "endline.haul_sweep/1",
        commands: &["haul --table"],
        schema: schema_of::<Vec<SweepRow>>,
    },
    Form { name: "endline.mill/1", commands: &["mill"], schema: schema_of::<StrengthLaw> },
    Form { name: "endline.mill.means/1", commands: &["mill"], schema: schema_of::<MeansLaws> },
];
