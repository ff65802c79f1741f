//! What all panels share: the workbench, the pilot, the selection, the user's preferences, and the commands that panels give.

use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::{Document, Kind};
use endline_session::PluginHost;
use endline_session::command::{Command, EditAction};
use endline_session::edit::Documents;
use endline_session::live::engine::Launch;
use endline_session::task::Waker;
use endline_session::workbench::{Notice, Preferences as WorkbenchPreferences, Workbench};
use serde::{Deserialize, Serialize};

use crate::gui::bars::FirstShown;
use crate::gui::command::action::WindowCommand;
use crate::gui::panel::PanelId;
use crate::gui::pictures::{FilmJob, Thumbnail};
use crate::gui::theme::Theme;
use crate::input::{Mapping, Pilot, Rumble};

/// What all panels share.
pub struct Shared {
    /// Open files, runs, studies and searches: all that needs no screen.
    pub workbench: Workbench,
    /// Preferences for the window.
    pub preferences: Preferences,
    /// Controls of the pilot.
    pub pilot: Pilot,
    /// Whether the pilot steers the whale.
    pub flying: bool,
    /// Pulses of the pad.
    pub rumble: Rumble,
    /// While only the 3-D view is shown: the screen scale before.
    pub presented_from: Option<f32>,
    /// Whether the 3-D view shows handles for the start of the whale.
    pub posing: bool,
    /// Selection in the panels.
    pub selection: Selection,
    /// The film in progress.
    pub film: Option<FilmJob>,
    /// The thumbnail of a recording in progress.
    pub thumbnail: Thumbnail,
    /// Folder for documents as HTML pages; `None` if the system has no data folder.
    pub pages: Option<PathBuf>,
    /// Times at which notices of the status bar were first shown.
    pub notice_shown: FirstShown,
    /// Panels drawn in this frame.
    pub drawn: Vec<PanelId>,
    /// Commands of the panels, performed after drawing.
    pub commands: Vec<WindowCommand>,
}

/// What is selected in the panels; commands depend on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Path of the selected library entry.
    pub entry: Option<String>,
    /// Table of the library that is shown.
    pub table: Kind,
    /// Index of the selected entry of the pilot program.
    pub program_entry: Option<usize>,
    /// Whether the statics of the assembly panel have converged.
    pub gear_at_rest: bool,
    /// Whether something is inspected or measured in the 3-D view.
    pub inspects: bool,
    /// Number of keys of the camera path.
    pub camera_keys: usize,
    /// Open panels.
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
    /// Opens a workbench on files; the first model is assembled in the background.
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
            thumbnail: Thumbnail::default(),
            pages: None,
            notice_shown: FirstShown::default(),
            drawn: Vec::new(),
            commands: Vec::new(),
        }
    }

    /// The open files.
    pub fn documents(&self) -> &Documents {
        &self.workbench.project().documents
    }

    /// Whether only the 3-D view is shown.
    pub fn presents(&self) -> bool {
        self.presented_from.is_some()
    }

    /// Gives a command, to be performed after drawing.
    pub fn give(&mut self, command: impl Into<WindowCommand>) {
        self.commands.push(command.into());
    }

    /// Performs a command of the workbench immediately; the notice reports a failure.
    pub fn perform(&mut self, command: impl Into<Command>) {
        // The notice has the reason.
        let _ = self.workbench.perform(command.into());
    }

    /// Sets a field of a text; the notice says what else changed, or why it failed.
    pub fn set(&mut self, path: &str, field: &str, value: &str) {
        let [path, field, value] = [path, field, value].map(str::to_owned);
        self.perform(EditAction::Set { path, field, value });
    }

    /// Sets a field while a slider is moved.
    pub fn set_held(&mut self, path: &str, field: &str, value: &str) {
        let [path, field, value] = [path, field, value].map(str::to_owned);
        self.perform(EditAction::SetHeld { path, field, value });
    }

    /// Replaces a text by what a change makes of it. Returns whether it did; the notice has the reason if not.
    pub fn alter(
        &mut self,
        path: &str,
        change: impl FnOnce(&mut Document) -> Result<(), String>,
    ) -> bool {
        match self.workbench.project().documents.altered(path, change) {
            Ok(text) => {
                self.perform(EditAction::Replace { path: path.to_owned(), text });
                true
            }
            Err(reason) => {
                self.fault(reason);
                false
            }
        }
    }

    /// Processes a finished film and a finished thumbnail.
    pub fn refresh_pictures(&mut self) {
        if self.thumbnail.ended() {
            self.workbench.recordings_changed();
        }
        if let Some(notice) = self.film.as_mut().and_then(FilmJob::ended) {
            self.film = None;
            self.workbench.say(notice);
        }
    }

    /// Reports a failure and its reason in the notice.
    pub fn fault(&mut self, text: impl Into<String>) {
        self.workbench.say(Notice::fault(text));
    }

    /// Reports in the notice that a file was written, or why not.
    pub fn notice_saved(&mut self, path: &std::path::Path, written: Result<(), String>) {
        self.workbench.say(match written {
            Ok(()) => Notice::done(format!("saved {}", path.display())),
            Err(error) => Notice::fault(format!("{}: {error}", path.display())),
        });
    }
}

/// Preferences for the window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Whether pushing the stick pitches the nose down.
    pub invert_pitch: bool,
    /// Assignment of the pad.
    pub mapping: Mapping,
    /// Screen scale, 1 normal; larger for a projector.
    pub scale: Scale,
}

/// Preferences of window and workbench, as they are stored in one text.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct StoredPreferences {
    /// Of the window.
    #[serde(flatten)]
    pub window: Preferences,
    /// Of the workbench.
    #[serde(flatten)]
    pub workbench: WorkbenchPreferences,
}

/// Screen scale.
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
    fn preferences_of_window_and_workbench_survive_one_text_and_an_older_text_is_read() {
        let text = r#"{"theme":"Light","units":"Noaa","invert_pitch":true,"scale":1.5,"recent":["a.toml"]}"#;
        let stored: StoredPreferences = serde_json::from_str(text).unwrap();
        assert_eq!((stored.window.theme, stored.window.scale), (Theme::Light, Scale(1.5)));
        assert_eq!(stored.workbench.recent, [PathBuf::from("a.toml")]);
        let again: StoredPreferences =
            serde_json::from_str(&serde_json::to_string(&stored).unwrap()).unwrap();
        assert_eq!((again.window, again.workbench), (stored.window, stored.workbench));
    }
}
