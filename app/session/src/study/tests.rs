//! Studies paused, cancelled, watched and queued, as the command line and the window run them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::{ResultsRequest, StudyResults, batch, merge, results};
use endline_gear::Sources;
use endline_sim::Model;

use super::folder::Folder;
use super::prepared::{Files, PreparedStudy};
use super::queue::{Part, Queue, StudyJob, StudyRequest};
use crate::campaign::control::{Control, Count, Progress};
use crate::campaign::{Shard, State};
use crate::encounters::Encounter;
use crate::plugins::PluginHost;

const STUDY: &str = r#"format = 1
kind = "study"
name = "Small"
scenario = "small.toml"
encounters = 24
baseline = "none"

[[option]]
id = "none"
set = { weak_links = false }

[[option]]
id = "weak"
set = { "link.0.rating" = "5 N" }

[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"
"#;

/// A small rig without a whale: these tests are about running, not about physics.
const SCENARIO: &str = r#"format = 1
kind = "scenario"
name = "Small rig"
source = "poly ball A-5: buoys/polyball-a5"
confidence = "derived"
duration = "0.2 s"
rope_nodes = 8
weak_links = true

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
float_height = "0.46 m"
drag_area = "0.187 m2"
added_mass = 0.5

[[line]]
id = "endline"
rope = "pp-3-8"
from = "foot"
to = "buoy"
length = "30 m"

[[link]]
id = "buoy-link"
rating = "600 lbf"
line = "endline"
end = "to"
"#;

/// Folders of the shipped library that the small rig needs.
const NEEDED: [&str; 5] = ["friction", "knots", "ropes", "sites", "weak-links"];

/// A folder with the study and a library of its own, removed at the end.
pub(crate) struct Place(pub(crate) PathBuf);

impl Place {
    pub(crate) fn new(name: &str) -> Self {
        let root = std::env::temp_dir().join(format!("endline-{name}-{}", std::process::id()));
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        for folder in NEEDED {
            let own = root.join("gear-library").join(folder);
            fs::create_dir_all(&own).unwrap();
            for file in fs::read_dir(shipped.join(folder)).unwrap().map(Result::unwrap) {
                if file.path().is_file() {
                    fs::copy(file.path(), own.join(file.file_name())).unwrap();
                }
            }
        }
        // A library is known by its folders of ropes and scenarios.
        fs::create_dir_all(root.join("gear-library/scenarios")).unwrap();
        let studies = root.join("gear-library/studies");
        fs::create_dir_all(&studies).unwrap();
        fs::write(studies.join("small.toml"), SCENARIO).unwrap();
        fs::write(studies.join("study.toml"), STUDY).unwrap();
        Self(root)
    }

    pub(crate) fn library(&self) -> PathBuf {
        self.0.join("gear-library")
    }

    pub(super) fn study(&self) -> PathBuf {
        self.library().join("studies/study.toml")
    }

    pub(super) fn open(&self) -> PreparedStudy {
        PreparedStudy::open(&self.study(), Some(&self.library()), &PluginHost::empty()).unwrap()
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A folder that stays behind does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Waits until something is so.
fn wait(what: &str, so: impl Fn() -> bool) {
    let start = Instant::now();
    while !so() {
        assert!(start.elapsed() < Duration::from_secs(60), "timeout: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn blocks_written(folder: &Folder) -> u32 {
    (0..folder.blocks()).map(|block| u32::from(folder.has(block))).sum()
}

/// Options that change one or several things, in scenario and library.
const DIFFERING: &str = r#"
[[option]]
id = "rope"
[option.set]
weak_links = false
"ropes/pp-3-8.strength" = "9 kN"

[[option]]
id = "places"
[option.set]
weak_links = false
"line.0.weak_places.strength" = "5 kN"
"line.0.weak_places.at" = ["10 m"]

[[option]]
id = "unrated"
remove = ["link.0.rating"]
[option.set]
"link.0.item" = "wl-600"

[[option]]
id = "linked"
"#;

#[test]
fn options_are_compared_with_the_baseline_by_what_differs() {
    let place = Place::new("differing");
    fs::write(
        place.study(),
        STUDY.replace(
            "[encounter",
            &format!(
                "{DIFFERING}
[encounter"
            ),
        ),
    )
    .unwrap();
    let opened = place.open();
    let of = |id: &str| {
        let option = &opened.options[opened.option(id).unwrap()];
        option.differs_in(&opened.options[opened.baseline]).join(" ")
    };
    assert_eq!(of("none"), "");
    assert_eq!(of("rope"), "ropes/pp-3-8.strength");
    assert_eq!(
        of("places"),
        "line.weak_places",
        "a table that the baseline has not is one difference"
    );
    assert_eq!(of("linked"), "weak_links", "the scenario has it otherwise than the baseline");
    assert_eq!(of("weak"), "link.rating weak_links");
    assert_eq!(of("unrated"), "link.item link.rating weak_links");
    let several: Vec<&str> = opened.several_differences().map(|(id, _)| id).collect();
    assert_eq!(several, ["weak", "unrated"], "in the order of the file");
    assert!(opened.plan_json(None).contains(r#""weak":["link.rating","weak_links"]"#));
}

#[test]
fn a_paused_study_does_not_advance_and_its_table_is_that_of_one_never_paused() {
    let place = Place::new("paused");
    let opened = place.open();
    let whole = Folder::open(&place.0.join("whole"), &opened).unwrap();
    batch::run(&opened, &whole, Shard::WHOLE, 2, &Control::default()).unwrap();

    let folder = Folder::open(&place.0.join("paused"), &opened).unwrap();
    let control = Control::default();
    std::thread::scope(|scope| {
        let run =
            scope.spawn(|| batch::run(&opened, &folder, Shard::WHOLE, 2, &control).map(|_| ()));
        wait("the first encounter", || control.progress().encounters.done > 0);
        control.pause();
        // Encounters in progress, one on each thread, still end.
        std::thread::sleep(Duration::from_millis(500));
        let done = control.progress().encounters.done;
        std::thread::sleep(Duration::from_millis(300));
        assert!(control.is_paused() && !run.is_finished());
        assert_eq!(control.progress().encounters.done, done, "a paused study does not advance");
        assert!(done < 24, "the study was over before it was paused");
        control.resume();
        run.join().unwrap().unwrap();
    });
    assert_eq!(control.progress().encounters, Count { done: 24, found: 0, total: 24 });
    let [one, other] =
        [&whole, &folder].map(|folder| merge::merge(&opened, folder).unwrap().table().csv());
    assert_eq!(one, other);
}

#[test]
fn a_cancelled_study_keeps_whole_blocks_and_a_second_call_continues_from_them() {
    let place = Place::new("cancelled");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    let control = Control::default();
    std::thread::scope(|scope| {
        let run = scope.spawn(|| batch::run(&opened, &folder, Shard::WHOLE, 1, &control));
        wait("the first block", || control.progress().blocks.done > 0);
        control.cancel();
        let progress = run.join().unwrap().unwrap();
        assert!(control.is_cancelled() && progress.blocks.done < progress.blocks.total);
    });
    let written = blocks_written(&folder);
    assert_eq!(written, control.progress().blocks.done, "blocks are whole or not there");

    let second = Control::default();
    let progress = batch::run(&opened, &folder, Shard::WHOLE, 1, &second).unwrap();
    assert_eq!(progress.blocks, Count { done: 24, found: written, total: 24 });
    assert_eq!(progress.encounters, Count { done: 24, found: written, total: 24 });
    assert_eq!(merge::merge(&opened, &folder).unwrap().rows().len(), 48);
}

#[test]
fn progress_counts_each_encounter_and_block_once_and_estimates_the_time_left() {
    let place = Place::new("progress");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    let seen: Arc<Mutex<Vec<Progress>>> = Arc::default();
    let watched = Arc::clone(&seen);
    let control = Control::new(move |progress| watched.lock().unwrap().push(*progress));
    // The second of three parts: encounters 1, 4, 7 and so on, each a block.
    batch::run(&opened, &folder, Shard { part: 1, of: 3 }, 2, &control).unwrap();
    let seen = seen.lock().unwrap();
    assert_eq!(seen.len(), 1 + 8 + 8);
    assert_eq!(seen[0].encounters, Count { done: 0, found: 0, total: 8 });
    assert_eq!(seen[0].left(), None, "there is no pace yet");
    for pair in seen.windows(2) {
        let steps = [pair[1].encounters, pair[1].blocks]
            .iter()
            .zip([pair[0].encounters, pair[0].blocks])
            .map(|(after, before)| after.done - before.done)
            .sum::<u32>();
        assert_eq!(steps, 1, "one encounter or one block at a time");
    }
    let half = seen.iter().find(|progress| progress.encounters.done == 4).unwrap();
    assert!(half.left().unwrap() > Duration::ZERO && (half.share() - 0.5).abs() < 1e-6);
    let last = control.progress();
    assert_eq!((last.blocks.done, last.left()), (8, Some(Duration::ZERO)));
}

#[test]
fn a_cancelled_control_stays_cancelled() {
    let control = Control::default();
    control.pause();
    assert!(control.is_paused());
    control.cancel();
    control.resume();
    control.pause();
    assert!(control.is_cancelled() && !control.is_paused() && !control.may_continue());
}

#[test]
fn queued_studies_are_run_one_after_the_other_and_their_results_can_be_read() {
    let place = Place::new("queued");
    let second = place.library().join("studies/second.toml");
    fs::write(&second, STUDY.replace("encounters = 24", "encounters = 4")).unwrap();
    let (host, root) = (Arc::new(PluginHost::empty()), place.0.join("results"));
    let job = |file: PathBuf| {
        let sources = Sources::from_folder(&place.library()).unwrap();
        let request = StudyRequest {
            text: fs::read_to_string(&file).unwrap(),
            file,
            name: "Small".into(),
            files: Files { root: place.library(), sources, scenario: None },
            root: root.clone(),
            part: Part::Whole,
        };
        StudyJob::new(request, Arc::new(|| {}))
    };
    let mut queue = Queue { normal_priority: true, ..Queue::default() };
    queue.add(job(place.study()));
    queue.add(job(second.clone()));
    queue.add(job(second.clone()));
    assert_eq!(queue.jobs.len(), 2, "a study is in the queue once");
    queue.begin_next(&host);
    queue.begin_next(&host);
    assert_eq!(queue.jobs[1].state(), State::Waiting, "one study at a time");
    queue.jobs[0].pause();
    wait("the pause", || queue.jobs[0].state() == State::Paused);
    queue.jobs[0].cancel();
    assert!(queue.unfinished(&place.study()).is_none(), "a cancelled study can be queued again");
    assert_eq!(queue.current().unwrap().request.file, second, "the next study is current");
    wait("the end of its threads", || !queue.jobs[0].is_unfinished());
    assert_eq!(queue.jobs[0].state(), State::Cancelled);
    queue.begin_next(&host);
    wait("the second study", || !queue.jobs[1].is_unfinished());
    assert_eq!(queue.jobs[1].state(), State::Done);
    let folder = queue.jobs[1].folder().unwrap();
    for file in ["table.parquet", "report.html"] {
        assert!(folder.join(file).is_file(), "{file}");
    }
    let request = ResultsRequest {
        file: Some(second),
        library: place.library(),
        root: root.clone(),
        ..ResultsRequest::default()
    };
    let read = StudyResults::read(request, &host).unwrap().unwrap();
    assert!(read.whole && read.runs.rows().len() == 8 && read.folder == folder);
    let reported: Vec<bool> = results::list(&root).iter().map(|found| found.reported).collect();
    assert!(reported.contains(&true) && reported.contains(&false), "{reported:?}");
}

#[test]
fn a_finer_resolution_halves_segments_and_steps_and_keeps_the_encounter() {
    let place = Place::new("finer");
    let study = place.library().join("studies/study.toml");
    let opened = PreparedStudy::open(&study, Some(&place.library()), &PluginHost::empty()).unwrap();
    let encounter = Encounter::of(&opened.study, 3);
    let [usual, finer] =
        [opened.play(0, &encounter, 0.0).unwrap(), opened.play_finer(0, &encounter).unwrap()]
            .map(|played| played.run.model().clone());
    assert_eq!(finer.node_count, 2 * usual.node_count);
    let step_s = |model: &Model| model.spec.settings.contact_step_s;
    assert!((step_s(&finer) - 0.5 * step_s(&usual)).abs() < 1e-12);
    assert_eq!(finer.spec.bodies[0].drag_area_m2, usual.spec.bodies[0].drag_area_m2);
}
