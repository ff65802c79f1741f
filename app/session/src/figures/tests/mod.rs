//! Each figure reads the field of its name, and stands in JSON under its key.
//!
//! In the made-up summary no two numbers are the same, so that a figure that reads another's field
//! is found out.

pub mod made_up;

use std::fmt::Debug;

use endline_sdk::BodyPart;
use endline_sim::CostPart;
use endline_sim::balance::Source;
use endline_sim::metrics::{Outcome, Summary, WhaleSummary};

use super::*;
use crate::json;
use crate::report::Report;

/// Keys whose field has another name.
const FIELDS: [(&str, &str); 2] = [("final", "last"), ("settled", "converged")];

/// Keys of a run that are not fields of its summary; tested one by one below.
const COMPUTED: [&str; 13] = [
    "schema",
    "version",
    "headline",
    "valid",
    "wall_s",
    "times_real_time",
    "steps_mostly_limited_by",
    "peak_tension_N",
    "peak_line",
    "peak_at_s",
    "link_peak_N",
    "parted",
    "parted_at_s",
];

/// Keys of the whale that are computed from its state at the end; tested below, but for the outcome.
const OF_STATE: [&str; 8] = [
    "outcome",
    "rope_on_head",
    "rope_on_flipper",
    "rope_on_tail",
    "wraps_present",
    "constricting",
    "trailing",
    "anchored",
];

/// How Rust writes a value as a field of a structure.
fn written(value: &Value) -> String {
    match value {
        Value::Number(number) | Value::Measured { value: number, .. } => format!("{number:?}"),
        Value::Whole(count) => count.to_string(),
        Value::Flag(flag) => flag.to_string(),
        Value::Text(text) => format!("{text:?}"),
        Value::Texts(texts) => format!("{texts:?}"),
        Value::Vector([x, y, z]) => format!("DVec3({x:?}, {y:?}, {z:?})"),
        other => format!("{other:?}"),
    }
}

/// Each figure of a list has the value of the field of its key, and stands in JSON under that key.
fn reads<S, D: Debug>(figures: &[Figure<S>], source: &S, data: &D, elsewhere: &[&str]) -> usize {
    let (data, json) =
        (format!("{data:?}"), serde_json::to_value(object(figures, source)).unwrap());
    let mut tried = 0;
    for figure in figures {
        let value = (figure.read)(source);
        assert_eq!(json.get(figure.key).is_some(), figure.in_json, "{} in JSON", figure.key);
        if figure.in_json {
            assert_eq!(json[figure.key], serde_json::to_value(&value).unwrap(), "{}", figure.key);
        }
        if figure.quantity == Quantity::Group || elsewhere.contains(&figure.key) {
            continue;
        }
        let own = figure.key.to_lowercase();
        let field =
            FIELDS.iter().find(|(key, _)| *key == own).map_or(own.as_str(), |named| named.1);
        let value = written(&value);
        let found = [format!(" {field}: {value}"), format!(" {field}: Some({value})")]
            .iter()
            .any(|text| data.contains(text.as_str()));
        assert!(found, "{} reads {value}, which is not `{field}` of {data}", figure.key);
        tried += 1;
    }
    tried
}

#[test]
fn every_figure_reads_the_field_of_its_key() {
    let report = made_up::report();
    let whale = report.summary.whale.as_ref().unwrap();
    let (lines, parts) = (lines(&report.summary, &report.settled_tension_n), parts(whale, &[]));
    let balance = report.balance.as_ref().unwrap();
    let by_source: Vec<_> = BALANCE.iter().map(|figure| figure.key).filter(is_by_source).collect();
    let tried = [
        reads(RUN, &report, &report, &COMPUTED),
        reads(AUDIT, &report, &(&report.audit, whale), &COMPUTED),
        reads(BALANCE, balance, balance, &by_source),
        reads(SETTLED, &report, &report.settled, &["wall_s"]),
        reads(PHASE, &report.timing.contact, &report.timing.contact, &["times_real_time"]),
        reads(LINE, &lines[1], &lines[1].summary, &["settled_tension_N"]),
        reads(LINK, &report.summary.links[1], &report.summary.links[1], &[]),
        reads(
            BODY,
            &report.summary.bodies[1],
            &report.summary.bodies[1],
            &["whale_part", "peak_whale_part"],
        ),
        reads(PROBE, &report.summary.probes[0], &report.summary.probes[0], &[]),
        reads(WHALE, whale, whale, &OF_STATE),
        reads(BEAT, whale.beat.as_ref().unwrap(), &whale.beat, &[]),
        reads(
            KINETIC,
            whale.kinetic.as_ref().unwrap(),
            &whale.kinetic,
            &["residual_Ns", "residual_J"],
        ),
        reads(PART, &parts[3], &parts[3].summary, &["region", "normal_now_N"]),
        reads(PATCH, &whale.patches[5], &whale.patches[5], &["patch"]),
        reads(EVENT, &report.events[0], &report.events[0], &["kind", "unit"]),
        reads(PLUGIN, &report.plugins[0], &report.plugins[0], &[]),
    ];
    assert!(tried.iter().all(|count| *count > 0), "{tried:?}");
    assert!(tried.iter().sum::<usize>() > 100, "{tried:?}");
}

