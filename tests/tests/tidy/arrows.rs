//! Which crate may know which:
//! `plugins/* -> sdk <- sim <- gear-library <- session <- workbench <- python`, `tests -> all`, read from the manifests.
//! Panels of the window read the workbench by its views, and change it by commands only.

use std::collections::BTreeSet;

use crate::{none, sources, toml_file};

/// What one crate may depend on.
struct Wall {
    folder: &'static str,
    /// Our own crates it may use.
    ours: &'static [&'static str],
    /// Outside crates it may use; `None` where only `FORBIDDEN` counts.
    outside: Option<&'static [&'static str]>,
}

const PLUGINS: [&str; 3] =
    ["endline-friction-models", "endline-gear-types", "endline-whale-motions"];

const WALLS: [Wall; 10] = [
    Wall { folder: "plugins/sdk", ours: &[], outside: Some(&[]) },
    Wall { folder: "plugins/friction-models", ours: &["endline-sdk"], outside: Some(&["libm"]) },
    Wall { folder: "plugins/gear-types", ours: &["endline-sdk"], outside: Some(&["libm"]) },
    Wall { folder: "plugins/whale-motions", ours: &["endline-sdk"], outside: Some(&["libm"]) },
    Wall {
        folder: "app/sim",
        ours: &["endline-sdk"],
        outside: Some(&["glam", "libm", "parry3d", "pulp", "strum"]),
    },
    Wall {
        folder: "gear-library",
        ours: &["endline-sdk", "endline-sim"],
        outside: Some(&[
            "base64",
            "blake3",
            "csv",
            "glam",
            "gltf",
            "libm",
            "serde",
            "serde_json",
            "strsim",
            "strum",
            "toml",
            "toml_edit",
        ]),
    },
    Wall {
        folder: "app/session",
        ours: &["endline-sdk", "endline-sim", "endline-gear"],
        outside: None,
    },
    // The plugins are linked for `embedded.rs` alone, so that the program's file works by itself.
    Wall {
        folder: "app/workbench",
        ours: &[
            "endline-sdk",
            "endline-sim",
            "endline-gear",
            "endline-session",
            PLUGINS[0],
            PLUGINS[1],
            PLUGINS[2],
        ],
        outside: None,
    },
    // Above the workbench for its pictures alone.
    Wall {
        folder: "app/python",
        ours: &["endline", "endline-sdk", "endline-sim", "endline-gear", "endline-session"],
        outside: Some(&["pyo3"]),
    },
    // Only tests depend on it, by the list of `dev-dependencies`.
    Wall {
        folder: "tests/fixtures",
        ours: &["endline-sdk", "endline-sim", PLUGINS[0]],
        outside: Some(&["libm"]),
    },
];

/// Our crates that the tests of any crate may use beside those of its wall.
const FOR_TESTS: [&str; 4] = [PLUGINS[0], PLUGINS[1], PLUGINS[2], "endline-fixtures"];

/// Outside crates that only one of ours may use, and why.
const KEPT_TO: [(&str, &str, &str); 11] = [
    ("toml", "gear-library", "only the gear library knows TOML"),
    ("toml_edit", "gear-library", "only the gear library knows TOML"),
    (
        "exmex",
        "app/session",
        "a dependency of the gear library would count as one that decides a run",
    ),
    ("libloading", "app/session", "only the session opens libraries"),
    ("clap", "app/workbench", "the session has no command line"),
    ("indicatif", "app/workbench", "the session has no terminal"),
    ("eframe", "app/workbench", "the session has no screen"),
    ("egui", "app/workbench", "the session has no screen"),
    ("three-d", "app/workbench", "the session has no screen"),
    ("gilrs", "app/workbench", "the session has no gamepad"),
    ("rfd", "app/workbench", "the session has no dialogs"),
];

