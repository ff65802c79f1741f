//! Ropes as the gear library has them: condition, knots and splices, weak inserts and sleeves, scatter.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, root};
use endline_gear::{Diagnostic, Options, Scenario, assemble};
use endline_sdk::LineEnd;
use endline_sim::model::RopeOnRope;
use endline_sim::{Input, Model, ModelSpec, State, Workspace, settle, step};

/// A rope drawn from a fixture by a hand, in a vacuum without weight: `line` goes into its `[[line]]`.
pub(crate) fn pulled(head: &str, line: &str) -> String {
    format!(
        r#"format = 1
kind = "scenario"
name = "Pulled"
duration = "60 s"
{head}
[site]
depth = "100 m"
density = "0 kg/m3"
gravity = "0 m/s2"
seabed = false

[[fixture]]
id = "post"
position = ["0 m", "0 m", "-10 m"]

[[fixture]]
id = "hand"
position = ["40 m", "0 m", "-10 m"]
velocity = ["0.5 m/s", "0 m/s", "0 m/s"]
from = "0 s"
until = "100 s"

[[line]]
id = "warp"
rope = "polysteel-1-2"
from = "post"
to = "hand"
length = "40 m"
{line}
"#
    )
}

fn refused(text: &str) -> Vec<Diagnostic> {
    match Scenario::read("test.toml", text) {
        Err(problems) => problems,
        Ok(scenario) => match assemble(&scenario, &library(), &Linked, &Options::default()) {
            Err(problems) => problems,
            Ok(_) => panic!("this assembles: {text}"),
        },
    }
}

pub(crate) fn assembled(text: &str, seed: Option<u64>) -> ModelSpec {
    let scenario = Scenario::read("test.toml", text)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let options = Options { seed, ..Options::default() };
    assemble(&scenario, &library(), &Linked, &options)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)))
}

/// Greatest tension of any segment until something parts, and what parted: ids of lines and links.
pub(crate) fn until_it_parts(spec: ModelSpec) -> (f64, Vec<String>) {
    let model = Model::new(spec).unwrap();
    let (mut state, mut workspace) = (settle(&model).state, Workspace::new(&model));
    let mut greatest = 0.0_f64;
    while state.time_s < model.spec.settings.duration_s {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        greatest = workspace.peak_tension_n.iter().copied().fold(greatest, f64::max);
        let parted = parted(&model, &state);
        if !parted.is_empty() {
            return (greatest, parted);
        }
    }
    (greatest, Vec::new())
}

fn parted(model: &Model, state: &State) -> Vec<String> {
    let lines = model
        .spec
        .lines
        .iter()
        .zip(&state.line_parted)
        .filter(|(_, parted)| parted.is_some())
        .map(|(line, _)| line.id.clone());
    let links = model
        .spec
        .links
        .iter()
        .zip(&state.link_parted_s)
        .filter(|(_, parted)| parted.is_some())
        .map(|(link, _)| link.id.clone());
    lines.chain(links).collect()
}

const INSERTS: &str = "[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nevery = \"30 ft\"\nwithin = 0.75\n";
/// 1,700 lbf [N].
const RATED_N: f64 = 7561.98;

#[test]
fn an_insert_parts_at_its_worn_strength_and_nothing_else_does() {
    let spec = assembled(&pulled("strength_scatter = false\nrope_nodes = 80", INSERTS), None);
    let ids: Vec<&str> = spec.lines.iter().map(|line| line.id.as_str()).collect();
    assert_eq!(
        ids,
        ["warp.1", "warp.insert-1", "warp.2", "warp.insert-2", "warp.3", "warp.insert-3", "warp.4"]
    );
    assert!((spec.lines.iter().flat_map(|line| &line.segments_m).sum::<f64>() - 40.0).abs() < 1e-9);
    let (greatest, parted) = until_it_parts(spec);
    // Alike and evenly loaded, several may part in the same step.
    assert!(!parted.is_empty() && parted.iter().all(|id| id.contains("insert")), "{parted:?}");
    // A rule makes no rope exempt from wear: 74 % of what it held when it was approved.
    assert!((greatest / (0.74 * RATED_N) - 1.0).abs() < 0.01, "{greatest}");
}

