//! Answers to touch: which way the whale goes, and what touch ends.

use endline_sdk::{BodyPart, Controls, MotionOutput};

use crate::acts::flight::Flight;

/// Swims, is touched on a part for a second, and swims on.
fn touch(answer: &str, part: BodyPart, seconds: f64) -> (Vec<MotionOutput>, Flight) {
    touch_at(answer, (part, 0.0), seconds)
}

/// Like [`touch`], with the place of the touch, to port of the midplane [m].
fn touch_at(
    answer: &str,
    (part, port_m): (BodyPart, f64),
    seconds: f64,
) -> (Vec<MotionOutput>, Flight) {
    let mut flight = Flight::new(Some(answer));
    flight.port_m[part as usize] = port_m;
    flight.play("", 5.0);
    flight.forces[part as usize] = 30.0;
    let mut out = flight.play("", 1.0);
    flight.forces = [0.0; BodyPart::ALL.len()];
    out.extend(flight.play("", seconds - 1.0));
    (out, flight)
}

fn turned(out: &[MotionOutput], axis: usize) -> f64 {
    out.iter().map(|out| out.turn_rate_rad_s[axis] * 0.01).sum::<f64>().to_degrees()
}

/// Roll to starboard lifts the port side: away from a touch on port.
#[test]
fn roll_away_lifts_the_touched_side_and_roll_toward_lowers_it() {
    for (part, port) in [
        (BodyPart::LeftFlipper, 1.0),
        (BodyPart::RightFlipper, -1.0),
        (BodyPart::LeftFluke, 1.0),
        (BodyPart::RightFluke, -1.0),
    ] {
        let away = turned(&touch("roll-away", part, 7.0).0, 0);
        let toward = turned(&touch("roll-toward", part, 7.0).0, 0);
        assert!(
            (away - port * 150.0).abs() < 1.0 && (toward + port * 150.0).abs() < 1.0,
            "{part:?}: {away} and {toward} degrees"
        );
        let (whole, flight) = touch("roll-away", part, 20.0);
        assert!(
            turned(&whole, 0).abs() < 0.5 && flight.attitude()[1].abs() < 1.0,
            "it rights itself"
        );
    }
}

/// A roll that goes all the way round winds rope on, because it is never undone; no faster than a humpback's corkscrew.
#[test]
fn a_barrel_roll_away_or_toward_is_one_whole_turn_and_is_not_undone() {
    for (part, port) in [(BodyPart::LeftFlipper, 1.0), (BodyPart::RightFlipper, -1.0)] {
        for (answer, sign) in [("barrel-roll-away", port), ("barrel-roll-toward", -port)] {
            let (out, flight) = touch(answer, part, 25.0);
            let rolled = turned(&out, 0);
            assert!(
                (rolled - sign * 360.0).abs() < 1.0,
                "{answer} from {part:?}: {rolled} degrees"
            );
            assert!(flight.attitude()[1].abs() < 1.0, "{answer} from {part:?}: belly down again");
            let fastest = out.iter().map(|out| out.turn_rate_rad_s[0] * sign).fold(0.0, f64::max);
            let back = out.iter().map(|out| out.turn_rate_rad_s[0] * sign).fold(0.0, f64::min);
            assert!(fastest < 0.75 && back > -1e-3, "{answer}: {back} to {fastest} rad/s");
        }
    }
}

/// Rope on head, body or peduncle: the side is where it lies, and the touch before does not count.
#[test]
fn a_touch_of_head_body_or_peduncle_has_the_side_where_it_lies() {
    for (part, port_m) in [
        (BodyPart::Head, 0.6),
        (BodyPart::Head, -0.6),
        (BodyPart::Body, -1.2),
        (BodyPart::Peduncle, 0.2),
    ] {
        let (out, mut flight) = touch_at("roll-away", (part, port_m), 30.0);
        let away = turned(&out[..700], 0);
        assert!(
            (away - port_m.signum() * 150.0).abs() < 1.0,
            "{part:?} at {port_m} m: {away} degrees"
        );
        flight.port_m[part as usize] = -port_m;
        flight.forces[part as usize] = 30.0;
        let other = turned(&flight.play("", 7.0), 0);
        assert!(
            (other + port_m.signum() * 150.0).abs() < 1.0,
            "{part:?} at {} m: {other} degrees",
            -port_m
        );
    }
}

