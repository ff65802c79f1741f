//! Says of a run whose whale goes as it is steered that no gear held it.

use egui::{Label, RichText, Ui};
use endline_session::command::{Command, EditAction};
use endline_session::edit::Documents;
use endline_session::live::LiveView;

use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Field by which a whale feels the gear, and its value.
const FEELS: [&str; 2] = ["whale.dynamics", "kinetic"];

/// Draws the warning where it holds, with the button that changes the scenario.
pub fn warning(ui: &mut Ui, shared: &mut Shared, view: &LiveView) {
    let whale = view.model.spec.whale.as_ref();
    if view.model.spec.lines.is_empty() || whale.is_none_or(|whale| whale.kinetic.is_some()) {
        return;
    }
    let text = "This whale does not feel the gear: it goes as it is steered, whatever pulls. \
                Peak tensions are those of a whale that nothing slows.";
    let colour = Theme::palette_of(ui).warning;
    ui.horizontal_wrapped(|ui| {
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
        let documents = &shared.workbench.project.documents;
        let of_scenario = !shared.workbench.shows_guest()
            && documents.field(Documents::SCENARIO, FEELS[0]).is_none();
        let help = "Sets dynamics = \"kinetic\" in the scenario; the next run uses it";
        if of_scenario && ui.small_button("Let it feel gear").on_hover_text(help).clicked() {
            shared.give(Command::from(EditAction::Set {
                path: Documents::SCENARIO.to_owned(),
                field: FEELS[0].to_owned(),
                value: FEELS[1].to_owned(),
            }));
        }
    });
}
