//! The step of gear that moves, in a model of several gears of which the others are held.
//!
//! Gears that stand still ([`rest`](super::rest)) and that nothing can reach in the step are left out: the others are a model of their
//! own ([`Selection`]), whose step is that of any model. Its state is copied from that of the whole model before the step, and back after
//! it. The choice follows from the state alone:
//!
//! | gear | is in the step if |
//! |---|---|
//! | moves, or has not stood still for long enough | always |
//! | stands still | it is within [`REACH_M`] of the whale, or within [`BESIDE_M`] of gear in the step |
//!
//! The whale is a ball about its origin at the start and at the end of the step, which contains it in any posture and on the way. Gear is
//! the box about its nodes and bodies. Rope and bodies move by less than [`BESIDE_M`] in a step of at most [`LONGEST_STEP_S`]: that takes
//! 50 m/s.

use glam::DVec3;

use super::substeps::advance_all;
use super::{Stop, Workspace, rest};
use crate::contact::rope_on_skin::stored_faces::{FACE_BITS, SEGMENT_BITS, segment_of};
use crate::model::Model;
use crate::model::gears::Selection;
use crate::state::{
    BodyGrip, BodyGrips, FrictionState, PairGrip, RopeGrip, RopeState, RopeWithin, SolidGrip,
    State, StepControl, WhaleState,
};
use crate::whale::tree::Bounds;

/// Distance from the whale within which gear is in the step [m].
const REACH_M: f64 = 5.0;
/// Distance from gear in the step within which other gear is in it too [m].
const BESIDE_M: f64 = 1.0;
/// Longest step of a model whose gears are held apart [s].
const LONGEST_STEP_S: f64 = 0.02;

/// The gears in the step, with their state and workspace.
#[derive(Clone)]
pub(super) struct Moving {
    selection: Selection,
    state: State,
    workspace: Workspace,
}

impl std::fmt::Debug for Moving {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Moving").field("gears", &self.selection.gears).finish()
    }
}

/// Whether gears of a model can be held apart from each other. Numbers of solids are those of parts of bodies if there is no obstacle.
pub(super) fn is_possible(model: &Model) -> bool {
    model.may_be_held
        && model.gears.count > 1
        && model.spec.obstacles.is_empty()
        && !model.spec.settings.balance
        && model.spec.settings.step_s <= LONGEST_STEP_S
}

/// The choice of the gears that are in the step, and its scratch.
#[derive(Clone, Debug, Default)]
pub(super) struct Choice {
    /// The gears, in rising order.
    gears: Vec<usize>,
    is_in: Vec<bool>,
    boxes: Vec<Bounds>,
}

impl Choice {
    /// Chooses the gears; returns whether some are left out.
    pub(super) fn choose(
        &mut self,
        model: &Model,
        state: &State,
        whale: Option<&[WhaleState; 2]>,
    ) -> bool {
        let Self { gears, is_in, boxes } = self;
        measure(model, state, boxes);
        let way_m = whale.map_or(0.0, |[from, to]| from.position.distance(to.position));
        let whale_m = model.skin_tree.as_ref().map_or(0.0, |tree| tree.reach_m);
        let reach_m = REACH_M + whale_m + way_m;
        let is_near_whale = |of: &Bounds| {
            whale.is_some_and(|whale| whale.iter().any(|at| distance(of, at.position) < reach_m))
        };
        is_in.clear();
        is_in.extend((0..model.gears.count).map(|gear| {
            !rest::gear_stands_still(model, state, gear) || is_near_whale(&boxes[gear])
        }));
        // Gear that is reached may reach further gear.
        let mut is_complete = false;
        while !is_complete {
            is_complete = true;
            for gear in 0..boxes.len() {
                let is_beside = |(other, is_in): (&Bounds, &bool)| {
                    *is_in && other.grown(BESIDE_M).meets(&boxes[gear])
                };
                if !is_in[gear] && boxes.iter().zip(is_in.iter()).any(is_beside) {
                    is_in[gear] = true;
                    is_complete = false;
                }
            }
        }
        gears.clear();
        gears.extend((0..is_in.len()).filter(|gear| is_in[*gear]));
        gears.len() < model.gears.count
    }
}

