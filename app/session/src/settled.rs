//! The gear at rest as JSON, schema `endline.settle/1`, and the strength of each part, with the keys of the run summary where they agree.

use endline_gear::{StrengthBudget, StrengthFigure};
use endline_sim::metrics::{Metrics, ProbeSummary};
use endline_sim::{Model, Settled, State};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::figures::{self, PROBE};
use crate::source::Prepared;

/// Name of the schema.
pub const SCHEMA: &str = "endline.settle/1";

/// Shape, tensions and residual of the gear at rest.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct SettledShape {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// The scenario's file as the user named it.
    pub scenario: String,
    /// Whether the gear is at rest.
    pub converged: bool,
    /// The outcome: `at rest`, or why not.
    pub outcome: String,
    /// The part with the greatest force out of balance.
    pub worst_part: Option<String>,
    /// Greatest force out of balance [N].
    pub residual_N: f64,
    /// Residual after each pass [N].
    pub trace_N: Vec<f64>,
    /// Real time [s].
    pub wall_s: f64,
    /// Rope nodes.
    pub nodes: usize,
    /// One for each line.
    pub lines: Vec<LineShape>,
    /// The strength of each piece of a line, of its weak places, and of each weak link, with its factors.
    pub strengths: Vec<PartStrength>,
    /// One for each body.
    pub bodies: Vec<BodyShape>,
    /// One for each probe.
    #[serde(serialize_with = "as_figures")]
    #[schemars(schema_with = "figures::schema::probes")]
    pub probes: Vec<ProbeSummary>,
}

/// A line at rest.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct LineShape {
    /// Id.
    pub id: String,
    /// Unstretched length [m].
    pub length_m: f64,
    /// Tension at end A [N].
    pub end_a_tension_N: f64,
    /// Tension at end B [N].
    pub end_b_tension_N: f64,
    /// Tension of each segment from A to B [N].
    pub tension_N: Vec<f64>,
    /// Place of each node from A to B [m].
    pub position_m: Vec<[f64; 3]>,
}

/// A body at rest.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct BodyShape {
    /// Id.
    pub id: String,
    /// Place [m].
    pub position_m: [f64; 3],
    /// Orientation, body to world, as (x, y, z, w).
    pub orientation: [f64; 4],
}

impl SettledShape {
    /// Of a settled model; `wall_s` is the real time it took [s].
    pub fn of(prepared: &Prepared, settled: &Settled, wall_s: f64) -> Self {
        Self::named(
            &prepared.source.scenario_name,
            &prepared.model,
            &prepared.strengths,
            settled,
            wall_s,
        )
    }

    /// The shape of a model, with the name of its scenario.
    pub fn named(
        scenario: &str,
        model: &Model,
        strengths: &[StrengthBudget],
        settled: &Settled,
        wall_s: f64,
    ) -> Self {
        let state = &settled.state;
        Self {
            schema: SCHEMA,
            scenario: scenario.to_owned(),
            converged: settled.converged,
            outcome: settled.outcome.to_string(),
            worst_part: settled.worst.as_ref().map(|worst| worst.part.clone()),
            residual_N: settled.residual_n,
            trace_N: settled.trace_n.clone(),
            wall_s,
            nodes: model.node_count,
            lines: lines(model, state),
            strengths: strengths.iter().map(PartStrength::from).collect(),
            bodies: bodies(model, state),
            probes: probes(model, state),
        }
    }
}

fn lines(model: &Model, state: &State) -> Vec<LineShape> {
    let shape = |(index, line): (usize, &endline_sim::model::Line)| {
        let tension_n: Vec<f64> = state.rope.tension[model.line_segments[index].clone()]
            .iter()
            .map(|tension| tension.max(0.0))
            .collect();
        LineShape {
            id: line.id.clone(),
            length_m: line.segments_m.iter().sum(),
            end_a_tension_N: tension_n.first().copied().unwrap_or_default(),
            end_b_tension_N: tension_n.last().copied().unwrap_or_default(),
            tension_N: tension_n,
            position_m: state.rope.position[model.line_nodes[index].clone()]
                .iter()
                .map(|place| place.to_array())
                .collect(),
        }
    };
    model.spec.lines.iter().enumerate().map(shape).collect()
}

