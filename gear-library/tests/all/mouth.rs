//! Rope in the mouth of the right whale: neither closing jaws nor fast rope make it pass through lips or baleen.
#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::sync::Arc;

use crate::fins::rig::{Taut, whale};
use crate::fins::tally::is_pierced;
use endline_fixtures::hooks::{Motion, descriptor};
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{MotionOutput, Posture, Region, WhaleMotion};
use endline_sim::geometry::distance::segment_triangle;
use endline_sim::metrics::Metrics;
use endline_sim::model::{Settings, Whale};
use endline_sim::whale::{Skin, pose, skin_all};
use endline_sim::{Audit, DQuat, DVec3, Input, Model, State, Workspace, step};

pub const LENGTH_M: f64 = 13.7;
/// Half of the rope, and its segments [m].
const HALF_M: f64 = 2.5;
const SEGMENT_M: f64 = 0.05;
const RADIUS_M: f64 = 0.005;
const WHALE: DVec3 = DVec3::new(0.0, 0.0, -20.0);

/// A skimming whale's mouth, as `gear-library/acts/skim-feed.toml` opens it [rad].
pub fn open() -> Posture {
    Posture { jaw: 0.2618, lips: [0.3491; 2], ..Posture::default() }
}

/// The result of a run.
struct Came {
    audit: Audit,
    /// Whether rope lies through skin at the end.
    pierced: bool,
    /// Regions of the head that rope pressed on.
    pressed: Vec<Region>,
    /// Whether rope was lodged in the mouth at the end.
    lodged: bool,
    /// Farthest aft that rope reached into the head, from the snout [m].
    aft_m: f64,
}

/// Corners of the skin's triangles with the mouth open, whale at the origin.
pub fn open_mouth(skin: &Skin) -> Vec<[DVec3; 3]> {
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, DVec3::ZERO, DQuat::IDENTITY, &open(), &mut bones);
    skin_all(skin, &bones, &mut places);
    skin.triangles.iter().map(|corners| corners.map(|corner| places[corner as usize])).collect()
}

/// Places at which a level rope across the whale lies in the open mouth, jaw below and rostrum above, clear of all skin.
fn clear_places(skin: &[[DVec3; 3]]) -> Vec<DVec3> {
    let head: Vec<_> = skin.iter().filter(|corners| corners[0].x > 0.25 * LENGTH_M).collect();
    let over = |place: DVec3, sign: f64| {
        let up = [place, place + DVec3::Z * sign * 3.0];
        head.iter().any(|corners| segment_triangle(up, **corners).distance <= 0.0)
    };
    let across = DVec3::Y * HALF_M;
    let clear = |place: DVec3| {
        head.iter().all(|corners| {
            segment_triangle([place - across, place + across], **corners).distance > 3.0 * RADIUS_M
        })
    };
    let grid = (0..24).flat_map(|x| (0..40).map(move |z| (f64::from(x), f64::from(z))));
    let places = grid.map(|(x, z)| DVec3::new((0.5 - 0.008 * x) * LENGTH_M, 0.0, 0.05 * z - 1.5));
    places.filter(|place| over(*place, 1.0) && over(*place, -1.0) && clear(*place)).collect()
}

