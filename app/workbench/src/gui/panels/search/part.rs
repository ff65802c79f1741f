//! The form of the selected body part.

use egui::{RichText, Slider, Ui};
use endline_gear::{Setting, Site};
use endline_session::command::EditAction;
use endline_session::edit::Documents;
use endline_session::edit::observation::{self, Range, Told};

use super::{Edits, Words, ends};
use crate::gui::fields::{self, Said};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::words::{capital, spoken};

/// Initial certainty of rope or no rope.
const SURE: f64 = 0.95;

const WRAPS: Words = Words {
    name: "Wraps",
    unit: "turns",
    help: "Least and most turns around the part; empty if they could not be counted",
};

/// Draws the form of a part.
pub(super) fn show(ui: &mut Ui, single: Site, shared: &mut Shared, edits: &mut Edits) {
    let documents = shared.documents();
    let site = observation::site_of(documents, single);
    let sighting = observation::told(documents, site);
    egui::Frame::new().fill(Theme::palette_of(ui).field).corner_radius(4.0).inner_margin(8.0).show(
        ui,
        |ui| {
            ui.set_width(ui.available_width());
            head(ui, single, site, sighting, edits);
            state(ui, site, sighting, edits);
            if let Told::Seen(present) = sighting {
                sure(ui, shared, site, present, edits);
                rope(ui, shared, site, sighting, edits);
            }
        },
    );
}

/// Draws the name of the part, and for paired parts whether the side is known.
fn head(ui: &mut Ui, single: Site, site: Site, sighting: Told, edits: &mut Edits) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(capital(&spoken(site.name()))).strong());
        let Some(pair) = observation::pair_of(single).filter(|_| sighting != Told::Nothing) else {
            return;
        };
        let help = "If the side is not known";
        let mut either = site == pair;
        if ui.checkbox(&mut either, "either side").on_hover_text(help).clicked() {
            let to = if either { pair } else { single };
            edits.push(Box::new(move |document| observation::rename(document, site, to)));
        }
    });
}

/// Draws the choice between rope, no rope, hidden and unknown.
fn state(ui: &mut Ui, site: Site, sighting: Told, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, "Seen");
        let rope = matches!(sighting, Told::Seen(present) if present > 0.5);
        let none = matches!(sighting, Told::Seen(present) if present <= 0.5);
        let choices = [
            (rope, Told::Seen(SURE), "Rope", "Rope was seen on this part"),
            (none, Told::Seen(1.0 - SURE), "No rope", "The part was visible and had no rope"),
            (
                sighting == Told::Hidden,
                Told::Hidden,
                "Hidden",
                "The part was not visible; it does not affect the distance",
            ),
            (
                sighting == Told::Nothing,
                Told::Nothing,
                "Unknown",
                "The observation does not mention it; rope there adds a small cost",
            ),
        ];
        for (is_so, then, words, help) in choices {
            if ui.selectable_label(is_so, words).on_hover_text(help).clicked() && !is_so {
                edits.push(Box::new(move |document| observation::tell(document, site, then)));
            }
        }
    });
}

/// Draws the certainty; 50 % means unknown.
fn sure(ui: &mut Ui, shared: &mut Shared, site: Site, present: f64, edits: &mut Edits) {
    let has_rope = present > 0.5;
    ui.horizontal(|ui| {
        widgets::name(ui, "How sure");
        let mut percent = 100.0 * present.max(1.0 - present);
        ui.spacing_mut().slider_width = (ui.available_width() - 90.0).clamp(60.0, 220.0);
        let slider =
            Slider::new(&mut percent, 51.0..=100.0).suffix(" %").step_by(1.0).max_decimals(0);
        let response = ui.add(slider);
        let documents = &shared.workbench.project().documents;
        if response.changed() {
            let present = if has_rope { percent / 100.0 } else { 1.0 - percent / 100.0 };
            let field = observation::path(documents, site, "present");
            let known = field.filter(|field| documents.has(Documents::OBSERVATION, field));
            match known {
                Some(field) => {
                    let text = format!("{}", (100.0 * present).round() / 100.0);
                    shared.set_held(Documents::OBSERVATION, &field, &text);
                }
                None => edits.push(Box::new(move |document| {
                    observation::tell(document, site, Told::Seen(present))
                })),
            }
        } else if response.drag_stopped() {
            shared.perform(EditAction::LetGo);
        }
    });
}

/// Draws wraps, tightness and method of observation.
fn rope(ui: &mut Ui, shared: &Shared, site: Site, sighting: Told, edits: &mut Edits) {
    if sighting.has_rope() {
        ends(ui, shared, &WRAPS, Range::Wraps(site), edits);
        tight(ui, shared, site, edits);
    }
    let documents = shared.documents();
    let Some(field) = observation::path(documents, site, "seen_by") else { return };
    ui.horizontal(|ui| {
        widgets::name(ui, "Seen by");
        let width = ui.available_width() - 12.0;
        let said = Said { hint: "photographs, drone, necropsy …", help: "Method of observation" };
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
    let now = observation::field(shared.documents(), site, "tight");
    ui.horizontal(|ui| {
        widgets::name(ui, "Tension");
        for (value, words, help) in [
            (Some("true"), "Tight", "The rope pressed into the skin or was under load"),
            (Some("false"), "Slack", "The rope was loose"),
            (None, "Unknown", "The observation does not say"),
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