fn bodies(model: &Model, state: &State) -> Vec<BodyShape> {
    let shape =
        |(body, now): (&endline_sim::model::Body, &endline_sim::state::BodyState)| BodyShape {
            id: body.id.clone(),
            position_m: now.position.to_array(),
            orientation: now.orientation.to_array(),
        };
    model.spec.bodies.iter().zip(&state.bodies).map(shape).collect()
}

/// Probes read by the metrics, so that a probe means the same at rest and in a run.
fn probes(model: &Model, state: &State) -> Vec<ProbeSummary> {
    let mut metrics = Metrics::new(model);
    metrics.fold(model, state, &[]);
    metrics.summary(model, state).probes
}

fn as_figures<S: Serializer>(probes: &[ProbeSummary], serializer: S) -> Result<S::Ok, S::Error> {
    figures::list(PROBE, probes).serialize(serializer)
}

/// The strength of a piece of a line, of its weak places together, or of a weak link, with its factors.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct PartStrength {
    /// Its id in the model.
    pub part: String,
    /// The rope or weak link it is of, or the number and lengths of weak places.
    pub item: String,
    /// Strength as its source states it [N].
    pub stated: Sourced,
    /// The factors by which it is reduced.
    pub factors: Vec<PartFactor>,
    /// Coefficient of variation between pieces.
    pub variation: Option<Sourced>,
    /// Coefficient of variation between gears of a fleet, beside that between pieces.
    pub fleet: Option<Sourced>,
    /// Mean strength delivered [N].
    pub delivered_N: f64,
    /// The strengths between which nine pieces of ten lie [N].
    pub nine_of_ten_N: [f64; 2],
    /// Strength of the piece that this run drew [N].
    pub drawn_N: f64,
    /// How sure the least sure of its numbers is.
    pub confidence: &'static str,
}

/// A factor of a budget.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct PartFactor {
    /// Its purpose.
    pub name: String,
    /// The factor with its source.
    #[serde(flatten)]
    pub figure: Sourced,
}

/// A number with where it comes from.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Sourced {
    /// The number.
    pub value: f64,
    /// Source.
    pub source: String,
    /// How sure it is.
    pub confidence: &'static str,
}

impl From<&StrengthFigure> for Sourced {
    fn from(figure: &StrengthFigure) -> Self {
        Self {
            value: figure.value,
            source: figure.source.clone(),
            confidence: figure.confidence.word(),
        }
    }
}

impl From<&StrengthBudget> for PartStrength {
    fn from(budget: &StrengthBudget) -> Self {
        let factors = budget.factors.iter().map(|factor| PartFactor {
            name: factor.name.clone(),
            figure: (&factor.figure).into(),
        });
        Self {
            part: budget.part.clone(),
            item: budget.item.clone(),
            stated: (&budget.stated).into(),
            factors: factors.collect(),
            variation: budget.variation.as_ref().map(Sourced::from),
            fleet: budget.fleet.as_ref().map(Sourced::from),
            delivered_N: budget.delivered_n(),
            nine_of_ten_N: budget.nine_of_ten_n(),
            drawn_N: budget.drawn_n(),
            confidence: budget.confidence().word(),
        }
    }
}

impl PartStrength {
    /// Its factors as a product, such as `1.11 mean of new pieces × 0.74 wear`; empty where there is none.
    pub fn product(&self) -> String {
        let factor = |factor: &PartFactor| format!("{:.2} {}", factor.figure.value, factor.name);
        self.factors.iter().map(factor).collect::<Vec<_>>().join(" × ")
    }
}
