//! Baleen: a rope slides more easily along the plates than across them, and may wedge between them until it is pulled out.
//!
//! Symbols as in `law.rs`; `g` unit vector along the plates, `h = n x g` across them, `l` length of rope, `k` stick stiffness per
//! metre of rope, `mu` coefficient of the library (along the plates), `rho` across over along, `N` normal force, `w` wedged (1) or
//! free (0) at the start of the step, `mu_w` effective coefficient of a wedge, `p` pull-out force per metre of rope.
//!
//! ```text
//! free:    Q(t) = sqrt(((t . g)/mu)² + ((t . h)/(rho mu))²),   L = N/Q(t)
//!          L_N = 1/Q,   L_z = (N/r) (t/Q - (((t . g)/mu²) g + ((t . h)/(rho mu)²) h)/Q³)
//! wedged:  L = max(N/Q(t), min(mu_w N, p l))
//! ```
//!
//! A rope along the plates that does not slip and exceeds the wedging pressure is wedged in the next step. A wedge holds by
//! `mu_w` up to the pull-out force, independent of the pressure. After a slip the rope is free until it sticks again. The
//! bristle shortens along its own direction, so the contact releases no energy (`law.rs`).
//!
//! Reference for the order of ropes: Cavatorta, Starczak, Prada and Moore, "Friction of different ropes in right whale baleen: An
//! entanglement issue", J. Cetacean Res. Manage. (SC/57). Place and orientation of the plates: `docs/whale.md`.

use endline_sdk::{Attribute, Descriptor, FrictionResponse, HookError};

use crate::law::{Bristle, Contact, Law, Limit, Model, Vec3, coefficient_scale, dot, values};

/// Smallest cosine between rope and plates for wedging: 45 degrees.
const LIES_ALONG: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Greatest effective coefficient of a wedge over that of the library, as the program accepts it.
const MOST_WEDGE: f64 = 10.0;

/// The baleen model.
pub type Baleen = Model<Plates>;

/// The law with a call's attribute values.
#[derive(Clone, Debug)]
pub struct Plates {
    stick_stiffness_n_m2: f64,
    across_ratio: f64,
    wedge_pressure_n_m: f64,
    wedge_coefficient: f64,
    pull_out_n_m: f64,
    coefficient_scale: f64,
}

impl Law for Plates {
    /// The bristle [m], world frame; and 1 for a wedged rope.
    const STATE_LEN: usize = 4;

    fn descriptor() -> Descriptor {
        let help = "Rope slides more easily along baleen plates than across them, and wedges between them until it is pulled out.";
        let own = vec![
            Attribute::number(
                "stick_stiffness",
                "N/m^2",
                [1e4, 1e10],
                1e6,
                "How stiffly plates and fringe hold a sticking rope, per metre of rope.",
            ),
            Attribute::number(
                "across_ratio",
                "1",
                [0.2, 3.0],
                1.5,
                "Friction across the plates over that along them; the library's coefficient is that along.",
            ),
            Attribute::number(
                "wedge_pressure",
                "N/m",
                [0.0, 1e6],
                500.0,
                "Normal force by length of rope above which a rope that lies along the plates enters between them.",
            ),
            Attribute::number(
                "wedge_coefficient",
                "1",
                [0.0, 3.0],
                1.5,
                "Effective coefficient of a wedged rope.",
            ),
            Attribute::number(
                "pull_out",
                "N/m",
                [0.0, 1e5],
                600.0,
                "Pull by length of rope that draws a wedged rope out.",
            ),
            coefficient_scale(),
        ];
        Descriptor::new("org.endline.friction.baleen", "Baleen", help).with_attributes(own)
    }

    fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let [
            stick_stiffness_n_m2,
            across_ratio,
            wedge_pressure_n_m,
            wedge_coefficient,
            pull_out_n_m,
            coefficient_scale,
        ] = values(attributes)?;
        Ok(Self {
            stick_stiffness_n_m2,
            across_ratio,
            wedge_pressure_n_m,
            wedge_coefficient,
            pull_out_n_m,
            coefficient_scale,
        })
    }

    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse {
        let (bristle, limit) = self.bristle(contact);
        bristle.response(&limit)
    }

    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]) {
        let (bristle, limit) = self.bristle(contact);
        let wedged =
            bristle.sticks(&limit) && (contact.state[3] > 0.5 || self.goes_between(contact));
        out[..3].copy_from_slice(&bristle.end(&limit));
        out[3] = f64::from(u8::from(wedged));
    }
}

impl Plates {
    fn goes_between(&self, contact: &Contact<'_>) -> bool {
        let lies_along = dot(contact.along, contact.grain).abs() >= LIES_ALONG;
        lies_along && contact.normal_force_n > self.wedge_pressure_n_m * contact.length_m
    }

    fn bristle(&self, contact: &Contact<'_>) -> (Bristle, Limit) {
        let [x, y, z] = [contact.state[0], contact.state[1], contact.state[2]];
        let bristle = Bristle::new(
            contact.normal,
            contact.stretched([x, y, z]),
            self.stick_stiffness_n_m2 * contact.length_m,
        );
        let free = self.free(contact, &bristle);
        let limit = if contact.state[3] > 0.5 { self.wedged(contact, free) } else { free };
        (bristle, limit)
    }

    fn free(&self, contact: &Contact<'_>, bristle: &Bristle) -> Limit {
        let along = self.coefficient_scale * contact.coefficient;
        if bristle.length_m <= 0.0 || along <= 0.0 {
            return Limit::default();
        }
        let (t, aside) = (bristle.direction(), contact.across_grain());
        let across = self.across_ratio * along;
        let parts = [dot(t, contact.grain) / along, dot(t, aside) / across];
        let q = (parts[0] * parts[0] + parts[1] * parts[1]).sqrt();
        let turned: Vec3 = std::array::from_fn(|i| {
            parts[0] / along * contact.grain[i] + parts[1] / across * aside[i]
        });
        let rate = contact.normal_force_n / bristle.length_m;
        Limit {
            force_n: contact.normal_force_n / q,
            by_normal_force: 1.0 / q,
            by_stretch: std::array::from_fn(|i| rate * (t[i] / q - turned[i] / (q * q * q))),
        }
    }

    fn wedged(&self, contact: &Contact<'_>, free: Limit) -> Limit {
        let coefficient = self.wedge_coefficient.min(MOST_WEDGE * contact.coefficient);
        let (pressed, pull_out) =
            (coefficient * contact.normal_force_n, self.pull_out_n_m * contact.length_m);
        let held = if pressed < pull_out {
            Limit { force_n: pressed, by_normal_force: coefficient, ..Limit::default() }
        } else {
            Limit { force_n: pull_out, ..Limit::default() }
        };
        if held.force_n > free.force_n { held } else { free }
    }
}
