//! An end of a pipe between the program and a plugin's process.
//!
//! The other side answers within microseconds as a rule, and a sleep costs more than that: an end asks again for a moment, giving
//! way to other threads, before it sleeps.

use std::fs::File;
use std::io::{self, ErrorKind, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};

/// How long an end asks again before it sleeps.
const BRIEF: Duration = Duration::from_micros(50);
/// Longest sleep at once of an end that gives up at last.
const POLL: Duration = Duration::from_millis(50);

/// An end of a pipe.
pub(super) struct Pipe {
    file: File,
    /// How long an exchange may wait for the other side; `None` for ever.
    patience: Option<Duration>,
    /// How long the exchange in progress has waited. While this process is suspended, one interval counts.
    waited: Duration,
}

impl Pipe {
    /// An end that waits for at most `limit`.
    pub fn new(end: impl Into<OwnedFd>, patience: Option<Duration>) -> io::Result<Self> {
        let file = File::from(end.into());
        fcntl_setfl(&file, fcntl_getfl(&file)? | OFlags::NONBLOCK)?;
        Ok(Self { file, patience, waited: Duration::ZERO })
    }

    /// An exchange begins, whose parts share the patience: who dribbles byte after byte gains no time.
    pub fn begin(&mut self) {
        self.waited = Duration::ZERO;
    }

    /// Does something once the other side is ready for it.
    fn ready<T>(
        &mut self,
        flags: PollFlags,
        mut work: impl FnMut(&mut File) -> io::Result<T>,
    ) -> io::Result<T> {
        let begun = Instant::now();
        loop {
            match work(&mut self.file) {
                Err(error) if error.kind() == ErrorKind::WouldBlock => {}
                done => return done,
            }
            if begun.elapsed() < BRIEF {
                std::thread::yield_now();
                continue;
            }
            match self.patience {
                None => return self.sleeping(work),
                Some(patience) if self.waited > patience => return Err(ErrorKind::TimedOut.into()),
                Some(_) => self.sleep(flags)?,
            }
        }
    }

    /// Sleeps for one interval, or until the other side is ready.
    fn sleep(&mut self, flags: PollFlags) -> io::Result<()> {
        let begun = Instant::now();
        let longest = Timespec { tv_sec: 0, tv_nsec: i64::from(POLL.subsec_nanos()) };
        let woken = poll(&mut [PollFd::from_borrowed_fd(self.file.as_fd(), flags)], Some(&longest));
        self.waited += begun.elapsed().min(POLL);
        match woken {
            Ok(_) | Err(rustix::io::Errno::INTR) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    /// Does something that sleeps until the other side is ready. A process without a file to open may not call `poll`.
    fn sleeping<T>(&mut self, work: impl FnOnce(&mut File) -> io::Result<T>) -> io::Result<T> {
        let flags = fcntl_getfl(&self.file)?;
        fcntl_setfl(&self.file, flags - OFlags::NONBLOCK)?;
        let done = work(&mut self.file);
        fcntl_setfl(&self.file, flags)?;
        done
    }
}

impl Read for Pipe {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        self.ready(PollFlags::IN, |file| file.read(room))
    }
}

impl Write for Pipe {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.ready(PollFlags::OUT, |file| file.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
