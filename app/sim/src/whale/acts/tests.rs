//! Acts over a scripted motion.

use endline_sdk::{
    Act, BodyPart, Controls, Descriptor, HookError, MotionInput, MotionOutput, Posture, WhaleMotion,
};

use super::*;
use crate::whale::Angle;
use crate::whale::pose::angle_of;

/// Swims at the requested speed with a periodic fluke angle; has one float of state and one act.
struct Wag(Descriptor);

impl Wag {
    fn shared() -> Arc<Self> {
        let acts = vec![Act::new("own", "Own", "An act of its own.")];
        let (id, name, help) = ("test.wag".into(), "Wag".into(), "Wags.".into());
        Arc::new(Self(Descriptor {
            id,
            version: "1".into(),
            name,
            help,
            attributes: Vec::new(),
            state_len: 1,
            acts,
        }))
    }
}

impl WhaleMotion for Wag {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn step(
        &self,
        _: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        state[0] += input.dt_s;
        let mut posture = Posture { fluke_pitch: 0.2 * libm::sin(state[0]), ..Posture::default() };
        posture.jaw = 0.1 * input.controls.mouth + input.controls.act;
        Ok(MotionOutput {
            speed_m_s: input.controls.speed,
            turn_rate_rad_s: [0.0, 0.0, input.controls.yaw],
            posture,
        })
    }
}

const DT_S: f64 = 0.01;

fn track(moves: Moves, points: &[(f64, f64)]) -> Track {
    Track { moves, curve: Curve::through(points, false) }
}

fn clip(id: &str, tracks: Vec<Track>) -> Clip {
    Clip {
        id: id.into(),
        name: id.into(),
        help: String::new(),
        tracks,
        length_s: 4.0,
        after: After::Return,
        fade_s: 0.5,
        blend: Blend::Replace,
        turn_rate_rad_s: 0.2,
        side: Side::AsWritten,
        ends_at_touch: [false; BodyPart::ALL.len()],
    }
}

/// The act `left` in response to every contact above a force, again after a time.
fn answers(above_n: f64, again_s: f64) -> Answers {
    Answers { first: Some(2), above_n, again_s, drawn: None }
}

/// Acts 2 to 5; act 1 is that of the underlying motion.
fn acting(answers: Option<Answers>) -> Acting {
    let raise = |side| {
        track(Moves::Angle(Angle::FlipperRaise(side)), &[(0.0, 0.0), (1.0, 0.6), (4.0, 0.0)])
    };
    let touched = Clip {
        side: Side::Touched,
        ..clip("left", vec![raise(0), track(Moves::Turn(Turn::Roll), &[(0.0, 0.0), (4.0, 2.0)])])
    };
    let mirrored = Clip { id: "right".into(), side: Side::Mirrored, ..touched.clone() };
    let mut open = clip(
        "open",
        vec![
            track(Moves::Control(Control::Mouth), &[(0.0, 1.0)]),
            track(Moves::Angle(Angle::FlukePitch), &[(0.0, 0.3)]),
        ],
    );
    open.after = After::Hold;
    open.ends_at_touch[BodyPart::Head as usize] = true;
    let round = Clip {
        after: After::Repeat,
        ..clip("round", vec![track(Moves::Turn(Turn::Yaw), &[(0.0, 0.0), (4.0, 1.0)])])
    };
    Acting::new(Wag::shared(), vec![touched, mirrored, open, round], answers)
}

const LEFT: f64 = 2.0;
const RIGHT: f64 = 3.0;
const OPEN: f64 = 4.0;
const ROUND: f64 = 5.0;

