//! A library is opened when its user allows it, asked about again when it changes, and taken in anew while the program runs.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};

use endline_sdk::{BodyPart, WhaleMotion};
use endline_session::plugins::{Change, Choices, Loader, PluginHost, PluginProblem, Standing};
use endline_tests::root;

use crate::built::{compile_c, folder};
use crate::refused::motion_input;

const ID: &str = "org.example.motion.speed";

/// The plugin `speed.c`, built with a speed into the same file each time.
fn build(folder: &Path, speed: &str) -> PathBuf {
    let text = fs::read_to_string(root().join("tests/plugins/speed.c")).unwrap();
    let source = folder.join("speed.c");
    fs::write(&source, text.replace("SPEED_M_S 1.0", &format!("SPEED_M_S {speed}"))).unwrap();
    compile_c(source.to_str().unwrap(), folder)
}

fn speed(motion: &dyn WhaleMotion) -> f64 {
    motion.step(&[], &motion_input(&[0.0; BodyPart::ALL.len()]), &mut []).unwrap().speed_m_s
}

/// The hash that is waited for, and why.
fn asked(loaded: &(PluginHost, Vec<PluginProblem>)) -> (String, Change) {
    let [problem] = loaded.1.as_slice() else { panic!("{:?}", loaded.1) };
    let Standing::Waiting(ask) = &problem.standing else { panic!("{problem:?}") };
    assert!(problem.help.contains("endline plugins allow"), "{problem}");
    (ask.hash.clone(), ask.change)
}

#[test]
fn a_library_built_anew_is_asked_about_and_taken_in_beside_the_old() {
    let folder = folder("reload");
    let checks = Cell::new(0);
    let checker = |_: &Path, _: &str| {
        checks.set(checks.get() + 1);
        Ok(())
    };
    let choices = Choices::kept_in(Some(folder.join("data/plugins-chosen")), &[]);
    let mut loader = Loader::new(std::slice::from_ref(&folder), choices);
    let file = build(&folder, "1.0");
    let (first, change) = asked(&loader.load(&checker));
    assert_eq!(
        (change, checks.get()),
        (Change::New, 0),
        "what is not allowed is not even opened in a child"
    );
    loader.choices.allow(&file, &first).unwrap();
    let (host, problems) = loader.load(&checker);
    assert!(problems.is_empty(), "{problems:?}");
    let old = host.motion(ID).unwrap();
    assert!((speed(&*old) - 1.0).abs() < 1e-15);
    assert_eq!(
        (host.list()[0].hash.as_ref(), host.list()[0].about.as_str()),
        (Some(&first), "Made for a test.")
    );
    let _ = loader.load(&checker);
    assert_eq!(checks.get(), 1, "what has not changed is not opened twice");

    build(&folder, "2.5");
    let (second, change) = asked(&loader.load(&checker));
    assert!(change == Change::Changed && second != first);
    loader.choices.allow(&file, &second).unwrap();
    let new = loader.load(&checker).0.motion(ID).unwrap();
    assert!((speed(&*new) - 2.5).abs() < 1e-15, "the new library");
    assert!((speed(&*old) - 1.0).abs() < 1e-15, "a run under way keeps the old");
}

#[test]
fn a_plugin_switched_off_is_left_out_and_still_known() {
    let folder = folder("switched-off");
    build(&folder, "1.0");
    let mut loader = Loader::new(std::slice::from_ref(&folder), Choices::everything());
    loader.choices.switch(ID, false).unwrap();
    let (host, problems) = loader.load(&|_: &Path, _: &str| Ok(()));
    assert!(problems.is_empty() && host.motion(ID).is_none());
    assert_eq!(host.switched_off()[0].id, ID);
    loader.choices.switch(ID, true).unwrap();
    assert!(loader.load(&|_: &Path, _: &str| Ok(())).0.motion(ID).is_some());
}
