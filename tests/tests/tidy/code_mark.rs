//! The mark of the code that decides a run covers the libraries that decide it, and no others.

#[path = "../../../app/session/build/libraries.rs"]
mod libraries;

use std::collections::BTreeSet;

use crate::none;

#[test]
fn the_mark_covers_what_calculates_and_nothing_that_only_tests_or_draws() {
    let found =
        libraries::deciding(endline_tests::root()).expect("the dependency tree can be read");
    let names: BTreeSet<&str> =
        found.iter().filter_map(|package| package.split(' ').next()).collect();
    for decides in ["glam", "libm", "pulp", "sobol_burley", "statrs", "toml_edit", "gltf"] {
        assert!(names.contains(decides), "{decides} decides a run: {names:?}");
    }
    for other in ["askama", "egui", "eframe", "parquet", "three-d", "divan"] {
        assert!(!names.contains(other), "{other} decides no run");
    }
    let versioned = found.iter().all(|package| package.split(' ').count() == 2);
    assert!(versioned, "each with its version: {found:?}");
}

#[test]
fn each_library_of_the_session_is_declared_to_decide_or_to_report() {
    let manifest =
        libraries::read(endline_tests::root(), "app/session/Cargo.toml").expect("a manifest");
    let declared: BTreeSet<&str> =
        libraries::DECIDING.iter().chain(libraries::REPORTING).copied().collect();
    let used = libraries::dependencies(&manifest);
    let outside: BTreeSet<&str> =
        used.iter().map(String::as_str).filter(|name| !name.starts_with("endline")).collect();
    let difference: Vec<String> =
        declared.symmetric_difference(&outside).map(|name| (*name).to_owned()).collect();
    none(
        &difference,
        "app/session/build/libraries.rs lists the libraries of the session, each once",
    );
}
