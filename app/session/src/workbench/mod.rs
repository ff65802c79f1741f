//! What a user has open and does, without a screen.
//!
//! A [`Workbench`] is given [commands](crate::command) by [`perform`](Workbench::perform) and takes in what other threads
//! have ready by [`refresh`](Workbench::refresh), which a window calls once a frame and a script while it waits.
//!
//! | module | what |
//! |---|---|
//! | [`project`] | texts opened, edited and saved |
//! | [`run`] | the run shown: its model, its thread, its speed |
//! | [`comparison`] | a second run beside it |
//! | [`studies`] | studies at work and their results |
//! | [`searches`] | the search at work and the stories found |
//! | [`rules`] | an assembly checked under rules, and edits by which it would comply |
//! | [`plugins`] | plugins loaded, allowed, checked and used |
//! | [`preferences`] | what is kept between sessions |

pub mod comparison;
mod export;
mod model;
mod notice;
pub mod plugins;
pub mod program;
pub mod project;
mod recordings;
mod replay;
pub mod rules;
pub mod run;
pub mod searches;
pub mod studies;
pub mod study_check;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_sdk::{Act, GearType};
use serde::{Deserialize, Serialize};

use crate::edit::Documents;
use crate::edit::recovery::{Autosave, UnsavedEdits};
use crate::live::{Launch, LiveView, Status};
use crate::plugins::{Ask, Loader, PluginHost, PluginProblem};
use crate::task::Waker;
use crate::units::Units;
pub use comparison::Comparison;
pub use notice::{Event, Notice, NoticeKind};
pub use plugins::{Load, Plugins};
pub use project::Project;
pub use rules::{RuleAnswer, RuleChecks, RuleQuestion};
pub use run::{CurrentRun, Direction, SPEEDS, Speed};
pub use searches::{SearchEffort, Searches};
pub use studies::Studies;

/// Folders that a workbench writes to.
#[derive(Clone, Debug, Default)]
pub struct Folders {
    /// Recordings of runs; no run is recorded without one.
    pub recordings: Option<PathBuf>,
    /// Results of studies; `results` in the working folder without one.
    pub studies: Option<PathBuf>,
    /// Results of searches; `results` in the working folder without one.
    pub searches: Option<PathBuf>,
    /// Unsaved edits, for the case of a crash; they are not stored without one.
    pub unsaved: Option<PathBuf>,
}

impl Folders {
    /// The folders inside the folder of a user's data.
    pub fn within(data: &Path) -> Self {
        let [recordings, studies, searches] =
            ["recordings", "studies", "searches"].map(|name| Some(data.join(name)));
        Self { recordings, studies, searches, unsaved: Some(data.to_owned()) }
    }
}

/// What is on screen and is to be checked as it is edited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shown {
    /// The open study.
    pub study: bool,
    /// An assembly under rules.
    pub rules: bool,
}

/// What a user has open and does.
///
/// It is read by views, such as [`project`](Self::project), and changed by [commands](Self::perform). What else changes it is for
/// the program around it: a window or a script.
pub struct Workbench {
    pub(crate) project: Project,
    pub(crate) run: CurrentRun,
    pub(crate) studies: Studies,
    pub(crate) searches: Searches,
    pub(crate) rules: RuleChecks,
    pub(crate) plugins: Plugins,
    pub(crate) preferences: Preferences,
    /// Folder of the recordings of runs; no run is recorded without one.
    pub(crate) recordings: Option<PathBuf>,
    pub(crate) notice: Option<Notice>,
    events: Vec<Event>,
    waker: Waker,
}

impl Workbench {
    /// A workbench with its texts; the first model is being made.
    ///
    /// `launch` starts runs; `waker` is called from any thread when there is something to take in.
    pub fn new(documents: Documents, host: Arc<PluginHost>, launch: Launch, waker: Waker) -> Self {
        let mut workbench = Self {
            project: Project::new(documents),
            run: CurrentRun::new(launch),
            studies: Studies::default(),
            searches: Searches::default(),
            rules: RuleChecks::default(),
            plugins: Plugins::new(host),
            preferences: Preferences::default(),
            recordings: None,
            notice: None,
            events: Vec::new(),
            waker,
        };
        if let Err(reason) = workbench.make_model() {
            workbench.notice = Some(Notice::fault(reason));
        }
        workbench
    }

    /// The open texts.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// Studies at work and their results.
    pub fn studies(&self) -> &Studies {
        &self.studies
    }

    /// The search at work and the stories found.
    pub fn searches(&self) -> &Searches {
        &self.searches
    }

    /// An assembly checked under rules.
    pub fn rules(&self) -> &RuleChecks {
        &self.rules
    }

    /// Plugins in use, and those that are not.
    pub fn plugins(&self) -> &Plugins {
        &self.plugins
    }

