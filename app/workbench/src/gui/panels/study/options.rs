//! Options of a study, each a list of differences from the scenario, and the menu of fields that an option can set.

use std::path::{Path, PathBuf};

use egui::{Align, Frame, RichText, ScrollArea, Ui};
use endline_gear::Setting;
use endline_session::command::StudyAction;
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;

use super::{Edits, settable};
use crate::gui::fields::{self, Said};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::command;

/// Fields that are often set, as a hint for typing.
const EXAMPLES: &str =
    "current.speed, weak_links, link.0.rating, gear.0.assembly, ropes/sink-3-8.strength";

/// A change of the list of options.
enum Act {
    Copy(usize),
    Drop(usize),
}

/// Draws every option with its settings.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, edits: &mut Edits) {
    widgets::caption(ui, "Options");
    let count = super::option_ids(shared.documents()).len();
    let baseline = shared.documents().field(Documents::STUDY, "baseline").unwrap_or_default();
    let mut act = None;
    ui.horizontal_wrapped(|ui| {
        if ui
            .button("Add option")
            .on_hover_text("Adds a copy of the last option, to be edited")
            .clicked()
        {
            act = Some(Act::Copy(count.saturating_sub(1)));
        }
        command(ui, shared, "From unsaved edits", StudyAction::OptionFromEdits);
        ui.menu_button("With another assembly ⏷", |ui| other_gear(ui, shared));
    });
    let is_longer = is_longer(ui, shared, count);
    for index in 0..count {
        let frame =
            Frame::new().fill(Theme::palette_of(ui).field).corner_radius(4.0).inner_margin(6.0);
        let drawn = frame.show(ui, |ui| {
            act = head(ui, shared, index, &baseline, edits).or(act.take());
            settings(ui, shared, index, edits);
        });
        if is_longer && index + 1 == count {
            drawn.response.scroll_to_me(Some(Align::Center));
        }
        ui.add_space(4.0);
    }
    match act {
        Some(Act::Copy(index)) => copy(shared, index),
        Some(Act::Drop(index)) => {
            shared.alter(Documents::STUDY, |document| {
                document.remove_table("option", index).map_err(|error| error.message)
            });
        }
        None => {}
    }
}

/// Whether an option was added since the last frame; the new one, at the end, is then scrolled into view.
fn is_longer(ui: &Ui, shared: &Shared, count: usize) -> bool {
    let id = ui.id().with("options drawn");
    let study = shared.documents().study_path().map(Path::to_owned);
    let before = ui.data(|data| data.get_temp::<(Option<PathBuf>, usize)>(id));
    let is_longer = before.is_some_and(|(of, before)| of == study && before < count);
    ui.data_mut(|data| data.insert_temp(id, (study, count)));
    is_longer
}

/// Draws the assemblies of the library; a click adds one as an option.
fn other_gear(ui: &mut Ui, shared: &mut Shared) {
    ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
        let documents = shared.documents();
        let names = documents.files("assemblies").map(|file| {
            let id = id_of(file).to_owned();
            (documents.field(file, "name").unwrap_or_else(|| id.clone()), id)
        });
        let mut names: Vec<(String, String)> = names.collect();
        names.sort();
        for (name, id) in names {
            if ui.button(name).on_hover_text(&id).clicked() {
                shared.give(StudyAction::OptionWithAssembly(id));
                ui.close();
            }
        }
    });
}

fn head(
    ui: &mut Ui,
    shared: &Shared,
    index: usize,
    baseline: &str,
    edits: &mut Edits,
) -> Option<Act> {
    let mut act = None;
    ui.horizontal_wrapped(|ui| {
        let id = format!("option.{index}.id");
        let is_baseline =
            shared.documents().field(Documents::STUDY, &id).as_deref() == Some(baseline);
        let fields = [
            (id, 84.0, "id", "Id, unique among the options"),
            (
                format!("option.{index}.name"),
                (ui.available_size_before_wrap().x - 292.0).max(90.0),
                "name",
                "Name in tables and figures",
            ),
            (
                format!("option.{index}.strength"),
                84.0,
                "strength",
                "Breaking strength for the curve of parting against strength; optional",
            ),
        ];
        for (field, width, hint, help) in fields {
            if let Some(typed) = fields::edit(
                ui,
                shared.documents(),
                Documents::STUDY,
                &field,
                width,
                Said { hint, help },
            ) {
                if field.ends_with(".id") && is_baseline {
                    edits.push(("baseline".into(), Some(Setting::text(&typed))));
                }
                edits.push((field, (!typed.is_empty()).then(|| Setting::text(&typed))));
            }
        }
        if is_baseline {
            ui.label(RichText::new("baseline").small().color(Theme::palette_of(ui).accent));
        }
        if ui.small_button("Copy").on_hover_text("Adds a copy of this option").clicked() {
            act = Some(Act::Copy(index));
        }
        if !is_baseline && ui.small_button("✖").on_hover_text("Removes this option").clicked() {
            act = Some(Act::Drop(index));
        }
    });
    act
}