#[test]
fn a_sleeve_parts_at_its_rating_and_a_rating_over_all_links_counts_for_it() {
    let sleeves = "[line.inserts]\nsleeve = \"south-shore-1700\"\nfirst = \"5 m\"\nevery = \"60 ft\"\ncounted_from = \"from\"\n";
    let mut spec = assembled(&pulled("strength_scatter = false\nrope_nodes = 80", sleeves), None);
    let ids: Vec<&str> = spec.links.iter().map(|link| link.id.as_str()).collect();
    assert_eq!(ids, ["warp.sleeve-1", "warp.sleeve-2"]);
    assert!((spec.lines[0].segments_m.iter().sum::<f64>() - 5.0).abs() < 1e-9);
    let (greatest, parted) = until_it_parts(spec.clone());
    assert!(
        parted.iter().all(|id| id.starts_with("warp.sleeve-")) && !parted.is_empty(),
        "{parted:?}"
    );
    assert!((greatest / RATED_N - 1.0).abs() < 0.01, "{greatest}");
    // As the command line's --rating sets it.
    spec.links.iter_mut().for_each(|link| link.rating_n = 2000.0);
    let (greatest, _) = until_it_parts(spec);
    assert!((greatest / 2000.0 - 1.0).abs() < 0.01, "{greatest}");
}

#[test]
fn a_knot_at_the_end_takes_its_share_of_the_parting_load() {
    let load = |line: &str| {
        let (greatest, parted) = until_it_parts(assembled(
            &pulled("strength_scatter = false\nrope_nodes = 40", line),
            None,
        ));
        assert_eq!(parted, ["warp"]);
        greatest
    };
    let spliced = load("from_knot = \"eye-splice\"\nto_knot = \"eye-splice\"");
    let knotted = load("from_knot = \"eye-splice\"\nto_knot = \"overhand\"");
    // Polysteel 1/2 in: at least 4,910 lbf new, 1.11 of that in the mean, 74 % of it used, 95 % of that at an eye splice,
    // 45 % at an overhand knot.
    let used = 4910.0 * 4.448_221_6 * 1.11 * 0.74;
    assert!((spliced / (0.95 * used) - 1.0).abs() < 0.01, "{spliced} against {}", 0.95 * used);
    assert!((knotted / (0.45 * used) - 1.0).abs() < 0.01, "{knotted} against {}", 0.45 * used);
}

#[test]
fn the_segment_at_a_knot_goes_and_a_line_may_name_its_own_wear() {
    let spec = assembled(
        &pulled(
            "strength_scatter = false\nrope_nodes = 40",
            "to_knot = \"bowline\"\nwear_factor = 0.5",
        ),
        None,
    );
    let model = Model::new(spec).unwrap();
    let new = model.spec.ropes[0].strength_n;
    let last = model.segment_count - 1;
    // The rope's usual 0.90 at the other end, nothing between.
    for (segment, share) in [(0, 0.5 * 0.9), (last / 2, 0.5), (last, 0.5 * 0.6)] {
        assert!(
            (model.rope_strength_n[segment] / new - share).abs() < 1e-12,
            "{segment}: {}",
            model.rope_strength_n[segment] / new
        );
    }
}

#[test]
fn strengths_scatter_as_the_library_says_and_a_seed_repeats_them() {
    let text = std::fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    let (scenario, library) = (Scenario::read("hello-endline.toml", &text).unwrap(), library());
    let drawn = |seed: u64| {
        let spec = assemble(
            &scenario,
            &library,
            &Linked,
            &Options { seed: Some(seed), ..Options::default() },
        )
        .unwrap();
        let top = spec.lines.iter().find(|line| line.id == "endline-top").unwrap();
        [top.strength.all, spec.links[0].rating_n]
    };
    assert_eq!(drawn(5).map(f64::to_bits), drawn(5).map(f64::to_bits));
    let all: Vec<[f64; 2]> = (0..1000).map(drawn).collect();
    // A used sinking rope: 0.74 of new with 12 %; links of at most 600 lbf, 0.86 of that in the mean, with 8 %.
    for (index, mean, variation) in [(0, 0.74, 0.12), (1, 0.86 * 600.0 * 4.448_221_6, 0.08)] {
        let found = all.iter().map(|drawn| drawn[index]).sum::<f64>() / 1000.0;
        let deviation =
            (all.iter().map(|drawn| (drawn[index] - found).powi(2)).sum::<f64>() / 999.0).sqrt();
        // Standard errors: variation/√1000 of the mean, variation/√2000 of the deviation.
        assert!(
            (found / mean - 1.0).abs() < 4.0 * variation / 1000_f64.sqrt(),
            "{found} against {mean}"
        );
        assert!(
            (deviation / found - variation).abs() < 4.0 * variation / 2000_f64.sqrt(),
            "{}",
            deviation / found
        );
    }
}

#[test]
fn a_line_added_does_not_change_what_others_are_drawn() {
    let one = pulled("", "");
    let two = format!(
        "{one}\n[[line]]\nid = \"another\"\nrope = \"pp-3-8\"\nfrom = \"post\"\nto = \"hand\"\nlength = \"41 m\"\n"
    );
    let of = |text: &str| {
        assembled(text, Some(9)).lines.iter().find(|line| line.id == "warp").unwrap().strength.all
    };
    assert_eq!(of(&one).to_bits(), of(&two).to_bits());
}

