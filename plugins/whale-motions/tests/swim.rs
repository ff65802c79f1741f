//! The swim, measured from its output: speeds, turn rates and joint angles.
#![expect(clippy::unwrap_used, reason = "helpers of tests: an error in one fails its test")]

use endline_sdk::{
    BodyPart, Controls, FLUKE_STATION, MotionInput, MotionOutput, Posture, SPINE_STATIONS,
    WhaleMotion,
};
use endline_whale_motions::Swim;

const LENGTH_M: f64 = 13.7;

fn attributes() -> Vec<f64> {
    Swim::new()
        .descriptor()
        .attributes
        .iter()
        .map(|attribute| attribute.default_value().number().unwrap())
        .collect()
}

fn attribute(key: &str) -> f64 {
    let index = Swim::new()
        .descriptor()
        .attributes
        .iter()
        .position(|attribute| attribute.key == key)
        .unwrap();
    attributes()[index]
}

/// Swims for a time with these controls; returns the output of every step.
fn swim(
    seconds: f64,
    dt_s: f64,
    start_m_s: f64,
    controls: impl Fn(f64) -> Controls,
) -> Vec<MotionOutput> {
    let (motion, attributes) = (Swim::new(), attributes());
    let mut state = vec![0.0; motion.descriptor().state_len];
    let mut speed_m_s = start_m_s;
    let steps = (seconds / dt_s).round() as usize;
    let mut step = |index: usize| {
        let time_s = index as f64 * dt_s;
        let input = MotionInput {
            time_s,
            dt_s,
            length_m: LENGTH_M,
            speed_m_s,
            position_m: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls: controls(time_s),
            contact_force_n: &[0.0; BodyPart::ALL.len()],
            contact_port_m: &[0.0; BodyPart::ALL.len()],
            thrust_speed_m_s: None,
        };
        let out = motion.step(&attributes, &input, &mut state).unwrap();
        speed_m_s = out.speed_m_s;
        out
    };
    (0..steps).map(&mut step).collect()
}

fn forward() -> Controls {
    Controls { speed: 1.0, ..Controls::default() }
}

/// First spine joint aft of mid-body, where the whale's frame is.
const AFT: usize = 3;

/// Heights of the spine joints aft of mid-body, of the flukes' hinge and of the notch [m], and the
/// flukes' own pitch (trailing edge down) [rad], by the chain of joints aft.
fn heights(posture: &Posture) -> (Vec<f64>, f64) {
    let (mut z, mut pitch, mut heights) = (0.0, 0.0, vec![0.0]);
    for (joint, angle) in posture.spine_pitch.iter().enumerate().skip(AFT) {
        pitch += angle;
        let next = SPINE_STATIONS.get(joint + 1).copied().unwrap_or(FLUKE_STATION);
        z -= LENGTH_M * (next - SPINE_STATIONS[joint]) * libm::sin(pitch);
        heights.push(z);
    }
    pitch += posture.fluke_pitch;
    heights.push(z - LENGTH_M * (1.0 - FLUKE_STATION) * libm::sin(pitch));
    (heights, pitch)
}

/// Height of the snout [m], by the chain of joints ahead.
fn snout_height(posture: &Posture) -> f64 {
    let (mut z, mut rise) = (0.0, 0.0);
    for joint in (0..AFT).rev() {
        rise += posture.spine_pitch[joint];
        let next = if joint == 0 { 0.0 } else { SPINE_STATIONS[joint - 1] };
        z -= LENGTH_M * (SPINE_STATIONS[joint] - next) * libm::sin(rise);
    }
    z
}

/// Places in [`heights`].
const HINGE: usize = SPINE_STATIONS.len() - AFT;
const NOTCH: usize = HINGE + 1;

fn span(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
}

/// Frequency from rising zero crossings [Hz].
fn frequency(values: &[f64], dt_s: f64) -> f64 {
    let rises: Vec<usize> =
        (1..values.len()).filter(|i| values[i - 1] < 0.0 && values[*i] >= 0.0).collect();
    (rises.len() - 1) as f64 / ((rises[rises.len() - 1] - rises[0]) as f64 * dt_s)
}

