//! Tension of every line over time, with the ratings of weak links and ropes.

use egui::Ui;

use super::super::charts::Kind;
use super::super::desk::Desk;

/// Draws the plot.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    super::plots::alone(ui, desk, Kind::Tension);
}
