//! Commands that change, open and save texts.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use endline_gear::Kind;

use super::info::{Choice, FileQuestion, Make, Shortcut, When};
use super::info::{can_redo, can_undo, has_moments, has_whale, unsaved};
use super::{Command, Info};
use crate::edit::recovery::UnsavedEdits;
use crate::edit::saving::Keep;
use crate::locate;
use crate::statics::TrialGear;
use crate::workbench::Workbench;

/// An action on texts.
#[derive(Clone, Debug, PartialEq)]
pub enum EditAction {
    /// Set a field of a text.
    Set {
        /// The text: a path in the library such as `ropes/x.toml`, or the scenario's key.
        path: String,
        /// The field, such as `whale.position.1`.
        field: String,
        /// Its value as it is typed, with its unit.
        value: String,
    },
    /// Set a field while a slider is moved: all values of one movement are one edit.
    SetHeld {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// The field.
        field: String,
        /// Its value, with its unit.
        value: String,
    },
    /// End the movement of a slider: its next value is an edit of its own.
    LetGo,
    /// Replace a text by an edited one.
    Replace {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// The edited text.
        text: String,
    },
    /// Put cells of the clipboard into the table of a kind.
    Paste {
        /// The kind of the table.
        kind: Kind,
        /// The cells, as a spreadsheet copies them.
        cells: String,
        /// Entries and fields from the chosen cell on; without, the cells have a head row.
        at: Option<(Vec<String>, Vec<&'static str>)>,
    },
    /// Add an assembly of a gear type, by its id, to the library.
    NewAssembly(String),
    /// Take the last edit back.
    Undo,
    /// Do it again.
    Redo,
    /// Save every changed text.
    Save,
    /// Decide between a file that was changed on disk and the edits of it here.
    Reconcile {
        /// The text, as for [`Set`](Self::Set).
        path: String,
        /// What is kept.
        keep: Keep,
    },
    /// Save the scenario to another file, which is open from then on.
    SaveScenarioAs(PathBuf),
    /// Open a scenario.
    OpenScenario(PathBuf),
    /// Take edits back that a crash left.
    Recover(UnsavedEdits),
    /// Weak links on or off, in the scenario.
    ToggleWeakLinks,
    /// Put the usual weak inserts along the endlines of an assembly, or of the scenario's own parts.
    AddInserts(TrialGear),
    /// Copy an entry of the library, by its path, to a file of its own.
    Duplicate(String),
    /// Delete an entry of the library, by its path. The file goes with the next save.
    Remove(String),
    /// Take a table of a kind into the library.
    ImportTable {
        /// The kind of its rows.
        kind: Kind,
        /// The file: CSV, or text with tabs.
        file: PathBuf,
    },
    /// Add an entry to the pilot program at the moment shown.
    AddEntry,
    /// Take an entry out of the pilot program, by its place.
    DeleteEntry(usize),
    /// Make the inputs of the run shown the scenario's pilot program.
    EditInputs,
}

impl EditAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Set { .. } => "edit.set",
            Self::SetHeld { .. } => "edit.set-held",
            Self::LetGo => "edit.let-go",
            Self::Replace { .. } => "edit.replace",
            Self::Paste { .. } => "edit.paste",
            Self::NewAssembly(_) => "edit.new-assembly",
            Self::Undo => "edit.undo",
            Self::Redo => "edit.redo",
            Self::Save => "edit.save",
            Self::Reconcile { .. } => "edit.reconcile",
            Self::SaveScenarioAs(_) => "edit.save-scenario-as",
            Self::OpenScenario(_) => "edit.open",
            Self::Recover(_) => "edit.recover",
            Self::ToggleWeakLinks => "edit.weak-links",
            Self::AddInserts(_) => "edit.add-inserts",
            Self::Duplicate(_) => "edit.duplicate",
            Self::Remove(_) => "edit.remove",
            Self::ImportTable { .. } => "edit.import-table",
            Self::AddEntry => "edit.add-entry",
            Self::DeleteEntry(_) => "edit.delete-entry",
            Self::EditInputs => "edit.inputs",
        }
    }
}

