//! What all panels share: the texts, the run, the pilot; and the orders that change them.

mod compare;
mod files;
mod plugins;
mod rerun;
mod runs;
mod studies;

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::Diagnostic;
use endline_sdk::{Act, GearType};
use endline_session::edit::Documents;
use endline_session::edit::recovery::Autosave;
use endline_session::live::{Engine, Launch, Maker};
use endline_session::live::{LiveView, RunCommand, Status};
use endline_session::plugins::PluginUsed;
use endline_session::recording::replay::check_plugins;
use endline_session::task::Waker;
use endline_session::{Error, Overrides, PluginHost, Prepared, Source};

pub use super::order::Order;
pub use super::preferences::{Preferences, Scale};

use super::plugins::Plugins;
use super::studies::Studies;
use crate::input::{Pilot, Rumble};
use compare::Other;
use runs::WORTH_KEEPING_S;

/// How fast a run is played again where it was run as fast as it went.
const FASTEST_REPLAY: f64 = 10.0;

/// Texts by path.
type Texts = std::collections::BTreeMap<String, String>;

/// Scenarios kept as open last.
const RECENT: usize = 8;

/// The shared state of the workbench.
pub struct Desk {
    /// The texts.
    pub documents: Documents,
    /// The newest view of the run.
    pub view: Option<Arc<LiveView>>,
    /// What the user prefers.
    pub preferences: Preferences,
    /// The pilot's hands.
    pub pilot: Pilot,
    /// Whether they steer.
    pub flying: bool,
    /// Whether handles in the 3-D view drag the whale's start.
    pub posing: bool,
    /// Studies at work and their results.
    pub studies: Studies,
    /// What the pilot feels.
    pub rumble: Rumble,
    /// Keeps unsaved edits.
    pub autosave: Autosave,
    /// Folder that runs are kept in.
    pub recordings: Option<PathBuf>,
    /// Problems found in making the model, beyond those of single files.
    pub make_problems: Vec<Diagnostic>,
    /// Plugins that are not used, checks of them, and loading them again.
    pub plugins: Plugins,
    /// What the status bar says last, and whether it is bad.
    pub notice: Option<(String, bool)>,
    /// Orders given by panels, obeyed after drawing.
    pub orders: Vec<Order>,
    host: Arc<PluginHost>,
    launch: Launch,
    waker: Waker,
    engine: Option<Box<dyn Engine>>,
    maker: Maker,
    making: Texts,
    applied: Option<Texts>,
    /// Whether texts differ from those, found for a version of the texts.
    stale: Cell<Option<(u64, bool)>>,
    start_when_made: bool,
    /// Moment shown of a run that is played again [s].
    replaying_s: Option<f64>,
    replay_speed: f64,
    /// Runs kept since the start.
    kept_runs: u64,
    /// Whether the run shown was kept as it stands.
    run_is_kept: bool,
    /// Whether plugins were loaded again since the run's thread began.
    other_plugins: bool,
    /// Inputs of a recording whose model is in the making, and the plugins it ran on.
    inputs_when_made: Option<(Vec<endline_sdk::Controls>, Vec<PluginUsed>)>,
    /// Version of the texts when a run was loaded that is not made from them: a recording, or an encounter of a study.
    guest: Option<u64>,
    guest_when_made: Option<u64>,
    /// The run that the one shown is compared with.
    other: Option<Other>,
    again: rerun::Again,
}

impl Desk {
    /// A desk with its texts; the first model is being made.
    #[must_use]
    pub fn new(
        documents: Documents,
        host: Arc<PluginHost>,
        launch: Launch,
        waker: Waker,
        pilot: Pilot,
    ) -> Self {
        let mut desk = Self {
            documents,
            view: None,
            preferences: Preferences::default(),
            pilot,
            flying: false,
            posing: false,
            studies: Studies::default(),
            rumble: Rumble::default(),
            autosave: Autosave::default(),
            recordings: None,
            make_problems: Vec::new(),
            plugins: Plugins::default(),
            notice: None,
            orders: Vec::new(),
            host,
            launch,
            waker,
            engine: None,
            maker: Maker::default(),
            making: Texts::new(),
            applied: None,
            stale: Cell::new(None),
            start_when_made: false,
            replaying_s: None,
            replay_speed: 1.0,
            kept_runs: 0,
            run_is_kept: false,
            other_plugins: false,
            inputs_when_made: None,
            guest: None,
            guest_when_made: None,
            other: None,
            again: rerun::Again::default(),
        };
        desk.make();
        desk
    }

