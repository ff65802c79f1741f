//! The panels, each with its own file or folder and state.

mod about;
pub mod assembly;
pub mod compare;
pub mod entanglement;
pub mod events;
pub mod help;
pub mod library;
pub mod pad;
pub mod pilot;
pub mod plots;
pub mod plugins;
pub mod problems;
pub mod recordings;
pub mod results;
pub mod rules;
pub mod run;
pub mod scenario;
pub mod search;
pub mod start;
pub mod stories;
pub mod study;
pub mod summary;
pub mod view;

use super::panel::{Panel, PanelId};

/// All panels of the window.
#[derive(Default)]
pub struct Panels {
    /// Tables of the gear library.
    pub library: library::LibraryPanel,
    /// Parts of an assembly and its statics.
    pub assembly: assembly::AssemblyPanel,
    /// Fields of the scenario.
    pub scenario: scenario::ScenarioPanel,
    /// The 3-D view.
    pub view: view::ViewPanel,
    /// Controls of the run.
    pub run: run::RunPanel,
    /// Tension over time.
    pub tension: plots::TensionPanel,
    /// Plots of the run.
    pub plots: plots::PlotsPanel,
    /// Rope on the whale's body.
    pub entanglement: entanglement::EntanglementPanel,
    /// Events.
    pub events: events::EventsPanel,
    /// Outcome and loads.
    pub summary: summary::SummaryPanel,
    /// Problems of the files.
    pub problems: problems::ProblemsPanel,
    /// Keys and pad.
    pub help: help::HelpPanel,
    /// Start page.
    pub start: start::StartPanel,
    /// Recordings.
    pub recordings: recordings::RecordingsPanel,
    /// Assignment of the pad.
    pub pad: pad::PadPanel,
    /// The plugins.
    pub plugins: plugins::PluginsPanel,
    /// Designer of a study.
    pub study: study::StudyPanel,
    /// Results of a study.
    pub results: results::ResultsPanel,
    /// An observation and its search.
    pub search: search::SearchPanel,
    /// Results of a search.
    pub stories: stories::StoriesPanel,
    /// Rules checked on an assembly.
    pub rules: rules::RulesPanel,
    /// The pilot program on a timeline.
    pub program: pilot::PilotPanel,
    /// Comparison of two runs.
    pub compare: compare::ComparePanel,
}

impl Panels {
    /// All panels, in the order of [`PanelId::ALL`].
    pub fn all(&mut self) -> [&mut dyn Panel; PanelId::ALL.len()] {
        [
            &mut self.library,
            &mut self.assembly,
            &mut self.scenario,
            &mut self.view,
            &mut self.run,
            &mut self.tension,
            &mut self.plots,
            &mut self.entanglement,
            &mut self.events,
            &mut self.summary,
            &mut self.problems,
            &mut self.help,
            &mut self.start,
            &mut self.recordings,
            &mut self.pad,
            &mut self.plugins,
            &mut self.study,
            &mut self.results,
            &mut self.search,
            &mut self.stories,
            &mut self.rules,
            &mut self.program,
            &mut self.compare,
        ]
    }

    /// Finds a panel by its id.
    pub fn find(&mut self, id: &str) -> Option<&mut dyn Panel> {
        self.all().into_iter().find(|panel| panel.id().id() == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_id_has_its_panel() {
        let ids: Vec<PanelId> = Panels::default().all().map(|panel| panel.id()).to_vec();
        assert_eq!(ids, PanelId::ALL);
    }
}
