//! How rope lies on the whale: a map of the body, numbers by part, the outcome and what it means.

use std::sync::Arc;

use egui::{Color32, Grid, Rect, RichText, ScrollArea, Sense, Stroke, Ui, vec2};
use endline_sdk::BodyPart;
use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::metrics::{RegionSummary, WhaleSummary};

use crate::gui::bodymap::{BodyMap, Face};
use crate::gui::desk::{Desk, Order};
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::spoken;
use crate::gui::widgets::{self, words};
use crate::gui::wraps::wraps;
use crate::scene::colour::tension_colour;

/// What the map is coloured by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Measure {
    /// Wraps now.
    #[default]
    Wraps,
    /// Most wraps so far.
    PeakWraps,
    /// Rope in contact now.
    Contact,
    /// Normal force at the moment shown.
    Force,
    /// Greatest normal force so far.
    PeakForce,
    /// Greatest pressure so far.
    Pressure,
    /// Work of friction so far.
    Work,
}

impl Measure {
    const ALL: [(Self, &'static str); 7] = [
        (Self::Wraps, "wraps"),
        (Self::PeakWraps, "most wraps"),
        (Self::Contact, "rope in contact"),
        (Self::Force, "force at this moment"),
        (Self::PeakForce, "greatest force"),
        (Self::Pressure, "greatest pressure"),
        (Self::Work, "friction work"),
    ];

    fn name(self) -> &'static str {
        Self::ALL.iter().find(|(known, _)| *known == self).map_or("", |(_, name)| name)
    }

    fn of(self, region: &RegionSummary, force_n: f64) -> f64 {
        match self {
            Self::Wraps => region.wraps,
            Self::PeakWraps => region.peak_wraps,
            Self::Contact => region.contact_length_m,
            Self::Force => force_n,
            Self::PeakForce => region.peak_normal_n,
            Self::Pressure => region.peak_pressure_pa,
            Self::Work => region.friction_work_j,
        }
    }

    fn text(self, value: f64, units: Units) -> String {
        match self {
            Self::Wraps | Self::PeakWraps => format!("{value:.2} turns"),
            Self::Contact => units.length(value),
            Self::Force | Self::PeakForce => units.force().text(value),
            Self::Pressure => units.force().pressure(value),
            Self::Work => format!("{value:.0} J"),
        }
    }
}

/// Rope on the whale's body, and the outcome.
#[derive(Default)]
pub struct EntanglementPanel {
    measure: Measure,
    map: Option<BodyMap>,
}

impl Panel for EntanglementPanel {
    fn id(&self) -> PanelId {
        PanelId::ENTANGLEMENT
    }

    fn ui(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let Some(view) = desk.view.clone() else { return widgets::nothing(ui, "No run yet.") };
        let Some(whale) = view.summary.as_ref().and_then(|summary| summary.whale.as_ref()) else {
            return widgets::nothing(ui, "No whale in this run.");
        };
        let units = desk.preferences.units;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            outcome(ui, whale, units);
            self.choose_measure(ui);
            self.map(ui, &view, whale, units);
            desk.orders.extend(wrap_list(ui, &view, units).map(Order::Seek));
            widgets::caption(ui, "By part");
            table(ui, &view, whale, units);
        });
    }
}

impl EntanglementPanel {
    fn choose_measure(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.label(RichText::new("Colour").color(Theme::palette_of(ui).faint));
            egui::ComboBox::from_id_salt("measure").selected_text(self.measure.name()).show_ui(
                ui,
                |ui| {
                    for (measure, name) in Measure::ALL {
                        ui.selectable_value(&mut self.measure, measure, name);
                    }
                },
            );
        });
    }

    fn map(&mut self, ui: &mut Ui, view: &LiveView, whale: &WhaleSummary, units: Units) {
        let Some(model) = &view.model.spec.whale else { return };
        if self.map.as_ref().is_none_or(|map| !map.is_of(&model.skin)) {
            self.map = Some(BodyMap::of(Arc::clone(&model.skin)));
        }
        let Some(map) = &mut self.map else { return };
        let (measure, forces) = (self.measure, forces_n(view));
        let value = |part: BodyPart| {
            whale
                .regions
                .iter()
                .find(|region| region.part == part)
                .map_or(0.0, |region| measure.of(region, forces[part as usize]))
        };
        let top = BodyPart::ALL.into_iter().map(value).fold(0.0, f64::max);
        let plain = if ui.visuals().dark_mode {
            Color32::from_rgb(0x6d, 0x7b, 0x84)
        } else {
            Color32::from_rgb(0xb4, 0xc0, 0xc7)
        };
        let colour =
            |part: BodyPart| if value(part) > 0.0 { tint(value(part) / top) } else { plain };
        let width = (ui.available_width() - 16.0) / 2.0;
        for faces in Face::ALL.chunks(2) {
            let height =
                faces.iter().map(|face| width * map.aspect(*face)).fold(0.0, f32::max) + 18.0;
            ui.horizontal(|ui| {
                for face in faces {
                    let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
                    if !ui.is_rect_visible(rect) {
                        continue;
                    }
                    draw(ui, map, *face, rect, view, &colour);
                }
            });
        }
        ui.label(
            RichText::new(format!("brightest: {}", measure.text(top, units)))
                .small()
                .color(Theme::palette_of(ui).faint),
        );
    }
}