    /// Takes in what other threads have ready; once a frame.
    pub fn refresh(&mut self) {
        if let Some(made) = self.maker.poll() {
            self.take_made(made);
        }
        self.take_plugins();
        self.tick_studies();
        self.view = self.engine.as_ref().map(|engine| engine.latest());
        if self.view.as_ref().is_some_and(|view| view.newest_s < WORTH_KEEPING_S) {
            self.run_is_kept = false;
        }
        if matches!(self.status(), Some(Status::Finished | Status::Stopped(_))) {
            self.keep_run();
        }
        self.take_program();
        self.refresh_other();
    }

    /// Whether a model is in the making.
    #[must_use]
    pub fn making(&self) -> bool {
        self.maker.busy()
    }

    /// Whether texts have changed since the run's model was made.
    #[must_use]
    pub fn stale(&self) -> bool {
        let version = self.documents.version();
        if let Some((_, stale)) = self.stale.get().filter(|(known, _)| *known == version) {
            return stale;
        }
        let stale = !self.applied.as_ref().is_some_and(|applied| self.documents.same_run(applied));
        self.stale.set(Some((version, stale)));
        stale
    }

    /// How the run stands.
    #[must_use]
    pub fn status(&self) -> Option<&Status> {
        self.view.as_ref().map(|view| &view.status)
    }

    /// Whether the run is stepping.
    #[must_use]
    pub fn running(&self) -> bool {
        self.status() == Some(&Status::Running)
    }

    /// What the whale's motion can be asked for.
    #[must_use]
    pub fn acts(&self) -> &[Act] {
        let whale = self.view.as_ref().and_then(|view| view.model.spec.whale.as_ref());
        whale.map_or(&[], |whale| &whale.motion.descriptor().acts)
    }

    /// What work in the background needs: the plugins, and whom to wake when there is something to draw.
    #[must_use]
    pub fn helpers(&self) -> (Arc<PluginHost>, Waker) {
        (Arc::clone(&self.host), Arc::clone(&self.waker))
    }

    /// The gear types among the plugins.
    #[must_use]
    pub fn gear_types(&self) -> Vec<Arc<dyn GearType>> {
        self.host.ids().iter().filter_map(|id| self.host.gear(id)).collect()
    }

    /// Problems of texts and of making the model.
    pub fn problems(&self) -> impl Iterator<Item = &Diagnostic> {
        let known = self.documents.problems();
        known.iter().chain(self.make_problems.iter().filter(|problem| !known.contains(problem)))
    }

    /// The worst problem at a field of a text, or of the model last made of the texts as they stand.
    #[must_use]
    pub fn problem_at(&self, path: &str, field: &str) -> Option<&Diagnostic> {
        let file = self.documents.shown_name(path);
        let here = |problem: &&Diagnostic| problem.file == file && problem.field == field;
        let made = || {
            self.make_problems.iter().find(here).filter(|_| self.documents.same_run(&self.making))
        };
        self.documents.problem_at(path, field).or_else(made)
    }

    /// Sends a command to the run; false where there is none to take it.
    pub fn send(&mut self, command: RunCommand) -> bool {
        self.engine.as_ref().is_some_and(|engine| engine.send(command))
    }

    /// Sets a field of a text and says so where that fails.
    pub fn set(&mut self, path: &str, field: &str, value: &str) {
        if let Err(error) = self.documents.set(path, field, value) {
            self.notice = Some((error, true));
        }
    }

