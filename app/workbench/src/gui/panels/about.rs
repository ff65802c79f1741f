//! Version, licence, citation and documents of Endline.

use egui::{RichText, Ui};
use endline_session::VERSION;

use crate::documents;
use crate::gui::command::action::WindowAction;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// Address of the repository.
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// Draws version, licence, citation and documents.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    widgets::caption(ui, "About");
    let rows = [
        ("Version", VERSION.to_owned()),
        ("Licence", format!("{}, at your choice", env!("CARGO_PKG_LICENSE"))),
        ("Library", shared.workbench.project().documents.root().display().to_string()),
    ];
    widgets::numbers(ui, "about", &rows);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(citation()).color(faint));
        if ui.small_button("Copy").on_hover_text("Copies the citation").clicked() {
            ui.ctx().copy_text(citation());
        }
    });
    for group in documents::groups() {
        widgets::caption(ui, group.title);
        ui.horizontal_wrapped(|ui| {
            for document in &group.documents {
                if ui.link(document.title).on_hover_text(document.contents).clicked() {
                    shared.give(WindowAction::Read(*document));
                }
                ui.add_space(14.0);
            }
        });
    }
}

/// Year of this version.
const YEAR: u16 = 2026;

/// Citation of this version in a paper; `CITATION.cff` has the same fields.
fn citation() -> String {
    format!(
        "The Endline authors ({YEAR}). Endline {VERSION}: a workbench for fishing gear that entangled whales can escape from. Computer program. {REPOSITORY}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_citation_names_version_and_place() {
        assert!(citation().contains(VERSION) && citation().ends_with(REPOSITORY));
        let file = include_str!("../../../../../CITATION.cff");
        for field in [format!("version: {}", env!("CARGO_PKG_VERSION")), REPOSITORY.to_owned()] {
            assert!(file.contains(&field), "CITATION.cff has no {field}");
        }
        assert!(REPOSITORY.starts_with("https://"), "{REPOSITORY}");
    }
}