#[test]
fn strouhal_number_lies_where_swimmers_keep_it() {
    for (speed, burst, wanted_m_s) in
        [(1.0, 0.0, 1.23), (0.5, 0.0, 0.615), (0.15, 0.0, 0.1845), (1.0, 1.0, 4.5)]
    {
        let controls = Controls { speed, burst, ..Controls::default() };
        let out = swim(160.0, 0.01, 1.0, |_| controls);
        let steady = &out[4000..];
        let u = steady[0].speed_m_s;
        assert!((u - wanted_m_s).abs() < 1e-6, "{u}");
        let tail: Vec<f64> = steady.iter().map(|out| heights(&out.posture).0[HINGE]).collect();
        let (f, a) = (frequency(&tail, 0.01), span(tail.iter().copied()));
        let strouhal = f * a / u;
        assert!((0.2..=0.4).contains(&strouhal), "St {strouhal} with f {f} Hz, A {a} m, U {u} m/s");
    }
}

#[test]
fn cruise_beat_is_that_of_a_foraging_right_whale() {
    let out = swim(120.0, 0.01, 1.23, |_| forward());
    let notch: Vec<f64> = out[3000..].iter().map(|out| heights(&out.posture).0[NOTCH]).collect();
    let f = frequency(&notch, 0.01);
    assert!((0.12..0.15).contains(&f), "0.13 to 0.14 Hz were tagged, here {f}");
    let excursion = span(notch.iter().copied()) / LENGTH_M;
    assert!((0.15..0.25).contains(&excursion), "peak to peak about 0.2 L, here {excursion}");
    let head = span(out[3000..].iter().map(|out| snout_height(&out.posture))) / LENGTH_M;
    assert!((0.03..0.05).contains(&head), "the head heaves about a fifth as far, here {head}");
}

#[test]
fn wave_runs_from_head_to_tail_and_grows() {
    let out = swim(60.0, 0.01, 1.23, |_| forward());
    let period = (1.0 / 0.1347 / 0.01) as usize;
    let late: Vec<Vec<f64>> =
        out[4000..4000 + 2 * period].iter().map(|out| heights(&out.posture).0).collect();
    let mut last_crest = 0;
    for station in 1..=HINGE {
        let mean = late[..period].iter().map(|h| h[station]).sum::<f64>() / period as f64;
        assert!(mean.abs() < 0.02 * LENGTH_M);
        let from = last_crest;
        let crest = (from..from + period)
            .max_by(|a, b| late[*a][station].total_cmp(&late[*b][station]))
            .unwrap();
        if station > 1 {
            assert!(
                crest > last_crest && crest - last_crest < period / 2,
                "station {station}: crest at {crest} after {last_crest}"
            );
            assert!(
                span(late.iter().map(|h| h[station])) > span(late.iter().map(|h| h[station - 1]))
            );
        }
        last_crest = if station == 1 { crest % period } else { crest };
    }
}

#[test]
fn flukes_push_water_back_on_both_strokes() {
    let out = swim(60.0, 0.01, 1.23, |_| forward());
    let (mut product, mut heave_square, mut pitch_square) = (0.0, 0.0, 0.0);
    for pair in out[3000..].windows(2) {
        let (before, (after, pitch)) =
            (heights(&pair[0].posture).0[HINGE], heights(&pair[1].posture));
        let heave = after[HINGE] - before;
        product += heave * pitch;
        heave_square += heave * heave;
        pitch_square += pitch * pitch;
    }
    let correlation = product / (heave_square * pitch_square).sqrt();
    assert!(correlation > 0.9, "trailing edge down as the flukes rise: {correlation}");
    let amplitude = (2.0 * pitch_square / out[3000..].len() as f64).sqrt().to_degrees();
    assert!((20.0..35.0).contains(&amplitude), "pitch amplitude {amplitude} degrees");
}

fn angles(posture: &Posture) -> Vec<f64> {
    let mut all = vec![posture.fluke_pitch, posture.jaw];
    for part in [&posture.spine_pitch[..], &posture.spine_yaw, &posture.fluke_flex] {
        all.extend_from_slice(part);
    }
    for part in [&posture.flipper_sweep, &posture.flipper_raise, &posture.flipper_twist] {
        all.extend_from_slice(part);
    }
    all
}

