//! Options of a study, each a list of differences from the scenario, and the menu of fields that an option can set.

use std::path::{Path, PathBuf};

use egui::{Align, Frame, Label, RichText, ScrollArea, TextEdit, Ui};
use endline_gear::{Document, Kind, Setting, referenced_folder};
use endline_sdk::Attribute;
use endline_session::command::StudyAction;
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;

use crate::gui::fields::Said;
use crate::gui::panels::study::{Edits, field_words};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::capital;
use crate::gui::widgets::{command, words};
use crate::gui::{fields, scenario_fields, widgets};

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
        for (id, name) in item_names(shared.documents(), "gear.0.assembly") {
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
            let words = capital(&field_words(shared.documents(), &shown));
            ui.add(Label::new(words).truncate()).on_hover_text(format!("Field: {shown}"));
            let width = (ui.available_size_before_wrap().x - 40.0).max(60.0);
            let names = item_names(shared.documents(), &shown);
            let chosen = if names.is_empty() {
                let said = Said { hint: "", help: "Value with its unit, as in the file" };
                fields::edit(ui, shared.documents(), Documents::STUDY, &path, width, said)
                    .map(|typed| Setting::plain(&typed))
            } else {
                fields::choose(ui, shared.documents(), Documents::STUDY, &path, &names, width)
                    .map(|id| Setting::text(&id))
            };
            edits.extend(chosen.map(|setting| (path.clone(), Some(setting))));
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
        if let Some((path, now)) = field_menu(ui, shared, index) {
            edits.push((format!("{table}.\"{path}\""), Some(Setting::plain(&now))));
        }
        let width = (ui.available_size_before_wrap().x - 70.0).max(60.0);
        let editor = TextEdit::singleline(&mut typed)
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

/// Ids and names of the items that a field can have, by name; empty for a field that takes no item.
pub(super) fn item_names(documents: &Documents, field: &str) -> Vec<(String, String)> {
    let folder = referenced_folder(field);
    let named = folder.into_iter().flat_map(|folder| documents.files(folder)).map(|file| {
        let id = id_of(file).to_owned();
        let name = documents.field(file, "name").unwrap_or_else(|| id.clone());
        (id, name)
    });
    let mut names: Vec<(String, String)> = named.collect();
    names.sort_by(|(_, one), (_, other)| one.cmp(other));
    names
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
    let change = |document: &mut Document| {
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

/// Maximum number of fields listed.
const MOST_FIELDS: usize = 200;

/// A field that an option can set.
#[derive(Clone, Debug)]
struct Settable {
    /// Heading and label.
    name: String,
    /// Dotted path for an option.
    path: String,
    /// Help.
    help: String,
    /// Current value; empty if the scenario has none.
    now: String,
    /// Default value.
    usual: String,
}

impl Settable {
    fn has(&self, words: &[String]) -> bool {
        let text = format!("{} {} {}", self.name, self.path, self.help).to_lowercase();
        words.iter().all(|word| text.contains(word))
    }
}

/// Draws a menu of fields with a search; returns the path and current value of the selected field.
fn field_menu(ui: &mut Ui, shared: &Shared, index: usize) -> Option<(String, String)> {
    let mut chosen = None;
    let menu = ui.menu_button("Set a field ⏷", |ui| {
        ui.set_min_width(460.0);
        let id = ui.id().with(("sought field", index));
        let mut sought = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_default();
        let hint = "Search: tide, strength, traps …";
        let typed = ui.add(TextEdit::singleline(&mut sought).hint_text(hint).desired_width(440.0));
        if ui.ctx().memory(|memory| memory.focused().is_none()) {
            typed.request_focus();
        }
        let words: Vec<String> =
            sought.to_lowercase().split_whitespace().map(str::to_owned).collect();
        let base = Base::of(shared);
        let all = base.scenario().chain(base.attributes()).chain(base.items(&words));
        let found: Vec<Settable> =
            all.filter(|field| field.has(&words)).take(MOST_FIELDS).collect();
        ScrollArea::vertical().max_height(340.0).show(ui, |ui| {
            for field in &found {
                if row(ui, field) {
                    chosen = Some((field.path.clone(), field.now.clone()));
                    ui.close();
                }
            }
            if found.is_empty() {
                ui.label(RichText::new("no field matches all words").weak());
            }
        });
        ui.data_mut(|data| data.insert_temp(id, sought));
    });
    menu.response.on_hover_text("Fields of the scenario and of library items, with help");
    chosen
}

fn row(ui: &mut Ui, field: &Settable) -> bool {
    let faint = Theme::palette_of(ui).faint;
    ui.horizontal(|ui| {
        let clicked = ui
            .button(&field.name)
            .on_hover_text(format!("{}\n{}", field.help, field.path))
            .clicked();
        let held = if field.now.is_empty() { &field.usual } else { &field.now };
        ui.label(RichText::new(held).color(faint));
        clicked
    })
    .inner
}

/// The scenario of the study.
struct Base<'a> {
    shared: &'a Shared,
    /// Its text, if it is not the open scenario.
    other: Option<Document>,
}

impl<'a> Base<'a> {
    fn of(shared: &'a Shared) -> Self {
        let documents = shared.documents();
        let of = documents.field(Documents::STUDY, "scenario").unwrap_or_default();
        let open = documents.scenario_path().file_stem().unwrap_or_default().to_string_lossy();
        if id_of(&of) == open {
            return Self { shared, other: None };
        }
        let file = documents.root().join(format!("scenarios/{of}.toml"));
        let text = endline_gear::read::text(&file).ok();
        Self { shared, other: text.and_then(|text| Document::parse(&text).ok()) }
    }

    fn documents(&self) -> &'a Documents {
        self.shared.documents()
    }

    fn now(&self, field: &str) -> String {
        let own = || self.documents().field(Documents::SCENARIO, field);
        self.other.as_ref().map_or_else(own, |other| other.get(field)).unwrap_or_default()
    }

    fn scenario(&self) -> impl Iterator<Item = Settable> {
        scenario_fields::all().map(|(heading, row)| {
            let (now, usual) = (self.now(row.field), row.usual.to_owned());
            let name = format!("{heading}: {}", row.label);
            Settable { name, path: row.field.to_owned(), help: row.help.to_owned(), now, usual }
        })
    }

    /// Attributes of the gear type, the motion and the friction law.
    fn attributes(&self) -> impl Iterator<Item = Settable> {
        let assembly = self.now("gear.0.assembly");
        let file = format!("assemblies/{assembly}.toml");
        let wanted = self.documents().field(&file, "gear_type");
        let gear = self
            .shared
            .workbench
            .gear_types()
            .into_iter()
            .find(|gear| Some(gear.descriptor().id.as_ref()) == wanted.as_deref());
        let (host, _) = self.shared.workbench.helpers();
        let motion = host.motion(&self.now("whale.motion"));
        let friction = host.friction(&self.now("friction.model"));
        let of = |heading: &str, table: &str, attributes: &[Attribute]| -> Vec<Settable> {
            let one = |attribute: &Attribute| {
                let path = format!("{table}.{}", attribute.key);
                let own = self.documents().field(&file, &format!("attributes.{}", attribute.key));
                let now = Some(self.now(&path)).filter(|now| !now.is_empty());
                let now = now.or(own.filter(|_| heading == "Gear")).unwrap_or_default();
                let name = format!("{heading}: {}", words::title(&attribute.key));
                let help = attribute.help.to_string();
                Settable { name, path, help, now, usual: "usual".to_owned() }
            };
            attributes.iter().map(one).collect()
        };
        let mut found = Vec::new();
        if let Some(gear) = gear {
            found.extend(of("Gear", "gear.0.attributes", &gear.descriptor().attributes));
        }
        if let Some(motion) = motion {
            found.extend(of("Motion", "whale.attributes", &motion.descriptor().attributes));
        }
        if let Some(friction) = friction {
            found.extend(of("Friction", "friction.attributes", &friction.descriptor().attributes));
        }
        found.into_iter()
    }

    /// Figures of library items: those used by the open scenario, or all items if there are search words.
    fn items(&self, sought: &[String]) -> impl Iterator<Item = Settable> {
        let documents = self.documents();
        let kinds = Kind::ALL.iter().copied().filter(|kind| *kind != Kind::Act);
        kinds.flat_map(move |kind| {
            let files = documents.files(kind.folder());
            let shown = files.filter(move |file| !sought.is_empty() || documents.in_use(file));
            shown.flat_map(move |file| {
                let named = documents.field(file, "name").unwrap_or_else(|| id_of(file).to_owned());
                let item = file.trim_end_matches(".toml");
                kind.fields().iter().map(move |field| Settable {
                    name: format!("{named}: {}", words::title(field.key)),
                    path: format!("{item}.{}", field.key),
                    help: field.help.to_owned(),
                    now: documents.field(file, field.key).unwrap_or_default(),
                    usual: "no value".to_owned(),
                })
            })
        })
    }
}
