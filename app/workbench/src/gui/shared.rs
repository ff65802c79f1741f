//! What all panels share: the workbench, the pilot's hands, what is chosen, and the commands they give.

use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::Kind;
use endline_session::PluginHost;
use endline_session::command::Command;
use endline_session::edit::Documents;
use endline_session::live::engine::Launch;
use endline_session::task::Waker;
use endline_session::workbench::{Notice, Workbench};

use super::command::action::WindowCommand;
use super::film::FilmJob;
use super::kept_picture::KeptPicture;
use super::panel_id::PanelId;
use super::preferences::Preferences;
use crate::input::{Pilot, Rumble};

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
