//! Files written for others: tables of the library and plots of the run.

use std::path::Path;

use endline_gear::Kind;

use super::Workbench;
use super::notice::Notice;
use crate::VERSION;
use crate::edit::library_table;
use crate::export::{self, Chart, chart};
use crate::save::atomically;

impl Workbench {
    pub(crate) fn export_table(
        &mut self,
        kind: Kind,
        rows: Option<Vec<String>>,
        file: &Path,
    ) -> Result<(), String> {
        let documents = &self.project.documents;
        let all = || documents.files(kind.folder()).map(str::to_owned).collect();
        let text = library_table::to_csv(documents, kind, &rows.unwrap_or_else(all));
        let written = atomically(file, text.as_bytes()).map_err(|error| error.to_string());
        self.report_written(file, written)
    }

    /// Plots of the run with the one it is compared with, in the units chosen.
    pub fn charts(&self, kinds: &[chart::Kind]) -> Vec<Chart> {
        let Some(view) = self.view() else { return Vec::new() };
        let (other, units) = (self.compared_view(), self.preferences.units);
        let chart = |kind: &chart::Kind| {
            let own = Chart::of(*kind, view, units);
            match &other {
                Some(other) => own.beside(Chart::of(*kind, other, units)),
                None => own,
            }
        };
        kinds.iter().map(chart).collect()
    }

    pub(crate) fn export_plots(
        &mut self,
        kinds: &[chart::Kind],
        file: &Path,
    ) -> Result<(), String> {
        let of = self.guest().map_or_else(|| self.scenario_stem(), str::to_owned);
        let origin = format!("{of}, Endline {VERSION}");
        let written = export::charts(file, &self.charts(kinds), &origin);
        self.report_written(file, written)
    }

    fn report_written(&mut self, file: &Path, written: Result<(), String>) -> Result<(), String> {
        written.map_err(|error| format!("{}: {error}", file.display()))?;
        self.notice = Some(Notice::done(format!("saved {}", file.display())));
        Ok(())
    }
}
