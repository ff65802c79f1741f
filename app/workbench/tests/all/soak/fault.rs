//! Faults injected while a session runs.

use std::fs;
use std::fs::Permissions;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use endline_sdk::{Descriptor, HookError, MotionInput, MotionOutput, WhaleMotion};
use endline_session::PluginHost;
use endline_session::plugins::Hook;

use super::Dice;
use super::session::numbers;

/// Environment variable with the file that contains the error of the clock [s].
const CLOCK: &str = "ENDLINE_TEST_CLOCK";

/// Whether libraries can be preloaded and root can drop a capability; elsewhere these faults are weaker.
const LINUX: bool = cfg!(target_os = "linux");

/// A fault of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No fault except that it is killed.
    Killed,
    /// No file may exceed 8 kB, like a disk that is almost full.
    FullDisk,
    /// The folder of recovery files is replaced by a file.
    NoDataFolder,
    /// Another program writes files of the library.
    OthersWrite,
    /// The motion plugin fails, hangs for a second and returns NaN, in turn.
    BadPlugin,
    /// The folders of the library are read-only.
    ReadOnly,
    /// The system clock jumps by a second or by a century, forwards and backwards.
    ClockJumps,
}

impl Fault {
    /// All faults.
    pub const ALL: [Self; 7] = [
        Self::Killed,
        Self::FullDisk,
        Self::NoDataFolder,
        Self::OthersWrite,
        Self::BadPlugin,
        Self::ReadOnly,
        Self::ClockJumps,
    ];

    /// Its name, to pass it to another process.
    pub fn name(self) -> String {
        format!("{self:?}")
    }

    /// Finds a fault by its name.
    pub fn named(name: &str) -> Self {
        Self::ALL.into_iter().find(|fault| fault.name() == name).unwrap_or(Self::Killed)
    }

    /// Whether recovery files can be written under this fault.
    pub fn allows_recovery_files(self) -> bool {
        !matches!(self, Self::FullDisk | Self::NoDataFolder)
    }

    /// Command that starts a session with this fault on a library.
    pub fn command(self, program: &Path, root: &Path) -> Command {
        let mut command = Command::new(program);
        match self {
            Self::FullDisk => {
                // A write beyond the limit returns an error instead of a signal.
                command = Command::new("sh");
                command.args(["-c", "trap '' XFSZ; ulimit -f 16; exec \"$0\" \"$@\""]).arg(program);
            }
            Self::ReadOnly => {
                set_writable(root, false);
                // Permissions apply to root only after it has dropped this capability.
                if LINUX && fs::metadata(root).unwrap().uid() == 0 {
                    command = Command::new("setpriv");
                    command
                        .args(["--inh-caps=-dac_override", "--bounding-set=-dac_override"])
                        .arg(program);
                }
            }
            Self::ClockJumps if LINUX => {
                command.env("LD_PRELOAD", jumping_clock(root)).env(CLOCK, root.join("clock"));
            }
            _ => {}
        }
        command
    }

    /// Injects the fault from outside; called ten times a second.
    pub fn strike(self, root: &Path, dice: &mut Dice) {
        match self {
            Self::NoDataFolder => {
                let data = root.join("data");
                // A session that writes there may create it again before the next call.
                if data.is_dir() && fs::remove_dir_all(&data).is_ok() {
                    let _ = fs::write(&data, "no folder");
                }
            }
            Self::OthersWrite if dice.below(5) == 0 => write_as_another(root, dice),
            Self::ClockJumps if dice.below(5) == 0 => {
                let by_s = [1, 60, 3600, 86_400, 31_557_600, 3_155_760_000_i64];
                let by_s = by_s[dice.below(by_s.len())] * [-1, 1][dice.below(2)];
                fs::write(root.join("clock"), by_s.to_string()).unwrap();
            }
            _ => {}
        }
    }

    /// Repairs what would prevent the next session from starting.
    pub fn repair(root: &Path) {
        let data = root.join("data");
        if data.is_file() {
            fs::remove_file(data).unwrap();
        }
    }

    /// Repairs what would prevent the check after a session.
    pub fn end(self, root: &Path) {
        if self == Self::ReadOnly {
            set_writable(root, true);
        }
    }

    /// Plugins of a session.
    pub fn host(self) -> Arc<PluginHost> {
        if self != Self::BadPlugin {
            return crate::common::linked();
        }
        let mut host = PluginHost::empty();
        let swim = endline_workbench::embedded::first_party().into_iter();
        for hook in swim {
            host.add(match hook {
                Hook::Motion(sound) => {
                    Hook::Motion(Arc::new(Bad { sound, calls: AtomicU32::new(0) }))
                }
                sound => sound,
            })
            .unwrap();
        }
        Arc::new(host)
    }
}

/// Folders of the library, without those for recovery files and results.
fn folders(root: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let ours = ["data", "home", "results"];
    entries.filter(move |path| path.is_dir() && !ours.iter().any(|name| path.ends_with(name)))
}

/// Makes folders of the library and their files writable or read-only.
fn set_writable(root: &Path, is_writable: bool) {
    let (folder, file) = if is_writable { (0o755, 0o644) } else { (0o555, 0o444) };
    for path in folders(root) {
        fs::set_permissions(&path, Permissions::from_mode(folder)).unwrap();
        for entry in fs::read_dir(&path).unwrap().flatten().filter(|entry| entry.path().is_file()) {
            fs::set_permissions(entry.path(), Permissions::from_mode(file)).unwrap();
        }
    }
}

/// Builds the library that shifts the system clock, from `clock.c`.
fn jumping_clock(root: &Path) -> PathBuf {
    let library = root.join("clock.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/soak/clock.c");
    let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    let built = Command::new(compiler)
        .args(["-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(source)
        .status()
        .unwrap();
    assert!(built.success());
    library
}

/// Changes a figure of a file as another program would, by replacing the file.
fn write_as_another(root: &Path, dice: &mut Dice) {
    let files: Vec<_> =
        fs::read_dir(root.join("ropes")).unwrap().map(|entry| entry.unwrap().path()).collect();
    let file = &files[dice.below(files.len())];
    let Ok(text) = fs::read_to_string(file) else { return };
    let fields = numbers(&text);
    if fields.is_empty() {
        return;
    }
    let (field, number, unit) = &fields[dice.below(fields.len())];
    let line = text.lines().find(|line| line.starts_with(&format!("{field} ="))).unwrap();
    let changed = format!("{field} = \"{} {unit}\"", number * 1.01);
    let beside = file.with_extension("theirs");
    fs::write(&beside, text.replacen(line, &changed, 1)).unwrap();
    fs::rename(beside, file).unwrap();
}

/// A motion that works for some steps and then fails.
struct Bad {
    sound: Arc<dyn WhaleMotion>,
    calls: AtomicU32,
}

impl WhaleMotion for Bad {
    fn descriptor(&self) -> &Descriptor {
        self.sound.descriptor()
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        let mut output = self.sound.step(attributes, input, state)?;
        match call % 400 {
            100 => Err(HookError::new("injected failure")),
            200 => {
                std::thread::sleep(Duration::from_secs(1));
                Ok(output)
            }
            300 => {
                output.speed_m_s = f64::NAN;
                Ok(output)
            }
            _ => Ok(output),
        }
    }
}
