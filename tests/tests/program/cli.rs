//! The command line as scripts depend on it: exit codes, one JSON object, clear errors, never a panic.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use crate::common;
use std::fs;
use std::process::{Command, Stdio};

use crate::common::{Place, called, edit, rope, text};
use serde_json::Value;

/// Keys of the run summary that scripts depend on; added keys are no one's business here.
const CONTRACT: &str = r#"
{"schema":"","scenario":"","seed":1,"simulated_s":1,"wall_s":1,"times_real_time":1,"dt_s":1,
 "steps":1,"nodes":1,"triangles":1,"state_hash":"","valid":true,"stopped":null,
 "audit":{"tunnelled":0,"max_penetration_m":1,"non_finite":0},
 "lines":[{"id":"","peak_tension_N":1,"peak_at_s":1,"end_a_tension_N":1,"end_b_tension_N":1,"parted_at_s":null}],
 "links":[{"id":"","rating_N":1,"peak_tension_N":1,"parted_at_s":null}],
 "bodies":[{"id":"","position_m":[0,0,0],"peak_speed_m_s":1}],
 "probes":[{"id":"","unit":"N","final":1,"min":1,"max":1,"mean":1}],
 "whale":{"outcome":"","regions":[{"region":"","wraps":1,"contact_length_m":1,"peak_normal_N":1,"friction_work_J":1}],
  "drag_added_N":1,"trailing_m":1},
 "approach":{"times_real_time":1},"contact":{"times_real_time":1}}"#;

/// Every key of the contract is there, with a value of its type; a list in the contract stands for its elements.
fn holds(contract: &Value, found: &Value, path: &str) {
    match (contract, found) {
        (Value::Object(wanted), Value::Object(object)) => {
            for (key, value) in wanted {
                let inner = object.get(key).unwrap_or_else(|| panic!("{path}.{key} is missing"));
                holds(value, inner, &format!("{path}.{key}"));
            }
        }
        (Value::Array(wanted), Value::Array(elements)) => {
            elements.iter().for_each(|element| holds(&wanted[0], element, path))
        }
        (Value::String(_), Value::String(_))
        | (Value::Number(_), Value::Number(_))
        | (Value::Bool(_), Value::Bool(_))
        | (Value::Null, _) => {}
        _ => panic!("{path}: expected something like {contract}, found {found}"),
    }
}

#[test]
fn the_summary_has_every_key_of_the_contract() {
    let place = Place::new("keys");
    let scenario = place.short_scenario("hello-endline", "0.2 s");
    let summary = place.endline(&["run", &scenario, "--json", "--seed", "7"]).done().json();
    holds(&serde_json::from_str(CONTRACT).unwrap(), &summary, "summary");
    assert_eq!(summary["schema"], "endline.run/1");
    assert_eq!(summary["seed"], 7);
    assert_eq!(summary["scenario"], scenario.as_str());
    for list in ["lines", "bodies"] {
        assert!(!summary[list].as_array().unwrap().is_empty(), "no {list}");
    }
    assert_eq!(summary["whale"]["regions"].as_array().unwrap().len(), 7);
    let hash = summary["state_hash"].as_str().unwrap();
    assert!(hash.len() == 16 && hash.chars().all(|digit| digit.is_ascii_hexdigit()), "{hash}");
    let steps = summary["steps"].as_f64().unwrap();
    assert!((steps * summary["dt_s"].as_f64().unwrap() - 0.2).abs() < 1e-9, "{steps} steps");
}

#[test]
fn a_scenario_from_standard_input_runs_as_its_file_does() {
    let place = Place::new("stream");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let library = text(&place.path("gear-library"));
    let from = |file: &str| {
        let mut command = place.command(&["--library", &library, "run", "-", "--json"]);
        called(command.stdin(fs::File::open(file).unwrap()))
    };
    let streamed = from(&scenario).done().json();
    let of_file = place.endline(&["run", &scenario, "--json"]).done().json();
    assert_eq!(streamed["scenario"], "standard input");
    assert_eq!(streamed["state_hash"], of_file["state_hash"]);

    let mistaken =
        text(&place.write("mistaken.toml", "format = 1\nkind = \"scenario\"\nnam = 1\n"));
    from(&mistaken).fails(1, &["standard input:3", "nam"]);
    place.endline(&["settle", "-"]).fails(1, &["standard input"]);
}

