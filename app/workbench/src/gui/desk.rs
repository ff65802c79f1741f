//! What all panels share: the texts, the run, the pilot; and the orders that change them.

use std::path::PathBuf;
use std::sync::Arc;

use endline_gear::Diagnostic;
use endline_sdk::Act;
use endline_session::live::{Command, LiveView, Status};
use endline_session::{Error, Overrides, PluginHost, Prepared, Source};
use serde::{Deserialize, Serialize};

use super::book::Book;
use super::engine::{Engine, Launch, Maker, Waker};
use super::layout::{Layout, Panel};
use super::panels::library::LibraryState;
use super::panels::view::ViewState;
use super::theme::Theme;
use super::units::ForceUnit;
use crate::input::Pilot;

/// Texts by path.
type Texts = std::collections::BTreeMap<String, String>;

/// What a user prefers; kept between sessions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Unit of forces on screen.
    pub force: ForceUnit,
    /// Whether pushing the stick puts the nose down.
    pub invert_pitch: bool,
}

/// All that can be asked of the workbench besides editing a text.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Run on; first takes over edited gear.
    Start,
    /// Stand still.
    Pause,
    /// The one of the two that fits.
    PlayPause,
    /// One step.
    Step,
    /// Back to the settled gear.
    Reset,
    /// Take over edited gear and scenario, back at the start.
    Apply,
    /// Simulated seconds for each real one.
    Speed(f64),
    /// Show the moment nearest to a time [s].
    Seek(f64),
    /// Weak links on or off, in the scenario's text.
    WeakLinks,
    /// The pilot's hands on the whale, or off.
    Fly,
    /// First or third person.
    Person,
    /// The next act of the whale's motion.
    NextAct,
    /// The act of this index.
    ChooseAct(usize),
    /// Save every changed text.
    Save,
    /// Save the run so far.
    SaveRecording(PathBuf),
    /// Open a scenario.
    Open(PathBuf),
    /// Take the last edit back.
    Undo,
    /// Do it again.
    Redo,
    /// Bring a panel to the front.
    Show(Panel),
    /// A named layout.
    Arrange(Layout),
    /// The list of all orders, open or closed.
    Commands,
}

/// The shared state of the workbench.
pub struct Desk {
    /// The texts.
    pub book: Book,
    /// The newest view of the run.
    pub view: Option<Arc<LiveView>>,
    /// What the user prefers.
    pub preferences: Preferences,
    /// The pilot's hands.
    pub pilot: Pilot,
    /// Whether they steer.
    pub flying: bool,
    /// State of the library panel.
    pub library: LibraryState,
    /// State of the 3-D view.
    pub view3d: ViewState,
    /// Problems found in making the model, beyond those of single files.
    pub make_problems: Vec<Diagnostic>,
    /// Plugins that were refused.
    pub plugin_problems: Vec<String>,
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
    start_when_made: bool,
}

impl Desk {
    /// A desk with its texts; the first model is being made.
    #[must_use]
    pub fn new(book: Book, host: Arc<PluginHost>, launch: Launch, waker: Waker, pilot: Pilot) -> Self {
        let mut desk = Self {
            book,
            view: None,
            preferences: Preferences::default(),
            pilot,
            flying: false,
            library: LibraryState::default(),
            view3d: ViewState::default(),
            make_problems: Vec::new(),
            plugin_problems: Vec::new(),
            notice: None,
            orders: Vec::new(),
            host,
            launch,
            waker,
            engine: None,
            maker: Maker::default(),
            making: Texts::new(),
            applied: None,
            start_when_made: false,
        };
        desk.make();
        desk
    }

    /// Takes in what other threads have ready; once a frame.
    pub fn refresh(&mut self) {
        if let Some(made) = self.maker.poll() {
            self.take_made(made);
        }
        let settling = self.status() == Some(&Status::Settling);
        self.view = self.engine.as_ref().map(|engine| engine.latest());
        // Gear at rest lies elsewhere than where it was first guessed.
        self.view3d.frame_again |= settling && self.status() != Some(&Status::Settling);
    }

    /// Whether a model is in the making.
    #[must_use]
    pub fn making(&self) -> bool {
        self.maker.busy()
    }

