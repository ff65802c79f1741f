//! One step of a run: from inputs to the next state.
//!
//! A step of the model (`settings.step_s`, one input) is divided into solver steps: whole while the
//! rope is free, or as long as its error allows (`pace.rs`) where the model asks for that; `settings.contact_step_s` while rope
//! is near the whale; halved where a solver step does not converge or where a link would part late. Halving stops at `settings.least_step_s`, which ends the run.

use endline_sdk::Controls;

use crate::contact::ContactPoint;
use crate::contact::near::MARGIN_M;
use crate::contact::ropes::RopeTouch;
use crate::contact::work::{ContactWork, touch_by_part};
use crate::gear_hook::{self, GearWork};
use crate::model::{Model, Settings};
use crate::pace::{self, LimitedBy, Pace};
use crate::regrid::{RegridWork, regrid};
use crate::solver::Solver;
use crate::state::{State, WhaleState};
use crate::substep::{self, Refused, Took};
use crate::whale::drive::{drive, pose_between};
use crate::whale::hitch;
use crate::whale::kinetic::pull::{RopeImpulse, Times, centre_of};
use crate::whale::pilot;

/// Rope this near to the whale's path over a whole step makes the solver steps short [m].
const NEAR_M: f64 = MARGIN_M + 0.12;

/// Times a model's step may be taken back and begun with shorter solver steps.
const MOST_TAKEN_BACK: usize = 3;

/// All that enters a step from outside; recorded, so that a run replays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The pilot's controls.
    pub controls: Controls,
}

/// Scratch of the solver and what the last step left for readers; dropping it between two steps changes no bit.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Places where rope pressed on skin at the end of the last step.
    pub contacts: Vec<ContactPoint>,
    /// Greatest tension of each segment over the solver steps of the last step [N].
    pub peak_tension_n: Vec<f64>,
    /// Places where rope pressed on rope at the end of the last step.
    pub rope_touches: Vec<RopeTouch>,
    /// Counters of the run so far.
    pub audit: Audit,
    pub(crate) solver: Solver,
    pub(crate) contact: Option<ContactWork>,
    before: Option<State>,
    gear: GearWork,
    regrid: Option<RegridWork>,
    /// The whale at the start and at the end of the step.
    whale: Option<Box<[WhaleState; 2]>>,
    /// What rope gave the whale over the solver steps of the step.
    pulled: RopeImpulse,
}

/// What a run did that its reader should know; see `docs/physics.md`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Audit {
    /// Rope passed through skin, found by an exact test over every sub-move.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Rope passed through rope, found by an exact test over every sub-move.
    pub ropes_crossed: u64,
    /// Most pairs of segments at a time that run through each other since the start, and are left alone.
    pub ropes_through: u64,
    /// Solver steps, away from the whale, that had rope on rope.
    pub rope_steps: u64,
    /// Nearest that the rope's centre line came to skin it touched [m]; `None` where it never touched.
    pub least_distance_m: Option<f64>,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Solver steps taken.
    pub solver_steps: u64,
    /// Solver steps that had rope near the whale.
    pub contact_steps: u64,
    /// Solver steps that were redone shorter.
    pub halved: u64,
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Newton passes in all.
    pub passes: u64,
    /// Segments split, each paid for by a merge, as resolution followed the whale.
    pub splits: u64,
    /// Steps in which the whale's motion asked for a posture beyond the joints' ranges, and was held.
    pub postures_held: u64,
    /// Solver steps by what kept them from being longer, in the order of [`LimitedBy::ALL`].
    pub limited_by: [u64; LimitedBy::ALL.len()],
}

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Time at which it stopped [s].
    pub time_s: f64,
    /// Which part, such as `line endline-top` or a plugin's id.
    pub part: String,
    /// The reason, for the user.
    pub reason: String,
}

impl Workspace {
    /// Scratch for a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self {
            contacts: Vec::new(),
            peak_tension_n: vec![0.0; model.segment_count],
            rope_touches: Vec::new(),
            audit: Audit::default(),
            solver: Solver::new(model),
            contact: ContactWork::new(model),
            before: None,
            gear: GearWork::default(),
            regrid: RegridWork::new(model),
            whale: None,
            pulled: RopeImpulse::default(),
        }
    }
}

/// Advances `state` by the model's step.
///
/// # Errors
/// With the part and the reason, where the run cannot go on; `state` is then as it was before the step.
pub fn step(
    model: &Model,
    input: &Input,
    state: &mut State,
    workspace: &mut Workspace,
) -> Result<(), Stop> {
    match &mut workspace.before {
        Some(before) => before.clone_from(state),
        none => *none = Some(state.clone()),
    }
    let done = try_step(model, input, state, workspace);
    if let (Err(_), Some(before)) = (&done, &workspace.before) {
        state.clone_from(before);
    }
    done
}

