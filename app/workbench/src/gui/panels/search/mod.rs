//! The search for a real case: an observation as a form on the body map of the whale, and the progress of the search.

mod body;
mod form;
mod run;

use std::path::{Path, PathBuf};

use egui::{RichText, ScrollArea, Ui};
use endline_gear::{Diagnostic, Document, Site};
use endline_session::command::SearchAction;
use endline_session::edit::Documents;
use endline_session::edit::observation::{self, Range};

use crate::gui::command::action::WindowAction;
use crate::gui::fields::{self, Said};
use crate::gui::files::{self, FileChooser};
use crate::gui::panel::Panel;
use crate::gui::panels::start::{What, files_by_subject};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::command;

/// Edits of the observation, each one step of undo.
type Edits = Vec<Box<dyn FnOnce(&mut Document) -> Result<(), String>>>;

/// The observation and its search.
pub struct SearchPanel {
    /// Body part whose form is shown.
    pub chosen: Site,
    /// Observation for which the part was selected.
    of: Option<PathBuf>,
    map: body::Map,
    files: FileChooser,
    text: form::Typed,
}

impl Default for SearchPanel {
    fn default() -> Self {
        Self {
            chosen: Site::Body,
            of: None,
            map: body::Map::default(),
            files: FileChooser::default(),
            text: form::Typed::default(),
        }
    }
}

impl Panel for SearchPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        self.pick(ui, shared);
        if shared.documents().text(Documents::OBSERVATION).is_none() {
            widgets::nothing(
                ui,
                "Select an observation above or create a new one, which records where rope was seen on a whale. The search finds encounters that end like it.",
            );
            return;
        }
        self.begin(shared);
        run::show(ui, shared);
        ui.separator();
        ScrollArea::vertical().id_salt("observation").auto_shrink(false).show(ui, |ui| {
            let mut edits = Edits::new();
            body::show(ui, self, shared);
            form::show_part(ui, self.chosen, shared, &mut edits);
            form::show_rope(ui, shared, &mut edits);
            form::show_case(ui, &mut self.text, shared, &mut edits);
            problems(ui, shared);
            apply(shared, edits);
        });
    }
}

impl SearchPanel {
    /// Selects a body part with rope when an observation is shown for the first time.
    fn begin(&mut self, shared: &Shared) {
        let documents = shared.documents();
        let path = documents.observation_path();
        if self.of.as_deref() == path {
            return;
        }
        self.of = path.map(Path::to_owned);
        let has_rope = |single: &Site| {
            observation::sighting_of(documents, observation::site_of(documents, *single)).has_rope()
        };
        self.chosen = Site::SINGLE.into_iter().find(has_rope).unwrap_or(Site::Body);
    }

    /// Draws the choice of an observation: from the library, from a file, or a new one.
    fn pick(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let documents = shared.documents();
        let path = documents.observation_path().map(Path::to_owned);
        let unsaved = path.is_some() && documents.is_unsaved(Documents::OBSERVATION);
        let mark = if unsaved { "• " } else { "" };
        let name = documents.field(Documents::OBSERVATION, "name");
        let shown = path.as_deref().map_or_else(
            || "Select an observation".to_owned(),
            |path| format!("{mark}{}", name.unwrap_or_else(|| files::stem(path))),
        );
        ui.horizontal_wrapped(|ui| {
            let width = (ui.available_width() - 224.0).max(120.0);
            let root = shared.documents().root().to_owned();
            let list = || files_by_subject(&root, What::Observation);
            let chosen =
                self.files.show(ui, ("observation", width), (path.as_deref(), &shown), list);
            shared.commands.extend(chosen.map(|file| SearchAction::Open(file).into()));
            command(ui, shared, "Open …", WindowAction::Ask("search.open-file"));
            command(ui, shared, "New", SearchAction::New);
            command(ui, shared, "Duplicate", SearchAction::Duplicate);
        });
    }
}

/// Applies edits to the observation.
fn apply(shared: &mut Shared, edits: Edits) {
    for edit in edits {
        shared.alter(Documents::OBSERVATION, edit);
    }
}

/// Draws a field of the observation with its label.
fn typed(ui: &mut Ui, shared: &Shared, name: &str, field: &str, said: Said<'_>, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        let documents = shared.documents();
        let width = ui.available_width() - 12.0;
        if let Some(typed) = fields::edit(ui, documents, Documents::OBSERVATION, field, width, said)
        {
            let field = field.to_owned();
            edits.push(Box::new(move |document| observation::set_field(document, &field, &typed)));
        }
    });
}

/// Label, unit and help of a range.
struct Words {
    name: &'static str,
    unit: &'static str,
    help: &'static str,
}

/// Draws least and greatest value of a range.
fn ends(ui: &mut Ui, shared: &Shared, words: &Words, range: Range, edits: &mut Edits) {
    let documents = shared.documents();
    let Some(path) = range.path(documents) else { return };
    ui.horizontal(|ui| {
        widgets::name(ui, words.name);
        for (end, hint) in [(0, "least"), (1, "most")] {
            let field = format!("{path}.{end}");
            let said = Said { hint, help: words.help };
            if let Some(typed) =
                fields::edit(ui, documents, Documents::OBSERVATION, &field, 64.0, said)
            {
                let before = observation::range(documents, range);
                edits.push(Box::new(move |document| {
                    observation::set_range(document, range, before, end, &typed)
                }));
            }
            ui.label(RichText::new(["to", words.unit][end]).color(Theme::palette_of(ui).faint));
        }
    });
}

/// Draws problems of the observation.
fn problems(ui: &mut Ui, shared: &Shared) {
    let documents = shared.documents();
    let file = documents.shown_name(Documents::OBSERVATION);
    let own = documents.problems().iter().filter(|problem| problem.file == file);
    let own: Vec<Diagnostic> = own.cloned().collect();
    for problem in &own {
        widgets::problem(ui, problem);
    }
}
