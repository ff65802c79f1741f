//! The packages for users who do not build Endline: a portable archive and a Debian package of the same tree.
//!
//! ```text
//! bin/endline        share/man, share/doc        share/applications, share/icons        completions of shells
//! ```
//! The program contains the gear library and the first-party plugins, so that it needs no other files.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;
use crate::system_packages::on_path;
use crate::workspace::{Profile, Workspace, announce};

/// Shells, and the path of each one's completions.
const SHELLS: [(&str, &str); 3] = [
    ("bash", "share/bash-completion/completions/endline"),
    ("zsh", "share/zsh/vendor-completions/_endline"),
    ("fish", "share/fish/vendor_completions.d/endline.fish"),
];

/// Files of the workspace, and their paths in the tree.
const FILES: [(&str, &str); 7] = [
    ("README.md", "share/doc/endline/README.md"),
    ("CHANGELOG.md", "share/doc/endline/CHANGELOG.md"),
    ("LICENSE-MIT", "share/doc/endline/LICENSE-MIT"),
    ("LICENSE-APACHE", "share/doc/endline/LICENSE-APACHE"),
    ("assets/desktop/endline.desktop", "share/applications/endline.desktop"),
    ("assets/icon/endline.svg", "share/icons/hicolor/scalable/apps/endline.svg"),
    ("assets/icon/endline.png", "share/icons/hicolor/256x256/apps/endline.png"),
];

/// Packages for the window and for films; the command line needs none of them.
const RECOMMENDS: &str = "libegl1, libgl1, libgl1-mesa-dri, libx11-6, libx11-xcb1, libxcursor1, libxi6, libxkbcommon-x11-0";

/// Builds both in `<target>/package`.
/// Errors: when the program cannot be built, or a tool is missing.
pub fn package(workspace: &Workspace) -> Outcome {
    workspace.cargo(&["build", "--release", "--package", "endline"])?;
    let out = workspace.target.join("package");
    // An earlier call may have written files of another version.
    let _ = fs::remove_dir_all(&out);
    let name = format!("endline-{}-{}-{}", version(), std::env::consts::ARCH, std::env::consts::OS);
    let tree = out.join(&name);
    fill(workspace, &tree)?;
    let stamp = stamp(workspace);
    write_materials(workspace, &tree.join("share/doc/endline/endline.cdx.json"), &stamp)?;
    let archive = archive(&out, &name, &stamp)?;
    let debian = debian(&out, &tree, &stamp)?;
    for file in [archive, debian] {
        let bytes = fs::metadata(&file).map_or(0, |file| file.len());
        eprintln!("{} ({:.1} MB)", file.display(), bytes as f64 / 1e6);
    }
    Ok(())
}

/// Writes the tree.
fn fill(workspace: &Workspace, tree: &Path) -> Outcome {
    let program = tree.join("bin/endline");
    folder(tree.join("bin"))?;
    call(
        "strip",
        &["--strip-unneeded", "-o", &text(&program), &text(&workspace.program(Profile::Release))],
        &[],
    )?;
    for (from, to) in FILES {
        copy(&workspace.root.join(from), &tree.join(to))?;
    }
    for entry in entries(&workspace.root.join("docs"))? {
        if entry.extension().is_some_and(|ending| ending == "md") {
            copy(
                &entry,
                &tree.join("share/doc/endline/docs").join(entry.file_name().unwrap_or_default()),
            )?;
        }
    }
    for (shell, to) in SHELLS {
        let script = output_of(&program, &["completions", shell])?;
        write(&tree.join(to), &script)?;
    }
    let pages = tree.join("share/man/man1");
    call(&text(&program), &["man", "--out", &text(&pages)], &[])?;
    for page in entries(&pages)? {
        call("gzip", &["-9n", &text(&page)], &[])?;
    }
    Ok(())
}

