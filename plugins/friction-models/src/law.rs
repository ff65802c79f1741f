//! What the models share: a law for one contact, applied to all contacts of a call.

use endline_sdk::{Attribute, Contacts, Descriptor, FrictionResponse, HookError};

use crate::contact::Contact;

/// A law of friction for one contact.
pub(crate) trait Law: Sized {
    /// Floats of a contact.
    const STATE_LEN: usize;
    /// The law with a call's attribute values.
    fn read(attributes: &[f64]) -> Result<Self, HookError>;
    /// Force and derivatives.
    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse;
    /// Writes the floats at the end of an accepted step.
    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]);
}

/// Answers for all contacts of a pass.
pub(crate) fn respond<L: Law>(
    attributes: &[f64],
    contacts: &Contacts<'_>,
    out: &mut [FrictionResponse],
) -> Result<(), HookError> {
    let law = L::read(attributes)?;
    for (index, answer) in out.iter_mut().enumerate() {
        *answer = law.respond(&Contact::at(contacts, index, L::STATE_LEN)?);
    }
    Ok(())
}

/// Floats of all contacts at the end of an accepted step.
pub(crate) fn advance<L: Law>(
    attributes: &[f64],
    contacts: &Contacts<'_>,
    out: &mut [f64],
) -> Result<(), HookError> {
    let law = L::read(attributes)?;
    for (index, floats) in out.chunks_exact_mut(L::STATE_LEN).enumerate() {
        law.advance(&Contact::at(contacts, index, L::STATE_LEN)?, floats);
    }
    Ok(())
}

/// Descriptor of a friction model.
pub(crate) fn descriptor(
    id: &'static str,
    name: &'static str,
    help: &'static str,
    state_len: usize,
    own: Vec<Attribute>,
) -> Descriptor {
    Descriptor {
        id: id.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: name.into(),
        help: help.into(),
        attributes: own,
        state_len,
        acts: Vec::new(),
    }
}

/// The attribute that every model has: what the library's coefficients are multiplied by.
pub(crate) fn coefficient_scale() -> Attribute {
    Attribute::number(
        "coefficient_scale",
        "1",
        [0.0, 3.0],
        1.0,
        "Multiplies every coefficient of friction of the gear library.",
    )
}

/// Makes a type a friction model by its [`Law`].
macro_rules! friction_model {
    ($model:ident, $law:ident) => {
        impl $model {
            /// The model with its descriptor.
            #[must_use]
            pub fn new() -> Self {
                Self { descriptor: descriptor() }
            }
        }

        impl Default for $model {
            fn default() -> Self {
                Self::new()
            }
        }

        impl FrictionModel for $model {
            fn descriptor(&self) -> &Descriptor {
                &self.descriptor
            }

            fn respond(
                &self,
                attributes: &[f64],
                contacts: &Contacts<'_>,
                out: &mut [FrictionResponse],
            ) -> Result<(), HookError> {
                law::respond::<$law>(attributes, contacts, out)
            }

            fn advance(
                &self,
                attributes: &[f64],
                contacts: &Contacts<'_>,
                out: &mut [f64],
            ) -> Result<(), HookError> {
                law::advance::<$law>(attributes, contacts, out)
            }
        }
    };
}

pub(crate) use friction_model;
