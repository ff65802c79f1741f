//! Figures of lines, weak links, bodies and probes, and of the plugins of a model.

use endline_sdk::BodyPart;
use endline_sim::metrics::{BodySummary, LineSummary, LinkSummary, ProbeSummary, Summary};

use super::View::{Compare, Summary as InSummary, Table};
use super::{Figure, Quantity, Value};
use crate::plugins::PluginUsed;

/// A line of a run.
#[derive(Clone, Debug)]
pub struct Line {
    /// The measurements.
    pub summary: LineSummary,
    /// Greatest tension of any segment in the settled state [N]; `None` where it is not at hand.
    pub settled_tension_n: Option<f64>,
}

/// The lines of a summary, with their settled tensions so far as they are given [N].
pub fn lines(summary: &Summary, settled_tension_n: &[f64]) -> Vec<Line> {
    let line = |(index, summary): (usize, &LineSummary)| Line {
        summary: summary.clone(),
        settled_tension_n: settled_tension_n.get(index).copied(),
    };
    summary.lines.iter().enumerate().map(line).collect()
}

/// Figures of a line.
pub static LINE: &[Figure<Line>] = &[
    Figure::new("id", "line", "Id of the line.", Quantity::Id, |line: &Line| {
        (&line.summary.id).into()
    })
    .shown(&[Table, InSummary]),
    Figure::new(
        "peak_tension_N",
        "peak tension",
        "Greatest tension of any of its segments in any solver step that converged.",
        Quantity::Force,
        |line: &Line| line.summary.peak_tension_n.into(),
    )
    .shown(&[Table, InSummary, Compare]),
    Figure::new(
        "peak_at_s",
        "peak at",
        "Time of the greatest tension: the end of that step.",
        Quantity::Moment,
        |line: &Line| line.summary.peak_at_s.into(),
    )
    .shown(&[Table, InSummary]),
    Figure::new(
        "unconverged_peak_N",
        "peak in steps not converged",
        "Greatest tension of any of its segments in any solver step that did not converge.",
        Quantity::Force,
        |line: &Line| line.summary.unconverged_peak_n.into(),
    ),
    Figure::new(
        "end_a_tension_N",
        "end A at end",
        "Tension at end A, at the joint, at the end of the run or at its newest moment so far.",
        Quantity::Force,
        |line: &Line| line.summary.end_a_tension_n.into(),
    )
    .shown(&[InSummary]),
    Figure::new(
        "end_b_tension_N",
        "end B at end",
        "Tension at end B, at the joint, at the end of the run or at its newest moment so far.",
        Quantity::Force,
        |line: &Line| line.summary.end_b_tension_n.into(),
    )
    .shown(&[InSummary]),
    Figure::new(
        "settled_tension_N",
        "settled",
        "Greatest tension of any of its segments in the settled state.",
        Quantity::Force,
        |line: &Line| line.settled_tension_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "parted_at_s",
        "parted",
        "Time at which it parted; none if it holds.",
        Quantity::Moment,
        |line: &Line| line.summary.parted_at_s.into(),
    )
    .shown(&[Table, InSummary])
    .alarming(),
    Figure::new(
        "drag_N",
        "drag of the water",
        "Drag of the water on its rope at the end.",
        Quantity::ForceVector,
        |line: &Line| line.summary.drag_n.into(),
    ),
    Figure::new(
        "whale_normal_N",
        "normal force on the whale",
        "Sum of the normal forces between it and the whale at the end.",
        Quantity::Force,
        |line: &Line| line.summary.whale_normal_n.into(),
    ),
    Figure::new(
        "whale_friction_N",
        "friction on the whale",
        "Sum of the friction forces between it and the whale at the end.",
        Quantity::Force,
        |line: &Line| line.summary.whale_friction_n.into(),
    ),
    Figure::new(
        "twist",
        "turns of its legs about each other",
        "Turns of its two legs about each other beyond the whale, at the end of the run; positive: \
         right-handed. Lines joined by splices are one rope.",
        Quantity::Turns,
        |line: &Line| line.summary.twist.into(),
    )
    .shown(&[Table, InSummary, Compare]),
    Figure::new(
        "peak_twist",
        "greatest turns of its legs about each other",
        "Greatest magnitude of these turns at any time, with its sign.",
        Quantity::Turns,
        |line: &Line| line.summary.peak_twist.into(),
    ),
];

