//! The menu bar.

use std::sync::mpsc;

use egui::{Button, MenuBar, RichText, Ui};
use endline_session::units::Units;

use super::app::App;
use super::desk::Order;
use super::files::scenarios;
use super::layout::{self, Layout};
use super::panel_id::PanelId;
use super::theme::Theme;

/// Draws the menu bar.
pub fn show(ui: &mut Ui, app: &mut App) {
    MenuBar::new().ui(ui, |ui| {
        ui.label(RichText::new("Endline").strong().color(Theme::palette_of(ui).accent));
        ui.add_space(6.0);
        ui.menu_button("File", |ui| file(ui, app));
        ui.menu_button("Edit", |ui| edit(ui, app));
        ui.menu_button("Run", |ui| run(ui, app));
        ui.menu_button("View", |ui| view(ui, app));
        ui.menu_button("Window", |ui| window(ui, app));
        ui.menu_button("Help", |ui| {
            item(ui, app, true, "Start page", "", Order::Show(PanelId::START));
            item(ui, app, true, "Keys and help", "F1", Order::Show(PanelId::HELP));
            item(ui, app, true, "Commands …", "Ctrl+P", Order::Commands);
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            for units in Units::ALL.into_iter().rev() {
                ui.selectable_value(&mut app.desk.preferences.units, units, units.name())
                    .on_hover_text(units.help());
            }
            ui.separator();
            for layout in Layout::ALL.into_iter().rev() {
                if ui.button(layout.name()).on_hover_text("Arrange the panels").clicked() {
                    app.desk.orders.push(Order::Arrange(layout));
                }
            }
        });
    });
}

/// A menu item that gives an order.
fn item(ui: &mut Ui, app: &mut App, enabled: bool, text: &str, keys: &str, order: Order) {
    if ui.add_enabled(enabled, Button::new(text).shortcut_text(keys)).clicked() {
        app.desk.orders.push(order);
        ui.close();
    }
}

fn file(ui: &mut Ui, app: &mut App) {
    ui.menu_button("Open scenario", |ui| {
        for path in scenarios(app.desk.documents.root()) {
            let name = path
                .file_stem()
                .map(|stem| stem.to_string_lossy().into_owned())
                .unwrap_or_default();
            item(ui, app, true, &name, "", Order::Open(path));
        }
        ui.separator();
        if ui.button("Other file …").clicked() {
            let folder = app.desk.documents.root().to_owned();
            ask(app, move || {
                rfd::FileDialog::new()
                    .add_filter("scenario", &["toml"])
                    .set_directory(folder)
                    .pick_file()
                    .map(Order::Open)
            });
            ui.close();
        }
    });
    let unsaved = !app.desk.documents.unsaved().is_empty();
    item(ui, app, unsaved, "Save all", "Ctrl+S", Order::Save);
    item(ui, app, true, "Save scenario as …", "", Order::AskScenarioAs);
    item(ui, app, true, "Open recording …", "", Order::AskRecording);
    if ui.add_enabled(app.desk.view.is_some(), Button::new("Save recording …")).clicked() {
        let name = format!("{}.endline", scenario_name(app));
        ask(app, move || {
            rfd::FileDialog::new().set_file_name(name).save_file().map(Order::SaveRecording)
        });
        ui.close();
    }
    ui.separator();
    if ui.button("Quit").clicked() {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
    }
}

fn scenario_name(app: &App) -> String {
    app.desk
        .documents
        .scenario_path()
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_default()
}

/// Asks by a file dialog on a thread of its own, so that the window stays alive.
fn ask(app: &mut App, question: impl FnOnce() -> Option<Order> + Send + 'static) {
    let (sender, receiver) = mpsc::channel();
    let asked = std::thread::Builder::new().name("endline-dialog".into()).spawn(move || {
        // Nobody waits any more where the window is gone.
        let _ = sender.send(question());
    });
    match asked {
        Ok(_) => app.dialog = Some(receiver),
        Err(error) => {
            app.desk.notice = Some((format!("the dialog cannot be opened: {error}"), true))
        }
    }
}

/// Asks where to write the library's shown table.
pub fn ask_export_table(app: &mut App) {
    let name = format!("{}.csv", app.panels.library.kind().folder());
    ask(app, move || {
        rfd::FileDialog::new()
            .set_file_name(name)
            .add_filter("CSV", &["csv"])
            .save_file()
            .map(Order::ExportTable)
    });
}

/// Asks where to write the gear as a 3-D model.
pub fn ask_export_model(app: &mut App, ending: &'static str) {
    ask(app, move || {
        rfd::FileDialog::new()
            .set_file_name(format!("gear.{ending}"))
            .add_filter(ending, &[ending])
            .save_file()
            .map(Order::ExportModel)
    });
}

