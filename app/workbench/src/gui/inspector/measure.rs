//! The way between two places, straight and along the rope.

use endline_session::live::LiveView;
use endline_session::units::{Units, bearing_degrees};
use endline_sim::model::JointKind;

use super::Reading;
use crate::scene::Picked;
use crate::scene::pick::length_m;

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

/// Where lines meet: at a joint, or at any of a body's.
type Knot = (bool, usize);

/// Unstretched rope on the shortest way between two places through the gear [m]; `None` where no rope joins them.
#[must_use]
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

/// The line that a place lies on, and how far along.
fn on_a_line(picked: Picked) -> Option<(usize, f64)> {
    match picked {
        Picked::Rope { line, at_m } | Picked::RopeOnSkin { line, at_m } => Some((line, at_m)),
        _ => None,
    }
}
