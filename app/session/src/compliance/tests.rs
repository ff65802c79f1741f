//! Sheets of the gear that ships.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;

use endline_gear::Date;

use super::*;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library")
}

fn sheet(assembly: &str, threat: Option<PathBuf>) -> Result<ComplianceSheet, Error> {
    let fishing = Fishing {
        area: "massachusetts".to_owned(),
        on: Date::parse("2024-06-01").unwrap(),
        depth_m: Some(25.0),
        distance_m: None,
        traps: None,
    };
    let packs = Packs::open(Some(&root()), &[]).unwrap();
    let sources = Sources::from_folder(&root()).unwrap();
    let request = Request { assembly, sources: &sources, fishing, tide_m_s: 0.25, threat };
    ComplianceSheet::of(&request, &packs, &PluginHost::empty())
}

#[test]
fn a_sheet_has_rules_strengths_and_the_command_that_reproduces_it() {
    let sheet = sheet("massachusetts-single", None).unwrap();
    let page = sheet.html().unwrap();
    for text in [
        "No verdict yet:",
        "ma.strength",
        "57 ft",
        "endline sheet massachusetts-single --area massachusetts --on 2024-06-01",
        &sheet.hash(),
        "no threat table was given",
    ] {
        assert!(page.contains(text), "{text}");
    }
    // Both seas are drawn: the second line dashed.
    assert!(
        page.contains("stroke-dasharray=\"none\"") && page.contains("stroke-dasharray=\"7 3\"")
    );
    assert_eq!(page, self::sheet("massachusetts-single", None).unwrap().html().unwrap());
}

#[test]
fn a_comparison_says_of_each_gear_what_its_own_sheet_says() {
    let sheets = ["single-bridle", "massachusetts-single"].map(|gear| sheet(gear, None).unwrap());
    let page = comparison(&sheets).unwrap();
    for sheet in &sheets {
        let own = sheet.html().unwrap();
        for text in [sheet.hash(), page::command(sheet), page::bodies(sheet)] {
            let text = text.replace('"', "&#34;");
            assert!(page.contains(&text) && own.contains(&text), "{text}");
        }
    }
    // The sleeves deliver less than the rope between them, and the bare endline fails the rule that they meet.
    assert!(page.contains("FAILS") && page.contains("ma.strength"), "{page}");
    assert!(comparison(&sheets[..1]).is_err());
}

#[test]
fn rope_above_the_seabed_of_a_taut_endline_is_its_height() {
    let sheet = sheet("single-bridle", None).unwrap();
    let [slack, _] = &sheet.rest;
    let whole: f64 = slack.shape.lines.iter().map(|line| line.length_m).sum();
    let above = comparison::above_the_seabed_m(&slack.shape, sheet.rules.depth_m);
    // The endline reaches from the seabed to the surface, and no more rope than there is stands in the water.
    assert!(above > sheet.rules.depth_m - 2.0 && above <= whole, "{above} of {whole}");
}

#[test]
fn the_threat_is_that_of_the_nearest_row_and_mistakes_of_the_table_stand_at_their_lines() {
    let head = "Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk,Risk_lo,Risk_hi,Risk_priors_lo,Risk_priors_hi,Risk_n,how\n";
    let row = |rope: &str, traps: u64, device: &str, risk: f64| {
        format!("\"{rope}\",0.375,{traps},{device},{risk},0.01,0.2,0.02,0.15,96,simulated\n")
    };
    let rows = [
        row("3/8in", 12, "NA", 0.11),
        row("3/8in", 3, "NA", 0.05),
        row("1,700", 3, "NA", 0.04),
        row("3/8in", 3, "SSS_Regular", 0.03),
    ];
    let file = std::env::temp_dir().join("endline-sheet-threat.csv");
    std::fs::write(&file, head.to_owned() + &rows.concat()).unwrap();
    let page = sheet("single-bridle", Some(file.clone())).unwrap().html().unwrap();
    assert!(page.contains("5.0 % end with the whale held fast; 1.0 to 20.0 % by chance"), "{page}");
    assert!(page.contains("The greatest risk in the table is 11.0 %."));

    std::fs::write(&file, head.to_owned() + &rows.concat().replace("0.05,", "much,")).unwrap();
    let Err(error) = sheet("single-bridle", Some(file)) else { panic!("it was read") };
    assert!(error.to_string().contains("endline-sheet-threat.csv:3"), "{error}");
}
