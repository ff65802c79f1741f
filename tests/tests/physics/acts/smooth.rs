//! Nothing jumps: random controls and acts, and the same again to the bit.

use endline_sdk::{BodyPart, Controls, MotionOutput, WhaleMotion};
use endline_sim::whale::Angle;
use endline_sim::whale::pose::angle_of;

use crate::acts::flight::Flight;

/// A new random number, 0 to 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Flies for a while with controls, acts and touches that change at random moments, the same ones for every step length.
fn fly(seed: u64, dt_s: f64) -> Vec<MotionOutput> {
    let mut flight = Flight::new(Some("roll-toward"));
    flight.dt_s = dt_s;
    let acts = flight.acting.descriptor().acts.len() as f64;
    let (mut seed, mut controls, mut until_s) = (seed, Controls::default(), 0.0);
    let mut out = Vec::new();
    for step in 0..(40.0 / dt_s).round() as usize {
        if step as f64 * dt_s >= until_s - 1e-9 {
            let mut axis = || 2.0 * random(&mut seed) - 1.0;
            controls = Controls {
                speed: axis().max(0.0),
                pitch: axis(),
                roll: axis(),
                yaw: axis(),
                burst: axis().max(0.0),
                mouth: axis().max(0.0),
                flipper_raise: axis(),
                flipper_twist: axis(),
                flipper_sweep: axis(),
                act: (axis().max(-0.2) * (acts + 1.0)).floor().clamp(0.0, acts),
            };
            let part = (random(&mut seed) * 20.0) as usize;
            flight.forces = [0.0; BodyPart::ALL.len()];
            if let Some(force) = flight.forces.get_mut(part) {
                *force = 100.0;
            }
            until_s += (0.04 * (1.0 + random(&mut seed) * 60.0) / 0.04).floor() * 0.04;
        }
        out.push(flight.step(controls));
    }
    out
}

/// The greatest change of any angle, and of any turn rate, from one step to the next.
fn jumps(out: &[MotionOutput]) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    for pair in out.windows(2) {
        for angle in Angle::all() {
            let of = |out: &MotionOutput| angle_of(&out.posture, angle);
            most[0] = most[0].max((of(&pair[1]) - of(&pair[0])).abs());
        }
        for axis in 0..3 {
            most[1] =
                most[1].max((pair[1].turn_rate_rad_s[axis] - pair[0].turn_rate_rad_s[axis]).abs());
        }
    }
    most
}

#[test]
fn posture_and_turn_rates_are_continuous_whatever_the_pilot_and_the_rope_do() {
    for seed in 1..6 {
        let (coarse, fine) = (jumps(&fly(seed, 0.02)), jumps(&fly(seed, 0.005)));
        assert!(coarse[0] < 0.08 && coarse[1] < 0.08, "seed {seed}: {coarse:?} in 20 ms");
        for (coarse, fine) in coarse.iter().zip(fine) {
            assert!(
                fine < 0.35 * coarse,
                "seed {seed}: a jump does not shrink with the step: {coarse} then {fine}"
            );
        }
    }
}

#[test]
fn the_same_flight_gives_the_same_bits() {
    let bits = |out: Vec<MotionOutput>| -> Vec<u64> {
        let angles = out
            .iter()
            .flat_map(|out| Angle::all().map(|angle| angle_of(&out.posture, angle).to_bits()));
        angles.chain(out.iter().flat_map(|out| out.turn_rate_rad_s.map(f64::to_bits))).collect()
    };
    assert!(bits(fly(7, 0.02)) == bits(fly(7, 0.02)) && bits(fly(7, 0.02)) != bits(fly(8, 0.02)));
}
