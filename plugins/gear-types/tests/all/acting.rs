//! Gear that acts: the cutter's clock, and the release of on-demand gear.

use crate::common;
use crate::common::{built, lines, number, values, word};
use endline_gear_types::{OnDemand, TimeTensionCutter};
use endline_sdk::{AttributeValue, GearAction, GearStep, GearType, LineEnd};

/// Steps a gear with a tension on one line, from a time on; returns the time and kind of its action.
fn acted(
    gear: &dyn GearType,
    changes: &[(&str, AttributeValue)],
    tension_n: impl Fn(f64, usize) -> [f64; 2],
    until_s: f64,
) -> Vec<(f64, GearAction)> {
    let (values, count, dt_s) = (values(gear, changes), built(gear, changes).lines.len(), 0.01);
    let (mut state, mut all) = (vec![0.0; gear.descriptor().state_len], Vec::new());
    for step in 1..=(until_s / dt_s) as usize {
        let time_s = step as f64 * dt_s;
        let tensions: Vec<_> = (0..count).map(|line| tension_n(time_s, line)).collect();
        let mut actions = Vec::new();
        gear.step(
            &values,
            &GearStep { time_s, dt_s, end_tension_n: &tensions },
            &mut state,
            &mut actions,
        )
        .unwrap();
        all.extend(actions.into_iter().map(|action| (time_s, action)));
    }
    all
}

/// Index of a line in the rig.
fn line(gear: &dyn GearType, changes: &[(&str, AttributeValue)], id: &str) -> usize {
    built(gear, changes).lines.iter().position(|line| line.id == id).unwrap()
}

fn cutter(extra: &[(&'static str, AttributeValue)]) -> Vec<(&'static str, AttributeValue)> {
    let mut changes = vec![("cutter_tension", number(1000.0)), ("cutter_hold", number(5.0))];
    changes.extend(extra.iter().cloned());
    changes
}

#[test]
fn the_cutter_parts_its_line_once_the_tension_has_stayed_for_its_time() {
    let gear = TimeTensionCutter::new();
    let changes = cutter(&[]);
    let foot = line(&gear, &changes, "endline-bottom");
    let pulled = |time_s: f64, line: usize| {
        if line == foot && time_s > 2.005 { [1000.0, 0.0] } else { [999.0, 5000.0] }
    };
    let cuts = acted(&gear, &changes, pulled, 20.0);
    assert_eq!(cuts.len(), 1, "{cuts:?}");
    assert!((cuts[0].0 - 7.0).abs() < 0.0101, "2 s and 5 s of hold: {}", cuts[0].0);
    assert_eq!(cuts[0].1, GearAction::CutLine { line: foot as u32, end: LineEnd::A });
}

#[test]
fn tension_that_lets_go_in_between_starts_the_cutters_time_again() {
    let (gear, changes) = (TimeTensionCutter::new(), cutter(&[]));
    // 4.5 s on, 0.1 s off: intervals of hauling in jerks are not added.
    let jerks = |time_s: f64, _| if time_s % 4.6 < 4.5 { [5000.0; 2] } else { [0.0; 2] };
    assert!(acted(&gear, &changes, jerks, 60.0).is_empty());
}

#[test]
fn the_cutter_is_at_its_place_in_each_endline() {
    let gear = TimeTensionCutter::new();
    for (at, id, end) in [
        ("foot", "endline-bottom", LineEnd::A),
        ("splice", "endline-top", LineEnd::A),
        ("buoy", "surface-system", LineEnd::B),
    ] {
        let trawl = [
            ("traps", number(6.0)),
            ("gangion", number(2.0)),
            ("bridle", number(1.0)),
            ("surface_rope", common::item("sink-3-8")),
            ("high_flyer", common::item("high-flyer")),
            ("anchor", common::item("danforth")),
            ("cutter_at", word(at)),
        ];
        let changes = cutter(&trawl);
        let cuts = acted(&gear, &changes, |_, _| [2000.0; 2], 6.0);
        let wanted: Vec<_> = [id.to_owned(), format!("far-{id}")]
            .map(|id| line(&gear, &changes, &id) as u32)
            .to_vec();
        let asked: Vec<_> = cuts.iter().map(|(_, action)| *action).collect();
        assert_eq!(
            asked,
            wanted.iter().map(|line| GearAction::CutLine { line: *line, end }).collect::<Vec<_>>(),
            "{at}"
        );
    }
}

#[test]
fn on_demand_gear_opens_its_release_and_every_tie_at_its_time() {
    let gear = OnDemand::new();
    let changes = [
        ("endlines", number(2.0)),
        ("traps", number(3.0)),
        ("flakes", number(4.0)),
        ("release_at", number(3.0)),
        ("far_release_at", number(5.0)),
    ];
    let links: Vec<_> = built(&gear, &changes).links.iter().map(|link| link.id.clone()).collect();
    let near = ["release", "tie-1", "tie-2", "tie-3"];
    assert_eq!(
        links,
        near.into_iter()
            .map(str::to_owned)
            .chain(near.map(|id| format!("far-{id}")))
            .collect::<Vec<_>>()
    );
    let released = acted(&gear, &changes, |_, _| [0.0; 2], 10.0);
    assert_eq!(released.len(), 8);
    for (index, (time_s, action)) in released.into_iter().enumerate() {
        assert_eq!(action, GearAction::ReleaseLink { link: index as u32 });
        assert!((time_s - if index < 4 { 3.0 } else { 5.0 }).abs() < 0.0101, "{time_s}");
    }
}

#[test]
fn the_stowed_endline_lies_on_the_seabed_and_is_as_long_as_its_scope_says() {
    let rig = built(&OnDemand::new(), &[]);
    let flakes: Vec<_> = rig.lines.iter().filter(|line| line.id.starts_with("endline")).collect();
    assert_eq!(lines(&rig, "endline").len(), 8);
    assert!((flakes.iter().map(|line| line.length_m).sum::<f64>() - 1.3 * 25.0).abs() < 1e-9);
    assert!(flakes.iter().all(|line| line.laid_m.iter().all(|place| place[2] < -25.0 + 0.2)));
    assert!(
        rig.bodies.iter().all(|body| body.position_m[2] < -23.0),
        "nothing stands in the water"
    );
}
