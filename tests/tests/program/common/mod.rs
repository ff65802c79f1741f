//! Calling the program as a user does, in a folder of the test's own.

#![allow(dead_code, reason = "each test file uses its part of this")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

pub mod form;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// What a call of the program came to.
pub struct Called {
    /// Exit code; `None` where a signal ended it.
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Called {
    /// Exit code and texts of a program that has ended.
    pub fn of(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        let code = output.status.code();
        Self { code, stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    /// The one JSON object on standard output, which is of the form that it names.
    pub fn json(&self) -> Value {
        let mut documents = serde_json::Deserializer::from_str(&self.stdout).into_iter::<Value>();
        let first = documents
            .next()
            .unwrap_or_else(|| panic!("no JSON; {self}"))
            .unwrap_or_else(|error| panic!("{error}; {self}"));
        assert!(documents.next().is_none(), "more than one JSON object; {self}");
        let form = first["schema"].as_str().unwrap_or_else(|| panic!("no form; {self}"));
        form::hold(&first, form);
        first
    }

    /// Asserts an exit code, no panic, and every word on standard error.
    pub fn fails(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, Some(code), "{self}");
        assert!(!self.stderr.contains("panicked"), "{self}");
        for word in words {
            let found = self.stderr.contains(word) || self.stdout.contains(word);
            assert!(found, "`{word}` is not printed; {self}");
        }
    }

    /// Asserts every word on standard output.
    pub fn prints(&self, words: &[&str]) {
        for word in words {
            assert!(self.stdout.contains(word), "`{word}` is not printed; {self}");
        }
    }

    /// Asserts exit code 0.
    pub fn done(self) -> Self {
        assert_eq!(self.code, Some(0), "{self}");
        self
    }
}

impl std::fmt::Display for Called {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "exit code {:?}\n--- stdout\n{}\n--- stderr\n{}",
            self.code, self.stdout, self.stderr
        )
    }
}

/// A folder of a test's own, with its own user folders, removed at its end.
pub struct Place {
    pub folder: PathBuf,
}

impl Place {
    pub fn new(name: &str) -> Self {
        let folder =
            std::env::temp_dir().join(format!("endline-test-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        Self { folder }
    }

    /// Path of a file here.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Writes a file here, its folders too.
    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path
    }

    /// A copy of the gear library here, without its code.
    pub fn library(&self) -> PathBuf {
        let (from, to) = (library(), self.path("gear-library"));
        for file in endline_tests::files_below(&from)
            .unwrap()
            .iter()
            .filter(|file| file.extension().is_some_and(|end| end == "toml" || end == "csv"))
        {
            let to = to.join(file.strip_prefix(&from).unwrap());
            fs::create_dir_all(to.parent().unwrap()).unwrap();
            fs::copy(file, to).unwrap();
        }
        to
    }

    /// A shipped scenario in a copy of the library here, cut to a duration; gives its path.
    pub fn short_scenario(&self, name: &str, duration: &str) -> String {
        let path = self.library().join("scenarios").join(format!("{name}.toml"));
        edit(&path, "duration", &format!("duration = \"{duration}\""));
        text(&path)
    }

    /// The shipped encounter on 500 segments that keep their lengths, with the whale set down just before the rope, two and a half seconds long;
    /// gives its path.
    pub fn encounter(&self) -> String {
        let scenario = self.short_scenario("hello-endline", "2.5 s");
        let text = fs::read_to_string(&scenario).unwrap();
        let (before, after) = text.split_once("[resolution]").unwrap();
        let after = after.split_once("[site]").unwrap().1;
        fs::write(&scenario, format!("{before}[site]{after}")).unwrap();
        edit(scenario.as_ref(), "rope_nodes", "rope_nodes = 500");
        edit(scenario.as_ref(), "position", "position = [\"13.9 m\", \"-7 m\"]");
        scenario
    }

    /// The program with these arguments, no display, and no plugins but its own.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let program = endline_tests::program().unwrap_or_else(|error| panic!("{error}"));
        self.command_of(&program, arguments)
    }

    /// A call of the program's file alone: copied here, with no gear library and no plugins beside it.
    pub fn alone(&self, arguments: &[&str]) -> Called {
        called(&mut self.command_alone(arguments))
    }

    /// A call of the program's file alone, not started yet.
    pub fn command_alone(&self, arguments: &[&str]) -> Command {
        let program = self.path(&format!("bin/endline{}", std::env::consts::EXE_SUFFIX));
        if !program.exists() {
            let built = endline_tests::program().unwrap_or_else(|error| panic!("{error}"));
            fs::create_dir_all(program.parent().unwrap()).unwrap();
            fs::copy(built, &program).unwrap();
        }
        self.command_of(&program, arguments)
    }

    fn command_of(&self, program: &Path, arguments: &[&str]) -> Command {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(&self.folder).stdin(Stdio::null());
        command.env("XDG_DATA_HOME", self.path("data")).env("XDG_CACHE_HOME", self.path("cache"));
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "ENDLINE_PLUGINS", "ENDLINE_LIBRARY"] {
            command.env_remove(name);
        }
        command
    }

    /// Calls the program.
    pub fn endline(&self, arguments: &[&str]) -> Called {
        called(&mut self.command(arguments))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A leftover in the folder for temporary files is harmless.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Calls a command to its end.
pub fn called(command: &mut Command) -> Called {
    Called::of(command.output().unwrap())
}

/// The shipped gear library.
pub fn library() -> PathBuf {
    endline_tests::root().join("gear-library")
}

/// A path as an argument.
pub fn text(path: &Path) -> String {
    path.to_str().unwrap().to_owned()
}

/// Puts a line in the place of the first that starts with a word, which must be there.
pub fn edit(path: &Path, start: &str, line: &str) {
    let before = fs::read_to_string(path).unwrap();
    let old = before
        .lines()
        .find(|line| line.starts_with(start))
        .unwrap_or_else(|| panic!("{} has no `{start}`", path.display()));
    fs::write(path, before.replacen(old, line, 1)).unwrap();
}

/// The first rope file of a library, by name.
pub fn rope(library: &Path) -> PathBuf {
    endline_tests::files_below(&library.join("ropes")).unwrap().remove(0)
}