/// Asks for another file to save the scenario to.
pub fn ask_scenario_as(app: &mut App) {
    let folder = app
        .desk
        .documents
        .scenario_path()
        .parent()
        .map(std::path::Path::to_owned)
        .unwrap_or_default();
    let name = format!("{}-2.toml", scenario_name(app));
    ask(app, move || {
        let dialog = rfd::FileDialog::new()
            .add_filter("scenario", &["toml"])
            .set_directory(folder)
            .set_file_name(name);
        dialog.save_file().map(Order::ScenarioAs)
    });
}

/// Asks for a recording to open.
pub fn ask_recording(app: &mut App) {
    let folder = app.desk.recordings.clone().unwrap_or_default();
    ask(app, move || {
        rfd::FileDialog::new()
            .set_directory(folder)
            .add_filter("recording", &["endline"])
            .pick_file()
            .map(Order::OpenRecording)
    });
}

/// Asks for a study's file to open.
pub fn ask_study(app: &mut App) {
    let folder = app.desk.documents.root().join("studies");
    ask(app, move || {
        rfd::FileDialog::new()
            .set_directory(folder)
            .add_filter("study", &["toml"])
            .pick_file()
            .map(Order::OpenStudy)
    });
}

/// Asks for a folder of a study's results.
pub fn ask_results(app: &mut App) {
    let folder = app.desk.studies.root();
    ask(app, move || {
        rfd::FileDialog::new().set_directory(folder).pick_folder().map(Order::OpenResults)
    });
}

/// Asks where to write the plots.
pub fn ask_export_plots(app: &mut App, ending: &'static str) {
    let name = format!("{}.{ending}", scenario_name(app));
    ask(app, move || {
        rfd::FileDialog::new()
            .set_file_name(name)
            .add_filter(ending, &[ending])
            .save_file()
            .map(Order::ExportPlots)
    });
}

/// Asks for a table to take into the library.
pub fn ask_import_table(app: &mut App) {
    ask(app, || {
        rfd::FileDialog::new()
            .add_filter("table", &["csv", "tsv", "txt"])
            .pick_file()
            .map(Order::ImportTable)
    });
}

fn edit(ui: &mut Ui, app: &mut App) {
    let (undo, redo) = app.desk.documents.can_undo_redo();
    item(ui, app, undo, "Undo", "Ctrl+Z", Order::Undo);
    item(ui, app, redo, "Redo", "Ctrl+Shift+Z", Order::Redo);
}

fn run(ui: &mut Ui, app: &mut App) {
    let ready = app.desk.view.is_some();
    let running = app.desk.running();
    item(ui, app, ready, if running { "Pause" } else { "Run" }, "Space", Order::PlayPause);
    item(ui, app, ready && !running, "Step", ".", Order::Step);
    item(ui, app, ready, "Reset", "Backspace", Order::Reset);
    let run = app.desk.view.as_ref().is_some_and(|view| view.newest_s > 0.0);
    item(ui, app, run, "Edit the inputs of this run", "", Order::EditInputs);
    item(ui, app, run, "Rerun from the moment shown", "", Order::Rerun);
    item(ui, app, run, "Hold this run to compare with", "", Order::HoldRun);
    let back = app.desk.view.as_ref().is_some_and(|view| view.sought);
    item(ui, app, back, "Go on from the moment shown", "", Order::Branch);
    item(ui, app, ready, "Copy as command line", "Ctrl+Shift+C", Order::CopyCommandLine);
    ui.separator();
    let changed = app.desk.stale() && !app.desk.documents.any_error();
    item(ui, app, changed, "Apply changes", "Ctrl+Enter", Order::Apply);
    item(ui, app, true, "Weak links on or off", "K", Order::WeakLinks);
    let flying = if app.desk.flying { "Stop flying" } else { "Fly the whale" };
    item(ui, app, ready, flying, "Ctrl+F", Order::Fly);
    ui.checkbox(&mut app.desk.pilot.invert_pitch, "Push to put the nose down");
}

fn view(ui: &mut Ui, app: &mut App) {
    for (theme, name) in [(Theme::Dark, "Dark"), (Theme::Light, "Light")] {
        ui.radio_value(&mut app.desk.preferences.theme, theme, name);
    }
    ui.separator();
    for size in [1.0, 1.25, 1.5, 2.0] {
        let text = format!("Size {:.0} %", 100.0 * size);
        item(ui, app, true, &text, "", Order::Size(size));
    }
    ui.separator();
    for layout in Layout::ALL {
        item(ui, app, true, &format!("Layout: {}", layout.name()), "", Order::Arrange(layout));
    }
    item(ui, app, true, "Reset layout", "", Order::Arrange(Layout::Design));
}

fn window(ui: &mut Ui, app: &mut App) {
    for panel in PanelId::ALL {
        let mut open = layout::is_open(&app.dock, panel);
        if ui.checkbox(&mut open, panel.title()).clicked() {
            app.desk.orders.push(if open { Order::Show(panel) } else { Order::Close(panel) });
            ui.close();
        }
    }
}
