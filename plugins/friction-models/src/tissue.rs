//! Tissue stick-slip: skin follows the rope over an elastic range of draw, then the rope slips.
//!
//! Under a tangential load the edge of a flipper or fluke deforms elastically up to a limit before the rope slips over the
//! skin (Winn et al.: the tissue compliance limit). Symbols as in `law.rs`; `l` length of rope, `k` shear stiffness of tissue per
//! metre of rope, `D` elastic range of draw, `q` times stiffer beyond it (taut collagen), `mu` kinetic coefficient of the library,
//! `rho` static over kinetic coefficient, `h` held (0) or slipping (1) at the start of the step.
//!
//! ```text
//! F(r) = k l r            r <= D          L = rho mu N where held, mu N where slipping
//!        k l (D + q (r - D))   beyond     stick, where F(r) <= L:  f = -F(r) t   df/ds = -(F/r) (P - t tᵀ) - F' t tᵀ
//!                                         slip, else:              f = -L t      as a bristle
//! end of step: z = z* and h = 0 in stick, F⁻¹(L) t and h = 1 in slip
//! ```
//!
//! The force decreases from static to kinetic in the step after the start of the slip: within a step it is continuous. The draw
//! is stored by its components along and across the direction of the skin, because it persists and rotates with the whale. `F`
//! grows with `r`, so its energy is convex and the contact releases none: with `z = c z*`, `f . (z* - z0) + E(z) - E(z0) <= -F(|z|) t . (z* - z) <= 0`.
//!
//! Reference: Winn, Woodward, Moore, Peterson and Riley, "Modeling whale entanglement injuries: An experimental study of tissue
//! compliance, line tension, and draw-length", Marine Mammal Science 24 (2008) 326-340.

use endline_sdk::{Attribute, Descriptor, FrictionResponse, HookError};

use crate::law::{
    Bristle, Contact, Law, Limit, Model, Vec3, across, coefficient_scale, dot, matrix, projector,
    values,
};

/// The model of elastic tissue.
pub type Tissue = Model<Drawn>;

/// The law with a call's attribute values.
#[derive(Clone, Debug)]
pub struct Drawn {
    stiffness_n_m2: f64,
    draw_m: f64,
    taut_ratio: f64,
    static_ratio: f64,
    coefficient_scale: f64,
}

impl Law for Drawn {
    /// Draw along and across the direction of the skin [m]; and 1 for a slipping rope.
    const STATE_LEN: usize = 3;

    fn descriptor() -> Descriptor {
        let help =
            "Skin moves with the rope over an elastic range, then the rope breaks loose and slips.";
        let own = vec![
            Attribute::number(
                "stiffness",
                "N/m^2",
                [1e2, 1e9],
                3e4,
                "How stiffly tissue holds the rope within its elastic range, per metre of rope.",
            ),
            Attribute::number(
                "draw",
                "m",
                [1e-4, 0.5],
                0.05,
                "Elastic range: distance that skin moves with the rope before it is taut.",
            ),
            Attribute::number(
                "taut_ratio",
                "1",
                [1.0, 1e3],
                50.0,
                "How many times stiffer taut tissue is.",
            ),
            Attribute::number(
                "static_ratio",
                "1",
                [1.0, 3.0],
                1.25,
                "Static over kinetic coefficient; the library's coefficient is the kinetic.",
            ),
            coefficient_scale(),
        ];
        Descriptor::new("org.endline.friction.tissue", "Tissue stick-slip", help)
            .with_attributes(own)
    }

    fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let [stiffness_n_m2, draw_m, taut_ratio, static_ratio, coefficient_scale] =
            values(attributes)?;
        Ok(Self { stiffness_n_m2, draw_m, taut_ratio, static_ratio, coefficient_scale })
    }

    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse {
        let (bristle, limit) = self.bristle(contact);
        if bristle.length_m > 0.0 && self.force(&bristle) > limit.force_n {
            bristle.slipping(&limit)
        } else {
            self.stuck(&bristle)
        }
    }

    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]) {
        let (bristle, limit) = self.bristle(contact);
        let slips = bristle.length_m > 0.0 && self.force(&bristle) > limit.force_n;
        let share =
            if slips { self.draw_at(&bristle, limit.force_n) / bristle.length_m } else { 1.0 };
        let kept = bristle.stretch_m.map(|z| share * z);
        out.copy_from_slice(&[
            dot(kept, contact.grain),
            dot(kept, contact.across_grain()),
            f64::from(u8::from(slips)),
        ]);
    }
}

impl Drawn {
    fn bristle(&self, contact: &Contact<'_>) -> (Bristle, Limit) {
        let (along, aside) = (contact.grain, contact.across_grain());
        let drawn: Vec3 = std::array::from_fn(|i| {
            contact.state[0] * along[i] + contact.state[1] * aside[i] + contact.slip_m[i]
        });
        let kinetic = self.coefficient_scale * contact.coefficient;
        let coefficient =
            if contact.state[2] > 0.5 { kinetic } else { self.static_ratio * kinetic };
        let limit = Limit {
            force_n: coefficient * contact.normal_force_n,
            by_normal_force: coefficient,
            ..Limit::default()
        };
        (
            Bristle::new(
                contact.normal,
                across(contact.normal, drawn),
                self.stiffness_n_m2 * contact.length_m,
            ),
            limit,
        )
    }

    /// `F(r)` [N].
    fn force(&self, bristle: &Bristle) -> f64 {
        let soft = bristle.length_m.min(self.draw_m);
        bristle.stiffness_n_m * (soft + self.taut_ratio * (bristle.length_m - soft))
    }

    /// `F⁻¹` [m].
    fn draw_at(&self, bristle: &Bristle, force_n: f64) -> f64 {
        let as_soft = force_n / bristle.stiffness_n_m;
        as_soft.min(self.draw_m) + (as_soft - self.draw_m).max(0.0) / self.taut_ratio
    }

    fn stuck(&self, bristle: &Bristle) -> FrictionResponse {
        let (r, k) = (bristle.length_m, bristle.stiffness_n_m);
        let taut = r > self.draw_m;
        let (around, out) =
            if taut { (self.force(bristle) / r, k * self.taut_ratio) } else { (k, k) };
        let t = if taut { bristle.direction() } else { [0.0; 3] };
        FrictionResponse {
            force_n: bristle.stretch_m.map(|z| -around * z),
            by_slip: matrix(|i, j| {
                -around * projector(bristle.normal, i, j) - (out - around) * t[i] * t[j]
            }),
            by_normal_force: [0.0; 3],
        }
    }
}
