//! What a panel of the window is.

use egui::Ui;

use super::panel_id::PanelId;
use super::shared::Shared;

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
