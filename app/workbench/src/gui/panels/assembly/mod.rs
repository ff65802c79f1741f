//! Gear from buoy to trap: its parts or attributes at the left, the rig at rest drawn to scale at slack and at running
//! tide beside it, tensions and float height below.

mod form;
mod inserts;
mod parts;
mod selector;
mod side;
mod sweep;
mod table;

use egui::{RichText, ScrollArea, Slider, SliderClamping, Ui};
use endline_gear::Kind;
use endline_session::edit::Documents;
use endline_session::rest::TrialSea;

use super::super::bench::{Answer, Bench, Trial};
use super::super::desk::{Desk, Order};
use super::super::theme::{Theme, primary};

/// Fastest current of the slider [m/s]: 2 knots.
const FASTEST_M_S: f64 = 1.03;

/// What the assembly panel shows.
#[derive(Default)]
pub struct AssemblyState {
    /// The gear shown; the scenario's where `None`.
    pub shown: Option<String>,
    /// The gear it is compared with.
    pub other: Option<String>,
    /// Surface speed at running tide [m/s]; the scenario's where `None`.
    pub running_m_s: Option<f64>,
    /// The line chosen, by its index among the parts.
    pub line: usize,
    /// Whether the table of depths and currents is shown.
    pub sweep: bool,
    bench: Bench,
    asked: Option<(u64, Vec<Trial>)>,
    /// Whether the gear selector is shown.
    pub selecting: bool,
    pictured: Bench,
    pictured_for: Option<u64>,
    swept: Bench,
    swept_for: Option<(u64, String)>,
}

/// The four rigs drawn: A and B, each at slack and at running tide.
pub(super) struct Drawn<'a> {
    a: [Option<&'a Answer>; 2],
    b: [Option<&'a Answer>; 2],
}

impl AssemblyState {
    fn drawn(&self) -> Drawn<'_> {
        let pair = |first: usize| [self.bench.answer(first), self.bench.answer(first + 1)];
        Drawn { a: pair(0), b: if self.other.is_some() { pair(2) } else { [None, None] } }
    }

    /// Whether every rig asked for is there.
    #[must_use]
    pub fn settled(&self) -> bool {
        let (done, all) = self.bench.progress();
        all > 0 && done == all
    }

    /// What came of the gear shown: at slack tide, then at running tide.
    #[must_use]
    pub fn answers(&self) -> [Option<&Answer>; 2] {
        [self.bench.newest(0), self.bench.newest(1)]
    }
}

/// Draws the assembly panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(id) = shown(desk) else {
        return super::nothing(
            ui,
            "No assembly here. Take one from a gear type with the New menu, or place one in the scenario.",
        );
    };
    ask(desk, &id);
    toolbar(ui, desk, &id);
    ui.separator();
    if desk.assembly.selecting {
        if let Some(taken) = selector::show(ui, desk) {
            (desk.assembly.shown, desk.assembly.selecting) = (Some(taken), false);
        }
        return;
    }
    let left = (ui.available_width() * 0.3).clamp(230.0, 340.0);
    let whole = ui.available_rect_before_wrap();
    let (at_left, rest) = whole.split_left_right_at_x(whole.left() + left);
    super::within(ui, at_left, |ui| {
        ScrollArea::vertical().id_salt("assembly-form").auto_shrink(false).show(ui, |ui| {
            ui.set_width(left - 16.0);
            make(ui, desk, &id);
        });
    });
    let rest = rest.with_min_x(rest.left() + 8.0);
    let foot =
        (if desk.assembly.sweep { 220.0 } else { table::height(desk) }).min(rest.height() * 0.5);
    let (above, below) = rest.split_top_bottom_at_y(rest.bottom() - foot);
    super::within(ui, above.with_max_y(above.bottom() - 6.0), |ui| side::show(ui, desk));
    super::within(ui, below, |ui| {
        ScrollArea::both()
            .id_salt("assembly-table")
            .auto_shrink(false)
            .show(ui, |ui| foot_of(ui, desk, &id))
    });
}

fn foot_of(ui: &mut Ui, desk: &mut Desk, id: &str) {
    if desk.assembly.sweep {
        sweep::show(ui, desk, id);
    } else {
        table::show(ui, desk);
    }
}

/// Id of the assembly shown: the one chosen, or the scenario's.
fn shown(desk: &Desk) -> Option<String> {
    let there = |id: &String| desk.documents.text(&path(id)).is_some();
    let chosen = desk.assembly.shown.clone().filter(there);
    let of_scenario = || desk.documents.field(Documents::SCENARIO, "gear.0.assembly").filter(there);
    let first = || {
        desk.documents
            .files("assemblies")
            .next()
            .map(|path| path["assemblies/".len()..].trim_end_matches(".toml").to_owned())
    };
    chosen.or_else(of_scenario).or_else(first)
}

