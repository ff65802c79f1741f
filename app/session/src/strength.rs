//! Budgets of delivered strength as JSON and as lines of text: what [`endline_gear::StrengthBudget`] holds, with units in its keys.

use endline_gear::{StrengthBudget, StrengthFigure};
use schemars::JsonSchema;
use serde::Serialize;

/// What a piece of a line, or a weak link, holds, and why.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct PartStrength {
    /// Its id in the model.
    pub part: String,
    /// The rope or weak link it is of.
    pub item: String,
    /// Strength as its source states it [N].
    pub stated: Sourced,
    /// What is left of it, factor by factor.
    pub factors: Vec<PartFactor>,
    /// Coefficient of variation between pieces.
    pub variation: Option<Sourced>,
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
    /// What it is for.
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
            delivered_N: budget.delivered_n(),
            nine_of_ten_N: budget.nine_of_ten_n(),
            drawn_N: budget.drawn_n(),
            confidence: budget.confidence().word(),
        }
    }
}

impl PartStrength {
    /// Its factors as a product, such as `1.11 mean of new pieces × 0.74 wear`; empty where nothing is taken off.
    #[must_use]
    pub fn product(&self) -> String {
        let factor = |factor: &PartFactor| format!("{:.2} {}", factor.figure.value, factor.name);
        self.factors.iter().map(factor).collect::<Vec<_>>().join(" × ")
    }
}
