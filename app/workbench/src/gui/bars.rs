//! The bars of the window: the menu bar, made from the declared commands, and the status bar.

use std::time::Duration;

use egui::{Align, Button, MenuBar, RichText, Sense, Ui, vec2};
use egui_dock::DockState;
use endline_session::live::Status;
use endline_session::units::Units;
use endline_session::workbench::{Notice, NoticeKind};

use crate::gui::command::action::{PanelAction, ViewAction, WindowAction};
use crate::gui::command::{Offer, find};
use crate::gui::layout;
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::questions::unsaved_names;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;

/// An item of a menu.
#[derive(Clone, Copy, Debug)]
pub enum Item {
    /// A command, or an item for each of its choices.
    Command(&'static str),
    /// A submenu with the choices of a command, then further commands: title, command, further commands.
    Submenu(&'static str, &'static str, &'static [&'static str]),
    /// A submenu with commands: title, commands.
    Group(&'static str, &'static [&'static str]),
    /// A line.
    Separator,
}

use Item::{Command, Group, Separator, Submenu};

/// Title and items of each menu.
pub static MENUS: [(&str, &[Item]); 4] = [
    (
        "File",
        &[
            Group("New", &["edit.new-assembly", "study.duplicate", "search.new"]),
            Submenu("Open scenario", "edit.open", &["edit.open-file"]),
            Command("run.open-recording"),
            Command("edit.save"),
            Command("edit.save-scenario-as"),
            Group(
                "Export",
                &[
                    "view.save-picture",
                    "view.save-film",
                    "panel.plots-png",
                    "panel.plots-svg",
                    "panel.plots-csv",
                    "panel.export-table",
                    "panel.model-stl",
                    "panel.model-gltf",
                    "rules.sheet",
                    "rules.save-sheet",
                    "study.save-bundle",
                    "export.recording",
                ],
            ),
            Separator,
            Command("window.quit"),
        ],
    ),
    ("Edit", &[Command("edit.undo"), Command("edit.redo")]),
    (
        "Run",
        &[
            Command("run.toggle"),
            Command("run.step"),
            Command("run.reset"),
            Command("edit.inputs"),
            Command("run.rerun"),
            Command("run.hold"),
            Command("run.branch"),
            Command("window.copy-run"),
            Separator,
            Command("run.apply"),
            Command("edit.weak-links"),
            Command("flight.toggle"),
        ],
    ),
    (
        "View",
        &[
            Command("window.dark"),
            Command("window.light"),
            Separator,
            Command("window.size"),
            Command("window.units"),
            Separator,
            Command("panel.layout"),
        ],
    ),
];

/// Commands of the Help menu, below the start page.
pub static HELP: [&str; 2] = ["panel.help", "window.palette"];

/// Draws the menu bar.
pub fn menus(ui: &mut Ui, shared: &mut Shared, dock: &DockState<String>) {
    MenuBar::new().ui(ui, |ui| {
        ui.label(RichText::new("Endline").strong().color(Theme::palette_of(ui).accent));
        ui.add_space(6.0);
        for (title, items) in MENUS {
            ui.menu_button(title, |ui| {
                items.iter().for_each(|item| show_item(ui, shared, *item));
                if title == "Run" {
                    ui.checkbox(&mut shared.pilot.invert_pitch, "Invert pitch: push for nose down");
                }
            });
        }
        ui.menu_button("Window", |ui| window(ui, shared, dock));
        ui.menu_button("Help", |ui| {
            if ui.button("Start page").clicked() {
                shared.give(PanelAction::Show(PanelId::Start));
                ui.close();
            }
            HELP.iter().for_each(|id| command(ui, shared, id));
            ui.menu_button("Documents", |ui| documents(ui, shared));
            if ui.button("Version, how to cite").clicked() {
                shared.give(PanelAction::Show(PanelId::Help));
                ui.close();
            }
        });
        ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| menus_right(ui, shared));
    });
}

/// Draws units and layouts at the right, as far as there is room. The menus have them too.
fn menus_right(ui: &mut Ui, shared: &mut Shared) {
    const UNITS: f32 = 170.0;
    const LAYOUTS: f32 = 300.0;
    let room = ui.available_width();
    if room < UNITS {
        return;
    }
    let now = shared.workbench.preferences().units;
    for units in Units::ALL.iter().copied().rev() {
        let label = ui.selectable_label(units == now, units.name()).on_hover_text(units.help());
        if label.clicked() {
            shared.give(WindowAction::Units(units));
        }
    }
    if room < UNITS + LAYOUTS {
        return;
    }
    ui.separator();
    for layout in Layout::ALL.iter().copied().rev() {
        if ui.button(layout.name()).on_hover_text("Arrange the panels").clicked() {
            shared.give(PanelAction::Arrange(layout));
        }
    }
}

fn show_item(ui: &mut Ui, shared: &mut Shared, item: Item) {
    match item {
        Command(id) => command(ui, shared, id),
        Submenu(title, id, further) => {
            ui.menu_button(title, |ui| {
                for offer in find(id).map(|command| command.offers(shared)).unwrap_or_default() {
                    let of = find(id).map_or("", |command| command.about().name);
                    let name = offer.name.strip_prefix(of).unwrap_or(&offer.name).trim().to_owned();
                    show_offer(ui, shared, Offer { name, ..offer });
                }
                ui.separator();
                further.iter().for_each(|id| command(ui, shared, id));
            });
        }
        Group(title, ids) => {
            ui.menu_button(title, |ui| ids.iter().for_each(|id| command(ui, shared, id)));
        }
        Separator => {
            ui.separator();
        }
    }
}

/// Draws a command, or an item for each of its choices.
fn command(ui: &mut Ui, shared: &mut Shared, id: &str) {
    let Some(command) = find(id) else { return };
    let asks = command.question(shared).is_some();
    for mut offer in command.offers(shared) {
        if asks {
            offer.name += " …";
        }
        show_offer(ui, shared, offer);
    }
}

/// Draws a menu item; a disabled one is grey, with the reason on hover.
fn show_offer(ui: &mut Ui, shared: &mut Shared, offer: Offer) {
    let button = Button::new(&offer.name).shortcut_text(&offer.keys);
    let response = ui.add_enabled(offer.enabled.is_ok(), button);
    let response = match &offer.enabled {
        Ok(()) => response.on_hover_text(offer.help),
        Err(reason) => response.on_disabled_hover_text(reason),
    };
    if response.clicked() {
        shared.give(offer.command);
        ui.close();
    }
}

/// Draws the list of documents by group.
fn documents(ui: &mut Ui, shared: &mut Shared) {
    for (index, group) in crate::documents::groups().iter().enumerate() {
        if index > 0 {
            ui.separator();
        }
        for document in &group.documents {
            if ui.button(document.title).on_hover_text(document.contents).clicked() {
                shared.give(WindowAction::Read(*document));
                ui.close();
            }
        }
    }
}

fn window(ui: &mut Ui, shared: &mut Shared, dock: &DockState<String>) {
    for panel in PanelId::ALL.iter().copied() {
        let mut open = layout::is_open(dock, panel);
        if ui.checkbox(&mut open, panel.title()).clicked() {
            shared.give(if open { PanelAction::Show(panel) } else { PanelAction::Close(panel) });
            ui.close();
        }
    }
}

/// Draws the status bar.
pub fn status(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    ui.horizontal(|ui| {
        let (text, colour) = match shared.workbench.status() {
            None if shared.workbench.making() => {
                ("Assembling the model".to_owned(), palette.warning)
            }
            None => ("No model".to_owned(), palette.error),
            Some(status) => {
                let colour = match status {
                    Status::Running => palette.good,
                    Status::Settling => palette.warning,
                    Status::Paused | Status::Finished => palette.faint,
                    Status::Stopped(_) | Status::Failed(_) => palette.error,
                };
                (words::status(status).0, colour)
            }
        };
        let (dot, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
        ui.painter().circle_filled(dot.center(), 4.0, colour);
        ui.label(text);
        if let Some(view) = shared.workbench.view() {
            let duration = view.model.spec.settings.duration_s;
            ui.label(
                RichText::new(format!("{:.2} / {duration:.0} s", view.frame.time_s))
                    .color(palette.faint),
            );
            if view.times_real_time > 0.0 {
                ui.label(
                    RichText::new(format!("solver {:.1}× real time", view.times_real_time))
                        .color(palette.faint),
                );
            }
            if view.piloted {
                ui.label(RichText::new("piloted").color(palette.accent));
            }
        }
        film(ui, shared);
        status_right(ui, shared);
    });
}

/// Draws the progress of a film and a button that cancels it, if one is in progress.
fn film(ui: &mut Ui, shared: &mut Shared) {
    let Some(job) = &shared.film else { return };
    let (drawn, of) = job.counted();
    let text = RichText::new(format!("film: {drawn} of {of} pictures"));
    ui.label(text.color(Theme::palette_of(ui).accent))
        .on_hover_text(job.out().display().to_string());
    if ui
        .small_button("Cancel")
        .on_hover_text("Stops here; the pictures drawn so far are kept")
        .clicked()
    {
        shared.give(ViewAction::CancelFilm);
    }
}

fn status_right(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    let problems =
        shared.workbench.project().problems().count() + shared.workbench.plugins().problems.len();
    let unsaved = unsaved_names(shared.documents());
    ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
        let (text, colour) = match problems {
            0 => ("no problems".to_owned(), palette.faint),
            1 => ("1 problem".to_owned(), palette.error),
            count => (format!("{count} problems"), palette.error),
        };
        if ui.add(Button::new(RichText::new(text).color(colour)).frame(false)).clicked() {
            shared.give(PanelAction::Show(PanelId::Problems));
        }
        if !unsaved.is_empty() {
            let text = RichText::new(format!("{} unsaved", unsaved.len())).color(palette.warning);
            ui.label(text).on_hover_text(unsaved.join("\n"));
        }
        if let Some(Notice { text: notice, kind }) = current_notice(ui, shared) {
            let colour = match kind {
                NoticeKind::Done => palette.good,
                NoticeKind::Hint => palette.warning,
                NoticeKind::Fault => palette.error,
            };
            let first = notice.lines().next().unwrap_or_default();
            ui.add(egui::Label::new(RichText::new(first).color(colour)).truncate())
                .on_hover_text(&notice);
        }
    });
}

