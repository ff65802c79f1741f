//! The window: menus, dock, status bar, keys and pad.

mod dispatch;

use crate::gui::command::action::FlightAction;
use crate::gui::command::keys;
use endline_session::command::{EditAction, RunAction};
use endline_session::workbench::Shown;
use std::sync::{Arc, Mutex};

use eframe::{CreationContext, Storage};
use egui::{CentralPanel, Context, Frame as Margins, Id, Panel as Bar, Ui};
use egui_dock::{DockArea, DockState, TabViewer};

use crate::gui::layout::{self, Layout};
use crate::gui::panel::PanelId;
use crate::gui::panels::Panels;
use crate::gui::questions::{self, Dialogs, Questions};
use crate::gui::shared::{Shared, StoredPreferences};
use crate::gui::{bars, fields};
use crate::input::{HeldKeys, PilotAction};
use crate::scene::Canvas;

const LAYOUT_KEY: &str = "layout";
const PREFERENCES_KEY: &str = "preferences";

/// The workbench as eframe runs it.
pub struct App {
    /// What the panels share.
    pub shared: Shared,
    /// The panels, each with its state.
    pub panels: Panels,
    /// Panels in place.
    pub dock: DockState<String>,
    dialogs: Dialogs,
    /// What the window asks.
    pub questions: Questions,
    /// The list of commands.
    pub palette: crate::gui::palette::Palette,
    dressed: Option<crate::gui::theme::Theme>,
    controls_at_s: Option<f64>,
    /// Commands performed in this frame and in the one before, reported on standard error once a frame after them was drawn;
    /// `None` if not requested.
    reported: Option<[Vec<String>; 2]>,
}

impl App {
    /// A window on a workbench; layout and preferences are taken from eframe's storage.
    pub fn new(creation: &CreationContext<'_>, mut shared: Shared) -> Self {
        let stored = |key: &str| creation.storage.and_then(|storage| storage.get_string(key));
        if let Some(text) = stored(PREFERENCES_KEY) {
            let stored: StoredPreferences = serde_json::from_str(&text).unwrap_or_default();
            shared.preferences = stored.window;
            shared.workbench.set_preferences(stored.workbench);
        }
        shared.pilot.invert_pitch = shared.preferences.invert_pitch;
        shared.pilot.mapping = shared.preferences.mapping.clone();
        creation.egui_ctx.set_zoom_factor(shared.preferences.scale.0.clamp(0.5, 4.0));
        let saved = stored(LAYOUT_KEY)
            .and_then(|text| serde_json::from_str(&text).ok())
            .and_then(layout::known);
        let mut panels = Panels::default();
        if let Some(gl) = &creation.gl {
            match Canvas::new(Arc::clone(gl)) {
                Ok(canvas) => panels.view.drawn[0].canvas = Some(Arc::new(Mutex::new(canvas))),
                Err(error) => shared.fault(error),
            }
        }
        let first = saved.is_none() && creation.storage.is_some();
        let mut dock = saved.unwrap_or_else(|| Layout::Design.dock());
        if first {
            layout::open_beside(&mut dock, PanelId::Start, PanelId::View);
        }
        let left_behind = shared.workbench.left_behind();
        Self {
            shared,
            panels,
            dock,
            dialogs: Dialogs::default(),
            questions: Questions::new(left_behind),
            palette: crate::gui::palette::Palette::default(),
            dressed: None,
            controls_at_s: None,
            reported: std::env::var_os("ENDLINE_TELL_COMMANDS").map(|_| Default::default()),
        }
    }

    /// Steers the whale with pad and keys, while flying.
    fn fly(&mut self, context: &Context) {
        let actions = self.shared.pilot.poll_pad();
        if !self.shared.flying {
            self.controls_at_s = None;
            if let Some(view) = self.shared.workbench.view().cloned() {
                self.shared.rumble.skip(&view.events);
            }
            return;
        }
        for action in actions {
            let commands = match action {
                PilotAction::Restart => vec![RunAction::Reset.into(), RunAction::Start.into()],
                PilotAction::PlayPause => vec![RunAction::Toggle.into()],
                PilotAction::Person => vec![FlightAction::Person.into()],
                PilotAction::WeakLinks => vec![EditAction::ToggleWeakLinks.into()],
                PilotAction::Slower => vec![RunAction::Slower.into()],
                PilotAction::Faster => vec![RunAction::Faster.into()],
                PilotAction::NextAct => vec![FlightAction::NextAct.into()],
            };
            self.perform(context, commands);
        }
        let now_s = context.input(|input| input.time);
        let elapsed_s = self
            .controls_at_s
            .replace(now_s)
            .map_or(0.0, |before| (now_s - before).clamp(0.0, 0.25));
        let typing = context.egui_wants_keyboard_input() || self.dialogs.asks();
        let held = if typing { HeldKeys::default() } else { context.input(HeldKeys::of) };
        let controls =
            self.shared.pilot.controls(&held, self.shared.workbench.acts().len(), elapsed_s);
        if let Some(view) = self.shared.workbench.view().cloned()
            && let Some(pulse) = self.shared.rumble.feel(&view.events, now_s)
        {
            self.shared.pilot.rumble(pulse.strength, pulse.long_s);
        }
        self.shared.perform(RunAction::Steer(controls));
        context.request_repaint();
    }

