//! The window: menus, dock, status bar, keys and pad.

use std::sync::{Arc, Mutex, mpsc};

use eframe::{CreationContext, Storage};
use egui::{CentralPanel, Context, Frame as Margins, Id, Panel as Bar, Ui};
use egui_dock::{DockArea, DockState, TabViewer};
use endline_session::edit::Documents;
use endline_session::edit::recovery::UnsavedEdits;
use endline_session::live::RunCommand;

use super::canvas::Canvas;
use super::desk::{Desk, Order, Preferences};
use super::layout::{self, Layout};
use super::panel_id::PanelId;
use super::panels::Panels;
use super::{keys, menus, questions, status};
use crate::input::{HeldKeys, PilotAction};

const LAYOUT_KEY: &str = "layout";
const PREFERENCES_KEY: &str = "preferences";

/// The workbench as eframe runs it.
pub struct App {
    /// What the panels share.
    pub desk: Desk,
    /// The panels, each with its state.
    pub panels: Panels,
    /// Panels in place.
    pub dock: DockState<String>,
    /// Answer of a file dialog still open.
    pub dialog: Option<mpsc::Receiver<Option<Order>>>,
    /// Edits that a crash left, with their files.
    pub left_behind: Vec<(std::path::PathBuf, UnsavedEdits)>,
    /// Whether it is asked what to do with unsaved edits.
    pub asking: bool,
    /// Whether the window may close as it is.
    pub leave: bool,
    /// The scenario to be opened, while it is asked what to do with unsaved edits of the present one.
    pub opening: Option<std::path::PathBuf>,
    palette: super::palette::Palette,
    dressed: Option<super::theme::Theme>,
    controls_at_s: Option<f64>,
    /// Orders obeyed in this frame and in the one before, told on standard error once a frame after them was drawn; `None` where
    /// nobody asked.
    told: Option<[Vec<String>; 2]>,
}

impl App {
    /// A workbench on a desk; layout and preferences are taken from eframe's storage.
    #[must_use]
    pub fn new(creation: &CreationContext<'_>, mut desk: Desk) -> Self {
        let stored = |key: &str| creation.storage.and_then(|storage| storage.get_string(key));
        if let Some(text) = stored(PREFERENCES_KEY) {
            desk.preferences = serde_json::from_str(&text).unwrap_or_default();
        }
        desk.pilot.invert_pitch = desk.preferences.invert_pitch;
        desk.pilot.mapping = desk.preferences.mapping.clone();
        creation.egui_ctx.set_zoom_factor(desk.preferences.scale.0.clamp(0.5, 4.0));
        let saved = stored(LAYOUT_KEY)
            .and_then(|text| serde_json::from_str(&text).ok())
            .and_then(layout::known);
        let mut panels = Panels::default();
        if let Some(gl) = &creation.gl {
            match Canvas::new(Arc::clone(gl)) {
                Ok(canvas) => panels.view.drawn[0].canvas = Some(Arc::new(Mutex::new(canvas))),
                Err(error) => desk.notice = Some((error, true)),
            }
        }
        let first = saved.is_none() && creation.storage.is_some();
        let mut dock = saved.unwrap_or_else(|| Layout::Design.dock());
        if first {
            layout::open_beside(&mut dock, PanelId::START, PanelId::VIEW);
        }
        let left_behind = desk.autosave.left_behind();
        Self {
            desk,
            panels,
            dock,
            left_behind,
            asking: false,
            leave: false,
            opening: None,
            dialog: None,
            palette: super::palette::Palette::default(),
            dressed: None,
            controls_at_s: None,
            told: std::env::var_os("ENDLINE_TELL_ORDERS").map(|_| Default::default()),
        }
    }

