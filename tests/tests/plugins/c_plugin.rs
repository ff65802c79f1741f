//! The smallest plugin, in C, against the committed header.

use endline_sdk::{Act, BodyPart, Controls};
use endline_session::plugins::{PluginHost, check_here};

use crate::built::{compile_c, folder};
use crate::refused::motion_input;

const GLIDE: &str = "org.example.motion.glide";

#[test]
fn the_c_template_builds_loads_and_glides_as_its_equation_says() {
    let folder = folder("c-template");
    let file = compile_c("plugins/template-c/glide.c", &folder);
    let infos = check_here(&file).unwrap();
    assert_eq!(infos[0].id, GLIDE);
    let (host, problems) = PluginHost::discover(&[folder]);
    assert!(problems.is_empty(), "{problems:?}");
    let motion = host.motion(GLIDE).unwrap();
    let attribute = &motion.descriptor().attributes[0];
    assert_eq!(
        (attribute.key.as_ref(), attribute.unit.as_ref(), attribute.default_value().number()),
        ("glide_length", "m", Some(150.0))
    );

    let forces = [0.0; BodyPart::ALL.len()];
    let mut speed_m_s = 2.0;
    for step in 1..=6000 {
        let out = motion
            .step(
                &[150.0],
                &endline_sdk::MotionInput { speed_m_s, ..motion_input(&forces) },
                &mut [],
            )
            .unwrap();
        speed_m_s = out.speed_m_s;
        let exact = 2.0 / (1.0 + 2.0 * f64::from(step) * 0.01 / 150.0);
        assert!((speed_m_s - exact).abs() < 1e-12, "{speed_m_s} {exact}");
    }
    assert_eq!(
        motion.descriptor().acts,
        [Act::new("brake", "Brake", "Raises the flippers, which halves the glide length.")]
    );
    let controls = Controls { act: 1.0, ..Controls::default() };
    let braking = endline_sdk::MotionInput { speed_m_s: 2.0, controls, ..motion_input(&forces) };
    let out = motion.step(&[150.0], &braking, &mut []).unwrap();
    assert!((out.speed_m_s - 2.0 / (1.0 + 2.0 * 0.01 / 75.0)).abs() < 1e-12, "{out:?}");
    assert!(out.posture.flipper_raise.iter().all(|raise| (raise - 0.5).abs() < 1e-12), "{out:?}");
    let backwards = endline_sdk::MotionInput { speed_m_s: -1.0, ..motion_input(&forces) };
    let error = motion.step(&[150.0], &backwards, &mut []).unwrap_err();
    assert_eq!(error.message, format!("plugin `{GLIDE}`: cannot glide backwards"));
}
