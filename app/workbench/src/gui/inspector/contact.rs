//! What is told of a place at which rope or a body presses on skin.

use endline_sdk::Region;
use endline_session::live::LiveView;
use endline_session::touching::BodyOnSkin;
use endline_session::units::Units;
use endline_sim::DVec3;

use super::rope::along_it;
use super::{Reading, levels};
use crate::gui::widgets::words::spoken;
use crate::scene::pick::press::{body_on_skin, contact_m, rope_on_skin};

/// Where a line presses.
pub(super) fn of_rope(view: &LiveView, line: usize, at_m: f64, units: Units) -> Option<Reading> {
    let (model, frame) = (&view.model, &view.frame);
    let id = &model.spec.lines.get(line)?.id;
    let Some(contact) = rope_on_skin(model, frame, line, at_m) else {
        let rows = vec![("Along it", along_it(view, line, at_m, units)), no_more()];
        return Some(Reading { title: format!("{id} on skin"), rows });
    };
    let mut rows = pressing(contact.region, contact.normal_force_n, contact.friction_n, units);
    let at_m = contact_m(model, frame, contact)?;
    rows.push(("Along the line", along_it(view, line, at_m, units)));
    rows.push(("Rope that presses", units.length(contact.length_m)));
    let tension_n = frame.tension_n.get(contact.segment);
    rows.extend(tension_n.map(|tension_n| ("Tension here", units.force().text(*tension_n))));
    rows.extend(levels(view, contact.position, units));
    Some(Reading { title: title(id, contact.region), rows })
}

/// Where a body presses.
pub(super) fn of_body(
    view: &LiveView,
    body: usize,
    triangle: usize,
    units: Units,
) -> Option<Reading> {
    let id = &view.model.spec.bodies.get(body)?.id;
    let Some(contact) = body_on_skin(&view.frame, body, triangle) else {
        return Some(Reading { title: format!("{id} on skin"), rows: vec![no_more()] });
    };
    let mut rows = pressing(contact.region, contact.normal_force_n, contact.friction_n, units);
    let whole = BodyOnSkin::at(&view.frame, &view.events, body, id);
    rows.push(("Push in all places", units.force().text(whole.push_n)));
    rows.extend(whole.since_s.map(|since_s| ("Touches since", format!("{since_s:.2} s"))));
    rows.extend(levels(view, contact.position, units));
    Some(Reading { title: title(id, contact.region), rows })
}

fn title(id: &str, region: Region) -> String {
    format!("{id} on {}", spoken(region.part().name()))
}

fn no_more() -> (&'static str, String) {
    ("On the whale", "not now".to_owned())
}

/// Patch of skin, push and friction at one place.
fn pressing(
    region: Region,
    push_n: f64,
    friction_n: DVec3,
    units: Units,
) -> Vec<(&'static str, String)> {
    vec![
        ("Patch", spoken(region.name())),
        ("Push here", units.force().text(push_n)),
        ("Friction here", units.force().text(friction_n.length())),
    ]
}
