//! The form of an observation: the selected body part, the rope as a whole, and the case with the encounters to search.

use egui::{CollapsingHeader, ComboBox, RichText, Slider, TextEdit, Ui};
use endline_gear::{PathPlace, RopeEnd, Setting, Site};
use endline_sdk::Side;
use endline_session::command::EditAction;
use endline_session::edit::observation::{Range, Sighting};
use endline_session::edit::{Documents, observation};
use endline_session::locate;

use crate::gui::fields::Said;
use crate::gui::panels::search::{Edits, Words, ends, typed};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::{capital, spoken};
use crate::gui::{fields, files, widgets};

/// Initial certainty of rope or no rope.
const SURE: f64 = 0.95;

const WRAPS: Words = Words {
    name: "Wraps",
    unit: "turns",
    help: "Least and most turns around the part; empty if they could not be counted",
};

const ACROSS: Words = Words {
    name: "Across",
    unit: "strands",
    help: "Least and most strands that lie across the part without a turn, such as 1 and 1",
};

/// Draws the form of a part.
pub(super) fn show_part(ui: &mut Ui, single: Site, shared: &mut Shared, edits: &mut Edits) {
    let documents = shared.documents();
    let site = observation::site_of(documents, single);
    let sighting = observation::sighting_of(documents, site);
    egui::Frame::new().fill(Theme::palette_of(ui).field).corner_radius(4.0).inner_margin(8.0).show(
        ui,
        |ui| {
            ui.set_width(ui.available_width());
            head(ui, single, site, sighting, edits);
            state(ui, site, sighting, edits);
            if let Sighting::Seen(present) = sighting {
                sure(ui, shared, site, present, edits);
                rope_on_part(ui, shared, site, sighting, edits);
            }
        },
    );
}

/// Draws the name of the part, and for paired parts whether the side is known.
fn head(ui: &mut Ui, single: Site, site: Site, sighting: Sighting, edits: &mut Edits) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(capital(&spoken(site.name()))).strong());
        let Some(pair) = observation::pair_of(single).filter(|_| sighting != Sighting::Nothing)
        else {
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
fn state(ui: &mut Ui, site: Site, sighting: Sighting, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, "Seen");
        let rope = matches!(sighting, Sighting::Seen(present) if present > 0.5);
        let none = matches!(sighting, Sighting::Seen(present) if present <= 0.5);
        let choices = [
            (rope, Sighting::Seen(SURE), "Rope", "Rope was seen on this part"),
            (none, Sighting::Seen(1.0 - SURE), "No rope", "The part was visible and had no rope"),
            (
                sighting == Sighting::Hidden,
                Sighting::Hidden,
                "Hidden",
                "The part was not visible; it does not affect the distance",
            ),
            (
                sighting == Sighting::Nothing,
                Sighting::Nothing,
                "Unknown",
                "The observation does not mention it; rope there adds a small cost",
            ),
        ];
        for (is_so, then, words, help) in choices {
            if ui.selectable_label(is_so, words).on_hover_text(help).clicked() && !is_so {
                edits.push(Box::new(move |document| {
                    observation::set_sighting(document, site, then)
                }));
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
                    observation::set_sighting(document, site, Sighting::Seen(present))
                })),
            }
        } else if response.drag_stopped() {
            shared.perform(EditAction::LetGo);
        }
    });
}

