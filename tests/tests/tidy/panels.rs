//! Panels of the window read the workbench by its views, and change it by commands only.

use crate::{none, sources};

/// The only method of the workbench that changes it and that a panel may call.
const PERFORM: &str = "perform";

#[test]
fn panels_change_the_workbench_by_commands_only() {
    let files = sources(&[".rs"]);
    let of = |folder: &'static str| files.iter().filter(move |file| file.path.starts_with(folder));
    let changing: Vec<String> = of("app/session/src/workbench/")
        .flat_map(|file| changing_methods(&file.text))
        .filter(|name| name != PERFORM)
        .collect();
    for known in ["refresh", "check", "say", "write_to"] {
        assert!(changing.iter().any(|name| name == known), "{known}: {changing:?}");
    }
    let complaints = of("app/workbench/src/gui/panels/").flat_map(|file| {
        let text: String = file.text.chars().filter(|letter| !letter.is_whitespace()).collect();
        let calls = changing.iter().map(|name| format!("workbench.{name}("));
        let borrows = ["&mutshared.workbench", "&mutself.shared.workbench", "&mutWorkbench"];
        let wrong = calls.chain(borrows.map(str::to_owned));
        let found = wrong.filter(|wrong| text.contains(wrong));
        found.map(|wrong| format!("{}: {wrong}", file.path)).collect::<Vec<_>>()
    });
    none(&complaints.collect::<Vec<_>>(), "a panel changes the workbench without a command");
}

/// Names of the public methods that take `&mut self`.
fn changing_methods(text: &str) -> Vec<String> {
    let text: String = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    let methods = text.split("pubfn").skip(1).filter_map(|method| {
        let (name, rest) = method.split_once('(')?;
        rest.starts_with("&mutself").then(|| name.to_owned())
    });
    methods.collect()
}
