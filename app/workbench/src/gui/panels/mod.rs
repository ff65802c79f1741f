//! The panels, each with its own file or folder and state.

pub mod assembly;
pub mod compare;
pub mod entanglement;
pub mod events;
pub mod help;
pub mod library;
pub mod map;
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
    /// The map.
    pub map: map::MapPanel,
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
    /// The panel with an id.
    pub fn get(&mut self, id: PanelId) -> &mut dyn Panel {
        match id {
            PanelId::Library => &mut self.library,
            PanelId::Assembly => &mut self.assembly,
            PanelId::Scenario => &mut self.scenario,
            PanelId::View => &mut self.view,
            PanelId::Map => &mut self.map,
            PanelId::Run => &mut self.run,
            PanelId::Tension => &mut self.tension,
            PanelId::Plots => &mut self.plots,
            PanelId::Entanglement => &mut self.entanglement,
            PanelId::Events => &mut self.events,
            PanelId::Summary => &mut self.summary,
            PanelId::Problems => &mut self.problems,
            PanelId::Help => &mut self.help,
            PanelId::Start => &mut self.start,
            PanelId::Recordings => &mut self.recordings,
            PanelId::Pad => &mut self.pad,
            PanelId::Plugins => &mut self.plugins,
            PanelId::Study => &mut self.study,
            PanelId::Results => &mut self.results,
            PanelId::Search => &mut self.search,
            PanelId::Stories => &mut self.stories,
            PanelId::Rules => &mut self.rules,
            PanelId::Pilot => &mut self.program,
            PanelId::Compare => &mut self.compare,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::any::Any;
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_id_has_its_panel() {
        let mut panels = Panels::default();
        let kinds = PanelId::ALL.iter().map(|id| (panels.get(*id) as &dyn Any).type_id());
        assert_eq!(kinds.collect::<BTreeSet<_>>().len(), PanelId::ALL.len());
    }
}
