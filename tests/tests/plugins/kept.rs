//! The promise of the frozen ABI: libraries built for 3.0 and for a later 3.x continue to work.
//!
//! `tests/plugins/kept` holds the header and a plugin as they were at 3.0; the header beside the sources is the one they are compiled with.

use endline_sdk::{
    BodyPart, MotionInput,
    abi::table::{ABI_MAJOR, ABI_MINOR},
};
use endline_session::plugins::{PluginHost, try_here};

use crate::built::{compile_c, folder};
use crate::refused::motion_input;

#[test]
fn plugins_of_3_0_and_of_a_later_minor_version_work() {
    assert_eq!(ABI_MAJOR, 3, "frozen");
    const { assert!(ABI_MINOR >= 1, "the program is of a later version than the plugin kept") };
    let folder = folder("kept");
    for source in ["glide_3_0", "later"] {
        let file = compile_c(&format!("tests/plugins/kept/{source}.c"), &folder);
        for finding in &try_here(&file, &|_, _| ()).unwrap()[0].findings {
            assert!(finding.outcome.is_ok(), "{source}: {finding:?}");
        }
    }
    let (host, problems) = PluginHost::discover(&[folder]);
    assert!(problems.is_empty(), "{problems:?}");
    assert!(
        host.list().iter().all(|info| info.about.is_empty()),
        "3.1 brought what a library says of itself, and these are of 3.0"
    );
    let forces = [0.0; BodyPart::ALL.len()];
    let input = MotionInput { speed_m_s: 2.0, ..motion_input(&forces) };
    let speed = |id: &str, attributes: &[f64]| {
        host.motion(id).unwrap().step(attributes, &input, &mut []).unwrap().speed_m_s
    };
    assert!((speed("org.example.motion.later", &[]) - 1.0).abs() < 1e-15);
    assert!(
        (speed("org.example.motion.glide", &[100.0]) - 2.0 / (1.0 + 2.0 * input.dt_s / 100.0))
            .abs()
            < 1e-15
    );
}
