//! The threat table and the compliance sheet as their users call them.

use std::fs;

use crate::common::Place;

/// Two ropes by two lengths of trawl that no whale meets, so that every risk is none.
const STUDY: &str = r#"
format = 1
kind = "study"
name = "Threat"
scenario = "weak-link-pull"
encounters = 4
baseline = "thick-03"
event = "parted"

[[axis]]
id = "rope"
[[axis.value]]
id = "thin"
threat = { rope = "3/8in", diameter = "3/8 in", device = "NA" }
[[axis.value]]
id = "thick"
threat = { rope = "1/2in", diameter = "1/2 in", device = "NA" }
set = { "link.0.rating" = "200 lbf" }

[[axis]]
id = "traps"
[[axis.value]]
id = "03"
threat = { traps = 3 }
[[axis.value]]
id = "12"
threat = { traps = 12 }

[encounter]
aim = ["warp"]

[encounter.tide]
choice = ["0 m/s", "0.1 m/s"]
source = "assumed"
"#;

#[test]
fn a_study_becomes_a_table_that_the_tool_reads() {
    let place = Place::new("threat");
    let study = place.write("threat.toml", STUDY).display().to_string();
    let out = place.path("out").display().to_string();
    for what in ["run", "merge"] {
        place.endline(&["study", what, &study, "--out", &out]).done();
    }
    let to = place.path("risk.csv").display().to_string();
    let called = place.endline(&["study", "threat", &study, "--out", &out, "--to", &to]).done();
    assert!(called.stdout.contains("share no rows in an order"), "{}", called.stdout);
    let table = fs::read_to_string(&to).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk");
    for row in
        ["3/8in,0.375,3,NA,0.000000", "1/2in,0.5,50,NA,0.000000", "7/16in,0.4375,7,NA,0.000000"]
    {
        assert!(rows.contains(&row), "{row}: {table}");
    }
    assert!(!table.contains("5/8in") && !table.contains("SSS"), "{table}");
    let bands = fs::read_to_string(place.path("risk-bands.csv")).unwrap();
    assert!(
        bands.contains("1/2in,0.5,50,NA,0.000000,0.000000,0.489891,0.000000,0.000000,4,held"),
        "{bands}"
    );
    let json = place.endline(&["study", "threat", &study, "--out", &out, "--json"]).done().json();
    assert_eq!(json["rows"].as_array().unwrap().len(), 4);

    let aim = place.write("aim.toml", &STUDY.replace("\"warp\"", "\"wrap\"")).display().to_string();
    place.endline(&["study", "plan", &aim]).fails(1, &["aim.toml:", "no line `wrap`", "`warp`"]);

    let wrong = ["study", "threat", &study, "--out", &out, "--event", "partd"];
    place.endline(&wrong).fails(2, &["no such event", "parted"]);
    place.write("poll.csv", "Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk\n3/8in,thick,3,NA,0.6\n");
    let wrong = ["study", "threat", &study, "--out", &out, "--poll", "poll.csv"];
    place.endline(&wrong).fails(1, &["poll.csv:2", "no row of a threat table"]);
}

#[test]
fn a_gear_becomes_a_page() {
    let place = Place::new("sheet");
    let arguments =
        ["sheet", "trawl-5", "--area", "maine", "--on", "2024-06-01", "--depth", "30 m"];
    place.endline(&arguments).done();
    let page = fs::read_to_string(place.path("trawl-5-sheet.html")).unwrap();
    assert!(
        page.contains("endline sheet trawl-5 --area maine") && page.contains("Wire lobster trap")
    );
    place
        .endline(&["sheet", "trawl-5", "--area", "mane", "--on", "2024-06-01"])
        .fails(2, &["maine"]);
    let mut printed = place.command(&[&arguments[..], &["--pdf", "page.pdf"]].concat());
    let called = crate::common::called(printed.env("ENDLINE_BROWSER", "no-such-browser"));
    called.fails(1, &["page.pdf", "cannot be made", "no-such-browser"]);
}
