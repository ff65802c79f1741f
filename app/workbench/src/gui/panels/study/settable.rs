//! Fields that an option can set, with a search: fields of the scenario, attributes of its plugins, figures of library items.

use egui::{RichText, ScrollArea, TextEdit, Ui};
use endline_gear::{Document, Kind};
use endline_sdk::Attribute;
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;

use crate::gui::scenario_fields;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;

/// Maximum number of fields listed.
const MOST: usize = 200;

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
pub(super) fn menu(ui: &mut Ui, shared: &Shared, index: usize) -> Option<(String, String)> {
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
        let found: Vec<Settable> = all.filter(|field| field.has(&words)).take(MOST).collect();
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
        let kinds = Kind::ALL.into_iter().filter(|kind| *kind != Kind::Act);
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
