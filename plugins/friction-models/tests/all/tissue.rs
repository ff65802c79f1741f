//! The tissue model against its elastic range, its thresholds and the spring-slider's closed form.

use crate::common::{Contact, Slider, norm, values};
use endline_friction_models::Tissue;

const STIFFNESS: f64 = 3e4;
const LENGTH: f64 = 0.02;
const DRAW: f64 = 0.05;

#[test]
fn skin_goes_with_the_rope_and_comes_back() {
    let model = Tissue::new();
    let attributes = values(&model, &[]);
    let mut contact = Contact::on_plane(&model, 1000.0, 0.2);
    let mut force = [0.0; 3];
    for _ in 0..40 {
        force = contact.slide(&model, &attributes, [6e-4, 8e-4, 0.0]);
    }
    // 4 cm of displacement, within the elastic range, along its direction.
    let expected = STIFFNESS * LENGTH * 0.04;
    assert!(
        (norm(force) / expected - 1.0).abs() < 1e-12 && (force[0] / force[1] - 0.75).abs() < 1e-12,
        "{force:?}"
    );
    for _ in 0..40 {
        force = contact.slide(&model, &attributes, [-6e-4, -8e-4, 0.0]);
    }
    assert!(norm(force) < 1e-9, "all of it comes back: {force:?}");
}

/// Slip begins where the pull reaches static friction: within the elastic range by the soft stiffness, beyond it by the taut one; then force falls to
/// kinetic friction, and remains there.
#[test]
fn slip_begins_at_the_static_limit_and_falls_to_the_kinetic() {
    let model = Tissue::new();
    let attributes = values(&model, &[("static_ratio", 1.25), ("taut_ratio", 50.0)]);
    let soft = STIFFNESS * LENGTH;
    for normal in [50.0, 100.0, 400.0] {
        let (kinetic, fixed) = (0.2 * normal, 1.25 * 0.2 * normal);
        let begins = if fixed < soft * DRAW {
            fixed / soft
        } else {
            DRAW + (fixed - soft * DRAW) / (50.0 * soft)
        };
        let mut contact = Contact::on_plane(&model, normal, 0.2);
        let (mut drawn, mut most, mut last) = (0.0, (0.0, 0.0), 0.0);
        for _ in 0..20_000 {
            drawn += 1e-5;
            last = -contact.slide(&model, &attributes, [1e-5, 0.0, 0.0])[0];
            if last > most.0 {
                most = (last, drawn);
            }
        }
        assert!((most.0 / fixed - 1.0).abs() < 1e-9, "{normal} N: {most:?} for {fixed} N");
        assert!((most.1 - begins).abs() < 1.1e-5, "{normal} N: draw {} m for {begins} m", most.1);
        assert!((last / kinetic - 1.0).abs() < 1e-12 && (contact.state[2] - 1.0).abs() < 1e-12);
    }
}

/// Displacement of the tissue is stored in the skin's frame: it rotates with the whale.
#[test]
fn draw_turns_with_the_skin() {
    let model = Tissue::new();
    let attributes = values(&model, &[]);
    let mut contact = Contact::on_plane(&model, 1000.0, 0.2);
    contact.slide(&model, &attributes, [0.03, 0.0, 0.0]);
    contact.slip = [0.0; 3];
    contact.grain = [-1.0, 0.0, 0.0];
    let force = contact.respond(&model, &attributes).force_n;
    assert!(
        force[0].abs() < 1e-9 && (force[1] + STIFFNESS * LENGTH * 0.03).abs() < 1e-9,
        "{force:?}"
    );
}

/// A light rope pulled by a spring at a slow, constant speed sticks and slips; skin and spring are in series, so with
/// `1/C = 1/K + 1/(k l)` pull rises from kinetic to static friction in `(rho - 1) mu N / (C V)`, and falls back at once.
#[test]
fn a_drawn_rope_sticks_and_slips_with_the_closed_form_period() {
    let model = Tissue::new();
    let (mu, normal, ratio, spring, hand) = (0.2, 40.0, 1.25, 400.0, 0.004);
    let attributes = values(&model, &[("static_ratio", ratio)]);
    let contact = Contact { dt: 1e-4, ..Contact::on_plane(&model, normal, mu) };
    let mut slider = Slider::new(&model, attributes, contact, spring, 1e-8);
    let (mut leaps, mut was, mut least) = (Vec::new(), 0.0, f64::INFINITY);
    for step in 0..250_000 {
        slider.step(hand);
        let slips = slider.contact.state[2];
        if slips > was {
            leaps.push((f64::from(step) * 1e-4, slider.pull()));
        }
        if leaps.len() > 2 {
            least = least.min(slider.pull());
        }
        was = slips;
    }
    let friction = mu * normal;
    let period = (leaps[leaps.len() - 1].0 - leaps[1].0) / (leaps.len() - 2) as f64;
    let together = 1.0 / (1.0 / spring + 1.0 / (STIFFNESS * LENGTH));
    let expected = (ratio - 1.0) * friction / (together * hand);
    assert!(leaps.len() > 5, "{leaps:?}");
    assert!(
        (leaps[3].1 / (ratio * friction) - 1.0).abs() < 0.01,
        "breaks loose at {} N",
        leaps[3].1
    );
    assert!((least / friction - 1.0).abs() < 0.02, "holds again at {least} N");
    assert!((period / expected - 1.0).abs() < 0.02, "{period} s for {expected} s");
}
