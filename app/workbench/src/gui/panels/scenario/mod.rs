//! The scenario of a run as a form: gear, sea, whale, friction, weak links, run.

mod aim;
mod attributes;
mod links;

use crate::gui::command::action::{PanelAction, ViewAction};
use egui::{CollapsingHeader, Grid, RichText, ScrollArea, Ui};
use endline_gear::Kind;
use endline_session::command::{EditAction, RunAction};
use endline_session::edit::problems::message;
use endline_session::edit::{Documents, scenario};

use crate::gui::files::FileChooser;
use crate::gui::panel::{Panel, PanelId};
use crate::gui::panels::start::{What, files_by_subject};
use crate::gui::scenario_fields::{FLAGS, Flag, RUN, Row, SEA, SWIMS, TIDE, WAVES, WHALE};
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};
use crate::gui::{fields, files, widgets};

/// Field of the scenario and its new value.
type Edit = (String, String);

/// Width of the labels [points].
const NAME_WIDTH: f32 = 74.0;

/// The fields of the scenario.
#[derive(Debug, Default)]
pub struct ScenarioPanel {
    aim: aim::AimForm,
    files: FileChooser,
}

impl Panel for ScenarioPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        pick(ui, shared, &mut self.files);
        show(ui, shared, &mut self.aim);
    }
}

/// Draws the fields of the scenario.
fn show(ui: &mut Ui, shared: &mut Shared, aim: &mut aim::AimForm) {
    let foot = 34.0;
    ScrollArea::vertical().auto_shrink(false).max_height(ui.available_height() - foot).show(
        ui,
        |ui| {
            let mut edits: Vec<Edit> = Vec::new();
            gear(ui, shared, &mut edits);
            sea(ui, shared, &mut edits);
            if shared.documents().field(Documents::SCENARIO, "whale.item").is_some() {
                whale(ui, shared, aim, &mut edits);
            }
            links::show(ui, shared, &mut edits);
            widgets::caption(ui, "Run");
            rows(ui, shared, "run", RUN, &mut edits);
            FLAGS.iter().for_each(|of| flag(ui, shared, of, &mut edits));
            for (field, text) in edits {
                shared.alter(Documents::SCENARIO, |document| {
                    scenario::set_field(document, &field, &text)
                });
            }
        },
    );
    ui.separator();
    apply(ui, shared);
}

/// Draws the choice of a scenario of the library.
fn pick(ui: &mut Ui, shared: &mut Shared, chooser: &mut FileChooser) {
    let path = shared.documents().scenario_path().to_owned();
    let mark = if shared.documents().is_unsaved(Documents::SCENARIO) { "• " } else { "" };
    let name = shared.documents().field(Documents::SCENARIO, "name");
    let shown = format!("{mark}{}", name.unwrap_or_else(|| files::stem(&path)));
    let (root, width) = (shared.documents().root().to_owned(), ui.available_width() - 8.0);
    let list = || files_by_subject(&root, What::Scenario);
    if let Some(file) = chooser.show(ui, ("scenario", width), (Some(&path), &shown), list) {
        shared.give(EditAction::OpenScenario(file));
    }
    if let Some(notes) = shared.documents().field(Documents::SCENARIO, "notes") {
        let notes = RichText::new(notes).color(Theme::palette_of(ui).faint);
        ui.add(egui::Label::new(notes).truncate());
    }
}

fn gear(ui: &mut Ui, shared: &Shared, edits: &mut Vec<Edit>) {
    let placed = |table: &str| {
        let table = table.to_owned();
        let of = move |index: u32| format!("{table}.{index}");
        let is_there = |at: &String| shared.documents().has(Documents::SCENARIO, at);
        (0..9).map(of).take_while(is_there).collect::<Vec<String>>()
    };
    let (gears, grounds) = (placed("gear"), placed("field"));
    if !gears.is_empty() {
        widgets::caption(ui, "Gear");
        Grid::new("gear").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            for at in gears {
                name(ui, "Assembly");
                choice(ui, shared, &format!("{at}.assembly"), Kind::Assembly, edits);
                ui.end_row();
            }
        });
    }
    for at in grounds {
        field_of_gear(ui, shared, &at, edits);
    }
}

