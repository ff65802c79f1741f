//! Panels, their stable ids, and the named layouts.

use egui_dock::{DockState, NodeIndex};

/// A panel; its id is what a saved layout holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// Tables of the gear library.
    Library,
    /// A rig's parts, its statics drawn to scale.
    Assembly,
    /// What happens: scenario, current, whale, weak links.
    Scenario,
    /// The 3-D view.
    View,
    /// Start, pause, speed; how the run does.
    Run,
    /// Tension over time.
    Tension,
    /// Tension, force, wraps, depth and speed.
    Plots,
    /// Rope on the whale's body, and the outcome.
    Entanglement,
    /// What happened when.
    Events,
    /// Outcome and loads by part of the whale.
    Summary,
    /// Everything wrong with the files.
    Problems,
    /// Keys and pad.
    Help,
    /// What was open last, and examples.
    Start,
    /// Runs that were kept.
    Recordings,
    /// What the pad does.
    Pad,
    /// Motions, laws of friction and gear types.
    Plugins,
    /// The designer of a study, and the queue.
    Study,
    /// What a study found.
    Results,
    /// The pilot program on a timeline.
    Program,
    /// Two runs beside one another.
    Compare,
}

impl Panel {
    /// Every panel, in the order of the Window menu.
    pub const ALL: [Self; 20] = [
        Self::Library,
        Self::Assembly,
        Self::Scenario,
        Self::View,
        Self::Run,
        Self::Tension,
        Self::Plots,
        Self::Entanglement,
        Self::Events,
        Self::Summary,
        Self::Problems,
        Self::Help,
        Self::Start,
        Self::Recordings,
        Self::Pad,
        Self::Plugins,
        Self::Study,
        Self::Results,
        Self::Program,
        Self::Compare,
    ];

    /// Its stable id in saved layouts.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Library => "library",
            Self::Assembly => "assembly",
            Self::Scenario => "scenario",
            Self::View => "view",
            Self::Run => "run",
            Self::Tension => "tension",
            Self::Plots => "plots",
            Self::Entanglement => "entanglement",
            Self::Events => "events",
            Self::Summary => "summary",
            Self::Problems => "problems",
            Self::Help => "help",
            Self::Start => "start",
            Self::Recordings => "recordings",
            Self::Pad => "pad",
            Self::Plugins => "plugins",
            Self::Study => "study",
            Self::Results => "results",
            Self::Program => "pilot",
            Self::Compare => "compare",
        }
    }

    /// Its title.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Library => "Library",
            Self::Assembly => "Assembly",
            Self::Scenario => "Scenario",
            Self::View => "3-D view",
            Self::Run => "Run",
            Self::Tension => "Tension",
            Self::Plots => "Plots",
            Self::Entanglement => "Entanglement",
            Self::Events => "Events",
            Self::Summary => "Summary",
            Self::Problems => "Problems",
            Self::Help => "Keys and help",
            Self::Start => "Start",
            Self::Recordings => "Recordings",
            Self::Pad => "Pad",
            Self::Plugins => "Plugins",
            Self::Study => "Study",
            Self::Results => "Results",
            Self::Program => "Pilot program",
            Self::Compare => "Compare",
        }
    }

    /// The panel of an id.
    #[must_use]
    pub fn of_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|panel| panel.id() == id)
    }
}

/// A named arrangement of panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Edit gear, run, compare.
    Design,
    /// The view large, the pilot's controls at hand.
    Fly,
    /// Look at what happened.
    Review,
    /// Compare options on the same encounters: designer and queue, what was found, any run again.
    Study,
}