/// Path of an assembly's file.
fn path(id: &str) -> String {
    format!("assemblies/{id}.toml")
}

/// Asks for statics where gear or sea have changed since.
fn ask(desk: &mut Desk, id: &str) {
    let at = |assembly: &str, current_m_s: Option<f64>| Trial {
        assembly: assembly.to_owned(),
        sea: TrialSea { depth: None, current_m_s },
    };
    let running = desk.assembly.running_m_s;
    let mut trials = vec![at(id, Some(0.0)), at(id, running)];
    if let Some(other) = &desk.assembly.other {
        trials.extend([at(other, Some(0.0)), at(other, running)]);
    }
    desk.assembly.bench.poll();
    let wanted = (desk.documents.version(), trials);
    if desk.assembly.asked.as_ref() != Some(&wanted) {
        let scenario = desk.documents.text(Documents::SCENARIO).unwrap_or_default().to_owned();
        let (library, (host, waker)) = (desk.documents.library().clone(), desk.helpers());
        desk.assembly.bench.ask(&scenario, &library, wanted.1.clone(), &host, &waker);
        desk.assembly.asked = Some(wanted);
    }
}

fn toolbar(ui: &mut Ui, desk: &mut Desk, id: &str) {
    ui.horizontal_wrapped(|ui| {
        let choices = assemblies(desk);
        ui.label(RichText::new("A").strong().color(side::A.color(ui)));
        if let Some(Some(taken)) = pick(ui, "gear-a", &choices, Some(id), None) {
            desk.assembly.shown = Some(taken);
        }
        ui.label(RichText::new("B").strong().color(side::B.color(ui)));
        let other = desk.assembly.other.clone();
        if let Some(taken) = pick(ui, "gear-b", &choices, other.as_deref(), Some("compare with …"))
        {
            desk.assembly.other = taken;
        }
        ui.toggle_value(&mut desk.assembly.selecting, "Pictures").on_hover_text(
            "Choose A by its picture: every assembly at rest in this scenario's sea",
        );
        ui.menu_button("New ⏷", |ui| new(ui, desk));
        if ui.button("Duplicate").on_hover_text("Copy A to a file of its own").clicked() {
            match desk.documents.duplicate(&path(id)) {
                Ok(fresh) => {
                    desk.assembly.shown =
                        Some(fresh["assemblies/".len()..].trim_end_matches(".toml").to_owned())
                }
                Err(error) => desk.notice = Some((error, true)),
            }
        }
        let placed = desk.documents.field(Documents::SCENARIO, "gear.0.assembly");
        if placed.is_some()
            && placed.as_deref() != Some(id)
            && primary(ui, true, "Use in scenario").clicked()
        {
            desk.set(Documents::SCENARIO, "gear.0.assembly", id);
        }
        ui.menu_button("Model ⏷", |ui| {
            for (text, ending) in [("Save as STL …", "stl"), ("Save as glTF …", "glb")] {
                if ui
                    .button(text)
                    .on_hover_text("A at rest in running tide, in metres, for CAD and pictures")
                    .clicked()
                {
                    desk.orders.push(Order::AskExportModel(ending));
                    ui.close();
                }
            }
        });
        ui.separator();
        ui.toggle_value(&mut desk.assembly.sweep, "Depths and tides")
            .on_hover_text("Tension and float height by depth and current");
    });
    tide(ui, desk);
}

/// The slider of the running tide.
fn tide(ui: &mut Ui, desk: &mut Desk) {
    let units = desk.preferences.units;
    let of_scenario_m_s = desk.assembly.answers()[1]
        .and_then(|answer| answer.as_ref().ok())
        .map(|rest| surface_m_s(rest));
    ui.horizontal(|ui| {
        ui.label(RichText::new("Running tide").color(Theme::palette_of(ui).faint));
        let mut speed = units.of_m_s(desk.assembly.running_m_s.or(of_scenario_m_s).unwrap_or(0.25));
        ui.spacing_mut().slider_width = 180.0;
        let slider = Slider::new(&mut speed, 0.0..=units.of_m_s(FASTEST_M_S))
            .clamping(SliderClamping::Never)
            .min_decimals(2)
            .max_decimals(4)
            .suffix(format!(" {}", units.speed_symbol()));
        if ui
            .add(slider)
            .on_hover_text("Surface speed of the current; slack tide is drawn beside it")
            .changed()
        {
            desk.assembly.running_m_s = Some(units.to_m_s(speed));
        }
        if desk.assembly.running_m_s.is_some() && ui.button("As scenario").clicked() {
            desk.assembly.running_m_s = None;
        }
        if !desk.assembly.settled() {
            ui.spinner();
        }
    });
}

