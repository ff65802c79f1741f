//! Which Endline this is, under which licence, how to cite it, and its documents.

use std::path::PathBuf;

use egui::{Grid, RichText, Ui};
use endline_session::VERSION;

use crate::gui::command::action::WindowAction;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// Where Endline is kept.
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// The documents by what they are about.
const DOCUMENTS: [(&str, &str); 15] = [
    ("The workbench, panel by panel", "workbench.md"),
    ("The gear library's files", "gear-format.md"),
    ("Gear types", "gear-types.md"),
    ("Studies and their statistics", "studies.md"),
    ("Rules and compliance", "rules.md"),
    ("Hauling", "hauling.md"),
    ("The sheet for a hearing", "sheet.md"),
    ("Entanglement: what is counted", "entanglement.md"),
    ("Search for a real case", "search.md"),
    ("Whales and their motions", "motions.md"),
    ("Physics and its equations", "physics.md"),
    ("Validation against measurements", "validation.md"),
    ("Recordings and films", "recording.md"),
    ("Writing a plugin", "plugin-tutorial.md"),
    ("Python", "python.md"),
];

/// Draws it.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    widgets::caption(ui, "About");
    let rows = [
        ("Version", VERSION.to_owned()),
        ("Licence", format!("{}, whichever you prefer", env!("CARGO_PKG_LICENSE"))),
        ("Library", shared.workbench.project.documents.root().display().to_string()),
    ];
    widgets::numbers(ui, "about", &rows);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(citation()).color(faint));
        if ui.small_button("Copy").on_hover_text("Copy how to cite it").clicked() {
            ui.ctx().copy_text(citation());
        }
    });
    widgets::caption(ui, "Documents");
    let folder = folder(shared);
    Grid::new("documents").num_columns(2).spacing([22.0, 4.0]).show(ui, |ui| {
        for pair in DOCUMENTS.chunks(2) {
            for (title, file) in pair {
                match folder.as_ref().map(|folder| folder.join(file)) {
                    Some(path) => {
                        if ui.link(*title).on_hover_text(path.display().to_string()).clicked() {
                            shared.give(WindowAction::OpenFolder(path));
                        }
                    }
                    None => {
                        ui.hyperlink_to(*title, format!("{REPOSITORY}/blob/main/docs/{file}"));
                    }
                }
            }
            ui.end_row();
        }
    });
}

/// How a paper names this version.
fn citation() -> String {
    format!(
        "Endline {VERSION}: a workbench for fishing gear that entangled whales can escape from. {REPOSITORY}"
    )
}

/// The folder of documents beside the gear library, as a source folder has it.
fn folder(shared: &Shared) -> Option<PathBuf> {
    let folder = shared.workbench.project.documents.root().parent()?.join("docs");
    folder.join(DOCUMENTS[0].1).is_file().then_some(folder)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn every_document_that_is_listed_is_there() {
        let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
        for (title, file) in DOCUMENTS {
            assert!(docs.join(file).is_file(), "{title}: {file}");
        }
        assert!(citation().contains(VERSION));
    }
}
