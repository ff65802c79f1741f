//! Coulomb friction that really sticks: an elastic-plastic bristle.
//!
//! Symbols, for one contact: `n` unit normal, `P = I - n nᵀ`, `N` normal force, `mu` coefficient,
//! `l` length of rope, `k` stick stiffness per metre of rope, `s` slip since the step began,
//! `z` bristle (tangential stretch of the tissue under the rope) as the step began.
//!
//! ```text
//! z* = P (z + s)                       trial bristle
//! stick, where k l |z*| <= mu N:       f = -k l z*        df/ds = -k l P                          df/dN = 0
//! slip, else, with t = z*/|z*|:        f = -mu N t        df/ds = -(mu N / |z*|) (P - t tᵀ)       df/dN = -mu t
//! end of step:                         z = z* in stick, mu N / (k l) t in slip
//! ```
//!
//! The force is continuous across the two branches, never exceeds `mu N`, and a rope held below
//! that limit does not creep, which velocity-smoothed laws do. The stick stiffness stands for the
//! shear compliance of skin and blubber; results are insensitive to it from 1e6 to 1e8 N/m².
//!
//! References: Dupont, Hayward, Armstrong and Altpeter, "Single state elastoplastic friction
//! models", IEEE Trans. Automatic Control 47 (2002) 787-792; Winn et al., "Modeling whale
//! entanglement injuries", Marine Mammal Science 24 (2008) 326-340, for the compliance of tissue.

use endline_sdk::{Attribute, Contacts, Descriptor, FrictionModel, FrictionResponse, HookError};

/// Floats for each contact: the bristle [m], world frame.
const STATE_LEN: usize = 3;

type Vec3 = [f64; 3];

/// The Coulomb model.
#[derive(Clone, Debug)]
pub struct Coulomb {
    descriptor: Descriptor,
}

impl Coulomb {
    /// The model with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Coulomb {
    fn default() -> Self {
        Self::new()
    }
}

impl FrictionModel for Coulomb {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn respond(&self, attributes: &[f64], contacts: &Contacts<'_>, out: &mut [FrictionResponse]) -> Result<(), HookError> {
        let settings = Settings::read(attributes)?;
        for (index, answer) in out.iter_mut().enumerate() {
            *answer = Bristle::of(&settings, contacts, index)?.response();
        }
        Ok(())
    }

    fn advance(&self, attributes: &[f64], contacts: &Contacts<'_>, out: &mut [f64]) -> Result<(), HookError> {
        let settings = Settings::read(attributes)?;
        for (index, floats) in out.chunks_exact_mut(STATE_LEN).enumerate() {
            floats.copy_from_slice(&Bristle::of(&settings, contacts, index)?.end());
        }
        Ok(())
    }
}

fn descriptor() -> Descriptor {
    Descriptor {
        id: "org.endline.friction.coulomb".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Coulomb".into(),
        help: "Rope sticks to the skin until the pull along it passes coefficient times normal force, then slips.".into(),
        attributes: vec![
            Attribute::number(
                "stick_stiffness",
                "N/m^2",
                [1e4, 1e10],
                1e7,
                "How stiffly skin holds a sticking rope, per metre of rope; stands for the shear compliance of tissue.",
            ),
            Attribute::number("coefficient_scale", "1", [0.0, 3.0], 1.0, "Multiplies every coefficient of friction of the gear library."),
        ],
        state_len: STATE_LEN,
        acts: Vec::new(),
    }
}

/// Attribute values of a call.
struct Settings {
    stick_stiffness_n_m2: f64,
    coefficient_scale: f64,
}

impl Settings {
    fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let &[stick_stiffness_n_m2, coefficient_scale] = attributes else {
            return Err(HookError::new(format!("expected 2 attribute values, got {}", attributes.len())));
        };
        Ok(Self { stick_stiffness_n_m2, coefficient_scale })
    }
}

/// One contact's trial bristle and what may hold it.
struct Bristle {
    normal: Vec3,
    /// Trial stretch `z*` [m] and its length [m].
    stretch_m: Vec3,
    stretch_length_m: f64,
    /// Stiffness `k l` [N/m].
    stiffness_n_m: f64,
    /// Coefficient of friction [1].
    coefficient: f64,
    /// Greatest force it holds, `mu N` [N].
    limit_n: f64,
}

impl Bristle {
    fn of(settings: &Settings, contacts: &Contacts<'_>, index: usize) -> Result<Self, HookError> {
        let missing = || HookError::new(format!("contact {index}: the arrays of contacts differ in length"));
        let at = |array: &[f64]| array.get(index).copied().ok_or_else(missing);
        let normal = *contacts.normal.get(index).ok_or_else(missing)?;
        let slip = *contacts.slip_m.get(index).ok_or_else(missing)?;
        let state = contacts.state.get(STATE_LEN * index..STATE_LEN * (index + 1)).ok_or_else(missing)?;
        let coefficient = settings.coefficient_scale * at(contacts.coefficient)?;
        let stretch_m = across(normal, [state[0] + slip[0], state[1] + slip[1], state[2] + slip[2]]);
        Ok(Self {
            normal,
            stretch_m,
            stretch_length_m: dot(stretch_m, stretch_m).sqrt(),
            stiffness_n_m: settings.stick_stiffness_n_m2 * at(contacts.length_m)?,
            coefficient,
            limit_n: coefficient * at(contacts.normal_force_n)?,
        })
    }

    fn sticks(&self) -> bool {
        self.stiffness_n_m * self.stretch_length_m <= self.limit_n
    }

    /// Direction of the stretch; only asked for in slip, where the stretch is not zero.
    fn direction(&self) -> Vec3 {
        self.stretch_m.map(|component| component / self.stretch_length_m)
    }

    fn response(&self) -> FrictionResponse {
        if self.sticks() { self.stuck() } else { self.slipping() }
    }

    fn stuck(&self) -> FrictionResponse {
        let k = self.stiffness_n_m;
        FrictionResponse {
            force_n: self.stretch_m.map(|z| -k * z),
            by_slip: matrix(|i, j| -k * projector(self.normal, i, j)),
            by_normal_force: [0.0; 3],
        }
    }

    fn slipping(&self) -> FrictionResponse {
        let t = self.direction();
        let rate = self.limit_n / self.stretch_length_m;
        FrictionResponse {
            force_n: t.map(|t| -self.limit_n * t),
            by_slip: matrix(|i, j| -rate * (projector(self.normal, i, j) - t[i] * t[j])),
            by_normal_force: t.map(|t| -self.coefficient * t),
        }
    }

    /// The bristle at the end of an accepted step.
    fn end(&self) -> Vec3 {
        if self.sticks() {
            return self.stretch_m;
        }
        let held = self.limit_n / self.stiffness_n_m;
        self.direction().map(|t| held * t)
    }
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The part of a vector in the plane across a unit normal.
fn across(normal: Vec3, vector: Vec3) -> Vec3 {
    let along = dot(normal, vector);
    std::array::from_fn(|i| vector[i] - along * normal[i])
}

/// Entry of `P = I - n nᵀ`.
fn projector(normal: Vec3, i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j)) - normal[i] * normal[j]
}

fn matrix(entry: impl Fn(usize, usize) -> f64) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}
