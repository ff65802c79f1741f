//! What is told of a thing picked in the 3-D view, and of the way between two.

use endline_session::live::LiveView;
use endline_session::units::{Units, bearing_degrees};
use endline_sim::metrics::RegionSummary;
use endline_sim::model::{BodyRole, JointKind};
use endline_sim::{Frame, Model};

use super::widgets::words::{capital, spoken};
use crate::scene::Picked;
use crate::scene::pick::{ends, length_m, on_line};

/// The name of a thing and its properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What it is.
    pub title: String,
    /// Names and values.
    pub rows: Vec<(&'static str, String)>,
}

/// What a picked thing reads at the moment shown; `None` where this run has no such thing.
#[must_use]
pub fn read(view: &LiveView, picked: Picked, units: Units) -> Option<Reading> {
    match picked {
        Picked::Rope { line, at_m } => rope(view, line, at_m, units),
        Picked::Body(index) => body(view, index, units),
        Picked::Skin { triangle, .. } => skin(view, picked, triangle, units),
    }
}

fn rope(view: &LiveView, line: usize, at_m: f64, units: Units) -> Option<Reading> {
    let (model, frame) = (&view.model, &view.frame);
    let spec = model.spec.lines.get(line)?;
    let rope = &model.spec.ropes[spec.rope];
    let (segment, share) = on_line(model, frame, line, at_m)?;
    let [a, b] = ends(model, frame, line, segment)?;
    let (place, tension_n) = (a.lerp(b, share), *frame.tension_n.get(segment)?);
    let from = &model.spec.joints[spec.from].id;
    let mut rows = vec![
        ("Rope", format!("{}, {}", rope.id, units.diameter(rope.diameter_m))),
        (
            "Along it",
            format!(
                "{} of {}, from {from}",
                units.length(at_m),
                units.length(length_m(model, frame, line))
            ),
        ),
        ("Tension here", units.force().text(tension_n)),
    ];
    rows.extend(strength(view, segment, tension_n, units));
    let stretch = (b - a).length() / frame.segment_length_m.get(segment)?.max(1e-12) - 1.0;
    // What is slack is not stretched: its nodes come nearer to one another.
    rows.push((
        "Stretch",
        if stretch < 0.0 { "slack".to_owned() } else { format!("{:.2} %", 100.0 * stretch) },
    ));
    rows.extend(levels(view, place, units));
    rows.push(("On the whale", touching(view, line, segment, units)));
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

/// Depth, and height above the seabed where there is one.
fn levels(view: &LiveView, place: endline_sim::DVec3, units: Units) -> Vec<(&'static str, String)> {
    let above = view.model.spec.seabed.as_ref().map(|seabed| place.z - seabed.height_at(place));
    let depth = if place.z > 0.0 {
        format!("{} above the sea", units.length(place.z))
    } else {
        units.depth(-place.z)
    };
    let mut rows = vec![("Depth", depth)];
    rows.extend(above.map(|above_m| ("Above the seabed", units.length(above_m.max(0.0)))));
    rows
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

fn body(view: &LiveView, index: usize, units: Units) -> Option<Reading> {
    let (body, (place, _)) = (view.model.spec.bodies.get(index)?, view.frame.bodies.get(index)?);
    let role = match body.role {
        BodyRole::Trap => "trap",
        BodyRole::Buoy => "buoy",
        BodyRole::Anchor => "anchor",
        BodyRole::Weight => "weight",
    };
    let mut rows =
        vec![("Kind", role.to_owned()), ("Mass in air", format!("{:.1} kg", body.mass_kg))];
    rows.extend(levels(view, *place, units));
    let moved = *place - body.position_m;
    rows.push(("Off its first place", units.length(moved.truncate().length())));
    rows.extend(pulls(view, index, units));
    let peak = view.summary.as_ref().and_then(|summary| summary.bodies.get(index));
    rows.extend(peak.map(|peak| ("Greatest speed", units.speed(peak.peak_speed_m_s))));
    Some(Reading { title: body.id.clone(), rows })
}

/// Tension of the lines that end at a body, where they do.
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

fn skin(view: &LiveView, picked: Picked, triangle: usize, units: Units) -> Option<Reading> {
    let whale = view.model.spec.whale.as_ref()?;
    let region = *whale.skin.regions.get(triangle)?;
    let place = picked.place(&view.model, &view.frame)?;
    let part = region.part();
    let mut rows = vec![("Patch", spoken(region.name()))];
    rows.extend(levels(view, place, units));
    let on: Vec<_> = view
        .frame
        .contacts
        .iter()
        .filter(|contact| contact.region.part() == part && contact.normal_force_n > 0.0)
        .collect();
    let force_n: f64 = on.iter().map(|contact| contact.normal_force_n).sum();
    let length_m: f64 = on.iter().map(|contact| contact.length_m).sum();
    rows.push(("Rope on the part now", units.length(length_m)));
    rows.push(("Force now", units.force().text(force_n)));
    let summary = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
    let of_part = summary.and_then(|whale| whale.regions.iter().find(|region| region.part == part));
    rows.extend(of_part.into_iter().flat_map(|part| so_far(part, units)));
    Some(Reading { title: capital(&spoken(part.name())), rows })
}

fn so_far(part: &RegionSummary, units: Units) -> [(&'static str, String); 3] {
    [
        ("Wraps, most", format!("{:.2}, {:.2} turns", part.wraps, part.peak_wraps)),
        ("Greatest force", units.force().text(part.peak_normal_n)),
        ("Greatest pressure", units.force().pressure(part.peak_pressure_pa)),
    ]
}

/// The way between two picked places; `None` where there are not two.
#[must_use]
pub fn measured(view: &LiveView, picked: &[Picked], units: Units) -> Option<Reading> {
    let [from, to] = picked else { return None };
    let (a, b) = (from.place(&view.model, &view.frame)?, to.place(&view.model, &view.frame)?);
    let way = b - a;
    let mut rows = vec![
        ("Straight", units.length(way.length())),
        (
            "Level, upright",
            format!("{}, {}", units.length(way.truncate().length()), units.length(way.z)),
        ),
        ("Bearing", format!("{:.0}°", bearing_degrees(way.x, way.y))),
    ];
    let along = along_m(view, *from, *to);
    rows.push((
        "Along the rope",
        along.map_or_else(|| "no rope joins them".to_owned(), |along_m| units.length(along_m)),
    ));
    Some(Reading { title: "Ruler".to_owned(), rows })
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

/// Where lines meet: at a joint, or at any of a body's.
type Knot = (bool, usize);

/// Unstretched rope on the shortest way between two places through the gear [m]; `None` where no rope joins them.
#[must_use]
pub fn along_m(view: &LiveView, from: Picked, to: Picked) -> Option<f64> {
    if let (Picked::Rope { line: one, at_m: a }, Picked::Rope { line: other, at_m: b }) = (from, to)
        && one == other
    {
        return Some((a - b).abs());
    }
    let spec = &view.model.spec;
    let knot = |joint: usize| match spec.joints[joint].kind {
        JointKind::Body { body, .. } => (true, body),
        _ => (false, joint),
    };
    let near = |picked: Picked| -> Vec<(Knot, f64)> {
        match picked {
            Picked::Rope { line, at_m } => {
                let left_m = length_m(&view.model, &view.frame, line) - at_m;
                spec.lines.get(line).map_or_else(Vec::new, |line| {
                    vec![(knot(line.from), at_m), (knot(line.to), left_m)]
                })
            }
            Picked::Body(index) => vec![((true, index), 0.0)],
            Picked::Skin { .. } => Vec::new(),
        }
    };
    let mut known: std::collections::BTreeMap<Knot, f64> = near(from).into_iter().collect();
    // A way leads through each line once at most.
    for _ in 0..spec.lines.len() {
        for (index, line) in spec.lines.iter().enumerate() {
            let length_m = length_m(&view.model, &view.frame, index);
            for (here, there) in
                [(knot(line.from), knot(line.to)), (knot(line.to), knot(line.from))]
            {
                if let Some(so_far_m) = known.get(&here).copied() {
                    let way_m = known.entry(there).or_insert(f64::INFINITY);
                    *way_m = way_m.min(so_far_m + length_m);
                }
            }
        }
    }
    let ways = near(to).into_iter().filter_map(|(knot, rest_m)| Some(known.get(&knot)? + rest_m));
    ways.min_by(f64::total_cmp)
}
