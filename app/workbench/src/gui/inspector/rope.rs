//! What is told of a place on a line.

use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::{Frame, Model};

use super::{Reading, levels};
use crate::gui::widgets::words::spoken;
use crate::scene::pick::{ends, length_m, on_line};

/// A place on a line.
pub(super) fn read(view: &LiveView, line: usize, at_m: f64, units: Units) -> Option<Reading> {
    let (model, frame) = (&view.model, &view.frame);
    let spec = model.spec.lines.get(line)?;
    let rope = &model.spec.ropes[spec.rope];
    let (segment, share) = on_line(model, frame, line, at_m)?;
    let [a, b] = ends(model, frame, line, segment)?;
    let (place, tension_n) = (a.lerp(b, share), *frame.tension_n.get(segment)?);
    let mut rows = vec![
        ("Rope", format!("{}, {}", rope.id, units.diameter(rope.diameter_m))),
        ("Along it", along_it(view, line, at_m, units)),
        ("Tension here", units.force().text(tension_n)),
    ];
    rows.extend(strength(view, segment, tension_n, units));
    rows.push(("On the whale", touching(view, line, segment, units)));
    let stretch = (b - a).length() / frame.segment_length_m.get(segment)?.max(1e-12) - 1.0;
    // What is slack is not stretched: its nodes come nearer to one another.
    rows.push((
        "Stretch",
        if stretch < 0.0 { "slack".to_owned() } else { format!("{:.2} %", 100.0 * stretch) },
    ));
    rows.extend(levels(view, place, units));
    let peak = view.summary.as_ref().and_then(|summary| summary.lines.get(line));
    rows.extend(peak.map(|peak| {
        (
            "Peak of the line",
            format!("{} at {:.2} s", units.force().text(peak.peak_tension_n), peak.peak_at_s),
        )
    }));
    Some(Reading { title: spec.id.clone(), rows })
}

fn strength(
    view: &LiveView,
    segment: usize,
    tension_n: f64,
    units: Units,
) -> Option<(&'static str, String)> {
    let strength_n = view
        .model
        .segment_strength_n
        .get(segment)
        .copied()
        .filter(|strength| strength.is_finite() && *strength > 0.0)?;
    Some((
        "Breaks at",
        format!(
            "{}; now {:.0} % of it",
            units.force().text(strength_n),
            100.0 * tension_n / strength_n
        ),
    ))
}

/// How far along its line a place is, of how much, and from which end.
pub(super) fn along_it(view: &LiveView, line: usize, at_m: f64, units: Units) -> String {
    let spec = &view.model.spec;
    let of_m = length_m(&view.model, &view.frame, line);
    let from = spec.lines.get(line).map_or("", |line| spec.joints[line.from].id.as_str());
    format!("{} of {}, from {from}", units.length(at_m), units.length(of_m))
}

/// Which part the rope presses on at a segment or its neighbours, and how hard.
fn touching(view: &LiveView, line: usize, segment: usize, units: Units) -> String {
    let here = view
        .frame
        .contacts
        .iter()
        .filter(|contact| contact.line == line && contact.segment.abs_diff(segment) <= 1);
    let hardest = here
        .filter(|contact| contact.normal_force_n > 0.0)
        .max_by(|a, b| a.normal_force_n.total_cmp(&b.normal_force_n));
    hardest.map_or_else(
        || "not here".to_owned(),
        |contact| {
            format!(
                "{}, {}",
                spoken(contact.region.name()),
                units.force().text(contact.normal_force_n)
            )
        },
    )
}

/// Unstretched rope from a line's first end to its segment of the greatest tension [m].
#[must_use]
pub fn worst_m(model: &Model, frame: &Frame, line: usize) -> f64 {
    let (mut before_m, mut worst) = (0.0, (f64::NEG_INFINITY, 0.0));
    for segment in model.line_segments.get(line).cloned().unwrap_or_default() {
        let (Some(length_m), Some(tension_n)) =
            (frame.segment_length_m.get(segment), frame.tension_n.get(segment))
        else {
            break;
        };
        if *tension_n > worst.0 {
            worst = (*tension_n, before_m + 0.5 * length_m);
        }
        before_m += length_m;
    }
    worst.1
}
