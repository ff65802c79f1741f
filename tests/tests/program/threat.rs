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
    assert!(called.stdout.contains("table of 2019 share no rows in an order"), "{}", called.stdout);
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
    place.endline(&wrong).fails(1, &["poll.csv:2", "no row of a threat table: column `RopeDiam`"]);
    let mixed = ["study", "threat", &study, "--out", &out, "--poll", "poll.csv", "--cap", "1 kN"];
    place.endline(&mixed).fails(2, &["--poll", "--cap"]);
    let none = ["study", "threat", &study, "--out", &out, "--curve", "rope"];
    place.endline(&none).fails(2, &["no such curve", "write curve = "]);
}

/// Two strengths of rope that no whale meets, so that every threat is 0 with Wilson's interval of 0 in 4.
const STRENGTHS: &str = r#"
format = 1
kind = "study"
name = "Threat by strength"
scenario = "weak-link-pull"
encounters = 4
baseline = "rope-1000"
event = "parted"

[[option]]
id = "rope-1000"
strength = "1000 lbf"
curve = "rope"
set = { "link.0.rating" = "1000 lbf" }

[[option]]
id = "rope-1250"
strength = "1250 lbf"
curve = "rope"
set = { "link.0.rating" = "1250 lbf" }

[encounter]
aim = ["warp"]

[encounter.tide]
choice = ["0 m/s", "0.1 m/s"]
source = "assumed"
"#;

#[test]
fn a_study_of_strengths_becomes_the_threat_by_strength_that_the_present_tool_reads() {
    let place = Place::new("threat-strength");
    let study = place.write("strengths.toml", STRENGTHS).display().to_string();
    let out = place.path("out").display().to_string();
    for what in ["run", "merge"] {
        place.endline(&["study", what, &study, "--out", &out]).done();
    }
    let to = place.path("threat.csv").display().to_string();
    let base = ["study", "threat", &study, "--out", &out];
    let called = place.endline(&[&base[..], &["--to", &to]].concat()).done();
    for text in
        ["curve `rope`, 2 simulated strengths", "1100 lbf *", "103 strengths of NOAA's table"]
    {
        assert!(called.stdout.contains(text), "{text}: {}", called.stdout);
    }
    let table = fs::read_to_string(&to).unwrap();
    let expected = "RopeStrength,Threat,Threat_Lower,Threat_Upper\n1000,0.000000,0.000000,0.489891\n1100,0.000000,0.000000,0.489891\n1200,0.000000,0.000000,0.489891\n";
    assert_eq!(table, expected);
    let bands = fs::read_to_string(place.path("threat-bands.csv")).unwrap();
    assert!(
        bands.contains("1000,0.000000,0.000000,0.489891,0.000000,0.000000,4,simulated")
            && bands.contains("1200,0.000000,0.000000,0.489891,0.000000,0.000000,4,interpolated"),
        "{bands}"
    );

    let cap = [&base[..], &["--cap", "1100 lbf", "--json"]].concat();
    let json = place.endline(&cap).done().json();
    assert_eq!(json["schema"], "endline.threat_by_strength/1");
    assert_eq!(json["strengths"].as_array().unwrap().len(), 3);
    assert_eq!(json["omitted_lbf"].as_array().unwrap().len(), 103);
    // NOAA's threat at 1,000 lbf is 0.04843, within 0 to 0.49.
    let first = &json["strengths"][0];
    assert_eq!((&first["noaa"]["threat"], &first["overlaps"]), (&0.04843.into(), &true.into()));
    assert!(first["relative"].is_null() && first["origin"] == "simulated");
    let trawl = &json["trawls"][9];
    assert_eq!(trawl["traps"], 10);
    // The mean of NOAA's threat over its lines of trawls of ten is 0.1072, by its own two tables.
    assert!((trawl["noaa"]["threat"].as_f64().unwrap() - 0.1072).abs() < 1e-4, "{trawl}");
    assert!(trawl["capped"]["noaa_change"]["threat"].as_f64().unwrap() < -0.4, "{trawl}");
    assert!(trawl["capped"]["simulated_change"].is_null(), "{trawl}");

    let wrong = [&base[..], &["--cap", "1700 lbf"]].concat();
    place.endline(&wrong).fails(2, &["a cap of 1700 lbf", "choose one from 1000 to 1250 lbf"]);
    let wrong = [&base[..], &["--curve", "ropes"]].concat();
    place.endline(&wrong).fails(2, &["no such curve", "`rope`"]);
    place.write("model.csv", "RopeStrength,Threat,Threat_Lower,Threat_Upper\n1000,1.5,0.3,0.01\n");
    let wrong = [&base[..], &["--model", "model.csv"]].concat();
    place.endline(&wrong).fails(1, &["model.csv:2", "column `Threat`", "1.5 is not from 0 to 1"]);
    place.write("lines.csv", "GearPerString_Applied,RopeStrength,Prop_Strength\n1,1000,0.5\n");
    let wrong = [&base[..], &["--strengths", "lines.csv"]].concat();
    place.endline(&wrong).fails(1, &["lines.csv:2", "the shares of 1 traps sum to 0.500"]);
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
