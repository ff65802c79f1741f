//! A session: random commands and edits until it is killed.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::Harness;
use endline_session::edit::Documents;
use endline_session::edit::recovery::{self, Autosave};
use endline_session::live::engine::live;
use endline_session::task::Waker;
use endline_session::workbench::Folders;
use endline_workbench::gui::app::App;
use endline_workbench::gui::command::action::{WindowAction, WindowCommand};
use endline_workbench::gui::command::declared;
use endline_workbench::gui::shared::Shared;
use endline_workbench::input::Pilot;

use super::Dice;
use super::fault::Fault;
use super::journal::digest;
use crate::common::{Reach as _, Window};

/// Environment variable with the library, which makes the test below a session.
pub const ROOT: &str = "ENDLINE_TEST_SOAK";
/// Environment variable with the seed.
pub const SEED: &str = "ENDLINE_TEST_SOAK_SEED";
/// Environment variable with the fault.
pub const FAULT: &str = "ENDLINE_TEST_SOAK_FAULT";

#[test]
fn role_of_a_session_process() {
    let Some(root) = std::env::var_os(ROOT).map(PathBuf::from) else { return };
    let variable = |name: &str| std::env::var(name).unwrap();
    let dice = Dice(variable(SEED).parse().unwrap());
    session(&root, dice, Fault::named(&variable(FAULT)));
}

/// A scenario of the library that can be opened.
pub fn scenario(root: &Path) -> PathBuf {
    let folder = root.join("scenarios");
    let usual = folder.join("reference-a-pendulum.toml");
    let others = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    if usual.is_file() { usual } else { others.into_iter().min().unwrap() }
}

fn session(root: &Path, mut dice: Dice, fault: Fault) -> ! {
    Fault::repair(root);
    let mut harness = opened(root, fault);
    let mut unsaved = BTreeSet::new();
    let mut version = None;
    loop {
        match dice.below(20) {
            0..9 => edit(&mut harness, &mut dice),
            9..18 => command(&mut harness, &mut dice),
            _ => harness.run_steps(60),
        }
        // Reports before the frame writes a recovery file, so that the journal of a killed session covers all recovery files.
        report(&harness, &mut unsaved, &mut version);
        harness.run_steps(1 + dice.below(20));
        // The clock of the window runs faster here than a disk can write.
        harness.workbench_mut().finish_storing();
        report(&harness, &mut unsaved, &mut version);
    }
}

/// Opens the window on the library and recovers what a killed session left.
fn opened(root: &Path, fault: Fault) -> Window {
    let mut documents = Documents::open(root, &scenario(root)).unwrap();
    for (file, kept) in Autosave::in_folder(root.join("data")).left_behind() {
        if kept.scenario == documents.scenario_path() {
            documents.restore(kept.texts.into_iter().collect());
        }
        recovery::forget(&file);
    }
    let waker: Waker = Arc::new(|| {});
    let host = fault.host();
    let create = move |creation: &mut eframe::CreationContext<'_>| {
        App::new(creation, Shared::new(documents, host, live(), waker, Pilot::default()))
    };
    let mut harness = Harness::builder().with_size(egui::vec2(1500.0, 940.0)).build_eframe(create);
    let results = Some(root.join("results"));
    harness.workbench_mut().write_to(Folders {
        studies: results.clone(),
        searches: results,
        unsaved: Some(root.join("data")),
        recordings: None,
    });
    harness
}

/// Changes a random figure of a random text.
fn edit(harness: &mut Window, dice: &mut Dice) {
    let documents = harness.documents();
    let paths: Vec<&String> = documents.texts().keys().collect();
    let path = paths[dice.below(paths.len())].clone();
    let fields = numbers(documents.text(&path).unwrap_or_default());
    if fields.is_empty() {
        return;
    }
    let (field, number, unit) = fields[dice.below(fields.len())].clone();
    let value = format!("{} {unit}", number * (0.5 + 0.01 * dice.below(150) as f64));
    println!("soak does edit of {path} {field}");
    harness.set(&path, &field, &value);
}

/// Fields of the first table of a text whose value is a number with a unit.
pub fn numbers(text: &str) -> Vec<(String, f64, String)> {
    let head = text.lines().take_while(|line| !line.starts_with('['));
    let of = |line: &str| {
        let (field, value) = line.split_once(" = \"").filter(|(field, _)| !field.contains(' '))?;
        let (number, unit) = value.split_once('"')?.0.split_once(' ')?;
        Some((field.to_owned(), number.replace(',', "").parse().ok()?, unit.to_owned()))
    };
    head.filter_map(of).collect()
}

/// Gives a random command as the palette would, without dialogs, which need a display, and without quitting.
fn command(harness: &mut Window, dice: &mut Dice) {
    let all: Vec<_> = declared().filter(|info| info.about().id != "window.quit").collect();
    let info = all[dice.below(all.len())];
    let mut offers = info.offers(&harness.state().shared);
    offers.retain(|offer| !matches!(offer.command, WindowCommand::Window(WindowAction::Ask(_))));
    if offers.is_empty() {
        return;
    }
    let offer = offers.swap_remove(dice.below(offers.len()));
    println!("soak does {}", offer.name);
    harness.state_mut().shared.give(offer.command);
    // A frame writes the recovery file before it performs commands.
    harness.run_steps(1);
}

/// Reports the unsaved texts, the time and the memory.
fn report(harness: &Window, unsaved: &mut BTreeSet<String>, version: &mut Option<u64>) {
    let documents = harness.documents();
    let now_s = harness.ctx.input(|input| input.time);
    let now: BTreeSet<String> = documents.unsaved().iter().cloned().collect();
    let is_new = version.replace(documents.version()) != Some(documents.version());
    if is_new || now != *unsaved {
        for path in &now {
            println!("soak unsaved {now_s:.3} {path} {}", digest(documents.text(path)));
        }
        unsaved.difference(&now).for_each(|path| println!("soak saved {now_s:.3} {path}"));
        *unsaved = now;
    }
    println!("soak at {now_s:.3} {}", most_mb().unwrap_or(0));
}

/// Peak memory of this process [MB], if the system reports it.
fn most_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? / 1024)
}
