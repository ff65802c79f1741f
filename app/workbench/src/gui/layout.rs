//! Named layouts, and how panels are opened and closed in them.

use egui_dock::{DockState, NodeIndex};
use strum::{IntoStaticStr, VariantArray};

use super::panel::PanelId;

/// A named arrangement of panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr, VariantArray)]
pub enum Layout {
    /// For editing gear and running it.
    Design,
    /// For steering the whale: a large view beside the controls.
    Fly,
    /// For studying what happened in a run.
    Review,
    /// For comparing options on the same encounters: designer, queue, results, and any run of them.
    Study,
    /// For finding encounters that end like an observation on a real whale: observation, stories, and any run of them.
    Search,
}

impl Layout {
    /// All layouts, in the order of the menu.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its name.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Its panels in their places.
    pub fn dock(self) -> DockState<String> {
        match self {
            Self::Design => design(),
            Self::Fly => fly(),
            Self::Review => review(),
            Self::Study => study(),
            Self::Search => search(),
        }
    }
}

fn design() -> DockState<String> {
    let mut dock =
        DockState::new(ids(&[PanelId::View, PanelId::Map, PanelId::Assembly, PanelId::Rules]));
    let tree = dock.main_surface_mut();
    let [upper, _] =
        tree.split_below(NodeIndex::root(), 0.66, ids(&[PanelId::Library, PanelId::Problems]));
    let [middle, _] = tree.split_left(upper, 0.2, ids(&[PanelId::Scenario]));
    let [_, right] = tree.split_right(middle, 0.7, ids(&[PanelId::Run]));
    tree.split_below(right, 0.5, ids(&[PanelId::Tension, PanelId::Summary, PanelId::Events]));
    dock
}

fn fly() -> DockState<String> {
    let mut dock = DockState::new(ids(&[PanelId::View]));
    let tree = dock.main_surface_mut();
    let [_, right] = tree.split_right(
        NodeIndex::root(),
        0.78,
        ids(&[PanelId::Run, PanelId::Scenario, PanelId::Pad]),
    );
    let [_, below] = tree.split_below(right, 0.42, ids(&[PanelId::Tension, PanelId::Map]));
    tree.split_below(below, 0.5, ids(&[PanelId::Events, PanelId::Summary]));
    dock
}

fn review() -> DockState<String> {
    let mut dock = DockState::new(ids(&[PanelId::View]));
    let tree = dock.main_surface_mut();
    let [upper, lower] =
        tree.split_below(NodeIndex::root(), 0.55, ids(&[PanelId::Plots, PanelId::Pilot]));
    tree.split_right(upper, 0.6, ids(&[PanelId::Entanglement, PanelId::Summary]));
    tree.split_right(
        lower,
        0.66,
        ids(&[PanelId::Events, PanelId::Run, PanelId::Recordings, PanelId::Compare]),
    );
    dock
}

fn study() -> DockState<String> {
    let mut dock = DockState::new(ids(&[PanelId::Results]));
    let tree = dock.main_surface_mut();
    let [right, _] = tree.split_left(
        NodeIndex::root(),
        0.36,
        ids(&[PanelId::Study, PanelId::Library, PanelId::Problems]),
    );
    let [_, below] = tree.split_below(right, 0.52, ids(&[PanelId::View, PanelId::Plots]));
    tree.split_right(below, 0.62, ids(&[PanelId::Summary, PanelId::Entanglement, PanelId::Events]));
    dock
}

fn search() -> DockState<String> {
    let mut dock = DockState::new(ids(&[PanelId::Stories]));
    let tree = dock.main_surface_mut();
    let [right, _] =
        tree.split_left(NodeIndex::root(), 0.38, ids(&[PanelId::Search, PanelId::Problems]));
    let [_, below] = tree.split_below(right, 0.46, ids(&[PanelId::View, PanelId::Plots]));
    tree.split_right(below, 0.66, ids(&[PanelId::Entanglement, PanelId::Summary, PanelId::Events]));
    dock
}

fn ids(panels: &[PanelId]) -> Vec<String> {
    panels.iter().map(|panel| panel.id().to_owned()).collect()
}

/// Brings a panel to the front; adds it if it is closed.
pub fn open(dock: &mut DockState<String>, panel: PanelId) {
    let id = panel.id().to_owned();
    match dock.find_tab(&id) {
        Some(path) => {
            // The tab was found above, so this cannot fail.
            let _ = dock.set_active_tab(path);
            dock.set_focused_node_and_surface(path.node_path());
        }
        None => dock.push_to_focused_leaf(id),
    }
}

/// Opens a panel among the tabs of another, in front.
pub fn open_beside(dock: &mut DockState<String>, panel: PanelId, other: PanelId) {
    if let Some(path) = dock.find_tab(&other.id().to_owned()) {
        dock.set_focused_node_and_surface(path.node_path());
    }
    open(dock, panel);
}

/// Closes a panel.
pub fn close(dock: &mut DockState<String>, panel: PanelId) {
    if let Some(path) = dock.find_tab(&panel.id().to_owned()) {
        dock.remove_tab(path);
    }
}

/// Whether a panel is open.
pub fn is_open(dock: &DockState<String>, panel: PanelId) -> bool {
    dock.find_tab(&panel.id().to_owned()).is_some()
}

/// Removes panels that this program does not know from a saved layout; returns `None` if no panel remains.
pub fn known(mut dock: DockState<String>) -> Option<DockState<String>> {
    dock.retain_tabs(|id| PanelId::find(id).is_some());
    let empty = dock.iter_all_tabs().next().is_none();
    (!empty).then_some(dock)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_opens_only_once_in_every_layout() {
        for layout in Layout::ALL.iter().copied() {
            let mut dock = layout.dock();
            for panel in PanelId::ALL.iter().chain(PanelId::ALL).copied() {
                open(&mut dock, panel);
                assert!(is_open(&dock, panel), "{layout:?} {panel:?}");
            }
            assert_eq!(
                dock.iter_all_tabs().count(),
                PanelId::ALL.len(),
                "{layout:?}: no panel twice"
            );
        }
    }

    #[test]
    fn a_saved_layout_loses_only_unknown_panels() {
        let mut dock = Layout::Design.dock();
        let before = dock.iter_all_tabs().count();
        dock.push_to_focused_leaf("crystal-ball".to_owned());
        assert_eq!(known(dock).unwrap().iter_all_tabs().count(), before);
        assert!(known(DockState::new(vec!["crystal-ball".to_owned()])).is_none());
    }
}
