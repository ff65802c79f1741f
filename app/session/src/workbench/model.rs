//! Models made of edited texts, of recordings and of a study's encounters, and given to the run.

use std::collections::BTreeMap;
use std::sync::Arc;

use endline_sdk::Controls;

use super::Workbench;
use super::notice::Notice;
use crate::edit::Documents;
use crate::error::Error;
use crate::live::RunCommand;
use crate::plugins::PluginUsed;
use crate::recording::replay::check_plugins;
use crate::source::{Prepared, Source};

/// Texts by path.
pub(super) type Texts = BTreeMap<String, String>;

/// What is done once a model is made.
#[derive(Default)]
pub(super) enum Then {
    /// Its run stands ready.
    #[default]
    Stay,
    /// Its run starts.
    Start,
    /// These inputs are run, on these plugins.
    Inputs(Vec<Controls>, Vec<PluginUsed>),
    /// The inputs of the run shown are run, up to the moment shown.
    Rerun,
}

/// What a run is of that is not of the texts.
#[derive(Clone, Debug)]
pub(super) struct Guest {
    /// What it is, for the user: a recording, an encounter of a study, a story.
    name: String,
    /// Version of the texts as it was loaded.
    version: u64,
}

/// A model in the making.
#[derive(Default)]
pub(super) struct Pending {
    /// The texts it is made of; empty where it is made of something else.
    texts: Texts,
    /// What it is made of, where that is something else.
    guest: Option<Guest>,
    then: Then,
    /// The notice that stood as the making began: past once the model is there. One that came since stays.
    notice: Option<Notice>,
}

/// What the model of the run shown was made of.
#[derive(Default)]
pub(super) struct Made {
    /// The texts; `None` before the first model, and where plugins have changed since.
    texts: Option<Texts>,
    /// What it was made of, where that is something else.
    guest: Option<Guest>,
    /// Whether the texts differ from those, found for a version of the texts.
    stale: std::cell::Cell<Option<(u64, bool)>>,
}

impl Made {
    /// Whether it was made of something else than the texts, such as a recording.
    pub(super) fn is_guest(&self) -> bool {
        self.guest.is_some()
    }

    /// Forgets the texts: whatever they are, the next model is another one.
    pub(super) fn forget(&mut self) {
        self.texts = None;
        self.stale.set(None);
    }
}

impl Workbench {
    /// Whether a model is in the making.
    pub fn making(&self) -> bool {
        self.run.maker.busy()
    }

    /// Whether texts have changed since the run's model was made.
    pub fn stale(&self) -> bool {
        let (documents, made) = (&self.project.documents, &self.run.made);
        let version = documents.version();
        if let Some((_, stale)) = made.stale.get().filter(|(known, _)| *known == version) {
            return stale;
        }
        let stale = !made.texts.as_ref().is_some_and(|texts| documents.same_run(texts));
        made.stale.set(Some((version, stale)));
        stale
    }

    /// Whether the run shown is of something else than the texts, and these are as they were when it was loaded.
    pub fn shows_guest(&self) -> bool {
        let version = self.project.documents.version();
        self.run.made.guest.as_ref().is_some_and(|guest| guest.version == version)
    }

    /// What the run shown is of, where that is not the scenario: a recording, an encounter of a study, a story.
    pub fn guest(&self) -> Option<&str> {
        self.run.made.guest.as_ref().map(|guest| guest.name.as_str())
    }

    /// Makes the model of the texts as they stand.
    pub(crate) fn make_model(&mut self) -> Result<(), String> {
        // Whoever has asked for a run still wants it.
        let starts = self.making() && matches!(self.run.pending.then, Then::Start);
        self.make_model_then(if starts { Then::Start } else { Then::Stay })
    }

    /// Makes the model of the texts as they stand, unless they have errors.
    pub(super) fn make_model_then(&mut self, then: Then) -> Result<(), String> {
        let documents = &self.project.documents;
        if documents.any_error() {
            self.run.pending.then = Then::Stay;
            return Err("the gear has errors; see Problems".to_owned());
        }
        let source = Source::new(
            documents.shown_name(Documents::SCENARIO),
            documents.text(Documents::SCENARIO).unwrap_or_default().to_owned(),
            self.plugins.host.with_clips(documents.sources()),
        );
        self.run.pending = Pending {
            texts: documents.texts_of_run(),
            then,
            notice: self.notice.clone(),
            ..Pending::default()
        };
        let host = Arc::clone(&self.plugins.host);
        self.make(move || source.prepare(&host))
    }

    /// Makes a model of something else than the texts, which has a name for the user.
    pub(super) fn make_guest(
        &mut self,
        name: String,
        then: Then,
        make: impl FnOnce() -> Result<Prepared, Error> + Send + 'static,
    ) -> Result<(), String> {
        let guest = Some(Guest { name, version: self.project.documents.version() });
        self.run.pending =
            Pending { guest, then, notice: self.notice.clone(), ..Pending::default() };
        self.make(make)
    }

    fn make(
        &mut self,
        make: impl FnOnce() -> Result<Prepared, Error> + Send + 'static,
    ) -> Result<(), String> {
        let started = self.run.maker.start_with(make, Arc::clone(&self.waker));
        started.map_err(|error| format!("the model cannot be made: {error}"))
    }

    /// Takes in a model that is ready.
    pub(super) fn take_model(&mut self) {
        let Some(made) = self.run.maker.poll() else { return };
        let pending = std::mem::take(&mut self.run.pending);
        self.project.model_problems.clear();
        let loaded = match made {
            Ok(prepared) => self.load(prepared, pending),
            Err(Error::Diagnostics(problems)) => {
                self.project.model_problems = problems;
                self.project.model_texts = pending.texts;
                Err("the model cannot be made; see Problems".to_owned())
            }
            Err(error) => Err(error.to_string()),
        };
        if let Err(reason) = loaded {
            self.notice = Some(Notice::fault(reason));
        }
    }

    /// Gives a model to the run, and what comes then.
    fn load(&mut self, prepared: Prepared, pending: Pending) -> Result<(), String> {
        if let Then::Inputs(_, plugins) = &pending.then {
            check_plugins(plugins, &prepared.plugins).map_err(|error| error.to_string())?;
        }
        if self.notice == pending.notice {
            self.notice = None;
        }
        self.keep_run();
        self.run.made.texts = Some(pending.texts);
        self.run.made.stale.set(None);
        self.run.made.guest = pending.guest;
        self.launch(prepared, matches!(pending.then, Then::Rerun))?;
        match pending.then {
            Then::Stay | Then::Rerun => Ok(()),
            Then::Start => self.send(RunCommand::Start),
            Then::Inputs(inputs, _) => {
                self.run.is_kept = true;
                self.send(RunCommand::Inputs(inputs))
            }
        }
    }

    /// Runs a model on the thread that is there, or on a new one where there is none or the plugins have changed.
    fn launch(&mut self, prepared: Prepared, rerun: bool) -> Result<(), String> {
        if std::mem::take(&mut self.run.other_plugins) {
            self.run.engine = None;
        }
        if self.run.engine.is_some() {
            let command = if rerun { RunCommand::Rerun } else { RunCommand::Load };
            return self.send(command(Box::new(prepared)));
        }
        let (host, waker) = self.helpers();
        self.run.engine = Some((self.run.launch)(prepared, host, waker)?);
        Ok(())
    }
}
