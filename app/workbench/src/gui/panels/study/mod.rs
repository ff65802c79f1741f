//! The designer of a study: its question, its options, how encounters are drawn; and the queue of studies.

mod options;
mod priors;
mod queue;

use crate::gui::command::action::{PanelAction, WindowAction};
use crate::gui::widgets::command;
use endline_session::command::{EditAction, StudyAction};
use std::path::{Path, PathBuf};

use egui::{RichText, ScrollArea, Ui};
use endline_gear::{Diagnostic, Document, Setting, StudyEvent, prior_words};
use endline_session::edit::Documents;

use crate::gui::fields::{self, Said};
use crate::gui::files::{self, FileChooser};
use crate::gui::layout::Layout;
use crate::gui::panel::{Panel, PanelId};
use crate::gui::panels::start::{What, files_by_subject};
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};
use crate::gui::widgets;
use crate::gui::widgets::words::capital;

/// Edits of the study: dotted path and value as TOML; `None` removes the field.
type Edits = Vec<(String, Option<Setting>)>;

/// The designer of a study, and the queue.
#[derive(Debug, Default)]
pub struct StudyPanel {
    files: FileChooser,
    scenario: ScenarioChoice,
}

/// The choice of the scenario of a study.
#[derive(Debug, Default)]
struct ScenarioChoice {
    files: FileChooser,
    /// The file of the chosen scenario, and its name.
    named: (PathBuf, String),
}

impl Panel for StudyPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        pick(ui, shared, &mut self.files);
        show(ui, shared, &mut self.scenario);
    }
}

/// Draws the study with its queue.
fn show(ui: &mut Ui, shared: &mut Shared, scenario: &mut ScenarioChoice) {
    if shared.documents().text(Documents::STUDY).is_none() {
        widgets::nothing(
            ui,
            "Select a study above. A study runs every option of gear on the same drawn encounters and counts the outcomes.",
        );
        queue::show(ui, shared);
        return;
    }
    start(ui, shared);
    queue::show(ui, shared);
    ui.separator();
    ScrollArea::vertical().id_salt("designer").auto_shrink(false).show(ui, |ui| {
        let mut edits = Edits::new();
        question(ui, shared, scenario, &mut edits);
        options::show(ui, shared, &mut edits);
        priors::show(ui, shared, &mut edits);
        problems(ui, shared);
        apply(shared, edits);
    });
}

/// Applies edits to the study, as one step of undo.
fn apply(shared: &mut Shared, edits: Edits) {
    if edits.is_empty() {
        return;
    }
    let message = |error: endline_gear::EditError| error.message;
    let change = |document: &mut Document| {
        edits.iter().try_for_each(|(path, value)| match value {
            Some(value) => document.put(path, value).map_err(message),
            None if document.has(path) => document.remove(path).map_err(message),
            None => Ok(()),
        })
    };
    shared.alter(Documents::STUDY, change);
}

fn pick(ui: &mut Ui, shared: &mut Shared, chooser: &mut FileChooser) {
    let path = shared.documents().study_path().map(Path::to_owned);
    let mark =
        if path.is_some() && shared.documents().is_unsaved(Documents::STUDY) { "• " } else { "" };
    ui.horizontal(|ui| {
        let name = shared.documents().field(Documents::STUDY, "name");
        let shown = path.as_deref().map_or_else(
            || "Select a study".to_owned(),
            |path| format!("{mark}{}", name.unwrap_or_else(|| files::stem(path))),
        );
        let (root, width) = (shared.documents().root().to_owned(), ui.available_width() - 152.0);
        let list = || files_by_subject(&root, What::Study);
        if let Some(file) = chooser.show(ui, ("study", width), (path.as_deref(), &shown), list) {
            shared.give(StudyAction::Open(file));
        }
        command(ui, shared, "Open …", WindowAction::Ask("study.open-file"));
        command(ui, shared, "Duplicate", StudyAction::Duplicate);
    });
}

/// Draws the buttons that run the study and open results.
fn start(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    let ready = shared.workbench.study_is_sound() && shared.workbench.studies().check.is_clean();
    ui.horizontal_wrapped(|ui| {
        if primary(ui, ready, "Run study")
            .on_hover_text("Runs the missing encounters at low priority. Saves no file; a cancelled study continues when it is run again")
            .clicked()
        {
            shared.give(StudyAction::Run);
        }
        command(ui, shared, "Forecast", StudyAction::Forecast);
        command(ui, shared, "Copy as command line", WindowAction::CopyStudyLine);
        command(ui, shared, "Open results …", WindowAction::Ask("study.results"));
        let help = "Runs at normal priority instead of low; the window may respond more slowly";
        let mut full_speed = shared.workbench.studies().queue.normal_priority;
        if ui.checkbox(&mut full_speed, "Full speed").on_hover_text(help).changed() {
            shared.perform(StudyAction::FullSpeed(full_speed));
        }
        if !ready {
            ui.label(RichText::new("has errors: see below or in Problems").color(faint));
        }
    });
}

