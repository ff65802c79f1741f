//! What a pilot sees over the 3-D view: speed, depth, heading, worst tension and its line, rope on each part of the body,
//! mouth, flippers and the chosen act.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, pos2, vec2};
use endline_sdk::{BodyPart, Controls};
use endline_session::live::{LiveView, Status};
use endline_session::units::{Units, bearing_degrees};
use endline_sim::{DQuat, DVec3};

use crate::gui::widgets::words::spoken;
use crate::input::Hands;

/// Width of a reading where there is room, and where its numbers are set smaller [points].
const WIDTH: f32 = 104.0;
const NARROW: f32 = 90.0;

/// Roll to starboard and nose up of a whale [degrees].
fn attitude(orientation: DQuat) -> (f64, f64) {
    let [ahead, port] = [orientation * DVec3::X, orientation * DVec3::Y];
    // Starboard down is a positive roll: port then points up.
    let roll = port.z.atan2((orientation * DVec3::Z).z);
    (roll.to_degrees(), ahead.z.clamp(-1.0, 1.0).asin().to_degrees())
}

/// The readings of the display: name and value.
#[must_use]
pub fn readings(view: &LiveView, units: Units) -> Vec<(String, String)> {
    let Some(whale) = &view.frame.whale else { return Vec::new() };
    let ahead = whale.orientation * DVec3::X;
    let (roll, pitch) = attitude(whale.orientation);
    let (worst, tension_n) = worst(view);
    vec![
        ("SPEED".into(), units.speed(whale.speed_m_s)),
        ("DEPTH".into(), units.depth(-whale.position.z)),
        (
            "HEADING".into(),
            format!("{:03.0}°", bearing_degrees(ahead.x, ahead.y).round().rem_euclid(360.0)),
        ),
        ("ROLL".into(), turned(roll, ["level", "port", "stbd"])),
        ("PITCH".into(), turned(pitch, ["level", "down", "up"])),
        ("THROTTLE".into(), format!("{:.0} %", 100.0 * view.controls.speed)),
        (format!("TENSION {worst}").trim_end().to_owned(), units.force().text(tension_n)),
    ]
}

/// An angle in whole degrees with the word for its side: none, below zero, above.
fn turned(degrees: f64, [none, below, above]: [&str; 3]) -> String {
    let whole = degrees.round();
    if whole == 0.0 {
        return none.to_owned();
    }
    format!("{:.0}° {}", whole.abs(), if whole < 0.0 { below } else { above })
}

/// The line of the greatest tension now, by its id, and that tension [N].
#[must_use]
pub fn worst(view: &LiveView) -> (&str, f64) {
    let segments = view.frame.tension_n.iter().copied().enumerate();
    let most =
        segments.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, tension_n)| *tension_n > 0.0);
    let line = most.and_then(|(segment, _)| view.model.segment_line.get(segment));
    (
        line.map_or("", |line| view.model.spec.lines[*line].id.as_str()),
        most.map_or(0.0, |(_, tension_n)| tension_n),
    )
}

/// Rope that presses on each part now, the hardest first, in one line; empty where none does.
#[must_use]
pub fn touched(view: &LiveView, units: Units) -> String {
    let mut forces = BodyPart::ALL.map(|part| (part, 0.0));
    for contact in &view.frame.contacts {
        forces[contact.region.part() as usize].1 += contact.normal_force_n.max(0.0);
    }
    forces.sort_by(|a, b| b.1.total_cmp(&a.1));
    let told = forces.iter().filter(|(_, force_n)| *force_n > 0.0);
    told.map(|(part, force_n)| format!("{} {}", spoken(part.name()), units.force().text(*force_n)))
        .collect::<Vec<_>>()
        .join(" · ")
}

/// What a pilot is told first where time stands still: the keys steer nothing then.
#[must_use]
pub fn waiting(view: &LiveView) -> &'static str {
    match view.status {
        Status::Running => "",
        Status::Finished | Status::Stopped(_) => "the run is over: Space begins again · ",
        Status::Settling | Status::Paused | Status::Failed(_) => {
            "time stands still: Space goes on · "
        }
    }
}

