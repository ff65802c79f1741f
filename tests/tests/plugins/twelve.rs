//! Twelve bad plugins: each is tried in a child process and reported with its defect, and the program continues.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::{env, fs};

use endline_session::plugins::PluginHost;

use crate::built::{compile_c, first_party_file, folder, panicking};
use crate::checked::{patient, stand_in};

/// What each file is refused for.
const VERDICTS: [(&str, &str); 15] = [
    (
        "panicking",
        "tried out with its own defaults, plugin `org.example.motion.panicking`: it failed inside (panicked): the whale bit me",
    ),
    ("abort", "it crashes at the check `defaults` of `org.example.motion.abort` (signal: 6"),
    ("segfault", "it crashes at the check `defaults` of `org.example.motion.segfault` (signal: 11"),
    ("loops", "it hangs at the check `ranges` of `org.example.motion.loops` (no answer in 3 s)"),
    (
        "nan",
        "at the check `ranges`, plugin `org.example.motion.not-a-number`: it gave NaN for the speed",
    ),
    (
        "too_few",
        "plugin `org.example.friction.too-few`: it wrote fewer answers than the 3 contacts it was asked about",
    ),
    (
        "too_many",
        "at the check `ranges`, plugin `org.example.friction.too-many`: it wrote beyond the 8 answers and 8 floats",
    ),
    ("wrong_abi", "was built for plugin ABI 4.3, but this program speaks 3.2"),
    ("missing_entry", "does not export `endline_plugin_entry`"),
    ("truncated_file", "is cut short: "),
    ("notes", "is not a library that can be opened"),
    (
        "hidden",
        "at the check `restore`, plugin `org.example.motion.hidden`: its state does not restore",
    ),
    ("motor", "at the check `energy`, plugin `org.example.friction.motor`: it adds energy"),
    ("impure", "at the check `pure`, plugin `org.example.friction.impure`: `respond` is not pure"),
    ("crash", "it crashes when opened (signal: 6"),
];

/// The bad files, and one good one.
fn all(folder: &Path) -> Vec<PathBuf> {
    for source in
        ["abort", "segfault", "loops", "nan", "too_few", "too_many", "hidden", "motor", "impure"]
    {
        compile_c(&format!("tests/plugins/bad/{source}.c"), folder);
    }
    for source in ["wrong_abi", "missing_entry", "crash"] {
        compile_c(&format!("tests/plugins/{source}.c"), folder);
    }
    let suffix = env::consts::DLL_SUFFIX;
    let good = first_party_file("endline_gear_types");
    let bytes = fs::read(&good).unwrap();
    fs::write(folder.join(format!("truncated_file{suffix}")), &bytes[..bytes.len() / 2]).unwrap();
    fs::write(folder.join(format!("notes{suffix}")), "not a library\n").unwrap();
    fs::copy(panicking(), folder.join(format!("panicking{suffix}"))).unwrap();
    fs::copy(good, folder.join(format!("good{suffix}"))).unwrap();
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn each_of_twelve_and_more_bad_plugins_has_its_verdict_and_the_program_lives() {
    let folder = folder("twelve");
    let program = stand_in(&self::folder("twelve-program"));
    all(&folder);
    let (host, problems) =
        PluginHost::discover_checked(std::slice::from_ref(&folder), &patient(program, "loops", 3));
    for (file, verdict) in VERDICTS {
        let of = |path: &Path| {
            path.file_stem().unwrap().to_string_lossy().trim_start_matches("lib").to_owned()
        };
        let problem = problems
            .iter()
            .find(|problem| of(&problem.file) == file)
            .unwrap_or_else(|| panic!("{file} passed"));
        assert!(problem.reason.contains(verdict), "{file}: {problem}");
        assert!(endline_tests::documented("plugin-abi.md", &[file, verdict]), "{file}");
    }
    assert_eq!(problems.len(), VERDICTS.len(), "{problems:?}");
    assert_eq!(host.ids().len(), 6, "the good one is there: {:?}", host.ids());
}
