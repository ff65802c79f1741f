//! What all panels share: the workbench, the pilot, the selection, the user's preferences, and the commands that panels give.

use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::Kind;
use endline_session::PluginHost;
use endline_session::command::Command;
use endline_session::edit::Documents;
use endline_session::live::engine::Launch;
use endline_session::task::Waker;
use endline_session::workbench::{Notice, Preferences as WorkbenchPreferences, Workbench};
use serde::{Deserialize, Serialize};

use crate::gui::command::action::WindowCommand;
use crate::gui::panel::PanelId;
use crate::gui::pictures::{FilmJob, KeptPicture};
use crate::gui::theme::Theme;
use crate::input::{Mapping, Pilot, Rumble};

/// What all panels share.
pub struct Shared {
    /// What the user has open and does, without a screen.
    pub workbench: Workbench,
    /// What the user prefers of the window.
    pub preferences: Preferences,
    /// The pilot's hands.
    pub pilot: Pilot,
    /// Whether they steer.
    pub flying: bool,
    /// What the pilot feels.
    pub rumble: Rumble,
    /// While the 3-D view is presented alone: the size of everything on screen before.
    pub presented_from: Option<f32>,
    /// Whether handles in the 3-D view drag the whale's start.
    pub posing: bool,
    /// What is chosen in the panels.
    pub selection: Selection,
    /// The film that is being made.
    pub film: Option<FilmJob>,
    /// The picture of a kept run that is being drawn.
    pub kept_picture: KeptPicture,
    /// Where documents are written as pages; none where the system names no home.
    pub pages: Option<PathBuf>,
    /// Commands given by panels, performed after drawing.
    pub commands: Vec<WindowCommand>,
}

/// What is chosen in the panels, for commands to be judged on.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// The entry chosen in the library, by its path.
    pub entry: Option<String>,
    /// The table of the library that is shown.
    pub table: Kind,
    /// The entry chosen in the pilot program, by its place.
    pub program_entry: Option<usize>,
    /// Whether the gear of the assembly panel is at rest.
    pub gear_at_rest: bool,
    /// Whether something is inspected or measured in the 3-D view.
    pub inspects: bool,
    /// How many keys the camera has.
    pub camera_keys: usize,
    /// Panels that are open.
    pub open: Vec<PanelId>,
}

impl Default for Selection {
    fn default() -> Self {
        Self {
            entry: None,
            table: Kind::Rope,
            program_entry: None,
            gear_at_rest: false,
            inspects: false,
            camera_keys: 0,
            open: Vec::new(),
        }
    }
}

impl Shared {
    /// With its texts; the first model is being made.
    #[must_use]
    pub fn new(
        documents: Documents,
        host: Arc<PluginHost>,
        launch: Launch,
        waker: Waker,
        pilot: Pilot,
    ) -> Self {
        Self {
            workbench: Workbench::new(documents, host, launch, waker),
            preferences: Preferences::default(),
            pilot,
            flying: false,
            rumble: Rumble::default(),
            presented_from: None,
            posing: false,
            selection: Selection::default(),
            film: None,
            kept_picture: KeptPicture::default(),
            pages: None,
            commands: Vec::new(),
        }
    }

    /// Whether the 3-D view is presented alone.
    #[must_use]
    pub fn presents(&self) -> bool {
        self.presented_from.is_some()
    }

    /// Gives a command, to be performed after drawing.
    pub fn give(&mut self, command: impl Into<WindowCommand>) {
        self.commands.push(command.into());
    }

    /// Performs a command of the workbench at once; the notice says where nothing came of it.
    pub fn perform(&mut self, command: impl Into<Command>) {
        // The reason stands in the notice.
        let _ = self.workbench.perform(command.into());
    }

    /// Takes in a film and a picture that have ended.
    pub fn refresh_pictures(&mut self) {
        if self.kept_picture.ended() {
            self.workbench.recordings_changed();
        }
        if let Some(notice) = self.film.as_mut().and_then(FilmJob::ended) {
            (self.film, self.workbench.notice) = (None, Some(notice));
        }
    }

    /// Says that something failed, and why.
    pub fn fault(&mut self, text: impl Into<String>) {
        self.workbench.notice = Some(Notice::fault(text));
    }

    /// Says that a file was written, or why it was not.
    pub fn notice_saved(&mut self, path: &std::path::Path, written: Result<(), String>) {
        self.workbench.notice = Some(match written {
            Ok(()) => Notice::done(format!("saved {}", path.display())),
            Err(error) => Notice::fault(format!("{}: {error}", path.display())),
        });
    }
}

/// What a user prefers of the window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Whether pushing the stick puts the nose down.
    pub invert_pitch: bool,
    /// What the pad does.
    pub mapping: Mapping,
    /// Size of everything on screen, 1 for usual; larger for a projector.
    pub scale: Scale,
}

/// Preferences of window and workbench, as they are kept in one place.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Kept {
    /// Those of the window.
    #[serde(flatten)]
    pub window: Preferences,
    /// Those of the workbench.
    #[serde(flatten)]
    pub workbench: WorkbenchPreferences,
}

/// Size of everything on screen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale(pub f32);

impl Default for Scale {
    fn default() -> Self {
        Self(1.0)
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn preferences_of_window_and_workbench_are_kept_in_one_text_and_read_from_an_older_one() {
        let text = r#"{"theme":"Light","units":"Noaa","invert_pitch":true,"scale":1.5,"recent":["a.toml"]}"#;
        let kept: Kept = serde_json::from_str(text).unwrap();
        assert_eq!((kept.window.theme, kept.window.scale), (Theme::Light, Scale(1.5)));
        assert_eq!(kept.workbench.recent, [PathBuf::from("a.toml")]);
        let again: Kept = serde_json::from_str(&serde_json::to_string(&kept).unwrap()).unwrap();
        assert_eq!((again.window, again.workbench), (kept.window, kept.workbench));
    }
}
