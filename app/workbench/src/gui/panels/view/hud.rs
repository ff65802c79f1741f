//! Head-up display of the pilot: speed, depth, heading, attitude, greatest tension and its line, rope on each body part, mouth, flippers
//! and the selected act.

use std::time::Duration;

use egui::{Align2, Color32, FontId, Id, Key, Painter, Pos2, Rect, Ui, pos2, vec2};
use endline_sdk::{BodyPart, Controls};
use endline_session::live::{LiveView, Status};
use endline_session::units::{Units, bearing_degrees};
use endline_sim::{DQuat, DVec3};

use crate::gui::panels::help;
use crate::gui::widgets::words::spoken;
use crate::input::Hands;

/// Normal width of a reading, and the width below which its numbers are smaller [points].
const WIDTH: f32 = 104.0;
const NARROW: f32 = 90.0;

/// Roll to starboard and pitch nose up of a whale [degrees].
fn attitude(orientation: DQuat) -> (f64, f64) {
    let [ahead, port] = [orientation * DVec3::X, orientation * DVec3::Y];
    // Roll is positive with starboard down, that is with port up.
    let roll = port.z.atan2((orientation * DVec3::Z).z);
    (roll.to_degrees(), ahead.z.clamp(-1.0, 1.0).asin().to_degrees())
}

/// Name and value of each reading.
pub fn readings(view: &LiveView, units: Units) -> Vec<(String, String)> {
    let Some(whale) = &view.frame.whale else { return Vec::new() };
    let ahead = whale.orientation * DVec3::X;
    let (roll, pitch) = attitude(whale.orientation);
    let (greatest, tension_n) = greatest(view);
    vec![
        ("SPEED".into(), units.speed(whale.speed_m_s)),
        ("DEPTH".into(), units.depth(-whale.position.z)),
        (
            "HEADING".into(),
            format!("{:03.0}°", bearing_degrees(ahead.x, ahead.y).round().rem_euclid(360.0)),
        ),
        ("ROLL".into(), with_side(roll, ["level", "port", "stbd"])),
        ("PITCH".into(), with_side(pitch, ["level", "down", "up"])),
        ("THROTTLE".into(), format!("{:.0} %", 100.0 * view.controls.speed)),
        (format!("TENSION {greatest}").trim_end().to_owned(), units.force().text(tension_n)),
    ]
}

/// An angle in whole degrees with a word for zero, negative or positive values.
fn with_side(degrees: f64, [none, below, above]: [&str; 3]) -> String {
    let whole = degrees.round();
    if whole == 0.0 {
        return none.to_owned();
    }
    format!("{:.0}° {}", whole.abs(), if whole < 0.0 { below } else { above })
}

/// Id of the line with the greatest tension now, and the tension [N].
pub fn greatest(view: &LiveView) -> (&str, f64) {
    let segments = view.frame.tension_n.iter().copied().enumerate();
    let most =
        segments.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, tension_n)| *tension_n > 0.0);
    let line = most.and_then(|(segment, _)| view.model.segment_line.get(segment));
    (
        line.map_or("", |line| view.model.spec.lines[*line].id.as_str()),
        most.map_or(0.0, |(_, tension_n)| tension_n),
    )
}

/// Force of rope on each body part now, largest first, in one line; empty without contact.
pub fn rope_forces(view: &LiveView, units: Units) -> String {
    let mut forces = BodyPart::ALL.map(|part| (part, 0.0));
    for contact in &view.frame.contacts {
        forces[contact.region.part() as usize].1 += contact.normal_force_n.max(0.0);
    }
    forces.sort_by(|a, b| b.1.total_cmp(&a.1));
    let present = forces.iter().filter(|(_, force_n)| *force_n > 0.0);
    present
        .map(|(part, force_n)| format!("{} {}", spoken(part.name()), units.force().text(*force_n)))
        .collect::<Vec<_>>()
        .join(" · ")
}

/// Hint while the run does not advance, when steering has no effect; empty while it runs.
pub fn waiting(view: &LiveView) -> &'static str {
    match view.status {
        Status::Running => "",
        Status::Finished | Status::Stopped(_) => "the run has ended: Space restarts it · ",
        Status::Settling | Status::Paused | Status::Failed(_) => {
            "the run is paused: Space continues it · "
        }
    }
}

/// Controls of mouth, flippers and acts in one line; `act` is the name of the selected act.
pub fn controls_text(controls: &Controls, act: Option<&str>, hands: Hands) -> String {
    match hands {
        Hands::On => {}
        Hands::Holding => return "the pad is disconnected: its last input holds".to_owned(),
        Hands::Gliding => {
            return "the pad is disconnected: the whale glides; any steering key takes over"
                .to_owned();
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
        format!("act {name}{}", if controls.act > 0.0 { ", now" } else { " (G: do it, N: next)" })
    });
    moved.chain(act).chain(["Esc: stop steering".to_owned()]).collect::<Vec<_>>().join(" · ")
}

