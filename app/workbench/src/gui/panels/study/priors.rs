//! How encounters are drawn: a prior for each quantity that varies, with its distribution, source and confidence.

use egui::{ComboBox, RichText, Ui};
use endline_gear::{Setting, prior_words};
use endline_session::edit::Documents;

use super::Edits;
use super::options::item_names;
use crate::gui::fields::{self, Said};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::words::capital;

/// Quantities of an encounter, each with its first distribution and values.
const KNOWN: [(&str, &str, &str); 18] = [
    ("age", "value", "\"10 yr\""),
    ("along", "uniform", "[0.0, 1.0]"),
    ("answer", "choice", "[\"none\", \"roll-away\", \"turn-away\"]"),
    ("answer_above", "value", "\"10 N\""),
    ("behaviour", "choice", "[\"swim\", \"skim-feed\"]"),
    ("condition", "uniform", "[0.9, 1.1]"),
    ("depth", "uniform", "[\"4 m\", \"18 m\"]"),
    ("flipper_raise", "uniform", "[-0.5, 0.5]"),
    ("flipper_sweep", "uniform", "[-0.5, 0.5]"),
    ("flipper_twist", "uniform", "[-0.5, 0.5]"),
    ("gape", "uniform", "[0.0, 1.0]"),
    ("heading", "uniform", "[\"0 deg\", \"360 deg\"]"),
    ("length", "normal", "[\"12 m\", \"1.5 m\"]"),
    ("offset", "uniform", "[\"-2 m\", \"2 m\"]"),
    ("pitch", "uniform", "[\"-10 deg\", \"10 deg\"]"),
    ("roll", "uniform", "[\"-20 deg\", \"20 deg\"]"),
    ("speed", "uniform", "[\"0.6 m/s\", \"1.6 m/s\"]"),
    ("tide", "choice", "[\"0 m/s\", \"0.25 m/s\", \"0.5 m/s\"]"),
];

/// Keys of `[encounter]` that are not priors.
const NO_PRIORS: [&str; 3] = ["aim", "aim_by", "gap"];

/// Distributions: key in the file and name on screen.
const LAWS: [(&str, &str); 5] = [
    ("uniform", "uniform from, to"),
    ("normal", "normal mean, s.d."),
    ("bins", "histogram"),
    ("choice", "one of"),
    ("value", "fixed"),
];

/// Draws the aim of the whale and all priors.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, edits: &mut Edits) {
    widgets::caption(ui, "Encounters, the same for every option");
    list(
        ui,
        shared,
        ("Aimed at", "encounter.aim"),
        "Lines of the gear at rest, with commas between; empty: any line",
        edits,
    );
    super::text(
        ui,
        shared,
        "Start gap",
        "encounter.gap",
        "Distance from the snout to the rope at the start, such as 3 m",
    );
    let names: Vec<String> = shared
        .documents()
        .keys(Documents::STUDY, "encounter")
        .into_iter()
        .filter(|name| !NO_PRIORS.contains(&name.as_str()))
        .collect();
    for name in &names {
        ui.add_space(3.0);
        prior(ui, shared, name, edits);
    }
    add(ui, &names, edits);
}

fn prior(ui: &mut Ui, shared: &mut Shared, name: &str, edits: &mut Edits) {
    let at = format!("encounter.{name}");
    let Some((law, _)) = LAWS
        .iter()
        .find(|(law, _)| shared.documents().has(Documents::STUDY, &format!("{at}.{law}")))
    else {
        return;
    };
    ui.horizontal(|ui| {
        let words = capital(&prior_words(&unquoted(name)));
        widgets::long_name(ui, &words, name);
        laws(ui, &at, law, name, edits);
        match *law {
            "uniform" | "normal" => pair(ui, shared, &format!("{at}.{law}"), edits),
            "value" => one(ui, shared, &format!("{at}.value"), 84.0, edits),
            _ => {}
        }
        if ui
            .small_button("✖")
            .on_hover_text(
                "Removes this prior; the value of the scenario applies in every encounter",
            )
            .clicked()
        {
            edits.push((at.clone(), None));
        }
    });
    if *law == "normal" {
        // On a separate line, because four fields beside the distribution are wider than the panel.
        ui.horizontal(|ui| {
            widgets::name(ui, "  within");
            pair(ui, shared, &format!("{at}.between"), edits);
        });
    }
    if *law == "bins" {
        let ends = "Bounds of the bins in ascending order, with commas between";
        list(ui, shared, ("", &format!("{at}.bins")), ends, edits);
        let shares = "Weight of each bin, with commas between";
        list(ui, shared, ("  weights", &format!("{at}.weights")), shares, edits);
    }
    if *law == "choice" {
        let (field, items) =
            (format!("{at}.choice"), item_names(shared.documents(), &unquoted(name)));
        if items.is_empty() {
            list(ui, shared, ("", &field), "Values, with commas between", edits);
        } else {
            choose_items(ui, shared, &field, &items, edits);
        }
        list(
            ui,
            shared,
            ("  weights", &format!("{at}.weights")),
            "Weight of each value, with commas between; empty: equal weights",
            edits,
        );
    }
    confidence(ui, shared, &at, edits);
}

