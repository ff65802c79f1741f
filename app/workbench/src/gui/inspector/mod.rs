//! Readings of what is picked in the 3-D view, of the ruler between two picks, and of rope wrapped round the whale.

mod body;

use endline_sdk::{BodyPart, Region};
use endline_session::live::{Channel, LiveView};
use endline_session::touching::{BodyOnSkin, bodies_on};
use endline_session::units::{Units, bearing_degrees};
use endline_sim::metrics::{EventKind, RegionSummary};
use endline_sim::model::JointKind;
use endline_sim::{DVec3, Frame, Model};

use crate::gui::widgets::words::{capital, spoken};
use crate::scene::Picked;
use crate::scene::pick::{body_on_skin, contact_m, ends, length_m, on_line, rope_on_skin};

/// Title and properties of a picked thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Title.
    pub title: String,
    /// Names and values, most important first.
    pub rows: Vec<(&'static str, String)>,
}

impl Reading {
    /// Keeps only the first rows, for a hover text.
    pub fn glance(mut self, picked: Picked) -> Self {
        // The whale fills much of the picture, so its hover text is shorter.
        let rows = if matches!(picked, Picked::Skin { .. }) { 3 } else { 5 };
        self.rows.truncate(rows);
        self
    }
}

/// Reads a picked thing at the moment shown; `None` if this run has no such thing.
pub fn read(view: &LiveView, picked: Picked, units: Units) -> Option<Reading> {
    match picked {
        Picked::Rope { line, at_m } => read_rope(view, line, at_m, units),
        Picked::Body(index) => body::read(view, index, units),
        Picked::Skin { triangle, .. } => read_skin(view, picked, triangle, units),
        Picked::RopeOnSkin { line, at_m } => read_rope_on_skin(view, line, at_m, units),
        Picked::BodyOnSkin { body, triangle } => read_body_on_skin(view, body, triangle, units),
    }
}

