//! What a panel is, and the id and title of every panel.

use egui::Ui;

use crate::gui::shared::Shared;

/// Id and title of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelId {
    id: &'static str,
    title: &'static str,
}

impl PanelId {
    /// Tables of the gear library.
    pub const LIBRARY: Self = Self::new("library", "Library");
    /// Parts of an assembly, and its statics drawn to scale.
    pub const ASSEMBLY: Self = Self::new("assembly", "Assembly");
    /// Fields of the scenario: sea, whale, weak links, run.
    pub const SCENARIO: Self = Self::new("scenario", "Scenario");
    /// The 3-D view.
    pub const VIEW: Self = Self::new("view", "3-D view");
    /// Start, pause and speed of a run; figures of the solver.
    pub const RUN: Self = Self::new("run", "Run");
    /// Tension over time.
    pub const TENSION: Self = Self::new("tension", "Tension");
    /// Tension, force, wraps, depth and speed over time.
    pub const PLOTS: Self = Self::new("plots", "Plots");
    /// Rope on the whale's body, and the outcome of the run.
    pub const ENTANGLEMENT: Self = Self::new("entanglement", "Entanglement");
    /// Events of the run, with their times.
    pub const EVENTS: Self = Self::new("events", "Events");
    /// Outcome and loads by part of the whale.
    pub const SUMMARY: Self = Self::new("summary", "Summary");
    /// Errors and warnings of all files.
    pub const PROBLEMS: Self = Self::new("problems", "Problems");
    /// Keys and pad.
    pub const HELP: Self = Self::new("help", "Keys and help");
    /// Recent files and examples.
    pub const START: Self = Self::new("start", "Start");
    /// Recorded runs.
    pub const RECORDINGS: Self = Self::new("recordings", "Recordings");
    /// Assignment of sticks, triggers and buttons of the pad.
    pub const PAD: Self = Self::new("pad", "Pad");
    /// Motions, friction laws and gear types.
    pub const PLUGINS: Self = Self::new("plugins", "Plugins");
    /// The designer of a study, and the queue.
    pub const STUDY: Self = Self::new("study", "Study");
    /// Results of a study.
    pub const RESULTS: Self = Self::new("results", "Results");
    /// An observation on a whale, and the search for encounters that end like it.
    pub const SEARCH: Self = Self::new("search", "Search");
    /// Results of a search.
    pub const STORIES: Self = Self::new("stories", "Stories");
    /// Rules of law checked on an assembly, and edits by which it would comply.
    pub const RULES: Self = Self::new("rules", "Rules");
    /// The pilot program as a timeline.
    pub const PROGRAM: Self = Self::new("pilot", "Pilot program");
    /// Two runs side by side.
    pub const COMPARE: Self = Self::new("compare", "Compare");

    /// All panels, in the order of the Window menu.
    pub const ALL: [Self; 23] = [
        Self::LIBRARY,
        Self::ASSEMBLY,
        Self::SCENARIO,
        Self::VIEW,
        Self::RUN,
        Self::TENSION,
        Self::PLOTS,
        Self::ENTANGLEMENT,
        Self::EVENTS,
        Self::SUMMARY,
        Self::PROBLEMS,
        Self::HELP,
        Self::START,
        Self::RECORDINGS,
        Self::PAD,
        Self::PLUGINS,
        Self::STUDY,
        Self::RESULTS,
        Self::SEARCH,
        Self::STORIES,
        Self::RULES,
        Self::PROGRAM,
        Self::COMPARE,
    ];

    const fn new(id: &'static str, title: &'static str) -> Self {
        Self { id, title }
    }

    /// Its id in saved layouts, which never changes.
    pub fn id(self) -> &'static str {
        self.id
    }

    /// Title of its tab.
    pub fn title(self) -> &'static str {
        self.title
    }

    /// Finds the panel with an id.
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|panel| panel.id == id)
    }
}

/// A panel of the window. It owns its state and reads everything else from [`Shared`].
///
/// A panel never names another one: it gives a command, and the window passes the command to the panel concerned.
pub trait Panel {
    /// Its id.
    fn id(&self) -> PanelId;

    /// Title of its tab.
    fn title(&self) -> &'static str {
        self.id().title()
    }

    /// Draws it.
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared);
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn ids_are_unique() {
        for panel in PanelId::ALL {
            assert_eq!(PanelId::find(panel.id()), Some(panel));
        }
    }
}