/// The actions on texts, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "edit.undo",
        "Undo",
        "Takes the last edit back.",
        Make::Plain(|| Command::Edit(EditAction::Undo)),
    )
    // A text being typed has an undo of its own.
    .with_keys(&[Shortcut::new("Ctrl+Z", When::Idle)])
    .only_if(can_undo),
    Info::new(
        "edit.redo",
        "Redo",
        "Does again what was taken back last.",
        Make::Plain(|| Command::Edit(EditAction::Redo)),
    )
    .with_keys(&[Shortcut::new("Ctrl+Shift+Z", When::Idle)])
    .only_if(can_redo),
    Info::new(
        "edit.save",
        "Save all",
        "Writes every changed file. Comments stay. A file that came with Endline is saved as a copy of your own.",
        Make::Plain(|| Command::Edit(EditAction::Save)),
    )
    .with_keys(&[Shortcut::new("Ctrl+S", When::Always)])
    .only_if(unsaved),
    Info::new(
        "edit.save-scenario-as",
        "Save the scenario as",
        "Writes the scenario to another file, which is open from then on.",
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
    Info::new(
        "edit.open",
        "Open",
        "Opens a scenario of the library.",
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
                FileQuestion::read("scenario", &["toml"]).within(workbench.project.documents.root())
            },
            command: |_, file| open(file),
        },
    ),
    Info::new(
        "edit.weak-links",
        "Weak links on or off",
        "Changes the scenario so that weak links part, or do not, and makes the model again.",
        Make::Plain(|| Command::Edit(EditAction::ToggleWeakLinks)),
    )
    .with_keys(&[Shortcut::with_pad("K", When::Idle, "Y")]),
    Info::new(
        "edit.add-entry",
        "Add an entry to the pilot program",
        "Adds an entry that begins at the moment shown.",
        Make::Plain(|| Command::Edit(EditAction::AddEntry)),
    )
    .only_if(has_whale),
    Info::new(
        "edit.inputs",
        "Edit the inputs of this run",
        "Makes what was flown or steered in the run shown the scenario's pilot program.",
        Make::Plain(|| Command::Edit(EditAction::EditInputs)),
    )
    .only_if(has_moments),
    Info::new(
        "edit.set",
        "Set a field",
        "Sets a field of a file or of the scenario to a value with its unit.",
        Make::Values("path, field, value"),
    ),
    Info::new(
        "edit.set-held",
        "Set a field while a slider is moved",
        "Sets a field as a slider is moved; all values of one movement are one edit.",
        Make::Values("path, field, value"),
    ),
    Info::new(
        "edit.let-go",
        "End the movement of a slider",
        "Ends the movement of a slider; its next value is an edit of its own.",
        Make::Values("nothing"),
    ),
    Info::new(
        "edit.replace",
        "Replace a text",
        "Replaces a text by an edited one; one undo takes it back.",
        Make::Values("path, text"),
    ),
    Info::new(
        "edit.paste",
        "Paste cells",
        "Puts cells of the clipboard into a library table, from a cell on or by their head row.",
        Make::Values("kind, cells, place"),
    ),
    Info::new(
        "edit.new-assembly",
        "New gear",
        "Adds an assembly of a gear type to the library, with the usual values of its attributes.",
        Make::Values("gear type"),
    ),
    Info::new(
        "edit.recover",
        "Recover unsaved edits",
        "Takes up the edits that a program which ended by a fault had not saved.",
        Make::Values("the edits kept"),
    ),
    Info::new(
        "edit.reconcile",
        "Decide about a file changed on disk",
        "Keeps the edits made here, what someone else wrote to the file since, or both.",
        Make::Values("path, what is kept"),
    ),
    Info::new(
        "edit.add-inserts",
        "Put in weak inserts",
        "Puts 3 ft of weak rope every 60 ft into the top three quarters of each endline of an assembly, or of the scenario's own parts.",
        Make::Values("gear"),
    ),
    Info::new(
        "edit.duplicate",
        "Duplicate an entry",
        "Copies an entry of the library to a file of its own.",
        Make::Values("path"),
    ),
    Info::new(
        "edit.remove",
        "Delete an entry",
        "Deletes an entry of the library that the open scenario does not use; its file goes with the next save.",
        Make::Values("path"),
    ),
    Info::new(
        "edit.import-table",
        "Import a table",
        "Changes the entries of a library table that a CSV file names, and adds those that it does not know.",
        Make::Values("kind, file"),
    ),
    Info::new(
        "edit.delete-entry",
        "Delete an entry of the pilot program",
        "Takes an entry out of the pilot program.",
        Make::Values("its place"),
    )
    .only_if(has_whale),
];

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
