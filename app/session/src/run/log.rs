//! The log of a run, a row of 64-bit words for each step, in bounded memory.
//!
//! The newest rows are in memory. When these are [`IN_MEMORY`], they go to a file without a name in the system's folder for
//! temporary files, which vanishes with the program. Where that cannot be written, rows stay in memory: a run does not end because
//! a disk is full.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex, PoisonError};

use crate::recording::{Rows, bytes};

/// Rows in memory at most: some 9 MB of inputs and state hashes. In tests few, so that their runs are in a file.
const IN_MEMORY: usize = if cfg!(test) { 16 } else { 1 << 16 };
/// Bytes read from the file at once.
const PIECE: usize = 1 << 16;

/// Rows of `N` words, appended one by one.
pub(crate) struct Log<const N: usize> {
    /// The older rows, and how many of the file are of this log.
    older: Option<(Arc<Mutex<File>>, usize)>,
    newer: Vec<[u64; N]>,
    last: Option<[u64; N]>,
    in_memory: usize,
    /// Whether newer rows may go to the file: not where another log has the file too, or it could not be written.
    spills: bool,
}

impl<const N: usize> Log<N> {
    /// An empty log.
    pub fn new() -> Self {
        Self { older: None, newer: Vec::new(), last: None, in_memory: IN_MEMORY, spills: true }
    }

    /// Appends a row.
    pub fn push(&mut self, row: [u64; N]) {
        self.last = Some(row);
        self.newer.push(row);
        if self.spills && self.newer.len() >= self.in_memory {
            self.spills = self.spill().is_ok();
        }
    }

    /// Rows so far.
    pub fn len(&self) -> usize {
        self.older.as_ref().map_or(0, |(_, rows)| *rows) + self.newer.len()
    }

    /// The last row.
    pub fn last(&self) -> Option<[u64; N]> {
        self.last
    }

    /// The first rows, all where there are fewer.
    pub fn first(&self, count: usize) -> io::Result<Vec<[u64; N]>> {
        let mut rows = Vec::with_capacity(count.min(self.len()));
        self.each_piece(&mut |bytes| {
            let (words, _) = bytes.as_chunks::<8>();
            let (pieces, _) = words.as_chunks::<N>();
            let left = count - rows.len();
            rows.extend(pieces.iter().take(left).map(|row| row.map(u64::from_le_bytes)));
            Ok(())
        })?;
        Ok(rows)
    }

    /// A log that begins with the first rows of this one; of those in the file it has the same, and writes no more of its own there.
    pub fn begun(&self, count: usize) -> io::Result<Self> {
        let of_file = self.older.as_ref().map_or(0, |(_, rows)| *rows);
        let older = self.older.as_ref().map(|(file, _)| (Arc::clone(file), of_file.min(count)));
        let newer = self.newer[..count.saturating_sub(of_file).min(self.newer.len())].to_vec();
        let last = match (newer.last(), &older) {
            (Some(row), _) => Some(*row),
            (None, Some((file, rows))) if *rows > 0 => Some(row_of(file, rows - 1)?),
            (None, _) => None,
        };
        Ok(Self { spills: older.is_none(), older, newer, last, in_memory: self.in_memory })
    }

    /// Moves the newer rows to the end of the file.
    fn spill(&mut self) -> io::Result<()> {
        let (file, rows) = match &self.older {
            Some((file, rows)) => (Arc::clone(file), *rows),
            None => (Arc::new(Mutex::new(tempfile::tempfile()?)), 0),
        };
        let mut open = file.lock().unwrap_or_else(PoisonError::into_inner);
        open.seek(SeekFrom::Start((rows * 8 * N) as u64))?;
        open.write_all(&bytes(self.newer.iter().copied()))?;
        drop(open);
        self.older = Some((file, rows + self.newer.len()));
        self.newer.clear();
        Ok(())
    }

    fn each_piece(&self, take: &mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        if let Some((file, rows)) = &self.older {
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            file.seek(SeekFrom::Start(0))?;
            let (mut left, mut piece) = (rows * 8 * N, vec![0; PIECE.next_multiple_of(8 * N)]);
            while left > 0 {
                let now = left.min(piece.len());
                file.read_exact(&mut piece[..now])?;
                take(&piece[..now])?;
                left -= now;
            }
        }
        self.newer.chunks(PIECE / (8 * N)).try_for_each(|rows| take(&bytes(rows.iter().copied())))
    }
}

impl<const N: usize> Rows for Log<N> {
    fn bytes(&self) -> u64 {
        (self.len() * 8 * N) as u64
    }

    fn each(&self, take: &mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        self.each_piece(take)
    }
}

fn row_of<const N: usize>(file: &Mutex<File>, at: usize) -> io::Result<[u64; N]> {
    let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
    file.seek(SeekFrom::Start((at * 8 * N) as u64))?;
    let mut row = [0; N];
    for word in &mut row {
        let mut bytes = [0; 8];
        file.read_exact(&mut bytes)?;
        *word = u64::from_le_bytes(bytes);
    }
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(number: u64) -> [u64; 3] {
        [number, number * number, u64::MAX - number]
    }

    /// A log with seven rows in memory, of this many rows.
    fn log(rows: u64) -> Log<3> {
        let mut log = Log { in_memory: 7, ..Log::new() };
        (0..rows).for_each(|number| log.push(row(number)));
        log
    }

    fn rows(count: u64) -> Vec<[u64; 3]> {
        (0..count).map(row).collect()
    }

    #[test]
    fn rows_come_back_from_memory_and_file() {
        for count in [0, 1, 6, 7, 8, 100] {
            let log = log(count);
            assert!(log.newer.len() < 7);
            assert_eq!(log.len() as u64, count);
            assert_eq!(log.last(), rows(count).last().copied());
            for first in [0, 1, 7, 50, 1_000] {
                assert_eq!(log.first(first).unwrap(), rows(count.min(first as u64)));
            }
            let mut all = Vec::new();
            log.each(&mut |piece| {
                all.extend_from_slice(piece);
                Ok(())
            })
            .unwrap();
            assert_eq!(all, bytes(rows(count).into_iter()));
            assert_eq!(log.bytes(), all.len() as u64);
        }
    }

    #[test]
    fn a_log_begun_with_the_rows_of_another_goes_its_own_way() {
        for count in [0, 3, 7, 20, 33] {
            let mut one = log(33);
            let mut other = one.begun(count).unwrap();
            assert_eq!(other.last(), rows(count as u64).last().copied());
            (0..40).for_each(|number| other.push(row(1_000 + number)));
            (33..80).for_each(|number| one.push(row(number)));
            let own = (0..40).map(|number| row(1_000 + number));
            let expected: Vec<_> = rows(count as u64).into_iter().chain(own).collect();
            assert_eq!(other.first(1_000).unwrap(), expected);
            assert_eq!(one.first(1_000).unwrap(), rows(80));
        }
    }

    #[test]
    fn a_row_longer_than_a_piece_of_the_file_comes_back() {
        let mut log = Log::<9> { in_memory: 2_000, ..Log::new() };
        (0..5_000).for_each(|number| log.push([number; 9]));
        let rows = log.first(5_000).unwrap();
        assert!(rows.iter().enumerate().all(|(place, row)| *row == [place as u64; 9]));
    }
}
