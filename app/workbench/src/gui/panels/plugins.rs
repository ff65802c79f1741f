//! The plugins: a list by kind, and for the selected one its attributes, file and check.

use crate::gui::command::action::WindowAction;
use endline_session::command::PluginAction;
use std::path::Path;

use egui::{Button, Grid, Label, RichText, ScrollArea, Ui};
use endline_gear::Setting;
use endline_gear::units::{Quantity, format_si};
use endline_sdk::{Attribute, AttributeKind};
use endline_session::edit::Documents;
use endline_session::plugins::{Change, PluginInfo, PluginProblem, Standing};
use endline_session::workbench::plugins::{Switchable, place_of};

use crate::gui::fields;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};
use crate::gui::widgets::{self, words};

/// Width of the list as a share of the panel.
const LIST_SHARE: f32 = 0.38;

/// Width of a field of the form [points].
const FIELD_WIDTH: f32 = 140.0;

/// The plugins.
#[derive(Debug, Default)]
pub struct PluginsPanel {
    /// Id of the plugin shown.
    pub chosen: Option<String>,
}

impl Panel for PluginsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let plugins = shared.workbench.plugins().every();
        if !plugins.iter().any(|plugin| self.chosen.as_ref() == Some(&plugin.info.id)) {
            self.chosen = plugins.first().map(|plugin| plugin.info.id.clone());
        }
        toolbar(ui, shared);
        ui.separator();
        let whole = ui.available_rect_before_wrap();
        let (left, right) = whole
            .split_left_right_at_x(whole.left() + (whole.width() * LIST_SHARE).clamp(170.0, 340.0));
        widgets::within(ui, left.with_max_x(left.right() - 8.0), |ui| {
            ScrollArea::vertical()
                .id_salt("list")
                .auto_shrink(false)
                .show(ui, |ui| self.list(ui, shared, &plugins));
        });
        widgets::within(ui, right, |ui| {
            let chosen = plugins
                .iter()
                .find(|plugin| self.chosen.as_ref() == Some(&plugin.info.id))
                .cloned();
            ScrollArea::vertical().id_salt("chosen").auto_shrink(false).show(ui, |ui| match chosen {
                Some(plugin) => detail(ui, shared, &plugin.info, plugin.on),
                None => widgets::nothing(ui, "No plugins: build them with `cargo xtask plugins`, or write one: `endline plugins new`."),
            });
        });
    }
}

impl PluginsPanel {
    /// Draws all plugins by kind, then files that are not used.
    fn list(&mut self, ui: &mut Ui, shared: &mut Shared, plugins: &[Switchable]) {
        let mut kind = None;
        for Switchable { info, on } in plugins {
            if kind.replace(info.kind) != Some(info.kind) {
                widgets::caption(ui, &format!("{}s", info.kind.name().trim_end_matches('s')));
            }
            self.row(ui, shared, info, *on);
        }
        let problems = shared.workbench.plugins().problems.clone();
        if !problems.is_empty() {
            widgets::caption(ui, "Not used");
            problems.iter().for_each(|problem| left_out(ui, shared, problem));
        }
    }

    fn row(&mut self, ui: &mut Ui, shared: &mut Shared, info: &PluginInfo, on: bool) {
        let palette = Theme::palette_of(ui);
        ui.horizontal(|ui| {
            let mut wanted = on;
            let help =
                if on { "In use; click to switch it off" } else { "Switched off; click to use it" };
            if ui.checkbox(&mut wanted, "").on_hover_text(format!("{help}: {}", info.id)).changed()
            {
                shared.give(PluginAction::Switch { id: info.id.clone(), on: wanted });
            }
            let colour = match (on, shared.workbench.uses_plugin(info)) {
                (false, _) => palette.faint,
                (true, true) => palette.accent,
                (true, false) => palette.text,
            };
            let chosen = self.chosen.as_ref() == Some(&info.id);
            let name =
                Button::selectable(chosen, RichText::new(&info.name).color(colour)).truncate();
            if ui.add(name).on_hover_text(format!("{}\n{}", info.id, info.help)).clicked() {
                self.chosen = Some(info.id.clone());
            }
        });
    }
}

