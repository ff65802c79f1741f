//! Figures as JSON, and the JSON schema of their declarations: type, unit and meaning of every key.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use super::{
    AUDIT, BALANCE, BEAT, BODY, COST, EVENT, Figure, KINETIC, LINE, LINK, PART, PATCH, PHASE,
    PLUGIN, PROBE, Quantity, RUN, SETTLED, WHALE,
};
use crate::report::{Report, SCHEMA};

impl JsonSchema for Report {
    fn schema_name() -> Cow<'static, str> {
        "Run".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        Schema::from(run())
    }
}

/// Schema of the probes of a run.
pub(crate) fn probes(_: &mut SchemaGenerator) -> Schema {
    Schema::try_from(each(object(PROBE, &[]))).unwrap_or_default()
}

fn run() -> Map<String, Value> {
    let balance = object(BALANCE, &[]);
    let audit = [("balance", or_none(balance)), ("steps_limited_by", counts())];
    let whale = [
        ("regions", each(object(PART, &[]))),
        ("patches", each(object(PATCH, &[]))),
        ("beat", or_none(object(BEAT, &[]))),
        ("kinetic", or_none(object(KINETIC, &[]))),
    ];
    let groups = [
        ("audit", object(AUDIT, &audit).into()),
        ("lines", each(object(LINE, &[]))),
        ("links", each(object(LINK, &[]))),
        ("bodies", each(object(BODY, &[]))),
        ("probes", each(object(PROBE, &[]))),
        ("whale", or_none(object(WHALE, &whale))),
        ("approach", object(PHASE, &[]).into()),
        ("contact", object(PHASE, &[]).into()),
        ("settled", object(SETTLED, &[]).into()),
        ("cost", object(COST, &[]).into()),
        ("events", each(object(EVENT, &[]))),
        ("plugins", each(object(PLUGIN, &[]))),
    ];
    let mut run = object(RUN, &groups);
    run["properties"]["schema"]["const"] = SCHEMA.into();
    run
}

/// Schema of an object of figures; the schemas of its groups are given by key.
fn object<S>(figures: &[Figure<S>], groups: &[(&str, Value)]) -> Map<String, Value> {
    let in_json = || figures.iter().filter(|figure| figure.in_json);
    let group = |key| groups.iter().find(|(own, _)| *own == key).map(|(_, schema)| schema.clone());
    let property = |figure: &Figure<S>| {
        let mut schema = group(figure.key).unwrap_or_else(|| single(figure.quantity));
        schema["description"] = figure.help.into();
        (figure.key.to_owned(), schema)
    };
    let keys: Vec<&str> = in_json().map(|figure| figure.key).collect();
    let mut schema = Map::new();
    schema.insert("type".into(), "object".into());
    schema.insert("properties".into(), in_json().map(property).collect::<Map<_, _>>().into());
    schema.insert("required".into(), keys.into());
    schema
}

fn each(object: Map<String, Value>) -> Value {
    json!({ "type": "array", "items": object })
}

fn or_none(mut object: Map<String, Value>) -> Value {
    object.insert("type".into(), json!(["object", "null"]));
    object.into()
}

fn counts() -> Value {
    json!({ "type": "object", "additionalProperties": { "type": "integer", "minimum": 0 } })
}

/// Schema of a figure that is no group; null where there is none.
fn single(quantity: Quantity) -> Value {
    let number = || json!({ "type": ["number", "null"] });
    let three = || json!({ "type": ["array", "null"], "items": { "type": "number" }, "minItems": 3, "maxItems": 3 });
    let mut schema = match quantity {
        Quantity::Flag => return json!({ "type": ["boolean", "null"] }),
        Quantity::Name | Quantity::Id => return json!({ "type": ["string", "null"] }),
        Quantity::Ids => return json!({ "type": "array", "items": { "type": "string" } }),
        Quantity::Count => return json!({ "type": ["integer", "null"], "minimum": 0 }),
        Quantity::Measured | Quantity::Group => return number(),
        Quantity::ForceVector | Quantity::Place => three(),
        Quantity::Impulse => json!({ "anyOf": [number(), three()] }),
        _ => number(),
    };
    schema["unit"] = quantity.unit().into();
    schema
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        super::object(RUN, self).serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A group without a schema would pass as a number.
    #[test]
    fn every_group_of_a_run_has_a_schema_of_its_own() {
        let run = run();
        let property = |list: &Value, key: &str| list["properties"][key].clone();
        for figure in RUN.iter().filter(|figure| figure.quantity == Quantity::Group) {
            let own = &run["properties"][figure.key];
            assert!(own.get("items").or(own.get("properties")).is_some(), "{}", figure.key);
        }
        let (audit, whale) = (&run["properties"]["audit"], &run["properties"]["whale"]);
        assert_eq!(property(audit, "balance")["type"], json!(["object", "null"]));
        assert_eq!(property(whale, "regions")["items"]["properties"]["wraps"]["unit"], "turns");
    }
}
