//! Plugins while the window is open: loaded again, allowed, switched off and checked, each on a thread of its own.
//!
//! What is loaded anew counts from the next run on; a run under way keeps the plugins it began with.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use endline_session::PluginHost;
use endline_session::plugins::{Ask, Loader, PluginProblem, Standing, report_of_child};

use endline_session::task::Waker;

/// How long a file may take to be tried.
const PATIENCE: Duration = Duration::from_secs(30);

/// Loads the plugins of a loader's folders.
pub type Load = Arc<dyn Fn(&mut Loader) -> (PluginHost, Vec<PluginProblem>) + Send + Sync>;

/// What is to be done before plugins are loaded again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
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

/// What is known of plugins, and what is under way with them.
#[derive(Default)]
pub struct Plugins {
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
    /// With a loader and how it loads.
    #[must_use]
    pub fn new(loader: Loader, load: Load, problems: Vec<PluginProblem>) -> Self {
        Self { problems, loader: Some((Arc::new(Mutex::new(loader)), load)), ..Self::default() }
    }

    /// Whether something is being loaded or checked.
    #[must_use]
    pub fn busy(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Folders searched.
    #[must_use]
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
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn reload(&mut self, change: Change, waker: Waker) -> Result<(), String> {
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
    ///
    /// # Errors
    /// Where the system gives no thread, or the program cannot find itself.
    pub fn check(&mut self, file: &Path, waker: Waker) -> Result<(), String> {
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
            // Nobody waits any more where the window is gone.
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

    /// Takes in what threads have ready: a new host, where plugins were loaded again, and what to tell.
    pub fn poll(&mut self) -> Option<(PluginHost, Option<String>)> {
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
    #[must_use]
    pub fn asked(&self) -> Option<(PathBuf, Ask)> {
        let mut waiting = self.waiting().filter(|(_, ask)| !self.later.contains(&ask.hash));
        waiting.next().map(|(file, ask)| (file.clone(), ask.clone()))
    }

    /// Leaves a library out for now.
    pub fn put_off(&mut self, ask: &Ask) {
        self.later.insert(ask.hash.clone());
    }
}

/// Shows a folder in the system's file manager.
///
/// # Errors
/// Where there is no program that does.
pub fn open_folder(folder: &Path) -> Result<(), String> {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let opened = std::process::Command::new(program).arg(folder).spawn();
    opened
        .map(|_| ())
        .map_err(|error| format!("{}: {program} cannot show it: {error}", folder.display()))
}