/// Paints the display at the top of the view.
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
        // A long line id is clipped at the next reading.
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
    let rope_forces = rope_forces(view, units);
    let lines = [
        (rope_forces.as_str(), Color32::from_rgb(0xff, 0xc9, 0x7a)),
        (note, Color32::from_rgb(0xd4, 0xe2, 0xe6)),
    ];
    for (text, colour) in lines.into_iter().filter(|(text, _)| !text.is_empty()) {
        line(painter, below, text, colour);
        below.y += 20.0;
    }
}

/// Time for which the card of keys is shown when a flight begins [s].
const CARD_S: f64 = 10.0;

/// Whether the card of keys is shown: in the first seconds of a flight, and while the question mark is held.
pub(super) fn shows_card(ui: &Ui, flying: bool) -> bool {
    let id = Id::new("flight began");
    if !flying {
        ui.data_mut(|data| data.remove::<f64>(id));
        return false;
    }
    let now_s = ui.input(|input| input.time);
    let began_s = ui.data_mut(|data| *data.get_temp_mut_or(id, now_s));
    let left_s = CARD_S - (now_s - began_s);
    if left_s > 0.0 {
        ui.ctx().request_repaint_after(Duration::from_secs_f64(left_s));
    }
    left_s > 0.0 || ui.input(|input| input.key_down(Key::Questionmark))
}

/// Paints the keys of a flight at the bottom of the view, in columns of a function and its keys.
pub(super) fn card(painter: &Painter, rect: Rect, rows: &[help::Row]) {
    const COLUMN: f32 = 300.0;
    const LINE: f32 = 17.0;
    let columns = (((rect.width() - 24.0) / COLUMN) as usize).clamp(1, 3);
    let lines = rows.len().div_ceil(columns);
    let size = vec2(COLUMN * columns as f32 + 16.0, LINE * (lines as f32 + 1.0) + 14.0);
    let plate = Rect::from_min_size(
        pos2(rect.center().x - size.x / 2.0, rect.bottom() - size.y - 12.0),
        size,
    );
    painter.rect_filled(plate, 6.0, Color32::from_black_alpha(175));
    let [faint, bright] =
        [Color32::from_rgb(0x9f, 0xb6, 0xbf), Color32::from_rgb(0xe8, 0xf2, 0xf4)];
    let text = |at: Pos2, text: &str, colour: Color32| {
        painter.text(at, Align2::LEFT_TOP, text, FontId::proportional(12.5), colour);
    };
    let corner = plate.left_top() + vec2(14.0, 7.0);
    text(corner, "Keys of a flight; hold ? to see them again", faint);
    for (index, row) in rows.iter().enumerate() {
        let at =
            corner + vec2(COLUMN * (index / lines) as f32, LINE * ((index % lines) as f32 + 1.0));
        text(at, &row.keys, bright);
        text(at + vec2(110.0, 0.0), &row.what, faint);
    }
}

/// Paints a line of text on its own background.
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
    fn roll_names_the_lower_side_and_pitch_the_direction_of_the_snout() {
        // A positive rotation about x moves y (port) towards z (up), and starboard down.
        let rotated = |axis, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
        let (roll, pitch) = attitude(rotated(DVec3::X, 30.0));
        assert!((roll - 30.0).abs() < 1e-9 && pitch.abs() < 1e-9);
        let (roll, pitch) = attitude(rotated(DVec3::Y, -20.0));
        assert!(roll.abs() < 1e-9 && (pitch - 20.0).abs() < 1e-9);
        let (roll, _) = attitude(rotated(DVec3::Z, 70.0) * rotated(DVec3::X, 170.0));
        assert!((roll - 170.0).abs() < 1e-9, "independent of the heading: {roll}");
        assert_eq!(with_side(-12.4, ["level", "port", "stbd"]), "12° port");
        assert_eq!(with_side(0.3, ["level", "down", "up"]), "level");
    }

    #[test]
    fn only_active_controls_are_listed_beside_the_selected_act() {
        let controls = Controls {
            speed: 1.0,
            mouth: 1.0,
            flipper_sweep: -0.5,
            act: 2.0,
            ..Controls::default()
        };
        assert_eq!(
            controls_text(&controls, Some("Roll away"), Hands::On),
            "mouth +1.00 · swept -0.50 · act Roll away, now · Esc: stop steering"
        );
        assert_eq!(controls_text(&Controls::default(), None, Hands::On), "Esc: stop steering");
        assert!(
            controls_text(&controls, None, Hands::Gliding).contains("glides"),
            "a disconnected pad is reported first"
        );
    }
}
