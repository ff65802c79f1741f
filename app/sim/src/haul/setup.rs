//! Start of a haul: the buoy and all that floats with it are taken aboard, and the line end is brought to the block.

use endline_sdk::LineEnd;

use super::take_in::Origin;
use super::{Boat, End, Haul, HaulStep, Hauling};
use crate::model::{BodyRole, JointKind, Model, Settings};
use crate::state::State;
use crate::step::Workspace;

/// Returns the line ends at buoys near the surface from which gear can be hauled: body, line, end of the line.
pub fn endlines(model: &Model) -> Vec<(usize, usize, LineEnd)> {
    let mut found = Vec::new();
    for (line, of) in model.spec.lines.iter().enumerate() {
        for (at, joint) in [(LineEnd::A, of.from), (LineEnd::B, of.to)] {
            let JointKind::Body { body, .. } = model.spec.joints[joint].kind else { continue };
            let is_afloat = model.spec.bodies[body].role == BodyRole::Buoy
                && model.spec.bodies[body].position_m.z > -0.5 * model.spec.water.depth_m;
            if is_afloat && reaches_down(model, body, line) {
                found.push((body, line, at));
            }
        }
    }
    found
}

/// Whether a line from a buoy reaches a body other than a buoy, directly or over branches, before another buoy.
fn reaches_down(model: &Model, buoy: usize, line: usize) -> bool {
    let (_, bodies) = beyond(model, buoy, false, |other| other == line);
    bodies.iter().any(|body| model.spec.bodies[*body].role != BodyRole::Buoy)
}

/// Returns the lines and bodies connected to a body through those of its lines that `lets` accepts. `past_buoys` selects
/// whether the search continues beyond other buoys.
fn beyond(
    model: &Model,
    start: usize,
    past_buoys: bool,
    lets: impl Fn(usize) -> bool,
) -> (Vec<usize>, Vec<usize>) {
    let spec = &model.spec;
    let body_of = |joint: usize| match spec.joints[joint].kind {
        JointKind::Body { body, .. } => Some(body),
        _ => None,
    };
    let place =
        |joint: usize| body_of(joint).map_or((joint, usize::MAX), |body| (usize::MAX, body));
    let (mut lines, mut bodies, mut reached) = (Vec::new(), Vec::new(), Vec::new());
    let mut open = vec![(usize::MAX, start)];
    while let Some(at) = open.pop() {
        reached.push(at);
        let is_start = at.1 == start;
        if at.1 != usize::MAX && !is_start {
            bodies.push(at.1);
            if !past_buoys && spec.bodies[at.1].role == BodyRole::Buoy {
                continue;
            }
        }
        for (index, line) in spec.lines.iter().enumerate() {
            let ends = [place(line.from), place(line.to)];
            if lines.contains(&index) || !ends.contains(&at) || (is_start && !lets(index)) {
                continue;
            }
            lines.push(index);
            open.extend(ends.into_iter().filter(|end| !reached.contains(end) && *end != at));
        }
    }
    bodies.sort_unstable();
    bodies.dedup();
    (lines, bodies)
}

impl Haul {
    /// Starts a haul of gear at rest from one of its [`endlines`]. Links, plugins, probes and obstacles are removed, and rope
    /// cannot break.
    /// Errors: reports a buoy whose other lines also lead to the gear.
    pub fn begin(
        model: &Model,
        state: &State,
        (buoy, line, at): (usize, usize, LineEnd),
        how: Hauling,
    ) -> Result<Self, String> {
        let (mut lines, mut bodies) = beyond(model, buoy, true, |other| other != line);
        if lines.contains(&line) {
            let id = &model.spec.bodies[buoy].id;
            return Err(format!("`{id}` holds the gear by more than one line"));
        }
        lines.sort_unstable();
        bodies.push(buoy);
        let bare = bare(model);
        let joint =
            if at == LineEnd::A { bare.spec.lines[line].from } else { bare.spec.lines[line].to };
        let place = state.joint_place(model, joint).unwrap_or_default();
        let mut haul = Self {
            how,
            state: state.clone(),
            work: Workspace::new(&bare),
            ends: Vec::new(),
            boat: Boat::at(place, &how),
            origin: Origin::of(model),
            began_m: state.bodies.iter().map(|body| body.position.z).collect(),
            hauled_m: 0.0,
            last_step: HaulStep::default(),
            model: bare,
        };
        haul.state.link_parted_s.clear();
        haul.leave_out(&lines, &bodies);
        let own = haul.origin.lines.iter().position(|other| *other == line).unwrap_or_default();
        haul.ends.push(End { line: own, at, joint });
        Ok(haul)
    }
}

/// The gear alone, with unbreakable lines.
fn bare(model: &Model) -> Model {
    let mut spec = model.spec.clone();
    spec.links.clear();
    spec.gear.clear();
    spec.probes.clear();
    spec.obstacles.clear();
    (spec.whale, spec.friction) = (None, None);
    for rope in &mut spec.ropes {
        rope.strength_n = f64::INFINITY;
    }
    for line in &mut spec.lines {
        line.weak_places.clear();
    }
    spec.settings = Settings {
        resolution: None,
        rope_on_rope: None,
        rope_on_bodies: false,
        bodies_on_bodies: false,
        balance: false,
        ..spec.settings
    };
    model.with_spec(spec)
}
