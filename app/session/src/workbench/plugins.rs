//! Plugins while the workbench is open: loaded again, allowed, switched off and checked, each on a thread of its own.
//!
//! What is loaded anew counts from the next run on; a run under way keeps the plugins it began with.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::Workbench;
use super::notice::Notice;
use crate::edit::Documents;
use crate::plugins::{
    Ask, Loader, PluginHost, PluginInfo, PluginKind, PluginProblem, Standing, report_of_child,
};
use crate::task::Waker;

/// How long a file may take to be tried.
const PATIENCE: Duration = Duration::from_secs(30);

/// Loads the plugins of a loader's folders.
pub type Load = Arc<dyn Fn(&mut Loader) -> (PluginHost, Vec<PluginProblem>) + Send + Sync>;

/// What is to be done before plugins are loaded again.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Change {
    /// Nothing.
    None,
    /// A file is allowed with the bytes of this hash.
    Allow(PathBuf, String),
    /// A plugin is switched on or off.
    Switch(String, bool),
}

/// What a check said of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Line by line.
    pub text: String,
    /// What is wrong, where anything is.
    pub fault: Option<String>,
}

/// What a thread has ready.
enum Answer {
    Loaded(PluginHost, Vec<PluginProblem>, Option<String>),
    Checked(PathBuf, Report),
}

/// A plugin, and whether it is on.
#[derive(Clone, Debug)]
pub struct Switchable {
    /// The plugin.
    pub info: PluginInfo,
    /// Whether it is on.
    pub on: bool,
}

/// Plugins in use, those that are not used and why, and checks of them.
pub struct Plugins {
    /// The plugins in use.
    pub(super) host: Arc<PluginHost>,
    /// Files and plugins that are not used, and why.
    pub problems: Vec<PluginProblem>,
    /// What checks said, by file.
    pub reports: BTreeMap<PathBuf, Report>,
    /// Times that plugins were loaded again.
    pub reloads: u64,
    loader: Option<(Arc<Mutex<Loader>>, Load)>,
    later: BTreeSet<String>,
    pending: Vec<Receiver<Answer>>,
}

impl Plugins {
    /// Plugins that cannot be loaded again.
    pub fn new(host: Arc<PluginHost>) -> Self {
        Self {
            host,
            problems: Vec::new(),
            reports: BTreeMap::new(),
            reloads: 0,
            loader: None,
            later: BTreeSet::new(),
            pending: Vec::new(),
        }
    }

    /// Lets plugins be loaded again by a loader; `problems` are those of the first time.
    pub fn load_with(&mut self, loader: Loader, load: Load, problems: Vec<PluginProblem>) {
        self.problems = problems;
        self.loader = Some((Arc::new(Mutex::new(loader)), load));
    }

    /// Whether plugins can be loaded again.
    pub fn has_loader(&self) -> bool {
        self.loader.is_some()
    }

    /// Every plugin, those switched off too; by kind and then by name.
    pub fn every(&self) -> Vec<Switchable> {
        let switchable = |info: &PluginInfo, on: bool| Switchable { info: info.clone(), on };
        let on = self.host.list().iter().map(|info| switchable(info, true));
        let off = self.host.switched_off().iter().map(|info| switchable(info, false));
        let mut all: Vec<Switchable> = on.chain(off).collect();
        all.sort_by(|a, b| (a.info.kind, &a.info.name).cmp(&(b.info.kind, &b.info.name)));
        all
    }

