//! Libraries that the user has allowed run in processes of their own: whatever they do, a run ends with a reason, and the program with
//! its own exit code. Sound ones give the bits that they give in the program's process.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fs;
use std::path::PathBuf;

use crate::common::{Called, Place, called, edit, text};

/// Behaviour of a library half a second into a run, and the message of the run.
const HARM: [(&str, &str, &str); 9] = [
    ("null", "*(volatile int *)0 = 1;", "signal: 11"),
    ("abort", "abort();", "signal: 6"),
    ("exit", "exit(0);", "its process ended (exit status: 0)"),
    ("memory", "for (;;) memset(malloc(1 << 24), 1, 1 << 24);", "signal: 11"),
    ("rounds", "fesetround(FE_UPWARD);", "floating-point state"),
    (
        "forges",
        "for (int file = 3; file < 40; file++) if (write(file, \"no answer at all\", 16) < 0) continue;",
        "it said what no plugin says",
    ),
    ("spins", "for (;;) {}", "no answer in 10 s"),
    ("stops", "raise(SIGSTOP);", "no answer in 10 s"),
    (
        "closes",
        "for (int file = 3; file < 40; file++) close(file); for (;;) {}",
        "it closed its pipe",
    ),
];

/// What a library must not be able to do in a process of its own; where it can, it ends its run.
const DOORS: [(&str, &str); 6] = [
    ("reads", "if (fopen(\"/etc/passwd\", \"r\")) abort();"),
    ("writes", "if (fopen(\"harm\", \"w\")) abort();"),
    ("connects", "if (socket(AF_INET, SOCK_STREAM, 0) >= 0) abort();"),
    ("forks", "if (fork() >= 0) abort();"),
    ("kills", "if (kill(getppid(), SIGKILL) == 0) abort();"),
    ("traces", "if (ptrace(PTRACE_ATTACH, getppid(), NULL, NULL) == 0) abort();"),
];

/// A library made of `late.c`, allowed by the user.
fn allowed(place: &Place, name: &str, harm: &str) -> PathBuf {
    let folder = place.path(name);
    fs::create_dir_all(&folder).unwrap();
    let library = folder.join(format!("late{}", std::env::consts::DLL_SUFFIX));
    let define = format!("HARM={harm}");
    endline_tests::compile_c("tests/plugins/late.c", &[&define], &library).unwrap();
    place.endline(&["plugins", "allow", &text(&library)]).done();
    folder
}

/// A run of a scenario with the plugins of a folder.
fn run(place: &Place, folder: &PathBuf, scenario: &str) -> Called {
    called(place.command(&["run", scenario, "--json"]).env("ENDLINE_PLUGINS", folder))
}

/// An encounter with a whale that swims as `late.c` does.
fn encounter(place: &Place) -> String {
    let scenario = place.encounter();
    edit(scenario.as_ref(), "motion", "motion = \"org.example.motion.late\"");
    edit(scenario.as_ref(), "cruise_speed", "");
    scenario
}

#[test]
fn whatever_a_library_does_the_run_ends_with_a_reason_and_the_program_lives() {
    let place = Place::new("out-of-process");
    let scenario = encounter(&place);
    let folders = HARM.map(|(name, harm, _)| allowed(&place, name, harm));
    std::thread::scope(|threads| {
        for ((name, _, message), folder) in HARM.into_iter().zip(&folders) {
            let (place, scenario) = (&place, &scenario);
            threads.spawn(move || {
                let called = run(place, folder, scenario);
                called.fails(1, &["plugin `org.example.motion.late`", message]);
                let at = called.json()["stopped"].clone();
                assert!(at.to_string().contains("0.51"), "{name}: {at}");
                assert!(endline_tests::documented("plugin-abi.md", &[name, message]), "{name}");
            });
        }
    });
}

#[cfg(target_os = "linux")]
#[test]
fn in_a_process_of_its_own_a_library_reaches_nothing_else() {
    let place = Place::new("sandbox");
    let scenario = encounter(&place);
    for (name, harm) in DOORS {
        let folder = allowed(&place, name, harm);
        run(&place, &folder, &scenario).done();
        assert!(endline_tests::documented("plugin-abi.md", &[name, "not permitted"]), "{name}");
    }
}

#[test]
fn a_library_gives_the_same_bits_in_a_process_of_its_own_as_in_the_programs() {
    let place = Place::new("out-of-process-bits");
    let scenario = place.encounter();
    let shipped = endline_tests::products().unwrap().join("plugins");
    let libraries: Vec<String> =
        fs::read_dir(&shipped).unwrap().map(|entry| text(&entry.unwrap().path())).collect();
    let hash_where = |how: &str, listed_so: bool| {
        let allow = ["plugins", "allow", how].into_iter().filter(|word| !word.is_empty());
        let allow: Vec<&str> = allow.chain(libraries.iter().map(String::as_str)).collect();
        place.alone(&allow).done();
        let with = |arguments: &[&str]| {
            called(place.command_alone(arguments).env("ENDLINE_PLUGINS", &shipped)).done()
        };
        let listed = with(&["plugins", "list"]).stdout;
        assert!(!listed.contains("linked in"), "{listed}");
        assert_eq!(listed.contains("in a process of its own"), listed_so, "{listed}");
        with(&["run", &scenario, "--json"]).json()["state_hash"].clone()
    };
    let own_process = hash_where("", true);
    assert!(own_process.is_string());
    assert_eq!(own_process, hash_where("--in-process", false));
}
