//! Leases held against what processes may do: be killed, fall asleep, begin and end at any moment.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::mem::{ManuallyDrop, forget};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::process::{BEAT, Place, SILENCE};
use super::{Lease, Leases, Next, clear, folder_of, path_of, workers};

/// A folder of results, removed at the end.
struct Results(PathBuf);

impl Results {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("endline-leases-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Results {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A process of another machine, whose lock is not visible.
fn far(results: &Path) -> Leases {
    Leases::join_from(results, Place::default()).unwrap()
}

fn run<'a>(leases: &'a Leases, wanted: &[u32]) -> Option<Lease<'a>> {
    match leases.next(wanted).unwrap() {
        Next::Run(lease) => Some(lease),
        Next::Wait(_) | Next::Nothing => None,
    }
}

/// Ends a process as a signal that it cannot catch does: its files stay, its lock is free.
fn kill(leases: Leases) {
    let leases = ManuallyDrop::new(leases);
    leases.process.file.lock().unwrap().unlock().unwrap();
}

fn set_time(file: &Path, time: SystemTime) {
    File::options().write(true).open(file).unwrap().set_modified(time).unwrap();
}

#[test]
fn a_block_is_leased_once_and_free_again_when_it_is_given_back() {
    let results = Results::new("once");
    let (one, other) = (far(&results.0), far(&results.0));
    let first = run(&one, &[4, 5]).unwrap();
    let second = run(&other, &[4, 5]).unwrap();
    assert_ne!(first.block, second.block);
    assert!(matches!(other.next(&[first.block]).unwrap(), Next::Wait(1)));
    assert!(
        matches!(one.next(&[first.block]).unwrap(), Next::Nothing),
        "one's own is no reason to wait"
    );
    let block = first.block;
    drop(first);
    assert_eq!(run(&other, &[block]).unwrap().block, block);
    drop(second);
    drop((one, other));
    assert!(!folder_of(&results.0).exists(), "the last one leaves nothing behind");
}

#[test]
fn a_killed_process_is_followed_at_once_on_its_machine_and_after_its_silence_elsewhere() {
    let results = Results::new("killed");
    let observer = Leases::join(&results.0).unwrap();
    let (here, elsewhere) = (Leases::join(&results.0).unwrap(), far(&results.0));
    let far_file = elsewhere.process.path.clone();
    let (one, other) = (run(&here, &[0]), run(&elsewhere, &[1]));
    assert!(one.is_some() && other.is_some());
    assert!(matches!(observer.next(&[0, 1]).unwrap(), Next::Wait(2)));
    forget((one, other));
    kill(here);
    kill(elsewhere);
    let first = run(&observer, &[0, 1]).unwrap();
    assert_eq!(first.block, 0);
    assert!(matches!(observer.next(&[1]).unwrap(), Next::Wait(1)));
    let now = SystemTime::now();
    set_time(&far_file, now - SILENCE / 2);
    assert!(matches!(observer.next(&[1]).unwrap(), Next::Wait(1)), "some beats may be late");
    set_time(&far_file, now - SILENCE - BEAT);
    let second = run(&observer, &[1]).unwrap();
    assert_eq!(second.block, 1);
    let seen = workers(&results.0).unwrap();
    let ended = seen.iter().filter(|worker| worker.has_ended);
    assert_eq!((seen.len(), ended.count()), (3, 2));
    let own = seen.iter().find(|worker| !worker.has_ended).unwrap();
    assert_eq!((own.pid, &own.blocks), (std::process::id(), &[0, 1].into()));
    drop((first, second));
    clear(&results.0);
    assert!(folder_of(&results.0).exists(), "one is at work");
    drop(observer);
    clear(&results.0);
    assert!(!folder_of(&results.0).exists());
}

#[test]
fn a_process_killed_before_its_name_was_written_holds_a_block_no_longer_than_one_that_fell_silent()
{
    let results = Results::new("empty");
    let observer = Leases::join(&results.0).unwrap();
    let empty = path_of(&observer.folder, 7, 0);
    File::create(&empty).unwrap();
    assert!(matches!(observer.next(&[7]).unwrap(), Next::Wait(1)));
    set_time(&empty, SystemTime::now() - 2 * SILENCE);
    assert_eq!(run(&observer, &[7]).unwrap().number, 1);
}

/// Blocks of the simulated study.
const BLOCKS: u32 = 2500;

/// Processes at work at a time.
const AT_ONCE: usize = 150;