/// Steps for a time, with the act and the part in contact as functions of time.
fn play(
    acting: &Acting,
    seconds: f64,
    act: impl Fn(f64) -> f64,
    touch: impl Fn(f64) -> Option<BodyPart>,
) -> Vec<MotionOutput> {
    let mut state = vec![0.0; acting.descriptor().state_len];
    (0..(seconds / DT_S).round() as usize)
        .map(|step| {
            let time_s = (step as f64 + 0.5) * DT_S;
            let mut forces = [0.0; BodyPart::ALL.len()];
            if let Some(part) = touch(time_s) {
                forces[part as usize] = 50.0;
            }
            let input = MotionInput {
                time_s,
                dt_s: DT_S,
                length_m: 10.0,
                speed_m_s: 1.0,
                position_m: [0.0; 3],
                orientation: [0.0, 0.0, 0.0, 1.0],
                controls: Controls { speed: 1.0, act: act(time_s), ..Controls::default() },
                contact_force_n: &forces,
                contact_port_m: &[0.0; BodyPart::ALL.len()],
                thrust_speed_m_s: None,
            };
            acting.step(&[], &input, &mut state).unwrap()
        })
        .collect()
}

fn none(_: f64) -> Option<BodyPart> {
    None
}

fn turned(out: &[MotionOutput], axis: usize) -> f64 {
    out.iter().map(|out| out.turn_rate_rad_s[axis] * DT_S).sum()
}

#[test]
fn without_an_act_the_output_of_the_underlying_motion_is_unchanged() {
    let (shown, wag) = (play(&acting(None), 3.0, |_| 0.0, none), Wag::shared());
    let mut state = [0.0];
    for out in shown {
        let forces = [0.0; BodyPart::ALL.len()];
        let input = MotionInput {
            time_s: 0.0,
            dt_s: DT_S,
            length_m: 10.0,
            speed_m_s: 1.0,
            position_m: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            controls: Controls { speed: 1.0, ..Controls::default() },
            contact_force_n: &forces,
            contact_port_m: &forces,
            thrust_speed_m_s: None,
        };
        assert_eq!(out, wag.step(&[], &input, &mut state).unwrap());
    }
}

/// Angles and turn of the clip, and the motion in every angle that the clip does not have.
#[test]
fn an_act_reaches_its_keys_and_its_turn_and_returns() {
    let out = play(&acting(None), 6.0, |_| LEFT, none);
    assert!(
        (out[99].posture.flipper_raise[0] - 0.6).abs() < 1e-9,
        "{}",
        out[99].posture.flipper_raise[0]
    );
    assert!(out.iter().all(|out| out.posture.flipper_raise[1].abs() < 1e-15));
    assert!((turned(&out[..400], 0) - 2.0).abs() < 1e-9, "{}", turned(&out, 0));
    assert!((turned(&out, 0) - 2.0).abs() < 1e-9, "{}: and no further", turned(&out, 0));
    assert!((out[250].posture.fluke_pitch - 0.2 * libm::sin(2.51)).abs() < 1e-12);
    assert!(
        out[599].posture.flipper_raise[0].abs() < 1e-15,
        "back, and not begun again while the pilot holds on"
    );
}

#[test]
fn the_mirror_image_moves_the_other_side_and_turns_the_other_way() {
    let (left, right) =
        (play(&acting(None), 5.0, |_| LEFT, none), play(&acting(None), 5.0, |_| RIGHT, none));
    for (left, right) in left.iter().zip(&right) {
        assert!((left.posture.flipper_raise[0] - right.posture.flipper_raise[1]).abs() < 1e-15);
        assert!((left.turn_rate_rad_s[0] + right.turn_rate_rad_s[0]).abs() < 1e-15);
    }
}

#[test]
fn the_end_of_the_request_ends_an_act_within_the_fade() {
    let out = play(&acting(None), 3.0, |time_s| if time_s < 1.0 { LEFT } else { 0.0 }, none);
    let raised = |index: usize| out[index].posture.flipper_raise[0];
    assert!(raised(99) > 0.59 && raised(124) > 0.1 && raised(124) < raised(99));
    assert!(
        out[151].posture.flipper_raise[0].abs() < 1e-15
            && out[151].turn_rate_rad_s[0].abs() < 1e-15
    );
}

