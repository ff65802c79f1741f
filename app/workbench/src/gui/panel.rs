//! What a panel is, and the id and title of every panel.

use std::any::Any;

use egui::Ui;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

use crate::gui::shared::Shared;
use crate::gui::widgets::words::capital;

/// The panels, in the order of the Window menu.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, EnumMessage, EnumString, IntoStaticStr, VariantArray,
)]
#[strum(serialize_all = "snake_case")]
pub enum PanelId {
    /// Tables of the gear library.
    Library,
    /// Parts of an assembly, and its statics drawn to scale.
    Assembly,
    /// Fields of the scenario: sea, whale, weak links, run.
    Scenario,
    /// The 3-D view.
    #[strum(message = "3-D view")]
    View,
    /// Gear, the whale and its track from above.
    Map,
    /// Start, pause and speed of a run; figures of the solver.
    Run,
    /// Tension over time.
    Tension,
    /// Tension, force, wraps, depth and speed over time.
    Plots,
    /// Rope on the whale's body, and the outcome of the run.
    Entanglement,
    /// Events of the run, with their times.
    Events,
    /// Outcome and loads by part of the whale.
    Summary,
    /// Errors and warnings of all files.
    Problems,
    /// Keys and pad.
    #[strum(message = "Keys and help")]
    Help,
    /// Recent files and examples.
    Start,
    /// Recorded runs.
    Recordings,
    /// Assignment of sticks, triggers and buttons of the pad.
    Pad,
    /// Motions, friction laws and gear types.
    Plugins,
    /// The designer of a study, and the queue.
    Study,
    /// Results of a study.
    Results,
    /// An observation on a whale, and the search for encounters that end like it.
    Search,
    /// Results of a search.
    Stories,
    /// Rules of law checked on an assembly, and edits by which it would comply.
    Rules,
    /// The pilot program as a timeline.
    #[strum(message = "Pilot program")]
    Pilot,
    /// Two runs side by side.
    Compare,
}

impl PanelId {
    /// All panels.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its id in saved layouts, which never changes.
    pub fn id(self) -> &'static str {
        self.into()
    }

    /// Title of its tab: its id in words, where it has no other one.
    pub fn title(self) -> String {
        self.get_message().map_or_else(|| capital(self.id()), str::to_owned)
    }

    /// Finds the panel with an id.
    pub fn find(id: &str) -> Option<Self> {
        id.parse().ok()
    }
}

/// A panel of the window. It owns its state and reads everything else from [`Shared`].
///
/// A panel never names another one: it gives a command, and the window passes the command to the panel concerned.
pub trait Panel: Any {
    /// Draws it.
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared);
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn ids_are_unique() {
        for panel in PanelId::ALL.iter().copied() {
            assert_eq!(PanelId::find(panel.id()), Some(panel));
        }
    }
}