/// Builds the portable archive; unpacked in any folder, `bin/endline` runs.
fn archive(out: &Path, name: &str, stamp: &str) -> Outcome<PathBuf> {
    let file = out.join(format!("{name}.tar.gz"));
    let time = format!("--mtime=@{stamp}");
    let owner = ["--sort=name", "--owner=0", "--group=0", "--numeric-owner", &time];
    let (into, from) = (text(&file), text(out));
    call("tar", &[owner.as_slice(), &["-C", &from, "-czf", &into, name]].concat(), &[])?;
    Ok(file)
}

/// Builds the Debian package: the tree under `/usr`.
fn debian(out: &Path, tree: &Path, stamp: &str) -> Outcome<PathBuf> {
    let root = out.join("debian");
    folder(root.join("DEBIAN"))?;
    let usr = root.join("usr");
    call("cp", &["-a", &text(tree), &text(&usr)], &[])?;
    let doc = usr.join("share/doc/endline");
    fs::rename(doc.join("LICENSE-MIT"), doc.join("copyright"))
        .map_err(|error| format!("{}: {error}", doc.display()))?;
    let machine = match std::env::consts::ARCH {
        "x86_64" => "amd64",
        "aarch64" => "arm64",
        other => other,
    };
    let version = version();
    let libc = newest_libc(&usr.join("bin/endline"))?;
    let control = format!(
        "Package: endline\nVersion: {version}\nArchitecture: {machine}\nSection: science\nPriority: optional\n\
         Maintainer: The Endline developers <https://github.com/endline/endline>\n\
         Depends: libc6 (>= {libc}), libgcc-s1, libudev1\nRecommends: {RECOMMENDS}\nSuggests: ffmpeg\n\
         Homepage: https://github.com/endline/endline\n\
         Description: design fishing gear that entangled whales can escape from\n \
         A workbench in which traps, ropes, buoys and weak links are designed and\n \
         whales are swum into them; its command line runs encounters, studies and\n \
         searches without a display.\n"
    );
    write(&root.join("DEBIAN/control"), &control)?;
    let file = out.join(format!("endline_{version}_{machine}.deb"));
    let build = ["--root-owner-group", "--build", &text(&root), &text(&file)];
    call("dpkg-deb", &build, &[("SOURCE_DATE_EPOCH", stamp)])?;
    Ok(file)
}

/// Returns the newest version of the C library of which the program uses symbols.
fn newest_libc(program: &Path) -> Outcome<String> {
    let symbols = output_of(Path::new("objdump"), &["-T", &text(program)])?;
    newest(&symbols).ok_or_else(|| format!("{} uses no symbol of libc", program.display()))
}

/// Returns the newest version `GLIBC_x.y` in a list of symbols.
fn newest(symbols: &str) -> Option<String> {
    let is_number = |letter: char| letter.is_ascii_digit() || letter == '.';
    let versions = symbols.split("GLIBC_").skip(1).filter_map(|rest| {
        let version: String = rest.chars().take_while(|letter| is_number(*letter)).collect();
        let numbers: Vec<u32> = version.split('.').map_while(|part| part.parse().ok()).collect();
        (!numbers.is_empty()).then_some((numbers, version))
    });
    versions.max().map(|(_, version)| version)
}

/// Returns the version of the workspace, which is that of this crate.
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Returns the time of the last commit, so that equal sources give equal bytes; 0 without a history.
fn stamp(workspace: &Workspace) -> String {
    let log = Command::new("git")
        .args(["log", "-1", "--format=%ct"])
        .current_dir(&workspace.root)
        .output();
    let time = log.ok().and_then(|log| String::from_utf8(log.stdout).ok());
    time.map(|time| time.trim().to_owned())
        .filter(|time| !time.is_empty())
        .unwrap_or_else(|| "0".to_owned())
}

fn text(path: &Path) -> String {
    path.display().to_string()
}