#[test]
fn standard_error_tells_as_much_as_is_asked_for() {
    let place = Place::new("verbosity");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let printed = |flag: &str| place.endline(&[flag, "run", &scenario]).done().stderr;
    let (library, plugins) = (place.path("gear-library"), "plugin: org.endline.");
    let details = printed("--verbose");
    assert!(details.contains(&format!("gear library: {}", library.display())), "{details}");
    assert!(details.contains(plugins), "{details}");
    assert_eq!(printed("--quiet"), "");
    place.endline(&["--quiet", "run", "nothing"]).fails(1, &["nothing"]);
    place.endline(&["--quiet", "--verbose", "run", &scenario]).fails(2, &["--verbose"]);
}

#[test]
fn out_holds_summary_and_recording() {
    let place = Place::new("out");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let printed = place.endline(&["run", &scenario, "--json", "--out", "deep/er"]).done().json();
    let saved: Value =
        serde_json::from_str(&fs::read_to_string(place.path("deep/er/summary.json")).unwrap())
            .unwrap();
    assert_eq!(saved, printed);
    assert!(place.path("deep/er/recording.endline").is_file());
}

/// Forty nodes in all cannot be 5 cm apart along a whale; a run with equal segments wishes for none.
#[test]
fn a_resolution_that_cannot_be_kept_is_reported_and_counts_agree() {
    let place = Place::new("resolution");
    let scenario = place.encounter();
    let audit = || {
        let summary = place.endline(&["run", &scenario, "--json"]).done().json();
        assert_eq!(
            (&summary["valid"], &summary["invalid_because"]),
            (&true.into(), &Value::Array(vec![]))
        );
        summary["audit"].clone()
    };
    let count = |audit: &Value, key: &str| audit[key].as_u64().unwrap();
    let equal = audit();
    assert_eq!(count(&equal, "resolution_looks"), 0);
    let text = fs::read_to_string(&scenario).unwrap();
    fs::write(&scenario, text.replace("[site]", "[resolution]\n\n[site]")).unwrap();
    edit(scenario.as_ref(), "rope_nodes", "rope_nodes = 40");
    let few = audit();
    assert!(
        count(&few, "resolution_missed") > 0 && few["resolution_ratio"].as_f64().unwrap() > 4.0
    );
    assert!(count(&few, "resolution_missed") <= count(&few, "resolution_looks"));
    let table = place.endline(&["run", &scenario, "--all"]).done().stdout;
    assert!(table.contains("checks at which resolution was missed"), "{table}");
    for audit in [equal, few] {
        let [contact, touching, all] =
            ["contact_steps", "touching_steps", "solver_steps"].map(|key| count(&audit, key));
        assert!(0 < contact && contact <= touching && touching < all, "{audit}");
        assert!(count(&audit, "unconverged") <= touching, "{audit}");
    }
}

/// A step of a millionth of a millionth of a second is refused alike in a file and as an option, with the reason.
#[test]
fn a_step_beyond_its_limit_is_refused_on_the_command_line_as_in_a_file() {
    let place = Place::new("step-limit");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let why = ["`step` is 1e-12 s", "because", "10 ms is usual"];
    place.endline(&["run", &scenario, "--dt", "1e-12s"]).fails(2, &why);
    edit(scenario.as_ref(), "duration", "duration = \"0.1 s\"\nstep = \"1e-12 s\"");
    place.endline(&["run", &scenario]).fails(1, &why);
}

/// Names and comments of a file cannot turn against the terminal, whatever prints them.
#[test]
fn escapes_of_a_file_do_not_reach_the_terminal() {
    let place = Place::new("escapes");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    edit(scenario.as_ref(), "duration", "duration = \"\\u001b]52;c;cm0gLXJm\\u0007 1 s\"");
    let refused = place.endline(&["check", &scenario]);
    assert_eq!(refused.code, Some(1), "{refused}");
    let printed = refused.stdout + &refused.stderr;
    assert!(!printed.contains(['\u{1b}', '\u{7}']), "{printed:?}");
    assert!(printed.contains("]52;c;"), "{printed}");
}