/// Times at which the notice and the message of the run were first shown [s].
#[derive(Debug, Default)]
pub struct FirstShown {
    notice: Option<(Notice, f64)>,
    message: Option<(Notice, f64)>,
}

/// Time after which a notice is removed [s]; a failure stays longer.
fn lifetime_s(kind: NoticeKind) -> f64 {
    match kind {
        NoticeKind::Done | NoticeKind::Hint => 20.0,
        NoticeKind::Fault => 60.0,
    }
}

/// The time for which a notice is still shown [s]; `None` if its time is over.
fn left_s(first: &mut Option<(Notice, f64)>, now: &Notice, now_s: f64) -> Option<f64> {
    let since_s = match first {
        Some((known, since_s)) if known == now => *since_s,
        _ => {
            *first = Some((now.clone(), now_s));
            now_s
        }
    };
    Some(since_s + lifetime_s(now.kind) - now_s).filter(|left_s| *left_s > 0.0)
}

/// The notice, or else the message of the run, until its time is over.
fn current_notice(ui: &Ui, shared: &mut Shared) -> Option<Notice> {
    let now_s = ui.input(|input| input.time);
    let first = &mut shared.notice_shown;
    let notice = shared.workbench.notice().cloned();
    let message = shared.workbench.view().and_then(|view| view.message.clone()).map(Notice::done);
    let current = |notice: Option<Notice>, first: &mut Option<(Notice, f64)>| {
        let Some(notice) = notice else {
            *first = None;
            return None;
        };
        let left_s = left_s(first, &notice, now_s)?;
        ui.ctx().request_repaint_after(Duration::from_secs_f64(left_s));
        Some(notice)
    };
    let message = current(message, &mut first.message);
    let shown = current(notice, &mut first.notice);
    if shown.is_none() {
        shared.workbench.dismiss_notice();
    }
    shown.or(message)
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn a_notice_is_removed_after_its_time_and_a_new_one_has_its_own() {
        let (saved, failed) = (Notice::done("saved a"), Notice::fault("no ffmpeg"));
        let mut first = None;
        assert!(left_s(&mut first, &saved, 5.0).is_some());
        assert!(left_s(&mut first, &saved, 24.0).is_some());
        assert!(left_s(&mut first, &saved, 26.0).is_none());
        assert!(left_s(&mut first, &failed, 26.0).is_some(), "another notice");
        assert!(left_s(&mut first, &failed, 80.0).is_some(), "a failure stays longer");
        assert!(left_s(&mut first, &failed, 90.0).is_none());
    }

    #[test]
    fn every_command_of_a_menu_is_declared() {
        for item in MENUS.iter().flat_map(|(_, items)| *items) {
            let ids: Vec<&str> = match item {
                Command(id) => vec![id],
                Submenu(_, id, further) => [id].into_iter().chain(*further).copied().collect(),
                Group(_, ids) => ids.to_vec(),
                Separator => Vec::new(),
            };
            ids.iter().for_each(|id| assert!(find(id).is_some(), "{id}"));
        }
        HELP.iter().for_each(|id| assert!(find(id).is_some(), "{id}"));
    }
}