/// Surface speed of the current of a model at the start [m/s].
fn surface_m_s(rest: &endline_session::rest::Rest) -> f64 {
    rest.model.spec.water.current.at(1.0, 0.0).length()
}

/// A number from a slider as a file has it: as typed, to four decimals, without zeros at its end.
fn written(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Every assembly: id and name.
fn assemblies(desk: &Desk) -> Vec<(String, String)> {
    let id = |path: &str| path["assemblies/".len()..].trim_end_matches(".toml").to_owned();
    let named =
        |path: &str| (id(path), desk.documents.field(path, "name").unwrap_or_else(|| id(path)));
    desk.documents.files("assemblies").map(named).collect()
}

/// A choice among assemblies; the outer answer says whether something was taken, the inner one what.
fn pick(
    ui: &mut Ui,
    salt: &str,
    choices: &[(String, String)],
    chosen: Option<&str>,
    none: Option<&str>,
) -> Option<Option<String>> {
    let name = |id: &str| {
        choices
            .iter()
            .find(|(known, _)| known == id)
            .map_or(id.to_owned(), |(_, name)| name.clone())
    };
    let shown = chosen.map_or(none.unwrap_or_default().to_owned(), name);
    let mut taken = None;
    egui::ComboBox::from_id_salt(salt).width(150.0).truncate().selected_text(shown).show_ui(
        ui,
        |ui| {
            if none.is_some() && ui.selectable_label(chosen.is_none(), "nothing").clicked() {
                taken = Some(None);
            }
            for (id, name) in choices {
                if ui.selectable_label(chosen == Some(id), name).on_hover_text(id).clicked() {
                    taken = Some(Some(id.clone()));
                }
            }
        },
    );
    taken
}

/// Gear types as starting points.
fn new(ui: &mut Ui, desk: &mut Desk) {
    for gear in desk.gear_types() {
        let descriptor = gear.descriptor();
        if ui.button(descriptor.name.as_ref()).on_hover_text(descriptor.id.as_ref()).clicked() {
            let stem = descriptor.id.rsplit('.').next().unwrap_or("gear").to_owned();
            let fresh = desk.documents.fresh_path("assemblies", &format!("my-{stem}"));
            let text = format!(
                "format = 1\nkind = \"assembly\"\nname = \"My {}\"\nnotes = \"\"\n\ngear_type = \"{}\"\n\n[attributes]\n",
                descriptor.name.to_lowercase(),
                descriptor.id
            );
            desk.documents.put_all(vec![(fresh.clone(), text)]);
            desk.assembly.shown =
                Some(fresh["assemblies/".len()..].trim_end_matches(".toml").to_owned());
            ui.close();
        }
    }
}

/// What the gear is made of: a gear type's attributes, or its parts.
fn make(ui: &mut Ui, desk: &mut Desk, id: &str) {
    let file = path(id);
    if let Some(name) = super::super::fields::edit(
        ui,
        &desk.documents,
        &file,
        "name",
        ui.available_width() - 8.0,
        said("Name shown to the user"),
    ) {
        desk.set(&file, "name", &name);
    }
    match desk.documents.field(&file, "gear_type") {
        Some(gear_type) => form::show(ui, desk, &file, id, &gear_type),
        None => parts::show(ui, desk, &file),
    }
    let problems: Vec<_> =
        desk.documents.problems().iter().filter(|problem| problem.file == file).cloned().collect();
    for problem in &problems {
        super::problems::entry(ui, problem);
    }
}

fn said(help: &str) -> super::super::fields::Said<'_> {
    super::super::fields::Said { hint: "", help }
}

/// A choice of a library item for a field of a file; with `none` it may be empty.
fn item(ui: &mut Ui, desk: &mut Desk, file: &str, field: &str, kind: Kind, none: bool) {
    let library = desk.documents.library();
    let mut choices: Vec<(String, String)> =
        library.entries(kind).iter().map(|entry| (entry.id.clone(), entry.name.clone())).collect();
    if none {
        choices.insert(0, (String::new(), "none".to_owned()));
    }
    let width = ui.available_width() - 8.0;
    if let Some(taken) =
        super::super::fields::choose(ui, &desk.documents, file, field, &choices, width)
    {
        desk.set(file, field, &taken);
    }
}