/// Draws wraps, strands across, tightness and method of observation.
fn rope_on_part(ui: &mut Ui, shared: &Shared, site: Site, sighting: Sighting, edits: &mut Edits) {
    if sighting.has_rope() {
        ends(ui, shared, &WRAPS, Range::Wraps(site), edits);
        if site != Site::Mouth {
            ends(ui, shared, &ACROSS, Range::Across(site), edits);
        }
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

const LENGTH: Words = Words {
    name: "Length",
    unit: "",
    help: "Least and greatest length of rope that trailed behind the whale, with its unit, such as 50 m or 200 ft",
};

const TWIST: Words = Words {
    name: "Twist",
    unit: "turns",
    help: "Least and most turns of the two legs of the rope around each other",
};

/// Draws the form of the rope.
pub(super) fn show_rope(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
    widgets::caption(ui, "Path of the rope");
    path(ui, shared, edits);
    widgets::caption(ui, "Behind the whale");
    ends(ui, shared, &LENGTH, Range::Trailing, edits);
    rope_ends(ui, shared, edits);
    ends(ui, shared, &TWIST, Range::Twist, edits);
}

/// Draws the list of places, which can be moved, removed and added.
fn path(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
    let places = observation::places(shared.documents());
    let faint = Theme::palette_of(ui).faint;
    for (index, place) in places.iter().enumerate() {
        ui.horizontal(|ui| {
            ui.label(RichText::new(format!("{}", index + 1)).color(faint));
            let up = egui::Button::new("⏶").small();
            if ui.add_enabled(index > 0, up).on_hover_text("Earlier").clicked() {
                edits.push(Box::new(move |document| observation::move_place(document, index)));
            }
            if ui.small_button("✖").on_hover_text("Removes this place").clicked() {
                edits.push(Box::new(move |document| observation::remove_place(document, index)));
            }
            ui.label(PathPlace::named(place).map_or_else(|| place.clone(), in_words));
        });
    }
    ui.horizontal(|ui| {
        let combo = ComboBox::from_id_salt("add place").width(150.0).selected_text("Add a place");
        combo.height(360.0).show_ui(ui, |ui| {
            for place in every_place() {
                if ui.selectable_label(false, in_words(place)).clicked() {
                    edits.push(Box::new(move |document| observation::add_place(document, place)));
                }
            }
        });
        if places.is_empty() {
            ui.label(RichText::new("in the order along the rope").color(faint));
        }
    });
}

/// All places that a path can contain, from snout to tail.
fn every_place() -> impl Iterator<Item = PathPlace> {
    Site::ALL.iter().copied().flat_map(|site| {
        let sides = [None, Some(Side::Left), Some(Side::Right)];
        let may = move |side: &Option<Side>| side.is_none() || site.is_in_midplane();
        sides.into_iter().filter(may).map(move |side| PathPlace { site, side })
    })
}

fn in_words(place: PathPlace) -> String {
    let side = match place.side {
        None => "",
        Some(Side::Left) => ", left side",
        Some(Side::Right) => ", right side",
    };
    format!("{}{side}", spoken(place.site.name()))
}

/// Draws what was attached to the ends of the rope.
fn rope_ends(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
    let now = observation::ends(shared.documents());
    ui.horizontal_wrapped(|ui| {
        widgets::name(ui, "Its ends");
        for (index, end) in now.iter().enumerate() {
            let help = "Click to remove this end";
            if ui.button(format!("{end}  ✖")).on_hover_text(help).clicked() {
                edits.push(Box::new(move |document| observation::remove_end(document, index)));
            }
        }
        let combo = ComboBox::from_id_salt("add end").width(90.0).selected_text("Add an end");
        combo.show_ui(ui, |ui| {
            for end in RopeEnd::ALL.iter().copied() {
                if ui.selectable_label(false, end.name()).on_hover_text(end.words()).clicked() {
                    edits.push(Box::new(move |document| observation::add_end(document, end)));
                }
            }
        });
    });
}

/// Text being typed and not applied yet.
#[derive(Debug, Default)]
pub(super) struct Typed(Option<String>);

/// Draws the form of the case.
pub(super) fn show_case(ui: &mut Ui, text: &mut Typed, shared: &mut Shared, edits: &mut Edits) {
    widgets::caption(ui, "The case");
    let said = |hint, help| Said { hint, help };
    typed(ui, shared, "Name", "name", said("", "Shown in lists and reports"), edits);
    typed(
        ui,
        shared,
        "Source",
        "source",
        said("observer, publication", "Observer and publication"),
        edits,
    );
    let known = ["measured", "catalogue", "derived", "estimate"]
        .map(|word| (word.to_owned(), word.to_owned()));
    choice(ui, shared, ("Confidence", "confidence"), &known, edits);
    let whales = &shared.documents().library().whales;
    let whales = whales.iter().map(|whale| (whale.entry.id.clone(), whale.entry.name.clone()));
    let mut whales: Vec<(String, String)> = whales.collect();
    whales.insert(0, (String::new(), "drawn with the encounters".to_owned()));
    choice(ui, shared, ("Animal", "whale"), &whales, edits);
    let help = "Such as 1 yr, instead of a length; sets the length";
    typed(ui, shared, "Age", "age", said("not known", help), edits);
    let help = "Such as 9.1 m or 30 ft, instead of an age";
    typed(ui, shared, "Length", "length", said("not known", help), edits);
    typed(ui, shared, "Notes", "notes", said("", "Remarks, shown in the report"), edits);
    widgets::caption(ui, "Search");
    let studies = locate::studies(shared.documents().root());
    let studies: Vec<(String, String)> =
        studies.iter().map(|file| (files::stem(file), files::stem(file))).collect();
    choice(ui, shared, ("Encounters", "encounters"), &studies, edits);
    mirrored(ui, shared, edits);
    as_text(ui, text, shared);
}

fn choice(
    ui: &mut Ui,
    shared: &Shared,
    (name, field): (&str, &str),
    choices: &[(String, String)],
    edits: &mut Edits,
) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        let width = ui.available_width() - 12.0;
        let documents = shared.documents();
        if let Some(taken) =
            fields::choose(ui, documents, Documents::OBSERVATION, field, choices, width)
        {
            let field = field.to_owned();
            edits.push(Box::new(move |document| observation::set_field(document, &field, &taken)));
        }
    });
}

fn mirrored(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
    let documents = shared.documents();
    let mut on = documents.field(Documents::OBSERVATION, "mirrored").as_deref() == Some("true");
    let help = "Endings that are mirror images of the observation match too; finds more where sides do not matter";
    if ui.checkbox(&mut on, "Mirror images match too").on_hover_text(help).clicked() {
        let value = Setting::plain(if on { "true" } else { "false" });
        edits.push(Box::new(move |document| {
            document.put("mirrored", &value).map_err(|error| error.to_string())
        }));
    }
}

/// Draws the text of the observation; edits apply when the editor loses the focus.
fn as_text(ui: &mut Ui, typed: &mut Typed, shared: &mut Shared) {
    CollapsingHeader::new("As text").id_salt("observation as text").show(ui, |ui| {
        let stored = shared.documents().text(Documents::OBSERVATION);
        let stored = stored.unwrap_or_default().to_owned();
        let mut text = typed.0.take().unwrap_or_else(|| stored.clone());
        let editor = TextEdit::multiline(&mut text).code_editor().desired_width(f32::INFINITY);
        let response = ui.add(editor);
        if response.lost_focus() && text != stored {
            shared.perform(EditAction::Replace { path: Documents::OBSERVATION.to_owned(), text });
        } else if response.has_focus() {
            typed.0 = Some(text);
        }
    });
}
