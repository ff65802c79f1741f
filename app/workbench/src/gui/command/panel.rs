//! Commands on what panels show and have chosen.

use std::path::PathBuf;

use endline_session::command::{Choice, FileQuestion, Make, Shortcut, When};

use super::WindowInfo;
use super::action::{PanelAction, WindowCommand};
use super::view::shown;
use crate::gui::files::KINDS;
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::shared::Shared;

/// The actions on panels, declared.
pub static COMMANDS: &[WindowInfo] = &[
    WindowInfo::new(
        "panel.help",
        "Show Keys and help",
        "Lists keys, mouse and game controller; tells version, licence and how to cite; opens the documents.",
        Make::Plain(|| PanelAction::Show(PanelId::HELP).into()),
    )
    .with_keys(&[Shortcut::new("F1", When::Always)]),
    WindowInfo::new(
        "panel.show",
        "Show",
        "Brings a panel to the front.",
        Make::Choices(|_| {
            let others = PanelId::ALL.into_iter().filter(|panel| *panel != PanelId::HELP);
            others
                .map(|panel| Choice::new(panel.title(), PanelAction::Show(panel).into()))
                .collect()
        }),
    ),
    WindowInfo::new(
        "panel.close",
        "Close",
        "Takes a panel away.",
        Make::Choices(|shared| {
            let open = shared.selection.open.iter();
            open.map(|panel| Choice::new(panel.title(), PanelAction::Close(*panel).into()))
                .collect()
        }),
    ),
    WindowInfo::new(
        "panel.layout",
        "Layout",
        "Puts the panels in their places for a kind of work.",
        Make::Choices(|_| {
            let choice =
                |layout: Layout| Choice::new(layout.name(), PanelAction::Arrange(layout).into());
            Layout::ALL.into_iter().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "panel.table",
        "Table of",
        "Shows a table of the library.",
        Make::Choices(|_| {
            let choice = |(kind, title): (_, &str)| {
                Choice::new(title.to_lowercase(), PanelAction::Table(kind).into())
            };
            KINDS.into_iter().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "panel.entry",
        "Show an entry of the library",
        "Shows an entry in its table.",
        Make::Values("path"),
    ),
    WindowInfo::new(
        "panel.assembly",
        "Show an assembly",
        "Shows an assembly and settles it.",
        Make::Values("id"),
    ),
    WindowInfo::new(
        "panel.duplicate",
        "Duplicate the chosen entry",
        "Copies the row chosen in the library to a file of its own.",
        Make::Plain(|| PanelAction::Duplicate.into()),
    )
    .with_keys(&[Shortcut::new("Ctrl+D", When::Always)])
    .only_if(has_row),
    WindowInfo::new(
        "panel.remove",
        "Delete the chosen entry of the library",
        "Deletes the row chosen in the library; its file goes with the next save, and Undo brings it back.",
        Make::Plain(|| PanelAction::Remove.into()),
    )
    .only_if(has_row),
    WindowInfo::new(
        "panel.delete-entry",
        "Delete the chosen entry of the pilot program",
        "Takes the entry chosen on the timeline out of the pilot program.",
        Make::Plain(|| PanelAction::DeleteEntry.into()),
    )
    .only_if(|shared| match shared.selection.program_entry {
        Some(_) => Ok(()),
        None => Err("choose an entry of the pilot program first".to_owned()),
    }),
    WindowInfo::new(
        "panel.export-table",
        "Save the library's table as CSV",
        "Writes the table shown, with its search and order.",
        Make::File {
            question: |shared| {
                let name = format!("{}.csv", shared.selection.table.folder());
                FileQuestion::write("table", &["csv"], name)
            },
            command: |_, file| PanelAction::ExportTable(file).into(),
        },
    ),
    WindowInfo::new(
        "panel.import-table",
        "Take a CSV into the library",
        "Changes the entries of the table shown that a CSV names, and adds those that it does not know.",
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
];

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
    if shared.selection.gear_at_rest {
        return Ok(());
    }
    Err("the gear of the assembly panel is not at rest yet".to_owned())
}

fn has_row(shared: &Shared) -> Result<(), String> {
    match &shared.selection.entry {
        Some(_) => Ok(()),
        None => Err("choose a row of the library first".to_owned()),
    }
}