fn folder(path: PathBuf) -> Outcome {
    fs::create_dir_all(&path)
        .map_err(|error| format!("{}: cannot be made: {error}", path.display()))
}

fn copy(from: &Path, to: &Path) -> Outcome {
    folder(to.parent().unwrap_or(to).to_path_buf())?;
    fs::copy(from, to)
        .map(drop)
        .map_err(|error| format!("{}: cannot be copied: {error}", from.display()))
}

fn write(file: &Path, words: &str) -> Outcome {
    folder(file.parent().unwrap_or(file).to_path_buf())?;
    fs::write(file, words)
        .map_err(|error| format!("{}: cannot be written: {error}", file.display()))
}

fn entries(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

fn call(program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    announce(program, arguments);
    let status = Command::new(program).args(arguments).envs(variables.iter().copied()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("{program} failed, see above")),
        Err(error) => Err(format!(
            "{program} cannot be started: {error}; packages are made on Debian, with binutils"
        )),
    }
}

/// Returns the output of a program.
fn output_of(program: &Path, arguments: &[&str]) -> Outcome<String> {
    let output = Command::new(program)
        .args(arguments)
        .output()
        .map_err(|error| format!("{} cannot be started: {error}", program.display()))?;
    if !output.status.success() {
        return Err(format!("{} {} failed", program.display(), arguments.join(" ")));
    }
    String::from_utf8(output.stdout).map_err(|error| format!("{}: {error}", program.display()))
}

/// Writes the bill of materials in the format CycloneDX by cargo-cyclonedx: every library in the program with its version, licence and
/// source. If the tool is missing, prints a message and writes nothing. `stamp` is the time of the last
/// commit.
/// Errors: when the tool fails, or a file cannot be written.
fn write_materials(workspace: &Workspace, file: &Path, stamp: &str) -> Outcome {
    if !on_path("cargo-cyclonedx") {
        eprintln!(
            "skipped: the bill of materials needs cargo-cyclonedx: cargo install cargo-cyclonedx --locked"
        );
        return Ok(());
    }
    let form = ["--format", "json", "--spec-version", "1.5", "--no-build-deps"];
    let of = ["cyclonedx", "--manifest-path", "app/workbench/Cargo.toml"];
    let outcome =
        workspace.cargo_with(&[of.as_slice(), &form].concat(), &[("SOURCE_DATE_EPOCH", stamp)]);
    let own = workspace.root.join("app/workbench/endline.cdx.json");
    let bill = fs::read_to_string(&own).map_err(|error| format!("{}: {error}", own.display()));
    // The tool writes one bill beside each package of the workspace.
    bills(workspace).iter().for_each(|file| drop(fs::remove_file(file)));
    outcome?;
    // The bill must not name folders of this machine.
    let bill = bill?.replace(&workspace.root.display().to_string(), "");
    fs::write(file, bill).map_err(|error| format!("{}: cannot be written: {error}", file.display()))
}

/// Returns the bills beside the packages of the workspace.
fn bills(workspace: &Workspace) -> Vec<PathBuf> {
    let inside = |folder: &Path| -> Vec<PathBuf> {
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
    };
    let root = &workspace.root;
    let mut packages = vec![root.join("gear-library"), root.join("tests")];
    packages.extend(["app", "plugins"].iter().flat_map(|folder| inside(&root.join(folder))));
    let files = packages.iter().flat_map(|folder| inside(folder));
    files.filter(|file| file.to_string_lossy().ends_with(".cdx.json")).collect()
}

#[cfg(test)]
mod tests {
    use super::newest;

    #[test]
    fn versions_are_compared_as_numbers() {
        let symbols = "puts (GLIBC_2.2.5)\nfoo (GLIBC_2.34) x\nbar GLIBC_2.9\nbaz (GLIBC_PRIVATE)";
        assert_eq!(newest(symbols).as_deref(), Some("2.34"));
        assert_eq!(newest("none (GCC_3.0)"), None);
    }
}
