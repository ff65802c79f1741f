//! What a pilot sees over the 3-D view: speed, depth, heading, worst tension, mouth, flippers and the chosen act.

use egui::{Align2, Color32, FontId, Painter, Rect, pos2, vec2};
use endline_sdk::Controls;
use endline_session::live::LiveView;
use endline_sim::DVec3;

use super::units::{Units, bearing_degrees};
use crate::input::Hands;

/// The readings of the display: name and value.
#[must_use]
pub fn readings(view: &LiveView, units: Units) -> Vec<(&'static str, String)> {
    let Some(whale) = &view.frame.whale else { return Vec::new() };
    let ahead = whale.orientation * DVec3::X;
    let tension_n = view.frame.tension_n.iter().copied().fold(0.0, f64::max);
    vec![
        ("SPEED", units.speed(whale.speed_m_s)),
        ("DEPTH", units.depth(-whale.position.z)),
        ("HEADING", format!("{:03.0}°", bearing_degrees(ahead.x, ahead.y).round().rem_euclid(360.0))),
        ("TENSION", units.force().text(tension_n)),
    ]
}

/// What mouth, flippers and acts are told to do, in one line; `act` is the name of the chosen one.
#[must_use]
pub fn told(controls: &Controls, act: Option<&str>, hands: Hands) -> String {
    match hands {
        Hands::On => {}
        Hands::Holding => return "the pad is gone: its last input holds".to_owned(),
        Hands::Gliding => return "the pad is gone: the whale glides; any key that steers takes over".to_owned(),
    }
    let amounts = [
        ("burst", controls.burst),
        ("mouth", controls.mouth),
        ("flippers raised", controls.flipper_raise),
        ("twisted", controls.flipper_twist),
        ("swept", controls.flipper_sweep),
    ];
    let moved = amounts.into_iter().filter(|(_, amount)| amount.abs() > 0.005).map(|(name, amount)| format!("{name} {amount:+.2}"));
    let act = act.map(|name| format!("act {name}{}", if controls.act > 0.0 { ", now" } else { " (G does it, N next)" }));
    moved.chain(act).chain(["Esc lets go".to_owned()]).collect::<Vec<_>>().join(" · ")
}

/// Paints the display along the top of the view.
pub fn paint(painter: &Painter, rect: Rect, view: &LiveView, units: Units, note: &str) {
    const WIDTH: f32 = 112.0;
    let readings = readings(view, units);
    let whole = WIDTH * readings.len() as f32;
    let plate = Rect::from_min_size(pos2(rect.center().x - whole / 2.0, rect.top() + 12.0), vec2(whole, 50.0));
    painter.rect_filled(plate, 6.0, Color32::from_black_alpha(140));
    for (index, (name, value)) in readings.iter().enumerate() {
        let x = plate.left() + WIDTH * (index as f32 + 0.5);
        painter.text(
            pos2(x, plate.top() + 13.0),
            Align2::CENTER_CENTER,
            name,
            FontId::proportional(10.5),
            Color32::from_rgb(0x9f, 0xb6, 0xbf),
        );
        painter.text(
            pos2(x, plate.top() + 33.0),
            Align2::CENTER_CENTER,
            value,
            FontId::proportional(18.0),
            Color32::from_rgb(0xe8, 0xf2, 0xf4),
        );
    }
    let place = plate.center_bottom() + vec2(0.0, 13.0);
    let note = painter.layout_no_wrap(note.to_owned(), FontId::proportional(12.0), Color32::from_rgb(0xd4, 0xe2, 0xe6));
    let behind = Rect::from_center_size(place, note.size() + vec2(14.0, 4.0));
    painter.rect_filled(behind, 4.0, Color32::from_black_alpha(120));
    painter.galley(behind.center() - note.size() / 2.0, note, Color32::WHITE);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_moved_is_told_beside_the_chosen_act() {
        let controls = Controls { speed: 1.0, mouth: 1.0, flipper_sweep: -0.5, act: 2.0, ..Controls::default() };
        assert_eq!(told(&controls, Some("Roll away"), Hands::On), "mouth +1.00 · swept -0.50 · act Roll away, now · Esc lets go");
        assert_eq!(told(&Controls::default(), None, Hands::On), "Esc lets go");
        assert!(told(&controls, None, Hands::Gliding).contains("glides"), "a lost pad is said first");
    }
}
