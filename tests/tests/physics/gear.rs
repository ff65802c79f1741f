//! The gear library: shipped files, messages, assembly.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, root, scenario_text, spec, spec_of};
use endline_gear::{
    Diagnostic, Kind, Library, Options, Scenario, Sources, assemble, assemble_traced,
};

use endline_sim::model::{BodyRole, CONTACT_TOLERANCE, JointKind, ProbeTarget};
use endline_sim::{DQuat, DVec3, Model, ModelSpec, settle};

#[test]
fn every_shipped_file_reads_without_a_word() {
    let library = library();
    assert!(library.ropes.len() >= 20);
    for entry in std::fs::read_dir(root().join("scenarios")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        if let Err(problems) = Scenario::read(&path.display().to_string(), &text) {
            panic!("{}", report(&problems));
        }
    }
}

fn shipped(name: &str) -> ModelSpec {
    spec(name, &[])
}

#[test]
fn every_shipped_scenario_makes_a_model_with_the_nodes_it_asks_for() {
    for (name, nodes) in [
        ("hello-endline.toml", 1000),
        ("hello-slack-tide.toml", 500),
        ("hello-weak-link.toml", 500),
        ("hello-resolution.toml", 250),
        ("reference-b-static.toml", 501),
        ("reference-a-pendulum.toml", 101),
        ("reference-d-capstan-half.toml", 501),
        ("reference-d-capstan-full.toml", 501),
    ] {
        let model = Model::new(shipped(name)).unwrap();
        assert_eq!(model.node_count, nodes, "{name}");
    }
}

pub(crate) fn refused(text: &str) -> Vec<Diagnostic> {
    match Scenario::read("test.toml", text) {
        Err(problems) => problems,
        Ok(scenario) => match assemble(&scenario, &library(), &Linked, &Options::default()) {
            Err(problems) => problems,
            Ok(_) => panic!("this assembles: {text}"),
        },
    }
}

/// Figures stand as `key = "3/8 in"` under a file's source and confidence, or as a table with their own.
#[test]
fn every_shipped_figure_has_source_and_confidence() {
    let sources = Sources::from_folder(&root()).unwrap();
    let mut figures = 0;
    for (path, text) in sources.iter().filter(|(path, _)| !path.starts_with("assemblies/")) {
        let file: toml::Table = text.parse().unwrap();
        figures += walk(path, &file, false, false);
    }
    assert!(figures > 600, "{figures}");
}

/// Counts the figures of a table; fails where one has no source or confidence of its own or above it.
fn walk(path: &str, table: &toml::Table, above_source: bool, above_confidence: bool) -> usize {
    let text = |key: &str| {
        table.get(key).and_then(toml::Value::as_str).is_some_and(|text| !text.trim().is_empty())
    };
    let (source, confidence) =
        (above_source || text("source"), above_confidence || text("confidence"));
    if table.contains_key("value") {
        assert!(source && confidence, "{path}: {table:?}");
        return 1;
    }
    let words = ["format", "kind", "name", "notes", "source", "confidence", "material", "shape"];
    let values = table.iter().filter(|(key, _)| !words.contains(&key.as_str()));
    values.map(|(key, value)| count(path, key, value, source, confidence)).sum()
}

fn count(path: &str, key: &str, value: &toml::Value, source: bool, confidence: bool) -> usize {
    match value {
        toml::Value::Table(inner) => walk(path, inner, source, confidence),
        toml::Value::Array(items) => {
            items.iter().map(|item| count(path, key, item, source, confidence)).sum()
        }
        _ => {
            assert!(source && confidence, "{path}: {key}");
            1
        }
    }
}

/// Nodes go to lines by length, to one segment.
#[test]
fn nodes_are_shared_out_by_length() {
    for name in ["single", "pair", "trawl-5"] {
        let spec = spec_of(
            "test.toml",
            &scenario_text("hello-endline.toml").replace("\"single\"", &format!("\"{name}\"")),
        );
        let lengths: Vec<f64> =
            spec.lines.iter().map(|line| line.segments_m.iter().sum()).collect();
        let total: f64 = lengths.iter().sum();
        let spare = (1000 - 2 * lengths.len()) as f64;
        for (line, length) in spec.lines.iter().zip(&lengths) {
            let share = 1.0 + spare * length / total;
            assert!(
                (line.segments_m.len() as f64 - share).abs() < 1.0,
                "{name} {}: {share}",
                line.id
            );
        }
        assert_eq!(Model::new(spec).unwrap().node_count, 1000, "{name}");
    }
}