/// Draws a field of gear: its assembly, and the numbers of its pattern.
fn field_of_gear(ui: &mut Ui, shared: &Shared, at: &str, edits: &mut Vec<Edit>) {
    let of = |key: &str| format!("{at}.{key}");
    let read = |key: &str| shared.documents().field(Documents::SCENARIO, &of(key));
    widgets::caption(ui, &format!("Field {}", read("id").unwrap_or_default()));
    Grid::new(of("assembly")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        name(ui, "Assembly");
        choice(ui, shared, &of("assembly"), Kind::Assembly, edits);
        ui.end_row();
    });
    let pattern: &[(&str, &str, &str)] = match read("pattern").as_deref() {
        Some("grid") => &[
            ("Columns", "columns", "Number of gears along the bearing"),
            ("Rows", "rows", "Number of rows; 1 for a row along a depth contour"),
            ("Spacing along", "spacing.0", "Distance of gears along the bearing, such as 60 m"),
            ("Spacing of rows", "spacing.1", "Distance between rows, such as 80 m"),
            ("Jitter", "jitter", "Greatest displacement of each gear, such as 5 m"),
        ],
        Some("random") => &[
            ("Gears", "count", "Number of gears"),
            ("Length", "area.0", "Side of the area along the bearing, such as 400 m"),
            ("Width", "area.1", "Side of the area across it, such as 200 m"),
            ("Least distance", "apart", "Least distance of two gears, such as 30 m"),
        ],
        _ => &[],
    };
    let common = [
        ("Bearing", "bearing", "Compass bearing of rows, or of the first side of the area"),
        ("Heading", "heading", "Compass bearing of each gear"),
        ("Turn", "turn", "Greatest angle by which a heading differs from it"),
    ];
    let paths: Vec<(String, &str, &str)> =
        pattern.iter().chain(&common).map(|(label, key, help)| (of(key), *label, *help)).collect();
    let listed: Vec<Row<'_>> = paths
        .iter()
        .map(|(field, label, help)| Row { label, field, usual: "usual", help })
        .collect();
    rows(ui, shared, &of("numbers"), &listed, edits);
}

fn sea(ui: &mut Ui, shared: &Shared, edits: &mut Vec<Edit>) {
    widgets::caption(ui, "Sea");
    if shared.documents().field(Documents::SCENARIO, "site.item").is_some() {
        Grid::new("site").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            name(ui, "Site");
            choice(ui, shared, "site.item", Kind::Site, edits);
            ui.end_row();
        });
    }
    rows(ui, shared, "sea", SEA, edits);
    widgets::caption(ui, "Tide that turns");
    rows(ui, shared, "tide", TIDE, edits);
    widgets::caption(ui, "Waves");
    rows(ui, shared, "waves", WAVES, edits);
}

fn whale(ui: &mut Ui, shared: &mut Shared, aim: &mut aim::AimForm, edits: &mut Vec<Edit>) {
    widgets::caption(ui, "Whale");
    let field = |field: &str| shared.documents().field(Documents::SCENARIO, field);
    let dead = field("whale.state").as_deref() == Some("dead");
    let motion = field("whale.motion").and_then(|id| shared.workbench.helpers().0.motion(&id));
    animal(ui, shared, dead, edits);
    rows(ui, shared, "whale", WHALE, edits);
    if !dead {
        rows(ui, shared, "swims", SWIMS, edits);
        if let Some(motion) = motion {
            let attributes = &motion.descriptor().attributes;
            let folded = CollapsingHeader::new("Motion in detail").id_salt("motion");
            folded.show(ui, |ui| {
                attributes::show(ui, shared, "whale.attributes", attributes, edits);
            });
        }
        mouth(ui, shared, edits);
    }
    if !dead {
        aim::show(ui, shared, aim);
    }
    let mut posing = shared.posing;
    if ui
        .toggle_value(&mut posing, "Drag the start in the view")
        .on_hover_text("Shows handles in the 3-D view for place, depth and heading")
        .clicked()
    {
        shared.give(PanelAction::Show(PanelId::View));
        shared.give(ViewAction::Pose);
    }
    attributes::show_friction(ui, shared, edits);
}

/// Draws animal, state and motion.
fn animal(ui: &mut Ui, shared: &Shared, dead: bool, edits: &mut Vec<Edit>) {
    const DYNAMICS: [(&str, &str); 2] =
        [("", "no: kinematic, moves as steered"), ("kinetic", "yes: kinetic")];
    Grid::new("animal").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        name(ui, "Animal");
        choice(ui, shared, "whale.item", Kind::Whale, edits);
        ui.end_row();
        words(
            ui,
            shared,
            "State",
            "whale.state",
            &[("", "alive"), ("dead", "dead, afloat")],
            edits,
        );
        if !dead {
            words(ui, shared, "Feels gear", "whale.dynamics", &DYNAMICS, edits);
            name(ui, "Motion");
            motion(ui, shared, edits);
            ui.end_row();
        }
    });
}

/// Draws the choice of a motion plugin.
fn motion(ui: &mut Ui, shared: &Shared, edits: &mut Vec<Edit>) {
    let (host, _) = shared.workbench.helpers();
    let named = |id: String| {
        let name = host.motion(&id)?.descriptor().name.to_string();
        Some((id, name))
    };
    let motions: Vec<(String, String)> = host.ids().into_iter().filter_map(named).collect();
    let (field, width) = ("whale.motion", ui.available_width() - 8.0);
    let taken = fields::choose(ui, shared.documents(), Documents::SCENARIO, field, &motions, width);
    edits.extend(taken.map(|id| (field.to_owned(), id)));
}

/// Draws the opening of the mouth at the start, which the pilot program contains.
fn mouth(ui: &mut Ui, shared: &Shared, edits: &mut Vec<Edit>) {
    let field = scenario::mouth_field(shared.documents());
    Grid::new("mouth").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        name(ui, "Mouth");
        let said = fields::Said {
            hint: "0, shut",
            help: "Opening at the start, 0 to 1; the pilot program can change it",
        };
        let width = ui.available_width() - 12.0;
        edits.extend(
            fields::edit(ui, shared.documents(), Documents::SCENARIO, &field, width, said)
                .map(|text| (field.clone(), text)),
        );
        ui.end_row();
    });
}

