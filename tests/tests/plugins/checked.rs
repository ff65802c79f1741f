//! A file that crashes or hangs as it is opened takes a child process with it, not the program.
//!
//! The child here is this test again, started through a script that stands for the program's
//! `plugins check --here FILE`.
#![cfg(unix)]

use std::cell::RefCell;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{env, fs};

use endline_session::plugins::{PluginHost, by_child, remembering, report_here};

use crate::built::{compile_c, first_party_file, folder, panicking};

const FILE_VARIABLE: &str = "ENDLINE_TEST_CHECK_FILE";

pub fn stand_in(folder: &Path) -> PathBuf {
    let program = folder.join("endline");
    let test = env::current_exe().unwrap();
    let call = format!(
        "exec '{}' --exact checked::bad_files_are_set_aside --nocapture --quiet",
        test.display()
    );
    fs::write(&program, format!("#!/bin/sh\n[ \"$1 $2 $3\" = \"plugins check --here\" ] || exit 2\n{FILE_VARIABLE}=\"$4\" {call}\n"))
        .unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    program
}

/// What the program does for `plugins check --here FILE`.
fn be_the_child(file: &Path) -> ! {
    let code = match report_here(file, &mut std::io::stdout()) {
        Ok(()) => 0,
        Err(message) => {
            eprintln!("{message}");
            1
        }
    };
    std::process::exit(code)
}

/// A checker with little patience for the file that hangs, and much for the rest: the machine may be busy.
pub fn patient(
    program: PathBuf,
    hangs: &str,
    seconds: u64,
) -> impl Fn(&Path, &str) -> Result<(), String> {
    let [short, long] =
        [seconds, 60].map(|seconds| by_child(program.clone(), Duration::from_secs(seconds)));
    move |file, hash| {
        if file.to_string_lossy().ends_with(&format!("{hangs}{}", env::consts::DLL_SUFFIX)) {
            short(file, hash)
        } else {
            long(file, hash)
        }
    }
}

#[test]
fn bad_files_are_set_aside() {
    if let Some(file) = env::var_os(FILE_VARIABLE) {
        be_the_child(Path::new(&file));
    }
    let folder = folder("checked");
    let program = stand_in(&folder);
    compile_c("tests/plugins/crash.c", &folder);
    compile_c("tests/plugins/hang.c", &folder);
    compile_c("tests/plugins/faulty.c", &folder);
    let suffix = env::consts::DLL_SUFFIX;
    fs::copy(panicking(), folder.join(format!("panicking{suffix}"))).unwrap();
    fs::copy(first_party_file("endline_gear_types"), folder.join(format!("good{suffix}"))).unwrap();

    let start = Instant::now();
    let (host, problems) = PluginHost::discover_checked(&[folder], &patient(program, "hang", 5));
    assert!(start.elapsed() < Duration::from_secs(60));
    assert_eq!(host.ids().len(), 6, "{:?}", host.ids());
    for (file, reason) in [
        ("crash", "it crashes when opened (signal: 6"),
        ("hang", "it hangs when opened (no answer in 5 s)"),
        ("faulty", "its table of functions is truncated"),
        (
            "panicking",
            "tried out with its own defaults, plugin `org.example.motion.panicking`: it failed inside (panicked): the whale bit me",
        ),
    ] {
        let problem =
            problems.iter().find(|problem| problem.file.to_string_lossy().contains(file)).unwrap();
        assert!(
            problem.reason.contains("set aside") && problem.reason.contains(reason),
            "{problem}"
        );
        assert!(endline_tests::documented("plugin-abi.md", &[file, reason]), "{file}");
    }
    assert_eq!(problems.len(), 4, "{problems:?}");
}

/// Libraries that end early, hold the pipe, take memory or change how the processor rounds, as they are opened.
#[test]
fn hostile_files_do_not_pass_and_do_not_hold_the_check_up() {
    let folder = folder("hostile");
    let program = stand_in(&folder);
    for name in ["early", "forks", "greedy", "rounds"] {
        compile_c(&format!("tests/plugins/{name}.c"), &folder);
    }
    let checker = by_child(program, Duration::from_secs(60));
    let (host, problems) = PluginHost::discover_checked(&[folder], &checker);
    assert_eq!(host.ids(), Vec::<String>::new());
    for (file, reason) in [
        ("early", "it ends the program when opened, before every check was made"),
        ("forks", "does not export"),
        ("greedy", "it crashes when opened (signal: 6"),
        ("rounds", "it changed the processor's floating-point state"),
    ] {
        let problem =
            problems.iter().find(|problem| problem.file.to_string_lossy().contains(file)).unwrap();
        assert!(problem.reason.contains(reason), "{problem}");
        assert!(endline_tests::documented("plugin-abi.md", &[file, reason]), "{file}");
    }
    assert_eq!(problems.len(), 4, "{problems:?}");
}

/// Bytes that were swapped after they were allowed are not opened.
#[test]
fn a_child_opens_only_the_bytes_that_were_hashed() {
    let folder = folder("swapped");
    let checker = by_child(stand_in(&folder), Duration::from_secs(60));
    let file = first_party_file("endline_gear_types");
    let refused = checker(&file, &"0".repeat(64)).unwrap_err();
    assert!(refused.contains("has changed as it was checked"), "{refused}");
    let hash = blake3::hash(&fs::read(&file).unwrap()).to_hex().to_string();
    checker(&file, &hash).unwrap();
}

#[test]
fn a_checker_that_cannot_start_is_named() {
    let checker = by_child("/nowhere/endline", Duration::from_secs(1));
    assert!(
        checker(&first_party_file("endline_gear_types"), "")
            .unwrap_err()
            .contains("cannot start /nowhere/endline")
    );
}

#[test]
fn a_file_that_passed_is_not_checked_again_until_it_changes() {
    let folder = folder("remembered");
    let (file, list) = (folder.join("plugin"), folder.join("cache/plugins-checked"));
    let asked = RefCell::new(0);
    let checker = |_: &Path, _: &str| {
        *asked.borrow_mut() += 1;
        if fs::read(&file).unwrap() == b"bad" { Err("bad".to_owned()) } else { Ok(()) }
    };
    let ask_twice = || {
        let remembering = remembering(Some(list.clone()), &checker);
        let hash = blake3::hash(&fs::read(&file).unwrap()).to_hex().to_string();
        let _ = remembering(&file, &hash);
        let answer = remembering(&file, &hash);
        (answer.is_ok(), *asked.borrow())
    };
    fs::write(&file, "good").unwrap();
    assert_eq!(ask_twice(), (true, 1), "asked once in one run");
    assert_eq!(ask_twice(), (true, 1), "and not at all in the next");
    fs::write(&file, "bad").unwrap();
    assert_eq!(ask_twice(), (false, 3), "a changed file is asked about, and a bad one each time");
}