    /// What the user prefers.
    pub fn preferences(&self) -> &Preferences {
        &self.preferences
    }

    /// Folder of the recordings of runs.
    pub fn recordings(&self) -> Option<&Path> {
        self.recordings.as_deref()
    }

    /// The last notice.
    pub fn notice(&self) -> Option<&Notice> {
        self.notice.as_ref()
    }

    /// Shows a notice of the program around the workbench.
    pub fn say(&mut self, notice: Notice) {
        self.notice = Some(notice);
    }

    /// Takes the last notice away.
    pub fn dismiss_notice(&mut self) {
        self.notice = None;
    }

    /// Restores what the user preferred in an earlier session.
    pub fn set_preferences(&mut self, preferences: Preferences) {
        self.preferences = preferences;
    }

    /// Shows values in other units.
    pub fn set_units(&mut self, units: Units) {
        self.preferences.units = units;
    }

    /// Sets the folders that are given; the others stay.
    pub fn write_to(&mut self, folders: Folders) {
        let Folders { recordings, studies, searches, unsaved } = folders;
        self.recordings = recordings.or(self.recordings.take());
        self.studies.folder = studies.or(self.studies.folder.take());
        self.searches.folder = searches.or(self.searches.folder.take());
        if let Some(folder) = unsaved {
            self.project.autosave = Autosave::in_folder(folder);
        }
    }

    /// Stores unsaved edits where it is time. Returns the time after which to call again [s].
    pub fn store_unsaved(&mut self, now_s: f64) -> Option<f64> {
        self.project.autosave.keep(&self.project.documents, now_s)
    }

    /// Waits until unsaved edits that are being stored are on the disk.
    pub fn finish_storing(&mut self) {
        self.project.autosave.finish();
    }

    /// Deletes the stored unsaved edits: they are saved, or given up.
    pub fn forget_unsaved(&mut self) {
        self.project.autosave.clear();
    }

    /// Unsaved edits that crashed programs left, the newest first, with their files.
    pub fn left_behind(&self) -> Vec<(PathBuf, UnsavedEdits)> {
        self.project.autosave.left_behind()
    }

    /// Loads plugins by a loader from now on; `problems` are those of the plugins loaded at the start.
    pub fn load_plugins_with(&mut self, loader: Loader, load: Load, problems: Vec<PluginProblem>) {
        self.plugins.load_with(loader, load, problems);
    }

    /// Asks about a new plugin no more in this session.
    pub fn put_off_plugin(&mut self, ask: &Ask) {
        self.plugins.put_off(ask);
    }

    /// Takes in what other threads have ready.
    pub fn refresh(&mut self) {
        self.take_model();
        self.take_plugins();
        self.refresh_studies();
        self.refresh_searches();
        self.refresh_rules();
        self.run.refresh();
        self.keep_finished_run();
        self.take_program();
        self.refresh_comparison();
    }

    /// Starts the checks of what is on screen, where it has changed since it was checked. A window calls it once a frame, a
    /// script once after its edits.
    pub fn check(&mut self, shown: Shown) {
        if shown.study {
            self.check_study();
        }
        if shown.rules {
            self.ask_for_rules();
        }
    }

    /// What came about since the last call.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// The newest view of the run.
    pub fn view(&self) -> Option<&Arc<LiveView>> {
        self.run.view.as_ref()
    }

    /// How the run stands.
    pub fn status(&self) -> Option<&Status> {
        self.view().map(|view| &view.status)
    }

    /// Whether the run is stepping.
    pub fn running(&self) -> bool {
        self.status() == Some(&Status::Running)
    }

    /// What the whale's motion can be asked for.
    pub fn acts(&self) -> &[Act] {
        let whale = self.view().and_then(|view| view.model.spec.whale.as_ref());
        whale.map_or(&[], |whale| &whale.motion.descriptor().acts)
    }

    /// What work in the background needs: the plugins, and whom to wake when something is ready.
    pub fn helpers(&self) -> (Arc<PluginHost>, Waker) {
        (Arc::clone(&self.plugins.host), Arc::clone(&self.waker))
    }

    /// The gear types among the plugins.
    pub fn gear_types(&self) -> Vec<Arc<dyn GearType>> {
        let host = &self.plugins.host;
        host.ids().iter().filter_map(|id| host.gear(id)).collect()
    }

    /// The scenario's name without folder and extension.
    pub fn scenario_stem(&self) -> String {
        self.project.scenario_stem()
    }
}

/// Scenarios kept as opened last.
const RECENT: usize = 8;

/// What a user prefers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Units that values are shown in.
    pub units: Units,
    /// Scenarios opened last, the newest first.
    pub recent: Vec<PathBuf>,
}

impl Preferences {
    /// Puts a scenario first among those opened last.
    fn remember(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(RECENT);
    }
}