    /// Menus, panels in the dock, status bar.
    fn panels_in_place(&mut self, ui: &mut Ui) {
        let theme = self.shared.preferences.theme;
        let bar =
            Margins::new().fill(theme.palette().ground).inner_margin(egui::Margin::symmetric(8, 4));
        Bar::top("menus")
            .frame(bar)
            .show_separator_line(false)
            .show(ui, |ui| bars::menus(ui, &mut self.shared, &self.dock));
        if !self.questions.left_behind.is_empty() {
            Bar::top("recovery")
                .frame(bar)
                .show(ui, |ui| self.questions.recovery(ui, &mut self.shared));
        }
        Bar::bottom("status")
            .frame(bar)
            .show_separator_line(false)
            .show(ui, |ui| bars::status(ui, &mut self.shared));
        CentralPanel::default().frame(Margins::new().fill(theme.palette().ground)).show(ui, |ui| {
            let style = theme.dock(ui.style());
            let mut tabs = Tabs { panels: &mut self.panels, shared: &mut self.shared };
            DockArea::new(&mut self.dock)
                .style(style)
                .show_leaf_collapse_buttons(true)
                .show_leaf_close_all_buttons(false)
                .show_inside(ui, &mut tabs);
        });
    }

    /// The 3-D view alone; Esc goes back.
    fn presentation(&mut self, ui: &mut Ui) {
        let ground = self.shared.preferences.theme.palette().ground;
        let Self { panels, shared, .. } = self;
        CentralPanel::default()
            .frame(Margins::new().fill(ground).inner_margin(6))
            .show(ui, |ui| panels.view.presented(ui, shared));
        let context = ui.ctx().clone();
        let free = !self.shared.flying && !self.palette.is_open() && !self.dialogs.asks();
        if free && context.input(|input| input.key_pressed(egui::Key::Escape)) {
            self.present(&context);
        }
    }

    /// What lies over everything, then the commands given while drawing.
    fn over_all(&mut self, ui: &Ui) {
        self.palette.show(ui.ctx(), &mut self.shared);
        questions::plugin(ui.ctx(), &mut self.shared);
        questions::newer(ui.ctx(), &mut self.shared);
        self.questions.before_closing(ui.ctx(), &mut self.shared);
        self.questions.before_opening(ui.ctx(), &mut self.shared);
        let typed = self.dialogs.show(ui.ctx());
        let answered = typed.and_then(|(command, file)| command.with_file(&self.shared, file));
        self.shared.commands.extend(answered);
        let commands = std::mem::take(&mut self.shared.commands);
        if !commands.is_empty() {
            self.perform(&ui.ctx().clone(), commands);
            ui.ctx().request_repaint();
        }
    }

    /// Reports the commands whose effect is on the screen by now; for whoever drives the window and must know what it has taken in.
    fn tell(&mut self, context: &Context) {
        let Some([now, drawn]) = &mut self.reported else { return };
        drawn.drain(..).for_each(|command| eprintln!("command: {command}"));
        std::mem::swap(now, drawn);
        if !drawn.is_empty() {
            context.request_repaint();
        }
    }

    /// Checks what the panels drawn show.
    fn check_shown(&mut self) {
        let drawn = std::mem::take(&mut self.shared.drawn);
        let [study, rules] = [PanelId::Study, PanelId::Rules].map(|panel| drawn.contains(&panel));
        self.shared.workbench.check(Shown { study, rules });
    }

    /// Keeps unsaved edits where it is time.
    fn keep(&mut self, context: &Context) {
        let now_s = context.input(|input| input.time);
        if let Some(after_s) = self.shared.workbench.store_unsaved(now_s) {
            context.request_repaint_after(std::time::Duration::from_secs_f64(after_s));
        }
        let size = self.shared.presented_from.unwrap_or_else(|| context.zoom_factor());
        self.shared.preferences.scale.0 = size;
    }
}

impl eframe::App for App {
    fn logic(&mut self, context: &Context, _frame: &mut eframe::Frame) {
        self.tell(context);
        self.shared.workbench.refresh();
        self.shared.refresh_pictures();
        self.take_events();
        let answered = self.answered();
        self.shared.commands.extend(answered);
        self.keep(context);
        if self.shared.workbench.replaying() {
            self.shared.workbench.play(f64::from(context.input(|input| input.stable_dt)).min(0.1));
            context.request_repaint();
        }
        self.fly(context);
        self.select();
        let commands =
            if self.dialogs.asks() { Vec::new() } else { keys::commands(context, &self.shared) };
        self.perform(context, commands);
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        fields::show_in(ui.ctx(), self.shared.workbench.preferences().units);
        let theme = self.shared.preferences.theme;
        if self.dressed.replace(theme) != Some(theme) {
            theme.apply(ui.ctx());
            // This frame was begun in the other one's colours.
            ui.ctx().request_repaint();
        }
        if self.shared.presents() {
            self.presentation(ui);
        } else {
            self.panels_in_place(ui);
        }
        self.over_all(ui);
        self.check_shown();
    }

    fn save(&mut self, storage: &mut dyn Storage) {
        self.shared.preferences.invert_pitch = self.shared.pilot.invert_pitch;
        self.shared.preferences.mapping = self.shared.pilot.mapping.clone();
        save_json(storage, LAYOUT_KEY, &self.dock);
        let Shared { preferences, workbench, .. } = &self.shared;
        let stored = StoredPreferences {
            window: preferences.clone(),
            workbench: workbench.preferences().clone(),
        };
        save_json(storage, PREFERENCES_KEY, &stored);
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
    shared: &'a mut Shared,
}

impl TabViewer for Tabs<'_> {
    type Tab = String;

    fn id(&mut self, tab: &mut String) -> Id {
        Id::new(("panel", tab.as_str()))
    }

    fn title(&mut self, tab: &mut String) -> egui::WidgetText {
        PanelId::find(tab).map_or_else(|| tab.clone(), PanelId::title).into()
    }

    fn ui(&mut self, ui: &mut Ui, tab: &mut String) {
        if let Some(panel) = PanelId::find(tab) {
            self.shared.drawn.push(panel);
            self.panels.get(panel).ui(ui, self.shared);
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
        tab != PanelId::View.id()
    }
}
