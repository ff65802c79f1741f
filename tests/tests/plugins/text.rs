//! Plugins without code: a folder of text is found, checked and used like a library.

use std::fs;
use std::path::Path;

use endline_gear::{Library, Options, Scenario, Sources, assemble};
use endline_sdk::{Attribute, RigEnd, Site};
use endline_session::plugins::{
    Language, PluginHost, PluginKind, Project, try_here, write_project,
};

use crate::built::folder;
use crate::linked::root;
use crate::same_bits::loaded;

const GEAR: &str = "org.example.gear.my-gear";

fn written(place: &Path, kind: PluginKind, name: &str) -> Project {
    write_project(&place.join(name), kind, Language::Text, None).unwrap()
}

fn discovered(place: &Path) -> PluginHost {
    let (host, problems) = PluginHost::discover(&[place.to_path_buf()]);
    assert!(problems.is_empty(), "{problems:?}");
    host
}

#[test]
fn a_gear_type_as_text_passes_the_check_and_builds_what_its_expressions_say() {
    let place = folder("text-gear");
    let project = written(&place, PluginKind::Gear, "my-gear");
    assert!(project.build.is_empty(), "nothing to build");
    let tried = try_here(&project.library, &|_, _| ()).unwrap();
    for finding in &tried[0].findings {
        assert!(finding.outcome.is_ok(), "{finding:?}");
    }
    assert!(tried[0].findings.len() >= 6, "{:?}", tried[0].findings);

    let host = discovered(&place);
    let gear = host.gear(GEAR).unwrap();
    let values: Vec<_> =
        gear.descriptor().attributes.iter().map(Attribute::default_value).collect();
    let rig = gear.build(&values, &Site { depth_m: 20.0, current_m_s: [0.0; 2] }).unwrap();
    let spacing_m = 20.0 * 1.8288;
    let ids: Vec<&str> = rig.bodies.iter().map(|body| body.id.as_str()).collect();
    assert_eq!(ids, ["trap-1", "trap-2", "trap-3", "buoy"]);
    assert!(
        (rig.bodies[2].position_m[0] - 2.0 * 0.98 * spacing_m).abs() < 1e-9,
        "{:?}",
        rig.bodies[2]
    );
    assert!(
        (rig.bodies[2].position_m[2] + 20.0).abs() < 1e-12
            && rig.bodies[3].position_m[2].abs() < 1e-12
    );
    let lengths: Vec<f64> = rig.lines.iter().map(|line| line.length_m).collect();
    for (length, expected) in lengths.iter().zip([spacing_m, spacing_m, 28.0]) {
        assert!((length - expected).abs() < 1e-9, "{lengths:?}");
    }
    assert_eq!(rig.lines[1].from, RigEnd::Body("trap-2".to_owned()));
    assert!(rig.links.is_empty(), "no weak link is chosen");
}

#[test]
fn a_change_of_the_text_changes_its_hash() {
    let place = folder("text-hash");
    let project = written(&place, PluginKind::Gear, "my-gear");
    let hash = || discovered(&place).list()[0].hash.clone().unwrap();
    let before = hash();
    let file = project.library.join("gear-types/simple.toml");
    fs::write(&file, fs::read_to_string(&file).unwrap().replace("default = 1.4", "default = 1.5"))
        .unwrap();
    assert_ne!(hash(), before);
}

#[test]
fn a_mistake_in_a_text_is_reported_with_its_place() {
    let place = folder("text-wrong");
    let project = written(&place, PluginKind::Gear, "my-gear");
    let file = project.library.join("gear-types/simple.toml");
    let good = fs::read_to_string(&file).unwrap();
    for (old, new, part) in [
        (
            "length = \"scope * depth\"",
            "length = \"scope\"",
            "this is a pure number; expected a length",
        ),
        ("length = \"scope * depth\"", "length = \"scop * depth\"", "unknown name `scop`"),
        ("rope = \"{rope}\"", "rope = \"{rop}\"", "unknown name `rop`"),
        ("key = \"spacing\"", "key = \"depth\"", "`depth` cannot be the key of an attribute"),
        ("default = 3\n", "default = 90\n", "the default is outside the range"),
        ("items = \"ropes\"", "items = \"roops\"", "`roops` is not a folder of items for gear"),
        ("height = 1\n", "hight = 1\n", "unknown field `hight`"),
    ] {
        let bad = good.replacen(old, new, 1);
        assert_ne!(bad, good, "{old}");
        fs::write(&file, &bad).unwrap();
        let problem = try_here(&project.library, &|_, _| ()).unwrap_err();
        let line = 1 + bad.lines().position(|line| line.contains(new.trim_end())).unwrap();
        assert!(
            problem.contains(part) && problem.contains(&format!("gear-types/simple.toml:{line}:")),
            "{new}: {problem}"
        );
        let (host, problems) = PluginHost::discover(std::slice::from_ref(&place));
        assert!(
            host.list().is_empty() && problems.len() == 1,
            "omitted, and the program continues"
        );
    }
    // A row that the attributes make endless ends with a message.
    fs::write(&file, good.replace("repeat = \"traps - 1\"", "repeat = \"1 / (traps - traps)\""))
        .unwrap();
    let gear = discovered(&place).gear(GEAR).unwrap();
    let values: Vec<_> =
        gear.descriptor().attributes.iter().map(Attribute::default_value).collect();
    let error = gear.build(&values, &Site { depth_m: 20.0, current_m_s: [0.0; 2] }).unwrap_err();
    assert!(error.message.contains("`repeat` of `groundline-1` is inf"), "{error}");
}

#[test]
fn motion_clips_of_a_folder_are_acts_of_every_whale() {
    let place = folder("text-clips");
    let project = written(&place, PluginKind::Motion, "my-clips");
    assert!(
        try_here(&project.library, &|_, _| ()).unwrap()[0]
            .info
            .acts
            .iter()
            .any(|act| act.id == "bend")
    );
    let host = discovered(&place);
    assert_eq!((host.list()[0].kind, host.ids().len()), (PluginKind::Clips, 0));

    let sources = host.with_clips(Sources::from_folder(&root()).unwrap());
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{problems:?}");
    let text = fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    let scenario =
        Scenario::read("test.toml", &text.replace("motion =", "acts = [\"bend\"]\nmotion ="))
            .unwrap();
    let spec = assemble(
        &scenario,
        &library,
        &loaded(),
        &Options { rope_nodes: Some(80), ..Options::default() },
    )
    .unwrap();
    let acts: Vec<_> =
        spec.whale.unwrap().motion.descriptor().acts.iter().map(|act| act.id.to_string()).collect();
    assert_eq!(acts, ["bend"]);
}

#[test]
fn friction_without_code_is_refused() {
    let refused = write_project(
        &folder("text-friction").join("mine"),
        PluginKind::Friction,
        Language::Text,
        None,
    )
    .unwrap_err();
    assert!(refused.contains("needs code"), "{refused}");
}
