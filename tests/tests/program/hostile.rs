//! Files and calls that ask for too much, or mean harm: each ends soon, with what is wrong, where, and how to correct it.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::fmt::Write;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::common::{Called, Place, edit, text};

#[test]
fn numbers_past_their_limits_are_refused_by_check_and_run_and_on_the_command_line() {
    let place = Place::new("limits");
    let scenario = place.short_scenario("hello-endline", "1 s");
    edit(scenario.as_ref(), "rope_nodes", "rope_nodes = 1000000000");
    for command in ["check", "run"] {
        place.endline(&[command, &scenario]).fails(1, &["rope_nodes", "1000000000", "100000"]);
    }
    for step in ["1e-12s", "0s", "2s", "nan", "0.01"] {
        place.endline(&["run", &scenario, "--dt", step]).fails(2, &["--dt"]);
    }
}

#[test]
fn what_is_no_regular_file_is_not_read_and_links_that_lead_round_end() {
    let place = Place::new("links");
    let library = place.library();
    let ropes = library.join("ropes");
    assert!(Command::new("mkfifo").arg(ropes.join("pipe.toml")).status().unwrap().success());
    symlink("/dev/zero", ropes.join("zero.toml")).unwrap();
    for name in ["pipe.toml", "zero.toml"] {
        let file = text(&ropes.join(name));
        place.endline(&["check", &file]).fails(1, &[name, "it is not a regular file"]);
    }
    let called = place.endline(&["check", library.to_str().unwrap()]);
    called.fails(1, &["ropes/pipe.toml", "ropes/zero.toml", "it is not a regular file"]);

    let folder = place.path("round");
    fs::create_dir_all(&folder).unwrap();
    for name in ["a", "b"] {
        symlink(".", folder.join(name)).unwrap();
    }
    place.endline(&["check", folder.to_str().unwrap()]).fails(1, &["nothing to check here"]);
}

#[test]
fn a_file_with_thousands_of_mistakes_tells_the_first_and_counts_the_rest() {
    let place = Place::new("mistakes");
    let rope = place.library().join("ropes/sink-3-8.toml");
    let mut own = fs::read_to_string(&rope).unwrap();
    (0..5000).for_each(|key| writeln!(own, "unknown{key} = 1").unwrap());
    fs::write(&rope, own).unwrap();
    let called = place.endline(&["check", rope.to_str().unwrap()]);
    called.fails(1, &["unknown0", "more problems are not shown"]);
    assert!(called.stdout.len() + called.stderr.len() < 200_000, "{}", called.stdout.len());

    // One line of 100 kB is not printed whole with each of its mistakes.
    let keys: Vec<String> =
        (0..2000).map(|key| format!("{{ time = \"{key} furlong\", pitch = 1 }}")).collect();
    let act = place.write(
        "gear-library/acts/long.toml",
        &format!("format = 1\nkind = \"act\"\nname = \"long\"\nkey = [{}]\n", keys.join(", ")),
    );
    let called = place.endline(&["check", act.to_str().unwrap()]);
    called.fails(1, &["furlong"]);
    assert!(called.stdout.len() + called.stderr.len() < 400_000, "{}", called.stdout.len());
}

#[test]
fn nothing_of_a_file_steers_the_terminal() {
    let place = Place::new("terminal");
    let rope = place.library().join("ropes/sink-3-8.toml");
    edit(&rope, "name", "name = \"x\\u001b]52;c;eA==\\u0007\\u202e\"");
    edit(&rope, "strength", "strength = \"12 \u{1b}[31mfurlong\"");
    let called = place.endline(&["check", rope.to_str().unwrap()]);
    assert_ne!(called.code, Some(0), "{called}");
    let printed = called.stdout + &called.stderr;
    assert!(
        !printed.contains('\u{1b}') && !printed.contains('\u{202e}') && printed.contains("\\u001b"),
        "{printed}"
    );
}

#[test]
fn rope_in_a_heap_ends_its_run_with_the_reason() {
    let place = Place::new("heap");
    let scenario = place.short_scenario("hitches", "1 s");
    edit(scenario.as_ref(), "length = \"0.9459 m\"", "length = \"30 m\"");
    let called = place.endline(&["run", &scenario]);
    called.fails(1, &["stopped at", "than can be solved", "check its length"]);
}

#[test]
fn a_recording_that_contradicts_itself_is_refused_and_nothing_is_written_over_it() {
    let place = Place::new("forged");
    let scenario = place.short_scenario("hello-endline", "0.1 s");
    place.endline(&["run", &scenario, "--out", "out"]).done();
    let path = place.path("out/recording.endline");
    let sound = fs::read(&path).unwrap();
    let file = path.to_str().unwrap();
    let called = place.endline(&["render", file, "--at", "0s", "--out", file]);
    let written_over = "--out would write over";
    called.fails(2, &[written_over]);
    place.endline(&["pilot", file, "--out", file]).fails(2, &[written_over]);
    let from = ["run", &scenario, "--from", file, "--at", "0.05s", "--out", "out"];
    place.endline(&from).fails(2, &[written_over]);
    assert_eq!(fs::read(&path).unwrap(), sound, "the recording is as it was");

    let mut recording = endline_session::Recording::load(&path).unwrap();
    type Forge = fn(&mut endline_session::Recording);
    let forged: [(&str, Forge); 4] = [
        ("its step", |recording| recording.header.dt_s *= 0.5),
        ("its seed", |recording| recording.header.seed += 1),
        ("its hash of the model", |recording| recording.header.model_hash.truncate(3)),
        ("used here, but not recorded", |recording| recording.header.plugins.clear()),
    ];
    for (says, forge) in forged {
        let header = recording.header.clone();
        forge(&mut recording);
        recording.save(&path).unwrap();
        for arguments in [vec!["replay", file], vec!["replay", file, "--verify"]] {
            place.endline(&arguments).fails(1, &[says]);
        }
        recording.header = header;
    }
}

