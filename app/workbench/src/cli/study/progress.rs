//! How far a study is: a bar on a terminal, else a line now and then on standard error.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::time::{Duration, Instant};

use endline_session::campaign::{Count, Progress};
use indicatif::{ProgressBar, ProgressStyle};

use super::super::output;

/// Time between two lines where there is no terminal.
const BETWEEN: Duration = Duration::from_secs(30);

/// Shows blocks done and the time left.
pub(super) struct Bar {
    bar: Option<ProgressBar>,
    start: Instant,
    told: Mutex<Instant>,
}

impl Bar {
    pub(super) fn new() -> Self {
        let shows = std::io::stderr().is_terminal() && output::is_told(output::Told::Notes);
        let bar = shows.then(|| {
            let bar = ProgressBar::new(0).with_message("encounters");
            if let Ok(style) =
                ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}%  {eta_precise} left")
            {
                bar.set_style(style);
            }
            bar
        });
        let now = Instant::now();
        Self { bar, start: now, told: Mutex::new(now) }
    }

    pub(super) fn at(&self, progress: &Progress) {
        let Count { done, found, total } = progress.blocks;
        if let Some(bar) = &self.bar {
            let others = progress.elsewhere;
            let message = match others {
                0 => "encounters".to_owned(),
                _ => format!("encounters, {others} of them run by other processes"),
            };
            bar.set_message(message);
            bar.set_length(u64::from(total));
            bar.set_position(u64::from(done));
            return;
        }
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        if told.elapsed() < BETWEEN && done < total {
            return;
        }
        *told = Instant::now();
        let fresh = done - found;
        let left = if fresh == 0 {
            String::new()
        } else {
            format!(", {} left", words(self.start.elapsed() / fresh * (total - done)))
        };
        let waits = match progress.elsewhere {
            0 => String::new(),
            others => {
                format!("; {others} are run by other processes, and none is left for this one")
            }
        };
        output::note(&format!("{done} of {total} blocks of encounters{left}{waits}"));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn words(left: Duration) -> String {
    let minutes = left.as_secs() / 60;
    match minutes {
        0 => format!("{} s", left.as_secs()),
        1..60 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}