fn try_step(
    model: &Model,
    input: &Input,
    state: &mut State,
    workspace: &mut Workspace,
) -> Result<(), Stop> {
    let mut whale = workspace.whale.take();
    let moved = move_whale(model, input, state, &mut whale);
    let done = moved.and_then(|held| {
        workspace.audit.postures_held += u64::from(held);
        paced_steps(model, state, workspace, whale.as_deref())
    });
    if let (Some(now), Some([_, after])) = (&mut state.whale, whale.as_deref_mut()) {
        if let Some(whale) = &model.spec.whale {
            [after.contact_force_n, after.contact_port_m] =
                touch_by_part(&whale.skin, &workspace.contacts);
            if let Some(kinetic) = &whale.kinetic {
                workspace.pulled.give(kinetic, model.spec.settings.step_s, after);
            }
        }
        now.clone_from(after);
    }
    workspace.whale = whale;
    done?;
    state.time_s = model.spec.settings.step_s * (state.step + 1) as f64;
    state.step += 1;
    gear_hook::act(model, state, &mut workspace.gear)?;
    pilot::look(model, state);
    Ok(())
}

/// Solver steps to the end of the model's step, all taken back and begun shorter where one misses the wanted error by far.
fn paced_steps(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> Result<(), Stop> {
    if model.node_count == 0 && model.spec.bodies.is_empty() {
        return Ok(()); // a whale alone: there is nothing to solve
    }
    let settings = &model.spec.settings;
    for taken_back in 0..=MOST_TAKEN_BACK {
        workspace.peak_tension_n.fill(0.0);
        workspace.contacts.clear();
        workspace.pulled = RopeImpulse::default();
        let splits = regrid(model, state, &mut workspace.regrid);
        workspace.audit.splits += if taken_back == 0 { splits } else { 0 };
        let near = near_whale(model, state, workspace, whale);
        let longest =
            if near { settings.contact_step_s.min(settings.step_s) } else { settings.step_s };
        if solver_steps(model, state, workspace, whale, (longest, taken_back < MOST_TAKEN_BACK))? {
            break;
        }
        workspace.audit.halved += 1;
        take_back(state, workspace);
    }
    Ok(())
}

/// Goes back to where the model's step began, with the shorter solver step.
fn take_back(state: &mut State, workspace: &Workspace) {
    let (step_s, limit) = (state.pace.step_s, state.pace.limit);
    if let Some(before) = &workspace.before {
        state.clone_from(before);
    }
    (state.pace.step_s, state.pace.limit) = (step_s, limit);
}

/// Lets the whale swim through the step: where it starts and where it ends; whether its posture was held.
fn move_whale(
    model: &Model,
    input: &Input,
    state: &State,
    whale: &mut Option<Box<[WhaleState; 2]>>,
) -> Result<bool, Stop> {
    let Some(now) = &state.whale else {
        *whale = None;
        return Ok(false);
    };
    let [from, to] = &mut **whale.get_or_insert_with(|| Box::new([now.clone(), now.clone()]));
    from.clone_from(now);
    drive(model, input, from, state.time_s, to)
}

/// Whether rope may come near the whale in this step.
fn near_whale(
    model: &Model,
    state: &State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> bool {
    let (Some(work), Some([from, to])) = (&mut workspace.contact, whale) else { return false };
    pose_between(model, from, to, 0.0, &mut work.bones[0]);
    pose_between(model, from, to, 1.0, &mut work.bones[1]);
    let step_s = model.spec.settings.step_s;
    let [start, end] = &work.bones;
    work.near.any(
        [start, end],
        &state.rope.position,
        |node| state.rope.velocity[node] * step_s,
        NEAR_M,
    )
}

/// Solver steps to the end of the model's step, halved where one is refused; `false` where a step missed its wanted error
/// and may be taken back.
fn solver_steps(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
    (mut longest, may_take_back): (f64, bool),
) -> Result<bool, Stop> {
    let settings = &model.spec.settings;
    let start = settings.step_s * state.step as f64;
    let end = settings.step_s * (state.step + 1) as f64;
    let (mut halvings, mut refused) = (0_u32, LimitedBy::Convergence);
    while end - state.time_s > 1e-9 * settings.step_s {
        let left = end - state.time_s;
        let (chosen, limit) = wanted(settings, &state.pace, longest);
        let wanted = chosen / f64::from(1_u32 << halvings.min(30));
        let dt = left / (left / wanted - 1e-9).ceil().max(1.0);
        if let (Some(work), Some([from, to])) = (&mut workspace.contact, whale) {
            let share = |time: f64| ((time - start) / settings.step_s).clamp(0.0, 1.0);
            pose_between(model, from, to, share(state.time_s), &mut work.bones[0]);
            pose_between(model, from, to, share(state.time_s + dt), &mut work.bones[1]);
            workspace.solver.trial.hitches.move_to(model, [&work.bones[0], &work.bones[1]]);
        }
        let earlier_dt = state.rope.earlier_dt_s;
        match substep::solver_step(model, state, workspace, dt, halvings > 0) {
            Ok(took) => {
                feel(model, state, workspace, whale, dt);
                let limit = if halvings > 0 { refused } else { limit };
                workspace.audit.limited_by[limit as usize] += 1;
                halvings = halvings.saturating_sub(1);
                if settings.auto_step
                    && pace_on(model, state, took, dt, earlier_dt)
                    && may_take_back
                {
                    return Ok(false);
                }
            }
            Err(Refused::RopesMeet) => longest = settings.contact_step_s.min(longest),
            Err(why) if why.may_halve() && 0.5 * dt >= settings.least_step_s => {
                refused = if why == Refused::PartsTooLate {
                    LimitedBy::Parting
                } else {
                    LimitedBy::Convergence
                };
                halvings += 1;
                workspace.audit.halved += 1;
            }
            Err(why) => return Err(stop(model, state, workspace, why)),
        }
    }
    Ok(true)
}

/// Takes in what rope gave a kinetic whale in the solver step that has just ended; a kinematic one has no use for it.
fn feel(
    model: &Model,
    state: &State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
    dt: f64,
) {
    let Some(kinetic) = model.spec.whale.as_ref().and_then(|whale| whale.kinetic.as_ref()) else {
        return;
    };
    let Some([_, after]) = whale else { return };
    let centre = centre_of(kinetic, after);
    let end_s = model.spec.settings.step_s * (state.step + 1) as f64;
    let times = Times { dt, left: (end_s - state.time_s).max(0.0) };
    workspace.pulled.add_contacts(&workspace.contacts, centre, times);
    for (force, place) in hitch::pulls(model, state) {
        workspace.pulled.add(force, place - centre, times);
    }
}

/// The longest solver step to try now, and what limits it.
fn wanted(settings: &Settings, pace: &Pace, longest: f64) -> (f64, LimitedBy) {
    if settings.auto_step && pace.step_s > 0.0 && pace.step_s < longest {
        (pace.step_s, pace.limit)
    } else if longest < settings.step_s {
        (longest, LimitedBy::Contact)
    } else {
        (longest, LimitedBy::Inputs)
    }
}

/// Chooses the step after this one; whether this one should be taken back.
fn pace_on(model: &Model, state: &mut State, took: Took, dt: f64, earlier_dt: f64) -> bool {
    let settings = &model.spec.settings;
    match took {
        Took::Parted => state.pace.restart(pace::PARTED_S.min(settings.step_s), LimitedBy::Parting),
        Took::Touching => {
            state.pace.restart(settings.contact_step_s.min(settings.step_s), LimitedBy::Contact)
        }
        Took::Free => return pace::choose(model, state, dt, earlier_dt),
    }
    false
}

/// The reason a run ends where even the shortest step is refused.
fn stop(model: &Model, state: &State, workspace: &Workspace, why: Refused) -> Stop {
    let line = || {
        workspace
            .solver
            .worst_line(model)
            .map_or_else(|| "model".into(), |line| format!("line {}", model.spec.lines[line].id))
    };
    let (part, reason) = match why {
        Refused::NotFinite => {
            (line(), "its numbers are no longer finite at the shortest step; check stiffness, mass and current of this part".into())
        }
        Refused::NotConverged => {
            (line(), "no balance of forces was found at the shortest step; check strength and stiffness of this part".into())
        }
        Refused::PartsTooLate => (line(), "it parts faster than the shortest step can follow".into()),
        Refused::Crossed(segment) => {
            let line = &model.spec.lines[model.segment_line[segment]].id;
            (format!("line {line}"), "rope crosses the whale's skin where the run starts; move the whale or the gear apart".into())
        }
        Refused::Pinched(segment, triangle) => {
            let line = &model.spec.lines[model.segment_line[segment]].id;
            let region = model.spec.whale.as_ref().map_or("skin", |whale| whale.skin.regions[triangle].part().name());
            let reason = format!("rope is pinched at the whale's {region} by parts of the skin that close on it harder than rope can bear");
            (format!("line {line}"), reason)
        }
        Refused::WentThrough(segment, solid) => {
            let line = &model.spec.lines[model.segment_line[segment]].id;
            let solid = crate::solids::name_of(model, solid);
            (format!("line {line}"), format!("rope goes through {solid} even at the shortest step; use shorter segments or a slower start"))
        }
        Refused::RopesPinched([segment, other]) => {
            let line = |segment: usize| &model.spec.lines[model.segment_line[segment]].id;
            let reason = format!("it is pressed into line {} harder than rope can bear; check what pulls on both", line(other));
            (format!("line {}", line(segment)), reason)
        }
        Refused::RopesMeet => (line(), "rope meets rope in a step that cannot be made shorter".into()),
        Refused::Plugin(failed) => (failed.id, failed.message),
    };
    Stop { time_s: state.time_s, part, reason }
}
