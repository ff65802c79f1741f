//! Commands on the window as a whole.

use endline_session::command::info::{observation_opened, ready, require, study_opened};
use endline_session::command::{Choice, Make, When};
use endline_session::units::Units;

use super::WindowInfo;
use super::action::{WindowAction, WindowVerb};
use crate::documents;
use crate::gui::theme::Theme;

/// Sizes offered, 1 for usual.
const SIZES: [f32; 4] = [1.0, 1.25, 1.5, 2.0];

/// The actions on the window, declared.
pub(super) fn commands() -> Vec<WindowInfo> {
    vec![
        WindowInfo::plain(WindowAction::Palette).with_key("Ctrl+P", When::Always),
        WindowInfo::new(
            "window.dark",
            "Dark",
            "Light text on dark ground.",
            Make::Plain(WindowAction::Theme(Theme::Dark).into()),
        ),
        WindowInfo::new(
            "window.light",
            "Light",
            "Dark text on light ground.",
            Make::Plain(WindowAction::Theme(Theme::Light).into()),
        ),
        WindowInfo::of(
            WindowVerb::Units,
            Make::Choices(|_| {
                let choice =
                    |units: Units| Choice::new(units.name(), WindowAction::Units(units).into());
                Units::ALL.iter().copied().map(choice).collect()
            }),
        ),
        WindowInfo::of(
            WindowVerb::Size,
            Make::Choices(|_| {
                let choice = |size: f32| {
                    Choice::new(format!("{:.0} %", 100.0 * size), WindowAction::Size(size).into())
                };
                SIZES.into_iter().map(choice).collect()
            }),
        ),
        WindowInfo::plain(WindowAction::CopyCommandLine)
            .with_key("Ctrl+Shift+C", When::Always)
            .only_if(|shared| ready(&shared.workbench)),
        WindowInfo::plain(WindowAction::CopyStudyLine)
            .only_if(|shared| study_opened(&shared.workbench)),
        WindowInfo::plain(WindowAction::OpenReport).only_if(|shared| {
            let written = shared.workbench.report_shown().is_some();
            require(written, "the report is written when a study has run to its end")
        }),
        WindowInfo::plain(WindowAction::CopySearchLine)
            .only_if(|shared| observation_opened(&shared.workbench)),
        WindowInfo::of(
            WindowVerb::Read,
            Make::Choices(|_| {
                let choice = |document: documents::Document| {
                    Choice::new(document.title, WindowAction::Read(document).into())
                };
                documents::all().map(choice).collect()
            }),
        ),
        WindowInfo::values(WindowVerb::OpenFolder, "folder"),
        WindowInfo::plain(WindowAction::Present).with_key("F11", When::Always),
        WindowInfo::plain(WindowAction::Quit),
    ]
}
