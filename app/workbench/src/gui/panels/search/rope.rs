//! The rope as a whole: the places it passes in order, what trailed behind, and how its legs were twisted.

use egui::{ComboBox, RichText, Ui};
use endline_gear::{PathPlace, RopeEnd, Site};
use endline_sdk::Side;
use endline_session::edit::observation::{self, Range};

use super::{Edits, Words, ends};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::words::spoken;

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
pub(super) fn show(ui: &mut Ui, shared: &Shared, edits: &mut Edits) {
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
    Site::ALL.into_iter().flat_map(|site| {
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
            for end in RopeEnd::ALL {
                if ui.selectable_label(false, end.name()).on_hover_text(end.words()).clicked() {
                    edits.push(Box::new(move |document| observation::add_end(document, end)));
                }
            }
        });
    });
}