fn toolbar(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal_wrapped(|ui| {
        let busy = shared.workbench.plugins().busy();
        if primary(ui, !busy, "Reload")
            .on_hover_text("Loads plugins that were rebuilt; the next run uses them")
            .clicked()
        {
            shared.give(PluginAction::Reload);
        }
        let folders: Vec<_> = shared
            .workbench
            .plugins()
            .folders()
            .into_iter()
            .filter(|folder| folder.is_dir())
            .collect();
        ui.add_enabled_ui(!folders.is_empty(), |ui| {
            ui.menu_button("Open folder ⏷", |ui| {
                for folder in folders {
                    if ui.button(folder.display().to_string()).clicked() {
                        shared.give(WindowAction::OpenFolder(folder));
                        ui.close();
                    }
                }
            });
        });
        if busy {
            ui.spinner();
        }
        let words =
            "Create a plugin in a terminal: endline plugins new my-friction --kind friction --lang rust";
        ui.add(Label::new(RichText::new(words).color(Theme::palette_of(ui).faint)).truncate());
    });
}

/// Draws a file that is not used, with the reason and actions.
fn left_out(ui: &mut Ui, shared: &mut Shared, problem: &PluginProblem) {
    let palette = Theme::palette_of(ui);
    let name = problem
        .file
        .file_name()
        .map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default();
    let (word, colour) = match &problem.standing {
        Standing::Waiting(ask) if ask.change == Change::New => ("not allowed yet", palette.warning),
        Standing::Waiting(_) => ("changed since it was allowed", palette.warning),
        Standing::SetAside => ("quarantined", palette.error),
        Standing::Unusable => ("not usable", palette.error),
    };
    let text = problem.to_string();
    ui.add(Label::new(RichText::new(&name).color(colour)).truncate()).on_hover_text(&text);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(word).size(12.0).color(palette.faint)).on_hover_text(&text);
        if let Standing::Waiting(ask) = &problem.standing
            && ui.small_button("Allow").on_hover_text("A plugin runs with your rights").clicked()
        {
            shared.give(PluginAction::Allow { file: problem.file.clone(), hash: ask.hash.clone() });
        }
        if problem.standing == Standing::SetAside && ui.small_button("Check again").clicked() {
            shared.give(PluginAction::Check(problem.file.clone()));
        }
    });
    report(ui, shared, &problem.file);
}

/// Draws the selected plugin: description, attributes, acts, actions.
fn detail(ui: &mut Ui, shared: &mut Shared, info: &PluginInfo, on: bool) {
    let palette = Theme::palette_of(ui);
    ui.heading(&info.name);
    ui.add(
        Label::new(
            RichText::new(format!("{}  {}  {}", info.id, info.version, info.kind))
                .monospace()
                .size(12.0),
        )
        .wrap(),
    );
    ui.add(Label::new(&info.help).wrap());
    if !info.about.is_empty() {
        ui.add(Label::new(RichText::new(&info.about).color(palette.faint)).wrap());
    }
    buttons(ui, shared, info, on);
    origin(ui, shared, info);
    if !info.attributes.is_empty() {
        widgets::caption(ui, "Attributes");
        attributes(ui, shared, info);
    }
    if !info.acts.is_empty() {
        widgets::caption(ui, "Acts");
        for act in &info.acts {
            ui.add(Label::new(format!("{}: {}", act.name, act.help)).wrap());
        }
    }
}

fn buttons(ui: &mut Ui, shared: &mut Shared, info: &PluginInfo, on: bool) {
    ui.horizontal_wrapped(|ui| {
        if on && place_of(info.kind).is_some() {
            if shared.workbench.uses_plugin(info) {
                ui.label(RichText::new("In this scenario").color(Theme::palette_of(ui).accent));
            } else if ui.button("Use in this scenario").on_hover_text("Undo reverts it").clicked() {
                shared.give(PluginAction::Use(info.id.clone()));
            }
        }
        let Some(file) = &info.file else { return };
        if ui
            .add_enabled(!shared.workbench.plugins().busy(), Button::new("Check"))
            .on_hover_text("Checks it in a separate process")
            .clicked()
        {
            shared.give(PluginAction::Check(file.clone()));
        }
        if let Some(folder) = file.parent()
            && ui.button("Open its folder").clicked()
        {
            shared.give(WindowAction::OpenFolder(folder.to_path_buf()));
        }
    });
}

