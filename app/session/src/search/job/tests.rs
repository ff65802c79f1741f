//! A search behind a window: run, paused, cancelled, read again.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::super::tests::place;
use endline_gear::Sources;

use super::*;
use crate::study::tests::Place;

fn request(place: &Place, trials: usize) -> SearchRequest {
    let library = place.library();
    let file = library.join("observations/made-up.toml");
    SearchRequest {
        text: std::fs::read_to_string(&file).unwrap(),
        root: place.0.join("searches"),
        file,
        files: Files {
            sources: Sources::from_folder(&library).unwrap(),
            root: library,
            scenario: None,
        },
        study: None,
        trials,
        threads: 2,
        neighbours: 0,
        normal_priority: true,
        only_reads: false,
    }
}

fn begin(request: SearchRequest) -> SearchJob {
    SearchJob::search(request, &Arc::new(PluginHost::empty()), &waker())
}

fn read(request: SearchRequest) -> SearchJob {
    begin(SearchRequest { only_reads: true, ..request })
}

fn waker() -> Waker {
    Arc::new(|| {})
}

fn ended(job: &SearchJob) -> State {
    let patience = Instant::now() + Duration::from_secs(60);
    while job.is_unfinished() {
        assert!(
            Instant::now() < patience,
            "waited in vain: {:?}, {:?}",
            job.state(),
            job.progress()
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    job.state()
}

#[test]
fn a_search_runs_to_its_end_and_is_read_again() {
    let place = place("job");
    let job = read(request(&place, 64));
    assert_eq!(ended(&job), State::Cancelled);
    assert!(job.found().stories.is_none() && !place.0.join("searches").exists());

    let job = begin(request(&place, 64));
    assert_eq!(ended(&job), State::Done);
    let found = job.found();
    assert_eq!((found.trials, found.stories.as_ref().unwrap().net), (64, 64));
    assert!(job.report().is_some());
    let read = read(request(&place, 64));
    assert_eq!(ended(&read), State::Cancelled);
    assert_eq!(read.found().stories, found.stories);
}

#[test]
fn a_search_that_is_paused_stands_still_and_one_that_is_cancelled_goes_on_later() {
    let place = place("job-paused");
    let job = begin(request(&place, 96));
    job.pause();
    assert_eq!(job.state(), State::Paused);
    job.cancel();
    assert_eq!(ended(&job), State::Cancelled);
    let run = job.progress().encounters.done;
    assert!(run < 96, "{run}");
    let job = begin(request(&place, 96));
    assert_eq!(ended(&job), State::Done);
    assert_eq!(job.progress().encounters.total, 0, "no story, no neighbour");
    assert_eq!(job.found().trials, 96);
}

#[test]
fn what_is_wrong_with_an_observation_is_told() {
    let place = place("job-wrong");
    let wrong = SearchRequest { text: "format = 1\n".into(), ..request(&place, 32) };
    let State::Failed(why) = ended(&begin(wrong)) else { panic!() };
    assert!(why.contains("made-up.toml"), "{why}");
}
