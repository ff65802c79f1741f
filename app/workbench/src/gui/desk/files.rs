//! The scenario saved to another file, and notices of what was written.

use std::path::Path;

use super::Desk;

impl Desk {
    /// Tells in the status bar that a file was written, or why it was not.
    pub fn notice_saved(&mut self, path: &Path, written: Result<(), String>) {
        self.notice = Some(match written {
            Ok(()) => (format!("saved {}", path.display()), false),
            Err(error) => (format!("{}: {error}", path.display()), true),
        });
    }

    pub(super) fn save_scenario_as(&mut self, path: &Path) {
        self.notice = Some(match self.documents.save_scenario_as(path) {
            Ok(()) => {
                self.remember(path);
                (format!("saved {}", path.display()), false)
            }
            Err(error) => (error, true),
        });
    }
}