#[test]
fn people_get_pounds_force_beside_newtons() {
    let place = Place::new("table");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let headline = place.endline(&["run", &scenario]).done().stdout;
    assert!(headline.lines().count() <= 10, "{headline}");
    for word in ["No contact", "Greatest tension: ", " N (", " lbf)", "Nothing parted.", "--all"] {
        assert!(headline.contains(word), "no `{word}` in\n{headline}");
    }
    let table = place.endline(&["run", &scenario, "--all"]).done().stdout;
    assert!(table.contains("Nothing parted."), "{table}");
    for word in [" N (", " lbf)", "state hash", "times real time", "peak tension"] {
        assert!(table.contains(word), "no `{word}` in\n{table}");
    }
}

#[test]
fn settle_prints_shape_tensions_and_residual() {
    let place = Place::new("settle");
    let scenario = place.short_scenario("hello-endline", "1 s");
    let shape = place.endline(&["settle", &scenario, "--json"]).done().json();
    assert_eq!(shape["converged"], true);
    assert!(shape["residual_N"].as_f64().unwrap() < 1.0);
    for line in shape["lines"].as_array().unwrap() {
        let (nodes, tensions) = (
            line["position_m"].as_array().unwrap().len(),
            line["tension_N"].as_array().unwrap().len(),
        );
        assert_eq!(nodes, tensions + 1);
    }
    assert!(place.endline(&["settle", &scenario]).done().stdout.contains("at rest"));
}

/// In 2 m/s nothing holds the shipped single: a run does not start from gear that drags, unless it is allowed.
#[test]
fn a_run_refuses_unsettled_gear_unless_allowed() {
    let place = Place::new("unsettled");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    edit(scenario.as_ref(), "speed", "speed = \"2 m/s\"");
    let why = ["the gear drags", "the load exceeds", "`trap`"];
    place.endline(&["settle", &scenario]).fails(1, &why);
    let refused = place.endline(&["run", &scenario, "--json"]);
    refused.fails(1, &why);
    refused.fails(1, &["--allow-unsettled"]);
    assert_eq!(refused.stdout, "");
    let printed = place.endline(&["run", &scenario, "--json", "--allow-unsettled"]).done().json();
    assert_eq!(printed["valid"], true);
}

/// A whale that swims away from the gear touches nothing: the run is over after half a minute, and its recording is as long.
#[test]
fn a_run_ends_when_it_is_over_if_requested() {
    let place = Place::new("over");
    let scenario = place.short_scenario("hello-endline", "40 s");
    edit(scenario.as_ref(), "heading", "heading = \"180 deg\"");
    let folder = place.path("out").display().to_string();
    let printed = place.endline(&["run", &scenario, "--json", "--until-over", "--out", &folder]);
    let seconds = |json: &Value| json["simulated_s"].as_f64().unwrap();
    assert!((seconds(&printed.done().json()) - 30.0).abs() < 1e-9);
    let recording = format!("{folder}/recording.endline");
    place.endline(&["replay", &recording, "--verify"]).done();
    let whole = place.endline(&["run", &scenario, "--json"]).done().json();
    assert!((seconds(&whole) - 40.0).abs() < 1e-9);
}

#[test]
fn wrong_use_ends_with_2() {
    let place = Place::new("use");
    for arguments in [
        &["run"][..],
        &["fly"],
        &["run", "a.toml", "--threads", "2"],
        &["run", "a.toml", "--dt", "-0.01s"],
        &["run", "a.toml", "--dt", "nan s"],
        &["run", "a.toml", "--dt", "1e-12s"],
        &["run", "a.toml", "--rating", "1e300N"],
        &["run", "a.toml", "--weak-links", "maybe"],
        &["run", "a.toml", "--rating", "3 furlong"],
        &["run", "a.toml", "--sed", "1"],
        &["render", "a.endline", "--at", "0s"],
        &["plugins", "check"],
    ] {
        place.endline(arguments).fails(2, &["error:"]);
    }
    assert!(place.endline(&["--help"]).done().stdout.contains("Exit codes"));
    assert!(place.endline(&["--version"]).done().stdout.starts_with("endline "));
}