/// Draws a choice among words of the format; the empty word removes the field.
fn words(
    ui: &mut Ui,
    shared: &Shared,
    label: &str,
    field: &str,
    words: &[(&str, &str)],
    edits: &mut Vec<Edit>,
) {
    name(ui, label);
    let choices: Vec<(String, String)> =
        words.iter().map(|(word, text)| ((*word).to_owned(), (*text).to_owned())).collect();
    let width = ui.available_width() - 8.0;
    edits.extend(
        fields::choose(ui, shared.documents(), Documents::SCENARIO, field, &choices, width)
            .map(|word| (field.to_owned(), word)),
    );
    ui.end_row();
}

/// Draws a label of fixed width, so that groups align.
fn name(ui: &mut Ui, text: &str) {
    name_with_help(ui, text, "");
}

/// Draws a label, wrapped if it is long, with help on hover.
fn name_with_help(ui: &mut Ui, text: &str, help: &str) {
    let colour = Theme::palette_of(ui).faint;
    let galley =
        ui.painter().layout(text.to_owned(), egui::FontId::proportional(13.0), colour, NAME_WIDTH);
    let size = egui::vec2(NAME_WIDTH, galley.size().y.max(20.0));
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    ui.painter().galley(
        rect.left_center() - egui::vec2(0.0, galley.size().y / 2.0),
        galley,
        colour,
    );
    if !help.is_empty() {
        response.on_hover_text(help);
    }
}

fn choice(ui: &mut Ui, shared: &Shared, field: &str, kind: Kind, edits: &mut Vec<Edit>) {
    let library = shared.documents().library();
    let choices: Vec<(String, String)> =
        library.entries(kind).iter().map(|entry| (entry.id.clone(), entry.name.clone())).collect();
    let width = ui.available_width() - 8.0;
    edits.extend(
        fields::choose(ui, shared.documents(), Documents::SCENARIO, field, &choices, width)
            .map(|id| (field.to_owned(), id)),
    );
}

fn rows(ui: &mut Ui, shared: &Shared, id: &str, rows: &[Row<'_>], edits: &mut Vec<Edit>) {
    Grid::new(id).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for row in rows {
            name(ui, row.label);
            let width = ui.available_width() - 12.0;
            ui.vertical(|ui| {
                let site = of_site(shared.documents(), row.field);
                let hint = if site.is_empty() { row.usual } else { &site };
                let typed = fields::edit(
                    ui,
                    shared.documents(),
                    Documents::SCENARIO,
                    row.field,
                    width,
                    fields::Said { hint, help: row.help },
                );
                edits.extend(typed.map(|value| (row.field.to_owned(), value)));
                problem(ui, shared, row.field);
            });
            ui.end_row();
        }
    });
}

/// Draws the problem of a field, in its text or in the last model.
fn problem(ui: &mut Ui, shared: &Shared, field: &str) {
    if let Some(problem) = shared.workbench.project().problem_at(Documents::SCENARIO, field) {
        let error = RichText::new(message(problem)).size(11.0).color(Theme::palette_of(ui).error);
        ui.add(egui::Label::new(error).wrap());
    }
}

/// Value of the site, used if the scenario has none.
fn of_site(documents: &Documents, field: &str) -> String {
    let key = match field {
        "site.depth" => "depth",
        "current.speed" => "current",
        _ => return String::new(),
    };
    let file = |item: String| format!("sites/{item}.toml");
    let site = documents.field(Documents::SCENARIO, "site.item").map(file);
    let value = site.and_then(|path| {
        documents.field(&path, &format!("{key}.value")).or_else(|| documents.field(&path, key))
    });
    value.map_or_else(String::new, |value| format!("{value} (site)"))
}

fn flag(ui: &mut Ui, shared: &Shared, flag: &Flag, edits: &mut Vec<Edit>) {
    let mut on = shared
        .documents()
        .field(Documents::SCENARIO, flag.field)
        .map_or(flag.usual, |text| text == "true");
    if ui.checkbox(&mut on, flag.label).on_hover_text(flag.help).changed() {
        edits.push((flag.field.to_owned(), on.to_string()));
    }
}

fn apply(ui: &mut Ui, shared: &mut Shared) {
    let wanted =
        shared.workbench.stale() && !shared.workbench.making() && !shared.documents().any_error();
    ui.horizontal(|ui| {
        if primary(ui, wanted, "Apply")
            .on_hover_text("Assembles the model from the edited files (Ctrl+Enter)")
            .clicked()
        {
            shared.give(RunAction::Apply);
        }
        if ui
            .button("Pilot program …")
            .on_hover_text("How the whale is steered, on a timeline")
            .clicked()
        {
            shared.give(PanelAction::Show(PanelId::Pilot));
        }
        if shared.workbench.making() {
            ui.spinner();
        }
    });
}