/// Keys of every table of this kind in a manifest, target-specific ones too.
fn dependencies(manifest: &toml::Table, kind: &str) -> BTreeSet<String> {
    let targets = manifest
        .get("target")
        .and_then(toml::Value::as_table)
        .into_iter()
        .flat_map(|targets| targets.values());
    let tables = targets.filter_map(toml::Value::as_table).chain([manifest]);
    tables
        .filter_map(|table| table.get(kind)?.as_table())
        .flat_map(|table| table.keys().cloned())
        .collect()
}

/// Manifests of all members, by folder.
fn members() -> Vec<(String, toml::Table)> {
    let workspace = toml_file("Cargo.toml");
    let members = workspace["workspace"]["members"].as_array().expect("members");
    let folders = members.iter().map(|member| member.as_str().expect("a folder").to_owned());
    folders.map(|folder| (folder.clone(), toml_file(&format!("{folder}/Cargo.toml")))).collect()
}

#[test]
fn each_crate_knows_only_what_it_may() {
    let mut complaints = Vec::new();
    for wall in &WALLS {
        let manifest = toml_file(&format!("{}/Cargo.toml", wall.folder));
        for kind in ["dependencies", "build-dependencies"] {
            for name in dependencies(&manifest, kind) {
                let is_ours = name.starts_with("endline");
                let may = if is_ours {
                    wall.ours.contains(&name.as_str())
                } else {
                    wall.outside.is_none_or(|list| list.contains(&name.as_str()))
                };
                if !may {
                    complaints.push(format!("{} must not depend on {name}", wall.folder));
                }
            }
        }
        // Tests of a crate may also link plugins, which depend on the sdk alone, and fixtures; nothing above the crate.
        for name in dependencies(&manifest, "dev-dependencies")
            .iter()
            .filter(|name| name.starts_with("endline"))
        {
            if !wall.ours.contains(&name.as_str()) && !FOR_TESTS.contains(&name.as_str()) {
                complaints.push(format!(
                    "{} must not depend on {name}, not even in its tests",
                    wall.folder
                ));
            }
        }
    }
    none(&complaints, "plugins -> sdk <- sim <- gear-library <- session <- workbench");
}

#[test]
fn every_member_is_walled() {
    let walled: BTreeSet<&str> =
        WALLS.iter().map(|wall| wall.folder).chain(["app/xtask", "tests"]).collect();
    let members = members();
    let members: BTreeSet<&str> = members.iter().map(|(folder, _)| folder.as_str()).collect();
    assert_eq!(members, walled, "a new crate needs its line in WALLS");
}

#[test]
fn outside_crates_stay_where_they_belong() {
    let mut complaints = Vec::new();
    for (folder, manifest) in members() {
        let used = dependencies(&manifest, "dependencies");
        for (name, home, reason) in
            KEPT_TO.iter().filter(|(name, home, _)| used.contains(*name) && folder != *home)
        {
            complaints.push(format!("{folder} depends on {name}: {reason} ({home})"));
        }
    }
    none(&complaints, "each outside crate that brings the world in has one home");
}

/// What the program brings with it is listed in one file; all else knows plugins by their hooks.
#[test]
fn one_file_of_the_program_names_its_plugins() {
    let mut complaints = Vec::new();
    for source in sources(&[".rs"]) {
        let is_embedded = source.path == "app/workbench/src/embedded.rs";
        if is_embedded || !source.path.starts_with("app/") || !source.path.contains("/src/") {
            continue;
        }
        for (number, line) in source.text.lines().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            if PLUGINS.iter().any(|plugin| code.contains(&plugin.replace('-', "_"))) {
                complaints.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
            }
        }
    }
    none(&complaints, "plugins are named in app/workbench/src/embedded.rs alone");
}

