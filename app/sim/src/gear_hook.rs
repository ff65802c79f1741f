//! Gear types during a run: each is called once per step with the tensions of its lines, and may cut lines or release links.

use endline_sdk::{GearAction, GearStep, LineEnd};

use crate::model::Model;
use crate::parting::{cut, link_segment, record_parted_line};
use crate::state::State;
use crate::step::Stop;

/// Buffers for the calls of gear types.
#[derive(Clone, Debug, Default)]
pub(crate) struct GearWorkspace {
    tensions: Vec<[f64; 2]>,
    actions: Vec<GearAction>,
}

/// Calls every gear type and executes its actions.
/// Errors: reports the plugin's id if it fails, or if it refers to a line or link that it did not build.
pub(crate) fn act(model: &Model, state: &mut State, work: &mut GearWorkspace) -> Result<(), Stop> {
    let GearWorkspace { tensions, actions } = work;
    for (index, hook) in model.spec.gear.iter().enumerate() {
        tensions.clear();
        tensions.extend(hook.lines.iter().map(|line| end_tensions(model, state, *line)));
        actions.clear();
        let input = GearStep {
            time_s: state.time_s,
            dt_s: model.spec.settings.step_s,
            end_tension_n: tensions,
        };
        let stop = |time_s: f64, reason: String| Stop {
            time_s,
            part: hook.gear.descriptor().id.to_string(),
            reason,
        };
        let mut floats = std::mem::take(&mut state.gear[index]);
        let answer = hook.gear.step(&hook.attributes, &input, &mut floats, actions);
        state.gear[index] = floats;
        answer.map_err(|error| stop(state.time_s, error.message))?;
        for action in actions.drain(..) {
            execute(model, state, index, action).map_err(|reason| stop(state.time_s, reason))?;
        }
    }
    Ok(())
}

/// Tension at the outer ends of a line's first and last piece [N].
fn end_tensions(model: &Model, state: &State, [first, last]: [usize; 2]) -> [f64; 2] {
    [model.line_segments[first].start, model.line_segments[last].end - 1]
        .map(|segment| state.rope.tension[segment].max(0.0))
}

fn execute(
    model: &Model,
    state: &mut State,
    hook: usize,
    action: GearAction,
) -> Result<(), String> {
    let hook = &model.spec.gear[hook];
    match action {
        GearAction::CutLine { line, end } => {
            let Some(&[first, last]) = hook.lines.get(line as usize) else {
                return Err(format!("asked to cut line {line}, which it did not build"));
            };
            let segment = if end == LineEnd::A {
                model.line_segments[first].start
            } else {
                model.line_segments[last].end - 1
            };
            if !state.rope.cut[segment] {
                record_parted_line(model, state, segment, None);
                cut(model, state, segment);
            }
        }
        GearAction::ReleaseLink { link } => {
            let Some(&link) = hook.links.get(link as usize) else {
                return Err(format!("asked to release link {link}, which it did not build"));
            };
            let segment = link_segment(model, &model.spec.links[link]);
            if !state.rope.cut[segment] {
                state.link_parted_s[link] = Some(state.time_s);
                cut(model, state, segment);
            }
        }
    }
    state.rope.earlier_dt_s = 0.0;
    Ok(())
}
