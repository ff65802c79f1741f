//! Plots of the run, one below the other; written to files as pictures and tables.

use std::path::Path;

use egui::{ScrollArea, Ui};
use endline_session::export;
use endline_session::export::chart::{Chart, Kind};

use crate::gui::desk::{Desk, Order};
use crate::gui::order::Dialog;
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::widgets;
use crate::gui::widgets::plot::{DrawnCharts, HEAD, LEAST, chart};

/// Plots of the run.
pub struct PlotsPanel {
    /// The kinds shown.
    kinds: Vec<Kind>,
    drawn: DrawnCharts,
}

impl Default for PlotsPanel {
    fn default() -> Self {
        Self { kinds: vec![Kind::Tension, Kind::Force, Kind::Wraps], drawn: DrawnCharts::default() }
    }
}

impl Panel for PlotsPanel {
    fn id(&self) -> PanelId {
        PanelId::PLOTS
    }

    fn ui(&mut self, ui: &mut Ui, desk: &mut Desk) {
        if desk.view.is_none() {
            return widgets::nothing(ui, "No run yet.");
        }
        self.toolbar(ui, desk);
        if self.kinds.is_empty() {
            return widgets::nothing(ui, "Choose what to plot above.");
        }
        let height = (ui.available_height() / self.kinds.len() as f32 - HEAD).max(LEAST);
        let compared = if desk.other().is_some() { "; A solid, B dashed" } else { "" };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for kind in self.kinds.clone() {
                let along = kind == Kind::Along;
                let note = if along { "; shaded from least to greatest so far" } else { "" };
                let title = format!("{}{note}{compared}", kind.title());
                self.drawn.show(ui, desk, kind, &title, height);
            }
        });
    }
}

impl PlotsPanel {
    fn toolbar(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal_wrapped(|ui| {
            for kind in Kind::ALL {
                let mut on = self.kinds.contains(&kind);
                if ui.toggle_value(&mut on, kind.title()).changed() {
                    let shown = |known: &Kind| {
                        if *known == kind { on } else { self.kinds.contains(known) }
                    };
                    self.kinds = Kind::ALL.into_iter().filter(shown).collect();
                }
            }
            ui.menu_button("Save ⏷", |ui| {
                for ending in export::CHART_ENDINGS {
                    let text = format!("As {} …", ending.to_uppercase());
                    if ui.button(text).clicked() {
                        desk.orders.push(Order::Ask(Dialog::ExportPlots(ending)));
                        ui.close();
                    }
                }
            });
        });
    }

    /// Writes the plots shown in the format of the file's ending.
    pub fn export(&mut self, desk: &mut Desk, path: &Path) {
        let written = export::charts(path, &self.charts(desk));
        desk.notice_saved(path, written);
    }

    /// The charts shown, for writing.
    fn charts(&self, desk: &Desk) -> Vec<Chart> {
        let Some(view) = &desk.view else { return Vec::new() };
        let (other, units) = (desk.other_view(), desk.preferences.units);
        self.kinds.iter().map(|kind| chart(*kind, view, other.as_deref(), units)).collect()
    }
}
