//! The clock and the memory of the inputs at work.
//!
//! Time is that of the processor, where the system tells it: on a busy machine a clock on the wall measures the others.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// An input that takes longer hangs.
pub const HANGS: Duration = Duration::from_secs(10);
/// Time after which the whole is ended, because the input may never end.
const ENDED: Duration = Duration::from_secs(60);

/// The time that a thread has worked.
#[derive(Clone)]
enum Clock {
    /// File in which the system counts its nanoseconds.
    Processor(PathBuf),
    Wall(Instant),
}

impl Clock {
    /// That of the thread that asks.
    fn own() -> Self {
        let file = PathBuf::from("/proc")
            .join(std::fs::read_link("/proc/thread-self").unwrap_or_default());
        let file = file.join("schedstat");
        if file.is_file() { Self::Processor(file) } else { Self::Wall(Instant::now()) }
    }

    fn now(&self) -> Duration {
        match self {
            Self::Wall(since) => since.elapsed(),
            Self::Processor(file) => {
                let text = std::fs::read_to_string(file).unwrap_or_default();
                let worked = text.split_whitespace().next().and_then(|word| word.parse().ok());
                Duration::from_nanos(worked.unwrap_or_default())
            }
        }
    }
}

/// An input at work.
struct Work {
    clock: Clock,
    since: Duration,
    target: &'static str,
    input: Vec<u8>,
}

impl Work {
    fn took(&self) -> Duration {
        self.clock.now().saturating_sub(self.since)
    }
}

/// What a thread is working on.
#[derive(Clone, Default)]
pub struct AtWork(Arc<Mutex<Option<Work>>>);

impl AtWork {
    /// Begins an input, on the thread that works on it.
    pub fn begin(&self, target: &'static str, input: &[u8]) {
        let clock = Clock::own();
        let (since, input) = (clock.now(), input.to_vec());
        *self.0.lock().unwrap() = Some(Work { clock, since, target, input });
    }

    /// Ends it; how long it took.
    pub fn end(&self) -> Duration {
        self.0.lock().unwrap().take().map_or(Duration::ZERO, |work| work.took())
    }
}

/// Ends the process, and keeps the input, where one never ends.
pub fn over(workers: Vec<AtWork>, done: Arc<AtomicBool>) {
    thread::spawn(move || {
        while !done.load(Ordering::Relaxed) {
            for worker in &workers {
                if let Some(work) = worker.0.lock().unwrap().as_ref()
                    && work.took() > ENDED
                {
                    let file = keep(work.target, &work.input);
                    eprintln!("`{}` never ends: {}", work.target, file.display());
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
