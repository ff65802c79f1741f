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
pub mod preferences;
mod program;
pub mod project;
mod recordings;
mod replay;
pub mod rules;
pub mod run;
pub mod searches;
pub mod studies;
pub mod study_check;

use std::path::PathBuf;
use std::sync::Arc;

use endline_sdk::{Act, GearType};

use crate::edit::Documents;
use crate::live::{Launch, LiveView, Status};
use crate::plugins::PluginHost;
use crate::task::Waker;
pub use comparison::Comparison;
pub use notice::{Event, Notice, NoticeKind};
pub use plugins::Plugins;
pub use preferences::Preferences;
pub use project::Project;
pub use rules::{RuleAnswer, RuleChecks, RuleQuestion};
pub use run::{CurrentRun, Direction, SPEEDS, Speed};
pub use searches::{SearchEffort, Searches};
pub use studies::Studies;

/// What is on screen and is to be checked as it is edited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shown {
    /// The open study.
    pub study: bool,
    /// An assembly under rules.
    pub rules: bool,
}

/// What a user has open and does.
pub struct Workbench {
    /// The texts.
    pub project: Project,
    /// The run shown.
    pub run: CurrentRun,
    /// Studies at work and their results.
    pub studies: Studies,
    /// The search at work and the stories found.
    pub searches: Searches,
    /// An assembly checked under rules.
    pub rules: RuleChecks,
    /// Plugins in use, and those that are not.
    pub plugins: Plugins,
    /// What the user prefers.
    pub preferences: Preferences,
    /// Folder that runs are kept in; none are kept without one.
    pub recordings: Option<PathBuf>,
    /// What was said last.
    pub notice: Option<Notice>,
    events: Vec<Event>,
    waker: Waker,
}

impl Workbench {
    /// A workbench with its texts; the first model is being made.
    ///
    /// `launch` starts runs; `waker` is called from any thread when there is something to take in.
    #[must_use]
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
    #[must_use]
    pub fn view(&self) -> Option<&Arc<LiveView>> {
        self.run.view.as_ref()
    }

    /// How the run stands.
    #[must_use]
    pub fn status(&self) -> Option<&Status> {
        self.view().map(|view| &view.status)
    }

    /// Whether the run is stepping.
    #[must_use]
    pub fn running(&self) -> bool {
        self.status() == Some(&Status::Running)
    }

    /// What the whale's motion can be asked for.
    #[must_use]
    pub fn acts(&self) -> &[Act] {
        let whale = self.view().and_then(|view| view.model.spec.whale.as_ref());
        whale.map_or(&[], |whale| &whale.motion.descriptor().acts)
    }

    /// What work in the background needs: the plugins, and whom to wake when something is ready.
    #[must_use]
    pub fn helpers(&self) -> (Arc<PluginHost>, Waker) {
        (Arc::clone(&self.plugins.host), Arc::clone(&self.waker))
    }

    /// The gear types among the plugins.
    #[must_use]
    pub fn gear_types(&self) -> Vec<Arc<dyn GearType>> {
        let host = &self.plugins.host;
        host.ids().iter().filter_map(|id| host.gear(id)).collect()
    }

    /// The scenario's name without folder and extension.
    #[must_use]
    pub fn scenario_stem(&self) -> String {
        self.project.scenario_stem()
    }
}
