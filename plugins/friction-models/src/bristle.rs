//! A bristle between rope and skin: what every law here is made of.
//!
//! Symbols: `z*` trial stretch across the normal, `r = |z*|`, `t = z*/r`, `P = I - n nᵀ`, `k` stiffness, `L` greatest force that
//! the law lets the bristle hold, with derivatives `L_N` by the normal force and `L_z` by the stretch.
//!
//! ```text
//! stick, where k r <= L:   f = -k z*    df/ds = -k P                                   df/dN = 0
//! slip, else:              f = -L t     df/ds = -(L/r) (P - t tᵀ) - t L_zᵀ             df/dN = -L_N t
//! end of step:             z = z* in stick, (L/k) t in slip
//! ```
//!
//! No energy comes out of it, whatever `L` does from step to step. With `z = c z*`, `0 <= c <= 1`, at the end, and `s = z* - z0`:
//! `f . s + k/2 (|z|² - |z0|²) = -k z . (z* - z) - k/2 |z - z0|² <= 0`.

use endline_sdk::FrictionResponse;

use crate::contact::{Vec3, dot};

/// Greatest force a bristle holds, and how it changes.
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

    /// Direction of the stretch; only asked for where the stretch is not zero.
    pub fn direction(&self) -> Vec3 {
        self.stretch_m.map(|component| component / self.length_m)
    }

    /// Force and derivatives: of a sticking bristle, or of one that slips at the limit.
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
