//! Tool bar of the assembly: gear shown, gear to compare with, running tide, and actions.

use crate::gui::command::action::WindowAction;
use crate::gui::widgets::command;
use egui::{RichText, Slider, SliderClamping, Ui};
use endline_session::command::EditAction;
use endline_session::edit::Documents;
use endline_session::statics::TrialGear;

use super::{AssemblyPanel, assemblies, has_own, path_of, side, surface_m_s};
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};

/// Greatest current of the slider, 2 knots [m/s].
const FASTEST_M_S: f64 = 1.03;

impl AssemblyPanel {
    /// Draws the tool bar.
    pub(super) fn toolbar(&mut self, ui: &mut Ui, shared: &mut Shared, gear: &TrialGear) {
        ui.horizontal_wrapped(|ui| {
            self.choose_gear(ui, shared, gear);
            ui.menu_button("New ⏷", |ui| new_gear(ui, shared));
            if let TrialGear::Assembly(id) = gear {
                self.of_assembly(ui, shared, id);
            }
            ui.menu_button("Model ⏷", |ui| model_menu(ui, shared));
            ui.separator();
            ui.toggle_value(&mut self.sweep, "Depths and tides")
                .on_hover_text("Tension and float height by depth and current");
        });
        self.tide(ui, shared);
    }

    /// Draws the actions on an assembly.
    fn of_assembly(&mut self, ui: &mut Ui, shared: &mut Shared, id: &str) {
        if ui.button("Duplicate").on_hover_text("Copies A to a new file").clicked() {
            shared.give(EditAction::Duplicate(path_of(id)));
        }
        let placed =
            shared.workbench.project().documents.field(Documents::SCENARIO, "gear.0.assembly");
        let other = placed.is_some_and(|placed| placed != id);
        if other && primary(ui, true, "Use in scenario").clicked() {
            shared.set(Documents::SCENARIO, "gear.0.assembly", id);
        }
    }

    /// Draws the choice of the gear shown, A, and the gear to compare with, B.
    fn choose_gear(&mut self, ui: &mut Ui, shared: &Shared, gear: &TrialGear) {
        let choices = assemblies(shared);
        let own = has_own(shared).then_some("The scenario's own gear");
        let chosen = match gear {
            TrialGear::Assembly(id) => Some(id.as_str()),
            TrialGear::Own => None,
        };
        ui.label(RichText::new("A").strong().color(side::A.color(ui)));
        match pick(ui, "gear-a", &choices, chosen, own.map(|own| [own; 2])) {
            Some(Some(taken)) => self.choose(shared, taken),
            Some(None) => self.chosen = None,
            None => {}
        }
        ui.label(RichText::new("B").strong().color(side::B.color(ui)));
        let other = self.other.clone();
        let none = Some(["compare with …", "nothing"]);
        if let Some(taken) = pick(ui, "gear-b", &choices, other.as_deref(), none) {
            self.other = taken;
        }
        ui.toggle_value(&mut self.selecting, "Pictures").on_hover_text(
            "Select A by its picture: the statics of every assembly in this scenario's sea",
        );
    }

    /// Draws the slider of the running tide.
    fn tide(&mut self, ui: &mut Ui, shared: &Shared) {
        let units = shared.workbench.preferences().units;
        let of_scenario_m_s =
            self.answers()[1].and_then(|answer| answer.as_ref().ok()).map(|rest| surface_m_s(rest));
        ui.horizontal(|ui| {
            ui.label(RichText::new("Running tide").color(Theme::palette_of(ui).faint));
            let mut speed = units.of_m_s(self.running_m_s.or(of_scenario_m_s).unwrap_or(0.25));
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
                self.running_m_s = Some(units.to_m_s(speed));
            }
            if self.running_m_s.is_some() && ui.button("As scenario").clicked() {
                self.running_m_s = None;
            }
            if !self.settled() {
                ui.spinner();
            }
        });
    }
}

/// Draws the menu of gear types for a new assembly.
fn new_gear(ui: &mut Ui, shared: &mut Shared) {
    for gear in shared.workbench.gear_types() {
        let descriptor = gear.descriptor();
        if ui.button(descriptor.name.as_ref()).on_hover_text(descriptor.id.as_ref()).clicked() {
            shared.give(EditAction::NewAssembly(descriptor.id.to_string()));
            ui.close();
        }
    }
}

fn model_menu(ui: &mut Ui, shared: &mut Shared) {
    for (text, id) in [("Save as STL …", "panel.model-stl"), ("Save as glTF …", "panel.model-gltf")]
    {
        if command(ui, shared, text, WindowAction::Ask(id)).clicked() {
            ui.close();
        }
    }
}

/// Draws a choice among assemblies, or none. The outer result is `None` if nothing was selected, the inner one if none was.
fn pick(
    ui: &mut Ui,
    salt: &str,
    choices: &[(String, String)],
    chosen: Option<&str>,
    none: Option<[&str; 2]>,
) -> Option<Option<String>> {
    let name = |id: &str| {
        choices
            .iter()
            .find(|(known, _)| known == id)
            .map_or(id.to_owned(), |(_, name)| name.clone())
    };
    let shown = chosen.map_or_else(|| none.map_or("", |[shown, _]| shown).to_owned(), name);
    let mut taken = None;
    egui::ComboBox::from_id_salt(salt).width(150.0).truncate().selected_text(shown).show_ui(
        ui,
        |ui| {
            if let Some([_, listed]) = none
                && ui.selectable_label(chosen.is_none(), listed).clicked()
            {
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
