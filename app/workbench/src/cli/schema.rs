//! `endline schema`: the JSON forms that commands print, and the schema of each.

use std::process::ExitCode;

use endline_session::forms::{FORMS, Form, schema_of};

use super::table::columns;
use super::{Failure, output, replay, study, validate};

/// The forms that only the command line writes.
static OWN: &[Form] = &[
    Form { name: replay::SCHEMA, commands: &["replay"], schema: schema_of::<replay::ReplayReport> },
    Form {
        name: validate::SCHEMA,
        commands: &["validate"],
        schema: schema_of::<validate::Report<'static>>,
    },
    Form {
        name: study::status::SCHEMA,
        commands: &["study status"],
        schema: schema_of::<study::status::Status>,
    },
];

/// Prints the schema of a form, or the forms there are.
pub(super) fn schema(named: Option<&str>) -> Result<ExitCode, Failure> {
    let Some(named) = named else {
        output::print(&listed())?;
        return Ok(ExitCode::SUCCESS);
    };
    let form = forms().find(|form| goes_by(form, named)).ok_or_else(|| {
        let names: Vec<&str> = forms().map(|form| form.name).collect();
        Failure::usage(format!("no form `{named}`; there are {}", names.join(", ")))
    })?;
    let text = serde_json::to_string_pretty(&form.titled()).map_err(Failure::failed)?;
    output::print(&(text + "\n"))?;
    Ok(ExitCode::SUCCESS)
}

fn forms() -> impl Iterator<Item = &'static Form> {
    FORMS.iter().chain(OWN)
}

fn goes_by(form: &Form, named: &str) -> bool {
    form.name == named || form.commands.contains(&named)
}

fn listed() -> String {
    let mut rows = vec![["form", "printed by"].map(str::to_owned).to_vec()];
    rows.extend(forms().map(|form| {
        let commands: Vec<String> =
            form.commands.iter().map(|command| format!("endline {command} --json")).collect();
        vec![form.name.to_owned(), commands.join(", ")]
    }));
    columns(&rows)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use clap::CommandFactory;

    use super::super::args::Args;
    use super::*;

    fn with_json(command: &clap::Command, path: &str, found: &mut BTreeSet<String>) {
        if command.get_arguments().any(|argument| argument.get_id() == "json") {
            found.insert(path.trim().to_owned());
        }
        for own in command.get_subcommands() {
            with_json(own, &format!("{path} {}", own.get_name()), found);
        }
    }

    #[test]
    fn every_command_that_prints_json_has_a_form() {
        let mut asked = BTreeSet::new();
        with_json(&Args::command(), "", &mut asked);
        let told = forms()
            .flat_map(|form| form.commands)
            .map(|command| command.split(" --").next().unwrap_or_default().to_owned());
        assert_eq!(asked, told.collect());
    }

    /// What a reader of a schema gets to know: every key has a meaning, in words and not in links of the source.
    #[test]
    fn every_key_of_every_form_is_described() {
        fn look(schema: &serde_json::Value, at: &str) {
            for (key, own) in schema["properties"].as_object().into_iter().flatten() {
                let text = own["description"].as_str().unwrap_or_default();
                assert!(!text.is_empty() && !text.contains("[`"), "{at}, {key}: {text:?}");
            }
            match schema {
                serde_json::Value::Object(map) => {
                    map.iter().for_each(|(key, own)| look(own, &format!("{at} {key}")));
                }
                serde_json::Value::Array(list) => list.iter().for_each(|own| look(own, at)),
                _ => {}
            }
        }
        for form in forms() {
            let schema = form.titled();
            assert_eq!(schema.get("title"), Some(&form.name.into()));
            let schema = schema.as_value();
            // What is written names the form under which it is listed; a bare list names none.
            let written = schema["properties"]["schema"].get("const");
            assert!(
                schema["type"] == "array" || written == Some(&form.name.into()),
                "{}",
                form.name
            );
            look(schema, form.name);
        }
    }
}
