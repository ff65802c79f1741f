//! Stribeck friction of rope on wet, lubricated skin: it decreases as a film of water forms, then rises with speed.
//!
//! Symbols as in `law.rs`; `mu` kinetic coefficient of the library, `rho` static over kinetic coefficient, `v` slip speed,
//! `w` slip speed of the film with its lag, `v_s` Stribeck speed, `v_v` viscous speed, `tau` film time, `N` normal force.
//!
//! ```text
//! mu_film(w) = mu (1 + (rho - 1) exp(-(w/v_s)²))            Stribeck curve
//! L          = (mu_film(w) + mu min(v/v_v, 1)) N            with the viscous part, at most equal to the kinetic
//! dw/dt      = (v - w) / tau                                the film follows with a lag
//! v          = (r - L/k) / dt                               slip beyond the stretch of the bristle
//! ```
//!
//! The film is a state, so that within a step the force only rises with slip. A law that decreases with the speed of the same
//! step would have several solutions. The lag is measured (Hess and Soom); steady slip has the plain Stribeck curve.
//!
//! In terms of the bristle the viscous part is implicit: with `a = mu/(v_v dt)`,
//! `L = (mu_film + a r) N / (1 + a N/k)`, `L_r = a N / (1 + a N/k)`, `L_N = (mu_film + a r) / (1 + a N/k)²`.
//!
//! References: Stribeck, Z. VDI 46 (1902) 1341-1348; Hess and Soom, "Friction at a lubricated line contact operating at oscillating
//! sliding velocities", J. Tribology 112 (1990) 147-152; Armstrong-Hélouvry, Dupont and Canudas de Wit, Automatica 30 (1994)
//! 1083-1138.

use endline_sdk::{Attribute, Descriptor, FrictionResponse, HookError};

use crate::law::{Bristle, Contact, Law, Limit, Model, coefficient_scale, values};

/// Greatest viscous part, as a share of the kinetic coefficient.
const MOST_VISCOUS: f64 = 1.0;

/// The Stribeck model.
pub type Stribeck = Model<Film>;

/// The law with a call's attribute values.
#[derive(Clone, Debug)]
pub struct Film {
    stick_stiffness_n_m2: f64,
    static_ratio: f64,
    stribeck_speed_m_s: f64,
    viscous_speed_m_s: f64,
    film_time_s: f64,
    coefficient_scale: f64,
}

impl Law for Film {
    /// The bristle [m], world frame, and the lagged slip speed of the film [m/s].
    const STATE_LEN: usize = 4;

    fn descriptor() -> Descriptor {
        let help = "Rope on wet skin: holds most at rest, least at a slow slip, and more again as it slips faster.";
        let own = vec![
            Attribute::number(
                "stick_stiffness",
                "N/m^2",
                [1e4, 1e10],
                1e7,
                "How stiffly skin holds a sticking rope, per metre of rope.",
            ),
            Attribute::number(
                "static_ratio",
                "1",
                [1.0, 2.0],
                1.4,
                "Static over kinetic coefficient; the library's coefficient is the kinetic.",
            ),
            Attribute::number(
                "stribeck_speed",
                "m/s",
                [1e-3, 5.0],
                0.05,
                "Slip speed over which the coefficient falls from static to kinetic.",
            ),
            Attribute::number(
                "viscous_speed",
                "m/s",
                [0.1, 1e4],
                20.0,
                "Slip speed at which drag in the film is as great as kinetic friction; it grows no further.",
            ),
            Attribute::number(
                "film_time",
                "s",
                [0.0, 1.0],
                0.01,
                "Time by which the film lags behind the slip speed.",
            ),
            coefficient_scale(),
        ];
        Descriptor::new("org.endline.friction.stribeck", "Stribeck", help).with_attributes(own)
    }

    fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let [
            stick_stiffness_n_m2,
            static_ratio,
            stribeck_speed_m_s,
            viscous_speed_m_s,
            film_time_s,
            coefficient_scale,
        ] = values(attributes)?;
        Ok(Self {
            stick_stiffness_n_m2,
            static_ratio,
            stribeck_speed_m_s,
            viscous_speed_m_s,
            film_time_s,
            coefficient_scale,
        })
    }

    fn respond(&self, contact: &Contact<'_>) -> FrictionResponse {
        let (bristle, limit) = self.bristle(contact);
        bristle.response(&limit)
    }

    fn advance(&self, contact: &Contact<'_>, out: &mut [f64]) {
        let (bristle, limit) = self.bristle(contact);
        let (end, followed) = (bristle.end(&limit), contact.state[3]);
        let beyond = (bristle.length_m - limit.force_n / bristle.stiffness_n_m).max(0.0);
        // Backward Euler of the lag, with v dt = `beyond`.
        out[..3].copy_from_slice(&end);
        out[3] = (followed * self.film_time_s + beyond) / (self.film_time_s + contact.dt_s);
    }
}

impl Film {
    fn bristle(&self, contact: &Contact<'_>) -> (Bristle, Limit) {
        let [x, y, z] = [contact.state[0], contact.state[1], contact.state[2]];
        let bristle = Bristle::new(
            contact.normal,
            contact.stretched([x, y, z]),
            self.stick_stiffness_n_m2 * contact.length_m,
        );
        let limit = self.limit(contact, &bristle);
        (bristle, limit)
    }

    fn limit(&self, contact: &Contact<'_>, bristle: &Bristle) -> Limit {
        let (kinetic, normal_n) =
            (self.coefficient_scale * contact.coefficient, contact.normal_force_n);
        let share = contact.state[3] / self.stribeck_speed_m_s;
        let film = kinetic * (1.0 + (self.static_ratio - 1.0) * libm::exp(-share * share));
        let still = Limit { force_n: film * normal_n, by_normal_force: film, ..Limit::default() };
        if bristle.sticks(&still) {
            return still;
        }
        let by_slip = kinetic / (self.viscous_speed_m_s * contact.dt_s);
        let soft = 1.0 + by_slip * normal_n / bristle.stiffness_n_m;
        let coefficient = film + by_slip * bristle.length_m;
        let most = film + MOST_VISCOUS * kinetic;
        if coefficient / soft >= most {
            return Limit { force_n: most * normal_n, by_normal_force: most, ..Limit::default() };
        }
        let by_length = by_slip * normal_n / soft;
        Limit {
            force_n: coefficient * normal_n / soft,
            by_normal_force: coefficient / (soft * soft),
            by_stretch: bristle.direction().map(|t| by_length * t),
        }
    }
}
