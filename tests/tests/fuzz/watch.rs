//! The clock and the memory of the inputs at work.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// An input that takes longer hangs.
pub const HANGS: Duration = Duration::from_secs(10);
/// Time of a wall clock after which the whole is ended: on a busy machine ten seconds may be few.
const ENDED: Duration = Duration::from_secs(120);

/// What a thread is working on.
#[derive(Clone, Default)]
pub struct AtWork(Arc<Mutex<Option<(Instant, &'static str, Vec<u8>)>>>);

impl AtWork {
    pub fn begin(&self, target: &'static str, input: &[u8]) {
        *self.0.lock().unwrap() = Some((Instant::now(), target, input.to_vec()));
    }

    /// Ends it; how long it took.
    pub fn end(&self) -> Duration {
        self.0.lock().unwrap().take().map_or(Duration::ZERO, |(since, ..)| since.elapsed())
    }
}

/// Ends the process, and keeps the input, where one never ends.
pub fn over(workers: Vec<AtWork>, done: Arc<AtomicBool>) {
    thread::spawn(move || {
        while !done.load(Ordering::Relaxed) {
            for worker in &workers {
                if let Some((since, target, input)) = &*worker.0.lock().unwrap()
                    && since.elapsed() > ENDED
                {
                    eprintln!("`{target}` never ends: {}", keep(target, input).display());
                    std::process::abort();
                }
            }
            thread::sleep(Duration::from_millis(200));
        }
    });
}

/// Keeps an input that was found, in the folder `fuzz` of the build.
pub fn keep(target: &str, input: &[u8]) -> PathBuf {
    let folder = endline_tests::products().unwrap().join("fuzz");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("{target}-{}", &blake3::hash(input).to_hex()[..12]));
    std::fs::write(&file, input).unwrap();
    file
}

/// Most memory that this process has had [MB]; `None` where the system does not say.
pub fn most_memory_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| kilobytes / 1000)
}
