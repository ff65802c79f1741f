//! The form of the selected entry: trigger, times, and values of controls.

use egui::{ComboBox, Grid, RichText, Ui};
use endline_sdk::Controls;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::{Entry, TRIGGERS, begin_by, path, set, spoken, times};

use crate::gui::fields::{self, Said};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// Times of an entry, with help.
const HELP: [(&str, &str); 3] = [
    ("delay", "Time from the trigger to the start, such as 0.4 s"),
    ("hold", "Duration, such as 3 s; empty: unlimited"),
    ("ramp", "Time over which controls change to their values, and back after the hold"),
];

/// Rows of the form for one kind of trigger: label, key and help.
fn details(trigger: &str) -> &'static [(&'static str, &'static str, &'static str)] {
    const OF: (&str, &str, &str) = ("of", "of", "Id of a line, body or joint; empty: any line");
    const DEVIATION: (&str, &str, &str) = (
        "deviation",
        "sees_deviation",
        "Standard deviation of the distance, such as 1.6 m; empty: 0",
    );
    match trigger {
        "within" => &[OF],
        "sees" => &[DEVIATION, OF],
        _ => &[],
    }
}

pub(super) fn show(ui: &mut Ui, shared: &mut Shared, entry: &Entry) {
    let mut typed: Vec<(&'static str, String)> = Vec::new();
    widgets::caption(ui, "Trigger");
    Grid::new("begins").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        trigger(ui, shared, entry);
        typed.extend(word(
            ui,
            shared,
            entry,
            entry.trigger,
            "Value of the trigger, such as 12 s, any, 5 m, 90 deg",
        ));
        ui.end_row();
        for (label, key, help) in details(entry.trigger) {
            ui.label(RichText::new(*label).color(Theme::palette_of(ui).faint));
            typed.extend(word(ui, shared, entry, key, help));
            ui.end_row();
        }
        for key in times(entry.trigger) {
            ui.label(RichText::new(*key).color(Theme::palette_of(ui).faint));
            let help = HELP.iter().find(|(known, _)| known == key).map_or("", |(_, help)| help);
            typed.extend(word(ui, shared, entry, key, help));
            ui.end_row();
        }
    });
    widgets::caption(ui, "Controls (empty: unchanged)");
    Grid::new("controls").num_columns(4).spacing([8.0, 3.0]).show(ui, |ui| {
        for (control, name) in
            Controls::NAMES.iter().enumerate().filter(|(control, _)| *control != Controls::ACT)
        {
            ui.label(RichText::new(spoken(name)).color(Theme::palette_of(ui).faint));
            let [least, most] = Controls::RANGES[control];
            typed.extend(number(ui, shared, entry, name, &format!("{least} to {most}")));
            if control % 2 == 1 {
                ui.end_row();
            }
        }
    });
    act(ui, shared, entry, &mut typed);
    for (key, text) in typed {
        super::change(shared, |document| set(document, entry.index, key, &text));
    }
}

/// Draws the choice of the trigger.
fn trigger(ui: &mut Ui, shared: &mut Shared, entry: &Entry) {
    let words = TRIGGERS
        .iter()
        .find(|(key, ..)| *key == entry.trigger)
        .map_or("never", |(_, words, _)| words);
    let mut taken = None;
    ComboBox::from_id_salt("trigger").width(132.0).truncate().selected_text(words).show_ui(
        ui,
        |ui| {
            for (key, words, fresh) in TRIGGERS {
                if ui.selectable_label(key == entry.trigger, words).clicked()
                    && key != entry.trigger
                {
                    taken = Some((key, fresh));
                }
            }
        },
    );
    let Some((key, fresh)) = taken else { return };
    // An entry with a time keeps it; two entries at the same time are an error.
    let text = match (key, entry.begin_s) {
        ("at", Some(begin_s)) => endline_session::edit::pilot_program::seconds(begin_s),
        ("after", _) => above(shared, entry.index).unwrap_or_default(),
        _ => fresh.to_owned(),
    };
    super::change(shared, |document| begin_by(document, entry.index, key, &text));
}

/// Id of the nearest entry above that has one.
fn above(shared: &Shared, index: usize) -> Option<String> {
    (0..index).rev().find_map(|above| {
        shared.workbench.project().documents.field(Documents::SCENARIO, &path(above, "id"))
    })
}

fn word(
    ui: &mut Ui,
    shared: &Shared,
    entry: &Entry,
    key: &'static str,
    help: &str,
) -> Option<(&'static str, String)> {
    let field = path(entry.index, key);
    let width = (ui.available_width() - 12.0).max(60.0);
    let typed = fields::edit(
        ui,
        &shared.workbench.project().documents,
        Documents::SCENARIO,
        &field,
        width,
        Said { hint: "", help },
    );
    typed.map(|text| (key, text))
}

fn number(
    ui: &mut Ui,
    shared: &Shared,
    entry: &Entry,
    key: &'static str,
    hint: &str,
) -> Option<(&'static str, String)> {
    let field = path(entry.index, key);
    // A grid would make the first of two too narrow.
    let typed = ui.scope(|ui| {
        ui.set_min_width(62.0);
        fields::edit(
            ui,
            &shared.workbench.project().documents,
            Documents::SCENARIO,
            &field,
            58.0,
            Said { hint, help: hint },
        )
    });
    typed.inner.map(|text| (key, text))
}

/// Draws the choice of an act of the whale.
fn act(ui: &mut Ui, shared: &Shared, entry: &Entry, typed: &mut Vec<(&'static str, String)>) {
    let stored = entry
        .controls
        .iter()
        .find(|(control, _)| *control == Controls::ACT)
        .map(|(_, text)| text.clone())
        .unwrap_or_default();
    ui.horizontal(|ui| {
        ui.label(RichText::new("act").color(Theme::palette_of(ui).faint));
        let shown = if stored.is_empty() { "unchanged".to_owned() } else { stored.clone() };
        ComboBox::from_id_salt("act").width(180.0).truncate().selected_text(shown).show_ui(
            ui,
            |ui| {
                let others = [("", "unchanged"), ("none", "none: ends an act")]
                    .map(|(id, name)| (id.to_owned(), name.to_owned()));
                let acts = shared
                    .workbench
                    .acts()
                    .iter()
                    .map(|act| (act.id.to_string(), act.name.to_string()));
                for (id, name) in others.into_iter().chain(acts) {
                    if ui.selectable_label(id == stored, name).clicked() && id != stored {
                        typed.push(("act", id));
                    }
                }
            },
        );
    });
}
