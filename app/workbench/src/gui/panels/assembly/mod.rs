//! Gear of an assembly or of the scenario: parts or attributes at the left; its statics at slack and running tide, drawn to scale,
//! beside it; tensions and float heights below.

mod form;
mod inserts;
mod parts;
mod selector;
mod side;
mod strength;
mod sweep;
mod table;
mod toolbar;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{ScrollArea, Ui};
use endline_gear::{Entry, Kind, Library};
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;
use endline_session::export;
use endline_session::scene::{Scene, Show};
use endline_session::statics::worker::Answer;
use endline_session::statics::{RigAtRest, StaticsWorker, Trial, TrialGear, TrialSea};
use endline_session::units::Units;

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::{fields, widgets};

/// The panel of gear and its statics.
#[derive(Default)]
pub struct AssemblyPanel {
    /// Selected assembly, and the scenario that was open then; for another scenario its own gear is shown.
    chosen: Option<(PathBuf, String)>,
    /// Assembly it is compared with.
    pub other: Option<String>,
    /// Surface speed at running tide [m/s]; `None` for that of the scenario.
    pub running_m_s: Option<f64>,
    /// Whether the table of depths and currents is shown.
    pub sweep: bool,
    statics: StaticsWorker,
    asked: Option<(u64, Vec<Trial>)>,
    /// Whether the gear selector is shown.
    pub selecting: bool,
    pictured: StaticsWorker,
    pictured_for: Option<u64>,
    swept: StaticsWorker,
    swept_for: Option<(u64, TrialGear)>,
}

/// The four results drawn: A and B, each at slack and running tide.
struct Drawn<'a> {
    a: [Rig<'a>; 2],
    b: [Rig<'a>; 2],
}

/// Statics of gear at one tide.
#[derive(Clone, Copy, Default)]
struct Rig<'a> {
    /// Last converged result, kept while an edit has errors.
    rest: Option<&'a RigAtRest>,
    /// Reason why there is no new result.
    wrong: Option<&'a str>,
}

impl AssemblyPanel {
    fn drawn(&self) -> Drawn<'_> {
        let rig = |index: usize| {
            let wrong = self.statics.newest(index).and_then(|answer| answer.as_ref().err());
            Rig {
                rest: self.statics.rest(index).map(Arc::as_ref),
                wrong: wrong.map(String::as_str),
            }
        };
        let pair = |first: usize| [rig(first), rig(first + 1)];
        Drawn { a: pair(0), b: if self.other.is_some() { pair(2) } else { Default::default() } }
    }

    /// Whether all requested statics are finished.
    pub fn settled(&self) -> bool {
        let (done, all) = self.statics.progress();
        all > 0 && done == all
    }

    /// Statics of the gear shown, at slack and running tide.
    pub fn answers(&self) -> [Option<&Answer>; 2] {
        [self.statics.newest(0), self.statics.newest(1)]
    }
}

impl Panel for AssemblyPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(gear) = self.shown(shared) else {
            return widgets::nothing(
                ui,
                "No assembly. Create one from a gear type in the menu New, or place one in the scenario.",
            );
        };
        self.ask(shared, &gear);
        self.toolbar(ui, shared, &gear);
        ui.separator();
        if self.selecting {
            if let Some(taken) = selector::show(ui, self, shared) {
                self.choose(shared, taken);
            }
            return;
        }
        let left = (ui.available_width() * 0.3).clamp(230.0, 340.0);
        let whole = ui.available_rect_before_wrap();
        let (at_left, rest) = whole.split_left_right_at_x(whole.left() + left);
        widgets::within(ui, at_left, |ui| {
            ScrollArea::vertical().id_salt("assembly-form").auto_shrink(false).show(ui, |ui| {
                ui.set_width(left - 16.0);
                self.make(ui, shared, &gear);
            });
        });
        let rest = rest.with_min_x(rest.left() + 8.0);
        let foot = (if self.sweep { 220.0 } else { table::height(self) }).min(rest.height() * 0.5);
        let (above, below) = rest.split_top_bottom_at_y(rest.bottom() - foot);
        widgets::within(ui, above.with_max_y(above.bottom() - 6.0), |ui| {
            side::show(ui, self, shared)
        });
        widgets::within(ui, below, |ui| {
            ScrollArea::both()
                .id_salt("assembly-table")
                .auto_shrink(false)
                .show(ui, |ui| self.foot(ui, shared, &gear))
        });
    }
}

impl AssemblyPanel {
    /// Shows an assembly until another scenario is opened.
    pub fn choose(&mut self, shared: &Shared, id: String) {
        let scenario = shared.workbench.project().documents.scenario_path().to_owned();
        (self.chosen, self.selecting) = (Some((scenario, id)), false);
    }

    /// Whether an assembly is shown.
    pub fn shows(&self, shared: &Shared, id: &str) -> bool {
        self.shown(shared).is_some_and(|gear| gear == TrialGear::Assembly(id.to_owned()))
    }