/// Draws file, hash and the result of the check.
fn origin(ui: &mut Ui, shared: &Shared, info: &PluginInfo) {
    let faint = Theme::palette_of(ui).faint;
    let Some(file) = &info.file else {
        ui.label(RichText::new("Part of the program.").color(faint));
        return;
    };
    let place = file.display().to_string();
    ui.add(Label::new(RichText::new(&place).size(12.0).color(faint)).truncate())
        .on_hover_text(&place);
    let hash = info.hash.clone().unwrap_or_default();
    ui.label(
        RichText::new(format!("hash {}", hash.get(..16).unwrap_or(&hash)))
            .monospace()
            .size(12.0)
            .color(faint),
    )
    .on_hover_text(&hash);
    if info.out_of_process {
        ui.label(RichText::new("It runs in a separate process.").size(12.0).color(faint))
            .on_hover_text("A crash or hang of the plugin ends the run, not the program");
    }
    if shared.workbench.plugins().reports.contains_key(file) {
        report(ui, shared, file);
    } else {
        ui.label(
            RichText::new("It passed the check before it was loaded.").size(12.0).color(faint),
        );
    }
}

/// Draws the lines of the last check of a file.
fn report(ui: &mut Ui, shared: &Shared, file: &Path) {
    let palette = Theme::palette_of(ui);
    let Some(report) = shared.workbench.plugins().reports.get(file) else { return };
    for line in report.text.lines() {
        let fault = line.contains("  FAULT  ");
        let colour = if fault { palette.error } else { palette.faint };
        ui.add(Label::new(RichText::new(line).monospace().size(11.0).color(colour)).wrap());
    }
    match &report.fault {
        Some(fault) => {
            ui.add(Label::new(RichText::new(fault).size(12.0).color(palette.error)).wrap())
        }
        None => ui.label(RichText::new("sound").color(palette.good)),
    };
}

/// Draws the attributes: a form if the scenario uses the plugin, otherwise a table.
fn attributes(ui: &mut Ui, shared: &mut Shared, info: &PluginInfo) {
    let palette = Theme::palette_of(ui);
    let form =
        place_of(info.kind).filter(|_| shared.workbench.uses_plugin(info)).map(|(table, _)| table);
    let mut edits = Vec::new();
    Grid::new(("attributes", &info.id)).num_columns(3).spacing([10.0, 3.0]).show(ui, |ui| {
        for attribute in &info.attributes {
            let (usual, range) = default_and_range(attribute);
            let help = format!("{}\n{range}", attribute.help);
            ui.label(words::title(&attribute.key)).on_hover_text(&help);
            match form {
                Some(table) => {
                    let (field, hint) = (
                        format!("{table}.attributes.{}", attribute.key),
                        format!("{usual} (usual)"),
                    );
                    let said = fields::Said { hint: &hint, help: &help };
                    let place = fields::Field {
                        documents: &shared.workbench.project().documents,
                        path: Documents::SCENARIO,
                        field: &field,
                    };
                    let cell = ui.horizontal(|ui| {
                        ui.set_min_width(FIELD_WIDTH);
                        fields::edit_in(ui, "plugins", place, FIELD_WIDTH - 8.0, said)
                    });
                    let typed = cell.inner;
                    edits.extend(typed.map(|value| (field, value)));
                }
                None => {
                    ui.label(&usual).on_hover_text(&help);
                }
            }
            ui.label(RichText::new(range).size(12.0).color(palette.faint))
                .on_hover_text(attribute.help.as_ref());
            ui.end_row();
        }
    });
    for (field, value) in edits {
        // The table of attributes may not exist yet.
        let value = Setting::plain(&value);
        shared.alter(Documents::SCENARIO, |scenario| {
            scenario.put(&field, &value).map_err(|error| error.to_string())
        });
    }
}

/// Default value and allowed range.
fn default_and_range(attribute: &Attribute) -> (String, String) {
    let in_unit = |value: f64| {
        let value = words::rounded(value);
        Quantity::from_si_unit(&attribute.unit).map_or_else(
            || format!("{value} {}", attribute.unit),
            |quantity| format_si(value, quantity),
        )
    };
    match &attribute.kind {
        AttributeKind::Number { min, max, default } => {
            (in_unit(*default), format!("{} to {}", in_unit(*min), in_unit(*max)))
        }
        AttributeKind::Count { min, max, default } => {
            (default.to_string(), format!("a whole number from {min} to {max}"))
        }
        AttributeKind::Choice { words, default } => (default.to_string(), words.join(" or ")),
        AttributeKind::Item { library, default } => (
            if default.is_empty() { "none".to_owned() } else { default.to_string() },
            format!("an item of {library}/"),
        ),
    }
}
