//! Figures of a whole run: what was run, the audit of the solver, the phases, the settled state.

use std::collections::BTreeMap;

use endline_sim::pace::LimitedBy;

use super::View::Table;
use super::{BODY, EVENT, Figure, LINE, LINK, PROBE, Quantity, Value, WHALE, lines, list, object};
use crate::plugins::PluginUsed;
use crate::report::{Report, SCHEMA};
use crate::timing::Phase;

/// Figures of a run.
pub static RUN: &[Figure<Report>] = &[
    Figure::new(
        "schema",
        "schema",
        "Name of the schema: `endline.run/1`.",
        Quantity::Id,
        |_: &Report| SCHEMA.into(),
    ),
    Figure::new(
        "scenario",
        "scenario",
        "File of the scenario, as the user named it.",
        Quantity::Id,
        |run: &Report| (&run.scenario).into(),
    ),
    Figure::new("seed", "seed", "Seed of the run.", Quantity::Count, |run: &Report| {
        run.seed.into()
    })
    .shown(&[Table]),
    Figure::new(
        "simulated_s",
        "simulated time",
        "Simulated time.",
        Quantity::Duration,
        |run: &Report| run.simulated_s.into(),
    )
    .shown(&[Table])
    .column(14),
    Figure::new(
        "wall_s",
        "real time",
        "Real time of the steps, without the statics.",
        Quantity::Duration,
        |run: &Report| run.timing.whole().wall_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "times_real_time",
        "times real time",
        "Simulated time divided by real time.",
        Quantity::Number,
        |run: &Report| run.timing.whole().times_real_time().into(),
    )
    .shown(&[Table]),
    Figure::new("dt_s", "step", "Step between inputs.", Quantity::Step, |run: &Report| {
        run.dt_s.into()
    })
    .shown(&[Table]),
    Figure::new("steps", "steps", "Number of steps taken.", Quantity::Count, |run: &Report| {
        run.steps.into()
    })
    .shown(&[Table]),
    Figure::new("nodes", "rope nodes", "Number of rope nodes.", Quantity::Count, |run: &Report| {
        run.nodes.into()
    })
    .shown(&[Table]),
    Figure::new(
        "triangles",
        "triangles of skin",
        "Number of triangles of the whale's skin.",
        Quantity::Count,
        |run: &Report| run.triangles.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "state_hash",
        "state hash",
        "Hash of the last state.",
        Quantity::Id,
        |run: &Report| (&run.state_hash).into(),
    )
    .shown(&[Table])
    .column(15),
    Figure::new(
        "valid",
        "valid",
        "Whether the numbers can be trusted: the run reached its end, rope passed through nothing, \
         every number is finite.",
        Quantity::Flag,
        |run: &Report| run.is_valid().into(),
    )
    .shown(&[Table])
    .column(10),
    Figure::new(
        "invalid_because",
        "invalid because",
        "Why the run is not valid; empty where it is.",
        Quantity::Ids,
        |run: &Report| (&run.invalid_because).into(),
    ),
    Figure::new(
        "stopped",
        "stopped",
        "Why the run stopped before its end; none where it did not.",
        Quantity::Id,
        |run: &Report| run.stopped.as_ref().into(),
    ),
    Figure::new("audit", "audit", "Counters of the solver.", Quantity::Group, |run: &Report| {
        object(AUDIT, run)
    }),
    Figure::new("lines", "lines", "One object for each line.", Quantity::Group, |run: &Report| {
        list(LINE, &lines(&run.summary, &run.settled_tension_n))
    }),
    Figure::new(
        "links",
        "weak links",
        "One object for each weak link.",
        Quantity::Group,
        |run: &Report| list(LINK, &run.summary.links),
    ),
    Figure::new(
        "bodies",
        "bodies",
        "One object for each body.",
        Quantity::Group,
        |run: &Report| list(BODY, &run.summary.bodies),
    ),
    Figure::new(
        "probes",
        "probes",
        "One object for each probe.",
        Quantity::Group,
        |run: &Report| list(PROBE, &run.summary.probes),
    ),
    Figure::new(
        "whale",
        "whale",
        "The whale; none without one.",
        Quantity::Group,
        |run: &Report| run.summary.whale.as_ref().map(|whale| object(WHALE, whale)).into(),
    ),
    Figure::new(
        "approach",
        "approach",
        "Steps before rope first came near the whale.",
        Quantity::Group,
        |run: &Report| object(PHASE, &run.timing.approach),
    ),
    Figure::new(
        "contact",
        "contact",
        "That step and all later ones.",
        Quantity::Group,
        |run: &Report| object(PHASE, &run.timing.contact),
    ),
    Figure::new(
        "settled",
        "settled",
        "The statics before the run.",
        Quantity::Group,
        |run: &Report| object(SETTLED, run),
    ),
    Figure::new(
        "events",
        "events",
        "One object for each event, in the order in which they were noticed.",
        Quantity::Group,
        |run: &Report| list(EVENT, &run.events),
    ),
    Figure::new("version", "version", "Version of Endline.", Quantity::Id, |_: &Report| {
        crate::VERSION.into()
    }),
    Figure::new(
        "model_hash",
        "model hash",
        "BLAKE3 of the scenario, the gear library and the options.",
        Quantity::Id,
        |run: &Report| (&run.model_hash).into(),
    ),
    Figure::new(
        "plugins",
        "plugins",
        "One object for each plugin of the model.",
        Quantity::Group,
        |run: &Report| list(PLUGIN, &run.plugins),
    ),
    Figure::new(
        "peak_tension_N",
        "greatest tension",
        "Greatest tension of any line.",
        Quantity::Force,
        |run: &Report| run.greatest().map(|line| line.peak_tension_n).into(),
    )
    .not_in_json()
    .column(300),
    Figure::new(
        "peak_line",
        "line of the greatest tension",
        "Id of the line with the greatest tension.",
        Quantity::Id,
        |run: &Report| run.greatest().map(|line| &line.id).into(),
    )
    .not_in_json()
    .column(301),
    Figure::new(
        "peak_at_s",
        "greatest tension at",
        "Time of the greatest tension.",
        Quantity::Moment,
        |run: &Report| run.greatest().map(|line| line.peak_at_s).into(),
    )
    .not_in_json()
    .column(302),
    Figure::new(
        "link_peak_N",
        "greatest tension at a weak link",
        "Greatest tension at any weak link.",
        Quantity::Force,
        |run: &Report| {
            run.summary.links.iter().map(|link| link.peak_tension_n).reduce(f64::max).into()
        },
    )
    .not_in_json()
    .column(303),
    Figure::new(
        "parted",
        "parted",
        "Id of the weak link or line that parted first; none where all hold.",
        Quantity::Id,
        |run: &Report| run.first_parted().map(|(_, id)| id).into(),
    )
    .not_in_json()
    .column(304),
    Figure::new(
        "parted_at_s",
        "parted at",
        "Time at which the first weak link or line parted; none where all hold.",
        Quantity::Moment,
        |run: &Report| run.first_parted().map(|(time_s, _)| time_s).into(),
    )
    .not_in_json()
    .column(305),
];

