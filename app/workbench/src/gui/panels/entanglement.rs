//! How rope lies on the whale: a map of the body, numbers by part, the outcome and what it means.

use endline_session::command::TimeAction;
use std::sync::Arc;

use egui::{Color32, Grid, Painter, Rect, RichText, ScrollArea, Sense, Stroke, Ui};
use endline_sdk::{BodyPart, Region};
use endline_session::figures::{Figure, PART, Part, Quantity, View, WHALE, parts, shown};
use endline_session::live::LiveView;
use endline_session::scene::colour::tension_colour;
use endline_session::units::Units;
use endline_sim::metrics::WhaleSummary;

use crate::gui::bodymap::{BodyMap, Face};
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::figures::{Style, list, table};
use crate::gui::widgets::words::spoken;
use crate::gui::widgets::{self, words};
use crate::gui::wraps::wraps;

/// Rope on the whale's body, and the outcome.
pub struct EntanglementPanel {
    /// The figure of the parts by which the map is coloured.
    measure: &'static Figure<Part>,
    map: Option<BodyMap>,
}

impl Default for EntanglementPanel {
    fn default() -> Self {
        // The first figure of a part is its name.
        Self { measure: &PART[1], map: None }
    }
}

impl Panel for EntanglementPanel {
    fn id(&self) -> PanelId {
        PanelId::ENTANGLEMENT
    }

    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(view) = shared.workbench.view().cloned() else {
            return widgets::nothing(ui, "No run yet.");
        };
        let Some(whale) = view.summary.as_ref().and_then(|summary| summary.whale.as_ref()) else {
            return widgets::nothing(ui, "No whale in this run.");
        };
        let style = Style { view: View::Entanglement, units: shared.workbench.preferences.units };
        let parts = parts(whale, &view.frame.contacts);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let first = outcome(ui, whale, style);
            self.choose_measure(ui);
            self.map(ui, &view, &parts, style.units);
            let wrap = wrap_list(ui, &view, style.units);
            shared.commands.extend(first.or(wrap).map(|chosen| TimeAction::Seek(chosen).into()));
            widgets::caption(ui, "By part");
            table(ui, PART, &parts, style, Part::is_untouched);
        });
    }
}

impl EntanglementPanel {
    fn choose_measure(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.label(RichText::new("Colour").color(Theme::palette_of(ui).faint));
            let combo = egui::ComboBox::from_id_salt("measure").selected_text(self.measure.label);
            combo.show_ui(ui, |ui| {
                let is_number = |figure: &&Figure<Part>| figure.quantity != Quantity::Name;
                for figure in shown(PART, View::Entanglement).filter(is_number) {
                    let is_chosen = figure.key == self.measure.key;
                    if ui.selectable_label(is_chosen, figure.label).clicked() {
                        self.measure = figure;
                    }
                }
            });
        });
    }

    fn map(&mut self, ui: &mut Ui, view: &LiveView, parts: &[Part], units: Units) {
        let Some(model) = &view.model.spec.whale else { return };
        if self.map.as_ref().is_none_or(|map| !map.is_of(&model.skin)) {
            self.map = Some(BodyMap::of(Arc::clone(&model.skin)));
        }
        let Some(map) = &mut self.map else { return };
        let measure = self.measure;
        let value = |part: BodyPart| {
            let own = parts.iter().find(|own| own.summary.part == part);
            own.and_then(|own| (measure.read)(own).number()).unwrap_or_default()
        };
        let top = BodyPart::ALL.into_iter().map(value).fold(0.0, f64::max);
        let plain = BodyMap::plain(ui);
        let colour = |region: Region| {
            let value = value(region.part());
            if value > 0.0 { tint(value / top) } else { plain }
        };
        let error = Theme::palette_of(ui).error;
        map.faces(ui, Sense::hover(), colour, |map, painter, face, rect| {
            contacts(map, painter, face, rect, view, error);
        });
        ui.label(
            RichText::new(format!("brightest: {}", measure.quantity.text(&top.into(), units)))
                .small()
                .color(Theme::palette_of(ui).faint),
        );
    }
}

/// The outcome and the figures of the whale; answers the moment that was clicked [s].
fn outcome(ui: &mut Ui, whale: &WhaleSummary, style: Style) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    let (text, meaning, colour) = words::outcome(whale.outcome, palette);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).heading().color(colour));
        let standing = if whale.decided { "" } else { "so far: " };
        ui.label(RichText::new(format!("{standing}{meaning}")).color(palette.faint));
    });
    let wanted = list(ui, WHALE, whale, style);
    ui.label(
        RichText::new(
            "Relative, given this encounter: it says nothing of how often whales meet gear.",
        )
        .small()
        .color(palette.faint),
    );
    wanted
}

/// Where rope presses on the side of the whale that a face shows.
fn contacts(
    map: &BodyMap,
    painter: &Painter,
    face: Face,
    rect: Rect,
    view: &LiveView,
    colour: Color32,
) {
    let strongest =
        view.frame.contacts.iter().map(|contact| contact.normal_force_n).fold(1.0, f64::max);
    for contact in view.frame.contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
        if let Some(at) = map.contact(face, rect, contact) {
            let size = 1.5 + 3.0 * (contact.normal_force_n / strongest).sqrt() as f32;
            painter.circle(at, size, colour, Stroke::new(0.5, Color32::BLACK));
        }
    }
}

fn tint(share: f64) -> Color32 {
    let [red, green, blue, _] = tension_colour(share).map(|part| (part * 255.0) as u8);
    Color32::from_rgb(red, green, blue)
}

/// Wrap by wrap at the moment shown; answers the moment asked for by a click on one.
fn wrap_list(ui: &mut Ui, view: &LiveView, units: Units) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, "Wraps at this moment");
    let found = wraps(view);
    if found.is_empty() {
        ui.label(
            RichText::new("No rope lies a quarter of a turn or more about a part.")
                .color(palette.faint),
        );
        return None;
    }
    let mut wanted = None;
    Grid::new("wraps").num_columns(5).striped(true).spacing([14.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            for head in ["Part", "Turns", "Since", "Touching", "Rope"] {
                ui.label(RichText::new(head).small().color(palette.faint));
            }
            ui.end_row();
            for wrap in &found {
                ui.label(spoken(wrap.part.name()));
                ui.label(format!("{:.2}", wrap.turns));
                match wrap.since_s {
                    Some(since_s)
                        if ui
                            .link(format!("{since_s:.2} s"))
                            .on_hover_text("See when it came half round")
                            .clicked() =>
                    {
                        wanted = Some(since_s);
                    }
                    Some(_) => {}
                    None => {
                        ui.label(RichText::new("not yet half round").color(palette.faint));
                    }
                }
                ui.label(units.length(wrap.touching_m));
                let lines = wrap
                    .lines
                    .iter()
                    .map(|(line, length_m)| format!("{line} {}", units.length(*length_m)));
                let lines = lines.collect::<Vec<_>>().join(", ");
                ui.label(if lines.is_empty() {
                    "loose: nothing presses".to_owned()
                } else {
                    lines
                });
                ui.end_row();
            }
        },
    );
    wanted
}
