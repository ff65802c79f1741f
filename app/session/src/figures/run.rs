//! Figures of a whole run, of its phases and events, and of the attempt that a study makes.

use endline_sim::metrics::Event;

use super::View::Table;
use super::{
    AUDIT, BODY, COST, Figure, LINE, LINK, PLUGIN, PROBE, Quantity, Value, WHALE, lines, list,
    object,
};
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
        "Whether the numbers are reliable: the run reached its end, rope passed through nothing, \
         and every number is finite. Unconverged solver steps, spikes and normal force beyond the \
         limit for rope are within their bounds.",
        Quantity::Flag,
        |run: &Report| run.is_valid().into(),
    )
    .shown(&[Table])
    .column(10),
    Figure::new(
        "headline",
        "headline",
        "The result in sentences: outcome, greatest tension, partings, and reasons for doubt.",
        Quantity::Ids,
        |run: &Report| {
            run.headline.iter().map(|sentence| sentence.text.clone()).collect::<Vec<_>>().into()
        },
    ),
    Figure::new(
        "invalid_because",
        "invalid because",
        "Reason for an invalid run; empty if it is valid.",
        Quantity::Ids,
        |run: &Report| (&run.invalid_because).into(),
    ),
    Figure::new(
        "stopped",
        "stopped",
        "Reason for a stop before the end of the run; none if it reached its end.",
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
        "Steps before rope was first near the whale.",
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
        "cost",
        "cost",
        "Computing time by part of the program.",
        Quantity::Group,
        |run: &Report| object(COST, &run.timing.cost),
    ),
    Figure::new(
        "events",
        "events",
        "One object for each event, in the order of detection.",
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
        "Id of the weak link or line that parted first; none if all hold.",
        Quantity::Id,
        |run: &Report| run.first_parted().map(|(_, id)| id).into(),
    )
    .not_in_json()
    .column(304),
    Figure::new(
        "parted_at_s",
        "parted at",
        "Time at which the first weak link or line parted; none if all hold.",
        Quantity::Moment,
        |run: &Report| run.first_parted().map(|(time_s, _)| time_s).into(),
    )
    .not_in_json()
    .column(305),
    Figure::new(
        "needed_rope_N",
        "strength of rope needed",
        "Least strength that every line must deliver at its weakest place so that no rope parts in this run.",
        Quantity::Force,
        |run: &Report| run.needed.needed_rope_n.into(),
    )
    .not_in_json()
    .column(308),
    Figure::new(
        "needed_link_N",
        "rating of weak links needed",
        "Least mean rating of every weak link with which none parts in this run.",
        Quantity::Force,
        |run: &Report| run.needed.needed_link_n.into(),
    )
    .not_in_json()
    .column(309),
    Figure::new(
        "needed_place_N",
        "strength of weak places needed",
        "Least strength that every weak place of the lines must have so that none parts in this run; none without weak places.",
        Quantity::Force,
        |run: &Report| run.needed.needed_place_n.into(),
    )
    .not_in_json()
    .column(310),
];

/// A run that a study asked for, whether or not there is one.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// Index of the encounter.
    pub encounter: u32,
    /// Id of the option.
    pub option: String,
    /// The weight of the encounter.
    pub weight: f64,
    /// Key by which `endline study replay` finds it.
    pub replay_key: String,
    /// Whether its run ends where something parts.
    pub until_parted: bool,
    /// Reason for a missing or invalid run; empty if it is valid.
    pub fault: String,
}

/// Figures of a run that a study asked for.
pub static ATTEMPT: &[Figure<Attempt>] = &[
    Figure::new(
        "encounter",
        "encounter",
        "Index of the encounter.",
        Quantity::Count,
        |attempt: &Attempt| attempt.encounter.into(),
    )
    .not_in_json()
    .column(0),
    Figure::new("option", "option", "Id of the option.", Quantity::Id, |attempt: &Attempt| {
        (&attempt.option).into()
    })
    .not_in_json()
    .column(1),
    Figure::new(
        "weight",
        "weight",
        "Weight of the encounter, if encounters are drawn from proposals; else 1.",
        Quantity::Number,
        |attempt: &Attempt| attempt.weight.into(),
    )
    .not_in_json()
    .column(3),
    Figure::new(
        "replay_key",
        "replay key",
        "Study hash, encounter and option, which define the run.",
        Quantity::Id,
        |attempt: &Attempt| (&attempt.replay_key).into(),
    )
    .not_in_json()
    .column(2),
    Figure::new(
        "until_parted",
        "until parted",
        "Whether the run ends where something parts, so that its outcome is known only if nothing parted.",
        Quantity::Flag,
        |attempt: &Attempt| attempt.until_parted.into(),
    )
    .not_in_json()
    .column(4),
    Figure::new(
        "fault",
        "fault",
        "Reason for a missing or invalid run; empty if it is valid.",
        Quantity::Id,
        |attempt: &Attempt| (&attempt.fault).into(),
    )
    .not_in_json()
    .column(11),
];

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
        "Simulated time divided by real time; 0 if the phase is empty.",
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
        "Result of statics, in words.",
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

/// Figures of an event of a run.
pub static EVENT: &[Figure<Event>] = &[
    Figure::new(
        "time_s",
        "time",
        "Time of the event: the end of its step.",
        Quantity::Moment,
        |event: &Event| event.time_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "kind",
        "event",
        "Kind of the event, such as `link_parted`.",
        Quantity::Name,
        |event: &Event| event.kind.name().into(),
    )
    .shown(&[Table]),
    Figure::new(
        "subject",
        "of",
        "Id of the object of the event.",
        Quantity::Name,
        |event: &Event| (&event.subject).into(),
    )
    .shown(&[Table]),
    Figure::new("value", "value", "Value of the event.", Quantity::Measured, |event: &Event| {
        Value::Measured { value: event.value, unit: event.kind.unit() }
    })
    .shown(&[Table]),
    Figure::new("unit", "unit", "Unit of the value.", Quantity::Id, |event: &Event| {
        event.kind.unit().into()
    }),
];