/// Depth, and height above the seabed if there is one.
fn levels(view: &LiveView, place: DVec3, units: Units) -> Vec<(&'static str, String)> {
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

/// Reads a place on a line.
fn read_rope(view: &LiveView, line: usize, at_m: f64, units: Units) -> Option<Reading> {
    let (model, frame) = (&view.model, &view.frame);
    let spec = model.spec.lines.get(line)?;
    let rope = &model.spec.ropes[spec.rope];
    let (segment, share) = on_line(model, frame, line, at_m)?;
    let [a, b] = ends(model, frame, line, segment)?;
    let (place, tension_n) = (a.lerp(b, share), *frame.tension_n.get(segment)?);
    let mut rows = vec![
        ("Rope", format!("{}, {}", rope.id, units.diameter(rope.diameter_m))),
        ("Position", along_it(view, line, at_m, units)),
        ("Tension here", units.force().text(tension_n)),
    ];
    rows.extend(strength(view, segment, tension_n, units));
    rows.push(("On the whale", touching(view, line, segment, units)));
    let stretch = (b - a).length() / frame.segment_length_m.get(segment)?.max(1e-12) - 1.0;
    // The nodes of slack rope move closer together, which gives a negative stretch.
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
    let line = *view.model.segment_line.get(segment)?;
    let own = segment - view.model.line_segments[line].start;
    let strength_n = view
        .model
        .weakest(line, &view.frame.segment_length_m)
        .nth(own)
        .map(|weakest| weakest.strength_n)
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

/// Position of a place along its line, with the length of the line and the end it is measured from.
fn along_it(view: &LiveView, line: usize, at_m: f64, units: Units) -> String {
    let spec = &view.model.spec;
    let of_m = length_m(&view.model, &view.frame, line);
    let from = spec.lines.get(line).map_or("", |line| spec.joints[line.from].id.as_str());
    format!("{} of {}, from {from}", units.length(at_m), units.length(of_m))
}

/// Region that the rope presses on at a segment or its neighbours, and the force.
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

/// Unstretched length from the first end of a line to its segment with the greatest tension [m].
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

/// Reads a place where a line presses on skin.
fn read_rope_on_skin(view: &LiveView, line: usize, at_m: f64, units: Units) -> Option<Reading> {
    let (model, frame) = (&view.model, &view.frame);
    let id = &model.spec.lines.get(line)?.id;
    let Some(contact) = rope_on_skin(model, frame, line, at_m) else {
        let rows = vec![("Position", along_it(view, line, at_m, units)), no_more()];
        return Some(Reading { title: format!("{id} on skin"), rows });
    };
    let mut rows = contact_rows(contact.region, contact.normal_force_n, contact.friction_n, units);
    let at_m = contact_m(model, frame, contact)?;
    rows.push(("Position", along_it(view, line, at_m, units)));
    rows.push(("Length in contact", units.length(contact.length_m)));
    let tension_n = frame.tension_n.get(contact.segment);
    rows.extend(tension_n.map(|tension_n| ("Tension here", units.force().text(*tension_n))));
    rows.extend(levels(view, contact.position, units));
    Some(Reading { title: title(id, contact.region), rows })
}

/// Reads a place where a body presses on skin.
fn read_body_on_skin(
    view: &LiveView,
    body: usize,
    triangle: usize,
    units: Units,
) -> Option<Reading> {
    let id = &view.model.spec.bodies.get(body)?.id;
    let Some(contact) = body_on_skin(&view.frame, body, triangle) else {
        return Some(Reading { title: format!("{id} on skin"), rows: vec![no_more()] });
    };
    let mut rows = contact_rows(contact.region, contact.normal_force_n, contact.friction_n, units);
    let whole = BodyOnSkin::at(&view.frame, &view.events, body, id);
    rows.push(("Push at all places", units.force().text(whole.push_n)));
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

/// Region of skin, push and friction at one place.
fn contact_rows(
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

/// Reads a place on skin: its region, and what presses on its body part.
fn read_skin(view: &LiveView, picked: Picked, triangle: usize, units: Units) -> Option<Reading> {
    let whale = view.model.spec.whale.as_ref()?;
    let region = *whale.skin.regions.get(triangle)?;
    let place = picked.place(&view.model, &view.frame)?;
    let part = region.part();
    let mut rows = vec![("Patch", spoken(region.name()))];
    rows.push(("Rope on it now", rope_on(view, part, units)));
    rows.push(("Buoys, traps now", bodies_on_part(view, part, units)));
    let summary = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
    let of_part = summary.and_then(|whale| whale.regions.iter().find(|region| region.part == part));
    rows.extend(of_part.into_iter().flat_map(|part| so_far(part, units)));
    rows.extend(levels(view, place, units));
    Some(Reading { title: capital(&spoken(part.name())), rows })
}

/// Length and force of the rope that presses on a body part now.
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

/// Bodies that press on a body part now, each with its push.
fn bodies_on_part(view: &LiveView, part: BodyPart, units: Units) -> String {
    let on = bodies_on(&view.frame, part).into_iter().filter_map(|(body, push_n)| {
        let body = view.model.spec.bodies.get(body)?;
        Some(format!("{} {}", body.id, units.force().text(push_n)))
    });
    let list = on.collect::<Vec<_>>().join(", ");
    if list.is_empty() { "none".to_owned() } else { list }
}

fn so_far(part: &RegionSummary, units: Units) -> [(&'static str, String); 3] {
    [
        ("Wraps, most", format!("{:.2}, {:.2} turns", part.wraps, part.peak_wraps)),
        ("Greatest force", units.force().text(part.peak_normal_n)),
        ("Greatest pressure", units.force().pressure(part.peak_pressure_pa)),
    ]
}

/// Reads the distance between two picked places; `None` unless there are two.
pub fn measured(view: &LiveView, picked: &[Picked], units: Units) -> Option<Reading> {
    let [from, to] = picked else { return None };
    let (a, b) = (from.place(&view.model, &view.frame)?, to.place(&view.model, &view.frame)?);
    let between = b - a;
    let mut rows = vec![
        ("Straight", units.length(between.length())),
        (
            "Horizontal, vertical",
            format!("{}, {}", units.length(between.truncate().length()), units.length(between.z)),
        ),
        ("Bearing", format!("{:.0}°", bearing_degrees(between.x, between.y))),
    ];
    let along = along_m(view, *from, *to);
    rows.push((
        "Along the rope",
        along.map_or_else(|| "no rope connects them".to_owned(), |along_m| units.length(along_m)),
    ));
    Some(Reading { title: "Ruler".to_owned(), rows })
}

/// A point where lines meet: (true, body) for all joints of a body, (false, joint) for any other joint.
type Knot = (bool, usize);

/// Unstretched length of the shortest path of rope between two places [m]; `None` if no rope connects them.
///
/// Bellman-Ford over lines as edges.
pub fn along_m(view: &LiveView, from: Picked, to: Picked) -> Option<f64> {
    if let (Some((one, a)), Some((other, b))) = (on_a_line(from), on_a_line(to))
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
            Picked::Rope { line, at_m } | Picked::RopeOnSkin { line, at_m } => {
                let left_m = length_m(&view.model, &view.frame, line) - at_m;
                spec.lines.get(line).map_or_else(Vec::new, |line| {
                    vec![(knot(line.from), at_m), (knot(line.to), left_m)]
                })
            }
            Picked::Body(index) => vec![((true, index), 0.0)],
            Picked::Skin { .. } | Picked::BodyOnSkin { .. } => Vec::new(),
        }
    };
    let mut known: std::collections::BTreeMap<Knot, f64> = near(from).into_iter().collect();
    // The shortest path uses each line at most once.
    for _ in 0..spec.lines.len() {
        for (index, line) in spec.lines.iter().enumerate() {
            let length_m = length_m(&view.model, &view.frame, index);
            for (here, there) in
                [(knot(line.from), knot(line.to)), (knot(line.to), knot(line.from))]
            {
                if let Some(so_far_m) = known.get(&here).copied() {
                    let length_m_there = known.entry(there).or_insert(f64::INFINITY);
                    *length_m_there = length_m_there.min(so_far_m + length_m);
                }
            }
        }
    }
    let paths = near(to).into_iter().filter_map(|(knot, rest_m)| Some(known.get(&knot)? + rest_m));
    paths.min_by(f64::total_cmp)
}

/// Line of a place and position along it [m]; `None` for a place that is not on a line.
fn on_a_line(picked: Picked) -> Option<(usize, f64)> {
    match picked {
        Picked::Rope { line, at_m } | Picked::RopeOnSkin { line, at_m } => Some((line, at_m)),
        _ => None,
    }
}

/// Least wrap to list; less is rope that bends round a part [turns].
const LEAST_WRAP: f64 = 0.25;

/// Rope wrapped round one body part.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrap {
    /// Body part.
    pub part: BodyPart,
    /// Turns round the part [turns].
    pub turns: f64,
    /// Time since which it has been at least half a turn without interruption [s].
    pub since_s: Option<f64>,
    /// Length of rope in contact [m].
    pub touching_m: f64,
    /// Id and contact length [m] of each line that touches the part, longest first.
    pub lines: Vec<(String, f64)>,
}

/// All wraps at the moment shown, most turns first.
pub fn wraps(view: &LiveView) -> Vec<Wrap> {
    let all = BodyPart::ALL.into_iter().map(|part| Wrap {
        part,
        turns: turns(view, part),
        since_s: since_s(view, part),
        touching_m: 0.0,
        lines: Vec::new(),
    });
    let mut found: Vec<Wrap> = all.filter(|wrap| wrap.turns >= LEAST_WRAP).collect();
    for wrap in &mut found {
        wrap.lines = lines_on(view, wrap.part);
        wrap.touching_m = wrap.lines.iter().map(|(_, length_m)| length_m).sum();
    }
    found.sort_by(|a, b| b.turns.total_cmp(&a.turns));
    found
}

/// Turns round a part at the moment shown: the measured value for the newest moment, otherwise that of the last sample before.
pub fn turns(view: &LiveView, part: BodyPart) -> f64 {
    let now = || {
        let whale = view.summary.as_ref()?.whale.as_ref()?;
        Some(whale.regions.iter().find(|region| region.part == part)?.wraps)
    };
    let sampled = || {
        let shown_s = view.frame.time_s + 1e-9;
        let samples = view.history.samples(Channel::Wraps(part).index());
        samples.take_while(|(time_s, _)| *time_s <= shown_s).last().map(|(_, turns)| turns)
    };
    let turns = if view.sought { sampled() } else { now() };
    turns.unwrap_or(0.0)
}

/// Time when the turns round a part last reached one half, up to the moment shown.
fn since_s(view: &LiveView, part: BodyPart) -> Option<f64> {
    let mut since_s = None;
    for event in view
        .events
        .iter()
        .filter(|event| event.time_s <= view.frame.time_s && event.subject == part.name())
    {
        match event.kind {
            EventKind::Wrap => since_s = since_s.or(Some(event.time_s)),
            EventKind::WrapUndone if event.value <= 0.5 => since_s = None,
            _ => {}
        }
    }
    since_s
}

fn lines_on(view: &LiveView, part: BodyPart) -> Vec<(String, f64)> {
    let mut lengths_m = vec![0.0; view.model.spec.lines.len()];
    for contact in view
        .frame
        .contacts
        .iter()
        .filter(|contact| contact.region.part() == part && contact.normal_force_n > 0.0)
    {
        lengths_m[contact.line] += contact.length_m;
    }
    let touching =
        view.model.spec.lines.iter().zip(lengths_m).filter(|(_, length_m)| *length_m > 0.0);
    let mut lines: Vec<(String, f64)> =
        touching.map(|(line, length_m)| (line.id.clone(), length_m)).collect();
    lines.sort_by(|a, b| b.1.total_cmp(&a.1));
    lines
}
