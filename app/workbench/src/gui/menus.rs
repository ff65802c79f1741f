//! The menu bar.

use egui::{Button, MenuBar, RichText, Ui};
use egui_dock::DockState;
use endline_session::units::Units;

use super::desk::{Desk, Order};
use super::files::{scenarios, stem};
use super::layout::{self, Layout};
use super::order::Dialog;
use super::panel_id::PanelId;
use super::theme::Theme;

/// Draws the menu bar.
pub fn show(ui: &mut Ui, desk: &mut Desk, dock: &DockState<String>) {
    MenuBar::new().ui(ui, |ui| {
        ui.label(RichText::new("Endline").strong().color(Theme::palette_of(ui).accent));
        ui.add_space(6.0);
        ui.menu_button("File", |ui| file(ui, desk));
        ui.menu_button("Edit", |ui| edit(ui, desk));
        ui.menu_button("Run", |ui| run(ui, desk));
        ui.menu_button("View", |ui| view(ui, desk));
        ui.menu_button("Window", |ui| window(ui, desk, dock));
        ui.menu_button("Help", |ui| {
            item(ui, desk, true, "Start page", "", Order::Show(PanelId::START));
            item(ui, desk, true, "Keys and help", "F1", Order::Show(PanelId::HELP));
            item(ui, desk, true, "Commands …", "Ctrl+P", Order::Commands);
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            for units in Units::ALL.into_iter().rev() {
                ui.selectable_value(&mut desk.preferences.units, units, units.name())
                    .on_hover_text(units.help());
            }
            ui.separator();
            for layout in Layout::ALL.into_iter().rev() {
                if ui.button(layout.name()).on_hover_text("Arrange the panels").clicked() {
                    desk.orders.push(Order::Arrange(layout));
                }
            }
        });
    });
}

/// A menu item that gives an order.
fn item(ui: &mut Ui, desk: &mut Desk, enabled: bool, text: &str, keys: &str, order: Order) {
    if ui.add_enabled(enabled, Button::new(text).shortcut_text(keys)).clicked() {
        desk.orders.push(order);
        ui.close();
    }
}

fn file(ui: &mut Ui, desk: &mut Desk) {
    ui.menu_button("Open scenario", |ui| {
        for path in scenarios(desk.documents.root()) {
            item(ui, desk, true, &stem(&path), "", Order::Open(path));
        }
        ui.separator();
        item(ui, desk, true, "Other file …", "", Order::Ask(Dialog::Scenario));
    });
    let unsaved = !desk.documents.unsaved().is_empty();
    item(ui, desk, unsaved, "Save all", "Ctrl+S", Order::Save);
    item(ui, desk, true, "Save scenario as …", "", Order::Ask(Dialog::ScenarioAs));
    item(ui, desk, true, "Open recording …", "", Order::Ask(Dialog::Recording));
    let run = desk.view.is_some();
    item(ui, desk, run, "Save recording …", "", Order::Ask(Dialog::SaveRecording));
    ui.separator();
    if ui.button("Quit").clicked() {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
    }
}

fn edit(ui: &mut Ui, desk: &mut Desk) {
    let (undo, redo) = desk.documents.can_undo_redo();
    item(ui, desk, undo, "Undo", "Ctrl+Z", Order::Undo);
    item(ui, desk, redo, "Redo", "Ctrl+Shift+Z", Order::Redo);
}

fn run(ui: &mut Ui, desk: &mut Desk) {
    let ready = desk.view.is_some();
    let running = desk.running();
    item(ui, desk, ready, if running { "Pause" } else { "Run" }, "Space", Order::PlayPause);
    item(ui, desk, ready && !running, "Step", ".", Order::Step);
    item(ui, desk, ready, "Reset", "Backspace", Order::Reset);
    let run = desk.view.as_ref().is_some_and(|view| view.newest_s > 0.0);
    item(ui, desk, run, "Edit the inputs of this run", "", Order::EditInputs);
    item(ui, desk, run, "Rerun from the moment shown", "", Order::Rerun);
    item(ui, desk, run, "Hold this run to compare with", "", Order::HoldRun);
    let back = desk.view.as_ref().is_some_and(|view| view.sought);
    item(ui, desk, back, "Go on from the moment shown", "", Order::Branch);
    item(ui, desk, ready, "Copy as command line", "Ctrl+Shift+C", Order::CopyCommandLine);
    ui.separator();
    let changed = desk.stale() && !desk.documents.any_error();
    item(ui, desk, changed, "Apply changes", "Ctrl+Enter", Order::Apply);
    item(ui, desk, true, "Weak links on or off", "K", Order::WeakLinks);
    let flying = if desk.flying { "Stop flying" } else { "Fly the whale" };
    item(ui, desk, ready, flying, "Ctrl+F", Order::Fly);
    ui.checkbox(&mut desk.pilot.invert_pitch, "Push to put the nose down");
}

fn view(ui: &mut Ui, desk: &mut Desk) {
    for (theme, name) in [(Theme::Dark, "Dark"), (Theme::Light, "Light")] {
        ui.radio_value(&mut desk.preferences.theme, theme, name);
    }
    ui.separator();
    for size in [1.0, 1.25, 1.5, 2.0] {
        let text = format!("Size {:.0} %", 100.0 * size);
        item(ui, desk, true, &text, "", Order::Size(size));
    }
    ui.separator();
    for layout in Layout::ALL {
        item(ui, desk, true, &format!("Layout: {}", layout.name()), "", Order::Arrange(layout));
    }
    item(ui, desk, true, "Reset layout", "", Order::Arrange(Layout::Design));
}

fn window(ui: &mut Ui, desk: &mut Desk, dock: &DockState<String>) {
    for panel in PanelId::ALL {
        let mut open = layout::is_open(dock, panel);
        if ui.checkbox(&mut open, panel.title()).clicked() {
            desk.orders.push(if open { Order::Show(panel) } else { Order::Close(panel) });
            ui.close();
        }
    }
}