/// Name of a prior without the quotes of the file.
fn unquoted(name: &str) -> String {
    name.replace('"', "")
}

/// Draws a list of library items, each chosen by its name, and a menu that adds one.
fn choose_items(
    ui: &mut Ui,
    shared: &Shared,
    field: &str,
    items: &[(String, String)],
    edits: &mut Edits,
) {
    let values = values(shared, field);
    let mut changed: Option<Vec<String>> = None;
    for (index, value) in values.iter().enumerate() {
        ui.horizontal(|ui| {
            widgets::name(ui, "");
            let known = items.iter().find(|(id, _)| id == value);
            let shown = known.map_or(value.as_str(), |(_, name)| name);
            let width = (ui.available_width() - 40.0).max(60.0);
            let list = ComboBox::from_id_salt((field, index)).width(width).selected_text(shown);
            list.show_ui(ui, |ui| {
                for (id, name) in items {
                    if ui.selectable_label(id == value, name).clicked() && id != value {
                        changed = Some(replaced(&values, index, Some(id)));
                    }
                }
            });
            if ui.small_button("✖").on_hover_text("Removes this value").clicked() {
                changed = Some(replaced(&values, index, None));
            }
        });
    }
    ui.horizontal(|ui| {
        widgets::name(ui, "");
        ui.menu_button("Add ⏷", |ui| {
            for (id, name) in items.iter().filter(|(id, _)| !values.contains(id)) {
                if ui.button(name).clicked() {
                    changed = Some(values.iter().chain([id]).cloned().collect());
                    ui.close();
                }
            }
        });
    });
    if let Some(values) = changed {
        edits.push((field.to_owned(), written(&values.join(", "))));
    }
}

/// Values with one replaced or removed.
fn replaced(values: &[String], index: usize, by: Option<&String>) -> Vec<String> {
    let mut values = values.to_vec();
    let _ = values.splice(index..=index, by.cloned());
    values
}

/// Values of a list of the study's file.
fn values(shared: &Shared, field: &str) -> Vec<String> {
    let value =
        |index: usize| shared.documents().field(Documents::STUDY, &format!("{field}.{index}"));
    (0..).map_while(value).collect()
}

/// Draws the choice of a distribution; a new one starts with default values.
fn laws(ui: &mut Ui, at: &str, law: &str, name: &str, edits: &mut Edits) {
    let shown = LAWS.iter().find(|(known, _)| *known == law).map_or(law, |(_, words)| words);
    ComboBox::from_id_salt(("law", at)).width(108.0).selected_text(shown).show_ui(ui, |ui| {
        for (other, words) in LAWS {
            if ui.selectable_label(other == law, words).clicked() && other != law {
                edits.push((format!("{at}.{law}"), None));
                edits.push((format!("{at}.weights"), None));
                edits.push((format!("{at}.between"), None));
                start(at, other, name, edits);
            }
        }
    });
}

/// Sets a distribution with its first values.
fn start(at: &str, law: &str, name: &str, edits: &mut Edits) {
    let usual = KNOWN.iter().find(|(known, ..)| *known == name);
    let pair = usual
        .filter(|(_, law, _)| ["uniform", "normal"].contains(law))
        .map_or("[0.0, 1.0]", |(.., values)| values);
    let single = usual
        .map_or("1.0", |(.., values)| values)
        .trim_start_matches('[')
        .split([',', ']'])
        .next()
        .unwrap_or("1.0");
    let values = match law {
        "uniform" | "normal" | "bins" => pair.to_owned(),
        "choice" => format!("[{single}]"),
        _ => single.to_owned(),
    };
    edits.push((format!("{at}.{law}"), Some(Setting::plain(&values))));
    if law == "normal" {
        edits.push((format!("{at}.between"), Some(Setting::plain(pair))));
    }
    if law == "bins" {
        edits.push((format!("{at}.weights"), Some(Setting::plain("[1.0]"))));
    }
}

fn pair(ui: &mut Ui, shared: &Shared, field: &str, edits: &mut Edits) {
    for index in 0..2 {
        one(ui, shared, &format!("{field}.{index}"), 62.0, edits);
    }
}

