//! The window: menus, dock, status bar, keys and pad.

mod dispatch;
mod tabs;

use std::sync::{Arc, Mutex};

use eframe::{CreationContext, Storage};
use egui::{CentralPanel, Context, Frame as Margins, Panel as Bar, Ui};
use egui_dock::{DockArea, DockState};
use endline_session::live::RunCommand;

use crate::gui::canvas::Canvas;
use crate::gui::desk::{Desk, Order, Preferences};
use crate::gui::dialogs::Dialogs;
use crate::gui::layout::{self, Layout};
use crate::gui::panel_id::PanelId;
use crate::gui::panels::Panels;
use crate::gui::questions::{self, Questions};
use crate::gui::{keys, menus, status};
use crate::input::{HeldKeys, PilotAction};
use tabs::Tabs;

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
    dialogs: Dialogs,
    /// What the window asks.
    pub questions: Questions,
    palette: crate::gui::palette::Palette,
    dressed: Option<crate::gui::theme::Theme>,
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
            dialogs: Dialogs::default(),
            questions: Questions::new(left_behind),
            palette: crate::gui::palette::Palette::default(),
            dressed: None,
            controls_at_s: None,
            told: std::env::var_os("ENDLINE_TELL_ORDERS").map(|_| Default::default()),
        }
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
}

impl eframe::App for App {
    fn logic(&mut self, context: &Context, _frame: &mut eframe::Frame) {
        self.tell(context);
        self.desk.refresh();
        self.desk.orders.extend(self.dialogs.take());
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
            .show(ui, |ui| menus::show(ui, &mut self.desk, &self.dock));
        if !self.questions.left_behind.is_empty() {
            Bar::top("recovery")
                .frame(bar)
                .show(ui, |ui| self.questions.recovery(ui, &mut self.desk));
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
        self.questions.before_closing(ui.ctx(), &mut self.desk);
        self.questions.before_opening(ui.ctx(), &mut self.desk);
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
