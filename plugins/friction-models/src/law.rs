//! The bristle between rope and skin on which all laws are based, the contact that a law receives, and the models of laws.
//!
//! Symbols: `z*` trial stretch across the normal, `r = |z*|`, `t = z*/r`, `P = I - n nᵀ`, `k` stiffness, `L` greatest force of the
//! bristle by the law, with derivatives `L_N` by the normal force and `L_z` by the stretch.
//!
//! ```text
//! stick, where k r <= L:   f = -k z*    df/ds = -k P                                   df/dN = 0
//! slip, else:              f = -L t     df/ds = -(L/r) (P - t tᵀ) - t L_zᵀ             df/dN = -L_N t
//! end of step:             z = z* in stick, (L/k) t in slip
//! ```
//!
//! It releases no energy, for any change of `L` between steps. With `z = c z*`, `0 <= c <= 1`, at the end, and `s = z* - z0`:
//! `f . s + k/2 (|z|² - |z0|²) = -k z . (z* - z) - k/2 |z - z0|² <= 0`.

use std::marker::PhantomData;

use endline_sdk::{Attribute, Contacts, Descriptor, FrictionModel, FrictionResponse, HookError};

/// Greatest force of a bristle with its derivatives.
#[derive(Clone, Copy, Default)]
pub(crate) struct Limit {
    /// `L` [N].
    pub force_n: f64,
    /// `L_N` [1].
    pub by_normal_force: f64,
    /// `L_z` [N/m].
    pub by_stretch: Vec3,
}

/// A trial bristle at one contact.
pub(crate) struct Bristle {
    /// Unit normal, from skin to rope.
    pub normal: Vec3,
    /// `z*` [m].
    pub stretch_m: Vec3,
    /// `r` [m].
    pub length_m: f64,
    /// `k` [N/m].
    pub stiffness_n_m: f64,
}

impl Bristle {
    /// A bristle across a normal, with its stretch [m] and stiffness [N/m].
    pub fn new(normal: Vec3, stretch_m: Vec3, stiffness_n_m: f64) -> Self {
        Self { normal, stretch_m, length_m: dot(stretch_m, stretch_m).sqrt(), stiffness_n_m }
    }

    /// Whether its force is within the limit.
    pub fn sticks(&self, limit: &Limit) -> bool {
        self.stiffness_n_m * self.length_m <= limit.force_n
    }

    /// Direction of the stretch, which must not be zero.
    pub fn direction(&self) -> Vec3 {
        self.stretch_m.map(|component| component / self.length_m)
    }

    /// Force and derivatives of a bristle that sticks, or slips at the limit.
    pub fn response(&self, limit: &Limit) -> FrictionResponse {
        if self.sticks(limit) { self.stuck() } else { self.slipping(limit) }
    }

    fn stuck(&self) -> FrictionResponse {
        let k = self.stiffness_n_m;
        FrictionResponse {
            force_n: self.stretch_m.map(|z| -k * z),
            by_slip: matrix(|i, j| -k * projector(self.normal, i, j)),
            by_normal_force: [0.0; 3],
        }
    }

    /// Force and derivatives of a bristle that slips at the limit.
    pub fn slipping(&self, limit: &Limit) -> FrictionResponse {
        let t = self.direction();
        let rate = limit.force_n / self.length_m;
        FrictionResponse {
            force_n: t.map(|t| -limit.force_n * t),
            by_slip: matrix(|i, j| {
                -rate * (projector(self.normal, i, j) - t[i] * t[j]) - t[i] * limit.by_stretch[j]
            }),
            by_normal_force: t.map(|t| -limit.by_normal_force * t),
        }
    }

    /// The bristle at the end of an accepted step [m].
    pub fn end(&self, limit: &Limit) -> Vec3 {
        if self.sticks(limit) {
            return self.stretch_m;
        }
        let held = limit.force_n / self.stiffness_n_m;
        self.direction().map(|t| held * t)
    }
}

/// Entry of `P = I - n nᵀ`.
pub(crate) fn projector(normal: Vec3, i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j)) - normal[i] * normal[j]
}

