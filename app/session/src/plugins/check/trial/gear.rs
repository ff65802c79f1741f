//! A gear type, tried out.

use endline_sdk::{AttributeValue, GearAction, GearStep, GearType, HookError, LineEnd, Rig, Site};

use super::{Play, Random, Trial, bits, defaults, drawn, on_threads, plays_again};

/// Water depths at which a gear type may build itself [m]; one that it takes is enough.
const DEPTHS_M: [f64; 4] = [25.0, 10.0, 80.0, 200.0];
/// Sets of attributes, and steps of a run.
const SETS: u64 = 60;
const STEPS: usize = 60;

pub(super) fn run(gear: &dyn GearType, trial: &mut Trial<'_>) {
    let values = defaults(&gear.descriptor().attributes);
    let mut built = None;
    trial.check("defaults", || {
        let (rig, site) = build_somewhere(gear, &values).map_err(|error| error.message)?;
        let range = format!(
            "{} bodies, {} lines, {} links in {} m of water",
            rig.bodies.len(),
            rig.lines.len(),
            rig.links.len(),
            site.depth_m
        );
        act(gear, &values, rig.lines.len(), None).map_err(|error| error.message)?;
        built = Some((rig, site));
        Ok(range)
    });
    let Some((rig, site)) = built else { return };
    trial.check("ranges", || ranges(gear));
    trial.check("same rig", || match gear.build(&values, &site) {
        Ok(again) if again == rig => Ok("built the same rig again".to_owned()),
        Ok(_) => Err("built another rig from the same attributes: it keeps something, or asks clock or chance".to_owned()),
        Err(error) => Err(format!("does not build a second time: {}", error.message)),
    });
    let lines = rig.lines.len();
    let Ok(first) = act(gear, &values, lines, None) else { return };
    plays_again(trial, &first, |restored| act(gear, &values, lines, restored));
    trial.check("threads", || on_threads(&first, || act(gear, &values, lines, None)));
    trial.time("a step", STEPS, || act(gear, &values, lines, None).map(drop));
}

fn build_somewhere(
    gear: &dyn GearType,
    values: &[AttributeValue],
) -> Result<(Rig, Site), HookError> {
    let at = |depth_m: f64| {
        let site = Site { depth_m, current_m_s: [0.3, 0.0] };
        gear.build(values, &site).map(|rig| (rig, site))
    };
    DEPTHS_M[1..]
        .iter()
        .fold(at(DEPTHS_M[0]), |built, depth| built.or_else(|first| at(*depth).map_err(|_| first)))
}

/// At attributes drawn at random it builds a rig that fits together, or returns an error; the guard checks the rig.
fn ranges(gear: &dyn GearType) -> Result<String, String> {
    let (mut built, mut refused) = (0, 0);
    for set in 0..SETS {
        let mut random = Random(set);
        let values = drawn(&gear.descriptor().attributes, &mut random);
        let site = Site {
            depth_m: random.between(5.0, 200.0),
            current_m_s: [random.between(-1.0, 1.0), random.between(-1.0, 1.0)],
        };
        match gear.build(&values, &site) {
            Ok(_) => built += 1,
            Err(error) if refuses(&error) => refused += 1,
            Err(error) => return Err(error.message),
        }
    }
    Ok(format!(
        "{built} rigs built, {refused} refused with a reason, at attributes drawn within their ranges"
    ))
}

/// Whether an error names a change, and is no fault of the plugin's own.
fn refuses(error: &HookError) -> bool {
    let faults = [
        "failed inside",
        "it gave ",
        "which its rig lacks",
        "used twice in its rig",
        "names no ",
        " m long",
        "is laid through one place",
    ];
    !faults.iter().any(|fault| error.message.contains(fault))
}

/// A run of its steps with tensions that rise and vanish; from floats saved half way where some are given.
fn act(
    gear: &dyn GearType,
    values: &[AttributeValue],
    lines: usize,
    restored: Option<&[f64]>,
) -> Result<Play, HookError> {
    let mut random = Random(7);
    let tensions: Vec<Vec<[f64; 2]>> = (0..STEPS)
        .map(|_| {
            (0..lines)
                .map(|_| [random.between(-2e3, 5e3).max(0.0), random.between(-2e3, 5e3).max(0.0)])
                .collect()
        })
        .collect();
    Play::of(&tensions, gear.descriptor().state_len, restored, |step, end_tension_n, state| {
        let mut actions = Vec::new();
        let input = GearStep { time_s: step as f64, dt_s: 1.0, end_tension_n };
        gear.step(values, &input, state, &mut actions)?;
        Ok(bits(state.iter().copied()).chain(actions.iter().flat_map(numbers_of)).collect())
    })
}

fn numbers_of(action: &GearAction) -> [u64; 3] {
    match action {
        GearAction::CutLine { line, end } => {
            [1, u64::from(*line), u64::from(matches!(end, LineEnd::B))]
        }
        GearAction::ReleaseLink { link } => [2, u64::from(*link), 0],
    }
}