/// The commands to mouth, flippers and acts, in one line; `act` is the name of the chosen one.
#[must_use]
pub fn told(controls: &Controls, act: Option<&str>, hands: Hands) -> String {
    match hands {
        Hands::On => {}
        Hands::Holding => return "the pad is gone: its last input holds".to_owned(),
        Hands::Gliding => {
            return "the pad is gone: the whale glides; any key that steers takes over".to_owned();
        }
    }
    let amounts = [
        ("burst", controls.burst),
        ("mouth", controls.mouth),
        ("flippers raised", controls.flipper_raise),
        ("twisted", controls.flipper_twist),
        ("swept", controls.flipper_sweep),
    ];
    let moved = amounts
        .into_iter()
        .filter(|(_, amount)| amount.abs() > 0.005)
        .map(|(name, amount)| format!("{name} {amount:+.2}"));
    let act = act.map(|name| {
        format!("act {name}{}", if controls.act > 0.0 { ", now" } else { " (G does it, N next)" })
    });
    moved.chain(act).chain(["Esc lets go".to_owned()]).collect::<Vec<_>>().join(" · ")
}

/// Paints the display along the top of the view.
pub fn paint(painter: &Painter, rect: Rect, view: &LiveView, units: Units, note: &str) {
    let readings = readings(view, units);
    let width = ((rect.width() - 24.0) / readings.len().max(1) as f32).min(WIDTH);
    let size = if width < NARROW { 13.0 } else { 18.0 };
    let whole = width * readings.len() as f32;
    let plate = Rect::from_min_size(
        pos2(rect.center().x - whole / 2.0, rect.top() + 12.0),
        vec2(whole, 50.0),
    );
    painter.rect_filled(plate, 6.0, Color32::from_black_alpha(140));
    for (index, (name, value)) in readings.iter().enumerate() {
        let x = plate.left() + width * (index as f32 + 0.5);
        let faint = Color32::from_rgb(0x9f, 0xb6, 0xbf);
        // A long name of a line ends where the next reading begins.
        let place = Rect::from_center_size(pos2(x, plate.top() + 13.0), vec2(width - 6.0, 14.0));
        let galley = painter.layout_no_wrap(name.clone(), FontId::proportional(10.5), faint);
        let left = (x - galley.size().x / 2.0).max(place.left());
        painter.with_clip_rect(place).galley(
            pos2(left, place.center().y - galley.size().y / 2.0),
            galley,
            faint,
        );
        painter.text(
            pos2(x, plate.top() + 33.0),
            Align2::CENTER_CENTER,
            value,
            FontId::proportional(size),
            Color32::from_rgb(0xe8, 0xf2, 0xf4),
        );
    }
    let mut below = plate.center_bottom() + vec2(0.0, 13.0);
    let touched = touched(view, units);
    let lines = [
        (touched.as_str(), Color32::from_rgb(0xff, 0xc9, 0x7a)),
        (note, Color32::from_rgb(0xd4, 0xe2, 0xe6)),
    ];
    for (text, colour) in lines.into_iter().filter(|(text, _)| !text.is_empty()) {
        line(painter, below, text, colour);
        below.y += 20.0;
    }
}

/// A line of text on a plate of its own.
fn line(painter: &Painter, middle: Pos2, text: &str, colour: Color32) {
    let text = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), colour);
    let behind = Rect::from_center_size(middle, text.size() + vec2(14.0, 4.0));
    painter.rect_filled(behind, 4.0, Color32::from_black_alpha(120));
    painter.galley(behind.center() - text.size() / 2.0, text, Color32::WHITE);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roll_is_to_the_side_that_goes_down_and_pitch_is_of_the_snout() {
        // About x by the right hand, y (port) goes towards z (up): starboard goes down.
        let turned_by = |axis, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
        let (roll, pitch) = attitude(turned_by(DVec3::X, 30.0));
        assert!((roll - 30.0).abs() < 1e-9 && pitch.abs() < 1e-9);
        let (roll, pitch) = attitude(turned_by(DVec3::Y, -20.0));
        assert!(roll.abs() < 1e-9 && (pitch - 20.0).abs() < 1e-9);
        let (roll, _) = attitude(turned_by(DVec3::Z, 70.0) * turned_by(DVec3::X, 170.0));
        assert!((roll - 170.0).abs() < 1e-9, "whatever the heading: {roll}");
        assert_eq!(turned(-12.4, ["level", "port", "stbd"]), "12° port");
        assert_eq!(turned(0.3, ["level", "down", "up"]), "level");
    }

    #[test]
    fn only_what_is_moved_is_told_beside_the_chosen_act() {
        let controls = Controls {
            speed: 1.0,
            mouth: 1.0,
            flipper_sweep: -0.5,
            act: 2.0,
            ..Controls::default()
        };
        assert_eq!(
            told(&controls, Some("Roll away"), Hands::On),
            "mouth +1.00 · swept -0.50 · act Roll away, now · Esc lets go"
        );
        assert_eq!(told(&Controls::default(), None, Hands::On), "Esc lets go");
        assert!(
            told(&controls, None, Hands::Gliding).contains("glides"),
            "a lost pad is said first"
        );
    }
}