/// Random changes of act: no angle changes in one step by more than the rates of clips and fades allow.
#[test]
fn no_angle_jumps_when_acts_change_often() {
    let wild = |time_s: f64| {
        [LEFT, OPEN, 0.0, RIGHT, 1.0, ROUND, OPEN, LEFT, 0.0][(time_s / 0.17) as usize % 9]
    };
    let out = play(&acting(None), 20.0, wild, none);
    // The steepest clip rises by 0.6 rad in 1 s, with at most 1.5 times the mean rate; a fade of at most 0.9 rad takes 0.5 s.
    let bound = (1.5 * 0.6 + 1.5 * 0.9 / 0.5 + 0.2) * DT_S;
    let mut most = 0.0_f64;
    for pair in out.windows(2) {
        for angle in Angle::all().filter(|angle| *angle != Angle::Jaw) {
            let of = |out: &MotionOutput| angle_of(&out.posture, angle);
            most = most.max((of(&pair[1]) - of(&pair[0])).abs());
        }
    }
    assert!(most < bound && most > 0.1 * bound, "{most} rad in a step, {bound} allowed");
}

#[test]
fn the_response_is_on_the_side_of_the_contact() {
    let answer = Some(answers(10.0, f64::INFINITY));
    for (part, side) in [(BodyPart::LeftFlipper, 0), (BodyPart::RightFluke, 1)] {
        let out =
            play(&acting(answer.clone()), 12.0, |_| 0.0, |time_s| (time_s > 2.0).then_some(part));
        assert!(out[199].posture.flipper_raise[side].abs() < 1e-15, "nothing before the touch");
        assert!(
            out[300].posture.flipper_raise[side] > 0.59
                && out[300].posture.flipper_raise[1 - side].abs() < 1e-15
        );
        let roll = turned(&out, 0);
        assert!((roll.abs() - 2.0).abs() < 1e-2 && (roll > 0.0) == (side == 0), "once, {roll} rad");
    }
}

#[test]
fn continuing_contact_repeats_the_response_if_set_and_new_contact_always() {
    let again = |again_s| acting(Some(answers(10.0, again_s)));
    let touch = |_: f64| Some(BodyPart::LeftFlipper);
    assert!((turned(&play(&again(6.0), 17.9, |_| 0.0, touch), 0) / 2.0 - 3.0).abs() < 0.05);
    let twice = |time_s: f64| (!(2.0..6.0).contains(&time_s)).then_some(BodyPart::LeftFlipper);
    assert!(
        (turned(&play(&again(f64::INFINITY), 15.0, |_| 0.0, twice), 0) / 2.0 - 2.0).abs() < 0.05
    );
    let weak = acting(Some(answers(60.0, 1.0)));
    assert!(turned(&play(&weak, 8.0, |_| 0.0, touch), 0).abs() < 1e-15, "50 N are below 60");
}

/// Drawn responses: the first as given, none before the whale is held, and then by the part that is pressed.
#[test]
fn drawn_responses_follow_the_state_of_the_whale() {
    let drawn = |acts: [Vec<(usize, f64)>; 3], shares: Vec<f64>| {
        let drawn = Some(DrawnAnswers { acts, held_after_s: 10.0, shares });
        acting(Some(Answers { first: Some(2), above_n: 10.0, again_s: 6.0, drawn }))
    };
    let always = |act| vec![(act, 1.0)];
    let by_mouth = drawn([always(0), always(2), always(0)], vec![0.5]);
    let rolls = |acting: &Acting, seconds, part| {
        (turned(&play(acting, seconds, |_| 0.0, |_| Some(part)), 0) / 2.0).round() as i64
    };
    // At 0 s the first response, at 6 s none, at 12 and 18 s those of a whale held by the mouth.
    for (seconds, expected) in [(5.5, 1), (11.5, 1), (17.5, 2), (23.5, 3)] {
        assert_eq!(rolls(&by_mouth, seconds, BodyPart::Head), expected, "{seconds} s");
    }
    assert_eq!(rolls(&by_mouth, 23.5, BodyPart::Peduncle), 1);
    // Two of seven of the responses from 12 to 1,200 s of a whale held by a fin, with evenly spaced numbers, and the first.
    let shares: Vec<f64> = (0..7).map(|step| (f64::from(step * 3 % 7) + 0.5) / 7.0).collect();
    let by_fin = drawn([always(0), always(0), vec![(0, 5.0 / 7.0), (2, 1.0)]], shares);
    let found = rolls(&by_fin, 1205.0, BodyPart::LeftFlipper);
    assert!((56..=60).contains(&found), "{found} rolls");
}

