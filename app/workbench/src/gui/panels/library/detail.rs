//! The selected entry: its texts, its uses, and its differences from another.

use crate::gui::command::action::PanelAction;
use endline_session::command::EditAction;
use std::sync::Arc;

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_gear::units::{self, Quantity};
use endline_gear::{Document, Kind};
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;

use super::LibraryPanel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};
use crate::gui::{fields, files};

/// What the selected entry is compared with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Against {
    /// Its file on disk.
    #[default]
    Saved,
    /// Another entry, by its path.
    Entry(String),
}

/// Uses of an entry, found when it is selected.
#[derive(Clone, Debug, Default)]
pub struct Uses {
    path: String,
    version: u64,
    assemblies: Vec<String>,
    scenarios: Vec<std::path::PathBuf>,
}

/// Differences between two entries, reused until a text changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Compared {
    texts: Option<[String; 2]>,
    rows: Option<Arc<[[String; 4]]>>,
}

impl Compared {
    /// Fields that differ; `None` if the other text is invalid.
    fn rows(
        &mut self,
        documents: &Documents,
        path: &str,
        other: &str,
        kind: Kind,
    ) -> Option<Arc<[[String; 4]]>> {
        let own = documents.text(path).unwrap_or_default();
        if self.texts.as_ref().is_none_or(|texts| texts[0] != own || texts[1] != other) {
            self.rows = Document::parse(other)
                .ok()
                .map(|other| differences(documents, path, &other, kind).into());
            self.texts = Some([own.to_owned(), other.to_owned()]);
        }
        self.rows.clone()
    }
}

/// Draws the details of an entry.
pub(super) fn show(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, path: &str) {
    ScrollArea::vertical().id_salt("entry").auto_shrink(false).show(ui, |ui| {
        let kind = panel.kind;
        if super::picture::has(kind) {
            super::picture::show(
                ui,
                &shared.workbench.project().documents,
                kind,
                path,
                egui::vec2(190.0, 120.0),
            )
            .on_hover_text("Drawn from its figures, at a common scale");
        }
        naming(ui, panel, shared, path);
        used_in(ui, panel, shared, path);
        compare(ui, panel, shared, path);
        super::figures::show(ui, shared, kind, path);
    });
}

/// Draws name, remarks, source and confidence.
fn naming(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, path: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.horizontal(|ui| {
        ui.label(RichText::new(path).monospace().size(11.5).color(faint));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.small_button("✖").on_hover_text("Close this list").clicked() {
                panel.chosen = None;
            }
        });
    });
    let rows = [
        ("Name", "name", "Name on screen"),
        ("Remarks", "notes", "Remarks for readers"),
        ("Source", "source", "Source of figures without their own source"),
        (
            "Confidence",
            "confidence",
            "measured, catalogue, derived or estimate; for figures without their own confidence",
        ),
    ];
    Grid::new("entry-words").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for (name, key, help) in rows {
            ui.label(RichText::new(name).color(faint));
            let width = ui.available_width() - 8.0;
            if let Some(typed) = fields::edit(
                ui,
                &shared.workbench.project().documents,
                path,
                key,
                width,
                fields::Said { hint: "", help },
            ) {
                shared.set(path, key, &typed);
            }
            ui.end_row();
        }
    });
}

fn used_in(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, path: &str) {
    let version = shared.workbench.project().documents.version();
    if panel.uses.path != path || panel.uses.version != version {
        panel.uses = Uses { version, ..uses(&shared.workbench.project().documents, path) };
    }
    widgets::caption(ui, "Used in");
    let uses = panel.uses.clone();
    if uses.assemblies.is_empty() && uses.scenarios.is_empty() {
        ui.label(RichText::new("no assembly and no scenario").color(Theme::palette_of(ui).faint));
    }
    ui.horizontal_wrapped(|ui| {
        for assembly in &uses.assemblies {
            if ui.link(assembly).on_hover_text("Show this assembly").clicked() {
                shared.give(PanelAction::Assembly(id_of(assembly).to_owned()));
            }
        }
        for scenario in &uses.scenarios {
            let stem = files::stem(scenario);
            if ui
                .link(format!("scenarios/{stem}.toml"))
                .on_hover_text("Open this scenario")
                .clicked()
            {
                shared.give(EditAction::OpenScenario(scenario.clone()));
            }
        }
    });
}

