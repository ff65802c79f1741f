//! Commands that change, open and save texts.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::Kind;
use endline_sdk::GearType;
use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::info::{Choice, FileQuestion, Make, When, has_moments, has_whale, require};
use super::{Command, Info};
use crate::edit::recovery::UnsavedEdits;
use crate::edit::saving::Keep;
use crate::locate;
use crate::statics::TrialGear;
use crate::workbench::Workbench;

/// An action on texts.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(EditVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "edit.", serialize_all = "kebab-case"))]
pub enum EditAction {
    /// Sets a field of a file or of the scenario to a value with its unit.
    #[strum_discriminants(strum(message = "Set a field"))]
    Set {
        /// The text: a path in the library such as `ropes/x.toml`, or the scenario's key.
        path: String,
        /// The field, such as `whale.position.1`.
        field: String,
        /// Its value as it is typed, with its unit.
        value: String,
    },
    /// Sets a field as a slider is moved; all values of one movement are one edit.
    #[strum_discriminants(strum(message = "Set a field while a slider is moved"))]
    SetHeld {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// The field.
        field: String,
        /// Its value, with its unit.
        value: String,
    },
    /// Ends the movement of a slider; its next value is an edit of its own.
    #[strum_discriminants(strum(message = "End the movement of a slider"))]
    LetGo,
    /// Replaces a text by an edited one; one undo takes it back.
    #[strum_discriminants(strum(message = "Replace a text"))]
    Replace {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// The edited text.
        text: String,
    },
    /// Puts cells of the clipboard into a library table, from a cell on or by their head row.
    #[strum_discriminants(strum(message = "Paste cells"))]
    Paste {
        /// The kind of the table.
        kind: Kind,
        /// The cells, as a spreadsheet copies them.
        cells: String,
        /// Entries and fields from the chosen cell on; without, the cells have a head row.
        at: Option<(Vec<String>, Vec<&'static str>)>,
    },
    /// Adds an assembly of a gear type to the library, with the usual values of its attributes.
    #[strum_discriminants(strum(message = "New gear"))]
    NewAssembly(String),
    /// Takes the last edit back.
    #[strum_discriminants(strum(message = "Undo"))]
    Undo,
    /// Does again what was taken back last.
    #[strum_discriminants(strum(message = "Redo"))]
    Redo,
    /// Writes every changed file. Comments stay. A file that came with Endline is saved as a copy of your own.
    #[strum_discriminants(strum(message = "Save all"))]
    Save,
    /// Keeps the edits made here, what someone else wrote to the file since, or both.
    #[strum_discriminants(strum(message = "Decide about a file changed on disk"))]
    Reconcile {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// What is kept.
        keep: Keep,
    },
    /// Writes the scenario to another file, which is open from then on.
    #[strum_discriminants(strum(message = "Save the scenario as"))]
    SaveScenarioAs(PathBuf),
    /// Opens a scenario of the library.
    #[strum_discriminants(strum(message = "Open", serialize = "open"))]
    OpenScenario(PathBuf),
    /// Takes up the edits that a program which ended by a fault had not saved.
    #[strum_discriminants(strum(message = "Recover unsaved edits"))]
    Recover(UnsavedEdits),
    /// Changes the scenario so that weak links part, or do not, and makes the model again.
    #[strum_discriminants(strum(message = "Weak links on or off", serialize = "weak-links"))]
    ToggleWeakLinks,
    /// Puts 3 ft of weak rope every 60 ft into the top three quarters of each endline of an assembly, or of the scenario's own parts.
    #[strum_discriminants(strum(message = "Put in weak inserts"))]
    AddInserts(TrialGear),
    /// Copies an entry of the library to a file of its own.
    #[strum_discriminants(strum(message = "Duplicate an entry"))]
    Duplicate(String),
    /// Deletes an entry of the library that the open scenario does not use; its file goes with the next save.
    #[strum_discriminants(strum(message = "Delete an entry"))]
    Remove(String),
    /// Changes the entries of a library table that a CSV file names, and adds those that it does not know.
    #[strum_discriminants(strum(message = "Import a table"))]
    ImportTable {
        /// The kind of its rows.
        kind: Kind,
        /// The file: CSV, or text with tabs.
        file: PathBuf,
    },
    /// Adds an entry that begins at the moment shown.
    #[strum_discriminants(strum(message = "Add an entry to the pilot program"))]
    AddEntry,
    /// Takes an entry out of the pilot program.
    #[strum_discriminants(strum(message = "Delete an entry of the pilot program"))]
    DeleteEntry(usize),
    /// Makes what was flown or steered in the run shown the scenario's pilot program.
    #[strum_discriminants(strum(message = "Edit the inputs of this run", serialize = "inputs"))]
    EditInputs,
}

/// The actions on texts, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::plain(EditAction::Undo)
            // A text being typed has an undo of its own.
            .with_key("Ctrl+Z", When::Idle)
            .only_if(|workbench| {
                let (undo, _) = workbench.project.documents.can_undo_redo();
                require(undo, "nothing to undo")
            }),
        Info::plain(EditAction::Redo).with_key("Ctrl+Shift+Z", When::Idle).only_if(|workbench| {
            let (_, redo) = workbench.project.documents.can_undo_redo();
            require(redo, "nothing to redo")
        }),
        Info::plain(EditAction::Save).with_key("Ctrl+S", When::Always).only_if(|workbench| {
            require(!workbench.project.documents.unsaved().is_empty(), "nothing to save")
        }),
        Info::of(
            EditVerb::SaveScenarioAs,
            Make::File {
                question: |workbench| {
                    let path = workbench.project.documents.scenario_path();
                    let name = format!("{}-2.toml", workbench.scenario_stem());
                    let question = FileQuestion::write("scenario", &["toml"], name);
                    path.parent().map_or(question.clone(), |folder| question.within(folder))
                },
                command: |_, file| Command::Edit(EditAction::SaveScenarioAs(file)),
            },
        ),
        Info::of(
            EditVerb::OpenScenario,
            Make::Choices(|workbench| {
                locate::scenarios(workbench.project.documents.root())
                    .into_iter()
                    .map(|path| Choice::new(stem(&path), open(path)))
                    .collect()
            }),
        ),
        Info::new(
            "edit.open-file",
            "Open another scenario",
            "Opens a scenario from any folder.",
            Make::File {
                question: |workbench| {
                    FileQuestion::read("scenario", &["toml"])
                        .within(workbench.project.documents.root())
                },
                command: |_, file| open(file),
            },
        ),
        Info::plain(EditAction::ToggleWeakLinks).with_key_and_pad("K", When::Idle, "Y"),
        Info::plain(EditAction::AddEntry).only_if(has_whale),
        Info::plain(EditAction::EditInputs).only_if(has_moments),
        Info::values(EditVerb::Set, "path, field, value"),
        Info::values(EditVerb::SetHeld, "path, field, value"),
        Info::values(EditVerb::LetGo, "nothing"),
        Info::values(EditVerb::Replace, "path, text"),
        Info::values(EditVerb::Paste, "kind, cells, place"),
        Info::of(
            EditVerb::NewAssembly,
            Make::Choices(|workbench| {
                let types = workbench.gear_types();
                let choice = |gear: &Arc<dyn GearType>| {
                    let about = gear.descriptor();
                    let new = EditAction::NewAssembly(about.id.to_string());
                    Choice::new(about.name.to_lowercase(), Command::Edit(new))
                };
                types.iter().map(choice).collect()
            }),
        )
        .only_if(|workbench| {
            require(!workbench.gear_types().is_empty(), "no plugin has a gear type")
        }),
        Info::values(EditVerb::Recover, "the edits kept"),
        Info::values(EditVerb::Reconcile, "path, what is kept"),
        Info::values(EditVerb::AddInserts, "gear"),
        Info::values(EditVerb::Duplicate, "path"),
        Info::values(EditVerb::Remove, "path"),
        Info::values(EditVerb::ImportTable, "kind, file"),
        Info::values(EditVerb::DeleteEntry, "its place").only_if(has_whale),
    ]
}

