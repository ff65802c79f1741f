//! Tables and plots written to files and taken from them.

use super::{Desk, Order};
use crate::scene::{Scene, Show};

impl Desk {
    /// Files written or taken in by one order.
    pub(super) fn obey_files(&mut self, order: &Order) {
        match order {
            Order::ScenarioAs(path) => self.save_scenario_as(path),
            Order::ExportTable(path) => self.export_table(path),
            Order::ImportTable(path) => self.import_table(path),
            Order::ExportPlots(path) => self.export_plots(path),
            Order::ExportModel(path) => self.export_model(path),
            _ => {}
        }
    }

    /// The plots as SVG or, by the ending, as CSV; a PNG is cut from the window by [`App`](super::super::app::App).
    fn export_plots(&mut self, path: &std::path::Path) {
        let charts = super::super::panels::plots::charts(self);
        let csv = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        let text = if csv {
            Ok(charts.iter().map(super::super::charts::Chart::csv).collect())
        } else {
            super::super::chart_svg::svg(&charts)
        };
        let written = text.and_then(|text: String| {
            endline_session::save::atomically(path, text.as_bytes())
                .map_err(|error| error.to_string())
        });
        self.notice = Some(match written {
            Ok(()) => (format!("saved {}", path.display()), false),
            Err(error) => (format!("{}: {error}", path.display()), true),
        });
    }

    /// The gear of the assembly panel, at rest in running tide.
    fn export_model(&mut self, path: &std::path::Path) {
        let rest = self.assembly.answers()[1].and_then(|answer| answer.as_ref().ok()).cloned();
        let Some(rest) = rest else {
            self.notice = Some(("the gear of the assembly panel is not at rest yet".into(), true));
            return;
        };
        let show = Show {
            surface: false,
            seabed: false,
            current: false,
            contacts: false,
            forces: false,
            whale: false,
            scale_n: None,
        };
        let scene = Scene::of(&rest.model, &rest.frame, &show);
        let stl = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("stl"));
        let bytes =
            if stl { super::super::models::stl(&scene) } else { super::super::models::glb(&scene) };
        self.notice = Some(match endline_session::save::atomically(path, &bytes) {
            Ok(()) => (format!("saved {}", path.display()), false),
            Err(error) => (format!("{}: {error}", path.display()), true),
        });
    }

    fn save_scenario_as(&mut self, path: &std::path::Path) {
        self.notice = Some(match self.documents.save_scenario_as(path) {
            Ok(()) => {
                self.remember(path);
                (format!("saved {}", path.display()), false)
            }
            Err(error) => (error, true),
        });
    }

    fn export_table(&mut self, path: &std::path::Path) {
        let text = super::super::panels::library::csv(self);
        self.notice = Some(match endline_session::save::atomically(path, text.as_bytes()) {
            Ok(()) => (format!("saved {}", path.display()), false),
            Err(error) => (format!("{}: {error}", path.display()), true),
        });
    }

    fn import_table(&mut self, path: &std::path::Path) {
        match std::fs::read_to_string(path) {
            Ok(text) => super::super::panels::library::take_in(self, &text),
            Err(error) => self.notice = Some((format!("{}: {error}", path.display()), true)),
        }
    }
}
