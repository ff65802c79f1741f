//! What `endline plugins new` writes builds, and passes the check, in each language and of each kind.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use endline_session::plugins::{Language, PluginKind, Project, try_here, write_project};
use endline_tests::root;

use crate::built::{first_party_file, folder};

const KINDS: [(PluginKind, &str); 3] = [
    (PluginKind::Motion, "my-motion"),
    (PluginKind::Friction, "my-friction"),
    (PluginKind::Gear, "my-gear"),
];

fn written(place: &Path, kind: PluginKind, name: &str, language: Language) -> Project {
    write_project(&place.join(name), kind, language, Some(&root().join("plugins/sdk"))).unwrap()
}

/// Runs the command that the project names, with builds kept from one test run to the next.
fn build(project: &Project) {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-templates");
    let mut command = Command::new(&project.build[0]);
    command
        .args(&project.build[1..])
        .env("CARGO_TARGET_DIR", &target)
        .env("CFLAGS", "-std=c99 -Wall -Wextra -Wpedantic -Werror");
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    if project.build[0] == "cargo" {
        let file = target.join("release").join(project.library.file_name().unwrap());
        fs::create_dir_all(project.library.parent().unwrap()).unwrap();
        fs::copy(file, &project.library).unwrap();
    }
}

fn passes(project: &Project, checks: &[&str]) {
    let tried = try_here(&project.library, &|_, _| ()).unwrap();
    assert_eq!(tried.len(), 1);
    assert_eq!(tried[0].info.id, project.id);
    for finding in &tried[0].findings {
        assert!(finding.outcome.is_ok(), "{}: {finding:?}", project.id);
    }
    let made: Vec<_> = tried[0].findings.iter().map(|finding| finding.check).collect();
    assert!(checks.iter().all(|check| made.contains(check)), "{made:?}");
}

const OF_ALL: [&str; 6] = ["defaults", "ranges", "same bits", "restore", "threads", "time"];

#[test]
fn a_project_of_each_kind_in_c_builds_and_passes() {
    let place = folder("templates-c");
    for (kind, name) in KINDS {
        let project = written(&place, kind, name, Language::C);
        build(&project);
        passes(&project, &OF_ALL);
        if kind == PluginKind::Friction {
            passes(&project, &["pure", "energy"]);
        }
    }
    let motion = fs::read_to_string(place.join("my-motion/plugin.c")).unwrap();
    assert!(
        motion.lines().count() < 60,
        "the smallest motion has {} lines",
        motion.lines().count()
    );
}

#[test]
fn a_project_of_each_kind_in_rust_builds_and_passes() {
    let place = folder("templates-rust");
    for (kind, name) in KINDS {
        let project = written(&place, kind, name, Language::Rust);
        build(&project);
        passes(&project, &OF_ALL);
    }
    let motion = fs::read_to_string(place.join("my-motion/src/lib.rs")).unwrap();
    assert!(
        motion.lines().count() < 60,
        "the smallest motion has {} lines",
        motion.lines().count()
    );
}

/// The program alone writes such a project: it has its own copy of `endline-sdk`.
#[test]
fn a_project_builds_without_the_source_of_endline() {
    let place = folder("templates-alone");
    let project =
        write_project(&place.join("my-own"), PluginKind::Friction, Language::Rust, None).unwrap();
    build(&project);
    passes(&project, &OF_ALL);
    let manifest = fs::read_to_string(place.join("my-own/Cargo.toml")).unwrap();
    assert!(manifest.contains("path = \"endline-sdk\""), "{manifest}");
}

#[test]
fn every_plugin_that_ships_passes() {
    for stem in ["endline_whale_motions", "endline_friction_models", "endline_gear_types"] {
        for tried in try_here(&first_party_file(stem), &|_, _| ()).unwrap() {
            for finding in &tried.findings {
                assert!(finding.outcome.is_ok(), "{}: {finding:?}", tried.info.id);
            }
            assert!(tried.findings.len() >= 6, "{}: {:?}", tried.info.id, tried.findings);
        }
    }
}

#[test]
fn what_cannot_be_written_is_reported() {
    let place = folder("templates-refused");
    let refused = |name: &str, sdk: &str| {
        write_project(&place.join(name), PluginKind::Motion, Language::Rust, Some(Path::new(sdk)))
            .unwrap_err()
    };
    assert!(refused("My Motion", "").contains("small letters"));
    assert!(refused("mine", "/nowhere").contains("/nowhere is not the folder of endline-sdk"));
    fs::create_dir(place.join("there")).unwrap();
    assert!(refused("there", "").contains("is there already"));
}