fn outcome(ui: &mut Ui, whale: &WhaleSummary, units: Units) {
    let palette = Theme::palette_of(ui);
    let (text, meaning, colour) = words::outcome(whale.outcome, palette);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).heading().color(colour));
        let standing = if whale.decided { "" } else { "so far: " };
        ui.label(RichText::new(format!("{standing}{meaning}")).color(palette.faint));
    });
    let rows = [
        (
            "First contact",
            whale.first_contact_s.map_or_else(|| "–".into(), |time| format!("{time:.2} s")),
        ),
        ("Time in contact", format!("{:.2} s", whale.contact_time_s)),
        ("Added drag, mean of 5 s", units.force().text(whale.drag_added_n)),
        (
            "Trailing, tethered rope",
            format!("{}, {}", units.length(whale.trailing_m), units.length(whale.tethered_m)),
        ),
    ];
    widgets::numbers(ui, "entanglement", &rows);
    ui.label(
        RichText::new(
            "Relative, given this encounter: it says nothing of how often whales meet gear.",
        )
        .small()
        .color(palette.faint),
    );
}

/// Normal force on each part at the moment shown [N].
fn forces_n(view: &LiveView) -> [f64; BodyPart::ALL.len()] {
    let mut forces = [0.0; BodyPart::ALL.len()];
    for contact in &view.frame.contacts {
        forces[contact.region.part() as usize] += contact.normal_force_n.max(0.0);
    }
    forces
}

fn draw(
    ui: &Ui,
    map: &mut BodyMap,
    face: Face,
    rect: Rect,
    view: &LiveView,
    colour: &impl Fn(BodyPart) -> Color32,
) {
    let palette = Theme::palette_of(ui);
    let painter = ui.painter_at(rect);
    painter.text(
        rect.left_top(),
        egui::Align2::LEFT_TOP,
        face.name(),
        egui::FontId::proportional(11.0),
        palette.faint,
    );
    let below = rect.with_min_y(rect.top() + 16.0).shrink(2.0);
    painter.add(map.mesh(face, below, colour));
    let strongest =
        view.frame.contacts.iter().map(|contact| contact.normal_force_n).fold(1.0, f64::max);
    for contact in view.frame.contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
        if let Some(at) = map.contact(face, below, contact) {
            let size = 1.5 + 3.0 * (contact.normal_force_n / strongest).sqrt() as f32;
            painter.circle(at, size, palette.error, Stroke::new(0.5, Color32::BLACK));
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

fn table(ui: &mut Ui, view: &LiveView, whale: &WhaleSummary, units: Units) {
    let palette = Theme::palette_of(ui);
    let forces = forces_n(view);
    Grid::new("parts").num_columns(8).striped(true).spacing([12.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            for head in [
                "Part",
                "Wraps",
                "most",
                "Contact",
                "Force now",
                "Peak",
                "Pressure",
                "Friction work",
            ] {
                ui.label(RichText::new(head).small().color(palette.faint));
            }
            ui.end_row();
            for region in &whale.regions {
                let touched = region.peak_contact_length_m > 0.0;
                let text = |text: String| {
                    RichText::new(text).color(if touched { palette.text } else { palette.faint })
                };
                let force = units.force();
                ui.label(text(region.part.name().replace('_', " ")));
                ui.label(text(format!("{:.2}", region.wraps)));
                ui.label(text(format!("{:.2}", region.peak_wraps)));
                ui.label(text(units.length(region.contact_length_m)));
                ui.label(text(force.text(forces[region.part as usize])));
                ui.label(text(force.text(region.peak_normal_n)));
                ui.label(text(force.pressure(region.peak_pressure_pa)));
                ui.label(text(format!("{:.0} J", region.friction_work_j)));
                ui.end_row();
            }
        },
    );
}
