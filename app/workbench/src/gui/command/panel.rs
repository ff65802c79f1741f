//! Commands on what panels show and have chosen.

use std::path::PathBuf;

use endline_session::command::info::require;
use endline_session::command::{Choice, FileQuestion, Make, When};

use super::WindowInfo;
use super::action::{PanelAction, PanelVerb, WindowCommand};
use super::view::shown;
use crate::gui::files::KINDS;
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::shared::Shared;

/// The actions on panels, declared.
pub(super) fn commands() -> Vec<WindowInfo> {
    vec![
        WindowInfo::new(
            "panel.help",
            "Show Keys and help",
            "Lists keys, mouse and game controller; tells version, licence and how to cite; opens the documents.",
            Make::Plain(PanelAction::Show(PanelId::Help).into()),
        )
        .with_key("F1", When::Always),
        WindowInfo::of(PanelVerb::Show, Make::Choices(panels_but_help)),
        WindowInfo::of(
            PanelVerb::Close,
            Make::Choices(|shared| {
                let open = shared.selection.open.iter();
                open.map(|panel| Choice::new(panel.title(), PanelAction::Close(*panel).into()))
                    .collect()
            }),
        ),
        WindowInfo::of(
            PanelVerb::Arrange,
            Make::Choices(|_| {
                let choice =
                    |layout: Layout| Choice::new(layout.name(), PanelAction::Arrange(layout).into());
                Layout::ALL.iter().copied().map(choice).collect()
            }),
        ),
        WindowInfo::of(
            PanelVerb::Table,
            Make::Choices(|_| {
                let choice = |(kind, title): (_, &str)| {
                    Choice::new(title.to_lowercase(), PanelAction::Table(kind).into())
                };
                KINDS.into_iter().map(choice).collect()
            }),
        ),
        WindowInfo::values(PanelVerb::Entry, "path"),
        WindowInfo::values(PanelVerb::Assembly, "id"),
        WindowInfo::plain(PanelAction::Duplicate).with_key("Ctrl+D", When::Always).only_if(has_row),
        WindowInfo::plain(PanelAction::Remove).only_if(has_row),
        WindowInfo::plain(PanelAction::DeleteEntry).only_if(|shared| {
            let chosen = shared.selection.program_entry.is_some();
            require(chosen, "choose an entry of the pilot program first")
        }),
        WindowInfo::of(
            PanelVerb::ExportTable,
            Make::File {
                question: |shared| {
                    let name = format!("{}.csv", shared.selection.table.folder());
                    FileQuestion::write("table", &["csv"], name)
                },
                command: |_, file| PanelAction::ExportTable(file).into(),
            },
        ),
        WindowInfo::of(
            PanelVerb::ImportTable,
            Make::File {
                question: |_| FileQuestion::read("table", &["csv", "tsv", "txt"]),
                command: |_, file| PanelAction::ImportTable(file).into(),
            },
        ),
        WindowInfo::new(
            "panel.plots-svg",
            "Save the plots as SVG",
            "Writes the plots shown as curves.",
            Make::File { question: |shared| plots(shared, &["svg"]), command: export_plots },
        )
        .only_if(shown),
        WindowInfo::new(
            "panel.plots-png",
            "Save the plots as PNG",
            "Writes the plots shown as a picture.",
            Make::File { question: |shared| plots(shared, &["png"]), command: export_plots },
        )
        .only_if(shown),
        WindowInfo::new(
            "panel.plots-csv",
            "Save the plots as CSV",
            "Writes the numbers of the plots shown.",
            Make::File { question: |shared| plots(shared, &["csv"]), command: export_plots },
        )
        .only_if(shown),
        WindowInfo::new(
            "panel.model-stl",
            "Save the gear as STL",
            "Writes the gear of the assembly panel at running tide as triangles.",
            Make::File { question: |_| model("stl", &["stl"]), command: export_model },
        )
        .only_if(at_rest),
        WindowInfo::new(
            "panel.model-gltf",
            "Save the gear as glTF",
            "Writes the gear of the assembly panel at running tide with its colours.",
            Make::File { question: |_| model("glb", &["glb"]), command: export_model },
        )
        .only_if(at_rest),
    ]
}

fn panels_but_help(_: &Shared) -> Vec<Choice<WindowCommand>> {
    let others = PanelId::ALL.iter().copied().filter(|panel| *panel != PanelId::Help);
    others.map(|panel| Choice::new(panel.title(), PanelAction::Show(panel).into())).collect()
}

fn plots(shared: &Shared, extensions: &'static [&'static str]) -> FileQuestion {
    let extension = extensions.first().copied().unwrap_or_default();
    let name = format!("{}.{extension}", shared.workbench.scenario_stem());
    FileQuestion::write("plots", extensions, name)
}

fn export_plots(_: &Shared, file: PathBuf) -> WindowCommand {
    PanelAction::ExportPlots(file).into()
}

fn model(extension: &str, extensions: &'static [&'static str]) -> FileQuestion {
    FileQuestion::write("3-D model", extensions, format!("gear.{extension}"))
}

fn export_model(_: &Shared, file: PathBuf) -> WindowCommand {
    PanelAction::ExportModel(file).into()
}

fn at_rest(shared: &Shared) -> Result<(), String> {
    require(shared.selection.gear_at_rest, "the gear of the assembly panel is not at rest yet")
}

fn has_row(shared: &Shared) -> Result<(), String> {
    require(shared.selection.entry.is_some(), "choose a row of the library first")
}