fn one(ui: &mut Ui, shared: &Shared, field: &str, width: f32, edits: &mut Edits) {
    let said = Said { hint: "", help: "With its unit, such as 0.6 m/s" };
    if let Some(typed) = fields::edit(ui, shared.documents(), Documents::STUDY, field, width, said)
    {
        edits.push((field.to_owned(), Some(Setting::plain(&typed))));
    }
}

/// Draws a list of values as one line with commas.
fn list(ui: &mut Ui, shared: &Shared, (name, field): (&str, &str), help: &str, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, name);
        let id = egui::Id::new(("list", field));
        let stored = values(shared, field).join(", ");
        let mut typed =
            ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| stored.clone());
        let width = ui.available_width() - 12.0;
        let response = ui
            .add(egui::TextEdit::singleline(&mut typed).id(id.with("edit")).desired_width(width))
            .on_hover_text(help);
        if response.changed() {
            ui.data_mut(|data| data.insert_temp(id, typed.clone()));
        }
        if response.lost_focus() {
            ui.data_mut(|data| data.remove_temp::<String>(id));
            let escaped = ui.input(|input| input.key_pressed(egui::Key::Escape));
            if !escaped && typed != stored {
                edits.push((field.to_owned(), written(&typed)));
            }
        }
    });
}

/// A list in TOML from values with commas between: numbers plain, all else in quotes.
fn written(typed: &str) -> Option<Setting> {
    let value = |text: &str| {
        if text.parse::<f64>().is_ok() {
            text.to_owned()
        } else {
            format!("{:?}", text.trim_matches('"'))
        }
    };
    let values: Vec<String> =
        typed.split(',').map(str::trim).filter(|text| !text.is_empty()).map(value).collect();
    (!values.is_empty()).then(|| Setting::plain(&format!("[{}]", values.join(", "))))
}

fn confidence(ui: &mut Ui, shared: &mut Shared, at: &str, edits: &mut Edits) {
    ui.horizontal(|ui| {
        widgets::name(ui, "  source");
        let field = format!("{at}.source");
        let assumed =
            shared.documents().field(Documents::STUDY, &field).as_deref() == Some("assumed");
        let width = ui.available_width() - if assumed { 12.0 } else { 110.0 };
        let said = Said { hint: "assumed", help: "Source of the distribution, or assumed" };
        if let Some(typed) =
            fields::edit(ui, shared.documents(), Documents::STUDY, &field, width, said)
        {
            let typed = if typed.trim().is_empty() { "assumed".to_owned() } else { typed };
            if typed == "assumed" {
                edits.push((format!("{at}.confidence"), None));
            } else if shared
                .documents()
                .field(Documents::STUDY, &format!("{at}.confidence"))
                .is_none()
            {
                edits.push((format!("{at}.confidence"), Some(Setting::text("assumed"))));
            }
            edits.push((field, Some(Setting::text(&typed))));
        }
        if !assumed {
            let field = format!("{at}.confidence");
            let words: Vec<(String, String)> =
                ["measured", "catalogue", "derived", "estimate", "assumed"]
                    .map(|word| (word.to_owned(), word.to_owned()))
                    .to_vec();
            if let Some(word) =
                fields::choose(ui, shared.documents(), Documents::STUDY, &field, &words, 88.0)
            {
                edits.push((field, Some(Setting::text(&word))));
            }
        }
    });
}

fn add(ui: &mut Ui, names: &[String], edits: &mut Edits) {
    ui.add_space(4.0);
    let faint = Theme::palette_of(ui).faint;
    ui.menu_button("Add a prior ⏷", |ui| {
        for (name, law, values) in
            KNOWN.iter().filter(|(name, ..)| !names.iter().any(|known| known == name))
        {
            if ui.button(name.replace('_', " ")).clicked() {
                let at = format!("encounter.{name}");
                edits.push((format!("{at}.{law}"), Some(Setting::plain(values))));
                if *law == "normal" {
                    edits.push((
                        format!("{at}.between"),
                        Some(Setting::plain("[\"9 m\", \"15 m\"]")),
                    ));
                }
                edits.push((format!("{at}.source"), Some(Setting::text("assumed"))));
                ui.close();
            }
        }
    });
    ui.label(
        RichText::new("Quantities without a prior have the value of the scenario.")
            .small()
            .color(faint),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_written_as_in_a_file() {
        assert_eq!(written("2 yr, 15 yr").unwrap().written(), "[\"2 yr\", \"15 yr\"]");
        assert_eq!(written("0.7, 0.3").unwrap().written(), "[0.7, 0.3]");
        assert!(written(" , ").is_none());
    }
}