/// The window's toolkit, in code, not in comments. Whoever drives Endline without a window, from a script or the command
/// line, calls the same session.
#[test]
fn session_sim_and_gear_never_name_egui() {
    let floors = ["app/session/", "app/sim/", "gear-library/"];
    let mut complaints = Vec::new();
    for source in sources(&[".rs", "Cargo.toml"]) {
        if !floors.iter().any(|floor| source.path.starts_with(floor)) {
            continue;
        }
        for (number, line) in source.text.lines().enumerate() {
            let comment = if source.path.ends_with(".rs") { "//" } else { "#" };
            let code = line.split(comment).next();
            if code.is_some_and(|code| code.contains("egui") || code.contains("eframe")) {
                complaints.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
            }
        }
    }
    none(&complaints, "only the window knows egui");
}

/// Modules of the session that studies and searches share.
const SHARED_BY_STUDIES: [&str; 4] = ["campaign", "encounters", "page", "table"];

#[test]
fn what_studies_and_searches_share_names_neither() {
    let is_shared = |path: &str| {
        let module = path.strip_prefix("app/session/src/").and_then(|path| path.split('/').next());
        module.is_some_and(|module| SHARED_BY_STUDIES.contains(&module))
    };
    let mut complaints = Vec::new();
    for source in sources(&[".rs"]).into_iter().filter(|source| is_shared(&source.path)) {
        for (number, line) in source.text.lines().enumerate() {
            if line.contains("crate::study") || line.contains("crate::search") {
                complaints.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
            }
        }
    }
    none(&complaints, "what studies and searches share names neither");
}

#[test]
fn xtask_compiles_from_the_standard_library_alone() {
    let manifest = toml_file("app/xtask/Cargo.toml");
    assert_eq!(
        dependencies(&manifest, "dependencies"),
        BTreeSet::new(),
        "xtask is the first thing a newcomer compiles"
    );
}

#[test]
fn members_share_lints_and_licence() {
    let mut complaints = Vec::new();
    for (folder, manifest) in members() {
        let shares =
            |table: &str, key: &str| manifest.get(table).and_then(|table| table.get(key)).is_some();
        if !shares("lints", "workspace") {
            complaints.push(format!("{folder} lacks `[lints] workspace = true`"));
        }
        if manifest["package"]["license"]
            .as_table()
            .is_none_or(|license| !license.contains_key("workspace"))
        {
            complaints.push(format!("{folder} lacks `license.workspace = true`"));
        }
        for (name, value) in
            manifest.get("dependencies").and_then(toml::Value::as_table).into_iter().flatten()
        {
            if value.as_table().is_none_or(|value| !value.contains_key("workspace")) {
                complaints.push(format!(
                    "{folder}: the version of {name} belongs in [workspace.dependencies]"
                ));
            }
        }
    }
    none(&complaints, "what all members share is said once, in the workspace's Cargo.toml");
}

#[test]
fn plugins_are_libraries_whose_entry_is_off_by_default() {
    let chore = std::fs::read_to_string(endline_tests::root().join("app/xtask/src/plugins.rs"))
        .expect("xtask builds the plugins");
    for (folder, manifest) in members()
        .iter()
        .filter(|(folder, _)| folder.starts_with("plugins/") && folder != "plugins/sdk")
    {
        let kinds = manifest["lib"]["crate-type"].as_array().expect("crate-type");
        let kinds: Vec<&str> = kinds.iter().filter_map(toml::Value::as_str).collect();
        assert_eq!(
            kinds,
            ["cdylib", "rlib"],
            "{folder}: loaded like anyone's plugin, and linked in tests"
        );
        let features = manifest["features"].as_table().expect("features");
        assert!(
            features.contains_key("entry"),
            "{folder}: the exported symbol stands behind the feature `entry`"
        );
        let default = features.get("default").and_then(toml::Value::as_array);
        assert!(
            default.is_none_or(Vec::is_empty),
            "{folder}: off by default, so that plugins link side by side"
        );
        let name = manifest["package"]["name"].as_str().expect("a name");
        assert!(
            chore.contains(&format!("\"{name}\"")),
            "{folder}: app/xtask/src/plugins.rs does not build {name}"
        );
    }
}