impl Layout {
    /// Every layout, in the order of the menu.
    pub const ALL: [Self; 4] = [Self::Design, Self::Fly, Self::Review, Self::Study];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Design => "Design",
            Self::Fly => "Fly",
            Self::Review => "Review",
            Self::Study => "Study",
        }
    }

    /// Its panels in place.
    #[must_use]
    pub fn dock(self) -> DockState<String> {
        use Panel::{
            Assembly, Compare, Entanglement, Events, Library, Pad, Plots, Problems, Program,
            Recordings, Results, Run, Scenario, Study, Summary, Tension, View,
        };
        let first = match self {
            Self::Design => ids(&[View, Assembly]),
            Self::Study => ids(&[Results]),
            Self::Fly | Self::Review => ids(&[View]),
        };
        let mut dock = DockState::new(first);
        let tree = dock.main_surface_mut();
        match self {
            Self::Design => {
                let [upper, _] =
                    tree.split_below(NodeIndex::root(), 0.66, ids(&[Library, Problems]));
                let [middle, _] = tree.split_left(upper, 0.2, ids(&[Scenario]));
                let [_, right] = tree.split_right(middle, 0.7, ids(&[Run]));
                tree.split_below(right, 0.5, ids(&[Tension, Summary, Events]));
            }
            Self::Fly => {
                let [_, right] =
                    tree.split_right(NodeIndex::root(), 0.78, ids(&[Run, Scenario, Pad]));
                let [_, below] = tree.split_below(right, 0.42, ids(&[Tension]));
                tree.split_below(below, 0.5, ids(&[Events, Summary]));
            }
            Self::Review => {
                let [upper, lower] =
                    tree.split_below(NodeIndex::root(), 0.55, ids(&[Plots, Program]));
                tree.split_right(upper, 0.6, ids(&[Entanglement, Summary]));
                tree.split_right(lower, 0.66, ids(&[Events, Run, Recordings, Compare]));
            }
            Self::Study => {
                let [right, _] =
                    tree.split_left(NodeIndex::root(), 0.36, ids(&[Study, Library, Problems]));
                let [_, below] = tree.split_below(right, 0.52, ids(&[View, Plots]));
                tree.split_right(below, 0.62, ids(&[Summary, Entanglement, Events]));
            }
        }
        dock
    }
}

fn ids(panels: &[Panel]) -> Vec<String> {
    panels.iter().map(|panel| panel.id().to_owned()).collect()
}

/// Brings a panel to the front, adding it where it is closed.
pub fn open(dock: &mut DockState<String>, panel: Panel) {
    let id = panel.id().to_owned();
    match dock.find_tab(&id) {
        Some(path) => {
            // The path was found just now, so it is there.
            let _ = dock.set_active_tab(path);
            dock.set_focused_node_and_surface(path.node_path());
        }
        None => dock.push_to_focused_leaf(id),
    }
}

/// Adds a panel in front of the tabs of another.
pub fn open_beside(dock: &mut DockState<String>, panel: Panel, other: Panel) {
    if let Some(path) = dock.find_tab(&other.id().to_owned()) {
        dock.set_focused_node_and_surface(path.node_path());
    }
    open(dock, panel);
}

/// Takes a panel away.
pub fn close(dock: &mut DockState<String>, panel: Panel) {
    if let Some(path) = dock.find_tab(&panel.id().to_owned()) {
        dock.remove_tab(path);
    }
}

/// Whether a panel is open.
#[must_use]
pub fn is_open(dock: &DockState<String>, panel: Panel) -> bool {
    dock.find_tab(&panel.id().to_owned()).is_some()
}

/// A saved layout without panels this program does not know; `None` where nothing is left.
#[must_use]
pub fn known(mut dock: DockState<String>) -> Option<DockState<String>> {
    dock.retain_tabs(|id| Panel::of_id(id).is_some());
    let empty = dock.iter_all_tabs().next().is_none();
    (!empty).then_some(dock)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_unique_and_lead_back() {
        for panel in Panel::ALL {
            assert_eq!(Panel::of_id(panel.id()), Some(panel));
        }
    }

    #[test]
    fn a_panel_opens_once_in_every_layout() {
        for layout in Layout::ALL {
            let mut dock = layout.dock();
            for panel in Panel::ALL.into_iter().chain(Panel::ALL) {
                open(&mut dock, panel);
                assert!(is_open(&dock, panel), "{layout:?} {panel:?}");
            }
            assert_eq!(
                dock.iter_all_tabs().count(),
                Panel::ALL.len(),
                "{layout:?}: no panel twice"
            );
        }
    }

    #[test]
    fn a_saved_layout_loses_what_is_unknown_and_only_that() {
        let mut dock = Layout::Design.dock();
        let before = dock.iter_all_tabs().count();
        dock.push_to_focused_leaf("crystal-ball".to_owned());
        assert_eq!(known(dock).unwrap().iter_all_tabs().count(), before);
        assert!(known(DockState::new(vec!["crystal-ball".to_owned()])).is_none());
    }
}
