//! Commands on the window as a whole.

use endline_session::command::{Choice, Make, Shortcut, When};
use endline_session::units::Units;

use super::WindowInfo;
use super::action::WindowAction;
use super::view::shown;
use crate::documents;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Sizes offered, 1 for usual.
const SIZES: [f32; 4] = [1.0, 1.25, 1.5, 2.0];

/// The actions on the window, declared.
pub static COMMANDS: &[WindowInfo] = &[
    WindowInfo::new(
        "window.palette",
        "Commands",
        "Lists every command by its name.",
        Make::Plain(|| WindowAction::Palette.into()),
    )
    .with_keys(&[Shortcut::new("Ctrl+P", When::Always)]),
    WindowInfo::new(
        "window.dark",
        "Dark",
        "Light text on dark ground.",
        Make::Plain(|| WindowAction::Theme(Theme::Dark).into()),
    ),
    WindowInfo::new(
        "window.light",
        "Light",
        "Dark text on light ground.",
        Make::Plain(|| WindowAction::Theme(Theme::Light).into()),
    ),
    WindowInfo::new(
        "window.units",
        "Units",
        "Chooses the units on screen; files keep theirs.",
        Make::Choices(|_| {
            let choice =
                |units: Units| Choice::new(units.name(), WindowAction::Units(units).into());
            Units::ALL.into_iter().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "window.size",
        "Size",
        "Makes everything on screen larger or smaller.",
        Make::Choices(|_| {
            let choice = |size: f32| {
                Choice::new(format!("{:.0} %", 100.0 * size), WindowAction::Size(size).into())
            };
            SIZES.into_iter().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "window.copy-run",
        "Copy as command line",
        "Copies the command that gives this run, for a terminal or a script.",
        Make::Plain(|| WindowAction::CopyCommandLine.into()),
    )
    .with_keys(&[Shortcut::new("Ctrl+Shift+C", When::Always)])
    .only_if(shown),
    WindowInfo::new(
        "window.copy-study",
        "Copy the study as command line",
        "Copies the commands that run the open study and report it.",
        Make::Plain(|| WindowAction::CopyStudyLine.into()),
    )
    .only_if(study_opened),
    WindowInfo::new(
        "window.open-report",
        "Open the study's report",
        "Opens the report of the results shown with the program that is usual for pages.",
        Make::Plain(|| WindowAction::OpenReport.into()),
    )
    .only_if(|shared| match shared.workbench.report_shown() {
        Some(_) => Ok(()),
        None => Err("the report is written when a study has run to its end".to_owned()),
    }),
    WindowInfo::new(
        "window.copy-search",
        "Copy the search as command line",
        "Copies the command that searches for the open observation.",
        Make::Plain(|| WindowAction::CopySearchLine.into()),
    )
    .only_if(observation_opened),
    WindowInfo::new(
        "window.read",
        "Read",
        "Opens a document with the program that is usual for pages; it is inside the program.",
        Make::Choices(|_| {
            let choice = |document: documents::Document| {
                Choice::new(document.title, WindowAction::Read(document).into())
            };
            documents::all().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "window.open-folder",
        "Open a folder",
        "Shows a folder in the system's file manager, or opens a file with its usual program.",
        Make::Values("folder"),
    ),
    WindowInfo::new(
        "window.present",
        "Present",
        "Shows the 3-D view alone on the whole screen, in large letters, for a talk; F11 or Esc goes back.",
        Make::Plain(|| WindowAction::Present.into()),
    )
    .with_keys(&[Shortcut::new("F11", When::Always)]),
    WindowInfo::new(
        "window.quit",
        "Quit",
        "Closes the window; unsaved edits are asked about first.",
        Make::Plain(|| WindowAction::Quit.into()),
    ),
];

fn observation_opened(shared: &Shared) -> Result<(), String> {
    let opened = shared.workbench.project().documents.observation_path();
    opened.map(|_| ()).ok_or_else(|| "open an observation first".to_owned())
}

fn study_opened(shared: &Shared) -> Result<(), String> {
    let opened = shared.workbench.project().documents.study_path();
    opened.map(|_| ()).ok_or_else(|| "open a study first".to_owned())
}
