//! The body map coloured by a measure of rope on each part, with a scale that does not change during the run.

use std::sync::Arc;

use egui::{Color32, Painter, Rect, RichText, Sense, Stroke, Ui, vec2};
use endline_sdk::{BodyPart, Region};
use endline_session::figures::Quantity;
use endline_session::live::LiveView;
use endline_session::scales::nice_above;
use endline_session::units::Units;
use endline_sim::metrics::{RegionSummary, WhaleSummary};

use crate::gui::bodymap::{BodyMap, Face};
use crate::gui::inspector::turns;
use crate::gui::theme::Theme;
use crate::scene::overlay::{gradient, scale_colour};

/// A measure for the colours of the map.
struct Measure {
    label: &'static str,
    quantity: Quantity,
    /// Top of the scale in the SI unit of the measure, unless a part exceeds it.
    usual_top: f64,
    /// Value at the moment shown, if known.
    now: Option<fn(&LiveView, BodyPart) -> f64>,
    /// Greatest value, or sum, of the run so far.
    so_far: fn(&RegionSummary) -> f64,
}

static MEASURES: [Measure; 5] = [
    Measure {
        label: "Wraps",
        quantity: Quantity::Turns,
        usual_top: 1.0,
        now: Some(turns),
        so_far: |part| part.peak_wraps,
    },
    Measure {
        label: "Rope in contact",
        quantity: Quantity::Length,
        usual_top: 1.0,
        now: Some(|view, part| pressing(view, part, |contact| contact.length_m)),
        so_far: |part| part.peak_contact_length_m,
    },
    Measure {
        label: "Force",
        quantity: Quantity::Force,
        usual_top: 500.0,
        now: Some(|view, part| pressing(view, part, |contact| contact.normal_force_n)),
        so_far: |part| part.peak_normal_n,
    },
    Measure {
        label: "Peak pressure",
        quantity: Quantity::Pressure,
        usual_top: 100e3,
        now: None,
        so_far: |part| part.peak_pressure_pa,
    },
    Measure {
        label: "Friction work",
        quantity: Quantity::Work,
        usual_top: 1000.0,
        now: None,
        so_far: |part| part.friction_work_j,
    },
];

/// The map, its measure, and whether it shows the moment or the whole run.
#[derive(Default)]
pub struct SkinMap {
    map: Option<BodyMap>,
    measure: usize,
    so_far: bool,
}

impl SkinMap {
    /// Draws the choice of measure, the four faces of the skin, and the scale.
    pub fn show(&mut self, ui: &mut Ui, view: &LiveView, whale: &WhaleSummary, units: Units) {
        self.choose(ui, view);
        let values = self.values(view, whale);
        let measure = &MEASURES[self.measure];
        let most = values.iter().copied().fold(0.0, f64::max);
        let top = nice_above(most).max(measure.usual_top);
        let plain = BodyMap::plain(ui);
        let colour = |region: Region| {
            let value = values[region.part() as usize];
            if value > 0.0 { scale_colour(value / top) } else { plain }
        };
        let error = Theme::palette_of(ui).error;
        let Some(map) = self.map_of(view) else { return };
        map.faces(ui, Sense::hover(), colour, |map, painter, face, rect| {
            contacts(map, painter, face, rect, view, error);
        });
        scale(ui, measure, top, units);
    }

    fn choose(&mut self, ui: &mut Ui, view: &LiveView) {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("Colour").color(Theme::palette_of(ui).faint));
            let combo = egui::ComboBox::from_id_salt("measure");
            combo.selected_text(MEASURES[self.measure].label).show_ui(ui, |ui| {
                for (index, measure) in MEASURES.iter().enumerate() {
                    ui.selectable_value(&mut self.measure, index, measure.label);
                }
            });
            let so_far = self.shows_so_far();
            let momentary = MEASURES[self.measure].now.is_some();
            let now = format!("At {:.2} s", view.frame.time_s);
            let now = ui.add_enabled(momentary, egui::Button::selectable(!so_far, now));
            let now = now.on_hover_text("Values at the moment shown");
            if now.on_disabled_hover_text("Known only for the whole run").clicked() {
                self.so_far = false;
            }
            let text = format!("Most until {:.2} s", view.newest_s);
            let help = "Greatest values of the run so far, whichever moment is shown";
            if ui.selectable_label(so_far, text).on_hover_text(help).clicked() {
                self.so_far = true;
            }
        });
    }

    fn shows_so_far(&self) -> bool {
        self.so_far || MEASURES[self.measure].now.is_none()
    }

    /// Value of each part, in the order of [`BodyPart::ALL`].
    fn values(&self, view: &LiveView, whale: &WhaleSummary) -> [f64; BodyPart::ALL.len()] {
        let measure = &MEASURES[self.measure];
        BodyPart::ALL.map(|part| match measure.now.filter(|_| !self.shows_so_far()) {
            Some(now) => now(view, part),
            None => whale
                .regions
                .iter()
                .find(|region| region.part == part)
                .map_or(0.0, |region| (measure.so_far)(region)),
        })
    }

    fn map_of(&mut self, view: &LiveView) -> Option<&mut BodyMap> {
        let skin = &view.model.spec.whale.as_ref()?.skin;
        if self.map.as_ref().is_none_or(|map| !map.is_of(skin)) {
            self.map = Some(BodyMap::of(Arc::clone(skin)));
        }
        self.map.as_mut()
    }
}

/// Sum over the contacts on a part at the moment shown.
fn pressing(view: &LiveView, part: BodyPart, of: fn(&endline_sim::ContactPoint) -> f64) -> f64 {
    let own = view.frame.contacts.iter().filter(|contact| contact.region.part() == part);
    own.filter(|contact| contact.normal_force_n > 0.0).map(of).sum()
}

/// Draws dots where rope presses on a face.
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

/// Draws the scale of colours with numbers, and the meaning of the dots.
fn scale(ui: &mut Ui, measure: &Measure, top: f64, units: Units) {
    let text = |value: f64| measure.quantity.text(&value.into(), units);
    ui.horizontal_wrapped(|ui| {
        let faint = Theme::palette_of(ui).faint;
        let small = |words: String| RichText::new(words).small().color(faint);
        ui.label(small("0".to_owned()));
        let (rect, response) = ui.allocate_exact_size(vec2(120.0, 10.0), Sense::hover());
        let label = || egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "Scale of the map");
        response.widget_info(label);
        gradient(ui.painter(), rect);
        let unit = if measure.quantity == Quantity::Turns { " turns" } else { "" };
        ui.label(small(format!("{}{unit}", text(top))));
        ui.label(small("· dots: contacts of rope at the moment shown".to_owned()));
    });
}