fn settings(ui: &mut Ui, shared: &mut Shared, index: usize, edits: &mut Edits) {
    let faint = Theme::palette_of(ui).faint;
    let table = format!("option.{index}.set");
    let leaves = leaves(shared.documents(), &table);
    if leaves.is_empty() {
        ui.label(RichText::new("no differences from the scenario").color(faint));
    }
    for path in leaves {
        ui.horizontal_wrapped(|ui| {
            let shown = path.trim_start_matches(&table).trim_start_matches('.').replace('"', "");
            ui.label(RichText::new(&shown).monospace())
                .on_hover_text("Dotted path of a field of the scenario or of a library item");
            let width = (ui.available_size_before_wrap().x - 40.0).max(60.0);
            if let Some(typed) = fields::edit(
                ui,
                shared.documents(),
                Documents::STUDY,
                &path,
                width,
                Said { hint: "", help: "Value with its unit, as in the file" },
            ) {
                edits.push((path.clone(), Some(Setting::plain(&typed))));
            }
            if ui
                .small_button("✖")
                .on_hover_text("Removes this setting; the value of the scenario applies")
                .clicked()
            {
                edits.push((path.clone(), None));
            }
        });
    }
    ui.horizontal_wrapped(|ui| {
        let id = ui.id().with(("fresh setting", index));
        let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_default();
        if let Some((path, now)) = settable::menu(ui, shared, index) {
            edits.push((format!("{table}.\"{path}\""), Some(Setting::plain(&now))));
        }
        let width = (ui.available_size_before_wrap().x - 70.0).max(60.0);
        let editor = egui::TextEdit::singleline(&mut typed)
            .desired_width(width)
            .hint_text("or its path, such as current.speed");
        let response = ui.add(editor).on_hover_text(EXAMPLES);
        let entered =
            response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let wanted = (ui.button("Set").clicked() || entered) && !typed.trim().is_empty();
        if wanted {
            let (field, value) = typed.split_once('=').unwrap_or((&typed, ""));
            let value = if value.trim().is_empty() {
                current(shared, field.trim())
            } else {
                value.trim().to_owned()
            };
            edits.push((format!("{table}.\"{}\"", field.trim()), Some(Setting::plain(&value))));
            typed.clear();
        }
        ui.data_mut(|data| data.insert_temp(id, typed));
    });
}

/// Current value of a field, with which a new setting starts.
fn current(shared: &Shared, field: &str) -> String {
    let item = field.split_once('.').filter(|(item, _)| item.contains('/'));
    let found = match item {
        Some((item, field)) => shared.documents().field(&format!("{item}.toml"), field),
        None => shared.documents().field(Documents::SCENARIO, field),
    };
    found.unwrap_or_default()
}

/// Paths of all values below a table.
fn leaves(documents: &Documents, table: &str) -> Vec<String> {
    let mut found = Vec::new();
    for key in documents.keys(Documents::STUDY, table) {
        let path = format!("{table}.{key}");
        if documents.field(Documents::STUDY, &path).is_some() {
            found.push(path)
        } else {
            found.extend(leaves(documents, &path))
        }
    }
    found
}

/// Adds a copy of an option with a new id.
fn copy(shared: &mut Shared, index: usize) {
    let ids = super::option_ids(shared.documents());
    let old = ids.get(index).cloned().unwrap_or_else(|| "option".into());
    let Some(id) = (2..).map(|number| format!("{old}-{number}")).find(|id| !ids.contains(id))
    else {
        return;
    };
    let of =
        |key: &str| shared.documents().field(Documents::STUDY, &format!("option.{index}.{key}"));
    let name = of("name").map(|name| format!("{name} (copy)"));
    let strength = of("strength");
    let table = format!("option.{index}.set");
    let settings: Vec<(String, String)> = leaves(shared.documents(), &table)
        .into_iter()
        .filter_map(|path| {
            Some((
                path.trim_start_matches(&table).to_owned(),
                shared.documents().field(Documents::STUDY, &path)?,
            ))
        })
        .collect();
    let change = |document: &mut endline_gear::Document| {
        let quoted = |text: &str| format!("{text:?}");
        let mut fields = vec![("id", quoted(&id))];
        fields.extend(name.as_deref().map(|name| ("name", quoted(name))));
        fields.extend(strength.as_deref().map(|strength| ("strength", quoted(strength))));
        let fields: Vec<(&str, &str)> =
            fields.iter().map(|(key, text)| (*key, text.as_str())).collect();
        let place = document.push_table("option", &fields).map_err(|error| error.message)?;
        settings.iter().try_for_each(|(path, value)| {
            document
                .put(&format!("option.{place}.set{path}"), &Setting::plain(value))
                .map_err(|error| error.message)
        })
    };
    shared.alter(Documents::STUDY, change);
}