    /// Obeys every order given since the last call.
    fn obey(&mut self, context: &Context, orders: Vec<Order>) {
        for order in orders {
            if let Some([now, _]) = &mut self.told {
                now.push(format!("{order:?}"));
            }
            match &order {
                Order::Start | Order::PlayPause if layout::is_open(&self.dock, PanelId::START) => {
                    // Whoever runs something wants to see it.
                    layout::close(&mut self.dock, PanelId::START);
                    layout::open(&mut self.dock, PanelId::VIEW);
                    self.desk.obey(&order);
                }
                Order::HoldRun | Order::CompareWith(_) => {
                    layout::open(&mut self.dock, PanelId::COMPARE);
                    self.desk.obey(&order);
                }
                // Another text in its place would take the edits with it.
                Order::Open(path) if self.desk.documents.is_unsaved(Documents::SCENARIO) => {
                    self.opening = Some(path.clone())
                }
                Order::Show(panel) => layout::open(&mut self.dock, *panel),
                Order::Table(kind) => {
                    layout::open(&mut self.dock, PanelId::LIBRARY);
                    self.panels.library.turn_to(*kind);
                }
                Order::Entry(path) => {
                    layout::open(&mut self.dock, PanelId::LIBRARY);
                    self.panels.library.choose(path.clone());
                }
                Order::Assembly(id) => {
                    layout::open(&mut self.dock, PanelId::ASSEMBLY);
                    self.panels.assembly.choose(id.clone());
                }
                Order::Duplicate => self.panels.library.duplicate(&mut self.desk),
                Order::ExportTable(path) => self.panels.library.export(&mut self.desk, path),
                Order::ImportTable(path) => self.panels.library.import(&mut self.desk, path),
                Order::ExportPlots(path) => self.panels.plots.export(&mut self.desk, path),
                Order::ExportModel(path) => self.panels.assembly.export_model(&mut self.desk, path),
                Order::AddEntry => self.panels.program.add_entry(&mut self.desk),
                Order::DeleteEntry => self.panels.program.delete_entry(&mut self.desk),
                Order::EditInputs => {
                    // The entries of the program that is to come are others.
                    self.panels.program.chosen = None;
                    self.desk.obey(&order);
                }
                Order::Person => self.panels.view.change_person(),
                Order::Look(view) => self.panels.view.look(*view),
                Order::Frame => self.panels.view.frame(),
                Order::Views(count) => self.panels.view.split(*count),
                Order::Ruler => self.panels.view.picks.toggle_ruler(),
                Order::LetGo => self.panels.view.picks.let_go(),
                Order::Read(picked) => self.panels.view.picks.read = Some(*picked),
                Order::Close(panel) => layout::close(&mut self.dock, *panel),
                Order::Size(scale) => context.set_zoom_factor(*scale),
                Order::AskExportModel(ending) => menus::ask_export_model(self, ending),
                Order::AskRecording => menus::ask_recording(self),
                Order::AskStudy => menus::ask_study(self),
                Order::AskResults => menus::ask_results(self),
                Order::CopyStudyLine => self.copy_study_line(context),
                Order::ReplayEncounter(..) => {
                    layout::open(&mut self.dock, PanelId::VIEW);
                    self.desk.obey(&order);
                }
                Order::AskScenarioAs => menus::ask_scenario_as(self),
                Order::Arrange(layout) => self.dock = layout.dock(),
                Order::Commands => self.palette.toggle(context),
                Order::CopyCommandLine => self.copy_command_line(context),
                Order::AskExportPlots(ending) => menus::ask_export_plots(self, ending),
                Order::AskExportTable => menus::ask_export_table(self),
                Order::AskImportTable => menus::ask_import_table(self),
                _ => self.desk.obey(&order),
            }
        }
    }

    fn copy_command_line(&mut self, context: &Context) {
        let (line, unsaved) = self.desk.command_line();
        context.copy_text(line);
        let notice = if unsaved {
            "copied; save first: the command reads the files"
        } else {
            "command line copied"
        };
        self.desk.notice = Some((notice.to_owned(), unsaved));
    }

    fn copy_study_line(&mut self, context: &Context) {
        self.desk.notice = Some(match super::studies::command_line(&self.desk) {
            Some((line, unsaved)) => {
                context.copy_text(line);
                let notice = if unsaved {
                    "copied; save first: the commands read the files"
                } else {
                    "command lines copied"
                };
                (notice.to_owned(), unsaved)
            }
            None => ("open a study first".to_owned(), true),
        });
    }

    /// Steers the whale with pad and keys, while flying.
    fn fly(&mut self, context: &Context) {
        let actions = self.desk.pilot.poll_pad();
        if !self.desk.flying {
            self.controls_at_s = None;
            if let Some(view) = self.desk.view.clone() {
                self.desk.rumble.skip(&view.events);
            }
            return;
        }
        for action in actions {
            match action {
                PilotAction::Restart => self.obey(context, vec![Order::Reset, Order::Start]),
                PilotAction::PlayPause => self.obey(context, vec![Order::PlayPause]),
                PilotAction::Person => self.obey(context, vec![Order::Person]),
                PilotAction::WeakLinks => self.obey(context, vec![Order::WeakLinks]),
                PilotAction::Slower => self.obey(context, vec![Order::Slower]),
                PilotAction::Faster => self.obey(context, vec![Order::Faster]),
                PilotAction::NextAct => self.obey(context, vec![Order::NextAct]),
            }
        }
        let now_s = context.input(|input| input.time);
        let elapsed_s = self
            .controls_at_s
            .replace(now_s)
            .map_or(0.0, |before| (now_s - before).clamp(0.0, 0.25));
        let typing = context.egui_wants_keyboard_input();
        let held = if typing { HeldKeys::default() } else { context.input(HeldKeys::of) };
        let controls = self.desk.pilot.controls(&held, self.desk.acts().len(), elapsed_s);
        if let Some(view) = self.desk.view.clone()
            && let Some(pulse) = self.desk.rumble.feel(&view.events, now_s)
        {
            self.desk.pilot.rumble(pulse.strength, pulse.long_s);
        }
        self.desk.send(RunCommand::Controls(controls));
        context.request_repaint();
    }

    /// Tells the orders whose effect is on the screen by now; for whoever drives the window and must know what it has taken in.
    fn tell(&mut self, context: &Context) {
        let Some([now, drawn]) = &mut self.told else { return };
        drawn.drain(..).for_each(|order| eprintln!("order: {order}"));
        std::mem::swap(now, drawn);
        if !drawn.is_empty() {
            context.request_repaint();
        }
    }

