//! A plugin that cannot be used is reported with the reason; the others are loaded.

use std::fs;
use std::path::Path;

use endline_sdk::{BodyPart, Contacts, Controls, FrictionResponse, MotionInput, Site};
use endline_session::plugins::{PluginHost, PluginProblem};

use crate::built::{compile_c, first_party_file, folder, panicking};

fn problem<'a>(problems: &'a [PluginProblem], file: &str, id: Option<&str>) -> &'a PluginProblem {
    let named = |problem: &&PluginProblem| {
        problem.file.to_string_lossy().contains(file) && problem.id.as_deref() == id
    };
    problems
        .iter()
        .find(named)
        .unwrap_or_else(|| panic!("no problem of {file} {id:?} among {problems:?}"))
}

#[test]
fn each_bad_file_is_named_with_its_reason_and_the_good_one_works() {
    let folder = folder("refused");
    for source in ["wrong_abi", "missing_entry", "truncated", "no_factory", "faulty"] {
        compile_c(&format!("tests/plugins/{source}.c"), &folder);
    }
    let suffix = std::env::consts::DLL_SUFFIX;
    fs::write(folder.join(format!("notes{suffix}")), "not a library\n").unwrap();
    fs::write(folder.join("README.txt"), "passed over\n").unwrap();
    fs::copy(first_party_file("endline_friction_models"), folder.join(format!("a{suffix}")))
        .unwrap();
    fs::copy(first_party_file("endline_friction_models"), folder.join(format!("b{suffix}")))
        .unwrap();
    let (host, problems) = PluginHost::discover(std::slice::from_ref(&folder));

    for (file, id, reason) in [
        ("wrong_abi", None, "was built for plugin ABI 4.3, but this program speaks 3.2"),
        ("missing_entry", None, "does not export `endline_plugin_entry`"),
        ("truncated", None, "its entry is truncated: 12 bytes where"),
        ("no_factory", None, "its factory `endline.plugins/3` is missing"),
        ("notes", None, "is not a library that can be opened"),
        (
            "faulty",
            Some("org.example.motion.cut"),
            "its table of functions is truncated: 4 bytes where",
        ),
        ("faulty", Some("org.example.motion.stepless"), "its table's function is missing"),
        (
            "faulty",
            Some("org.example.motion.endless"),
            "its attribute `depth`: its default inf and range 0 to 1 must be finite",
        ),
        ("b.", Some("org.endline.friction.coulomb"), "already has a plugin with this id"),
    ] {
        let problem = problem(&problems, file, id);
        assert!(problem.reason.contains(reason), "{problem}");
        let documented =
            endline_tests::documented("plugin-abi.md", &[file.trim_end_matches('.'), reason]);
        assert!(documented, "{file}: {reason}");
        assert!(!problem.help.is_empty(), "{problem}");
    }
    // Each of the four models of the second copy is named.
    assert_eq!(problems.len(), 12, "{problems:?}");
    let models = ["baleen", "coulomb", "stribeck", "tissue"]
        .map(|name| format!("org.endline.friction.{name}"));
    assert_eq!(host.ids(), [&models[..], &["org.example.motion.nan".to_owned()]].concat());
}

#[test]
fn a_folder_that_is_not_there_is_passed_over_and_one_that_is_a_file_is_named() {
    let folder = folder("folders");
    let file = folder.join("file");
    fs::write(&file, "").unwrap();
    let (host, problems) = PluginHost::discover(&[folder.join("none"), file]);
    assert!(host.list().is_empty());
    assert_eq!(problems.len(), 1);
    assert!(problems[0].reason.contains("cannot be searched"), "{}", problems[0]);
}

fn load(file: &Path, test: &str) -> PluginHost {
    let folder = folder(test);
    fs::copy(file, folder.join(file.file_name().unwrap())).unwrap();
    let (host, problems) = PluginHost::discover(&[folder]);
    assert!(problems.is_empty(), "{problems:?}");
    host
}

pub fn motion_input(forces: &[f64; BodyPart::ALL.len()]) -> MotionInput<'_> {
    MotionInput {
        time_s: 0.0,
        dt_s: 0.01,
        length_m: 13.0,
        speed_m_s: 1.0,
        position_m: [0.0; 3],
        orientation: [0.0, 0.0, 0.0, 1.0],
        controls: Controls::default(),
        contact_force_n: forces,
        contact_port_m: forces,
        thrust_speed_m_s: None,
    }
}

pub const ONE_CONTACT: Contacts<'_> = Contacts {
    dt_s: 0.002,
    normal_force_n: &[100.0],
    normal: &[[0.0, 0.0, 1.0]],
    grain: &[[0.0, 1.0, 0.0]],
    along: &[[1.0, 0.0, 0.0]],
    slip_m: &[[0.01, 0.0, 0.0]],
    length_m: &[0.02],
    coefficient: &[0.3],
    region: &[4],
    rope: &[0],
    state: &[],
};

#[test]
fn a_plugin_that_panics_ends_the_call_with_its_name_and_message() {
    let host = load(panicking(), "panicking");
    let forces = [0.0; BodyPart::ALL.len()];
    let motion = host.motion("org.example.motion.panicking").unwrap();
    let friction = host.friction("org.example.friction.panicking").unwrap();
    let gear = host.gear("org.example.gear.panicking").unwrap();
    for _ in 0..3 {
        let errors = [
            motion.step(&[], &motion_input(&forces), &mut []).unwrap_err(),
            friction.respond(&[], &ONE_CONTACT, &mut [FrictionResponse::default()]).unwrap_err(),
            friction.advance(&[], &ONE_CONTACT, &mut []).unwrap_err(),
            gear.build(&[], &Site { depth_m: 20.0, current_m_s: [0.0; 2] }).unwrap_err(),
        ];
        for (error, kind) in errors.iter().zip(["motion", "friction", "friction", "gear"]) {
            let expected = format!(
                "plugin `org.example.{kind}.panicking`: it failed inside (panicked): the whale bit me"
            );
            assert_eq!(error.message, expected);
        }
    }
}

#[test]
fn a_plugin_in_c_that_gives_nan_ends_the_call_with_its_name() {
    let folder = folder("nan");
    compile_c("tests/plugins/faulty.c", &folder);
    let (host, _) = PluginHost::discover(&[folder]);
    let motion = host.motion("org.example.motion.nan").unwrap();
    let error = motion.step(&[], &motion_input(&[0.0; BodyPart::ALL.len()]), &mut []).unwrap_err();
    assert_eq!(error.message, "plugin `org.example.motion.nan`: it gave NaN for the speed");
}
