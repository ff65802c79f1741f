//! What was seen at the chosen part.

use egui::{RichText, Slider, Ui};
use endline_gear::{Setting, Site};
use endline_session::edit::Documents;
use endline_session::edit::observation::{self, Range, Told};

use super::{Edits, Words, ends};
use crate::gui::fields::{self, Said};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::words::{capital, spoken};

/// How sure somebody is who says that there was rope, or that there was none.
const SURE: f64 = 0.95;

const WRAPS: Words = Words {
    name: "Wraps",
    unit: "turns",
    help: "Least and most turns about it; empty where nobody could count them",
};

/// Draws the form of a part.
pub(super) fn show(ui: &mut Ui, single: Site, shared: &mut Shared, edits: &mut Edits) {
    let documents = &shared.workbench.project.documents;
    let site = observation::site_of(documents, single);
    let told = observation::told(documents, site);
    egui::Frame::new().fill(Theme::palette_of(ui).field).corner_radius(4.0).inner_margin(8.0).show(
        ui,
        |ui| {
            ui.set_width(ui.available_width());
            head(ui, single, site, told, edits);
            state(ui, site, told, edits);
            if let Told::Seen(present) = told {
                sure(ui, shared, site, present, edits);
                rope(ui, shared, site, told, edits);
            }
        },
    );
}

/// The part's name, and for fins whether it is told by itself or as either of its pair.
fn head(ui: &mut Ui, single: Site, site: Site, told: Told, edits: &mut Edits) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(capital(&spoken(site.name()))).strong());
        let Some(pair) = observation::pair_of(single).filter(|_| told != Told::Nothing) else {
            return;
        };
        let help = "Where it was not told on which side";
        let mut either = site == pair;
        if ui.checkbox(&mut either, "either side").on_hover_text(help).clicked() {
            let to = if either { pair } else { single };
            edits.push(Box::new(move |document| observation::rename(document, site, to)));
        }
    });
}

/// Rope, no rope, hidden, or nothing told.
fn state(ui: &mut Ui, site: Site, told: Told, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, "Seen");
        let rope = matches!(told, Told::Seen(present) if present > 0.5);
        let none = matches!(told, Told::Seen(present) if present <= 0.5);
        let choices = [
            (rope, Told::Seen(SURE), "Rope", "Rope was seen there"),
            (none, Told::Seen(1.0 - SURE), "No rope", "It was seen, and there was no rope"),
            (told == Told::Hidden, Told::Hidden, "Hidden", "Nobody could see it: it costs nothing"),
            (
                told == Told::Nothing,
                Told::Nothing,
                "Not told",
                "Nothing is said of it: rope there counts a little",
            ),
        ];
        for (is_so, then, words, help) in choices {
            if ui.selectable_label(is_so, words).on_hover_text(help).clicked() && !is_so {
                edits.push(Box::new(move |document| observation::tell(document, site, then)));
            }
        }
    });
}

/// How sure it is: 50 % is nobody knows.
fn sure(ui: &mut Ui, shared: &mut Shared, site: Site, present: f64, edits: &mut Edits) {
    let has_rope = present > 0.5;
    ui.horizontal(|ui| {
        widgets::name(ui, "How sure");
        let mut percent = 100.0 * present.max(1.0 - present);
        ui.spacing_mut().slider_width = (ui.available_width() - 90.0).clamp(60.0, 220.0);
        let slider =
            Slider::new(&mut percent, 51.0..=100.0).suffix(" %").step_by(1.0).max_decimals(0);
        let response = ui.add(slider);
        let documents = &mut shared.workbench.project.documents;
        if response.changed() {
            let present = if has_rope { percent / 100.0 } else { 1.0 - percent / 100.0 };
            let field = observation::path(documents, site, "present");
            let known = field.filter(|field| documents.has(Documents::OBSERVATION, field));
            match known {
                Some(field) => {
                    let text = format!("{}", (100.0 * present).round() / 100.0);
                    if let Err(error) = documents.set_held(Documents::OBSERVATION, &field, &text) {
                        shared.fault(error);
                    }
                }
                None => edits.push(Box::new(move |document| {
                    observation::tell(document, site, Told::Seen(present))
                })),
            }
        } else if response.drag_stopped() {
            documents.let_go();
        }
    });
}

/// Wraps, tightness, and how it was seen.
fn rope(ui: &mut Ui, shared: &Shared, site: Site, told: Told, edits: &mut Edits) {
    if told.has_rope() {
        ends(ui, shared, &WRAPS, Range::Wraps(site), edits);
        tight(ui, shared, site, edits);
    }
    let documents = &shared.workbench.project.documents;
    let Some(field) = observation::path(documents, site, "seen_by") else { return };
    ui.horizontal(|ui| {
        widgets::name(ui, "Seen by");
        let width = ui.available_width() - 12.0;
        let said = Said { hint: "photographs, drone, necropsy …", help: "How it was seen" };
        if let Some(typed) =
            fields::edit(ui, documents, Documents::OBSERVATION, &field, width, said)
        {
            let value = (!typed.trim().is_empty()).then(|| Setting::text(typed.trim()));
            edits.push(Box::new(move |document| {
                observation::set(document, site, "seen_by", value.as_ref())
            }));
        }
    });
}

fn tight(ui: &mut Ui, shared: &Shared, site: Site, edits: &mut Edits) {
    let now = observation::field(&shared.workbench.project.documents, site, "tight");
    ui.horizontal(|ui| {
        widgets::name(ui, "Tension");
        for (value, words, help) in [
            (Some("true"), "Tight", "It pressed into the skin, or stood under load"),
            (Some("false"), "Slack", "It lay loose"),
            (None, "Not told", "Nobody said"),
        ] {
            let is_so = now.as_deref() == value;
            if ui.selectable_label(is_so, words).on_hover_text(help).clicked() && !is_so {
                let value = value.map(Setting::plain);
                edits.push(Box::new(move |document| {
                    observation::set(document, site, "tight", value.as_ref())
                }));
            }
        }
    });
}