/// A matrix by its entries, row by row.
pub(crate) fn matrix(entry: impl Fn(usize, usize) -> f64) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// A vector in the world frame.
pub type Vec3 = [f64; 3];

/// One contact of a pass.
pub struct Contact<'a> {
    /// Length of the step [s].
    pub dt_s: f64,
    /// Unit normal.
    pub normal: Vec3,
    /// Unit vector fixed to the skin, perpendicular to the normal.
    pub grain: Vec3,
    /// Unit vector along the rope.
    pub along: Vec3,
    /// Slip since the start of the step [m].
    pub slip_m: Vec3,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Length of rope [m].
    pub length_m: f64,
    /// Coefficient of the library [1].
    pub coefficient: f64,
    /// Floats of the model at the start of the step.
    pub state: &'a [f64],
}

impl<'a> Contact<'a> {
    /// The contact with an index in the arrays, with `state_len` floats.
    pub fn at(contacts: &Contacts<'a>, index: usize, state_len: usize) -> Result<Self, HookError> {
        let missing =
            || HookError::new(format!("contact {index}: the arrays of contacts differ in length"));
        let number = |array: &[f64]| array.get(index).copied().ok_or_else(missing);
        let vector = |array: &[Vec3]| array.get(index).copied().ok_or_else(missing);
        Ok(Self {
            dt_s: contacts.dt_s,
            normal: vector(contacts.normal)?,
            grain: vector(contacts.grain)?,
            along: vector(contacts.along)?,
            slip_m: vector(contacts.slip_m)?,
            normal_force_n: number(contacts.normal_force_n)?,
            length_m: number(contacts.length_m)?,
            coefficient: number(contacts.coefficient)?,
            state: contacts
                .state
                .get(state_len * index..state_len * (index + 1))
                .ok_or_else(missing)?,
        })
    }

    /// The trial bristle `z* = P (z + s)` of a bristle in the world frame.
    pub fn stretched(&self, bristle: Vec3) -> Vec3 {
        across(
            self.normal,
            [bristle[0] + self.slip_m[0], bristle[1] + self.slip_m[1], bristle[2] + self.slip_m[2]],
        )
    }

    /// Across the grain, on the skin: `normal x grain`.
    pub fn across_grain(&self) -> Vec3 {
        cross(self.normal, self.grain)
    }
}

/// Scalar product.
pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The part of a vector in the plane across a unit normal.
pub(crate) fn across(normal: Vec3, vector: Vec3) -> Vec3 {
    let along = dot(normal, vector);
    std::array::from_fn(|i| vector[i] - along * normal[i])
}

/// The attribute values of a call, as many as the model declares.
pub(crate) fn values<const COUNT: usize>(attributes: &[f64]) -> Result<[f64; COUNT], HookError> {
    attributes.try_into().map_err(|_| {
        HookError::new(format!("expected {COUNT} attribute values, got {}", attributes.len()))
    })
}

/// A law of friction for one contact.
pub trait Law: Sized + Send + Sync {
    /// Floats of a contact.
    const STATE_LEN: usize;
    /// Descriptor of the model, without version and floats.
    fn descriptor() -> Descriptor;
    /// The law with a call's attribute values.
    fn read(attributes: &[f64]) -> Result<Self, HookError>;
    /// Force and derivatives.
    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse;
    /// Writes the floats at the end of an accepted step.
    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]);
}

/// The friction model of a law.
#[derive(Clone, Debug)]
pub struct Model<L> {
    descriptor: Descriptor,
    law: PhantomData<L>,
}

impl<L: Law> Model<L> {
    /// The model with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        let version = env!("CARGO_PKG_VERSION").into();
        let descriptor = Descriptor { version, ..L::descriptor() }.with_state(L::STATE_LEN);
        Self { descriptor, law: PhantomData }
    }
}

impl<L: Law> Default for Model<L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<L: Law> FrictionModel for Model<L> {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn respond(
        &self,
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

    fn advance(
        &self,
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
}

/// The attribute of all models: a factor on the library's coefficients.
pub(crate) fn coefficient_scale() -> Attribute {
    Attribute::number(
        "coefficient_scale",
        "1",
        [0.0, 3.0],
        1.0,
        "Multiplies every coefficient of friction of the gear library.",
    )
}
