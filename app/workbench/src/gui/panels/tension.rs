//! Tension of every line over time, with the ratings of weak links and ropes.

use egui::Ui;
use endline_session::export::chart::Kind;

use crate::gui::panel::{Panel, PanelId};
use crate::gui::shared::Shared;
use crate::gui::widgets;
use crate::gui::widgets::plot::{DrawnCharts, HEAD};

/// Tension of every line over time.
#[derive(Default)]
pub struct TensionPanel {
    drawn: DrawnCharts,
}

impl Panel for TensionPanel {
    fn id(&self) -> PanelId {
        PanelId::TENSION
    }

    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        if let Some(view) = shared.workbench.view().cloned() {
            widgets::kinematic_whale(ui, shared, &view);
        }
        let height = ui.available_height() - HEAD;
        self.drawn.show(ui, shared, Kind::Tension, "", height);
    }
}