fn question(ui: &mut Ui, shared: &mut Shared, scenario: &mut ScenarioChoice, edits: &mut Edits) {
    widgets::caption(ui, "Question");
    text(ui, shared, "Name", "name", "Shown in the report");
    text(ui, shared, "Notes", "notes", "Purpose of the study, shown below the name in the report");
    scenario.show(ui, shared, edits);
    design(ui, shared);
    number(
        ui,
        shared,
        ("Encounters", "encounters"),
        "Number of encounters, the same for every option, at most 65,536",
        edits,
    );
    let mut events: Vec<(String, String)> =
        StudyEvent::all().iter().map(|event| (event.name(), event.words())).collect();
    if !shared.documents().has(Documents::STUDY, "event") {
        events.insert(0, (String::new(), StudyEvent::Entangled.words()));
    }
    choice(ui, shared, ("Event", "event"), &events, edits);
    let options = option_names(shared.documents());
    choice(ui, shared, ("Baseline", "baseline"), &options, edits);
    let drawn = shared.documents().keys(Documents::STUDY, "encounter").into_iter();
    let chosen = drawn
        .filter(|name| {
            shared.documents().has(Documents::STUDY, &format!("encounter.{name}.choice"))
        })
        .map(|name| name.replace('"', ""));
    let words = |name: String| (name.clone(), capital(&prior_words(&name)));
    let mut levels: Vec<(String, String)> = chosen.map(words).collect();
    levels.insert(0, (String::new(), "no split".into()));
    choice(ui, shared, ("Results split by", "split"), &levels, edits);
    number(ui, shared, ("Seed", "seed"), "Seed of the drawn encounters", edits);
    number(
        ui,
        shared,
        ("Stop at width", "enough.narrower"),
        "Stops the study when the confidence interval of every option's rate is narrower than this, such as 0.05 for 5 percentage points; empty: runs all encounters",
        edits,
    );
}

fn text(ui: &mut Ui, shared: &mut Shared, name: &str, field: &str, help: &str) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        let width = ui.available_width() - 12.0;
        if let Some(typed) = fields::edit(
            ui,
            shared.documents(),
            Documents::STUDY,
            field,
            width,
            Said { hint: "", help },
        ) {
            shared.set(Documents::STUDY, field, &typed);
        }
    });
}

fn number(
    ui: &mut Ui,
    shared: &Shared,
    (name, field): (&str, &str),
    help: &str,
    edits: &mut Edits,
) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        if let Some(typed) = fields::edit(
            ui,
            shared.documents(),
            Documents::STUDY,
            field,
            90.0,
            Said { hint: "not set", help },
        ) {
            let typed = typed.replace(',', "");
            let value = (!typed.trim().is_empty()).then(|| Setting::plain(typed.trim()));
            if field == "enough.narrower" {
                let event = shared
                    .documents()
                    .field(Documents::STUDY, "event")
                    .unwrap_or_else(|| "entangled".into());
                match value {
                    Some(_) => edits.push(("enough.event".into(), Some(Setting::text(&event)))),
                    None => return edits.push(("enough".into(), None)),
                }
            }
            edits.push((field.to_owned(), value));
        }
    });
}

/// Draws a button that opens the scenario of the study, if another one is open, so that an option can be made from edits of it.
fn design(ui: &mut Ui, shared: &mut Shared) {
    let documents = shared.documents();
    let Some(id) = documents.field(Documents::STUDY, "scenario") else { return };
    let file = documents.root().join(format!("scenarios/{id}.toml"));
    if files::stem(documents.scenario_path()) == id || !file.is_file() {
        return;
    }
    let help = "Opens the scenario. Edit its gear without saving, then return here and click \"From unsaved edits\"";
    ui.horizontal(|ui| {
        widgets::name(ui, "");
        if ui.button("Open the scenario").on_hover_text(help).clicked() {
            // Gear without an assembly is edited in the scenario itself.
            let text = endline_gear::read::text(&file).unwrap_or_default();
            let has_assembly = Document::parse(&text).is_ok_and(|scenario| scenario.has("gear"));
            shared.give(EditAction::OpenScenario(file));
            shared.give(PanelAction::Arrange(Layout::Design));
            if has_assembly {
                shared.give(PanelAction::Show(PanelId::Assembly));
            }
        }
    });
}

