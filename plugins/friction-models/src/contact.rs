//! One contact out of the arrays, and vectors in three dimensions.

use endline_sdk::{Contacts, HookError};

/// A vector in the world frame.
pub(crate) type Vec3 = [f64; 3];

/// One contact of a pass.
pub(crate) struct Contact<'a> {
    /// Length of the step [s].
    pub dt_s: f64,
    /// Unit normal.
    pub normal: Vec3,
    /// Unit vector fixed to the skin, across the normal.
    pub grain: Vec3,
    /// Unit vector along the rope.
    pub along: Vec3,
    /// Slip since the step began [m].
    pub slip_m: Vec3,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Length of rope [m].
    pub length_m: f64,
    /// Coefficient of the library [1].
    pub coefficient: f64,
    /// The model's floats as the step began.
    pub state: &'a [f64],
}

impl<'a> Contact<'a> {
    /// The contact at a place in the arrays, with `state_len` floats.
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

    /// The trial bristle `z* = P (z + s)` of a bristle kept in the world frame.
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