#[test]
fn shells_complete_every_command_and_each_has_a_manual_page() {
    let place = Place::new("manual");
    let bash = place.endline(&["completions", "bash"]).done().stdout;
    for word in ["settle", "hindcast", "--allow-plugins"] {
        assert!(bash.contains(word), "{word}");
    }
    place.endline(&["completions", "tcsh"]).fails(2, &["tcsh", "bash"]);
    place.endline(&["man", "--out", "pages"]).done();
    for page in ["endline.1", "endline-run.1", "endline-study-report.1"] {
        let text = fs::read_to_string(place.path("pages").join(page)).unwrap();
        assert!(text.contains(".TH endline"), "{page}");
    }
}

#[test]
fn documents_are_inside_the_program() {
    let place = Place::new("documents");
    let listed = place.endline(&["docs"]).done().stdout;
    assert!(listed.contains("gear-format") && listed.contains("Physics: what is solved"));
    let physics = fs::read_to_string(endline_tests::root().join("docs/physics.md")).unwrap();
    assert_eq!(place.endline(&["docs", "physics"]).done().stdout, physics);
    place.endline(&["docs", "zeppelins"]).fails(2, &["zeppelins", "the nearest of"]);
}

#[test]
fn missing_files_are_named() {
    let place = Place::new("missing");
    place.endline(&["run", "no-such.toml"]).fails(1, &["no-such.toml", "cannot be read"]);
    place.endline(&["settle", "no-such.toml"]).fails(1, &["no-such.toml"]);
    place.endline(&["replay", "no-such.endline"]).fails(1, &["no-such.endline", "cannot be read"]);
    place.endline(&["check", "no-such.toml"]).fails(1, &["no-such.toml", "cannot be read"]);
    place.endline(&["plugins", "check", "no-such.so"]).fails(1, &["no-such.so"]);
    let library = text(&place.library());
    let meant = place.endline(&["settle", "hello-endlin", "--library", &library]);
    meant.fails(1, &["no `hello-endlin.toml`", "did you mean `hello-endline`?"]);
    let settled = place.endline(&["settle", "hello-endline", "--library", &library]).done();
    assert!(settled.stdout.contains("endline-top"), "{settled}");
    let scenario = place.write("alone/case.toml", "");
    let nowhere = place.endline(&["run", &text(&scenario), "--library", "no-such-library"]);
    nowhere.fails(1, &["no-such-library", "ropes", "--library"]);
}

/// A fault written into a rope file: the line it replaces, the faulty line, and the expected message.
const FAULTS: [(&str, &str, &[&str]); 3] = [
    ("diameter", "diamter = \"3/8 in\"", &["diamter", "diameter"]),
    ("diameter", "diameter = \"3/8 furlong\"", &["furlong", "a length"]),
    ("diameter", "diameter = \"-3/8 in\"", &["-3/8 in"]),
];

#[test]
fn faults_in_a_rope_file_are_located_by_check() {
    for (index, (start, faulty, words)) in FAULTS.iter().enumerate() {
        let place = Place::new(&format!("check-{index}"));
        let library = place.library();
        let rope = rope(&library);
        edit(&rope, start, faulty);
        let number = 1 + fs::read_to_string(&rope)
            .unwrap()
            .lines()
            .position(|line| line == *faulty)
            .unwrap();
        let located = format!("{}:{number}:", rope.file_name().unwrap().to_str().unwrap());
        // The whole library takes seconds: once is enough.
        let whole = (index == 0).then(|| text(&library));
        for target in whole.into_iter().chain([text(&rope)]) {
            let checked = place.endline(&["check", &target]);
            checked.fails(1, words);
            checked.fails(1, &[&located]);
        }
    }
}

#[test]
fn faults_in_a_scenario_end_the_run_with_1_and_their_place() {
    for (index, (start, faulty, words)) in [
        ("duration", "durration = \"1 s\"", ["durration", "duration"]),
        ("duration", "duration = \"1 furlong\"", ["furlong", "a time"]),
    ]
    .iter()
    .enumerate()
    {
        let place = Place::new(&format!("scenario-{index}"));
        let scenario = place.short_scenario("hello-endline", "1 s");
        edit(scenario.as_ref(), start, faulty);
        for command in ["run", "settle", "check"] {
            let failed = place.endline(&[command, &scenario]);
            failed.fails(1, words);
            failed.fails(1, &["hello-endline.toml:"]);
        }
    }
}