/// A level rope across the whale, at a place of the whale's frame.
fn across(
    skin: &Skin,
    place: DVec3,
    pull_n: f64,
    (speed_m_s, closes_s): (f64, [f64; 2]),
    until_s: f64,
) -> Came {
    let (position_m, orientation) = (WHALE, DQuat::IDENTITY);
    let whale = Whale {
        motion: motion(speed_m_s, closes_s),
        position_m,
        orientation,
        speed_m_s,
        ..whale(skin.clone(), speed_m_s, [0.0; 3])
    };
    let rope = Taut {
        held: WHALE + place - DVec3::Y * HALF_M,
        along: DVec3::Y,
        pull_n,
        radius_m: RADIUS_M,
        length_m: 2.0 * HALF_M,
        segments: (2.0 * HALF_M / SEGMENT_M) as usize,
    };
    let model = Model::new(rope.rig(whale, 0.2, Settings::default()))
        .unwrap_or_else(|errors| panic!("{errors:?}"));
    let (mut state, mut workspace, mut metrics) =
        (State::start(&model), Workspace::new(&model), Metrics::new(&model));
    if let Some(whale) = &mut state.whale {
        whale.posture = open();
    }
    let (mut pressed, mut aft_m) = (Vec::new(), 0.0_f64);
    while state.time_s < until_s {
        step(&model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?} {:?}", workspace.audit));
        metrics.fold_step(&model, &state, &workspace);
        pressed.extend(
            workspace
                .contacts
                .iter()
                .map(|contact| contact.region)
                .filter(|region| !pressed.contains(region))
                .collect::<Vec<_>>(),
        );
        let snout = state.whale.as_ref().map_or(0.0, |whale| whale.position.x) + 0.5 * LENGTH_M;
        let near = state.rope.position.iter().filter(|place| place.y.abs() < 0.5);
        aft_m = near.map(|place| snout - place.x).fold(aft_m, f64::max);
    }
    let lodged = metrics.summary(&model, &state).whale.is_some_and(|whale| whale.lodged_in_mouth);
    Came { audit: workspace.audit, pierced: is_pierced(&model, &state), pressed, lodged, aft_m }
}

/// Returns a motion at constant speed with an open mouth, which closes between two times.
pub fn motion(speed_m_s: f64, [from, to]: [f64; 2]) -> Arc<dyn WhaleMotion> {
    Motion::new(descriptor("test.closing"), move |input| {
        let share = ((to - input.time_s - input.dt_s) / (to - from)).clamp(0.0, 1.0);
        let wide = open();
        let posture =
            Posture { jaw: wide.jaw * share, lips: wide.lips.map(|lip| lip * share), ..wide };
        MotionOutput { speed_m_s, posture, ..MotionOutput::default() }
    })
}

#[test]
fn jaws_that_close_on_rope_let_none_through() {
    let skin = build_skin(&WhaleForm::right_whale(LENGTH_M));
    let places = clear_places(&open_mouth(&skin));
    println!("{} places in the open mouth", places.len());
    assert!(places.len() >= 4, "{places:?}");
    let mut lodged = 0;
    for place in places.iter().step_by(places.len() / 4).take(4) {
        let came = across(&skin, *place, 30.0, (0.0, [0.1, 1.1]), 2.6);
        println!(
            "at {place:.2}: lodged {}, pressed {:?}, {:?}",
            came.lodged, came.pressed, came.audit
        );
        assert!(came.audit.tunnelled == 0 && !came.pierced, "{place}: {:?}", came.audit);
        assert!(!came.pressed.is_empty(), "{place}: the jaws never touched the rope");
        lodged += u32::from(came.lodged);
    }
    println!("{lodged} lodged");
}

#[test]
fn rope_that_enters_the_mouth_at_speed_is_let_through_nothing() {
    let skin = build_skin(&WhaleForm::right_whale(LENGTH_M));
    let places = clear_places(&open_mouth(&skin));
    let mut entered = 0;
    for (number, place) in places.iter().step_by(places.len() / 6).take(6).enumerate() {
        for speed_m_s in [3.0, 10.0] {
            let ahead = DVec3::new(0.5 * LENGTH_M + 0.1, 0.0, place.z);
            let came = across(
                &skin,
                ahead,
                [20.0, 200.0, 2000.0][number % 3],
                (speed_m_s, [9.0, 10.0]),
                2.0 / speed_m_s,
            );
            println!(
                "at {place:.2}, {speed_m_s} m/s: {:.2} m in, pressed {:?}, {:?}",
                came.aft_m, came.pressed, came.audit
            );
            assert!(came.audit.tunnelled == 0 && !came.pierced, "{place}: {:?}", came.audit);
            entered += u32::from(
                came.pressed.iter().any(|region| matches!(region, Region::Baleen | Region::Lips)),
            );
        }
    }
    assert!(entered > 4, "rope met baleen or lips {entered} times");
}