    /// Writes the gear shown, at running tide, as a 3-D model in the format of the file's extension.
    pub fn export_model(&self, shared: &mut Shared, path: &Path) {
        let rest = self.answers()[1].and_then(|answer| answer.as_ref().ok());
        let Some(rest) = rest else {
            shared.fault("the statics of the panel Assembly have not converged yet");
            return;
        };
        let scene = Scene::of(&rest.model, &rest.frame, &GEAR_ALONE);
        shared.notice_saved(path, export::model(path, &scene));
    }

    /// Draws the table below the drawings: tensions, or depths and currents.
    fn foot(&mut self, ui: &mut Ui, shared: &Shared, gear: &TrialGear) {
        if self.sweep {
            sweep::show(ui, self, shared, gear);
        } else {
            table::show(ui, self, shared.workbench.preferences().units);
        }
    }

    /// The gear shown: the selected assembly, or the gear of the scenario, or the first assembly.
    pub fn shown(&self, shared: &Shared) -> Option<TrialGear> {
        let documents = &shared.workbench.project().documents;
        let there = |id: &String| documents.text(&path_of(id)).is_some();
        let open = documents.scenario_path();
        let chosen = self.chosen.as_ref().filter(|(scenario, _)| scenario.as_path() == open);
        let chosen = chosen.map(|(_, id)| id.clone()).filter(there);
        let placed = || documents.placed_assemblies().next().filter(there);
        if let Some(id) = chosen.or_else(placed) {
            return Some(TrialGear::Assembly(id));
        }
        if has_own(shared) {
            return Some(TrialGear::Own);
        }
        let first = documents.files("assemblies").next();
        first.map(|path| TrialGear::Assembly(id_of(path).to_owned()))
    }

    /// Requests statics if gear or sea have changed.
    fn ask(&mut self, shared: &Shared, gear: &TrialGear) {
        let at = |gear: &TrialGear, current_m_s: Option<f64>| Trial {
            gear: gear.clone(),
            sea: TrialSea { depth: None, current_m_s },
        };
        let running = self.running_m_s;
        let mut trials = vec![at(gear, Some(0.0)), at(gear, running)];
        if let Some(other) = self.other.clone().map(TrialGear::Assembly) {
            trials.extend([at(&other, Some(0.0)), at(&other, running)]);
        }
        self.statics.poll();
        let wanted = (shared.workbench.project().documents.version(), trials);
        if self.asked.as_ref() != Some(&wanted) {
            let scenario = shared
                .workbench
                .project()
                .documents
                .text(Documents::SCENARIO)
                .unwrap_or_default()
                .to_owned();
            let (library, (host, waker)) = (
                shared.workbench.project().documents.library().clone(),
                shared.workbench.helpers(),
            );
            self.statics.ask(&scenario, &library, wanted.1.clone(), &host, &waker);
            self.asked = Some(wanted);
        }
    }

    /// Draws the form of the gear: attributes of a gear type, or parts.
    fn make(&self, ui: &mut Ui, shared: &mut Shared, gear: &TrialGear) {
        let file = path(gear);
        if let Some(name) = fields::edit(
            ui,
            &shared.workbench.project().documents,
            &file,
            "name",
            ui.available_width() - 8.0,
            said("Name shown to the user"),
        ) {
            shared.set(&file, "name", &name);
        }
        match shared.workbench.project().documents.field(&file, "gear_type") {
            Some(gear_type) => form::show(ui, self, shared, gear, &gear_type),
            None => parts::show(ui, shared, gear),
        }
        let problems: Vec<_> = shared
            .workbench
            .project()
            .documents
            .problems()
            .iter()
            .filter(|problem| problem.file == file)
            .cloned()
            .collect();
        for problem in &problems {
            widgets::problem(ui, problem);
        }
    }
}

/// Path of the file of an assembly.
fn path_of(id: &str) -> String {
    format!("assemblies/{id}.toml")
}

/// Path of the file that contains the gear.
fn path(gear: &TrialGear) -> String {
    match gear {
        TrialGear::Assembly(id) => path_of(id),
        TrialGear::Own => Documents::SCENARIO.to_owned(),
    }
}

/// Whether the open scenario has its own parts.
fn has_own(shared: &Shared) -> bool {
    let has = |field| shared.workbench.project().documents.has(Documents::SCENARIO, field);
    has("line.0") && !has("gear.0") && !has("field.0")
}

/// Surface speed of the current of a model at the start [m/s].
fn surface_m_s(rest: &RigAtRest) -> f64 {
    rest.model.spec.water.current.at(1.0, 0.0).length()
}

/// A number of a slider for a file: four decimals at most, without trailing zeros.
fn written(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Parts of a scene for a model: only the gear.
const GEAR_ALONE: Show = Show {
    surface: false,
    seabed: false,
    current: false,
    contacts: false,
    forces: false,
    whale: false,
    names: false,
    film: false,
    scale_n: None,
};

/// Id and name of all assemblies.
fn assemblies(shared: &Shared) -> Vec<(String, String)> {
    let id = |path: &str| id_of(path).to_owned();
    let named = |path: &str| {
        (
            id(path),
            shared.workbench.project().documents.field(path, "name").unwrap_or_else(|| id(path)),
        )
    };
    shared.workbench.project().documents.files("assemblies").map(named).collect()
}

fn said(help: &str) -> fields::Said<'_> {
    fields::Said { hint: "", help }
}