fn greatest_jump(out: &[MotionOutput]) -> f64 {
    let jump = |pair: &[MotionOutput]| {
        let (a, b) = (angles(&pair[0].posture), angles(&pair[1].posture));
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    out.windows(2).map(jump).fold(0.0, f64::max)
}

/// Controls that jump every 1.7 s between their limits.
fn wild(time_s: f64) -> Controls {
    let beat = (time_s / 1.7) as u64;
    let sign = |bit: u64| if ((beat * 2_654_435_761) >> bit) & 1 == 0 { -1.0 } else { 1.0 };
    Controls {
        speed: f64::max(sign(3), 0.0),
        pitch: sign(4),
        roll: sign(5),
        yaw: sign(6),
        burst: f64::max(sign(7), 0.0),
        mouth: f64::max(sign(8), 0.0),
        flipper_raise: sign(9),
        flipper_twist: sign(10),
        flipper_sweep: sign(11),
        act: 0.0,
    }
}

#[test]
fn posture_is_continuous_whatever_the_pilot_does() {
    let coarse = greatest_jump(&swim(60.0, 0.01, 1.0, wild));
    let fine = greatest_jump(&swim(60.0, 0.0025, 1.0, wild));
    assert!(coarse < 0.05, "{coarse} rad in 10 ms");
    assert!(fine < 0.3 * coarse, "a jump does not shrink with the step: {coarse} then {fine}");
}

#[test]
fn speed_keeps_its_limits() {
    let out = swim(60.0, 0.01, 0.0, wild);
    let (most, faster, slower) =
        (attribute("burst_speed"), attribute("acceleration"), attribute("braking"));
    for pair in out.windows(2) {
        let rate = (pair[1].speed_m_s - pair[0].speed_m_s) / 0.01;
        assert!(rate <= faster + 1e-9 && rate >= -slower - 1e-9, "{rate} m/s²");
        assert!((0.0..=most).contains(&pair[1].speed_m_s));
    }
    let rates = [attribute("roll_rate"), attribute("pitch_rate"), attribute("yaw_rate")];
    for out in &out {
        assert!(
            out.turn_rate_rad_s.iter().zip(rates).all(|(rate, most)| rate.abs() <= most + 1e-12)
        );
    }
}

/// Velocity of a point of the whale by the turn rate: `omega x point`.
fn carried(out: &MotionOutput, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = out.turn_rate_rad_s;
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

#[test]
fn turns_go_the_way_the_controls_say() {
    let after = |controls: Controls| *swim(10.0, 0.01, 1.0, |_| controls).last().unwrap();
    let (snout, port_side) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let to_port = after(Controls { yaw: 1.0, ..forward() });
    assert!(
        (carried(&to_port, snout)[1] - 10_f64.to_radians()).abs() < 1e-6,
        "snout to port at 10 degrees a second"
    );
    assert!(
        to_port.posture.spine_yaw.iter().all(|angle| *angle < 0.0),
        "tail to port, the turn's inside"
    );
    assert!(
        to_port.posture.flipper_sweep[0] < to_port.posture.flipper_sweep[1],
        "inner flipper further forward"
    );
    let to_starboard = after(Controls { yaw: -1.0, ..forward() });
    assert!(
        carried(&to_starboard, snout)[1] < 0.0
            && to_starboard.posture.flipper_sweep[1] < to_starboard.posture.flipper_sweep[0]
    );
    let nose_up = after(Controls { pitch: 1.0, ..forward() });
    assert!(carried(&nose_up, snout)[2] > 0.0);
    let level = after(forward());
    let bend = |out: &MotionOutput| out.posture.spine_pitch.iter().sum::<f64>();
    assert!(bend(&nose_up) < bend(&level), "tail bends up, the turn's inside");
    assert!(nose_up.posture.flipper_twist.iter().all(|twist| *twist < 0.0), "leading edges up");
    let roll = after(Controls { roll: 1.0, ..forward() });
    assert!(carried(&roll, port_side)[2] > 0.0, "rolling to starboard lifts the port side");
    assert!(roll.posture.flipper_twist[0] < 0.0 && roll.posture.flipper_twist[1] > 0.0);
}

#[test]
fn a_glide_reaches_the_rest_posture() {
    let out = swim(
        40.0,
        0.01,
        1.0,
        |time_s| if time_s < 15.0 { wild(time_s) } else { Controls::default() },
    );
    assert!(angles(&out[1400].posture).iter().any(|angle| angle.abs() > 0.1));
    let rest = angles(&out.last().unwrap().posture);
    assert!(rest.iter().all(|angle| angle.abs() < 1e-6), "{rest:?}");
}

#[test]
fn mouth_and_flippers_take_their_time() {
    let controls =
        Controls { mouth: 1.0, flipper_raise: 1.0, flipper_sweep: 1.0, ..Controls::default() };
    let out = swim(4.0, 0.01, 0.0, |_| controls);
    let (half, whole) = (out[99].posture.jaw, out[399].posture.jaw);
    assert!(
        (whole - attribute("jaw_open")).abs() < 1e-12 && (half / whole - 0.5).abs() < 1e-6,
        "{half} of {whole}"
    );
    assert!(
        out[99].posture.flipper_raise.iter().all(|raise| (raise.to_degrees() - 25.0).abs() < 0.1),
        "tips up, as far as the joint turns"
    );
    let forward = -40_f64.to_radians();
    assert!(
        out[399].posture.flipper_sweep.iter().all(|sweep| (sweep - forward).abs() < 0.01),
        "forward to the end of their range"
    );
    let aft = swim(4.0, 0.01, 0.0, |_| Controls { flipper_sweep: -1.0, ..Controls::default() });
    assert!(aft[399].posture.flipper_sweep.iter().all(|sweep| *sweep > 0.5), "and aft");
}

#[test]
fn wrong_lengths_and_bad_steps_are_errors() {
    let input = MotionInput {
        time_s: 0.0,
        dt_s: f64::NAN,
        length_m: LENGTH_M,
        speed_m_s: 1.0,
        position_m: [0.0; 3],
        orientation: [0.0, 0.0, 0.0, 1.0],
        controls: forward(),
        contact_force_n: &[0.0; BodyPart::ALL.len()],
        contact_port_m: &[0.0; BodyPart::ALL.len()],
        thrust_speed_m_s: None,
    };
    let motion = Swim::new();
    let mut state = vec![0.0; motion.descriptor().state_len];
    assert!(motion.step(&attributes(), &input, &mut state).unwrap_err().message.contains("NaN"));
    let input = MotionInput { dt_s: 0.01, ..input };
    assert!(
        motion
            .step(&attributes()[1..], &input, &mut state)
            .unwrap_err()
            .message
            .contains("17 attribute values")
    );
    assert!(
        motion
            .step(&attributes(), &input, &mut state[1..])
            .unwrap_err()
            .message
            .contains("floats of state")
    );
}

/// A kinetic whale's flukes move as fast as those of a free whale at the speed at which its drag equals the thrust.
#[test]
fn the_beat_follows_the_thrust() {
    let run = |speed_m_s: f64, thrust_speed_m_s: Option<f64>| {
        let (motion, attributes) = (Swim::new(), attributes());
        let mut state = vec![0.0; motion.descriptor().state_len];
        let tail: Vec<f64> = (0..12_000)
            .map(|index| {
                let input = MotionInput {
                    time_s: f64::from(index) * 0.01,
                    dt_s: 0.01,
                    length_m: LENGTH_M,
                    speed_m_s,
                    position_m: [0.0; 3],
                    orientation: [0.0, 0.0, 0.0, 1.0],
                    controls: forward(),
                    contact_force_n: &[0.0; BodyPart::ALL.len()],
                    contact_port_m: &[0.0; BodyPart::ALL.len()],
                    thrust_speed_m_s,
                };
                heights(&motion.step(&attributes, &input, &mut state).unwrap().posture).0[HINGE]
            })
            .collect();
        tail[4000..].to_vec()
    };
    let way_m = |tail: &[f64]| span(tail.iter().copied());
    let flukes_m_s = |tail: &[f64]| frequency(tail, 0.01) * way_m(tail);
    let free = flukes_m_s(&run(1.23, None));
    assert!(
        (flukes_m_s(&run(1.23, Some(1.23))) / free - 1.0).abs() < 1e-3,
        "without gear nothing changes"
    );
    let held = flukes_m_s(&run(0.0, Some(2.46)));
    assert!(
        (held / free - 2.0).abs() < 0.01,
        "held fast, with the thrust of 2.46 m/s: {held} of {free}"
    );
    assert!(way_m(&run(1.0, Some(0.0))) < 1e-9, "without thrust the flukes are still");
}
