//! Panels as the dock's tabs.

use egui::{Id, Ui};
use egui_dock::TabViewer;

use crate::gui::panel::PanelId;
use crate::gui::panels::Panels;
use crate::gui::shared::Shared;

/// Panels as the dock's tabs.
pub(super) struct Tabs<'a> {
    pub(super) panels: &'a mut Panels,
    pub(super) shared: &'a mut Shared,
}

impl TabViewer for Tabs<'_> {
    type Tab = String;

    fn id(&mut self, tab: &mut String) -> Id {
        Id::new(("panel", tab.as_str()))
    }

    fn title(&mut self, tab: &mut String) -> egui::WidgetText {
        PanelId::find(tab).map_or_else(|| tab.clone(), PanelId::title).into()
    }

    fn ui(&mut self, ui: &mut Ui, tab: &mut String) {
        if let Some(panel) = PanelId::find(tab) {
            self.shared.drawn.push(panel);
            self.panels.get(panel).ui(ui, self.shared);
        }
    }

    fn on_tab_button(&mut self, tab: &mut String, response: &egui::Response) {
        // The dock's tabs say nothing to screen readers of themselves.
        let title = self.title(tab).text().to_owned();
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &title));
    }

    fn scroll_bars(&self, _tab: &String) -> [bool; 2] {
        [false, false]
    }

    fn allowed_in_windows(&self, tab: &mut String) -> bool {
        tab != PanelId::View.id()
    }
}
