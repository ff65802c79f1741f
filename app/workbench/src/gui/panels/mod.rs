//! The panels, one file each: each draws from the desk and leaves orders on it.

pub mod assembly;
pub mod compare;
pub mod entanglement;
pub mod events;
pub mod help;
pub mod library;
pub mod pad;
pub mod pilot;
pub mod plots;
pub mod plugins;
pub mod problems;
pub mod recordings;
pub mod results;
pub mod run;
pub mod scenario;
pub mod start;
pub mod study;
pub mod summary;
pub mod tension;
pub mod view;

use egui::{Rect, RichText, Ui, UiBuilder};

use super::desk::Desk;
use super::layout::Panel;
use super::theme::Theme;

/// Draws a panel.
pub fn show(ui: &mut Ui, panel: Panel, desk: &mut Desk) {
    match panel {
        Panel::Library => library::show(ui, desk),
        Panel::Assembly => assembly::show(ui, desk),
        Panel::Scenario => scenario::show(ui, desk),
        Panel::View => view::show(ui, desk),
        Panel::Run => run::show(ui, desk),
        Panel::Tension => tension::show(ui, desk),
        Panel::Plots => plots::show(ui, desk),
        Panel::Entanglement => entanglement::show(ui, desk),
        Panel::Events => events::show(ui, desk),
        Panel::Summary => summary::show(ui, desk),
        Panel::Problems => problems::show(ui, desk),
        Panel::Help => help::show(ui),
        Panel::Start => start::show(ui, desk),
        Panel::Recordings => recordings::show(ui, desk),
        Panel::Pad => pad::show(ui, desk),
        Panel::Plugins => plugins::show(ui, desk),
        Panel::Study => study::show(ui, desk),
        Panel::Results => results::show(ui, desk),
        Panel::Program => pilot::show(ui, desk),
        Panel::Compare => compare::show(ui, desk),
    }
}

/// A line of small grey text above a group.
fn caption(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(3.0);
    ui.label(RichText::new(text.to_uppercase()).size(10.5).color(faint).strong());
}

/// A line that says why a panel is empty.
fn nothing(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(8.0);
    ui.vertical_centered(|ui| ui.label(RichText::new(text).color(faint)));
}

/// Draws in a part of the panel and nowhere else.
fn within<R>(ui: &mut Ui, rect: Rect, draw: impl FnOnce(&mut Ui) -> R) {
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        draw(ui);
    });
}
