//! Friction of rope and bodies on the whale: laws, coefficients, and where each law applies.

use std::sync::Arc;

use endline_sdk::FrictionModel;

/// A friction model with its attribute values.
#[derive(Clone)]
pub struct FrictionLaw {
    /// The model.
    pub model: Arc<dyn FrictionModel>,
    /// Its attributes, SI, in the declared order.
    pub attributes: Vec<f64>,
}

/// Friction of ropes and bodies on the whale: the laws, which of them holds where, and the table of coefficients.
#[derive(Clone)]
pub struct Friction {
    /// The laws; at least one.
    pub laws: Vec<FrictionLaw>,
    /// Index among the laws by rope index and region number.
    pub law_of: Vec<[usize; endline_sdk::Region::ALL.len()]>,
    /// Coefficient by rope index and region number.
    pub coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
    /// Index among the laws by region number, of traps, buoys and anchors.
    pub law_of_bodies: [usize; endline_sdk::Region::ALL.len()],
    /// Coefficient by region number, of traps, buoys and anchors.
    pub coefficients_of_bodies: [f64; endline_sdk::Region::ALL.len()],
}

/// Coefficient of friction of bodies on a whale where nothing else is said: smooth plastic on wet skin 0.1 to 0.3; estimate.
pub const BODY_ON_SKIN_FRICTION: f64 = 0.2;

impl Friction {
    /// One law for every rope and region.
    #[must_use]
    pub fn of_one(
        model: Arc<dyn FrictionModel>,
        attributes: Vec<f64>,
        coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
    ) -> Self {
        let law_of = vec![[0; endline_sdk::Region::ALL.len()]; coefficients.len()];
        Self {
            laws: vec![FrictionLaw { model, attributes }],
            law_of,
            coefficients,
            law_of_bodies: [0; endline_sdk::Region::ALL.len()],
            coefficients_of_bodies: [BODY_ON_SKIN_FRICTION; endline_sdk::Region::ALL.len()],
        }
    }

    /// Floats of a contact: as many as the law with the most takes.
    #[must_use]
    pub fn state_len(&self) -> usize {
        self.laws.iter().map(|law| law.model.descriptor().state_len).max().unwrap_or(0)
    }
}