/// Processes in all: where one is killed another begins, and the last are not killed.
const IN_ALL: usize = 1000;

/// Time between two steps of every process.
const STEP: Duration = Duration::from_secs(5);

/// A process that runs blocks in simulated time.
struct Simulated {
    leases: Leases,
    /// Its block, number of the lease and end of the work.
    at_work: Option<(u32, u32, Duration)>,
    /// Until when it sleeps, as that of a closed laptop.
    asleep_until: Duration,
}

impl Simulated {
    fn begin(results: &Results, at: SystemTime) -> Self {
        let leases = far(&results.0);
        set_time(&leases.process.path, at);
        Self { leases, at_work: None, asleep_until: Duration::ZERO }
    }
}

/// A thousand processes take 2500 blocks of 10 to 90 s. One step in 25 of a process kills it, until all have begun; one in 300 puts it
/// to sleep for up to ten minutes. Every block is run, and for the second time only after the one that ran it was killed or slept.
#[test]
fn a_thousand_processes_that_are_killed_and_fall_asleep_run_every_block() {
    let results = Results::new("thousand");
    let start = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
    let mut chance = Chance(5);
    let mut begun = AT_ONCE;
    let mut processes: Vec<Simulated> =
        (0..AT_ONCE).map(|_| Simulated::begin(&results, start)).collect();
    let mut runs: BTreeMap<u32, u32> = BTreeMap::new();
    let (mut now, mut lost) = (Duration::ZERO, 0);
    let all: Vec<u32> = (0..BLOCKS).collect();
    while runs.len() < all.len() {
        now += STEP;
        let left: Vec<u32> =
            all.iter().copied().filter(|block| !runs.contains_key(block)).collect();
        for place in (0..processes.len()).rev() {
            let process = &mut processes[place];
            if process.asleep_until > now {
                continue;
            }
            if begun < IN_ALL && chance.one_in(25) {
                lost += u32::from(process.at_work.is_some());
                kill(processes.swap_remove(place).leases);
                processes.push(Simulated::begin(&results, start + now));
                begun += 1;
                continue;
            }
            set_time(&process.leases.process.path, start + now);
            if chance.one_in(300) {
                lost += u32::from(process.at_work.is_some());
                process.asleep_until = now + STEP * chance.up_to(120);
            }
            step(process, &left, now, &mut chance, &mut runs);
        }
        no_block_is_run_by_two_that_are_awake(&processes, now);
    }
    let again: u32 = runs.values().map(|times| times - 1).sum();
    assert!(lost > 500 && begun == IN_ALL, "{lost} lost, {begun} begun: too few for the test");
    assert!(again <= lost, "{again} blocks were run again, {lost} processes were lost");
    drop(processes);
    clear(&results.0);
    assert!(!folder_of(&results.0).exists());
}

/// A step of a process that is awake: it ends its block, or begins one of those left.
fn step(
    process: &mut Simulated,
    left: &[u32],
    now: Duration,
    chance: &mut Chance,
    runs: &mut BTreeMap<u32, u32>,
) {
    if let Some((block, number, until)) = process.at_work {
        if until > now {
            return;
        }
        *runs.entry(block).or_default() += 1;
        process.at_work = None;
        drop(Lease { block, number, leases: &process.leases });
    }
    let wanted: Vec<u32> = left.iter().copied().filter(|block| !runs.contains_key(block)).collect();
    if let Some(lease) = run(&process.leases, &wanted) {
        process.at_work = Some((lease.block, lease.number, now + STEP * (2 + chance.up_to(16))));
        forget(lease);
    }
}

fn no_block_is_run_by_two_that_are_awake(processes: &[Simulated], now: Duration) {
    let awake = processes.iter().filter(|process| {
        process.asleep_until == Duration::ZERO || process.asleep_until + SILENCE < now
    });
    let mut seen = BTreeMap::new();
    for (block, number, _) in awake.filter_map(|process| process.at_work) {
        assert_eq!(seen.insert(block, number), None, "block {block} is run twice at {now:?}");
    }
}

/// Chances by a linear congruence (Knuth's MMIX).
struct Chance(u64);

impl Chance {
    fn up_to(&mut self, most: u32) -> u32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from((self.0 >> 33) % u64::from(most + 1)).unwrap()
    }

    fn one_in(&mut self, of: u32) -> bool {
        self.up_to(of - 1) == 0
    }
}