#[test]
fn what_decides_a_run_repeats_the_lint_settings_of_the_house() {
    // Clippy reads the nearest clippy.toml only.
    let house = toml_file("clippy.toml");
    let folders = ["app/sim", "plugins", "gear-library", "app"];
    let [sim, plugins, gear, app] = folders.map(|folder| {
        let file = toml_file(&format!("{folder}/clippy.toml"));
        for (key, value) in &house {
            assert_eq!(file.get(key), Some(value), "{folder}/clippy.toml must repeat {key}");
        }
        file
    });
    let banned = |file: &toml::Table| {
        let methods = file["disallowed-methods"].as_array().expect("a list").iter();
        methods
            .map(|method| method["path"].as_str().expect("a path").to_owned())
            .collect::<BTreeSet<_>>()
    };
    assert_eq!(
        banned(&sim),
        banned(&plugins),
        "a plugin is part of the physics: it may call no more than sim does"
    );
    let platform = banned(&sim).into_iter().filter(|path| path.starts_with("f64::"));
    assert_eq!(banned(&gear), platform.collect(), "a model is the same on every platform");
    let reading = ["std::fs::read", "std::fs::read_to_string", "std::fs::File::open"];
    assert_eq!(
        banned(&app),
        reading.map(str::to_owned).into(),
        "files that a user names are read by `endline_gear::read`"
    );
}

/// Contact kinds see the solver through their trait's arguments alone.
#[test]
fn contact_never_names_the_solver() {
    let files = sources(&[".rs"]).into_iter();
    let contact = files.filter(|file| file.path.starts_with("app/sim/src/contact/"));
    let named = contact.filter(|file| file.text.contains("crate::solver"));
    none(&named.map(|file| file.path).collect::<Vec<_>>(), "contact must not name crate::solver");
}

/// Methods of the solver are in few files, so that a reader finds what changes its fields.
#[test]
fn methods_of_the_solver_are_in_few_files() {
    let files = sources(&[".rs"]).into_iter();
    let with = files.filter(|file| {
        file.path.starts_with("app/sim/src/")
            && file.text.lines().any(|line| line.starts_with("impl Solver"))
    });
    let with: Vec<_> = with.map(|file| file.path).collect();
    assert!(!with.is_empty() && with.len() <= 8, "`impl Solver` is in {with:?}");
}

/// The only method of the workbench that changes it and that a panel may call.
const PERFORM: &str = "perform";

#[test]
fn panels_change_the_workbench_by_commands_only() {
    let files = sources(&[".rs"]);
    let of = |folder: &'static str| files.iter().filter(move |file| file.path.starts_with(folder));
    let changing: Vec<String> = of("app/session/src/workbench/")
        .flat_map(|file| changing_methods(&file.text))
        .filter(|name| name != PERFORM)
        .collect();
    for known in ["refresh", "check", "say", "write_to"] {
        assert!(changing.iter().any(|name| name == known), "{known}: {changing:?}");
    }
    let complaints = of("app/workbench/src/gui/panels/").flat_map(|file| {
        let text: String = file.text.chars().filter(|letter| !letter.is_whitespace()).collect();
        let calls = changing.iter().map(|name| format!("workbench.{name}("));
        let borrows = ["&mutshared.workbench", "&mutself.shared.workbench", "&mutWorkbench"];
        let wrong = calls.chain(borrows.map(str::to_owned));
        let found = wrong.filter(|wrong| text.contains(wrong));
        found.map(|wrong| format!("{}: {wrong}", file.path)).collect::<Vec<_>>()
    });
    none(&complaints.collect::<Vec<_>>(), "a panel changes the workbench without a command");
}

/// Names of the public methods that take `&mut self`.
fn changing_methods(text: &str) -> Vec<String> {
    let text: String = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    let methods = text.split("pubfn").skip(1).filter_map(|method| {
        let (name, rest) = method.split_once('(')?;
        rest.starts_with("&mutself").then(|| name.to_owned())
    });
    methods.collect()
}
