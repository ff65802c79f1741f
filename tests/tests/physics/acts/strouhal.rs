//! The Strouhal number as swum: from the posed skin's fluke tips over several beats, not from the setting.

use endline_sdk::Controls;
use endline_sim::whale::{pose, skin_vertex};
use endline_sim::{DQuat, DVec3};

use crate::acts::flight::Flight;
use crate::linked::library;

/// Fluke tips over eight beats at a steady speed: frequency [Hz], way from top to bottom [m].
fn beat(length_m: f64, speed_m_s: f64, burst: f64) -> [f64; 2] {
    let library = library();
    let whale = library.whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap();
    let skin = endline_gear::whale::build_skin(&whale.form_at(length_m));
    let tip = (0..skin.vertices.len())
        .filter(|v| skin.vertices[*v].x < -0.4 * length_m)
        .max_by(|a, b| skin.vertices[*a].y.total_cmp(&skin.vertices[*b].y));
    let mut flight = Flight::new(None);
    (flight.length_m, flight.speed_m_s, flight.dt_s) = (length_m, speed_m_s, 0.02);
    flight.set(if burst > 0.0 { "burst_speed" } else { "cruise_speed" }, speed_m_s);
    let controls = Controls { speed: 1.0, burst, ..Controls::default() };
    let (mut bones, mut heights) = (Vec::new(), Vec::new());
    for _ in 0..1000 {
        flight.step(controls);
    }
    for _ in 0..6000 {
        let out = flight.step(controls);
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &out.posture, &mut bones);
        heights.push(skin_vertex(&skin, &bones, tip.unwrap()).z);
    }
    assert!((flight.speed_m_s - speed_m_s).abs() < 1e-3, "{} m/s", flight.speed_m_s);
    let mean = heights.iter().sum::<f64>() / heights.len() as f64;
    let rises: Vec<usize> =
        (1..heights.len()).filter(|i| heights[i - 1] < mean && heights[*i] >= mean).collect();
    let whole = &heights[rises[0]..rises[rises.len() - 1]];
    let ways = rises.windows(2).map(|pair| {
        let beat = &heights[pair[0]..pair[1]];
        beat.iter().fold(f64::MIN, |most, h| most.max(*h))
            - beat.iter().fold(f64::MAX, |least, h| least.min(*h))
    });
    let beats = (rises.len() - 1) as f64;
    [beats / (whole.len() as f64 * flight.dt_s), ways.sum::<f64>() / beats]
}

/// Migrating mothers 0.6 and 1.0, travel 0.9 and 1.5, filtering 1.1, mean 1.23, descent and skimming 1.4, ascent 1.46, top 2.6,
/// sprint 4 and 5 m/s; whales of 10 and 13.7 m, and a calf up to the top speed.
#[test]
fn at_every_speed_right_whales_swim_it_lies_between_0_2_and_0_4() {
    let cruise = [0.6, 0.9, 1.0, 1.1, 1.23, 1.4, 1.46, 1.5].map(|speed| (speed, 0.0));
    let sprint = [2.6, 4.0, 5.0].map(|speed| (speed, 1.0));
    for (length_m, sprints) in [(4.2, 1), (10.0, 3), (13.7, 3)] {
        for (speed_m_s, burst) in cruise.into_iter().chain(sprint.into_iter().take(sprints)) {
            let [frequency_hz, way_m] = beat(length_m, speed_m_s, burst);
            let strouhal = frequency_hz * way_m / speed_m_s;
            println!(
                "{length_m:5.1} m {speed_m_s:5.2} m/s: {frequency_hz:.3} Hz, {:.3} L, St {strouhal:.3}",
                way_m / length_m
            );
            assert!(
                (0.2..=0.4).contains(&strouhal),
                "{length_m} m at {speed_m_s} m/s: {frequency_hz} Hz, {way_m} m, St {strouhal}"
            );
        }
    }
}

/// Tagged right whales beat 0.14 Hz while filtering at 1.1 m/s and 0.13 Hz on the way up; peak to peak 0.2 of the length.
#[test]
fn the_beat_is_near_that_of_tagged_whales() {
    let [frequency_hz, way_m] = beat(13.0, 1.1, 0.0);
    assert!(
        (0.11..0.16).contains(&frequency_hz) && (0.17..0.27).contains(&(way_m / 13.0)),
        "{frequency_hz} Hz, {way_m} m"
    );
}