fn choice(
    ui: &mut Ui,
    shared: &Shared,
    (name, field): (&str, &str),
    choices: &[(String, String)],
    edits: &mut Edits,
) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        let width = ui.available_width() - 12.0;
        if let Some(taken) =
            fields::choose(ui, shared.documents(), Documents::STUDY, field, choices, width)
        {
            edits.push((field.to_owned(), (!taken.is_empty()).then(|| Setting::text(&taken))));
        }
    });
}

impl ScenarioChoice {
    fn show(&mut self, ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
        ui.horizontal(|ui| {
            widgets::name(ui, "Scenario");
            let id = shared.documents().field(Documents::STUDY, "scenario").unwrap_or_default();
            let root = shared.documents().root().to_owned();
            let file = root.join(format!("scenarios/{id}.toml"));
            if self.named.0 != file {
                self.named = (file.clone(), files::name_of(&file).unwrap_or(id));
            }
            let list = || files_by_subject(&root, What::Scenario);
            let (width, present) = (ui.available_width() - 12.0, (Some(&*file), &*self.named.1));
            let chosen = self.files.show(ui, ("study scenario", width), present, list);
            if let Some(file) = chosen {
                edits.push(("scenario".into(), Some(Setting::text(&files::stem(&file)))));
            }
        });
    }
}

/// Ids of the options, in the order of the file.
fn option_ids(documents: &Documents) -> Vec<String> {
    (0..)
        .map_while(|index| documents.field(Documents::STUDY, &format!("option.{index}.id")))
        .collect()
}

/// Ids and names of the options.
fn option_names(documents: &Documents) -> Vec<(String, String)> {
    let name = |(index, id): (usize, String)| {
        let name = documents.field(Documents::STUDY, &format!("option.{index}.name"));
        (id.clone(), name.unwrap_or(id))
    };
    option_ids(documents).into_iter().enumerate().map(name).collect()
}

/// Draws problems of the study's file and of its assembled options.
fn problems(ui: &mut Ui, shared: &Shared) {
    let file = shared.documents().shown_name(Documents::STUDY);
    let own: Vec<Diagnostic> = shared
        .documents()
        .problems()
        .iter()
        .filter(|problem| problem.file == file)
        .cloned()
        .collect();
    let check = &shared.workbench.studies().check;
    for problem in own.iter().chain(check.problems()) {
        widgets::problem(ui, problem);
    }
    if let Some(fault) = check.fault() {
        ui.label(RichText::new(fault).color(Theme::palette_of(ui).error));
    }
}

/// A field of the scenario or of a library item in words, by its dotted path: `line.0.weak_places.strength` is
/// `line 1, weak places: strength`.
fn field_words(documents: &Documents, path: &str) -> String {
    path_words(path, |item| documents.field(&format!("{item}.toml"), "name"))
}

fn path_words(path: &str, name_of: impl Fn(&str) -> Option<String>) -> String {
    let path = path.replace('"', "");
    let (item, field) = match path.split_once('.') {
        Some((item, field)) if item.contains('/') => (Some(item), field),
        _ => (None, path.as_str()),
    };
    let mut words: Vec<String> = Vec::new();
    if let Some(item) = item {
        words.push(name_of(item).unwrap_or_else(|| item.to_owned()));
    }
    for part in field.split('.').filter(|part| *part != "attributes") {
        match (part.parse::<usize>(), words.last_mut()) {
            (Ok(index), Some(before)) => before.push_str(&format!(" {}", index + 1)),
            _ => words.push(part.replace('_', " ")),
        }
    }
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, before)) => format!("{}: {last}", before.join(", ")),
        None => path,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_fields_read_as_words() {
        let name =
            |item: &str| (item == "ropes/sink-3-8").then(|| "Sinking rope, 3/8 in".to_owned());
        for (path, words) in [
            ("tide", "tide"),
            ("weak_links", "weak links"),
            ("line.0.weak_places.strength", "line 1, weak places: strength"),
            ("\"gear.0.attributes.buoy\"", "gear 1: buoy"),
            ("ropes/sink-3-8.strength", "Sinking rope, 3/8 in: strength"),
        ] {
            assert_eq!(path_words(path, name), words);
        }
    }
}