/// Rope of a condition hung with a weight stretches as its law says: polysteel 1/2 in, E = 100 kN, strength 21.84 kN.
#[test]
fn the_condition_of_a_rope_sets_how_it_stretches() {
    let stretch = |choice: &str| {
        let text = pulled(&format!("rope_nodes = 20\n{choice}"), "")
            .replace("velocity = [\"0.5 m/s\", \"0 m/s\", \"0 m/s\"]\n", "");
        let text = text
            .replace("from = \"0 s\"\nuntil = \"100 s\"\n", "")
            .replace("[\"40 m\", \"0 m\", \"-10 m\"]", "[\"42 m\", \"0 m\", \"-10 m\"]");
        let model = Model::new(assembled(&text, None)).unwrap();
        let settled = settle(&model);
        assert!(settled.converged);
        settled.state.rope.tension[5]
    };
    // Drawn out by 5 %: E ε, twice E ε, and E ε (0.35 + 0.65 ε/ε_b) with ε_b = 0.22.
    for (choice, expected) in [
        ("", 5000.0),
        ("rope_condition = \"worked\"", 10_000.0),
        ("rope_condition = \"new\"", 5000.0 * (0.35 + 0.65 * 0.05 / 0.22)),
    ] {
        assert!(
            (stretch(choice) / expected - 1.0).abs() < 1e-6,
            "{choice}: {} against {expected}",
            stretch(choice)
        );
    }
    let own = assembled(&pulled("rope_condition = \"new\"", "condition = \"worked\""), None);
    assert_eq!(own.ropes[0].id, "polysteel-1-2 (worked)");
}

#[test]
fn gear_of_a_gear_type_takes_inserts_too() {
    let text = std::fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    let inserts = "[gear.lines.endline-top]\nto_knot = \"anchor-bend\"\n\n[gear.lines.endline-top.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nfirst = \"12 ft\"\nevery = \"30 ft\"\n";
    let text = text.replace(
        "assembly = \"single\"\n",
        &format!(
            "assembly = \"single\"\n[gear.ropes]\nendline-top = \"polysteel-3-8\"\n\n{inserts}"
        ),
    );
    let text = format!(
        "{text}\n[[probe]]\nid = \"at the buoy\"\nof = \"tension\"\nline = \"endline-top\"\nend = \"to\"\n"
    );
    let spec = assembled(&text, None);
    let index = |id: &str| {
        spec.lines.iter().position(|line| line.id == id).unwrap_or_else(|| panic!("no {id}"))
    };
    let (first, last) = (index("endline-top.1"), index("endline-top.3"));
    assert_eq!(last - first, 4);
    assert!(spec.gear[0].lines.contains(&[first, last]));
    assert_eq!((spec.links[0].line, spec.links[0].end), (last, LineEnd::B));
    assert_eq!(
        spec.probes.last().unwrap().target,
        endline_sim::model::ProbeTarget::EndTension(last, LineEnd::B)
    );
    assert_eq!(spec.ropes[spec.lines[first].rope].id, "polysteel-3-8");
    assert!((spec.lines[last].strength.end_b - 0.70).abs() < 1e-12);
}

