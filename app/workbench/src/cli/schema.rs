//! `endline schema`, `docs`, `completions` and `man`: JSON forms and their schemas, documents, shell completion, manual pages.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::Shell;
use endline_session::forms::{FORMS, Form, schema_of};
use endline_session::study::threat::{STRENGTH_SCHEMA, StrengthThreats};

use super::args::Args;
use super::table::columns;
use super::{Failure, output, replay, study, validate, whale};
use crate::documents::{self, Document};

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
    Form { name: whale::AIM, commands: &["whale aim"], schema: schema_of::<whale::AimedStart> },
    Form {
        name: STRENGTH_SCHEMA,
        commands: &["study threat"],
        schema: schema_of::<StrengthThreats>,
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

/// Prints a document as Markdown, or the documents there are.
pub(super) fn docs(named: Option<&str>) -> Result<ExitCode, Failure> {
    let Some(named) = named else {
        output::print(&documents_listed())?;
        return Ok(ExitCode::SUCCESS);
    };
    let document = documents::find(named).ok_or_else(|| {
        let names: Vec<&str> = documents::all().map(|document| document.name).collect();
        let hint = endline_gear::hint(named, names);
        Failure::usage(format!("no document `{named}`; {hint}; `endline docs` lists all"))
    })?;
    output::print(document.text)?;
    Ok(ExitCode::SUCCESS)
}

fn documents_listed() -> String {
    let row = |document: Document| [document.name, document.title].map(str::to_owned).to_vec();
    let mut rows = vec![["document", "about"].map(str::to_owned).to_vec()];
    rows.extend(documents::all().map(row));
    columns(&rows)
}

/// Prints the script by which a shell completes this program's arguments.
pub(super) fn completions(shell: Shell) -> ExitCode {
    clap_complete::generate(shell, &mut Args::command(), "endline", &mut io::stdout());
    ExitCode::SUCCESS
}

/// Writes a manual page for the program and each of its commands into a folder.
pub(super) fn man(folder: &Path) -> Result<ExitCode, Failure> {
    let failed = |error: io::Error| {
        Failure::failed(format!("{}: the pages cannot be written: {error}", folder.display()))
    };
    std::fs::create_dir_all(folder).map_err(failed)?;
    clap_mangen::generate_to(Args::command(), folder).map_err(failed)?;
    output::note(&format!("read them with `man -l {}/endline.1`", folder.display()));
    Ok(ExitCode::SUCCESS)
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
        let declared = forms()
            .flat_map(|form| form.commands)
            .map(|command| command.split(" --").next().unwrap_or_default().to_owned());
        assert_eq!(asked, declared.collect());
    }

    /// Every key of a schema has a meaning in words, without links of the source.
    #[test]
    fn every_key_of_every_form_is_described() {
        fn check(schema: &serde_json::Value, at: &str) {
            for (key, own) in schema["properties"].as_object().into_iter().flatten() {
                let text = own["description"].as_str().unwrap_or_default();
                assert!(!text.is_empty() && !text.contains("[`"), "{at}, {key}: {text:?}");
            }
            match schema {
                serde_json::Value::Object(map) => {
                    map.iter().for_each(|(key, own)| check(own, &format!("{at} {key}")));
                }
                serde_json::Value::Array(list) => list.iter().for_each(|own| check(own, at)),
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
            check(schema, form.name);
        }
    }
}