#[test]
fn lines_that_leave_one_body_share_a_joint() {
    let spec = spec_of(
        "test.toml",
        &scenario_text("hello-endline.toml").replace("\"single\"", "\"pair\""),
    );
    let line = |id: &str| spec.lines.iter().find(|line| line.id == id).unwrap();
    assert_eq!(line("endline-bottom").from, line("groundline-1").from);
    let joint = &spec.joints[line("groundline-1").from];
    let JointKind::Body { body, offset_m } = joint.kind else {
        panic!("{} is not on a body", joint.id)
    };
    let from_middle = offset_m - spec.bodies[body].middle_m();
    assert!((from_middle - DVec3::new(0.4572, 0.0, 0.1778)).length() < 1e-12);
}

/// A bridle's legs leave the corners of the trap's top edge; lines at one point share a joint, and a bare id is the usual point.
#[test]
fn a_line_is_made_fast_at_the_point_it_names() {
    let spec = spec_of(
        "test.toml",
        &scenario_text("hello-endline.toml").replace("\"single\"", "\"single-bridle\""),
    );
    let offset = |id: &str| {
        let line = spec.lines.iter().find(|line| line.id == id).unwrap();
        match spec.joints[line.from].kind {
            JointKind::Body { offset_m, .. } => offset_m,
            _ => panic!("{id} is not on a body"),
        }
    };
    let apart = offset("bridle-port") - offset("bridle-starboard");
    assert!((apart - DVec3::new(0.0, 21.0 * 0.0254, 0.0)).length() < 1e-12, "{apart}");
    let legs: Vec<usize> = spec
        .lines
        .iter()
        .filter(|line| line.id.starts_with("bridle"))
        .map(|line| line.to)
        .collect();
    assert!(legs.len() == 2 && legs[0] == legs[1]);
}