    /// Obeys an order; those about layout are left to the window.
    pub fn obey(&mut self, order: &Order) {
        match order {
            Order::Start => {
                self.replaying_s = None;
                self.run_is_kept = false;
                self.start();
            }
            Order::Pause => self.tell(RunCommand::Pause),
            Order::PlayPause if self.running() => self.tell(RunCommand::Pause),
            Order::PlayPause
                if self.replaying() || self.view.as_ref().is_some_and(|view| view.sought) =>
            {
                self.replay()
            }
            Order::PlayPause => self.start(),
            Order::Step => self.tell(RunCommand::Step),
            Order::Reset => {
                self.keep_run();
                self.tell(RunCommand::Reset);
            }
            Order::OpenRecording(path) => self.open_recording(path),
            Order::Branch => {
                self.keep_run();
                self.replaying_s = None;
                self.tell(RunCommand::Branch);
            }
            Order::HoldRun | Order::CompareWith(_) | Order::EndCompare => self.obey_compare(order),
            Order::Pose => self.posing = !self.posing,
            Order::EditInputs => self.edit_inputs(),
            Order::Rerun => self.rerun(),
            Order::Dress(theme) => self.preferences.theme = *theme,
            Order::Measure(units) => self.preferences.units = *units,
            Order::Apply => self.make(),
            Order::Speed(speed) => self.set_speed(*speed),
            Order::Seek(_) | Order::Shift(_) | Order::Newest | Order::Replay => {
                self.obey_time(order)
            }
            Order::WeakLinks => self.toggle_weak_links(),
            Order::Fly => self.toggle_fly(),
            Order::NextAct => {
                let acts = self.acts().len();
                self.pilot.next_act(acts);
            }
            Order::Slower => self.change_speed(false),
            Order::Faster => self.change_speed(true),
            Order::Mouth => self.pilot.toggle_mouth(),
            Order::ChooseAct(act) => self.pilot.choose_act(*act),
            Order::Save => self.save(),
            Order::ScenarioAs(path) => self.save_scenario_as(path),
            Order::SaveRecording(path) => self.tell(RunCommand::SaveRecording(path.clone())),
            Order::Open(path) => self.open(path),
            Order::ReloadPlugins
            | Order::AllowPlugin(..)
            | Order::SwitchPlugin(..)
            | Order::CheckPlugin(_)
            | Order::UsePlugin(_)
            | Order::OpenFolder(_) => self.obey_plugins(order),
            Order::Undo => self.step_back(true),
            Order::Redo => self.step_back(false),
            Order::ReplayEncounter(option, encounter) => self.replay_encounter(*option, *encounter),
            // What is left is about studies, or about panels and layout, and obeyed by the window.
            other => self.obey_study(other),
        }
    }

    fn set_speed(&mut self, speed: f64) {
        self.replay_speed = if speed.is_finite() { speed } else { FASTEST_REPLAY };
        self.tell(RunCommand::Speed(speed));
    }

    /// The next of the speeds offered.
    fn change_speed(&mut self, faster: bool) {
        let now = self.view.as_ref().map_or(1.0, |view| view.speed);
        let speeds = endline_session::live::engine::SPEEDS.map(|(speed, _)| speed);
        let next = if faster {
            speeds.into_iter().find(|speed| *speed > now)
        } else {
            speeds.into_iter().rev().find(|speed| *speed < now)
        };
        next.into_iter().for_each(|speed| self.set_speed(speed));
    }

    /// Another moment shown by one order.
    fn obey_time(&mut self, order: &Order) {
        match order {
            Order::Seek(time_s) => self.look(RunCommand::Seek(*time_s)),
            Order::Shift(by) => self.look(RunCommand::Shift(*by)),
            Order::Newest => self.look(RunCommand::Seek(f64::MAX)),
            _ => self.replay(),
        }
    }

    /// Looks at another moment; what was playing stands still.
    fn look(&mut self, command: RunCommand) {
        self.replaying_s = None;
        self.tell(command);
    }

    /// Whether what was run is playing.
    #[must_use]
    pub fn replaying(&self) -> bool {
        self.replaying_s.is_some()
    }

    /// From the moment shown, or from the start where that is the newest.
    fn replay(&mut self) {
        let Some(view) = self.view.clone() else { return };
        if self.replaying_s.take().is_none() {
            self.replaying_s = Some(if view.sought { view.frame.time_s } else { 0.0 });
            self.tell(RunCommand::Pause);
        }
    }

    /// Goes on with the moment shown where what was run is playing; `elapsed_s` of real time are over.
    pub fn play(&mut self, elapsed_s: f64) {
        let Some((shown_s, view)) = self.replaying_s.zip(self.view.clone()) else { return };
        let next_s = shown_s + elapsed_s * self.replay_speed;
        self.replaying_s = (next_s < view.newest_s).then_some(next_s);
        self.tell(RunCommand::Seek(next_s));
    }

    /// The command line that gives the run shown, and whether files must be saved before it does.
    #[must_use]
    pub fn command_line(&self) -> (String, bool) {
        let quoted = |path: &std::path::Path| {
            format!("'{}'", path.display().to_string().replace('\'', "'\\''"))
        };
        let line = format!(
            "endline run {} --library {}",
            quoted(self.documents.scenario_path()),
            quoted(self.documents.root())
        );
        (line, !self.documents.unsaved().is_empty())
    }

    fn tell(&mut self, command: RunCommand) {
        if !self.send(command) {
            self.notice = Some(("the run does not take commands now".into(), true));
        }
    }