/// Figures of a weak link.
pub static LINK: &[Figure<LinkSummary>] = &[
    Figure::new("id", "weak link", "Id of the weak link.", Quantity::Id, |link: &LinkSummary| {
        (&link.id).into()
    })
    .shown(&[Table, InSummary]),
    Figure::new(
        "rating_N",
        "rating",
        "Tension above which it parts.",
        Quantity::Force,
        |link: &LinkSummary| link.rating_n.into(),
    )
    .shown(&[Table, InSummary]),
    Figure::new(
        "peak_tension_N",
        "peak tension",
        "Greatest tension of its segment in any solver step that converged.",
        Quantity::Force,
        |link: &LinkSummary| link.peak_tension_n.into(),
    )
    .shown(&[Table, InSummary]),
    Figure::new(
        "unconverged_peak_N",
        "peak in steps not converged",
        "The same, in any solver step that did not converge.",
        Quantity::Force,
        |link: &LinkSummary| link.unconverged_peak_n.into(),
    ),
    Figure::new(
        "parted_at_s",
        "parted",
        "Time at which it parted; none if it holds.",
        Quantity::Moment,
        |link: &LinkSummary| link.parted_at_s.into(),
    )
    .shown(&[Table, InSummary])
    .alarming(),
];

/// Figures of a trap, buoy, anchor or weight.
pub static BODY: &[Figure<BodySummary>] = &[
    Figure::new("id", "body", "Id of the body.", Quantity::Id, |body: &BodySummary| {
        (&body.id).into()
    })
    .shown(&[Table]),
    Figure::new(
        "position_m",
        "place east, north, up",
        "Position of its origin at the end.",
        Quantity::Place,
        |body: &BodySummary| body.position_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_speed_m_s",
        "peak speed",
        "Greatest speed over ground.",
        Quantity::Speed,
        |body: &BodySummary| body.peak_speed_m_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "drag_N",
        "drag of the water",
        "Drag of the water on it at the end.",
        Quantity::ForceVector,
        |body: &BodySummary| body.drag_n.into(),
    ),
    Figure::new(
        "whale_part",
        "on the whale's",
        "Part of the whale that it presses on at the end; none without contact.",
        Quantity::Name,
        |body: &BodySummary| body.on_whale.whale_part.map(BodyPart::name).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "whale_since_s",
        "on the whale since",
        "Start of its present contact with the whale, without gaps below a second; none without \
         contact at the end.",
        Quantity::Moment,
        |body: &BodySummary| body.on_whale.whale_since_s.into(),
    ),
    Figure::new(
        "whale_contact_time_s",
        "time on the whale",
        "Total time of its contact with the whale.",
        Quantity::Duration,
        |body: &BodySummary| body.on_whale.whale_contact_time_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "caught",
        "caught on the whale",
        "Whether it has been on the whale for 5 s at the end.",
        Quantity::Flag,
        |body: &BodySummary| body.on_whale.caught.into(),
    ),
    Figure::new(
        "peak_whale_push_N",
        "greatest push on the whale",
        "Greatest sum of its pushes on skin in any solver step.",
        Quantity::Force,
        |body: &BodySummary| body.on_whale.peak_whale_push_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_whale_part",
        "greatest push on",
        "Part of the whale that it pressed on at that time.",
        Quantity::Name,
        |body: &BodySummary| body.on_whale.peak_whale_part.map(BodyPart::name).into(),
    ),
    Figure::new(
        "whale_friction_work_J",
        "friction work on the whale",
        "Work done against friction on skin.",
        Quantity::Work,
        |body: &BodySummary| body.on_whale.whale_friction_work_j.into(),
    ),
];

fn measured(probe: &ProbeSummary, value: f64) -> Value {
    Value::Measured { value, unit: probe.unit }
}

/// Figures of a probe.
pub static PROBE: &[Figure<ProbeSummary>] = &[
    Figure::new("id", "probe", "Id of the probe.", Quantity::Id, |probe: &ProbeSummary| {
        (&probe.id).into()
    })
    .shown(&[Table]),
    Figure::new("unit", "unit", "Unit of its readings.", Quantity::Id, |probe: &ProbeSummary| {
        probe.unit.into()
    }),
    Figure::new(
        "final",
        "final",
        "Reading at the end.",
        Quantity::Measured,
        |probe: &ProbeSummary| measured(probe, probe.last),
    )
    .shown(&[Table]),
    Figure::new("min", "least", "Least reading.", Quantity::Measured, |probe: &ProbeSummary| {
        measured(probe, probe.min)
    })
    .shown(&[Table]),
    Figure::new(
        "max",
        "greatest",
        "Greatest reading.",
        Quantity::Measured,
        |probe: &ProbeSummary| measured(probe, probe.max),
    )
    .shown(&[Table]),
    Figure::new(
        "mean",
        "mean",
        "Mean over time, by the trapezium rule.",
        Quantity::Measured,
        |probe: &ProbeSummary| measured(probe, probe.mean),
    )
    .shown(&[Table]),
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
        "BLAKE3 of the file it was loaded from; empty if it is linked.",
        Quantity::Id,
        |plugin: &PluginUsed| (&plugin.file_hash).into(),
    ),
];