    /// Whether texts have changed since the run's model was made.
    #[must_use]
    pub fn stale(&self) -> bool {
        self.applied.as_ref() != Some(self.book.texts())
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

    /// Problems of texts and of making the model.
    pub fn problems(&self) -> impl Iterator<Item = &Diagnostic> {
        let known = self.book.problems();
        known.iter().chain(self.make_problems.iter().filter(|problem| !known.contains(problem)))
    }

    /// Sends a command to the run; false where there is none to take it.
    pub fn send(&mut self, command: Command) -> bool {
        self.engine.as_ref().is_some_and(|engine| engine.send(command))
    }

    /// Sets a field of a text and says so where that fails.
    pub fn set(&mut self, path: &str, field: &str, value: &str) {
        if let Err(error) = self.book.set(path, field, value) {
            self.notice = Some((error, true));
        }
    }

    /// Obeys an order; those about layout are left to the window.
    pub fn obey(&mut self, order: &Order) {
        match order {
            Order::Start => self.start(),
            Order::Pause => self.tell(Command::Pause),
            Order::PlayPause if self.running() => self.tell(Command::Pause),
            Order::PlayPause => self.start(),
            Order::Step => self.tell(Command::Step),
            Order::Reset => self.tell(Command::Reset),
            Order::Apply => self.make(),
            Order::Speed(speed) => self.tell(Command::Speed(*speed)),
            Order::Seek(time_s) => self.tell(Command::Seek(*time_s)),
            Order::WeakLinks => self.toggle_weak_links(),
            Order::Fly => self.toggle_fly(),
            Order::Person => self.view3d.change_person(),
            Order::NextAct => {
                let acts = self.acts().len();
                self.pilot.next_act(acts);
            }
            Order::ChooseAct(act) => self.pilot.choose_act(*act),
            Order::Save => self.save(),
            Order::SaveRecording(path) => self.tell(Command::SaveRecording(path.clone())),
            Order::Open(path) => self.open(path),
            Order::Undo => self.step_back(true),
            Order::Redo => self.step_back(false),
            Order::Show(_) | Order::Arrange(_) | Order::Commands => {}
        }
    }

    fn tell(&mut self, command: Command) {
        if !self.send(command) {
            self.notice = Some(("the run does not take commands now".into(), true));
        }
    }

    fn start(&mut self) {
        if self.stale() && !self.book.any_error() {
            self.start_when_made = true;
            self.make();
            return;
        }
        if matches!(self.status(), Some(Status::Finished | Status::Stopped(_))) {
            self.tell(Command::Reset);
        }
        self.tell(Command::Start);
    }

    /// Makes a model from the present texts, unless they have errors.
    fn make(&mut self) {
        if self.book.any_error() {
            self.start_when_made = false;
            self.notice = Some(("the gear has errors; see Problems".into(), true));
            return;
        }
        let source = Source {
            scenario_name: self.book.shown_name(Book::SCENARIO),
            scenario: self.book.text(Book::SCENARIO).unwrap_or_default().to_owned(),
            library: self.book.sources(),
            overrides: Overrides::default(),
        };
        self.making.clone_from(self.book.texts());
        if let Err(error) = self.maker.start(source, Arc::clone(&self.host), Arc::clone(&self.waker)) {
            self.notice = Some((format!("the model cannot be made: {error}"), true));
        }
    }

    fn take_made(&mut self, made: Result<Prepared, Error>) {
        self.make_problems.clear();
        let start = std::mem::take(&mut self.start_when_made);
        match made {
            Ok(prepared) => {
                self.notice = None;
                self.load(prepared);
                if start {
                    self.tell(Command::Start);
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
        self.applied = Some(std::mem::take(&mut self.making));
        self.view3d.frame_again = true;
        if self.engine.is_some() {
            self.tell(Command::Load(Box::new(prepared)));
            return;
        }
        match (self.launch)(prepared, Arc::clone(&self.waker)) {
            Ok(engine) => self.engine = Some(engine),
            Err(error) => self.notice = Some((error, true)),
        }
    }

    fn toggle_weak_links(&mut self) {
        let on = self.book.field(Book::SCENARIO, "weak_links").is_none_or(|text| text == "true");
        self.set(Book::SCENARIO, "weak_links", if on { "false" } else { "true" });
        self.make();
    }

    fn toggle_fly(&mut self) {
        self.flying = !self.flying;
        if self.flying {
            let speed = self.view.as_ref().map_or(0.5, |view| view.controls.speed);
            self.pilot.set_throttle(speed.max(0.3));
            self.view3d.go_with_whale();
        } else {
            self.view3d.follow = false;
            self.view3d.frame_again = true;
            self.tell(Command::Autopilot);
        }
    }

    fn save(&mut self) {
        self.notice = Some(match self.book.save() {
            Ok(0) => ("nothing to save".into(), false),
            Ok(1) => ("saved 1 file".into(), false),
            Ok(count) => (format!("saved {count} files"), false),
            Err(error) => (format!("not saved: {error}"), true),
        });
    }

    fn open(&mut self, path: &std::path::Path) {
        match self.book.open_scenario(path) {
            Ok(()) => self.make(),
            Err(error) => self.notice = Some((error, true)),
        }
    }

    fn step_back(&mut self, undo: bool) {
        let done = if undo { self.book.undo() } else { self.book.redo() };
        if !done {
            self.notice = Some((format!("nothing to {}", if undo { "undo" } else { "redo" }), false));
        }
    }
}
