//! What is told of a part of the whale.

use endline_sdk::BodyPart;
use endline_session::live::LiveView;
use endline_session::touching::bodies_on;
use endline_session::units::Units;
use endline_sim::metrics::RegionSummary;

use super::{Reading, levels};
use crate::gui::widgets::words::{capital, spoken};
use crate::scene::Picked;

/// A place on skin: its patch, and what presses on its part.
pub(super) fn read(
    view: &LiveView,
    picked: Picked,
    triangle: usize,
    units: Units,
) -> Option<Reading> {
    let whale = view.model.spec.whale.as_ref()?;
    let region = *whale.skin.regions.get(triangle)?;
    let place = picked.place(&view.model, &view.frame)?;
    let part = region.part();
    let mut rows = vec![("Patch", spoken(region.name()))];
    rows.push(("Rope on it now", rope_on(view, part, units)));
    rows.push(("Buoys, traps now", pressing(view, part, units)));
    let summary = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
    let of_part = summary.and_then(|whale| whale.regions.iter().find(|region| region.part == part));
    rows.extend(of_part.into_iter().flat_map(|part| so_far(part, units)));
    rows.extend(levels(view, place, units));
    Some(Reading { title: capital(&spoken(part.name())), rows })
}

/// Length and force of the rope that presses on a part now.
fn rope_on(view: &LiveView, part: BodyPart, units: Units) -> String {
    let on = view.frame.contacts.iter().filter(|contact| contact.region.part() == part);
    let (mut force_n, mut length_m) = (0.0, 0.0);
    for contact in on.filter(|contact| contact.normal_force_n > 0.0) {
        force_n += contact.normal_force_n;
        length_m += contact.length_m;
    }
    if force_n <= 0.0 {
        return "none".to_owned();
    }
    format!("{}, {}", units.length(length_m), units.force().text(force_n))
}

/// Bodies that press on a part now, each with its push.
fn pressing(view: &LiveView, part: BodyPart, units: Units) -> String {
    let on = bodies_on(&view.frame, part).into_iter().filter_map(|(body, push_n)| {
        let body = view.model.spec.bodies.get(body)?;
        Some(format!("{} {}", body.id, units.force().text(push_n)))
    });
    let told = on.collect::<Vec<_>>().join(", ");
    if told.is_empty() { "none".to_owned() } else { told }
}

fn so_far(part: &RegionSummary, units: Units) -> [(&'static str, String); 3] {
    [
        ("Wraps, most", format!("{:.2}, {:.2} turns", part.wraps, part.peak_wraps)),
        ("Greatest force", units.force().text(part.peak_normal_n)),
        ("Greatest pressure", units.force().pressure(part.peak_pressure_pa)),
    ]
}