    /// Whether something is being loaded or checked.
    pub fn busy(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Folders searched.
    pub fn folders(&self) -> Vec<PathBuf> {
        let folders = |loader: &Mutex<Loader>| {
            loader.lock().unwrap_or_else(PoisonError::into_inner).folders.clone()
        };
        self.loader
            .as_ref()
            .filter(|_| !self.busy())
            .map_or_else(Vec::new, |(loader, _)| folders(loader))
    }

    /// Makes a change and loads again what has changed.
    /// Errors: where the system gives no thread.
    fn reload(&mut self, change: Change, waker: Waker) -> Result<(), String> {
        let Some((loader, load)) = self.loader.clone() else {
            return Err("there are no folders of plugins here".into());
        };
        self.work(waker, move || {
            let mut loader = loader.lock().unwrap_or_else(PoisonError::into_inner);
            let kept = match change {
                Change::None => Ok(()),
                Change::Allow(file, hash) => loader.choices.allow(&file, &hash),
                Change::Switch(id, on) => loader.choices.switch(&id, on),
            };
            let (host, problems) = load(&mut loader);
            Answer::Loaded(host, problems, kept.err())
        })
    }

    /// Tries a file in a child process.
    /// Errors: where the system gives no thread, or the program cannot find itself.
    fn check(&mut self, file: &Path, waker: Waker) -> Result<(), String> {
        let program = std::env::current_exe()
            .map_err(|error| format!("the program cannot find itself to check it: {error}"))?;
        let file = file.to_path_buf();
        self.work(waker, move || {
            // A plugin without code is checked as the folder that it is.
            let tried = if file.ends_with(endline_gear::PLUGIN_FILE) {
                file.parent().unwrap_or(&file)
            } else {
                &file
            };
            let (text, verdict) = report_of_child(&program, tried, PATIENCE);
            Answer::Checked(file, Report { text, fault: verdict.err() })
        })
    }

    fn work(
        &mut self,
        waker: Waker,
        work: impl FnOnce() -> Answer + Send + 'static,
    ) -> Result<(), String> {
        let (sender, receiver) = channel();
        let work = move || {
            // The receiver is gone if the workbench has closed.
            let _ = sender.send(work());
            waker();
        };
        std::thread::Builder::new()
            .name("endline-plugins".into())
            .spawn(work)
            .map_err(|error| error.to_string())?;
        self.pending.push(receiver);
        Ok(())
    }

    /// Receives the results of threads: a new host, if plugins were loaded again, and a notice.
    fn poll(&mut self) -> Option<(PluginHost, Option<String>)> {
        let mut answers = Vec::new();
        self.pending.retain(|pending| match pending.try_recv() {
            Ok(answer) => {
                answers.push(answer);
                false
            }
            Err(TryRecvError::Empty) => true,
            Err(TryRecvError::Disconnected) => false,
        });
        let mut fresh = None;
        for answer in answers {
            match answer {
                Answer::Loaded(host, problems, fault) => {
                    self.problems = problems;
                    self.reloads += 1;
                    fresh = Some((host, fault));
                }
                Answer::Checked(file, report) => {
                    self.reports.insert(file, report);
                }
            }
        }
        fresh
    }

    /// Libraries that wait for their user.
    pub fn waiting(&self) -> impl Iterator<Item = (&PathBuf, &Ask)> {
        self.problems.iter().filter_map(|problem| match &problem.standing {
            Standing::Waiting(ask) => Some((&problem.file, &**ask)),
            Standing::Unusable | Standing::SetAside => None,
        })
    }

    /// The first that was not put off.
    pub fn asked(&self) -> Option<(PathBuf, Ask)> {
        let mut waiting = self.waiting().filter(|(_, ask)| !self.later.contains(&ask.hash));
        waiting.next().map(|(file, ask)| (file.clone(), ask.clone()))
    }

    /// Leaves a library out for now.
    pub fn put_off(&mut self, ask: &Ask) {
        self.later.insert(ask.hash.clone());
    }
}

/// The table of the scenario whose plugin a kind is, and its key; none for kinds that a scenario does not name itself.
pub fn place_of(kind: PluginKind) -> Option<(&'static str, &'static str)> {
    match kind {
        PluginKind::Motion => Some(("whale", "motion")),
        PluginKind::Friction => Some(("friction", "model")),
        PluginKind::Gear | PluginKind::Clips => None,
    }
}

impl Workbench {
    pub(crate) fn reload_plugins(&mut self) -> Result<(), String> {
        self.change_plugins(Change::None)
    }

