//! An end of a pipe between the program and a plugin's process.
//!
//! The other side answers within microseconds as a rule, and a sleep costs more than that: an end asks again for a moment, giving
//! way to whoever wants the processor, before it sleeps.

use std::fs::File;
use std::io::{self, ErrorKind, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};

/// How long an end asks again before it sleeps.
const BRIEF: Duration = Duration::from_micros(50);
/// Longest sleep of an end that gives up at last.
const LOOK: Timespec = Timespec { tv_sec: 0, tv_nsec: 50_000_000 };

/// An end of a pipe.
pub(super) struct Pipe {
    file: File,
    /// After how many looks without a sign of the other side a wait is given up; `None` for never. A time in which this process
    /// stands still is one look.
    patience: Option<u32>,
}

impl Pipe {
    /// Looks in a second.
    pub const LOOKS: u32 = 20;

    /// An end that waits for so many looks.
    pub fn new(end: impl Into<OwnedFd>, patience: Option<u32>) -> io::Result<Self> {
        let file = File::from(end.into());
        fcntl_setfl(&file, fcntl_getfl(&file)? | OFlags::NONBLOCK)?;
        Ok(Self { file, patience })
    }

    /// Does something once the other side is ready for it.
    fn ready<T>(
        &mut self,
        flags: PollFlags,
        mut work: impl FnMut(&mut File) -> io::Result<T>,
    ) -> io::Result<T> {
        let begun = Instant::now();
        let mut looks = 0;
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
                Some(patience) if looks > patience => return Err(ErrorKind::TimedOut.into()),
                Some(_) => self.sleep(flags)?,
            }
            looks += 1;
        }
    }

    /// Sleeps for a look, or until the other side is ready.
    fn sleep(&self, flags: PollFlags) -> io::Result<()> {
        match poll(&mut [PollFd::from_borrowed_fd(self.file.as_fd(), flags)], Some(&LOOK)) {
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