/// The value of a key.
fn value<S>(figures: &[Figure<S>], key: &str, source: &S) -> Value {
    (figures.iter().find(|figure| figure.key == key).unwrap().read)(source)
}

/// A figure of a held whale, and the change of its state that makes it true.
type StateChange = (&'static str, fn(&mut WhaleSummary));

/// One change of a whale that is only just held makes one of the figures true, and none once it is free.
#[test]
fn figures_of_a_held_whale_are_those_of_its_state() {
    let mut held = made_up::report().summary.whale.unwrap();
    for part in &mut held.regions {
        (part.touching, part.wraps, part.touching_wraps) = (false, 0.4, 0.7);
    }
    (held.trailing_m, held.tethered_m, held.speed_made_good_m_s) = (0.9, 0.0, 0.1);
    let all_true = |whale: &WhaleSummary| -> Vec<&str> {
        let is_true = |key: &&&str| value(WHALE, key, whale) == true.into();
        OF_STATE[1..].iter().filter(is_true).copied().collect()
    };
    assert!(all_true(&held).is_empty(), "{:?}", all_true(&held));
    let changes: [StateChange; 10] = [
        ("rope_on_head", |whale| whale.lodged_in_mouth = true),
        ("rope_on_head", |whale| whale.regions[BodyPart::Head as usize].touching = true),
        ("rope_on_flipper", |whale| whale.regions[BodyPart::RightFlipper as usize].touching = true),
        ("rope_on_tail", |whale| whale.regions[BodyPart::LeftFluke as usize].touching = true),
        ("rope_on_tail", |whale| whale.regions[BodyPart::Peduncle as usize].touching = true),
        ("wraps_present", |whale| whale.regions[BodyPart::Body as usize].wraps = 0.5),
        ("constricting", |whale| whale.regions[BodyPart::Body as usize].touching_wraps = 0.75),
        ("trailing", |whale| whale.trailing_m = 1.1),
        ("anchored", |whale| whale.tethered_m = 3.0),
        ("", |whale| (whale.tethered_m, whale.speed_made_good_m_s) = (3.0, 0.11)),
    ];
    for (key, change) in changes {
        let mut whale = held.clone();
        change(&mut whale);
        assert_eq!(all_true(&whale).concat(), key);
        whale.outcome = Outcome::Shed;
        assert!(all_true(&whale).is_empty(), "{key}");
    }
}

/// Whether a figure of the balance is one of a source, or computed; tested below.
fn is_by_source(key: &&str) -> bool {
    let computed = ["residual_share", "numerical_damping_J"];
    key.ends_with("_impulse_Ns") || key.ends_with("_work_J") || computed.contains(key)
}

#[test]
fn figures_of_the_balance_are_those_of_their_source() {
    let report = made_up::report();
    let balance = report.balance.as_ref().unwrap();
    for source in Source::ALL {
        let (impulse, work) =
            (balance.impulse_ns[source as usize], balance.work_j[source as usize]);
        let key = |of: &str| format!("{}_{of}", source.name());
        assert_eq!(value(BALANCE, &key("impulse_Ns"), balance), impulse.into());
        assert_eq!(value(BALANCE, &key("work_J"), balance), work.into());
    }
    assert_eq!(value(BALANCE, "residual_share", balance), balance.residual_share().into());
    let damping = balance.numerical_damping_j();
    assert_eq!(value(BALANCE, "numerical_damping_J", balance), damping.into());
}

#[test]
fn figures_of_a_run_that_are_computed() {
    let report = made_up::report();
    let run = |key| value(RUN, key, &report);
    let whole = report.timing.whole();
    assert_eq!(run("schema"), "endline.run/1".into());
    assert_eq!(run("version"), crate::VERSION.into());
    assert_eq!(run("headline"), vec!["It ended.".to_owned()].into());
    assert_eq!(run("valid"), false.into());
    assert_eq!(run("wall_s"), whole.wall_s.into());
    assert_eq!(run("times_real_time"), whole.times_real_time().into());
    // Numbers rise from field to field: the last line and the last link bore most, the first line parted first.
    let (lines, links) = (&report.summary.lines, &report.summary.links);
    assert_eq!(run("peak_tension_N"), lines[1].peak_tension_n.into());
    assert_eq!(run("peak_line"), "endline-foot".into());
    assert_eq!(run("peak_at_s"), lines[1].peak_at_s.into());
    assert_eq!(run("link_peak_N"), links[1].peak_tension_n.into());
    assert_eq!(run("parted"), "endline-top".into());
    assert_eq!(run("parted_at_s"), lines[0].parted_at_s.into());
    let Value::Counts(counts) = value(AUDIT, "steps_limited_by", &report) else {
        panic!("counts by name")
    };
    assert_eq!(counts["snap"], report.audit.limited_by[2]);
    let mostly = value(AUDIT, "steps_mostly_limited_by", &report);
    assert!(matches!(mostly, Value::Text(text) if text.starts_with("forces that converge")));
    let body = &report.summary.bodies[1];
    assert_eq!(value(BODY, "whale_part", body), "head".into());
    assert_eq!(value(BODY, "peak_whale_part", body), "peduncle".into());
    assert_eq!(value(SETTLED, "wall_s", &report), report.timing.settle_wall_s.into());
}

#[test]
fn figures_of_a_part_of_a_run_that_are_computed() {
    let report = made_up::report();
    let whale = report.summary.whale.as_ref().unwrap();
    let lines = lines(&report.summary, &report.settled_tension_n);
    assert_eq!(value(LINE, "settled_tension_N", &lines[1]), report.settled_tension_n[1].into());
    assert_eq!(value(PHASE, "times_real_time", &report.timing.contact), {
        report.timing.contact.times_real_time().into()
    });
    assert_eq!(value(WHALE, "outcome", whale), "parted_entangled".into());
    assert_eq!(value(PART, "region", &parts(whale, &[])[3]), "right_flipper".into());
    let region = whale.patches[5].region;
    assert_eq!(value(PATCH, "patch", &whale.patches[5]), region.name().into());
    assert_eq!(value(EVENT, "kind", &report.events[0]), "link_parted".into());
    assert_eq!(value(EVENT, "unit", &report.events[0]), "N".into());
}

#[test]
fn the_summary_nests_the_lists() {
    let report = made_up::report();
    let whale = report.summary.whale.as_ref().unwrap();
    let json: serde_json::Value = serde_json::from_str(&json::line(&report)).unwrap();
    assert_eq!(json["audit"]["passes"], report.audit.passes);
    let balance = report.balance.as_ref().unwrap();
    assert_eq!(json["audit"]["balance"]["residual_Ns"], balance.residual_ns);
    assert_eq!(json["lines"][1]["drag_N"][2], report.summary.lines[1].drag_n.z);
    assert_eq!(json["links"][0]["rating_N"], report.summary.links[0].rating_n);
    assert_eq!(json["bodies"][1]["position_m"][0], report.summary.bodies[1].position_m.x);
    assert_eq!(json["probes"][0]["final"], report.summary.probes[0].last);
    assert_eq!(json["whale"]["regions"][6]["wraps"], whale.regions[6].wraps);
    assert_eq!(json["whale"]["patches"][19]["friction_N"], whale.patches[19].friction_n);
    assert_eq!(json["whale"]["beat"]["beats"], whale.beat.unwrap().beats);
    assert_eq!(json["whale"]["kinetic"]["power_W"], whale.kinetic.unwrap().power_w);
    assert_eq!(json["approach"]["wall_s"], report.timing.approach.wall_s);
    assert_eq!(json["contact"]["simulated_s"], report.timing.contact.simulated_s);
    let cost = &report.timing.cost;
    assert_eq!(json["cost"]["whole_s"], cost.whole_s());
    for (figure, part) in COST[1..].iter().zip(CostPart::ALL.iter().copied()) {
        assert_eq!(json["cost"][figure.key], cost.of_s(part), "{}", figure.key);
    }
    assert_eq!(json["settled"]["residual_N"], report.settled.residual_n);
    assert_eq!(json["events"][1]["kind"], "wrap");
    assert_eq!(json["plugins"][0]["file_hash"], "00ff");
    let none = Report { summary: Summary { whale: None, ..report.summary.clone() }, ..report };
    let json: serde_json::Value = serde_json::from_str(&json::line(&none)).unwrap();
    assert!(json["whale"].is_null() && json["audit"]["winding_jumps"] == 0);
}

#[test]
fn keys_are_unique_and_labels_are_lower_case() {
    fn check<S>(figures: &[Figure<S>]) {
        for (index, figure) in figures.iter().enumerate() {
            let same =
                |other: &&Figure<S>| other.key == figure.key && other.in_json == figure.in_json;
            assert_eq!(figures[..index].iter().find(same).map(|other| other.key), None);
            let first = figure.label.chars().next().unwrap();
            assert!(
                first.is_lowercase()
                    || figure.label == "Strouhal number"
                    || figure.label == "Newton passes",
                "{}",
                figure.label
            );
            assert!(figure.help.ends_with('.'), "{}", figure.help);
        }
    }
    check(ATTEMPT);
    check(RUN);
    check(AUDIT);
    check(BALANCE);
    check(SETTLED);
    check(PHASE);
    check(COST);
    check(EVENT);
    check(PLUGIN);
    check(LINE);
    check(LINK);
    check(BODY);
    check(PROBE);
    check(WHALE);
    check(BEAT);
    check(KINETIC);
    check(PART);
    check(PATCH);
    check(MOMENT);
}
