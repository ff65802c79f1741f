//! Plugins loaded again, tried, and put into the scenario.

use std::path::Path;
use std::sync::Arc;

use endline_session::edit::Documents;
use endline_session::plugins::{PluginInfo, PluginKind};

use super::super::plugins::{Change, open_folder};
use super::{Desk, Order};

impl Desk {
    /// Every plugin, those switched off too, each with whether it is on; by kind and then by name.
    #[must_use]
    pub fn every_plugin(&self) -> Vec<(PluginInfo, bool)> {
        let (on, off) = (
            self.host.list().iter().map(|info| (info, true)),
            self.host.switched_off().iter().map(|info| (info, false)),
        );
        let mut all: Vec<(PluginInfo, bool)> =
            on.chain(off).map(|(info, on)| (info.clone(), on)).collect();
        all.sort_by(|(a, _), (b, _)| (a.kind, &a.name).cmp(&(b.kind, &b.name)));
        all
    }

    /// Plugins loaded, tried and put to use by one order.
    pub(super) fn obey_plugins(&mut self, order: &Order) {
        match order {
            Order::ReloadPlugins => self.reload_plugins(Change::None),
            Order::AllowPlugin(file, hash) => {
                self.reload_plugins(Change::Allow(file.clone(), hash.clone()))
            }
            Order::SwitchPlugin(id, on) => self.reload_plugins(Change::Switch(id.clone(), *on)),
            Order::CheckPlugin(file) => self.check_plugin(file),
            Order::UsePlugin(id) => self.use_plugin(id),
            Order::OpenFolder(folder) => self.open_folder(folder),
            _ => {}
        }
    }

    fn reload_plugins(&mut self, change: Change) {
        if let Err(error) = self.plugins.reload(change, Arc::clone(&self.waker)) {
            self.notice = Some((format!("plugins cannot be loaded: {error}"), true));
        }
    }

    /// Takes in plugins that were loaded again: a model is made with them, at once or when the run under way is over.
    pub(super) fn take_plugins(&mut self) {
        let Some((host, fault)) = self.plugins.poll() else { return };
        let told = |host: &endline_session::PluginHost| -> Vec<_> {
            host.list().iter().map(|info| (info.id.clone(), info.hash.clone())).collect()
        };
        let changed = told(&host) != told(&self.host);
        self.host = Arc::new(host);
        let waiting = self.running();
        let notice = match (&fault, changed, waiting) {
            (Some(fault), _, _) => fault.clone(),
            (None, false, _) => "plugins loaded again; none has changed".to_owned(),
            (None, true, false) => "plugins loaded again".to_owned(),
            (None, true, true) => "plugins loaded again; the next run uses them".to_owned(),
        };
        if changed {
            // The next model goes to a run with the new plugins.
            self.applied = None;
            self.stale.set(None);
            self.other_plugins = true;
            // While a question stands open, the model would lack what is asked about.
            if !waiting && !self.documents.any_error() && self.plugins.asked().is_none() {
                self.make();
            }
        }
        self.notice = Some((notice, fault.is_some()));
    }

    fn check_plugin(&mut self, file: &Path) {
        if let Err(error) = self.plugins.check(file, Arc::clone(&self.waker)) {
            self.notice = Some((error, true));
        }
    }

    fn open_folder(&mut self, folder: &Path) {
        if let Err(error) = open_folder(folder) {
            self.notice = Some((error, true));
        }
    }

    /// The table of the scenario whose plugin this kind is, and its key; none for kinds that a scenario does not name itself.
    #[must_use]
    pub fn place_of(kind: PluginKind) -> Option<(&'static str, &'static str)> {
        match kind {
            PluginKind::Motion => Some(("whale", "motion")),
            PluginKind::Friction => Some(("friction", "model")),
            PluginKind::Gear | PluginKind::Clips => None,
        }
    }

    /// Whether the scenario names a motion or a law of friction.
    #[must_use]
    pub fn uses_plugin(&self, info: &PluginInfo) -> bool {
        let named = |(table, key): (&str, &str)| {
            self.documents.field(Documents::SCENARIO, &format!("{table}.{key}"))
        };
        Self::place_of(info.kind).and_then(named).is_some_and(|id| id == info.id)
    }

    /// Puts a motion or a law of friction into the scenario; attributes of the one before go.
    fn use_plugin(&mut self, id: &str) {
        let kind =
            self.every_plugin().iter().find(|(info, _)| info.id == id).map(|(info, _)| info.kind);
        let Some((table, key)) = kind.and_then(Self::place_of) else { return };
        let attributes = format!("{table}.attributes");
        let put = self.documents.alter(Documents::SCENARIO, |document| {
            if document.has(&attributes) {
                document.remove(&attributes).map_err(|error| error.to_string())?;
            }
            document.set(&format!("{table}.{key}"), id).map_err(|error| error.to_string())
        });
        if let Err(error) = put {
            self.notice = Some((error, true));
        }
    }
}
