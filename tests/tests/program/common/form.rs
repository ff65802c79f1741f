//! Printed JSON held against the schema that the program prints for its form, by a reader of schemas that is not ours.

use std::collections::BTreeMap;
use std::process::Command;
use std::sync::Mutex;

use serde_json::{Value, json};

/// Schemas that were asked for.
static KNOWN: Mutex<BTreeMap<String, Value>> = Mutex::new(BTreeMap::new());

/// Asserts that a value is of a form, and has no key that the form's schema does not know.
pub fn hold(value: &Value, form: &str) {
    let schema =
        KNOWN.lock().unwrap().entry(form.to_owned()).or_insert_with(|| schema(form)).clone();
    let reader =
        jsonschema::validator_for(&schema).unwrap_or_else(|error| panic!("{form}: {error}"));
    let wrong: Vec<String> = reader
        .iter_errors(value)
        .map(|error| format!("{} at {}", error, error.instance_path()))
        .collect();
    assert!(wrong.is_empty(), "{form}: {}", wrong.join("\n"));
}

fn schema(form: &str) -> Value {
    let program = endline_tests::program().unwrap_or_else(|error| panic!("{error}"));
    let output = Command::new(program).args(["schema", form]).output().unwrap();
    assert!(output.status.success(), "{form}: {}", String::from_utf8_lossy(&output.stderr));
    let mut schema = serde_json::from_slice(&output.stdout).unwrap();
    close(&mut schema);
    schema
}

/// Forbids keys that a schema does not name, which schemas leave open for later versions.
fn close(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            map.values_mut().for_each(close);
            if map.get("properties").is_some_and(Value::is_object) && map.contains_key("type") {
                map.entry("additionalProperties").or_insert(json!(false));
            }
        }
        Value::Array(list) => list.iter_mut().for_each(close),
        _ => {}
    }
}

#[test]
#[should_panic(expected = "wraps_seen")]
fn a_key_that_a_form_does_not_name_is_reported() {
    let law = json!({ "schema": "endline.mill/1", "wraps_seen": 1 });
    hold(&law, "endline.mill/1");
}