    pub(crate) fn allow_plugin(&mut self, file: PathBuf, hash: String) -> Result<(), String> {
        self.change_plugins(Change::Allow(file, hash))
    }

    pub(crate) fn switch_plugin(&mut self, id: String, on: bool) -> Result<(), String> {
        self.change_plugins(Change::Switch(id, on))
    }

    fn change_plugins(&mut self, change: Change) -> Result<(), String> {
        let reloaded = self.plugins.reload(change, Arc::clone(&self.waker));
        reloaded.map_err(|error| format!("plugins cannot be loaded: {error}"))
    }

    pub(crate) fn check_plugin(&mut self, file: &Path) -> Result<(), String> {
        self.plugins.check(file, Arc::clone(&self.waker))
    }

    /// Takes in plugins that were loaded again: a model is made with them, at once or when the run under way is over.
    pub(super) fn take_plugins(&mut self) {
        let Some((host, fault)) = self.plugins.poll() else { return };
        let hashes = |host: &PluginHost| -> Vec<_> {
            host.list().iter().map(|info| (info.id.clone(), info.hash.clone())).collect()
        };
        let changed = hashes(&host) != hashes(&self.plugins.host);
        self.plugins.host = Arc::new(host);
        let waiting = self.running();
        self.notice = Some(match (fault, changed, waiting) {
            (Some(fault), _, _) => Notice::fault(fault),
            (None, false, _) => Notice::done("plugins loaded again; none has changed"),
            (None, true, false) => Notice::done("plugins loaded again"),
            (None, true, true) => Notice::done("plugins loaded again; the next run uses them"),
        });
        if changed {
            self.use_other_plugins(waiting);
        }
    }

    /// The next model goes to a run with the new plugins.
    fn use_other_plugins(&mut self, waiting: bool) {
        self.run.made.forget();
        self.run.other_plugins = true;
        // While a question stands open, the model would lack what is asked about.
        let asked = self.plugins.asked().is_some();
        if waiting || asked || self.project.documents.any_error() {
            return;
        }
        if let Err(reason) = self.make_model() {
            self.notice = Some(Notice::fault(reason));
        }
    }

    /// Whether the scenario names a motion or a law of friction.
    pub fn uses_plugin(&self, info: &PluginInfo) -> bool {
        let documents = &self.project.documents;
        let named = |(table, key): (&str, &str)| {
            documents.field(Documents::SCENARIO, &format!("{table}.{key}"))
        };
        place_of(info.kind).and_then(named).is_some_and(|id| id == info.id)
    }

    /// Plugins that the scenario can name and does not.
    pub fn usable_plugins(&self) -> Vec<PluginInfo> {
        let has_whale = self.project.has_whale();
        let usable = |plugin: &Switchable| {
            let place = place_of(plugin.info.kind);
            let there = place.is_some_and(|(table, _)| table != "whale" || has_whale);
            plugin.on && there && !self.uses_plugin(&plugin.info)
        };
        self.plugins.every().into_iter().filter(usable).map(|plugin| plugin.info).collect()
    }

    /// Puts a motion or a law of friction into the scenario; attributes of the one before go.
    pub(crate) fn use_plugin(&mut self, id: &str) -> Result<(), String> {
        let every = self.plugins.every();
        let known = every.iter().find(|plugin| plugin.info.id == id);
        let Some((table, key)) = known.and_then(|plugin| place_of(plugin.info.kind)) else {
            return Err(format!("{id} is no motion and no law of friction"));
        };
        let attributes = format!("{table}.attributes");
        self.project.documents.alter(Documents::SCENARIO, |document| {
            if document.has(&attributes) {
                document.remove(&attributes).map_err(|error| error.to_string())?;
            }
            document.set(&format!("{table}.{key}"), id).map_err(|error| error.to_string())
        })
    }
}
