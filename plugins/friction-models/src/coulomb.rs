//! Coulomb friction with true sticking: an elastic-plastic bristle.
//!
//! Symbols, for one contact: `n` unit normal, `P = I - n nᵀ`, `N` normal force, `mu` coefficient,
//! `l` length of rope, `k` stick stiffness per metre of rope, `s` slip since the start of the step,
//! `z` bristle (tangential stretch of the tissue under the rope) at the start of the step.
//!
//! ```text
//! z* = P (z + s)                       trial bristle
//! stick, where k l |z*| <= mu N:       f = -k l z*        df/ds = -k l P                          df/dN = 0
//! slip, else, with t = z*/|z*|:        f = -mu N t        df/ds = -(mu N / |z*|) (P - t tᵀ)       df/dN = -mu t
//! end of step:                         z = z* in stick, mu N / (k l) t in slip
//! ```
//!
//! The force is continuous at the transition and at most `mu N`. A rope below this limit does not creep, unlike with
//! velocity-smoothed laws. The stick stiffness represents the shear compliance of skin and blubber; results do not depend on
//! it from 1e6 to 1e8 N/m².
//!
//! References: Dupont, Hayward, Armstrong and Altpeter, "Single state elastoplastic friction
//! models", IEEE Trans. Automatic Control 47 (2002) 787-792; Winn et al., "Modeling whale
//! entanglement injuries", Marine Mammal Science 24 (2008) 326-340, for the compliance of tissue.

use endline_sdk::{Attribute, Descriptor, FrictionResponse, HookError};

use crate::law::{Bristle, Contact, Law, Limit, Model, coefficient_scale, values};

/// The Coulomb model.
pub type Coulomb = Model<Sticking>;

/// The law with a call's attribute values.
#[derive(Clone, Debug)]
pub struct Sticking {
    stick_stiffness_n_m2: f64,
    coefficient_scale: f64,
}

impl Law for Sticking {
    /// The bristle [m], world frame.
    const STATE_LEN: usize = 3;

    fn descriptor() -> Descriptor {
        let help = "Rope sticks to the skin until the pull along it passes coefficient times normal force, then slips.";
        let stiffness = Attribute::number(
            "stick_stiffness",
            "N/m^2",
            [1e4, 1e10],
            1e7,
            "How stiffly skin holds a sticking rope, per metre of rope; represents the shear compliance of tissue.",
        );
        Descriptor::new("org.endline.friction.coulomb", "Coulomb", help)
            .with_attributes(vec![stiffness, coefficient_scale()])
    }

    fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let [stick_stiffness_n_m2, coefficient_scale] = values(attributes)?;
        Ok(Self { stick_stiffness_n_m2, coefficient_scale })
    }

    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse {
        let (bristle, limit) = self.bristle(contact);
        bristle.response(&limit)
    }

    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]) {
        let (bristle, limit) = self.bristle(contact);
        out.copy_from_slice(&bristle.end(&limit));
    }
}

impl Sticking {
    fn bristle(&self, contact: &Contact<'_>) -> (Bristle, Limit) {
        let [x, y, z] = [contact.state[0], contact.state[1], contact.state[2]];
        let coefficient = self.coefficient_scale * contact.coefficient;
        let limit = Limit {
            force_n: coefficient * contact.normal_force_n,
            by_normal_force: coefficient,
            ..Limit::default()
        };
        (
            Bristle::new(
                contact.normal,
                contact.stretched([x, y, z]),
                self.stick_stiffness_n_m2 * contact.length_m,
            ),
            limit,
        )
    }
}