/// Advances the gears chosen by the model's step, and holds the others.
pub(super) fn advance(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> Result<(), Stop> {
    let gears = &workspace.choice.gears;
    if gears.is_empty() {
        workspace.leave_moving(model);
        workspace.begin_step();
        rest::hold(model, state, workspace);
        return Ok(());
    }
    let known = workspace.moving.take().filter(|moving| moving.selection.gears == *gears);
    let mut moving = known.unwrap_or_else(|| {
        hold_others(model, state, gears);
        Box::new(Moving::new(model, gears.clone()))
    });
    moving.gather(model, state);
    moving.exchange(workspace);
    let done =
        advance_all(&moving.selection.model, &mut moving.state, &mut moving.workspace, whale);
    moving.exchange(workspace);
    if done.is_ok() {
        moving.scatter(model, state);
        moving.report(model, state, workspace);
    }
    workspace.moving = Some(moving);
    done
}

/// Sets the velocities of all other gears to zero, and their history to that of gear at rest.
fn hold_others(model: &Model, state: &mut State, gears: &[usize]) {
    let is_held = |gear: usize| gears.binary_search(&gear).is_err();
    let rope = &mut state.rope;
    for (nodes, gear) in model.line_nodes.iter().zip(&model.gears.of_line) {
        if is_held(*gear) {
            rope.velocity[nodes.clone()].fill(DVec3::ZERO);
            rope.earlier_velocity[nodes.clone()].fill(DVec3::ZERO);
            rope.earlier_position[nodes.clone()].copy_from_slice(&rope.position[nodes.clone()]);
        }
    }
    for (body, gear) in state.bodies.iter_mut().zip(&model.gears.of_body) {
        if is_held(*gear) {
            body.rest();
        }
    }
}

impl Moving {
    fn new(model: &Model, gears: Vec<usize>) -> Self {
        let selection = Selection::new(model, gears);
        let (state, workspace) = (State::start(&selection.model), Workspace::new(&selection.model));
        Self { selection, state, workspace }
    }

    /// Gives counters, clock and what the whale feels to the workspace of the selection, or takes them back.
    fn exchange(&mut self, whole: &mut Workspace) {
        let own = &mut self.workspace;
        std::mem::swap(&mut own.audit, &mut whole.audit);
        std::mem::swap(&mut own.solver.cost, &mut whole.solver.cost);
        std::mem::swap(&mut own.mouth, &mut whole.mouth);
        std::mem::swap(&mut own.pulled, &mut whole.pulled);
        std::mem::swap(&mut own.sums, &mut whole.sums);
    }

    /// Copies the state of the selection from that of the whole model.
    fn gather(&mut self, model: &Model, whole: &State) {
        let Self { selection, state: own, workspace } = self;
        (own.time_s, own.step) = (whole.time_s, whole.step);
        own.whale.clone_from(&whole.whale);
        for (place, body) in selection.bodies.iter().enumerate() {
            own.bodies[place].clone_from(&whole.bodies[*body]);
        }
        for (place, link) in selection.links.iter().enumerate() {
            own.link_parted_s[place] = whole.link_parted_s[*link];
        }
        for (place, line) in selection.lines.iter().enumerate() {
            own.line_parted[place] = whole.line_parted[*line];
        }
        gather_rope(selection, model, &whole.rope, &mut own.rope);
        gather_body_grips(selection, &whole.body_grips, &mut own.body_grips);
        own.pair_grips.clear();
        own.pair_grips.extend(whole.pair_grips.iter().filter_map(|grip| {
            let parts = [selection.part_of(grip.parts[0])?, selection.part_of(grip.parts[1])?];
            Some(PairGrip { parts, ..*grip })
        }));
        let StepControl { step_s, limit, contact_step_s, tension_n, known, still_steps } =
            &whole.step_control;
        let control = &mut own.step_control;
        (control.step_s, control.limit, control.contact_step_s, control.known) =
            (*step_s, *limit, *contact_step_s, *known);
        control.tension_n.clear();
        control.tension_n.extend(selection.lines.iter().map(|line| tension_n[*line]));
        control.still_steps.clear();
        control.still_steps.extend(selection.gears.iter().map(|gear| still_steps[*gear]));
        match &mut workspace.before {
            Some(before) => before.clone_from(own),
            none => *none = Some(own.clone()),
        }
    }

    /// Copies the state of the selection to that of the whole model.
    fn scatter(&self, model: &Model, whole: &mut State) {
        let Self { selection, state: own, .. } = self;
        whole.time_s = own.time_s;
        for (place, body) in selection.bodies.iter().enumerate() {
            whole.bodies[*body].clone_from(&own.bodies[place]);
        }
        for (place, link) in selection.links.iter().enumerate() {
            whole.link_parted_s[*link] = own.link_parted_s[place];
        }
        for (place, line) in selection.lines.iter().enumerate() {
            whole.line_parted[*line] = own.line_parted[place];
        }
        scatter_rope(selection, model, &own.rope, &mut whole.rope);
        let BodyGrips { contacts, floats } = &mut whole.body_grips;
        contacts.clear();
        contacts.extend(
            own.body_grips
                .contacts
                .iter()
                .map(|grip| BodyGrip { part: selection.parts[grip.part], ..*grip }),
        );
        floats.clone_from(&own.body_grips.floats);
        whole.pair_grips.retain(|grip| selection.part_of(grip.parts[0]).is_none());
        whole.pair_grips.extend(
            own.pair_grips.iter().map(|grip| PairGrip {
                parts: grip.parts.map(|part| selection.parts[part]),
                ..*grip
            }),
        );
        whole.pair_grips.sort_by_key(|grip| grip.parts);
        let StepControl { step_s, limit, contact_step_s, tension_n, known, still_steps } =
            &own.step_control;
        let control = &mut whole.step_control;
        (control.step_s, control.limit, control.contact_step_s, control.known) =
            (*step_s, *limit, *contact_step_s, *known);
        for (place, line) in selection.lines.iter().enumerate() {
            control.tension_n[*line] = tension_n[place];
        }
        for (place, gear) in selection.gears.iter().enumerate() {
            control.still_steps[*gear] = still_steps[place];
        }
    }

    /// Copies the results of the step for readers, in the numbers of the whole model. Held gear has its tensions as peaks.
    fn report(&self, model: &Model, state: &State, whole: &mut Workspace) {
        let Self { selection, workspace: own, .. } = self;
        let line = |line: usize| selection.lines[line];
        let segment = |segment: usize| selection.segment_in(model, segment);
        whole.contacts.clear();
        whole.contacts.extend(own.contacts.iter().cloned().map(|mut contact| {
            (contact.line, contact.segment) = (line(contact.line), segment(contact.segment));
            contact
        }));
        whole.body_contacts.clear();
        whole.body_contacts.extend(own.body_contacts.iter().cloned().map(|mut contact| {
            contact.body = selection.bodies[contact.body];
            contact
        }));
        whole.rope_touches.clear();
        whole.rope_touches.extend(own.rope_touches.iter().cloned().map(|mut touch| {
            touch.segments = touch.segments.map(segment);
            touch.knots = touch.knots.map(|knot| knot.map(|knot| selection.knots[knot]));
            touch
        }));
        whole.body_sums.clear();
        for (place, body) in selection.bodies.iter().enumerate() {
            whole.body_sums.bodies[*body] = own.body_sums.bodies[place];
        }
        for (peak_n, tension_n) in whole.peak_tension_n.iter_mut().zip(&state.rope.tension) {
            *peak_n = tension_n.max(0.0);
        }
        whole.unconverged_peak_n.fill(0.0);
        for (from, to) in selection.segments(model) {
            whole.peak_tension_n[to.clone()].copy_from_slice(&own.peak_tension_n[from.clone()]);
            whole.unconverged_peak_n[to].copy_from_slice(&own.unconverged_peak_n[from]);
        }
    }
}

fn gather_rope(selection: &Selection, model: &Model, whole: &RopeState, own: &mut RopeState) {
    for (to, from) in selection.nodes(model) {
        for (to_list, from_list) in [
            (&mut own.position, &whole.position),
            (&mut own.velocity, &whole.velocity),
            (&mut own.earlier_position, &whole.earlier_position),
            (&mut own.earlier_velocity, &whole.earlier_velocity),
            (&mut own.seabed_grip, &whole.seabed_grip),
        ] {
            to_list[to.clone()].copy_from_slice(&from_list[from.clone()]);
        }
    }
    for (to, from) in selection.segments(model) {
        own.segment_length[to.clone()].copy_from_slice(&whole.segment_length[from.clone()]);
        own.tension[to.clone()].copy_from_slice(&whole.tension[from.clone()]);
        own.cut[to].copy_from_slice(&whole.cut[from]);
    }
    own.earlier_dt_s = whole.earlier_dt_s;
    let FrictionState { sites, push_n, normals, floats } = &mut own.friction;
    sites.clear();
    // Gear that touches the whale is in the step.
    sites.extend(whole.friction.sites.iter().filter_map(|site| {
        Some(with_segment(*site, selection.segment_of(model, segment_of(*site))?))
    }));
    debug_assert_eq!(sites.len(), whole.friction.sites.len(), "held gear touches no skin");
    push_n.clone_from(&whole.friction.push_n);
    normals.clone_from(&whole.friction.normals);
    floats.clone_from(&whole.friction.floats);
    own.solid_grips.clear();
    own.solid_grips.extend(whole.solid_grips.iter().filter_map(|grip| {
        let (solid, line) = (selection.part_of(grip.solid)?, selection.line_of(grip.line)?);
        Some(SolidGrip { solid, line, ..*grip })
    }));
    own.within.clear();
    own.within.extend(whole.within.iter().filter_map(|within| {
        let (solid, line) = (selection.part_of(within.solid)?, selection.line_of(within.line)?);
        Some(RopeWithin { solid, line, ..*within })
    }));
    own.rope_grips.clear();
    own.rope_grips.extend(whole.rope_grips.iter().filter_map(|grip| {
        let lines = [selection.line_of(grip.lines[0])?, selection.line_of(grip.lines[1])?];
        let knots = grip.knots.map(|knot| knot.and_then(|knot| selection.knot_of(knot)));
        Some(RopeGrip { lines, knots, ..*grip })
    }));
    debug_assert_eq!(own.rope_grips.len(), whole.rope_grips.len(), "held rope touches no rope");
}

fn scatter_rope(selection: &Selection, model: &Model, own: &RopeState, whole: &mut RopeState) {
    for (from, to) in selection.nodes(model) {
        for (to_list, from_list) in [
            (&mut whole.position, &own.position),
            (&mut whole.velocity, &own.velocity),
            (&mut whole.earlier_position, &own.earlier_position),
            (&mut whole.earlier_velocity, &own.earlier_velocity),
            (&mut whole.seabed_grip, &own.seabed_grip),
        ] {
            to_list[to.clone()].copy_from_slice(&from_list[from.clone()]);
        }
    }
    for (from, to) in selection.segments(model) {
        whole.segment_length[to.clone()].copy_from_slice(&own.segment_length[from.clone()]);
        whole.tension[to.clone()].copy_from_slice(&own.tension[from.clone()]);
        whole.cut[to].copy_from_slice(&own.cut[from]);
    }
    whole.earlier_dt_s = own.earlier_dt_s;
    let FrictionState { sites, push_n, normals, floats } = &mut whole.friction;
    sites.clear();
    sites.extend(
        own.friction
            .sites
            .iter()
            .map(|site| with_segment(*site, selection.segment_in(model, segment_of(*site)))),
    );
    push_n.clone_from(&own.friction.push_n);
    normals.clone_from(&own.friction.normals);
    floats.clone_from(&own.friction.floats);
    whole.solid_grips.retain(|grip| selection.line_of(grip.line).is_none());
    whole.solid_grips.extend(own.solid_grips.iter().map(|grip| SolidGrip {
        solid: selection.parts[grip.solid],
        line: selection.lines[grip.line],
        ..*grip
    }));
    whole.within.retain(|within| selection.line_of(within.line).is_none());
    whole.within.extend(own.within.iter().map(|within| RopeWithin {
        solid: selection.parts[within.solid],
        line: selection.lines[within.line],
        ..*within
    }));
    whole.rope_grips.clear();
    whole.rope_grips.extend(own.rope_grips.iter().map(|grip| RopeGrip {
        lines: grip.lines.map(|line| selection.lines[line]),
        knots: grip.knots.map(|knot| knot.map(|knot| selection.knots[knot])),
        ..*grip
    }));
}

fn gather_body_grips(selection: &Selection, whole: &BodyGrips, own: &mut BodyGrips) {
    own.contacts.clear();
    own.contacts.extend(
        whole
            .contacts
            .iter()
            .filter_map(|grip| Some(BodyGrip { part: selection.part_of(grip.part)?, ..*grip })),
    );
    debug_assert_eq!(own.contacts.len(), whole.contacts.len(), "held bodies touch no skin");
    own.floats.clone_from(&whole.floats);
}

/// A site of friction on another segment.
fn with_segment(site: u64, segment: usize) -> u64 {
    const { assert!(FACE_BITS < SEGMENT_BITS) };
    (segment as u64) << SEGMENT_BITS | site & ((1 << SEGMENT_BITS) - 1)
}

/// Distance of a point from a box; 0 within [m].
fn distance(bounds: &Bounds, place: DVec3) -> f64 {
    place.distance(place.clamp(bounds.low, bounds.high))
}

/// Measures the boxes about the gears.
fn measure(model: &Model, state: &State, boxes: &mut Vec<Bounds>) {
    boxes.clear();
    boxes.resize(model.gears.count, Bounds::EMPTY);
    for (nodes, gear) in model.line_nodes.iter().zip(&model.gears.of_line) {
        let places = &state.rope.position[nodes.clone()];
        boxes[*gear] = boxes[*gear].join(Bounds::around(places));
    }
    for ((body, of), gear) in state.bodies.iter().zip(&model.spec.bodies).zip(&model.gears.of_body)
    {
        let corners = of.corners().map(|corner| corner.length());
        let around = Bounds::around(&[body.position]).grown(corners.fold(0.0, f64::max));
        boxes[*gear] = boxes[*gear].join(around);
    }
}
