//! Gear towed: its drag by the law of drag, the weight carried, and forces by patch whose sum is the force on the whale.

use endline_sdk::MotionOutput;
use endline_sim::DVec3;

use super::{Run, hands, scenario, spec};

/// Rope and body as heavy as water trail straight behind: at speed u they drag with `rho u²/2 (Cd A + Ct pi d L)`.
#[test]
fn drag_added_is_that_of_the_gear_towed() {
    let gear = "[[body]]\nid = \"pot\"\nrole = \"weight\"\nposition = [\"0 m\", \"-18 m\", \"-16 m\"]\nradius = \"0.2 m\"\nmass = \"41 kg\"\n\
                volume = \"40 L\"\nfloat_height = \"0.4 m\"\ndrag_area = \"0.1 m2\"\nadded_mass = 0.5\n\
                [[line]]\nid = \"rope\"\nrope = \"rope\"\nfrom = \"whale:back\"\nto = \"pot\"\nlength = \"20 m\"\n";
    let speed = 1.2;
    let hooks = hands(
        Box::new(move |_| MotionOutput { speed_m_s: speed, ..MotionOutput::default() }),
        false,
    );
    let text = scenario(gear)
        .replace("segment = \"0.1 m\"", "segment = \"1 m\"")
        .replace("speed = \"0 m/s\"\nmotion", "speed = \"1.2 m/s\"\nmotion");
    let mut run = Run::of(spec(&text, &hooks));
    run.until(30.0, |_| ());
    let whale = run.summary().whale.unwrap();
    let wanted = 0.5 * 1025.0 * speed * speed * (0.1 + 0.02 * std::f64::consts::PI * 0.01 * 20.0);
    println!(
        "{:.3} N, now {:.3} N, by the law {wanted:.3} N",
        whale.drag_added_n, whale.drag_added_now_n
    );
    assert!(
        (whale.drag_added_n / wanted - 1.0).abs() < 0.01,
        "{} N for {wanted} N",
        whale.drag_added_n
    );
    assert!(
        (whale.drag_added_now_n / wanted - 1.0).abs() < 0.01,
        "{} N for {wanted} N",
        whale.drag_added_now_n
    );
    assert_eq!(whale.carried, ["pot"]);
    assert!(
        (whale.tethered_m - 20.0).abs() < 0.1 && whale.trailing_m < 1e-9,
        "a weight holds: {whale:?}"
    );
}

/// The carcass wound in gear: the forces of rope on the patches add up to the total force, as a vector, at each step.
#[test]
fn forces_on_the_patches_add_up_to_what_the_whale_feels() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/dead-whale-wraps.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let mut run = Run::of(spec(&text, &hands(Box::new(|_| MotionOutput::default()), true)));
    let (mut compared, mut greatest) = (0, 0.0_f64);
    run.until(0.6, |run| {
        let patches = run.summary().whale.unwrap().patches;
        let sum: DVec3 = patches.iter().map(|patch| patch.force_n).sum();
        let felt = run.state.whale.as_ref().unwrap().exertion.rope_force_n;
        assert!(
            (sum - felt).length() <= 1e-9 * felt.length().max(1.0),
            "{sum} N on the patches, {felt} N felt"
        );
        compared += 1;
        greatest = greatest.max(patches.iter().map(|patch| patch.normal_n).sum());
    });
    println!("{compared} steps, up to {greatest:.1} N of normal forces");
    assert!(compared > 40 && greatest > 50.0, "{compared} steps, {greatest} N");
}