/// Assemblies and scenarios that contain the id of an entry.
fn uses(documents: &Documents, path: &str) -> Uses {
    let named = format!("\"{}\"", id_of(path));
    let names = |text: &str| text.contains(&named);
    let assemblies = documents
        .files("assemblies")
        .filter(|file| *file != path && documents.text(file).is_some_and(names))
        .map(str::to_owned);
    let scenarios = files::scenarios(documents.root()).into_iter();
    let scenarios =
        scenarios.filter(|file| endline_gear::read::text(file).is_ok_and(|text| names(&text)));
    Uses {
        path: path.to_owned(),
        version: 0,
        assemblies: assemblies.collect(),
        scenarios: scenarios.collect(),
    }
}

fn compare(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, path: &str) {
    widgets::caption(ui, "Compared with");
    let kind = panel.kind;
    choose(ui, panel, shared, path, kind);
    let other = match &panel.against {
        Against::Saved => shared.workbench.project().documents.saved_text(path),
        Against::Entry(other) => shared.workbench.project().documents.text(other),
    };
    let rows = other.and_then(|other| {
        panel.compared.rows(&shared.workbench.project().documents, path, other, kind)
    });
    let Some(rows) = rows else {
        ui.label(RichText::new("new, not saved yet").color(Theme::palette_of(ui).faint));
        return;
    };
    if rows.is_empty() {
        ui.label(RichText::new("no difference").color(Theme::palette_of(ui).faint));
        return;
    }
    Grid::new("compare").num_columns(4).striped(true).spacing([12.0, 2.0]).show(ui, |ui| {
        let faint = Theme::palette_of(ui).faint;
        for head in ["", "here", "there", ""] {
            ui.label(RichText::new(head).small().color(faint));
        }
        ui.end_row();
        for [name, here, there, by] in rows.iter() {
            ui.label(RichText::new(name).color(faint));
            ui.label(here);
            ui.label(there);
            ui.label(RichText::new(by).color(faint));
            ui.end_row();
        }
    });
}

fn choose(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, path: &str, kind: Kind) {
    let name = |path: &str| {
        shared.workbench.project().documents.field(path, "name").unwrap_or_else(|| path.to_owned())
    };
    let shown = match &panel.against {
        Against::Saved => "its file on disk".to_owned(),
        Against::Entry(other) => name(other),
    };
    let width = ui.available_width() - 8.0;
    egui::ComboBox::from_id_salt("against").width(width).truncate().selected_text(shown).show_ui(
        ui,
        |ui| {
            ui.selectable_value(&mut panel.against, Against::Saved, "its file on disk");
            for other in shared
                .workbench
                .project()
                .documents
                .files(kind.folder())
                .filter(|other| *other != path)
            {
                ui.selectable_value(
                    &mut panel.against,
                    Against::Entry(other.to_owned()),
                    name(other),
                );
            }
        },
    );
}

/// Draws fields that differ: name, both values, difference.
fn differences(
    documents: &Documents,
    path: &str,
    other: &Document,
    kind: Kind,
) -> Vec<[String; 4]> {
    let words = kind.words().iter().map(|word| (word.key, None));
    let figures = kind.fields().iter().map(|field| (field.key, Some(field.quantity)));
    let row = |(key, quantity): (&str, Option<Quantity>)| {
        let (here, there) =
            (documents.field(path, key).unwrap_or_default(), other.get(key).unwrap_or_default());
        (here != there)
            .then(|| [words::title(key), here.clone(), there.clone(), by(&here, &there, quantity)])
    };
    words.chain(figures).filter_map(row).collect()
}

/// Relative difference of two values.
fn by(here: &str, there: &str, quantity: Option<Quantity>) -> String {
    let si = |text: &str| quantity.and_then(|quantity| units::parse(text, quantity).ok());
    match (si(here), si(there)) {
        (Some(here), Some(there)) if there != 0.0 => {
            format!("{:+.1} %", 100.0 * (here / there - 1.0))
        }
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_stated_across_units() {
        assert_eq!(by("1,700 lbf", "3400 lbf", Some(Quantity::Force)), "-50.0 %");
        assert_eq!(by("1 in", "25.4 mm", Some(Quantity::Length)), "+0.0 %");
        assert_eq!(by("pp", "sink", None), "");
    }
}
