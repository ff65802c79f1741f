//! Readings of a trap, buoy, anchor or weight.

use endline_session::live::LiveView;
use endline_session::touching::BodyOnSkin;
use endline_session::units::Units;
use endline_sim::contact::bodies_touching;
use endline_sim::metrics::{BodyOnWhale, CAUGHT_S};
use endline_sim::model::{Body, BodyRole, JointKind, Shape};

use super::{Reading, levels};
use crate::gui::widgets::words::spoken;

/// Reads a body: its kind, its contact with the whale, the lines that pull it, its position.
pub(super) fn read(view: &LiveView, index: usize, units: Units) -> Option<Reading> {
    let (body, (place, _)) = (view.model.spec.bodies.get(index)?, view.frame.bodies.get(index)?);
    let mut rows = vec![("Kind", kind(body))];
    rows.extend(on_whale(view, index, body, units));
    rows.extend(touches(view, index));
    rows.extend(pulls(view, index, units));
    rows.extend(levels(view, *place, units));
    rows.push(("Size", size(body, units)));
    rows.push(("Mass in air", format!("{:.1} kg", body.mass_kg)));
    let moved = *place - body.position_m;
    rows.push(("Moved since the start", units.length(moved.truncate().length())));
    let peak = view.summary.as_ref().and_then(|summary| summary.bodies.get(index));
    rows.extend(peak.map(|peak| ("Greatest speed", units.speed(peak.peak_speed_m_s))));
    Some(Reading { title: body.id.clone(), rows })
}

/// Role, and library item if it has one.
fn kind(body: &Body) -> String {
    let role = role(body.role);
    if body.item.is_empty() { role.to_owned() } else { format!("{role}, {}", body.item) }
}

fn role(role: BodyRole) -> &'static str {
    match role {
        BodyRole::Trap => "trap",
        BodyRole::Buoy => "buoy",
        BodyRole::Anchor => "anchor",
        BodyRole::Weight => "weight",
    }
}

/// Size of a body in words: of its only part, or of the float of a buoy with the overall length.
fn size(body: &Body, units: Units) -> String {
    let first = body.parts.first().map_or_else(String::new, |part| size_of(&part.shape, units));
    if body.parts.len() < 2 {
        return first;
    }
    let heights = body.corners().map(|corner| corner.z);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
        (low.min(height), high.max(height))
    });
    let whole = units.of_metres(high - low);
    format!("float {first}; {whole:.2} {} over all", units.length_symbol())
}

/// Size of a shape in words.
fn size_of(shape: &Shape, units: Units) -> String {
    let (length, symbol) = (|length_m| units.of_metres(length_m), units.length_symbol());
    match shape {
        Shape::Box(half) => {
            let [x, y, z] = half.to_array().map(|half| length(2.0 * half));
            format!("{x:.2} × {y:.2} × {z:.2} {symbol}")
        }
        Shape::Sphere(radius_m) => format!("{:.2} {symbol} across", length(2.0 * radius_m)),
        Shape::Capsule { radius_m: across, half_length_m: along }
        | Shape::Cylinder { radius_m: across, half_length_m: along }
        | Shape::Spheroid { across_m: across, along_m: along } => {
            let (across, long) = (length(2.0 * across), length(2.0 * along));
            format!("{across:.2} {symbol} across, {long:.2} {symbol} long")
        }
    }
}

/// Contact of a body with the whale; empty in a run without contact of bodies and whale.
fn on_whale(
    view: &LiveView,
    index: usize,
    body: &Body,
    units: Units,
) -> Vec<(&'static str, String)> {
    if view.model.spec.whale.is_none() || !view.model.spec.settings.bodies_on_whale {
        return Vec::new();
    }
    let now = BodyOnSkin::at(&view.frame, &view.events, index, &body.id);
    let summary = view.summary.as_ref().and_then(|summary| summary.bodies.get(index));
    let so_far = summary.map(|summary| &summary.on_whale).filter(|it| it.peak_whale_push_n > 0.0);
    let mut rows = vec![("On the whale", where_since(&now))];
    if so_far.is_none() && now.part().is_none() {
        return rows;
    }
    // A buoy that bounces keeps its rows while it is off the skin, so that the list does not jump.
    rows.push(("Push now", push(&now, units)));
    // The summary covers the whole run, whichever moment is shown.
    let name = if view.sought { "Greatest of the run" } else { "Greatest push" };
    rows.extend(so_far.map(|it| (name, greatest(it, units))));
    rows.push(("Caught", caught(&now, so_far, view.frame.time_s)));
    rows
}

fn push(now: &BodyOnSkin, units: Units) -> String {
    let force = units.force();
    format!("{}, friction {}", force.text(now.push_n), force.text(now.friction_n))
}

/// Parts of the whale that the body presses on, largest force first, and since when.
fn where_since(now: &BodyOnSkin) -> String {
    if now.part().is_none() {
        return "not now".to_owned();
    }
    let parts = now.parts.iter().map(|(part, _)| spoken(part.name()));
    let parts = parts.collect::<Vec<_>>().join(", ");
    now.since_s.map_or_else(|| parts.clone(), |since_s| format!("{parts}, since {since_s:.2} s"))
}

/// The greatest push and its place.
fn greatest(on_whale: &BodyOnWhale, units: Units) -> String {
    let part = on_whale.peak_whale_part.map_or(String::new(), |part| spoken(part.name()));
    format!("{}, {part}", units.force().text(on_whale.peak_whale_push_n))
}

/// Whether the body is caught, or how long it has been in contact of the time required.
fn caught(now: &BodyOnSkin, so_far: Option<&BodyOnWhale>, time_s: f64) -> String {
    match (now.caught_s, now.since_s) {
        (Some(caught_s), _) => format!("yes, since {caught_s:.2} s"),
        (None, Some(since_s)) => {
            format!("not yet: {:.1} s of {CAUGHT_S:.0} s", (time_s - since_s).max(0.0))
        }
        (None, None) if so_far.is_some_and(|it| it.was_caught) => {
            "not now, but earlier in this run".to_owned()
        }
        (None, None) => "not now".to_owned(),
    }
}

/// Ids of other bodies that the body touches.
fn touches(view: &LiveView, index: usize) -> Option<(&'static str, String)> {
    let others = bodies_touching(&view.model, &view.frame.bodies, index);
    let ids = others.into_iter().map(|other| view.model.spec.bodies[other].id.as_str());
    let ids = ids.collect::<Vec<_>>().join(", ");
    (!ids.is_empty()).then_some(("Touches", ids))
}

/// Tension of each line at its end on the body.
fn pulls(view: &LiveView, index: usize, units: Units) -> Vec<(&'static str, String)> {
    let at = |joint: usize| matches!(view.model.spec.joints[joint].kind, JointKind::Body { body, .. } if body == index);
    let mut rows = Vec::new();
    for (line, spec) in view.model.spec.lines.iter().enumerate() {
        let segments = view.model.line_segments[line].clone();
        for (joint, segment) in
            [(spec.from, segments.start), (spec.to, segments.end.saturating_sub(1))]
        {
            let tension_n = view.frame.tension_n.get(segment).filter(|_| at(joint));
            rows.extend(tension_n.map(|tension_n| {
                ("Pull of a line", format!("{}, {}", spec.id, units.force().text(*tension_n)))
            }));
        }
    }
    rows
}