/// Counters of the solver's work.
pub static AUDIT: &[Figure<Report>] = &[
    Figure::new(
        "tunnelled",
        "rope through skin",
        "Times rope passed through skin.",
        Quantity::Count,
        |run: &Report| run.audit.tunnelled.into(),
    )
    .shown(&[Table])
    .column(12)
    .alarming(),
    Figure::new(
        "max_penetration_m",
        "deepest penetration",
        "Greatest depth to which the rope's surface sank into the skin.",
        Quantity::SmallLength,
        |run: &Report| run.audit.max_penetration_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "ropes_crossed",
        "rope through rope",
        "Times rope passed through rope.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_crossed.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "ropes_through",
        "ropes through each other since the start",
        "Most pairs of segments at a time that have run through each other since the start, and \
         are left alone.",
        Quantity::Count,
        |run: &Report| run.audit.ropes_through.into(),
    ),
    Figure::new(
        "rope_steps",
        "solver steps with rope on rope",
        "Solver steps, away from the whale, with rope on rope.",
        Quantity::Count,
        |run: &Report| run.audit.rope_steps.into(),
    ),
    Figure::new(
        "least_distance_m",
        "least distance from skin",
        "Least distance of the rope's centre line from skin that it touched; none where it touched \
         none.",
        Quantity::SmallLength,
        |run: &Report| run.audit.least_distance_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "winding_jumps",
        "winding jumps",
        "Steps in which wraps jumped by more than 0.3 turns along unbroken contact.",
        Quantity::Count,
        |run: &Report| run.summary.whale.as_ref().map_or(0, |whale| whale.winding_jumps).into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "non_finite",
        "numbers not finite",
        "Numbers that were not finite.",
        Quantity::Count,
        |run: &Report| run.audit.non_finite.into(),
    )
    .shown(&[Table])
    .alarming(),
    Figure::new(
        "solver_steps",
        "solver steps",
        "Solver steps taken.",
        Quantity::Count,
        |run: &Report| run.audit.solver_steps.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "contact_steps",
        "solver steps in contact",
        "Solver steps with rope near the whale.",
        Quantity::Count,
        |run: &Report| run.audit.contact_steps.into(),
    ),
    Figure::new(
        "halved",
        "solver steps redone",
        "Solver steps that were redone shorter.",
        Quantity::Count,
        |run: &Report| run.audit.halved.into(),
    ),
    Figure::new(
        "unconverged",
        "solver steps not converged",
        "Solver steps accepted above the wanted residual.",
        Quantity::Count,
        |run: &Report| run.audit.unconverged.into(),
    )
    .shown(&[Table])
    .column(13),
    Figure::new(
        "passes",
        "Newton passes",
        "Newton passes in all.",
        Quantity::Count,
        |run: &Report| run.audit.passes.into(),
    ),
    Figure::new(
        "splits",
        "segments split",
        "Segments split, each together with a merge, as resolution followed the whale.",
        Quantity::Count,
        |run: &Report| run.audit.splits.into(),
    ),
    Figure::new(
        "postures_held",
        "steps with joints at their limits",
        "Steps in which the whale's posture was held at the ranges of its joints.",
        Quantity::Count,
        |run: &Report| run.audit.postures_held.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "steps_limited_by",
        "solver steps by what limited them",
        "Solver steps by what kept them from being longer: `inputs`, `accuracy`, `snap`, \
         `contact`, `parting`, `convergence`.",
        Quantity::Group,
        |run: &Report| Value::Counts(limits(run)),
    ),
    Figure::new(
        "steps_mostly_limited_by",
        "solver steps mostly limited by",
        "What limited most of the solver steps, in words.",
        Quantity::Id,
        |run: &Report| Value::Text(mostly(run)),
    )
    .shown(&[Table]),
];

