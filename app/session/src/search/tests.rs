//! The search by itself, with trials that are calculated and not run.

use std::fs;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use endline_gear::{Observation, Site};

use super::ending::AtSite;
use super::*;
use crate::campaign::{Control, Shard};
use crate::plugins::PluginHost;
use crate::study::tests::Place;

const OBSERVATION: &str = r#"format = 1
kind = "observation"
name = "Made up"
source = "a test"
confidence = "estimate"
encounters = "study"
[[site]]
part = "body"
[trailing]
length = ["1 m", "1 m"]
"#;

const STUDY: &str = r#"format = 1
kind = "study"
name = "Made up"
scenario = "small.toml"
encounters = 4
baseline = "one"
[[option]]
id = "one"
[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"
[encounter."body.0.mass"]
uniform = ["5 kg", "7 kg"]
source = "assumed"
[encounter."body.0.added_mass"]
uniform = ["0.4", "0.6"]
source = "assumed"
[encounter."line.0.rope"]
choice = ["pp-3-8", "sink-3-8"]
source = "assumed"
"#;

/// A question in a library of its own.
pub(super) fn place(name: &str) -> Place {
    let place = Place::new(&format!("search-{name}"));
    let library = place.library();
    fs::create_dir_all(library.join("observations")).unwrap();
    fs::write(library.join("studies/study.toml"), STUDY).unwrap();
    fs::write(library.join("observations/made-up.toml"), OBSERVATION).unwrap();
    place
}

fn asked(place: &Place, seed: u64) -> Question {
    let library = place.library();
    let opened = Question::open("made-up", None, Some(&library), &PluginHost::empty());
    Question { seed, ..opened.unwrap() }
}

/// The observation of these tests.
pub(crate) fn observation() -> Observation {
    Observation::read("made-up.toml", OBSERVATION).unwrap()
}

fn folder_of(place: &Place, name: &str, question: &Question) -> Folder {
    Folder::open(&place.0.join(name), None, question).unwrap()
}

fn effort(trials: usize, threads: usize, [part, of]: [u32; 2]) -> Effort {
    Effort { trials, threads, shard: Shard { part, of }, neighbours: 0, net: DEFAULT_NET }
}

/// Three kinds of story, each with a narrow pit of its own; only that of the head goes down to nothing.
fn made_up(point: &[f64]) -> RunEnding {
    let (kind, pit, floor) = match point[3] {
        share if share < 0.5 => ("head", [0.32, 0.81, 0.17], 0.0),
        _ if point[0] < 0.5 => ("body", [0.21, 0.4, 0.9], 1.4),
        _ => ("left_flipper", [0.77, 0.63, 0.55], 0.7),
    };
    let away: f64 = point.iter().zip(pit).map(|(share, pit)| (share - pit).powi(2)).sum();
    let distance = floor + 8.0 * away.sqrt();
    // As far from the observation as wanted: rope behind the whale that is too long costs the logarithm of its length.
    let behind_m = libm::exp(0.4 * distance);
    let body = AtSite { site: Site::Body, wraps: 0.0, tight: false, across: 0 };
    let ending = Ending { sites: vec![body], behind_m, ..Ending::default() };
    RunEnding { ending, first_part: kind.into(), simulated_s: 1.0, ..RunEnding::default() }
}

fn found(question: &Question, folder: &Folder, effort: &Effort) -> Vec<(Vec<f64>, f64)> {
    let control = Control::default();
    let rounds = rounds_of(question, folder, effort, made_up, &control, |_| {}).unwrap();
    let elites = rounds.elites.best.values();
    elites.map(|elite| (elite.point.clone(), elite.trial.distance)).collect()
}

#[test]
fn threads_shards_kills_and_a_longer_search_change_nothing() {
    let place = place("same");
    let question = asked(&place, 1);
    let whole = found(&question, &folder_of(&place, "whole", &question), &effort(600, 1, [0, 1]));
    let folder = folder_of(&place, "threads", &question);
    assert_eq!(found(&question, &folder, &effort(600, 4, [0, 1])), whole, "threads");

    let folder = folder_of(&place, "shards", &question);
    let shards = std::thread::scope(|scope| {
        let one = |part| {
            let (question, folder) = (&question, &folder);
            move || found(question, folder, &effort(600, 2, [part, 3]))
        };
        let all: Vec<_> = (0..3).map(|part| scope.spawn(one(part))).collect();
        all.into_iter().map(|shard| shard.join().unwrap()).collect::<Vec<_>>()
    });
    assert!(shards.iter().all(|shard| *shard == whole), "shards");

    // Killed after some rounds, with one part of a round lost; then on with other shards than before.
    let folder = folder_of(&place, "killed", &question);
    found(&question, &folder, &effort(250, 1, [0, 1]));
    let lost = fs::read_dir(&folder.path).unwrap().map(|entry| entry.unwrap().path());
    let is_lost = |file: &PathBuf| file.to_string_lossy().contains("round-00004.");
    let lost: Vec<PathBuf> = lost.filter(is_lost).collect();
    assert_eq!(lost.len(), 1);
    fs::remove_file(&lost[0]).unwrap();
    assert_eq!(found(&question, &folder, &effort(600, 2, [0, 1])), whole, "killed");
}

/// Every kind's pit is found to a quarter of what makes an ending unlike; the net alone stays three times as far away on average.
#[test]
fn local_searches_find_what_the_net_leaves() {
    let place = place("pits");
    let mut above = [0.0; 2];
    for seed in 1..=4 {
        let question = asked(&place, seed);
        let best = |net_alone: bool| {
            let folder = folder_of(&place, &format!("{seed}-{net_alone}"), &question);
            let net = if net_alone { 900 } else { DEFAULT_NET };
            let effort = Effort { net, ..effort(900, 1, [0, 1]) };
            found(&question, &folder, &effort).into_iter().map(|(_, distance)| distance)
        };
        let (searched, net): (Vec<f64>, Vec<f64>) = (best(false).collect(), best(true).collect());
        // By kind: body, head, left flipper.
        for ((searched, net), floor) in searched.iter().zip(&net).zip([1.4, 0.0, 0.7]) {
            assert!(searched - floor < 0.25, "seed {seed}: {searched} above {floor}");
            above = [above[0] + searched - floor, above[1] + net - floor];
        }
    }
    assert!(3.0 * above[0] < above[1], "{above:?}");
}

#[test]
fn endings_with_nothing_on_the_whale_are_counted_and_no_more_runs_are_reported_than_announced() {
    let place = place("free");
    let question = asked(&place, 1);
    let sheds = |point: &[f64]| {
        let run = made_up(point);
        let ending =
            if run.first_part == "left_flipper" { Ending::default() } else { run.ending.clone() };
        RunEnding { ending, ..run }
    };
    for (trials, least) in [(48, 64), (150, 150)] {
        let folder = folder_of(&place, &format!("of-{trials}"), &question);
        let (control, mut reported) = (Control::default(), Vec::new());
        let note = |progress: Progress| reported.push((progress.trials, progress.of));
        let effort = effort(trials, 1, [0, 1]);
        let rounds = rounds_of(&question, &folder, &effort, sheds, &control, note).unwrap();
        assert!(reported.iter().all(|(done, of)| done <= of), "{reported:?}");
        assert!(reported.last().is_some_and(|(done, of)| done == of && *of >= least));
        let count = control.progress().encounters;
        assert_eq!((count.done, count.done as usize), (count.total, rounds.trials));
        let stories = found::so_far(&rounds);
        assert_eq!((stories.free_kinds, stories.stories.len()), (1, 2));
        assert!(stories.stories.iter().all(|story| story.first_part != "left_flipper"));
        let answer = stories.answer();
        assert!(answer.contains("One more kind ends with nothing on the whale"), "{answer}");
    }
    for (trials, net, runs) in
        [(48, 128, 64), (64, 128, 64), (150, 128, 150), (33, 40, 40), (usize::MAX, 128, usize::MAX)]
    {
        assert_eq!(whole_rounds(trials, net), runs);
    }
}

#[test]
fn another_search_does_not_mix_with_what_a_folder_holds() {
    let place = place("mix");
    let question = asked(&place, 1);
    let folder = folder_of(&place, "results", &question);
    found(&question, &folder, &effort(40, 1, [0, 1]));
    fs::write(
        place.library().join("observations/made-up.toml"),
        OBSERVATION.replace("body", "head"),
    )
    .unwrap();
    let error = Folder::open(&folder.path, None, &asked(&place, 1)).unwrap_err().to_string();
    assert!(error.contains("choose another folder with --out"), "{error}");
    fs::write(folder.path.join("net.0-32.0of1"), b"not a round").unwrap();
    let (effort, control) = (effort(40, 1, [0, 1]), Control::default());
    let error = rounds_of(&question, &folder, &effort, made_up, &control, |_| {}).err().unwrap();
    assert!(error.to_string().contains("is damaged"), "{error}");
}

/// Cancelled within a round: runs are stored, none runs twice, and the search continues to the same end.
#[test]
fn a_search_cancelled_between_trials_continues_from_them() {
    let place = place("cancelled");
    let question = asked(&place, 1);
    let effort = effort(300, 2, [0, 1]);
    let whole = found(&question, &folder_of(&place, "whole", &question), &effort);
    let folder = folder_of(&place, "parts", &question);
    let (control, count) = (Control::default(), AtomicUsize::new(0));
    let counted = |point: &[f64]| {
        if count.fetch_add(1, Ordering::Relaxed) + 1 == 180 {
            control.cancel();
        }
        made_up(point)
    };
    let mut rounds = 0;
    let part = rounds_of(&question, &folder, &effort, counted, &control, |_| rounds += 1).unwrap();
    let run = count.load(Ordering::Relaxed);
    assert!((180..=181).contains(&run), "each thread finishes its trial: {run}");
    assert!(part.trials <= run && rounds > 3, "{} of {run}", part.trials);
    assert_eq!(usize::try_from(control.progress().encounters.done).unwrap(), run);

    let again = Control::default();
    let counted = |point: &[f64]| {
        count.fetch_add(1, Ordering::Relaxed);
        made_up(point)
    };
    let rest = rounds_of(&question, &folder, &effort, counted, &again, |_| {}).unwrap();
    assert_eq!(count.load(Ordering::Relaxed), rest.trials, "no trial is run twice");
    assert_eq!(usize::try_from(again.progress().encounters.found).unwrap(), run);
    let elites = rest.elites.best.values();
    let elites: Vec<_> = elites.map(|elite| (elite.point.clone(), elite.trial.distance)).collect();
    assert_eq!(elites, whole);
}

#[test]
fn observations_of_the_same_encounters_share_draws() {
    let place = place("shared");
    let shared = place.0.join("net");
    let runs = Mutex::new(Vec::new());
    let kept = |point: &[f64]| {
        runs.lock().unwrap().push(point.to_vec());
        made_up(point)
    };
    // Draws of a search, and how many of them it ran itself.
    let search = |name: &str, trials: usize| {
        let question = asked(&place, 1);
        let folder = Folder::open(&place.0.join(name), Some(&shared), &question).unwrap();
        let effort = Effort { net: 100, ..effort(trials, 1, [0, 1]) };
        let rounds =
            rounds_of(&question, &folder, &effort, kept, &Control::default(), |_| {}).unwrap();
        let ran = std::mem::take(&mut *runs.lock().unwrap());
        let own = rounds.prior_sample.iter().filter(|(point, _)| ran.contains(point)).count();
        (rounds.prior_sample.len(), own)
    };
    let observation = place.library().join("observations/made-up.toml");
    assert_eq!(search("one", 100), (100, 100));
    let other = OBSERVATION.replace(r#""1 m", "1 m""#, r#""2 m", "3 m""#);
    assert_ne!(other, OBSERVATION);
    fs::write(&observation, other).unwrap();
    assert_eq!(search("other", 100), (100, 0));
    // Each later round brings eight draws; the first search finds them stored when it continues.
    assert_eq!(search("other", 101), (108, 8));
    fs::write(&observation, OBSERVATION).unwrap();
    assert_eq!(search("one", 101), (108, 0));
}
