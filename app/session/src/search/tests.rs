//! The search by itself, with trials that are calculated and not run.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;
use crate::plugins::PluginHost;
use crate::study::Shard;

const OBSERVATION: &str = r#"format = 1
kind = "observation"
name = "Made up"
source = "a test"
confidence = "estimate"
encounters = "study"
[[site]]
part = "body"
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

const SCENARIO: &str = r#"format = 1
kind = "scenario"
name = "Small rig"
source = "made up"
confidence = "estimate"
duration = "0.2 s"
rope_nodes = 8
[site]
item = "cape-cod-bay"
[[fixture]]
id = "foot"
position = ["0 m", "0 m", "-24.6 m"]
[[body]]
id = "buoy"
role = "buoy"
position = ["2 m", "0 m", "0.2 m"]
radius = "0.345 m"
mass = "6 kg"
volume = "172 L"
drag_area = "0.187 m2"
added_mass = 0.5
[[line]]
id = "endline"
rope = "pp-3-8"
from = "foot"
to = "buoy"
length = "30 m"
"#;

/// A library of its own with the question, removed at the end.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let root =
            std::env::temp_dir().join(format!("endline-search-{name}-{}", std::process::id()));
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        for folder in ["friction", "knots", "ropes", "sites"] {
            fs::create_dir_all(root.join(folder)).unwrap();
            for file in fs::read_dir(shipped.join(folder)).unwrap().map(Result::unwrap) {
                if file.path().is_file() {
                    fs::copy(file.path(), root.join(folder).join(file.file_name())).unwrap();
                }
            }
        }
        for (file, text) in [
            ("scenarios/none.txt", ""),
            ("studies/small.toml", SCENARIO),
            ("studies/study.toml", STUDY),
            ("observations/made-up.toml", OBSERVATION),
        ] {
            fs::create_dir_all(root.join(file).parent().unwrap()).unwrap();
            fs::write(root.join(file), text).unwrap();
        }
        Self(root)
    }

    fn question(&self, seed: u64) -> Question {
        let mut question =
            Question::open("made-up", None, Some(&self.0), &PluginHost::empty()).unwrap();
        question.seed = seed;
        question
    }

    fn folder(&self, name: &str, question: &Question) -> Folder {
        Folder::open(&self.0.join(name), question).unwrap()
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A folder that stays behind does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn effort(trials: usize, threads: usize, [part, of]: [u32; 2]) -> Effort {
    Effort { trials, threads, shard: Shard { part, of }, neighbours: 0, net_alone: false }
}

/// Three kinds of story, each with a narrow pit of its own; only that of the head goes down to nothing.
fn made_up(point: &[f64]) -> Trial {
    let (kind, pit, floor) = match point[3] {
        share if share < 0.5 => ("head", [0.32, 0.81, 0.17], 0.0),
        _ if point[0] < 0.5 => ("body", [0.21, 0.4, 0.9], 1.4),
        _ => ("left_flipper", [0.77, 0.63, 0.55], 0.7),
    };
    let away: f64 = point.iter().zip(pit).map(|(share, pit)| (share - pit).powi(2)).sum();
    let distance = floor + 8.0 * away.sqrt();
    Trial {
        distance,
        nearest: distance,
        terms: Vec::new(),
        mirrored: false,
        first_part: kind.into(),
        outcome: "entangled".into(),
        fault: String::new(),
        simulated_s: 1.0,
        state_hash: String::new(),
    }
}

fn found(question: &Question, folder: &Folder, effort: &Effort) -> Vec<(Vec<f64>, f64)> {
    let rounds = rounds_of(question, folder, effort, made_up, |_| {}).unwrap();
    let elites = rounds.elites.0.values();
    elites.map(|elite| (elite.point.clone(), elite.trial.distance)).collect()
}

#[test]
fn threads_shards_kills_and_a_longer_search_change_nothing() {
    let place = Place::new("same");
    let question = place.question(1);
    let whole = found(&question, &place.folder("whole", &question), &effort(600, 1, [0, 1]));
    let folder = place.folder("threads", &question);
    assert_eq!(found(&question, &folder, &effort(600, 4, [0, 1])), whole, "threads");

    let folder = place.folder("shards", &question);
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
    let folder = place.folder("killed", &question);
    found(&question, &folder, &effort(250, 1, [0, 1]));
    fs::remove_file(folder.path.join("round-00004.0of1")).unwrap();
    assert_eq!(found(&question, &folder, &effort(600, 2, [0, 1])), whole, "killed");
}

/// Every kind's pit is found to a quarter of what makes an ending unlike; the net alone stays three times as far away on average.
#[test]
fn local_searches_find_what_the_net_leaves() {
    let place = Place::new("pits");
    let mut above = [0.0; 2];
    for seed in 1..=4 {
        let question = place.question(seed);
        let best = |net_alone: bool| {
            let folder = place.folder(&format!("{seed}-{net_alone}"), &question);
            let effort = Effort { net_alone, ..effort(900, 1, [0, 1]) };
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
fn another_search_does_not_mix_with_what_a_folder_holds() {
    let place = Place::new("mix");
    let question = place.question(1);
    let folder = place.folder("results", &question);
    found(&question, &folder, &effort(40, 1, [0, 1]));
    fs::write(place.0.join("observations/made-up.toml"), OBSERVATION.replace("body", "head"))
        .unwrap();
    let error = Folder::open(&folder.path, &place.question(1)).unwrap_err().to_string();
    assert!(error.contains("choose another folder with --out"), "{error}");
    fs::write(folder.path.join("net-00000.0of1"), b"not a round").unwrap();
    let error =
        rounds_of(&question, &folder, &effort(40, 1, [0, 1]), made_up, |_| {}).err().unwrap();
    assert!(error.to_string().contains("is damaged"), "{error}");
}