#[test]
fn a_mistake_in_a_line_is_reported_with_its_place() {
    for (head, line, parts) in [
        ("", "to_knot = \"granny\"", vec!["no `granny` in knots/"]),
        ("", "to_knot = \"bowlin\"", vec!["did you mean `bowline`?"]),
        (
            "",
            "condition = \"old\"",
            vec!["`old` is not a value of `condition`", "secant, new, worked"],
        ),
        (
            "",
            "[line.inserts]\nrope = \"weak-1700-3-8\"\nevery = \"60 ft\"\n",
            vec!["`length` is missing"],
        ),
        (
            "",
            "[line.inserts]\nsleeve = \"wl-60\"\nevery = \"60 ft\"\n",
            vec!["no `wl-60` in weak-links/"],
        ),
        ("", "[line.inserts]\nevery = \"60 ft\"\n", vec!["`rope` is missing", "or sleeve"]),
        (
            "",
            "[line.inserts]\nsleeve = \"south-shore-1700\"\nevery = \"60 ft\"\nwithin = 0.2\n",
            vec!["no insert fits into the 40.00 m"],
        ),
        (
            "",
            "[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nevery = \"2 ft\"\n",
            vec!["inserts do not overlap"],
        ),
        (
            "",
            "[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nevery = \"60 ft\"\nevry = 1\n",
            vec!["unknown field `evry`"],
        ),
        (
            "",
            "start = \"catenary\"\n[line.inserts]\nsleeve = \"wl-600\"\nevery = \"5 m\"\n",
            vec!["cannot have inserts"],
        ),
        ("", "[line.weak_places]\nevery = \"60 ft\"\n", vec!["`strength` is missing"]),
        (
            "",
            "[line.weak_places]\nstrength = \"1700 lbf\"\n",
            vec!["`every` is missing in `line.0.weak_places`", "or at = [\"10 m\""],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"-5 N\"\nevery = \"60 ft\"\n",
            vec!["`strength` is -5 N", "above zero"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nevery = \"60 ft\"\nat = [\"5 m\"]\n",
            vec!["both `every` and `at` are present", "keep one"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nfirst = \"6 m\"\nat = [\"5 m\"]\n",
            vec!["`first` is present without `every`"],
        ),
        ("", "[line.weak_places]\nstrength = \"5 N\"\nat = []\n", vec!["`at` has no values"]),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nat = [\"5 m\", \"0 m\"]\n",
            vec!["`at` is 0 m", "between 0.01 m"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nat = [\"5 m\", \"40 m\"]\n",
            vec!["a weak place at 40.00 m is beyond the 40.00 m of line `warp`"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nevery = \"90 m\"\n",
            vec!["no weak place is on the 40.00 m of line `warp`", "a shorter `first` or `every`"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nevery = \"9 m\"\nevry = 1\n",
            vec!["unknown field `evry`"],
        ),
        (
            "",
            "[line.weak_places]\nstrength = \"5 N\"\nevery = \"9 m\"\n[line.inserts]\nsleeve = \"wl-600\"\nevery = \"5 m\"\n",
            vec!["line `warp` has both inserts and weak places", "keep one of them"],
        ),
    ] {
        let problems = refused(&pulled(head, line));
        for part in parts {
            assert!(report(&problems).contains(part), "{line}: {}", report(&problems));
        }
        assert!(
            problems.iter().all(|problem| problem.file == "test.toml" && problem.line > 25),
            "{}",
            report(&problems)
        );
    }
}

#[test]
fn gear_of_a_gear_type_takes_weak_places_and_keeps_its_lines() {
    let text = std::fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    let places = "[gear.lines.endline-top.weak_places]\nstrength = \"500 lbf\"\nfirst = \"12 ft\"\nevery = \"30 ft\"\n";
    let weak =
        text.replace("assembly = \"single\"\n", &format!("assembly = \"single\"\n\n{places}"));
    let [bare, weak] = [&text, &weak].map(|text| assembled(text, None));
    let line = weak.lines.iter().position(|line| line.id == "endline-top").unwrap();
    let found = &weak.lines[line].weak_places;
    assert!(!found.is_empty() && found[0].strength_n > 0.0);
    for (index, place) in found.iter().enumerate() {
        assert!((place.at_m - 0.3048 * (12.0 + 30.0 * index as f64)).abs() < 1e-9, "{found:?}");
    }
    let mut lines = weak.lines.clone();
    lines[line].weak_places.clear();
    assert_eq!(lines, bare.lines, "nothing but strength");
    assert_eq!(weak.ropes, bare.ropes);
}

#[test]
fn the_hauled_endline_parts_at_an_insert() {
    let text = std::fs::read_to_string(root().join("scenarios/hauled-inserts.toml")).unwrap();
    let (_, parted) = until_it_parts(assembled(&text, None));
    assert_eq!(parted.len(), 1);
    assert!(parted[0].starts_with("endline.insert-"), "{parted:?}");
}

#[test]
fn rope_touches_rope_unless_a_scenario_says_no() {
    let law = |head: &str| assembled(&pulled(head, ""), None).settings.rope_on_rope;
    assert_eq!(law("rope_nodes = 40\nrope_on_rope = false"), None);
    assert_eq!(law("rope_nodes = 40"), Some(RopeOnRope::default()));
    let rough = law("rope_nodes = 40\nrope_friction = 0.4").unwrap();
    assert!((rough.friction - 0.4).abs() < 1e-15);
    for (head, part) in [
        ("rope_on_rope = \"yes\"", "true or false"),
        ("seed = 2\nrope_friction = 7", "rope_friction"),
        ("seed = 2\nrope_friction = \"0.2 N\"", "rope_friction"),
        ("rope_on_rope = false\nrope_friction = 0.2", "ropes pass through each other"),
    ] {
        let problems = refused(&pulled(head, ""));
        let here = problems.iter().find(|problem| problem.to_string().contains(part));
        let line = 5 + head.lines().position(|line| line.starts_with("rope_friction")).unwrap_or(0);
        assert!(
            here.is_some_and(|problem| problem.to_string().contains(&format!("test.toml:{line}"))),
            "{head}: {problems:?}"
        );
    }
}
