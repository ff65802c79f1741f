//! A progress bar, on a terminal only, on standard error.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

use super::output::{Told, is_told};

/// How often the bar is touched [steps]; drawing is limited further by its own clock.
const STRIDE: u64 = 16;

/// Shows steps taken of steps in all.
pub(super) struct Progress(Option<ProgressBar>);

impl Progress {
    pub(super) fn new(label: &'static str) -> Self {
        if !std::io::stderr().is_terminal() || !is_told(Told::Notes) {
            return Self(None);
        }
        let bar = ProgressBar::new(0).with_message(label);
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}%  {eta_precise}")
        {
            bar.set_style(style);
        }
        Self(Some(bar))
    }

    pub(super) fn at(&self, step: u64, steps: u64) {
        let Some(bar) = &self.0 else { return };
        if step.is_multiple_of(STRIDE) || step >= steps {
            bar.set_length(steps);
            bar.set_position(step);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