fn limits(run: &Report) -> BTreeMap<&'static str, u64> {
    let names = LimitedBy::ALL.iter().map(|limit| limit.name());
    names.zip(run.audit.limited_by).collect()
}

fn mostly(run: &Report) -> String {
    let (limit, steps) = LimitedBy::mostly(&run.audit.limited_by);
    let share = steps as f64 / run.audit.solver_steps.max(1) as f64;
    format!("{} ({:.0} %)", limit.words(), 100.0 * share)
}

/// Figures of a phase of a run.
pub static PHASE: &[Figure<Phase>] = &[
    Figure::new(
        "simulated_s",
        "simulated time",
        "Simulated time.",
        Quantity::Duration,
        |phase: &Phase| phase.simulated_s.into(),
    )
    .shown(&[Table]),
    Figure::new("wall_s", "real time", "Real time.", Quantity::Duration, |phase: &Phase| {
        phase.wall_s.into()
    })
    .shown(&[Table]),
    Figure::new(
        "times_real_time",
        "times real time",
        "Simulated time divided by real time; 0 where the phase is empty.",
        Quantity::Number,
        |phase: &Phase| phase.times_real_time().into(),
    )
    .shown(&[Table]),
];

/// Figures of the statics before a run.
pub static SETTLED: &[Figure<Report>] = &[
    Figure::new(
        "settled",
        "started from rest",
        "Whether the run began from rest.",
        Quantity::Flag,
        |run: &Report| run.settled.converged.into(),
    ),
    Figure::new(
        "outcome",
        "statics",
        "What statics found, in words.",
        Quantity::Id,
        |run: &Report| (&run.settled.outcome).into(),
    ),
    Figure::new(
        "residual_N",
        "greatest force out of balance",
        "Greatest force out of balance.",
        Quantity::Force,
        |run: &Report| run.settled.residual_n.into(),
    ),
    Figure::new(
        "wall_s",
        "real time of the statics",
        "Real time of the statics.",
        Quantity::Duration,
        |run: &Report| run.timing.settle_wall_s.into(),
    ),
];

/// Figures of a plugin of the model.
pub static PLUGIN: &[Figure<PluginUsed>] = &[
    Figure::new("id", "plugin", "Id of the plugin.", Quantity::Id, |plugin: &PluginUsed| {
        (&plugin.id).into()
    }),
    Figure::new(
        "version",
        "version",
        "Version of the plugin.",
        Quantity::Id,
        |plugin: &PluginUsed| (&plugin.version).into(),
    ),
    Figure::new(
        "file_hash",
        "file hash",
        "BLAKE3 of the file it was loaded from; empty where it is linked in.",
        Quantity::Id,
        |plugin: &PluginUsed| (&plugin.file_hash).into(),
    ),
];