    /// Keeps unsaved edits where it is time.
    fn keep(&mut self, context: &Context) {
        let now_s = context.input(|input| input.time);
        if let Some(after_s) = self.desk.autosave.keep(&self.desk.documents, now_s) {
            context.request_repaint_after(std::time::Duration::from_secs_f64(after_s));
        }
        self.desk.preferences.scale.0 = context.zoom_factor();
    }

    /// Drops edits that a crash left.
    pub fn drop_left_behind(&mut self, file: &std::path::Path) {
        // One that cannot be taken away is offered again next time.
        let _ = std::fs::remove_file(file);
        self.left_behind.retain(|(known, _)| known != file);
    }

    fn take_dialog(&mut self) {
        let answer = self.dialog.as_ref().map(mpsc::Receiver::try_recv);
        match answer {
            Some(Ok(order)) => {
                self.dialog = None;
                self.desk.orders.extend(order);
            }
            Some(Err(mpsc::TryRecvError::Disconnected)) => self.dialog = None,
            Some(Err(mpsc::TryRecvError::Empty)) | None => {}
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, context: &Context, _frame: &mut eframe::Frame) {
        self.tell(context);
        self.desk.refresh();
        self.take_dialog();
        self.keep(context);
        if self.desk.replaying() {
            self.desk.play(f64::from(context.input(|input| input.stable_dt)).min(0.1));
            context.request_repaint();
        }
        self.fly(context);
        let orders = keys::orders(context, &self.desk);
        self.obey(context, orders);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let theme = self.desk.preferences.theme;
        if self.dressed.replace(theme) != Some(theme) {
            theme.apply(ui.ctx());
            // This frame was begun in the other one's colours.
            ui.ctx().request_repaint();
        }
        let bar =
            Margins::new().fill(theme.palette().ground).inner_margin(egui::Margin::symmetric(8, 4));
        Bar::top("menus")
            .frame(bar)
            .show_separator_line(false)
            .show(ui, |ui| menus::show(ui, self));
        if !self.left_behind.is_empty() {
            Bar::top("recovery").frame(bar).show(ui, |ui| questions::recovery(ui, self));
        }
        Bar::bottom("status")
            .frame(bar)
            .show_separator_line(false)
            .show(ui, |ui| status::show(ui, &mut self.desk));
        CentralPanel::default().frame(Margins::new().fill(theme.palette().ground)).show(ui, |ui| {
            let style = theme.dock(ui.style());
            let mut tabs = Tabs { panels: &mut self.panels, desk: &mut self.desk };
            DockArea::new(&mut self.dock)
                .style(style)
                .show_leaf_collapse_buttons(false)
                .show_leaf_close_all_buttons(false)
                .show_inside(ui, &mut tabs);
        });
        self.palette.show(ui.ctx(), &mut self.desk);
        questions::plugin(ui.ctx(), &mut self.desk);
        questions::closing(&ui.ctx().clone(), self);
        questions::opening(ui.ctx(), self);
        let orders = std::mem::take(&mut self.desk.orders);
        if !orders.is_empty() {
            self.obey(&ui.ctx().clone(), orders);
            ui.ctx().request_repaint();
        }
    }

    fn save(&mut self, storage: &mut dyn Storage) {
        self.desk.preferences.invert_pitch = self.desk.pilot.invert_pitch;
        self.desk.preferences.mapping = self.desk.pilot.mapping.clone();
        save_json(storage, LAYOUT_KEY, &self.dock);
        save_json::<Preferences>(storage, PREFERENCES_KEY, &self.desk.preferences);
    }
}

fn save_json<T: serde::Serialize>(storage: &mut dyn Storage, key: &str, value: &T) {
    if let Ok(text) = serde_json::to_string(value) {
        storage.set_string(key, text);
    }
}

/// Panels as the dock's tabs.
struct Tabs<'a> {
    panels: &'a mut Panels,
    desk: &'a mut Desk,
}

impl TabViewer for Tabs<'_> {
    type Tab = String;

    fn id(&mut self, tab: &mut String) -> Id {
        Id::new(("panel", tab.as_str()))
    }

    fn title(&mut self, tab: &mut String) -> egui::WidgetText {
        self.panels.find(tab).map_or(tab.as_str(), |panel| panel.title()).into()
    }

    fn ui(&mut self, ui: &mut Ui, tab: &mut String) {
        if let Some(panel) = self.panels.find(tab) {
            panel.ui(ui, self.desk);
        }
    }

    fn on_tab_button(&mut self, tab: &mut String, response: &egui::Response) {
        // The dock's tabs say nothing to screen readers of themselves.
        let title = self.title(tab).text().to_owned();
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &title));
    }

    fn scroll_bars(&self, _tab: &String) -> [bool; 2] {
        [false, false]
    }

    fn allowed_in_windows(&self, tab: &mut String) -> bool {
        tab != PanelId::VIEW.id()
    }
}