fn open(path: PathBuf) -> Command {
    Command::Edit(EditAction::OpenScenario(path))
}

/// A file's name without folder and extension.
pub(super) fn stem(path: &std::path::Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: EditAction) -> Result<(), String> {
    match action {
        EditAction::Set { path, field, value } => workbench.set_field(&path, &field, &value),
        EditAction::SetHeld { path, field, value } => {
            workbench.project.documents.set_held(&path, &field, &value)
        }
        EditAction::LetGo => {
            workbench.project.documents.let_go();
            Ok(())
        }
        EditAction::Replace { path, text } => {
            workbench.project.documents.put_all(vec![(path, text)]);
            Ok(())
        }
        EditAction::Paste { kind, cells, at } => workbench.paste(kind, &cells, at),
        EditAction::NewAssembly(gear_type) => workbench.new_assembly(&gear_type),
        EditAction::Undo => workbench.undo(),
        EditAction::Redo => workbench.redo(),
        EditAction::Save => workbench.save(),
        EditAction::Reconcile { path, keep } => workbench.reconcile(&path, keep),
        EditAction::SaveScenarioAs(path) => workbench.save_scenario_as(&path),
        EditAction::OpenScenario(path) => workbench.open_scenario(&path),
        EditAction::Recover(edits) => workbench.recover(&edits),
        EditAction::ToggleWeakLinks => workbench.toggle_weak_links(),
        EditAction::AddInserts(gear) => workbench.add_inserts(&gear),
        EditAction::Duplicate(path) => workbench.duplicate(path),
        EditAction::Remove(path) => workbench.remove(&path),
        EditAction::ImportTable { kind, file } => workbench.import_table(kind, &file),
        EditAction::AddEntry => workbench.add_entry(),
        EditAction::DeleteEntry(index) => workbench.delete_entry(index),
        EditAction::EditInputs => workbench.edit_inputs(),
    }
}