#[test]
fn a_point_that_is_not_there_is_reported_with_the_existing_ones() {
    let text = scenario_text("hello-endline.toml").replace("\"single\"", "\"single-bridle\"");
    let scenario = Scenario::read("test.toml", &text).unwrap();
    let message_of = |from: &str, to: &str| {
        let mut sources = Sources::from_folder(&root()).unwrap();
        let bridle = sources.get("assemblies/single-bridle.toml").unwrap().replace(from, to);
        let line = 1 + bridle.lines().position(|line| line.contains(to)).unwrap();
        sources.set("assemblies/single-bridle.toml", bridle);
        let (library, problems) = Library::read(&sources);
        assert!(problems.is_empty(), "{}", report(&problems));
        let problems = assemble(&scenario, &library, &Linked, &Options::default()).err().unwrap();
        assert_eq!(
            (problems[0].file.as_str(), problems[0].line),
            ("assemblies/single-bridle.toml", line),
            "{}",
            report(&problems)
        );
        problems[0].to_string()
    };
    for (from, to, parts) in [
        (
            "trap:bridle-port",
            "trap:bridle-prt",
            ["body `trap` has no point `bridle-prt`", "did you mean `bridle-port`?"],
        ),
        (
            "trap:bridle-port",
            "trap:xyz",
            ["has no point `xyz`", "known names are end, bridle-port, bridle-starboard"],
        ),
        (
            "trap:bridle-port",
            "trp:bridle-port",
            ["there is no body or joint `trp`", "did you mean `trap`?"],
        ),
        (
            "to = \"splice\"",
            "to = \"splice:end\"",
            ["joint `splice` has no point `end`", "only a body has points"],
        ),
    ] {
        let message = message_of(from, to);
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

/// An item's own points: one more, and a usual one moved.
#[test]
fn an_item_may_have_points_of_its_own() {
    let read = |points: &str| {
        let mut sources = Sources::from_folder(&root()).unwrap();
        let trap = format!("{}\n{points}", sources.get("traps/wire-lobster-3ft.toml").unwrap());
        sources.set("traps/wire-lobster-3ft.toml", trap);
        Library::read(&sources)
    };
    let at = |name: &str, x: &str| {
        format!("[[point]]\nname = \"{name}\"\nat = [\"{x}\", \"0 m\", \"0.1 m\"]\n")
    };
    let (library, problems) = read(&(at("becket", "0.3 m") + &at("end", "0.4 m")));
    assert!(problems.is_empty(), "{}", report(&problems));
    let points =
        library.traps.iter().find(|trap| trap.entry.id == "wire-lobster-3ft").unwrap().points();
    assert!(
        points[0].name == "end"
            && DVec3::from_array(points[0].at_m).distance(DVec3::new(0.4, 0.0, 0.1)) < 1e-12
    );
    assert!(
        points.iter().any(|point| point.name == "becket" && (point.at_m[0] - 0.3).abs() < 1e-12)
    );
    for (points, part) in [
        (at("a:b", "0.3 m"), "`a:b` cannot be a point's name"),
        (at("becket", "0.3 kg"), "`kg` is a unit of a mass, not of a length"),
        (at("becket", "0 m") + &at("becket", "1 m"), "there are two points `becket`"),
        ("[[point]]\nname = \"becket\"\n".to_owned(), "`at` is missing"),
    ] {
        let problems = read(&points).1;
        assert!(
            problems.len() == 1 && problems[0].to_string().contains(part),
            "{points}: {}",
            report(&problems)
        );
    }
}

/// The start shape of reference problem (a) against its exact data.
#[test]
fn the_pendulum_starts_on_its_elastic_catenary() {
    let spec = shipped("reference-a-pendulum.toml");
    let middle = spec.lines[0].start_m[50];
    assert!((middle - DVec3::new(14.4026908, 0.0, -26.3797929)).length() < 1e-6, "{middle}");
    assert_eq!(spec.bodies[0].held_until_s, Some(0.0));
    assert!(spec.water.density_kg_m3 == 0.0 && spec.seabed.is_none());
}

#[test]
fn problem_b_has_its_rope_buoy_and_probes() {
    let spec = shipped("reference-b-static.toml");
    let (rope, buoy) = (&spec.ropes[0], &spec.bodies[0]);
    assert!((rope.displaced_m3_m - std::f64::consts::PI / 4.0 * 1e-4).abs() < 1e-16);
    assert!(
        (buoy.added_mass_kg.z - 5.125).abs() < 1e-12 && !buoy.wetted_drag && !spec.water.rope_dries
    );
    assert_eq!(spec.water.current.surface_m_s, DVec3::new(0.5, 0.0, 0.0));
    assert!(matches!(spec.probes[2].target, ProbeTarget::Body { body: 0, axis: 0, .. }));
}

#[test]
fn a_whale_starts_where_and_as_the_scenario_says() {
    let whale = shipped("hello-endline.toml").whale.unwrap();
    assert!((whale.orientation * DVec3::X - DVec3::Y).length() < 1e-12, "heading 0 deg is north");
    let text = scenario_text("hello-endline.toml").replace(
        "heading = \"0 deg\"",
        "heading = \"90 deg\"\npitch = \"30 deg\"\nroll = \"90 deg\"",
    );
    let whale = spec_of("test.toml", &text).whale.unwrap();
    let nose = whale.orientation * DVec3::X;
    assert!((nose - DVec3::new(3.0_f64.sqrt() / 2.0, 0.0, 0.5)).length() < 1e-12, "{nose}");
    assert!((whale.orientation * DVec3::Y).z > 0.8, "rolled to starboard, the port side is up");
    assert!((whale.motion_attributes[0] - 1.3).abs() < 1e-15);
    assert!(whale.skin.triangles.len() > 5000);
}

#[test]
fn gear_turns_with_its_heading_and_answers_the_current() {
    let north = scenario_text("hello-endline.toml")
        .replace("[[gear]]", "[[gear]]\nposition = [\"3 m\", \"4 m\"]\nheading = \"0 deg\"");
    let spec = spec_of("test.toml", &north);
    let buoy = spec.bodies.iter().find(|body| body.id == "buoy").unwrap();
    assert!(
        buoy.position_m.x > 5.0 && (buoy.position_m.y - 4.0).abs() < 1e-9,
        "{}: still down-current, to the east",
        buoy.position_m
    );
    assert!((buoy.orientation * DVec3::X - DVec3::Y).length() < 1e-12);
    assert!(
        spec.bodies[0]
            .orientation
            .angle_between(DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2))
            < 1e-7
    );
}

#[test]
fn friction_is_by_rope_and_region() {
    let spec = shipped("hello-endline.toml");
    let friction = spec.friction.unwrap();
    assert_eq!(friction.coefficients.len(), spec.ropes.len());
    let of = |rope: &str, region: endline_sdk::Region| {
        friction.coefficients[spec.ropes.iter().position(|known| known.id == rope).unwrap()]
            [region as usize]
    };
    assert!(
        of("pp-3-8", endline_sdk::Region::Baleen) < of("sink-3-8", endline_sdk::Region::Baleen)
    );
    assert!((of("pp-3-8", endline_sdk::Region::LeftFlukeLeading) - 0.15).abs() < 1e-15);
    assert_eq!(friction.laws.len(), 1);
}

#[test]
fn files_used_are_named_and_are_enough_to_build_again() {
    let text = scenario_text("hello-endline.toml");
    let scenario = Scenario::read("test.toml", &text).unwrap();
    let sources = Sources::from_folder(&root()).unwrap();
    let first = assemble_traced(&scenario, &library(), &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let (again, problems) = Library::read(&sources.only(&first.files));
    assert!(problems.is_empty(), "{}", report(&problems));
    // The whale can do every act of the library, so their files are used, too.
    let gear = first.files.iter().filter(|path| !path.starts_with("acts/")).count();
    assert!(
        first.files.iter().any(|path| path == "traps/wire-lobster-3ft.toml") && gear < 14,
        "{:?}",
        first.files
    );
    let second = assemble(&scenario, &again, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    assert_eq!(first.spec.bodies, second.bodies);
    assert_eq!(first.spec.lines, second.lines);
}

#[test]
fn options_come_before_the_scenario() {
    let scenario = Scenario::read("test.toml", &scenario_text("hello-endline.toml")).unwrap();
    let options = Options {
        seed: Some(7),
        step_s: Some(0.02),
        weak_links: Some(false),
        rope_nodes: Some(60),
        ..Options::default()
    };
    let spec = assemble(&scenario, &library(), &Linked, &options)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    assert_eq!((spec.settings.seed, spec.settings.step_s, spec.links[0].enabled), (7, 0.02, false));
    assert_eq!(Model::new(spec).unwrap().node_count, 60);
}

#[test]
fn the_program_chooses_the_step_where_the_scenario_says_so() {
    let text = scenario_text("hello-endline.toml");
    let with = |step: &str| text.replacen("seed = 1", &format!("seed = 1\n{step}"), 1);
    let settings = |text: &str| spec_of("test.toml", text).settings;
    assert!(!settings(&text).auto_step && settings(&with("step = \"auto\"")).auto_step);
    let fixed = settings(&with("step = \"5 ms\""));
    assert!(!fixed.auto_step && (fixed.step_s - 0.005).abs() < 1e-15);
    let problems = refused(&with("step = \"automatic\""));
    assert!(
        problems.len() == 1 && problems[0].to_string().contains("`step`"),
        "{}",
        report(&problems)
    );
}

#[test]
fn the_tolerance_near_the_whale_is_what_the_scenario_says() {
    let text = scenario_text("hello-endline.toml");
    let with = |entry: &str| text.replacen("weak_links", &format!("{entry}\nweak_links"), 1);
    let tolerance = |text: &str| spec_of("test.toml", text).settings.contact_tolerance;
    let read = [tolerance(&text), tolerance(&with("contact_tolerance = 0.005"))];
    assert!((read[0] - CONTACT_TOLERANCE).abs() + (read[1] - 0.005).abs() < 1e-15, "{read:?}");
    for wrong in ["contact_tolerance = 0.5", "contact_tolerance = true"] {
        let messages: Vec<_> = refused(&with(wrong)).iter().map(ToString::to_string).collect();
        assert!(messages.len() == 1 && messages[0].contains("test.toml:9:"), "{messages:?}");
    }
}

#[test]
fn ropes_and_attributes_of_placed_gear_may_be_chosen() {
    let text = scenario_text("hello-endline.toml");
    let with = |extra: &str| {
        text.replacen("assembly = \"single\"", &format!("assembly = \"single\"\n{extra}"), 1)
    };
    let spec = spec_of(
        "test.toml",
        &with("[gear.ropes]\nendline-top = \"polysteel-7-16\"\n[gear.attributes]\nscope = 2.0"),
    );
    let top = spec.lines.iter().find(|line| line.id == "endline-top").unwrap();
    assert_eq!(spec.ropes[top.rope].id, "polysteel-7-16");
    let length: f64 = spec.lines.iter().flat_map(|line| &line.segments_m).sum();
    assert!((length - 50.0).abs() < 1e-9, "{length}");
    for (extra, part) in [
        ("[gear.ropes]\nendline-topp = \"pp-3-8\"", "did you mean `endline-top`?"),
        ("[gear.ropes]\nendline-top = \"polysteel-3-9\"", "did you mean `polysteel-3-8`?"),
        ("[gear.attributes]\nbuoy = \"bullet-6x15\"", "did you mean `bullet-6x14`?"),
    ] {
        let problems = refused(&with(extra));
        assert!(
            problems.len() == 1 && problems[0].to_string().contains(part),
            "{}",
            report(&problems)
        );
    }
}

#[test]
fn a_mistake_in_an_assembly_is_reported_in_its_own_file() {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let body = |id: &str| {
        format!(
            "[[body]]\nid = \"{id}\"\nkind = \"trap\"\nitem = \"wire-lobster-3ft\"\nheight = 0\n"
        )
    };
    let pair = format!(
        "format = 1\nkind = \"assembly\"\nname = \"Two traps\"\n{}{}\
         [[line]]\nid = \"groundline-1\"\nrope = \"pp-3-9\"\nfrom = \"trap-1\"\nto = \"trap-22\"\nlength = \"20 m\"\n",
        body("trap-1"),
        body("trap-2")
    );
    sources.set("assemblies/pair.toml", pair);
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    let text = scenario_text("hello-endline.toml")
        .replace("\"single\"", "\"pair\"")
        .replace("part = \"buoy\"", "part = \"trap-1\"");
    let scenario = Scenario::read("test.toml", &text).unwrap();
    let problems = assemble(&scenario, &library, &Linked, &Options::default()).err().unwrap();
    assert_eq!(problems.len(), 2, "{}", report(&problems));
    assert!(
        problems.iter().all(|problem| problem.file == "assemblies/pair.toml" && problem.line > 10),
        "{}",
        report(&problems)
    );
}

#[test]
fn every_kind_of_item_is_shipped() {
    let library = library();
    for kind in Kind::ALL.iter().copied() {
        assert!(!library.ids(kind).is_empty(), "{kind:?}");
    }
}

/// Every shipped scenario, and each assembly in the first one's place, reaches equilibrium.
#[test]
fn all_shipped_gear_settles() {
    let hello = scenario_text("hello-endline.toml");
    let pair = hello.replace("\"single\"", "\"pair\"");
    let trawl = hello.replace("\"single\"", "\"trawl-5\"");
    let slack = scenario_text("hello-slack-tide.toml");
    for text in [hello, pair, trawl, slack, scenario_text("hello-weak-link.toml")] {
        let model = Model::new(spec_of("test.toml", &text)).unwrap();
        let settled = settle(&model);
        assert!(settled.converged, "{:?}: {} N", model.spec.lines[0].id, settled.residual_n);
        let bodies = model.spec.bodies.iter().zip(&settled.state.bodies);
        for (body, state) in bodies.filter(|(body, _)| body.role == BodyRole::Trap) {
            assert!(
                (state.position - body.position_m).length() < 0.05,
                "{} stays where it was set: {}",
                body.id,
                state.position
            );
        }
    }
}

/// The scenario file of reference problem (b) against its shooting solution: 0.5 % in tension, 5 cm in place.
#[test]
fn problem_b_as_a_file_settles_to_its_reference() {
    let model = Model::new(shipped("reference-b-static.toml")).unwrap();
    let settled = settle(&model);
    assert!(settled.converged);
    let rope = &settled.state.rope;
    for (tension, expected) in [(rope.tension[0], 23.93630), (rope.tension[499], 14.39362)] {
        assert!((tension / expected - 1.0).abs() < 0.005, "{tension} N for {expected} N");
    }
    let buoy = settled.state.bodies[0].position;
    assert!((buoy - DVec3::new(50.34061059, 0.0, 0.06596101)).length() < 0.05, "{buoy}");
    assert!(
        (rope.position[250] - DVec3::new(27.63402, 0.0, -18.31986)).length() < 0.05,
        "{}",
        rope.position[250]
    );
}