/// Contact that returns within the interval is not answered again if responses are drawn.
#[test]
fn contact_that_returns_is_answered_at_most_once_in_an_interval() {
    let drawn = Some(DrawnAnswers {
        acts: [vec![(2, 1.0)], vec![(0, 1.0)], vec![(0, 1.0)]],
        held_after_s: 10.0,
        shares: vec![0.0],
    });
    let acting = acting(Some(Answers { first: None, above_n: 10.0, again_s: 20.0, drawn }));
    let often = |time_s: f64| (time_s % 3.0 < 0.5).then_some(BodyPart::Body);
    let found = turned(&play(&acting, 59.0, |_| 0.0, often), 0) / 2.0;
    assert!((found - 3.0).abs() < 0.1, "at 0, 21 and 42 s");
}

/// A held act ends at contact with a part of its list; its control is then the pilot's again.
#[test]
fn an_act_ends_at_contact_with_its_parts() {
    let mouth = |out: &MotionOutput| out.posture.jaw;
    let flipper = play(
        &acting(None),
        9.0,
        |_| OPEN,
        |time_s| (time_s > 2.0).then_some(BodyPart::LeftFlipper),
    );
    assert!(flipper.iter().skip(60).all(|out| (mouth(out) - 0.1).abs() < 1e-12));
    let head = play(
        &acting(None),
        9.0,
        |_| OPEN,
        |time_s| (2.0..3.0).contains(&time_s).then_some(BodyPart::Head),
    );
    assert!(
        (mouth(&head[199]) - 0.1).abs() < 1e-12
            && mouth(&head[300]).abs() < 1e-12
            && mouth(&head[899]).abs() < 1e-12
    );
}

#[test]
fn the_turn_of_a_repeated_act_accumulates() {
    let out = play(&acting(None), 20.0, |_| ROUND, none);
    assert!(
        (turned(&out, 2) - 5.0).abs() < 1e-3,
        "{}: the full turn except for the effect of the fade on the first step",
        turned(&out, 2)
    );
}

#[test]
fn acts_of_the_underlying_motion_are_passed_on_and_unknown_ones_are_errors() {
    let acting = acting(None);
    let ids: Vec<&str> = acting.descriptor().acts.iter().map(|act| act.id.as_ref()).collect();
    assert_eq!(ids, ["own", "left", "right", "open", "round"]);
    let jaw = |act: f64| play(&acting, 0.1, |_| act, none)[9].posture.jaw;
    assert!(
        (jaw(1.0) - 1.0).abs() < 1e-15 && jaw(LEFT).abs() < 1e-15,
        "beneath sees its own act alone"
    );
    let mut state = vec![0.0; acting.descriptor().state_len];
    let input = MotionInput {
        time_s: 0.0,
        dt_s: DT_S,
        length_m: 10.0,
        speed_m_s: 1.0,
        position_m: [0.0; 3],
        orientation: [0.0, 0.0, 0.0, 1.0],
        controls: Controls { act: 6.0, ..Controls::default() },
        contact_force_n: &[0.0; BodyPart::ALL.len()],
        contact_port_m: &[0.0; BodyPart::ALL.len()],
        thrust_speed_m_s: None,
    };
    assert!(
        acting.step(&[], &input, &mut state).unwrap_err().message.contains("there is no act 6")
    );
}

#[test]
fn floats_are_read_as_they_were_written() {
    let mut state: Vec<f64> = (0..LEN).map(|index| 0.25 + index as f64).collect();
    (state[0], state[2], state[3], state[6]) = (3.0, 1.0, 7.0, 5.0);
    let before = state.clone();
    let floats = Floats::read(&state).unwrap();
    state.fill(0.0);
    floats.write(&mut state);
    assert_eq!(state, before);
    assert!(Floats::read(&state[1..]).unwrap_err().message.contains("floats for acts"));
}