/// Meaning of an empty field that takes a library item.
enum WhenEmpty<'a> {
    /// The field must not be empty.
    Missing,
    /// No item.
    Nothing,
    /// The item with this id.
    Usual(&'a str),
}

/// Draws the choice of a library item for a field.
fn item(
    ui: &mut Ui,
    shared: &mut Shared,
    file: &str,
    field: &str,
    kind: Kind,
    empty: &WhenEmpty<'_>,
) {
    let documents = &shared.workbench.project().documents;
    let (library, units) = (documents.library(), shared.workbench.preferences().units);
    let mut entries: Vec<(f64, &Entry)> = library
        .entries(kind)
        .into_iter()
        .map(|entry| (rank(library, kind, &entry.id), entry))
        .collect();
    entries.sort_by(|(one, first), (other, second)| {
        one.total_cmp(other).then_with(|| first.name.cmp(&second.name))
    });
    let mut choices: Vec<(String, String)> =
        entries.iter().map(|(_, entry)| (entry.id.clone(), entry.name.clone())).collect();
    match empty {
        WhenEmpty::Missing => {}
        WhenEmpty::Nothing => choices.insert(0, (String::new(), "none".to_owned())),
        WhenEmpty::Usual(id) => {
            with_usual(&mut choices, id, documents.field(file, field).as_deref());
        }
    }
    let width = ui.available_width() - 8.0;
    let describe = |id: &str| values_of(library, kind, id, units);
    let field_of = fields::Field { documents, path: file, field };
    if let Some(taken) = fields::choose_described(ui, field_of, &choices, describe, width) {
        shared.set(file, field, &taken);
    }
}

/// Order of an item in a list: ropes and weak links by strength, buoys by volume; 0 for others, which are in order of their names.
fn rank(library: &Library, kind: Kind, id: &str) -> f64 {
    let found = match kind {
        Kind::Rope => {
            library.ropes.iter().find(|rope| rope.entry.id == id).map(|rope| rope.strength_n)
        }
        Kind::WeakLink => {
            library.weak_links.iter().find(|link| link.entry.id == id).map(|link| link.rating_n)
        }
        Kind::Buoy => {
            library.buoys.iter().find(|buoy| buoy.entry.id == id).map(|buoy| buoy.volume_m3)
        }
        _ => None,
    };
    found.unwrap_or_default()
}

/// Values that tell an item from others of its kind; empty for a kind without such values.
fn values_of(library: &Library, kind: Kind, id: &str, units: Units) -> String {
    /// Pounds for 1,000 ft in one kilogram for a metre.
    const LB_PER_1000_FT: f64 = 671.969;
    let force = |force_n: f64| units.force().text(force_n);
    let found =
        match kind {
            Kind::Rope => library.ropes.iter().find(|rope| rope.entry.id == id).map(|rope| {
                format!(
                    "{}, {:.0} g/m ({:.0} lb for 1,000 ft), {} new",
                    units.diameter(rope.diameter_m),
                    1000.0 * rope.mass_kg_m,
                    LB_PER_1000_FT * rope.mass_kg_m,
                    force(rope.strength_n)
                )
            }),
            Kind::WeakLink => library
                .weak_links
                .iter()
                .find(|link| link.entry.id == id)
                .map(|link| format!("parts at {}", force(link.rating_n))),
            Kind::Buoy => library.buoys.iter().find(|buoy| buoy.entry.id == id).map(|buoy| {
                format!("{:.1} litres, {:.1} kg", 1000.0 * buoy.volume_m3, buoy.mass_kg)
            }),
            _ => None,
        };
    found.unwrap_or_default()
}

/// Puts the usual choice first, which leaves the field empty. Its own entry is omitted, unless the field names it.
fn with_usual(choices: &mut Vec<(String, String)>, usual: &str, stored: Option<&str>) {
    let known = choices.iter().position(|(id, _)| id == usual);
    let name = known.map_or(usual, |place| choices[place].1.as_str());
    let first = (String::new(), format!("{name} (usual)"));
    if let Some(place) = known.filter(|_| stored != Some(usual)) {
        choices.remove(place);
    }
    choices.insert(0, first);
}

#[cfg(test)]
mod tests {
    use super::with_usual;

    #[test]
    fn the_usual_item_is_named_first_and_is_listed_once_unless_the_file_names_it() {
        let two = || [("a", "Link A"), ("b", "Link B")].map(|(id, name)| (id.into(), name.into()));
        let listed = |usual: &str, stored: Option<&str>| -> Vec<String> {
            let mut choices = Vec::from(two());
            with_usual(&mut choices, usual, stored);
            assert_eq!(choices[0].0, "", "it leaves the field empty");
            choices.into_iter().map(|(_, name)| name).collect()
        };
        assert_eq!(listed("b", None), ["Link B (usual)", "Link A"]);
        assert_eq!(listed("b", Some("b")), ["Link B (usual)", "Link A", "Link B"]);
        assert_eq!(listed("c", None), ["c (usual)", "Link A", "Link B"]);
    }
}