#[test]
fn a_whale_is_built_as_gltf() {
    let place = Place::new("whale");
    let (out, library) = (text(&place.path("whale.glb")), text(&common::library()));
    let build = |whale: &[&str]| {
        place.endline(&[&["whale", "build"], whale, &["--library", &library]].concat())
    };
    let printed = build(&["right-whale", "--length", "10 m", "--out", &out]).done().stdout;
    assert!(printed.contains(": 10 m, ") && printed.contains(" bones, "), "{printed}");
    let bytes = fs::read(&out).unwrap();
    assert!(bytes.starts_with(b"glTF") && bytes.len() > 300_000);
    assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
    build(&["right-whale", "--out", "whale.obj"]).fails(2, &["ends in .glb or .gltf"]);
    build(&["sperm-whale", "--out", &out]).fails(1, &["no whale `sperm-whale`", "right-whale"]);
    build(&["right-whale", "--length", "90 m", "--out", &out]).fails(2, &["from 1 m to 35 m"]);
}

/// The mesh that the program has written stands in the whale's place, and goes into the recording with the library's texts.
#[test]
fn a_whale_from_a_mesh_file_runs_and_replays() {
    let place = Place::new("mesh");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    let plain = place.endline(&["run", &scenario, "--json"]).done().json();
    let whales = place.path("gear-library/whales");
    place
        .endline(&["whale", "build", "right-whale", "--out", &text(&whales.join("mine.glb"))])
        .done();
    let item = whales.join("right-whale.toml");
    fs::write(
        &item,
        fs::read_to_string(&item).unwrap().replacen(
            "\nlength =",
            "\nmesh = \"mine.glb\"\nlength =",
            1,
        ),
    )
    .unwrap();
    let own = place.endline(&["run", &scenario, "--json", "--out", "own"]).done().json();
    assert_eq!(own["triangles"], plain["triangles"]);
    assert_ne!(own["model_hash"], plain["model_hash"]);
    fs::remove_file(whales.join("mine.glb")).unwrap();
    place.endline(&["replay", "own/recording.endline", "--verify"]).done();
    let printed = ["right-whale.toml:", "there is no file `whales/mine.glb`"];
    place.endline(&["run", &scenario]).fails(1, &printed);
    // The file alone too, and by its name in its folder.
    place.endline(&["check", &text(&item)]).fails(1, &printed);
    let mut inside = place.command(&["check", "right-whale.toml"]);
    called(inside.current_dir(&whales)).fails(1, &printed);
}

#[test]
fn the_shipped_library_has_no_faults() {
    let place = Place::new("shipped");
    let checked = place.endline(&["check", &text(&common::library())]).done();
    assert!(checked.stdout.contains(" 0 errors"), "{checked}");
}

#[test]
fn without_a_display_the_program_names_the_command_line() {
    Place::new("display").endline(&[]).fails(1, &["endline run"]);
}

