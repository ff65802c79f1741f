//! Where acts take the whale: how far it turns, to which attitude, at which rates.

use endline_sim::whale::Angle;
use endline_sim::whale::acts::{After, Moves};
use endline_sim::whale::pose::angle_of;

use crate::acts::flight::{Flight, clips};

/// Rate of turn of a humpback's corkscrew, the fastest measured of a large whale [rad/s].
const CORKSCREW_RAD_S: f64 = 0.75;

#[test]
fn a_barrel_roll_turns_once_round_in_its_stated_time() {
    for (id, sign) in [("barrel-roll", 1.0), ("barrel-roll-port", -1.0)] {
        let mut flight = Flight::new(None);
        flight.play("", 5.0);
        let out = flight.play(id, 16.0);
        let rolled: f64 = out.iter().map(|out| out.turn_rate_rad_s[0] * flight.dt_s).sum();
        assert!(
            (rolled.to_degrees() - sign * 360.0).abs() < 0.5,
            "{id}: {} degrees",
            rolled.to_degrees()
        );
        let half: f64 = out[..800].iter().map(|out| out.turn_rate_rad_s[0] * flight.dt_s).sum();
        assert!(
            (half.to_degrees() - sign * 180.0).abs() < 5.0,
            "{id}: {} degrees half way",
            half.to_degrees()
        );
        let rates: Vec<f64> =
            out.iter().map(|out| sign * out.turn_rate_rad_s[0].to_degrees()).collect();
        assert!(rates.iter().all(|rate| (-0.1..43.0).contains(rate)) && rates[800] > 30.0);
        let [heading, bank, climb] = flight.attitude();
        assert!(
            heading.abs() < 0.5 && bank.abs() < 0.5 && climb.abs() < 0.5,
            "{heading} {bank} {climb}"
        );
        let after: f64 =
            flight.play("", 10.0).iter().map(|out| out.turn_rate_rad_s[0].abs() * 0.01).sum();
        assert!(after.to_degrees() < 0.5, "{} degrees after it", after.to_degrees());
    }
}

/// Pitches of tagged foraging dives, and bank of whales that feed on their side or lie on their back.
#[test]
fn attitudes_are_reached_and_kept_while_the_pilot_holds_on() {
    for (id, bank, climb) in [
        ("descent", 0.0, -58.0),
        ("ascent", 0.0, 54.0),
        ("skim-feed", 0.0, 0.0),
        ("skim-feed-on-right-side", 90.0, 0.0),
        ("skim-feed-on-left-side", -90.0, 0.0),
        ("belly-up", 180.0, 0.0),
        ("tail-lift", 0.0, -80.0),
        ("level", 0.0, 0.0),
    ] {
        let mut flight = Flight::new(None);
        flight.orientation =
            endline_sim::DQuat::from_rotation_y(0.2) * endline_sim::DQuat::from_rotation_x(0.3);
        flight.play(id, 30.0);
        let now = flight.attitude();
        let off = (now[1] - bank).rem_euclid(360.0);
        assert!(off.min(360.0 - off) < 1.0, "{id}: bank {}", now[1]);
        assert!((now[2] - climb).abs() < 1.0, "{id}: climb {}", now[2]);
    }
}

/// Every act, on top of the swim: its own angles reach the values of its file, turn rates stay below what was measured of a
/// large whale, and once let go the whale swims as if there had been no act.
#[test]
fn every_act_reaches_its_angles_keeps_its_rates_and_returns_to_the_swim() {
    for clip in clips() {
        let mut flight = Flight::new(None);
        flight.play("", 10.0);
        let lasts = if clip.after == After::Return {
            clip.length_s
        } else {
            clip.length_s + 2.0 * clip.fade_s + 4.0
        };
        let out = flight.play(&clip.id, lasts);
        for out in &out {
            let fastest =
                out.turn_rate_rad_s.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
            assert!(fastest < CORKSCREW_RAD_S, "{}: {fastest} rad/s", clip.id);
        }
        if clip.after == After::Hold {
            let swim = out.last().unwrap();
            let held = clip.posture(lasts, false, &swim.posture);
            for track in &clip.tracks {
                let Moves::Angle(moved) = track.moves else { continue };
                let (shown, wanted) = (angle_of(&swim.posture, moved), angle_of(&held, moved));
                let mirror = angle_of(&clip.posture(lasts, true, &swim.posture), moved);
                assert!(
                    (shown - wanted).abs() < 1e-9 || (shown - mirror).abs() < 1e-9,
                    "{} {moved:?}: {shown} for {wanted}",
                    clip.id
                );
            }
        }
        let last = *flight.play("", 25.0).last().unwrap();
        let never = *Flight::new(None).play("", 60.0).last().unwrap();
        let beats = |angle: &Angle| {
            matches!(angle, Angle::SpinePitch(_) | Angle::FlukePitch | Angle::FlukeFlex(_))
        };
        for angle in Angle::all().filter(|angle| !beats(angle)) {
            let (shown, swims) = (angle_of(&last.posture, angle), angle_of(&never.posture, angle));
            assert!(
                (shown - swims).abs() < 1e-6,
                "{} {angle:?}: {shown}, swimming {swims}",
                clip.id
            );
        }
        assert!(last.turn_rate_rad_s.iter().all(|rate| rate.abs() < 1e-6), "{}", clip.id);
        assert!((last.speed_m_s - 1.23).abs() < 0.2, "{}: {} m/s", clip.id, last.speed_m_s);
    }
}

#[test]
fn bolt_goes_fast_and_a_glide_loses_way() {
    let mut flight = Flight::new(None);
    flight.play("bolt", 8.0);
    assert!(flight.speed_m_s > 3.0, "{} m/s after 8 s", flight.speed_m_s);
    let mut flight = Flight::new(None);
    let out = flight.play("glide", 12.0);
    assert!(flight.speed_m_s < 0.3 && out.last().unwrap().posture.fluke_pitch.abs() < 1e-6);
}
