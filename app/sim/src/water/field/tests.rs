//! Waves against linear theory.

use core::f64::consts::{PI, TAU};

use super::*;
use crate::water::jonswap::Spectrum;
use crate::water::waves::WaveKind;

fn regular(height_m: f64, period_s: f64, ramp_s: f64) -> Waves {
    Waves {
        toward: DVec3::X,
        ramp_s,
        kind: WaveKind::Regular { height_m, period_s, phase_rad: 0.0 },
    }
}

fn irregular() -> Field {
    let spectrum = Spectrum { significant_height_m: 1.5, peak_period_s: 5.0, gamma: 3.3 };
    let waves = Waves {
        toward: DVec3::new(0.6, 0.8, 0.0),
        ramp_s: 10.0,
        kind: WaveKind::Jonswap { spectrum, components: 62 },
    };
    Field::new(&waves, 25.0, 9.81, 3)
}

/// Deep water: speed `a ω e^{kz}`, orbits round; at half a wavelength down 4.3 % are left. Shallow water: the speed
/// along is the same at every depth, that up falls linearly to the bed.
#[test]
fn orbital_velocity_decays_as_it_should() {
    let deep = Field::new(&regular(1.0, 6.0, 0.0), 500.0, 9.81, 1);
    let number = wave_number(TAU / 6.0, 500.0, 9.81);
    for depth in [0.0, 0.3, 1.0, PI] {
        let at = |time: f64| deep.at(DVec3::new(0.0, 0.0, -depth / number), time);
        let expected = 0.5 * TAU / 6.0 * libm::exp(-depth);
        assert!((at(6.0).velocity_m_s.x / expected - 1.0).abs() < 1e-12);
        assert!((at(4.5).velocity_m_s.z / expected - 1.0).abs() < 1e-9);
    }
    let shallow = Field::new(&regular(0.1, 600.0, 0.0), 10.0, 9.81, 1);
    let speed = 0.05 * (9.81_f64 / 10.0).sqrt();
    for share in [0.0, 0.25, 1.0] {
        let at = |time: f64| shallow.at(DVec3::new(0.0, 0.0, -10.0 * share), time);
        assert!((at(600.0).velocity_m_s.x / speed - 1.0).abs() < 1e-3);
        assert!((at(450.0).velocity_m_s.z - 0.05 * TAU / 600.0 * (1.0 - share)).abs() < 1e-6);
    }
}

/// No divergence, no rotation, and the surface moves with the water: by central differences at odd places and times.
#[test]
fn the_flow_is_incompressible_irrotational_and_carries_its_surface() {
    let field = irregular();
    let step = 1e-4;
    for (place, time) in
        [(DVec3::new(3.0, -7.0, -2.0), 41.0), (DVec3::new(-20.0, 11.0, -14.0), 7.0)]
    {
        let by = |axis: DVec3| {
            (field.at(place + axis * step, time).velocity_m_s
                - field.at(place - axis * step, time).velocity_m_s)
                / (2.0 * step)
        };
        let (x, y, z) = (by(DVec3::X), by(DVec3::Y), by(DVec3::Z));
        assert!((x.x + y.y + z.z).abs() < 1e-7);
        assert!((z.x - x.z).abs() + (z.y - y.z).abs() + (y.x - x.y).abs() < 1e-7);
        let rate = (field.at(place, time + step).velocity_m_s
            - field.at(place, time - step).velocity_m_s)
            / (2.0 * step);
        assert!((rate - field.at(place, time).acceleration_m_s2).length() < 1e-6);
    }
    let surface = DVec3::new(2.0, 3.0, 0.0);
    let rise = (field.at(surface, 41.0 + step).surface_m
        - field.at(surface, 41.0 - step).surface_m)
        / (2.0 * step);
    assert!((rise - field.at(surface, 41.0).velocity_m_s.z).abs() < 1e-6);
}

/// Dynamic pressure at the surface is `ρ g η`: `du/dt = -g ∂η/∂x` there.
#[test]
fn water_runs_down_the_slope_of_its_surface() {
    let field = irregular();
    let (place, toward, step) = (DVec3::new(2.0, 3.0, 0.0), DVec3::new(0.6, 0.8, 0.0), 1e-4);
    let slope = (field.at(place + toward * step, 41.0).surface_m
        - field.at(place - toward * step, 41.0).surface_m)
        / (2.0 * step);
    assert!((field.at(place, 41.0).acceleration_m_s2.dot(toward) + 9.81 * slope).abs() < 1e-6);
}

#[test]
fn waves_grow_from_nothing_and_are_as_at_the_mean_surface_above_it() {
    let field = Field::new(&regular(2.0, 6.0, 12.0), 25.0, 9.81, 1);
    assert_eq!(field.at(DVec3::ZERO, 0.0), WaterAt::default());
    assert!(field.at(DVec3::ZERO, 0.01).acceleration_m_s2.length() < 0.01);
    assert!((field.at(DVec3::ZERO, 6.0).surface_m - 0.5).abs() < 1e-12);
    assert!((field.at(DVec3::ZERO, 12.0).surface_m - 1.0).abs() < 1e-12);
    assert_eq!(field.at(DVec3::new(1.0, 0.0, 0.7), 20.0), field.at(DVec3::X, 20.0));
}

/// A rope of short and long segments from the bed to above the surface, in deep and in shallow water.
#[test]
fn a_walk_along_rope_agrees_with_each_place_on_its_own() {
    for field in [irregular(), Field::new(&regular(1.0, 4.0, 0.0), 300.0, 9.81, 1)] {
        let mut walk = Walk::default();
        field.begin(&mut walk, 123.4);
        let (mut place, mut worst) = (DVec3::new(5.0, -3.0, -30.0), 0.0_f64);
        for node in 0..600 {
            let length = if node % 100 == 99 { 3.0 } else { 0.06 };
            place +=
                DVec3::new(0.3 * libm::sin(0.05 * f64::from(node)), 0.2, 0.8).normalize() * length;
            let (walked, alone) = (field.walk_to(&mut walk, place), field.at(place, 123.4));
            worst = worst.max((walked.velocity_m_s - alone.velocity_m_s).length());
            worst = worst.max((walked.acceleration_m_s2 - alone.acceleration_m_s2).length());
            worst = worst.max((walked.surface_m - alone.surface_m).abs());
        }
        assert!(worst < 1e-10, "{worst:e}");
    }
}
