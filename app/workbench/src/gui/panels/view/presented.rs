//! The 3-D view alone on the whole screen, for a talk: what it shows stands above it in large letters.

use egui::{Align2, FontId, Ui, pos2};

use super::ViewPanel;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;

/// Height of the letters [points].
const LETTERS: f32 = 20.0;

impl ViewPanel {
    /// Draws the view with the name of the run and how it stands for the whale.
    pub fn presented(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let top = ui.max_rect().center_top();
        self.ui(ui, shared);
        let palette = Theme::palette_of(ui);
        let painter = ui.painter();
        let name = title(shared);
        let font = FontId::proportional(LETTERS);
        painter.text(pos2(top.x, top.y + 8.0), Align2::CENTER_TOP, name, font, palette.text);
        let Some(view) = shared.workbench.view().filter(|view| view.newest_s > 0.0) else { return };
        let Some(whale) = view.summary.as_ref().and_then(|summary| summary.whale.as_ref()) else {
            return;
        };
        let (said, _, colour) = words::outcome(whale.outcome, palette);
        let place = pos2(top.x, top.y + 8.0 + 1.3 * LETTERS);
        painter.text(place, Align2::CENTER_TOP, said, FontId::proportional(0.8 * LETTERS), colour);
    }
}

/// The scenario by its name, or what else the run is of.
fn title(shared: &Shared) -> String {
    let documents = &shared.workbench.project.documents;
    let scenario = || documents.field(endline_session::edit::Documents::SCENARIO, "name");
    let guest = shared.workbench.guest().map(str::to_owned);
    guest.or_else(scenario).unwrap_or_else(|| shared.workbench.scenario_stem())
}
