//! The case of an observation: animal, source and confidence; the encounters to search; and its text.

use egui::{CollapsingHeader, TextEdit, Ui};
use endline_gear::Setting;
use endline_session::command::EditAction;
use endline_session::edit::Documents;
use endline_session::edit::observation;

use super::{Edits, typed};
use crate::gui::fields::{self, Said};
use crate::gui::files;
use crate::gui::shared::Shared;
use crate::gui::widgets;

/// Text being typed and not applied yet.
#[derive(Debug, Default)]
pub(super) struct Typed(Option<String>);

/// Draws the form of the case.
pub(super) fn show(ui: &mut Ui, text: &mut Typed, shared: &mut Shared, edits: &mut Edits) {
    widgets::caption(ui, "The case");
    let said = |hint, help| Said { hint, help };
    typed(ui, shared, "Name", "name", said("", "Shown in lists and reports"), edits);
    typed(
        ui,
        shared,
        "Source",
        "source",
        said("observer, publication", "Observer and publication"),
        edits,
    );
    let known = ["measured", "derived", "estimate"].map(|word| (word.to_owned(), word.to_owned()));
    choice(ui, shared, ("Confidence", "confidence"), &known, edits);
    let whales = &shared.documents().library().whales;
    let whales = whales.iter().map(|whale| (whale.entry.id.clone(), whale.entry.name.clone()));
    let mut whales: Vec<(String, String)> = whales.collect();
    whales.insert(0, (String::new(), "drawn with the encounters".to_owned()));
    choice(ui, shared, ("Animal", "whale"), &whales, edits);
    let help = "Such as 1 yr, instead of a length; sets the length";
    typed(ui, shared, "Age", "age", said("not known", help), edits);
    let help = "Such as 9.1 m or 30 ft, instead of an age";
    typed(ui, shared, "Length", "length", said("not known", help), edits);
    typed(ui, shared, "Notes", "notes", said("", "Remarks, shown in the report"), edits);
    widgets::caption(ui, "Search");
    let studies = files::studies(shared.documents().root());
    let studies: Vec<(String, String)> =
        studies.iter().map(|file| (files::stem(file), files::stem(file))).collect();
    choice(ui, shared, ("Encounters", "encounters"), &studies, edits);
    mirrored(ui, shared, edits);
    as_text(ui, text, shared);
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
        let documents = shared.documents();
        if let Some(taken) =
            fields::choose(ui, documents, Documents::OBSERVATION, field, choices, width)
        {
            let field = field.to_owned();
            edits.push(Box::new(move |document| observation::set_field(document, &field, &taken)));
        }
    });
}

fn mirrored(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
    let documents = shared.documents();
    let mut on = documents.field(Documents::OBSERVATION, "mirrored").as_deref() == Some("true");
    let help = "Endings that are mirror images of the observation match too; finds more where sides do not matter";
    if ui.checkbox(&mut on, "Mirror images match too").on_hover_text(help).clicked() {
        let value = Setting::plain(if on { "true" } else { "false" });
        edits.push(Box::new(move |document| {
            document.put("mirrored", &value).map_err(|error| error.to_string())
        }));
    }
}

/// Draws the text of the observation; edits apply when the editor loses the focus.
fn as_text(ui: &mut Ui, typed: &mut Typed, shared: &mut Shared) {
    CollapsingHeader::new("As text").id_salt("observation as text").show(ui, |ui| {
        let stored = shared.documents().text(Documents::OBSERVATION);
        let stored = stored.unwrap_or_default().to_owned();
        let mut text = typed.0.take().unwrap_or_else(|| stored.clone());
        let editor = TextEdit::multiline(&mut text).code_editor().desired_width(f32::INFINITY);
        let response = ui.add(editor);
        if response.lost_focus() && text != stored {
            shared.perform(EditAction::Replace { path: Documents::OBSERVATION.to_owned(), text });
        } else if response.has_focus() {
            typed.0 = Some(text);
        }
    });
}
