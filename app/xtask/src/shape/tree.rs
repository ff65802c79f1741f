//! The source files of a crate, found as the compiler finds them: from its root through `mod name;`.

use super::code::{Code, Place, code};

/// A file of a crate.
pub struct File {
    /// Path from the workspace's root, with `/` between folders.
    pub path: String,
    /// Names of the modules it stands in, from the crate's root; empty for the root itself.
    pub module: Vec<String>,
    /// What ships of it.
    pub code: Code,
}

/// A library or program: all files that one root leads to.
pub struct Crate {
    /// The root first, each file before the files of its modules.
    pub files: Vec<File>,
}

/// Gives the text of a file by its path from the workspace's root; `None` where there is none.
pub type Read<'a> = &'a dyn Fn(&str) -> Option<String>;

/// Library and programs of the packages in these folders.
pub fn crates(folders: &[String], read: Read) -> Vec<Crate> {
    let roots = |folder: &String| ["lib", "main"].map(|name| format!("{folder}/src/{name}.rs"));
    let all = folders.iter().flat_map(roots);
    all.filter_map(|root| {
        let mut files = Vec::new();
        collect(&root, &[], read, &mut files);
        (!files.is_empty()).then_some(Crate { files })
    })
    .collect()
}

/// Folders of the workspace's members, read from its Cargo.toml.
pub fn members(manifest: &str) -> Vec<String> {
    let list = manifest.split_once("members = [").and_then(|(_, rest)| rest.split_once(']'));
    let quoted = list.map_or("", |(list, _)| list).split('"').skip(1).step_by(2);
    quoted.map(str::to_owned).collect()
}

fn collect(path: &str, module: &[String], read: Read, files: &mut Vec<File>) {
    let Some(code) = read(path).and_then(|text| code(&text)) else { return };
    let children = declared(&code);
    files.push(File { path: path.to_owned(), module: module.to_vec(), code });
    let folder = folder_of_modules(path, module.is_empty());
    for inner in children {
        let module = [module, &inner].concat();
        let stem = format!("{folder}/{}", inner.join("/"));
        for path in [format!("{stem}.rs"), format!("{stem}/mod.rs")] {
            collect(&path, &module, read, files);
        }
    }
}

/// Where the files of a file's modules lie.
fn folder_of_modules(path: &str, is_root: bool) -> &str {
    let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
    if is_root || path.ends_with("/mod.rs") { folder } else { path.trim_end_matches(".rs") }
}

/// Modules with a file of their own, each with the modules of this file that it is declared in.
fn declared(code: &Code) -> Vec<Vec<String>> {
    let (mut found, mut place) = (Vec::new(), Place::default());
    for at in 0..code.tokens.len() {
        place.step(&code.tokens, at);
        if at >= 2 && code.tokens[at].is(";") && code.tokens[at - 2].is("mod") {
            found.push([place.modules(), vec![code.tokens[at - 1].text.clone()]].concat());
        }
    }
    found
}