/// Commands that take a file: `FILE` is its path, `OUT` a path to write; the ending that the file's name gets.
const TAKING: [(&str, &str); 35] = [
    ("toml", "run FILE"),
    ("endline", "run hello-endline --from FILE --at 0.05s --out OUT"),
    ("toml", "settle FILE"),
    ("endline", "replay FILE"),
    ("endline", "replay FILE --verify"),
    ("endline", "pilot FILE --out OUT.toml"),
    ("toml", "render FILE --out OUT.png"),
    ("endline", "render FILE --out OUT.png"),
    ("toml", "export FILE --out OUT"),
    ("endline", "export FILE --out OUT"),
    ("toml", "check FILE"),
    ("toml", "search FILE --out OUT"),
    ("toml", "search e15-02 --encounters FILE --out OUT"),
    ("toml", "haul FILE"),
    ("toml", "sheet FILE --area maine --on 2024-06-01 --to OUT.html"),
    ("toml", "rules check FILE --area maine --on 2024-06-01"),
    ("toml", "rules check pair --area maine --on 2024-06-01 --pack FILE"),
    ("toml", "rules fix FILE --area maine --on 2024-06-01"),
    ("toml", "rules study pair --option us.weak --option us.traps --out OUT.toml --like FILE"),
    ("toml", "rules list --pack FILE"),
    ("csv", "mill FILE"),
    ("so", "plugins check FILE"),
    ("so", "plugins allow FILE"),
    ("toml", "study plan FILE"),
    ("toml", "study run FILE --out OUT"),
    ("toml", "study status FILE --out OUT"),
    ("toml", "study submit FILE --slurm --dry-run --out OUT"),
    ("toml", "study merge FILE --out OUT"),
    ("toml", "study report FILE --out OUT"),
    ("json", "study report buoy-contact --out OUT --haul FILE"),
    ("toml", "study hindcast FILE --out OUT"),
    ("csv", "study threat threat --out OUT --poll FILE"),
    ("csv", "study threat weak-links --out OUT --model FILE"),
    ("csv", "study threat weak-links --out OUT --strengths FILE"),
    ("toml", "study replay FILE --row 0 --out OUT"),
];

/// What is there under the name: makes it.
type Make = fn(&Path);

const UNREADABLE: [(&str, Make); 5] = [
    ("pipe", |file| assert!(Command::new("mkfifo").arg(file).status().unwrap().success())),
    ("folder", |file| fs::create_dir_all(file).unwrap()),
    ("missing", |_| ()),
    ("noise", |file| fs::write(file, [0xff, 0xfe, 0, 7, 0xc3, 0x28].repeat(64)).unwrap()),
    ("huge", |file| fs::File::create(file).unwrap().set_len((4 << 30) + 1).unwrap()),
];

#[test]
fn every_command_that_takes_a_file_refuses_what_is_none_and_ends() {
    let place = Place::new("taking");
    // A permission is for the bytes of a file, whatever they are.
    let is_refused =
        |words: &str, kind: &str| !(words.starts_with("plugins allow") && kind == "noise");
    let all = TAKING.iter().flat_map(|row| UNREADABLE.map(|kind| (row, kind)));
    let jobs: Vec<_> = all.filter(|(row, kind)| is_refused(row.1, kind.0)).collect();
    let (next, wrong) = (AtomicUsize::new(0), AtomicUsize::new(0));
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some(((ending, words), (kind, make))) =
                    jobs.get(next.fetch_add(1, Ordering::Relaxed))
                {
                    let name = words.replace([' ', '/'], "-");
                    let file = place.path(&format!("{name}-{kind}.{ending}"));
                    make(&file);
                    let out = place.path(&format!("{name}-{kind}-out"));
                    let words = words.replace("FILE", &text(&file)).replace("OUT", &text(&out));
                    let words: Vec<&str> = words.split(' ').collect();
                    let mut command = place.command(&words);
                    let called = ended(command.stdout(Stdio::piped()).stderr(Stdio::piped()));
                    let says = called.stdout.clone() + &called.stderr;
                    let right = matches!(called.code, Some(1 | 2))
                        && says.contains(&format!("{name}-{kind}"))
                        && !says.contains("panicked");
                    if !right {
                        eprintln!("### {words:?}: {called}");
                        wrong.fetch_add(1, Ordering::Relaxed);
                    }
                }
            });
        }
    });
    assert_eq!(wrong.into_inner(), 0);
}

/// A call that ends within a minute.
fn ended(command: &mut Command) -> Called {
    let mut child = command.spawn().unwrap();
    let until = Instant::now() + Duration::from_secs(60);
    while child.try_wait().unwrap().is_none() {
        if Instant::now() > until {
            child.kill().unwrap();
            panic!("{command:?} did not end");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Called::of(child.wait_with_output().unwrap())
}
