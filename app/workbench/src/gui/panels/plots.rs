//! Plots of the run, also written to files as pictures and tables: the panel Plots, and the panel Tension with the tension of every line.

use std::path::PathBuf;

use egui::{ScrollArea, Ui};
use endline_session::command::ExportAction;
use endline_session::export::chart::Kind;

use crate::gui::command::action::WindowAction;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::widgets;
use crate::gui::widgets::command;
use crate::gui::widgets::plot::{DrawnCharts, HEAD, LEAST};

/// Plots of the run.
pub struct PlotsPanel {
    /// Kinds of plots shown.
    kinds: Vec<Kind>,
    drawn: DrawnCharts,
}

impl Default for PlotsPanel {
    fn default() -> Self {
        Self { kinds: vec![Kind::Tension, Kind::Force, Kind::Wraps], drawn: DrawnCharts::default() }
    }
}

impl Panel for PlotsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        if shared.workbench.view().is_none() {
            return widgets::nothing(ui, "No run yet.");
        }
        self.toolbar(ui, shared);
        if self.kinds.is_empty() {
            return widgets::nothing(ui, "Select plots above.");
        }
        let height = (ui.available_height() / self.kinds.len() as f32 - HEAD).max(LEAST);
        let compared =
            if shared.workbench.comparison().is_some() { "; A solid, B dashed" } else { "" };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for kind in self.kinds.clone() {
                let along = kind == Kind::Along;
                let note = if along { "; shaded from least to greatest so far" } else { "" };
                let title = format!("{}{note}{compared}", kind.title());
                self.drawn.show(ui, shared, kind, &title, height);
            }
        });
    }
}

impl PlotsPanel {
    fn toolbar(&mut self, ui: &mut Ui, shared: &mut Shared) {
        ui.horizontal_wrapped(|ui| {
            for kind in Kind::ALL.iter().copied() {
                let mut on = self.kinds.contains(&kind);
                if ui.toggle_value(&mut on, kind.title()).changed() {
                    let shown = |known: &Kind| {
                        if *known == kind { on } else { self.kinds.contains(known) }
                    };
                    self.kinds = Kind::ALL.iter().copied().filter(shown).collect();
                }
            }
            ui.menu_button("Save ⏷", |ui| {
                for (text, id) in [
                    ("As SVG …", "panel.plots-svg"),
                    ("As PNG …", "panel.plots-png"),
                    ("As CSV …", "panel.plots-csv"),
                ] {
                    if command(ui, shared, text, WindowAction::Ask(id)).clicked() {
                        ui.close();
                    }
                }
            });
        });
    }

    /// Command that writes the plots shown.
    pub fn export(&self, file: PathBuf) -> ExportAction {
        ExportAction::Plots { kinds: self.kinds.clone(), file }
    }
}

/// Tension of every line over time.
#[derive(Default)]
pub struct TensionPanel {
    drawn: DrawnCharts,
}

impl Panel for TensionPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        if let Some(view) = shared.workbench.view().cloned() {
            widgets::kinematic_whale(ui, shared, &view);
        }
        let height = ui.available_height() - HEAD;
        self.drawn.show(ui, shared, Kind::Tension, "", height);
    }
}
