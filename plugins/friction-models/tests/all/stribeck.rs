//! The Stribeck model against its steady curve, and against the spring-slider's closed forms.

use crate::common::{Contact, Slider, values};
use endline_friction_models::Stribeck;

const MU: f64 = 0.2;
const NORMAL: f64 = 100.0;

/// Steady friction over kinetic friction by the written law.
fn curve(ratio: f64, speed: f64, stribeck: f64, viscous: f64) -> f64 {
    1.0 + (ratio - 1.0) * libm::exp(-(speed / stribeck) * (speed / stribeck))
        + (speed / viscous).min(1.0)
}

#[test]
fn steady_slip_has_the_stribeck_curve() {
    let model = Stribeck::new();
    let (stribeck, viscous) = (0.05, 4.0);
    let attributes = values(&model, &[("stribeck_speed", stribeck), ("viscous_speed", viscous)]);
    for speed in [1e-3, 0.01, 0.03, 0.05, 0.08, 0.15, 0.5, 1.0, 3.0, 6.0] {
        let mut contact = Contact::on_plane(&model, NORMAL, MU);
        let mut force = 0.0;
        for _ in 0..3000 {
            force = contact.slide(&model, &attributes, [speed * contact.dt, 0.0, 0.0])[0];
        }
        let expected = -MU * NORMAL * curve(1.4, speed, stribeck, viscous);
        assert!((force / expected - 1.0).abs() < 1e-9, "{speed} m/s: {force} N for {expected} N");
        assert!((contact.state[3] / speed - 1.0).abs() < 1e-9);
    }
}

/// The film follows with a lag: after a jump of speed the difference falls to 1/e in the film time.
#[test]
fn the_film_lags_by_its_time() {
    let model = Stribeck::new();
    let (speed, lag) = (0.2, 0.05);
    let attributes = values(&model, &[("film_time", lag), ("stick_stiffness", 1e10)]);
    let mut contact = Contact { dt: 1e-5, ..Contact::on_plane(&model, NORMAL, MU) };
    for _ in 0..5000 {
        contact.slide(&model, &attributes, [speed * 1e-5, 0.0, 0.0]);
    }
    let expected = speed * (1.0 - libm::exp(-1.0));
    assert!((contact.state[3] / expected - 1.0).abs() < 1e-3, "{} {expected}", contact.state[3]);
}

/// A block pulled slowly sticks until the spring reaches static friction, slips, and sticks again. With a fall from `rho mu` to `mu` that is
/// fast compared with the slip, the block oscillates about the kinetic equilibrium by half a cosine: pull falls from `rho mu N` to
/// `(2 - rho) mu N`, and a period consists of `2 (rho - 1) mu N / (K V)` of sticking and about `pi sqrt(M/K)` of slip.
#[test]
fn a_slowly_drawn_block_sticks_and_slips_with_the_closed_form_period() {
    let model = Stribeck::new();
    let (ratio, spring, mass, hand) = (1.4, 400.0, 1.0, 0.004);
    let attributes = values(
        &model,
        &[
            ("static_ratio", ratio),
            ("stribeck_speed", 2e-3),
            ("viscous_speed", 1e4),
            ("film_time", 2e-4),
        ],
    );
    let contact = Contact { dt: 1e-4, ..Contact::on_plane(&model, NORMAL, MU) };
    let mut slider = Slider::new(&model, attributes, contact, spring, mass);
    let (mut leaps, mut tops, mut bottoms, mut was_slipping) =
        (Vec::new(), Vec::new(), Vec::new(), false);
    for step in 0..600_000 {
        let before = slider.pull();
        slider.step(hand);
        let slipping = slider.speed > 10.0 * hand;
        if slipping && !was_slipping {
            leaps.push(f64::from(step) * 1e-4);
            tops.push(before);
        } else if was_slipping && !slipping {
            bottoms.push(slider.pull());
        }
        was_slipping = slipping;
    }
    let friction = MU * NORMAL;
    let period = (leaps[leaps.len() - 1] - leaps[1]) / (leaps.len() - 2) as f64;
    let expected = 2.0 * (ratio - 1.0) * friction / (spring * hand)
        + std::f64::consts::PI * (mass / spring).sqrt();
    let (top, bottom) = (tops[2], bottoms[2]);
    assert!(leaps.len() > 4, "{leaps:?}");
    assert!((period / expected - 1.0).abs() < 0.02, "{period} s for {expected} s");
    assert!((top / (ratio * friction) - 1.0).abs() < 0.01, "slips at {top} N");
    assert!((bottom / ((2.0 - ratio) * friction) - 1.0).abs() < 0.03, "sticks again at {bottom} N");
}

/// Steady slip is stable where friction rises with speed and not where it falls, whatever the lag (Routh's test of
/// `m tau x³ + m x² + (K tau + N mu') x + K`): the threshold is the minimum of the curve.
#[test]
fn stick_slip_ends_at_the_least_of_the_curve() {
    let model = Stribeck::new();
    let (stribeck, viscous) = (0.05, 2.0);
    let attributes = values(
        &model,
        &[("stribeck_speed", stribeck), ("viscous_speed", viscous), ("film_time", 0.02)],
    );
    let least = (1..4000).map(|i| f64::from(i) * 1e-4).min_by(|a, b| {
        curve(1.4, *a, stribeck, viscous).total_cmp(&curve(1.4, *b, stribeck, viscous))
    });
    let least = least.unwrap_or_default();
    assert!((0.1..0.15).contains(&least), "{least} m/s");
    let swing = |speed: f64| {
        let contact = Contact { dt: 2e-4, ..Contact::on_plane(&model, NORMAL, MU) };
        let mut slider = Slider::new(&model, attributes.clone(), contact, 300.0, 2.0);
        // Starts at equilibrium with a small disturbance.
        slider.contact.state[3] = speed;
        slider.contact.state[0] = MU * NORMAL * curve(1.4, speed, stribeck, viscous) / (1e7 * 0.02);
        slider.hand = MU * NORMAL * curve(1.4, speed, stribeck, viscous) / 300.0;
        slider.speed = 1.02 * speed;
        let mut extremes = [f64::INFINITY, f64::NEG_INFINITY];
        for step in 0..400_000 {
            slider.step(speed);
            if step > 350_000 {
                extremes = [extremes[0].min(slider.speed), extremes[1].max(slider.speed)];
            }
        }
        (extremes[1] - extremes[0]) / speed
    };
    assert!(swing(0.8 * least) > 0.5, "falls: {}", swing(0.8 * least));
    assert!(swing(1.2 * least) < 0.01, "rises: {}", swing(1.2 * least));
}