    fn start(&mut self) {
        if self.stale()
            && self.guest != Some(self.documents.version())
            && !self.documents.any_error()
        {
            self.start_when_made = true;
            self.make();
            return;
        }
        if matches!(self.status(), Some(Status::Finished | Status::Stopped(_))) {
            self.tell(RunCommand::Reset);
        }
        self.tell(RunCommand::Start);
    }

    /// Makes a model from the present texts, unless they have errors.
    fn make(&mut self) {
        if self.documents.any_error() {
            self.start_when_made = false;
            self.notice = Some(("the gear has errors; see Problems".into(), true));
            return;
        }
        let source = Source {
            scenario_name: self.documents.shown_name(Documents::SCENARIO),
            scenario: self.documents.text(Documents::SCENARIO).unwrap_or_default().to_owned(),
            library: self.host.with_clips(self.documents.sources()),
            overrides: Overrides::default(),
        };
        self.making = self.documents.texts_of_run();
        self.guest_when_made = None;
        if let Err(error) =
            self.maker.start(source, Arc::clone(&self.host), Arc::clone(&self.waker))
        {
            self.notice = Some((format!("the model cannot be made: {error}"), true));
        }
    }

    fn take_made(&mut self, made: Result<Prepared, Error>) {
        self.make_problems.clear();
        let start = std::mem::take(&mut self.start_when_made);
        let recorded = self.inputs_when_made.take();
        match made {
            Ok(prepared) => {
                let other = recorded
                    .as_ref()
                    .and_then(|(_, plugins)| check_plugins(plugins, &prepared.plugins).err());
                if let Some(error) = other {
                    self.guest_when_made = None;
                    return self.notice = Some((error.to_string(), true));
                }
                self.notice = None;
                self.load(prepared);
                if let Some((inputs, _)) = recorded {
                    self.tell(RunCommand::Inputs(inputs));
                    self.run_is_kept = true;
                }
                if start {
                    self.tell(RunCommand::Start);
                }
            }
            Err(Error::Diagnostics(problems)) => {
                self.make_problems = problems;
                self.notice = Some(("the model cannot be made; see Problems".into(), true));
            }
            Err(error) => self.notice = Some((error.to_string(), true)),
        }
    }

    fn load(&mut self, prepared: Prepared) {
        self.keep_run();
        self.applied = Some(std::mem::take(&mut self.making));
        self.stale.set(None);
        self.guest = self.guest_when_made.take();
        let rerun = self.again.rerun_when_made();
        if std::mem::take(&mut self.other_plugins) {
            self.engine = None;
        }
        if self.engine.is_some() {
            let command = if rerun { RunCommand::Rerun } else { RunCommand::Load };
            self.tell(command(Box::new(prepared)));
            return;
        }
        match (self.launch)(prepared, Arc::clone(&self.host), Arc::clone(&self.waker)) {
            Ok(engine) => self.engine = Some(engine),
            Err(error) => self.notice = Some((error, true)),
        }
    }

    fn toggle_weak_links(&mut self) {
        let on = self
            .documents
            .field(Documents::SCENARIO, "weak_links")
            .is_none_or(|text| text == "true");
        self.set(Documents::SCENARIO, "weak_links", if on { "false" } else { "true" });
        self.make();
    }

    fn toggle_fly(&mut self) {
        self.flying = !self.flying;
        if self.flying {
            let speed = self.view.as_ref().map_or(0.5, |view| view.controls.speed);
            self.pilot.set_throttle(speed.max(0.3));
        } else {
            self.tell(RunCommand::Autopilot);
        }
    }

    fn save(&mut self) {
        self.notice = Some(match self.documents.save() {
            Ok(0) => ("nothing to save".into(), false),
            Ok(1) => ("saved 1 file".into(), false),
            Ok(count) => (format!("saved {count} files"), false),
            Err(error) => (format!("not saved: {error}"), true),
        });
    }

    fn open(&mut self, path: &std::path::Path) {
        match self.documents.open_scenario(path) {
            Ok(()) => {
                self.remember(path);
                self.make();
            }
            Err(error) => self.notice = Some((error, true)),
        }
    }

    /// Puts a scenario first among those open last.
    fn remember(&mut self, path: &std::path::Path) {
        self.preferences.recent.retain(|known| known != path);
        self.preferences.recent.insert(0, path.to_owned());
        self.preferences.recent.truncate(RECENT);
    }

    fn step_back(&mut self, undo: bool) {
        let done = if undo { self.documents.undo() } else { self.documents.redo() };
        if !done {
            self.notice =
                Some((format!("nothing to {}", if undo { "undo" } else { "redo" }), false));
        }
    }
}