#[test]
fn turn_away_and_bolt_leave_the_touched_side_behind() {
    for (part, port) in [(BodyPart::LeftFlipper, 1.0), (BodyPart::RightFlipper, -1.0)] {
        for (answer, least) in [("turn-away", 40.0), ("bolt", 10.0)] {
            let yaw = turned(&touch(answer, part, 9.0).0, 2);
            assert!(-port * yaw > least, "{answer} from {part:?}: {yaw} degrees to port");
        }
    }
}

#[test]
fn the_touched_flipper_thrashes_and_the_other_does_not() {
    for (part, side) in [(BodyPart::LeftFlipper, 0), (BodyPart::RightFlipper, 1)] {
        let (out, _) = touch("thrash-flipper", part, 7.0);
        let swing = |side: usize| {
            let raise = out.iter().map(|out| out.posture.flipper_raise[side].to_degrees());
            raise.clone().fold(f64::MIN, f64::max) - raise.fold(f64::MAX, f64::min)
        };
        assert!(
            swing(side) > 70.0 && swing(1 - side) < 10.0,
            "{part:?}: {} and {}",
            swing(side),
            swing(1 - side)
        );
    }
}

/// A whale that skims and meets rope with its head closes its mouth in the time the swim gives it, and keeps it closed.
#[test]
fn the_mouth_closes_at_a_touch_of_the_head() {
    for id in ["skim-feed", "skim-feed-on-right-side"] {
        let mut flight = Flight::new(None);
        let open = *flight.play(id, 20.0).last().unwrap();
        assert!(
            open.posture.jaw.to_degrees() > 10.0 && open.posture.lips[0].to_degrees() > 15.0,
            "{id}"
        );
        flight.forces[BodyPart::LeftFlipper as usize] = 30.0;
        assert!(
            flight.play(id, 3.0).last().unwrap().posture.jaw.to_degrees() > 10.0,
            "{id}: rope on a flipper does not close it"
        );
        flight.forces[BodyPart::Head as usize] = 30.0;
        flight.play(id, 0.1);
        flight.forces = [0.0; BodyPart::ALL.len()];
        let closed = *flight.play(id, 2.2).last().unwrap();
        assert!(
            closed.posture.jaw.abs() < 1e-9 && closed.posture.lips[0].abs() < 1e-9,
            "{id}: {:?}",
            closed.posture.jaw
        );
        assert!(
            flight.play(id, 10.0).last().unwrap().posture.jaw.abs() < 1e-9,
            "{id}: while the pilot still asks"
        );
    }
}

/// The pilot steers through an act, and another act or none breaks an answer off.
#[test]
fn the_pilot_steers_all_the_while_and_can_break_off() {
    let mut flight = Flight::new(None);
    let controls =
        Controls { speed: 1.0, yaw: 1.0, act: flight.act("flippers-tuck"), ..Controls::default() };
    for _ in 0..600 {
        flight.step(controls);
    }
    assert!(flight.attitude()[0] > 30.0, "{} degrees to port", flight.attitude()[0]);
    let mut flight = Flight::new(Some("roll-away"));
    flight.play("", 2.0);
    flight.forces[BodyPart::LeftFlipper as usize] = 30.0;
    flight.play("", 2.0);
    let out = flight.play("level", 12.0);
    assert!(
        flight.attitude()[1].abs() < 2.0 && turned(&out, 0) < 20.0,
        "bank {} degrees",
        flight.attitude()[1]
    );
}
