//! End tensions of a coarse line against the shooting solution of reference problem b.

use endline_fixtures::gear::{fixed, line, model, on_body, water, weight};
use endline_sim::metrics::Metrics;
use endline_sim::model::{Float, Settings};
use endline_sim::{DVec3, settle};

/// A rope of 60 m anchored at 30 m to a buoy at the surface, in a current of 0.5 m/s: 23.93630 N at the
/// anchor and 14.39362 N at the buoy by shooting. Twenty segments give both, though their own tensions do not.
#[test]
fn a_coarse_line_bears_the_end_tensions_of_the_shooting_solution() {
    let mut buoy = weight("buoy", 1.0, DVec3::new(51.9615, 0.0, 0.0), None);
    buoy.floats = vec![Float::level(DVec3::ZERO, 0.010, 0.25)];
    buoy.drag_area_m2 = DVec3::splat(0.0281);
    buoy.added_mass_kg = DVec3::splat(0.5 * 1025.0 * 0.010);
    let joints = vec![fixed("anchor", DVec3::new(0.0, 0.0, -30.0)), on_body("buoy", 0)];
    let model = model(
        water(1025.0, 0.5),
        joints,
        vec![line("endline", 60.0, 20)],
        vec![buoy],
        Settings::default(),
    );
    let settled = settle(&model);
    assert!(settled.converged);
    let summary = Metrics::new(&model).summary(&model, &settled.state);
    let bare = [settled.state.rope.tension[0], settled.state.rope.tension[19]];
    let ends = [summary.lines[0].end_a_tension_n, summary.lines[0].end_b_tension_n];
    for (wanted, (bare, end)) in [23.93630, 14.39362].into_iter().zip(bare.into_iter().zip(ends)) {
        println!(
            "{wanted} N: segment {:+.3} %, end {:+.3} %",
            100.0 * (bare / wanted - 1.0),
            100.0 * (end / wanted - 1.0)
        );
        assert!((end / wanted - 1.0).abs() < 0.002, "{end} N for {wanted} N");
    }
}
