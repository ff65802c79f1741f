//! A run in which rope is forced through skin is not valid, and says so; the same run as the program makes it is.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::sync::Arc;

use crate::common::Place;
use endline_session::{Overrides, PluginHost, Prepared, Report, Run, RunOptions, prepare};
use endline_sim::geometry::crossing::pierces;
use endline_sim::model::Settings;
use endline_sim::whale::{pose, skin_all};
use endline_sim::{Model, ModelSpec};

/// The shipped encounter with a whale at 5 m/s, 5 cm a step: what is tested at the end of a step alone goes through a fin.
fn fast(place: &Place) -> String {
    let path = place.encounter();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("1.3 m/s", "5 m/s")).unwrap();
    path
}

/// Runs an encounter whose whale goes more than a rope's diameter in a step, with paths filtered or without, as far as a crossing.
fn run(prepared: &Prepared, swept: bool) -> Run {
    let spec = prepared.model.spec.clone();
    let settings =
        Settings { swept, contact_step_s: spec.settings.step_s, ..spec.settings.clone() };
    let model =
        Model::new(ModelSpec { settings, ..spec }).unwrap_or_else(|errors| panic!("{errors:?}"));
    let prepared = Prepared { model: Arc::new(model), ..prepared.clone() };
    let mut run =
        Run::new(prepared, RunOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    while !run.finished() && run.audit().tunnelled == 0 && run.step(run.pilot()).is_ok() {}
    run
}

/// Whether any segment passes through any triangle where they stand, each tried with each.
fn is_pierced(run: &Run) -> bool {
    let (whale, now) =
        (run.model().spec.whale.as_ref().unwrap(), run.state().whale.as_ref().unwrap());
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let skin =
        whale.skin.triangles.iter().map(|corners| corners.map(|corner| places[corner as usize]));
    let lines =
        run.model().line_nodes.iter().map(|nodes| &run.state().rope.position[nodes.clone()]);
    let pieces: Vec<_> =
        lines.flat_map(|line| line.windows(2).map(|ends| [ends[0], ends[1]])).collect();
    skin.into_iter().any(|triangle| pieces.iter().any(|ends| pierces(*ends, triangle)))
}

#[test]
fn a_forced_crossing_makes_a_run_invalid_and_is_reported() {
    let place = Place::new("crossing");
    let plugins = endline_tests::products().unwrap().join("plugins");
    let (host, problems) = PluginHost::discover(&[plugins]);
    assert!(problems.is_empty(), "{problems:?}");
    let path = fast(&place);
    let prepared = prepare(path.as_ref(), None, &host, Overrides::default())
        .unwrap_or_else(|error| panic!("{error}"));

    let forced = run(&prepared, false);
    let report = Report::from_run(&forced);
    println!("{:?} {:?}", report.audit, report.invalid_because);
    assert!(
        report.audit.tunnelled > 0,
        "the exact test along the paths finds rope that went through"
    );
    assert!(
        !report.is_valid()
            && report.invalid_because.iter().any(|why| why.contains("rope passed through skin")),
        "{:?}",
        report.invalid_because
    );

    let sound = run(&prepared, true);
    let report = Report::from_run(&sound);
    println!("{:?} {:?}", report.audit, report.invalid_because);
    assert!(
        !is_pierced(&sound) && report.is_valid() && report.audit.tunnelled == 0,
        "{:?}",
        report.invalid_because
    );
    assert!(sound.finished() && report.audit.contact_steps > 0, "rope met the whale");
}
