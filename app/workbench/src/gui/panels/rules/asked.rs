//! The question to the rules: the assembly, and where, when and how it is fished.

use egui::{ComboBox, RichText, TextEdit, Ui};
use endline_session::command::RuleAction;
use endline_session::edit::library_table::id_of;
use endline_session::workbench::RuleQuestion;

use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Texts being typed and not applied yet.
#[derive(Debug, Default)]
pub(super) struct Typed {
    /// The field being typed in, and its content.
    now: Option<(&'static str, String)>,
}

/// Least width for one line [points].
const ONE_LINE: f32 = 900.0;

/// A field of the question.
struct Field {
    name: &'static str,
    width: f32,
    hint: &'static str,
    help: &'static str,
    of: fn(&mut RuleQuestion) -> &mut String,
}

const FIELDS: [Field; 4] = [
    Field {
        name: "Day",
        width: 82.0,
        hint: "2024-06-01",
        help: "Date of fishing: year, month, day. Rules have dates of validity and seasons",
        of: |question| &mut question.on,
    },
    Field {
        name: "Distance",
        width: 58.0,
        hint: "5 nmi",
        help: "Distance from shore, needed by some rules",
        of: |question| &mut question.distance,
    },
    Field {
        name: "Depth",
        width: 66.0,
        hint: "25 m",
        help: "Water depth, for which a gear type is built; 25 m if empty",
        of: |question| &mut question.depth,
    },
    Field {
        name: "Traps",
        width: 42.0,
        hint: "count",
        help: "Number of traps on one set, instead of that of the assembly",
        of: |question| &mut question.traps,
    },
];

/// Draws the question on one line, or on two in a narrow panel.
pub(super) fn show(ui: &mut Ui, typed: &mut Typed, shared: &mut Shared) {
    let whole = ui.available_width() >= ONE_LINE;
    let mut fields = |ui: &mut Ui, shared: &mut Shared| {
        FIELDS.iter().for_each(|field| one(ui, typed, shared, field));
    };
    ui.horizontal(|ui| {
        assembly(ui, shared);
        area(ui, shared);
        if whole {
            fields(ui, shared);
        }
    });
    if !whole {
        ui.horizontal_wrapped(|ui| fields(ui, shared));
    }
}

fn name(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).color(Theme::palette_of(ui).faint));
}

fn assembly(ui: &mut Ui, shared: &mut Shared) {
    let documents = &shared.workbench.project().documents;
    let named = |id: &str| documents.field(&format!("assemblies/{id}.toml"), "name");
    let question = &shared.workbench.rules().question;
    let mut chosen = None;
    let shown = named(&question.assembly).unwrap_or_else(|| question.assembly.clone());
    let combo = ComboBox::from_id_salt("rules assembly").width(190.0).truncate();
    let response = combo.selected_text(&shown).show_ui(ui, |ui| {
        for path in documents.files("assemblies") {
            let id = id_of(path);
            let name = named(id).unwrap_or_else(|| id.to_owned());
            if ui.selectable_label(question.assembly == id, name).on_hover_text(id).clicked() {
                chosen = Some(RuleQuestion { assembly: id.to_owned(), ..question.clone() });
            }
        }
    });
    response.response.on_hover_text(format!("The assembly that is checked: {shown}"));
    if let Some(question) = chosen {
        shared.perform(RuleAction::Ask(question));
    }
}

fn area(ui: &mut Ui, shared: &mut Shared) {
    let checks = &shared.workbench.rules();
    let mut chosen = None;
    let Some(packs) = checks.packs.clone() else { return };
    let named = |id: &str| {
        let area = packs.areas().find(|area| area.id.value == id);
        area.map_or_else(|| id.to_owned(), |area| area.name.clone())
    };
    let shown = named(&checks.question.area);
    let combo = ComboBox::from_id_salt("rules area").width(220.0).truncate();
    let response = combo.selected_text(&shown).show_ui(ui, |ui| {
        for area in packs.areas() {
            let id = &area.id.value;
            let own = checks.question.area == *id;
            if ui.selectable_label(own, &area.name).on_hover_text(id).clicked() {
                chosen = Some(RuleQuestion { area: id.clone(), ..checks.question.clone() });
            }
        }
    });
    response.response.on_hover_text(format!("The area of fishing: {shown}"));
    if let Some(question) = chosen {
        shared.perform(RuleAction::Ask(question));
    }
}

/// Draws a text field, applied on Enter or when it loses the focus.
fn one(ui: &mut Ui, typed: &mut Typed, shared: &mut Shared, field: &Field) {
    name(ui, field.name);
    let mut question = shared.workbench.rules().question.clone();
    let stored = (field.of)(&mut question);
    let own = typed.now.as_ref().filter(|(name, _)| *name == field.name);
    let mut text = own.map_or_else(|| stored.clone(), |(_, text)| text.clone());
    let editor = TextEdit::singleline(&mut text).desired_width(field.width).hint_text(field.hint);
    let response = ui.add(editor).on_hover_text(field.help);
    if response.has_focus() {
        typed.now = Some((field.name, text));
    } else if response.lost_focus() {
        typed.now = None;
        let escaped = ui.input(|input| input.key_pressed(egui::Key::Escape));
        if !escaped {
            text.trim().clone_into(stored);
            shared.perform(RuleAction::Ask(question));
        }
    }
}
