//! The panels of the window: their trait, and their names as layouts and commands use them.

use egui::Ui;

use crate::gui::shared::Shared;

/// Names a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelId {
    id: &'static str,
    title: &'static str,
}

impl PanelId {
    /// Tables of the gear library.
    pub const LIBRARY: Self = Self::new("library", "Library");
    /// A rig's parts, its statics drawn to scale.
    pub const ASSEMBLY: Self = Self::new("assembly", "Assembly");
    /// What happens: scenario, current, whale, weak links.
    pub const SCENARIO: Self = Self::new("scenario", "Scenario");
    /// The 3-D view.
    pub const VIEW: Self = Self::new("view", "3-D view");
    /// Start, pause, speed; figures of the solver.
    pub const RUN: Self = Self::new("run", "Run");
    /// Tension over time.
    pub const TENSION: Self = Self::new("tension", "Tension");
    /// Tension, force, wraps, depth and speed.
    pub const PLOTS: Self = Self::new("plots", "Plots");
    /// Rope on the whale's body, and the outcome.
    pub const ENTANGLEMENT: Self = Self::new("entanglement", "Entanglement");
    /// What happened when.
    pub const EVENTS: Self = Self::new("events", "Events");
    /// Outcome and loads by part of the whale.
    pub const SUMMARY: Self = Self::new("summary", "Summary");
    /// Everything wrong with the files.
    pub const PROBLEMS: Self = Self::new("problems", "Problems");
    /// Keys and pad.
    pub const HELP: Self = Self::new("help", "Keys and help");
    /// What was open last, and examples.
    pub const START: Self = Self::new("start", "Start");
    /// Runs that were kept.
    pub const RECORDINGS: Self = Self::new("recordings", "Recordings");
    /// What the pad does.
    pub const PAD: Self = Self::new("pad", "Pad");
    /// Motions, friction laws and gear types.
    pub const PLUGINS: Self = Self::new("plugins", "Plugins");
    /// The designer of a study, and the queue.
    pub const STUDY: Self = Self::new("study", "Study");
    /// What a study found.
    pub const RESULTS: Self = Self::new("results", "Results");
    /// What was seen on a whale, and the search for encounters that end like it.
    pub const SEARCH: Self = Self::new("search", "Search");
    /// What a search found.
    pub const STORIES: Self = Self::new("stories", "Stories");
    /// What laws ask of an assembly, and edits by which it would comply.
    pub const RULES: Self = Self::new("rules", "Rules");
    /// The pilot program on a timeline.
    pub const PROGRAM: Self = Self::new("pilot", "Pilot program");
    /// Two runs beside one another.
    pub const COMPARE: Self = Self::new("compare", "Compare");

    /// Every panel, in the order of the Window menu.
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

    /// Its stable id in saved layouts.
    #[must_use]
    pub fn id(self) -> &'static str {
        self.id
    }

    /// Its title.
    #[must_use]
    pub fn title(self) -> &'static str {
        self.title
    }

    /// The panel of an id.
    #[must_use]
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|panel| panel.id == id)
    }
}

/// A panel of the window. It owns its state and reads what all panels share from the shared.
///
/// A panel never names another one. Where it wants something of another, it leaves an order on the shared, and the window
/// hands that order to the panel it concerns.
pub trait Panel {
    /// Which panel it is.
    fn id(&self) -> PanelId;

    /// The title of its tab.
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
    fn each_id_leads_to_its_own_panel() {
        for panel in PanelId::ALL {
            assert_eq!(PanelId::find(panel.id()), Some(panel));
        }
    }
}
