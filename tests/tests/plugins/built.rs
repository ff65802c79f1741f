//! Plugin libraries of the tests, built once in a target folder of their own: with `entry` on they
//! must not replace what the rest of the workspace links.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::{env, fs};

use endline_tests::root;

/// A fresh, empty folder for one test; the next run clears it.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-tests").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn library_name(stem: &str) -> String {
    format!("{}{stem}{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX)
}

fn cargo_build(arguments: &[&str]) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-libraries");
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command
        .current_dir(root())
        .args(["build", "--quiet"])
        .args(arguments)
        .arg("--target-dir")
        .arg(&target);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    target.join("debug")
}

/// A folder that holds the three libraries that ship with Endline, and nothing else.
pub fn first_party() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let crates = ["endline-whale-motions", "endline-friction-models", "endline-gear-types"];
        let mut arguments = vec!["--lib", "--features", "entry"];
        arguments.extend(crates.iter().flat_map(|name| ["--package", name]));
        let built = cargo_build(&arguments);
        let folder = folder("first-party");
        for name in crates {
            let file = library_name(&name.replace('-', "_"));
            fs::copy(built.join(&file), folder.join(&file)).unwrap();
        }
        folder
    })
}

/// One of the libraries that ship with Endline, by the stem of its file.
pub fn first_party_file(stem: &str) -> PathBuf {
    first_party().join(library_name(stem))
}

/// The library of plugins that panic.
pub fn panicking() -> &'static Path {
    static FILE: OnceLock<PathBuf> = OnceLock::new();
    FILE.get_or_init(|| {
        let built = cargo_build(&[
            "--package",
            "endline-sdk",
            "--example",
            "panicking",
            "--features",
            "entry",
        ]);
        built.join("examples").join(library_name("panicking"))
    })
}

/// Compiles a C source of the repository into a folder.
pub fn compile_c(source: &str, folder: &Path) -> PathBuf {
    let stem = Path::new(source).file_stem().unwrap().to_str().unwrap();
    let file = folder.join(library_name(stem));
    endline_tests::compile_c(source, &[], &file).unwrap();
    file
}
