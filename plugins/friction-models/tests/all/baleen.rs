//! The baleen model against its ellipse of friction, its wedge and its pull-out force.

use crate::common::{Contact, Slider, dot, norm, values};
use endline_friction_models::Baleen;

const MU: f64 = 0.3;
const NORMAL: f64 = 20.0;

/// Steady friction in a direction at an angle from the plates.
fn steady(angle: f64) -> [f64; 3] {
    let model = Baleen::new();
    let attributes = values(&model, &[("across_ratio", 1.6), ("wedge_pressure", 1e6)]);
    let mut contact = Contact::on_plane(&model, NORMAL, MU);
    let (s, c) = libm::sincos(angle);
    let mut force = [0.0; 3];
    for _ in 0..200 {
        // Grain along y.
        force = contact.slide(&model, &attributes, [1e-4 * s, 1e-4 * c, 0.0]);
    }
    assert!((dot(force, [s, c, 0.0]) + norm(force)).abs() < 1e-9, "against the slip: {force:?}");
    force
}

#[test]
fn steady_slip_has_the_ellipse_of_friction() {
    let ratio = norm(steady(std::f64::consts::FRAC_PI_2)) / norm(steady(0.0));
    assert!((ratio - 1.6).abs() < 1e-9, "across over along: {ratio}");
    for angle in [0.0, 0.3, 0.8, 1.2, std::f64::consts::FRAC_PI_2, 2.5] {
        let (s, c) = libm::sincos(angle);
        let expected = MU * NORMAL / (c * c + s * s / (1.6 * 1.6)).sqrt();
        let force = norm(steady(angle));
        assert!((force / expected - 1.0).abs() < 1e-9, "{angle} rad: {force} N for {expected} N");
    }
}

/// A rope along the plates, pressed in, holds up to the pull-out force; then it slides free, and wedges again only at rest.
#[test]
fn a_wedged_rope_is_drawn_out_at_the_pull_out_force() {
    let model = Baleen::new();
    let attributes = values(
        &model,
        &[("wedge_pressure", 500.0), ("wedge_coefficient", 3.0), ("pull_out", 1000.0)],
    );
    let fresh = Contact { along: [0.0, 1.0, 0.0], ..Contact::on_plane(&model, NORMAL, MU) };
    let mut slider =
        Slider::new(&model, attributes.clone(), Contact { dt: 1e-3, ..fresh.clone() }, 500.0, 0.1);
    let (mut most, mut pulled_out_at) = (0.0_f64, None);
    for _ in 0..8_000 {
        let before = slider.contact.state[3];
        slider.step(0.01);
        most = most.max(slider.pull());
        if before > 0.5 && slider.contact.state[3] < 0.5 && pulled_out_at.is_none() {
            pulled_out_at = Some(slider.pull());
        }
    }
    // 1000 N/m on 2 cm of rope; plain friction across the plates is 9 N, the wedge by coefficient would hold 60 N.
    assert!((most - 20.0).abs() < 0.05, "held {most} N");
    assert!(pulled_out_at.is_some_and(|pull| (pull - 20.0).abs() < 0.1), "{pulled_out_at:?}");

    let mut sliding = fresh.clone();
    sliding.slide(&model, &attributes, [0.0; 3]);
    assert!(sliding.state[3] > 0.5, "wedged at rest");
    for _ in 0..50 {
        sliding.slide(&model, &attributes, [2e-3, 0.0, 0.0]);
        assert!(sliding.state[3] < 0.5, "free while it slides");
    }
    let plain = -sliding.slide(&model, &attributes, [1e-3, 0.0, 0.0])[0];
    assert!((plain - 1.5 * MU * NORMAL).abs() < 1e-9, "{plain} N");
    sliding.slide(&model, &attributes, [-1e-6, 0.0, 0.0]);
    assert!(sliding.state[3] > 0.5, "and wedges again where it stops");
}

/// At low pressure, a wedge holds by its coefficient; a rope across the plates, or at lower pressure, does not enter between them.
#[test]
fn what_wedges_and_how_hard_it_holds() {
    let model = Baleen::new();
    let attributes = values(
        &model,
        &[("wedge_pressure", 500.0), ("wedge_coefficient", 1.5), ("pull_out", 5000.0)],
    );
    let wedged = |contact: Contact| {
        let mut contact = contact;
        contact.slide(&model, &attributes, [0.0; 3]);
        contact.slip = [1e-2, 0.0, 0.0];
        norm(contact.respond(&model, &attributes).force_n)
    };
    let along = Contact { along: [0.0, 1.0, 0.0], ..Contact::on_plane(&model, NORMAL, MU) };
    assert!((wedged(along.clone()) - 1.5 * NORMAL).abs() < 1e-9);
    let plain = 1.5 * MU * NORMAL;
    assert!(
        (wedged(Contact { along: [1.0, 0.0, 0.0], ..along.clone() }) - plain).abs() < 1e-9,
        "lies across"
    );
    assert!(
        (wedged(Contact { normal_force: 9.0, ..along }) - 1.5 * MU * 9.0).abs() < 1e-9,
        "pressed too little"
    );
}
