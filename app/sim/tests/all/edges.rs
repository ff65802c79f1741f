//! The capstan law on triangles, round drums and over the edges of fins, and rope at rest that stays.
//!
//! Rope drawn over a drum of skin by a turn `θ` against a steady pull: sliding, the tensions stand as `T₂/T₁ = e^{μθ}`.
//! The whole table, over segment lengths and facets: `cargo bench -p endline-sim --bench capstan`.

use std::f64::consts::{FRAC_PI_2, TAU};

use endline_fixtures::capstan::{Capstan, Reading};
use endline_sim::model::Resolution;

/// Segments of the shipped encounters [m].
const SHIPPED_M: f64 = 0.07;

fn read(what: &str, capstan: &Capstan) -> Reading {
    let read = capstan.read();
    let share = |part: f64| 100.0 * (part - 1.0);
    println!(
        "{what}: friction {:+.2} %, ratio {:+.2} %, ripple {:.2} %",
        share(read.friction),
        share(read.ratio),
        100.0 * read.ripple
    );
    assert_eq!(read.audit.tunnelled, 0, "{what}");
    read
}

#[test]
fn friction_round_a_drum_is_that_of_the_law() {
    for (turn, friction) in [(FRAC_PI_2, 0.1), (TAU, 0.3), (2.0 * TAU, 0.6)] {
        let slack_n = 4000.0 / libm::exp(friction * turn);
        let capstan = Capstan {
            turn,
            friction,
            slack_n,
            segment_m: SHIPPED_M,
            drawn_m: [0.1, 0.1],
            ..Capstan::default()
        };
        let read = read(&format!("{turn:.2} rad at {friction}"), &capstan);
        assert!((read.friction - 1.0).abs() < 0.012, "{read:?}");
    }
}

#[test]
fn tension_over_the_edge_of_a_fin_is_that_of_the_law() {
    for radius_m in [0.01, 0.02, 0.05] {
        for degrees in [90.0_f64, 160.0] {
            let capstan = Capstan {
                turn: degrees.to_radians(),
                radius_m,
                facets: 48,
                slack_n: 100.0,
                segment_m: SHIPPED_M,
                resolution: Some(Resolution::default()),
                tail_m: 4.0,
                drawn_m: [0.1, 0.1],
                ..Capstan::default()
            };
            let read = read(&format!("edge of {radius_m} m, {degrees} deg"), &capstan);
            assert!(read.audit.splits > 20, "{read:?}");
            assert!((read.ratio - 1.0).abs() < 0.02, "{read:?}");
            assert!(read.ripple < 0.03, "{read:?}");
        }
    }
}

/// Rope in the fold of a sheave is pressed by both of its sides, each with `N / (2 cos β)` where they rise by `β`: its friction is that
/// of a flat drum over `cos β`, as of a V-belt.
#[test]
fn rope_pulled_into_a_fold_is_held_by_both_of_its_sides() {
    for (degrees, segment_m) in [(4.0_f64, SHIPPED_M), (15.0, 0.03), (40.0, 0.03)] {
        let rise = degrees.to_radians();
        let capstan = Capstan {
            turn: FRAC_PI_2,
            rise,
            slack_n: 8000.0,
            segment_m,
            drawn_m: [0.1, 0.1],
            ..Capstan::default()
        };
        let read = read(&format!("a fold with sides that rise by {degrees} deg"), &capstan);
        assert!((read.friction * libm::cos(rise) - 1.0).abs() < 0.02, "{read:?}");
        assert_eq!(read.audit.unconverged, 0, "{read:?}");
    }
}

/// Nine tenths of what friction holds, for a minute.
#[test]
fn rope_at_rest_under_load_does_not_creep() {
    for (radius_m, degrees, segment_m) in [(0.3, 180.0_f64, 2.0 * SHIPPED_M), (0.02, 160.0, 0.0125)]
    {
        let turn = degrees.to_radians();
        let slack_n = 100.0;
        let held_n = Some(slack_n * libm::exp(0.9 * 0.3 * turn));
        let capstan = Capstan {
            turn,
            radius_m,
            facets: 24,
            slack_n,
            held_n,
            segment_m,
            tail_m: 0.1,
            ..Capstan::default()
        };
        let creep = capstan.creep(1.0, 61.0);
        println!("drum of {radius_m} m: {:.6} mm in 60 s", 1e3 * creep);
        assert!(creep < 1e-3, "crept {creep} m");
    }
}

/// A contact point beside the middle of its piece stays where the rope is nearest to the edge. Where it stays at a place of the rope
/// instead, a tight rope that slides over the edges of a square bar takes 1.4 iterations per solver step.
#[test]
fn tight_rope_slides_over_sharp_edges_in_few_iterations() {
    let capstan = Capstan {
        facets: 4,
        radius_m: 0.2,
        turn: 2.0,
        slack_n: 2000.0,
        segment_m: SHIPPED_M,
        ..Capstan::default()
    };
    let audit = read("square bar", &capstan).audit;
    let iterations = audit.passes as f64 / audit.solver_steps as f64;
    println!("{iterations:.3} iterations per solver step");
    assert!(iterations < 1.15, "{audit:?}");
    assert_eq!(audit.unconverged, 0, "{audit:?}");
}