#[test]
fn a_reader_who_leaves_is_no_fault() {
    let place = Place::new("pipe");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    for arguments in [
        &["run", &scenario][..],
        &["run", &scenario, "--json"],
        &["settle", &scenario, "--json"],
        &["plugins", "list"],
        &["--help"],
    ] {
        let mut child =
            place.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(
            output.status.code(),
            Some(0),
            "{arguments:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}

#[test]
fn the_shipped_plugins_are_listed() {
    let listed = Place::new("plugins").endline(&["plugins", "list"]).done();
    for id in ["org.endline.motion.swim", "org.endline.friction.coulomb", "org.endline.gear.single"]
    {
        assert!(listed.stdout.contains(id), "no {id}; {listed}");
    }
}

/// Source of a library whose entry has another ABI version.
const WRONG_ABI: &str = r#"
#[repr(C)]
pub struct Entry(u32, u32, u32, Option<extern "C" fn()>, Option<extern "C" fn()>, Option<extern "C" fn()>);
#[unsafe(no_mangle)]
#[allow(non_upper_case_globals)]
pub static endline_plugin_entry: Entry = Entry(4711, 0, std::mem::size_of::<Entry>() as u32, None, None, None);
"#;

/// Source of a library that panics as soon as it is asked anything.
const PANICS: &str = r#"
#[repr(C)]
pub struct Entry(u32, u32, u32, Option<extern "C" fn(Text, *mut u8) -> i32>, Option<extern "C" fn()>, Option<extern "C" fn()>);
#[repr(C)]
pub struct Text(*const u8, usize);
extern "C" fn init(_: Text, _: *mut u8) -> i32 { panic!("the plugin's own fault") }
extern "C" fn nothing() {}
#[unsafe(no_mangle)]
#[allow(non_upper_case_globals)]
pub static endline_plugin_entry: Entry = Entry(1, 0, std::mem::size_of::<Entry>() as u32, Some(init), None, Some(nothing));
"#;

/// Compiles a library in a plugins folder of a place.
fn library(place: &Place, name: &str, source: &str) -> String {
    let source = place.write(&format!("{name}.rs"), source);
    let file = place.path("plugins").join(format!("{name}.{}", std::env::consts::DLL_EXTENSION));
    fs::create_dir_all(place.path("plugins")).unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    called(
        Command::new(rustc)
            .args(["--edition", "2024", "--crate-type", "cdylib", "-o"])
            .arg(&file)
            .arg(source),
    )
    .done();
    text(&file)
}

#[test]
fn a_bad_plugin_is_reported_and_the_others_work() {
    let place = Place::new("bad-plugins");
    for (name, source, words) in
        [("wrong_abi", WRONG_ABI, &["4711"][..]), ("panics", PANICS, &["panics."][..])]
    {
        let file = library(&place, name, source);
        let checked = place.endline(&["plugins", "check", &file]);
        // The check of a library that panics across its boundary is itself ended by a signal: that is what the child is for.
        assert!(checked.code != Some(0), "{checked}");
        assert!(name == "panics" || checked.stderr.contains(words[0]), "{checked}");

        let list = |arguments: &[&str]| {
            called(place.command(arguments).env("ENDLINE_PLUGINS", place.path("plugins"))).done()
        };
        let unasked = list(&["plugins", "list"]);
        assert!(
            unasked.stdout.contains("not allowed")
                && unasked.stderr.contains("has not been allowed yet"),
            "{unasked}"
        );
        let listed = list(&["--allow-plugins", "plugins", "list"]);
        let standing = format!("quarantined   {file}");
        assert!(listed.stdout.contains(&standing), "{standing}; {listed}");
        assert!(words.iter().all(|word| listed.stderr.contains(word)), "{listed}");
        assert!(listed.stdout.contains("org.endline.motion.swim"), "{listed}");
        fs::remove_file(file).unwrap();
    }
    let file = place
        .write(&format!("plugins/text.{}", std::env::consts::DLL_EXTENSION), "no library at all");
    place.endline(&["plugins", "check", &text(&file)]).fails(1, &["text."]);
}

/// A field set on the command line gives the state of a scenario that says the same.
#[test]
fn fields_are_set_on_the_command_line() {
    let place = Place::new("set");
    let scenario = place.short_scenario("hello-endline", "0.2 s");
    let rest = |arguments: &[&str]| {
        let json = place.endline(arguments).done().json();
        json["lines"].to_string()
    };
    let plain = rest(&["settle", &scenario, "--json"]);
    let by_option = rest(&[
        "settle",
        &scenario,
        "--json",
        "--set",
        "current.speed=0.5 m/s",
        "--set",
        "ropes/sink-3-8.drag_normal=1.5",
    ]);
    assert_ne!(plain, by_option);
    place.endline(&["settle", &scenario, "--set", "current.sped=0.5 m/s"]).fails(1, &["sped"]);
    place
        .endline(&["settle", &scenario, "--set", "ropes/sink-3-9.drag_normal=1.5"])
        .fails(1, &["ropes/sink-3-9.toml", "did you mean `ropes/sink-"]);
    place.endline(&["settle", &scenario, "--set", "current.speed"]).fails(2, &["FIELD=VALUE"]);
    edit(scenario.as_ref(), "speed", "speed = \"0.5 m/s\"");
    let by_file = rest(&["settle", &scenario, "--json", "--set", "ropes/sink-3-8.drag_normal=1.5"]);
    assert_eq!(by_file, by_option);
}
