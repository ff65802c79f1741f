//! A study with tracks through gear: a whale meets the gear that its track shows, rates are by distance, and mistakes are explained.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fs;

use endline_session::encounters::Encounter;
use endline_session::plugins::PluginHost;
use endline_session::study::PreparedStudy;

use crate::common::{Place, edit};

/// Singles in a small area, and a whale that swims straight on.
const STUDY: &str = r#"
format = 1
kind = "study"
name = "Tracks"
scenario = "tracks.toml"
encounters = 6
baseline = "single"
event = "contact"

[run]
passed = "25 s"
held = "1 s"

[[option]]
id = "single"

[[option]]
id = "none-near"
set = { "field.0.position" = ["40 km", "0 m"] }

[exposure]
area = ["400 m", "400 m"]
distance = "1 km"
leg = "100 m"
turn = "20 deg"
source = "assumed"

[encounter]
gap = "6 m"

[encounter.depth]
bins = ["8 m", "14 m"]
weights = [1]
source = "assumed"

[encounter.tide]
choice = ["0.1 m/s", "0.25 m/s"]
source = "assumed"
"#;

/// The shipped field, coarser and smaller, beside its study.
fn study(place: &Place) -> String {
    let folder = place.library().join("studies");
    let scenario =
        fs::read_to_string(place.library().join("scenarios/cross-a-field.toml")).unwrap();
    let scenario = scenario
        .replace("segment = \"25 cm\"", "segment = \"1 m\"")
        .replace("[resolution]\nnear = \"10 cm\"\nedges = \"5 cm\"\n", "")
        .replace("area = [\"400 m\", \"240 m\"]", "area = [\"380 m\", \"380 m\"]")
        .replace("duration = \"600 s\"", "duration = \"60 s\"");
    fs::write(folder.join("tracks.toml"), scenario).unwrap();
    let study = folder.join("study.toml");
    fs::write(&study, STUDY).unwrap();
    study.display().to_string()
}

#[test]
fn whales_meet_the_gear_on_their_tracks_and_rates_are_by_distance() {
    let place = Place::new("exposure");
    let file = study(&place);
    let out = place.folder.join("out").display().to_string();
    place.endline(&["study", "run", &file, "--out", &out]).done();
    place.endline(&["study", "merge", &file, "--out", &out]).done();
    let report = place.endline(&["study", "report", &file, "--out", &out, "--all"]).done();
    assert!(report.stdout.contains("in 100 km that a whale swims among 24 gears"), "{report}");
    assert!(report.stdout.contains("gear within reach"), "{report}");
    let page = fs::read_to_string(place.folder.join("out/report.html")).unwrap();
    assert!(page.contains("Rates by distance swum"));
    assert!(!page.contains("The frequency of encounters is not known here"));

    let table = fs::read_to_string(place.folder.join("out/table.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let column = |name: &str| names.iter().position(|known| *known == name).unwrap();
    let [option, outcome, valid, swum, meetings, met] =
        ["option", "outcome", "valid", "swum_m", "meetings", "met_gear"].map(column);
    let (mut touched, mut met_any) = (0, 0);
    for row in lines {
        assert_eq!(row[valid], "true", "{row:?}");
        assert!((row[swum].parse::<f64>().unwrap() - 1000.0).abs() < 1e-6, "{row:?}");
        let count: u32 = row[meetings].parse().unwrap();
        assert_eq!(count == 0, row[met].is_empty(), "{row:?}");
        if row[option] == "none-near" || count == 0 {
            assert_eq!((count, row[outcome]), (0, "no_contact"), "{row:?}");
        }
        met_any += u32::from(count > 0);
        touched += u32::from(count > 0 && row[outcome] != "no_contact");
    }
    // 24 lines of 25 m depth in 0.16 km²: more than one meeting for each track; most touch the whale.
    assert!(met_any >= 3 && touched >= 2, "{touched} of {met_any}");
}

/// The whale starts on its track, its snout the gap before the rope that passes mid-body within its reach.
#[test]
fn a_whale_starts_before_the_gear_that_it_meets_which_is_simulated_alone() {
    let place = Place::new("exposure-start");
    let file = study(&place);
    let plugins = endline_tests::products().unwrap().join("plugins");
    let (host, problems) = PluginHost::discover(&[plugins]);
    assert!(problems.is_empty(), "{problems:?}");
    let opened = PreparedStudy::open(file.as_ref(), None, &host).unwrap();
    let mut found = 0;
    for index in 0..6 {
        let encounter = Encounter::of(&opened.study, index);
        let option = opened.option("single").unwrap();
        let Ok(prepared) = opened.prepare(option, &encounter) else { continue };
        found += 1;
        let whale = prepared.model.spec.whale.as_ref().unwrap();
        assert_eq!(prepared.model.spec.bodies.len(), 2, "one trap and one buoy");
        let played = opened.play(option, &encounter, 0.0).unwrap();
        let first_s = played.report.summary.whale.as_ref().unwrap().first_contact_s;
        if let Some(first_s) = first_s {
            // Between the gap alone, and the gap with the whole body, at its speed.
            let speed_m_s = whale.speed_m_s;
            let latest_s = (6.0 + whale.length_m + 4.0) / (speed_m_s - 0.25);
            assert!(first_s > 3.0 / (speed_m_s + 0.25) && first_s < latest_s, "{first_s} s");
        }
    }
    assert!(found >= 3, "{found}");
}

#[test]
fn a_scenario_without_fields_is_refused() {
    let place = Place::new("exposure-wrong");
    let file = study(&place);
    edit(file.as_ref(), "scenario", "scenario = \"hello-endline\"");
    place.endline(&["study", "plan", &file]).fails(1, &["[exposure]", "[[field]]"]);
}
