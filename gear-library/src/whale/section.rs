//! The body's sections: the table as smooth curves, and places on its surface.

use std::f64::consts::PI;

use glam::DVec3;

use super::curve::MonotoneCubic;
use super::form::WhaleForm;

/// Depth of the rounded snout and of the rounded tail end [share of length].
pub const CAP: f64 = 0.016;

/// The body's sections in the whale's frame.
pub struct Sections {
    form: WhaleForm,
    width: MonotoneCubic,
    dorsal: MonotoneCubic,
    ventral: MonotoneCubic,
}

impl Sections {
    /// Smooth sections of a form.
    #[must_use]
    pub fn of(form: &WhaleForm) -> Self {
        let curve =
            |value: fn(&super::Station) -> f64| MonotoneCubic::through(form.stations.iter().map(|station| [station.at, value(station)]));
        Self { form: form.clone(), width: curve(|s| s.width), dorsal: curve(|s| s.dorsal), ventral: curve(|s| s.ventral) }
    }

    /// A place given as share of length from the snout and as offset `y`, `z` in shares of length.
    #[must_use]
    pub fn place(&self, at: f64, offset: DVec3) -> DVec3 {
        DVec3::new(0.5 - at, offset.y, offset.z) * self.form.length_m
    }

    /// Half width and half height of a section [share of length].
    #[must_use]
    pub fn halves(&self, at: f64) -> [f64; 2] {
        let scale = self.form.breadth_scale / 2.0;
        [self.width.at(at) * scale, (self.dorsal.at(at) - self.ventral.at(at)) * scale]
    }

    /// Height of a section's middle [share of length].
    #[must_use]
    pub fn height(&self, at: f64) -> f64 {
        (self.dorsal.at(at) + self.ventral.at(at)) / 2.0 * self.form.breadth_scale
    }

    /// Middle of a section in the whale's frame [m].
    #[must_use]
    pub fn axis(&self, at: f64) -> DVec3 {
        self.place(at, DVec3::Z * self.height(at))
    }

    /// A place on the surface; `angle` runs from the back (0) over port to the belly and back over starboard [rad].
    #[must_use]
    pub fn surface(&self, at: f64, angle: f64) -> DVec3 {
        let [half_width, half_height] = self.halves(at);
        let size = cap(at) * self.relief(at, angle);
        let offset = DVec3::new(0.0, half_width * size * libm::sin(angle), self.height(at) + half_height * size * libm::cos(angle));
        self.place(at, offset)
    }

    /// Angle from the back at which the rostrum ends and the lips begin to hide the baleen [rad].
    #[must_use]
    pub fn rostrum_angle(&self) -> f64 {
        libm::asin(self.form.head.rostrum_width.clamp(0.0, 1.0))
    }

    /// The arched lips stand out beside the rostrum, with the slit of the mouth between.
    fn relief(&self, at: f64, angle: f64) -> f64 {
        let head = &self.form.head;
        let along = libm::sin(PI * (at / head.mouth).clamp(0.0, 1.0));
        let from_back = angle.min(2.0 * PI - angle);
        let bump = |middle: f64, half: f64| {
            let off = ((from_back - middle) / half).clamp(-1.0, 1.0);
            (1.0 - off * off) * (1.0 - off * off)
        };
        let slit = self.rostrum_angle() + SLIT / 2.0;
        1.0 + head.lip_arch * along * (bump(slit + 0.45, 0.5) - 0.9 * bump(slit, SLIT))
    }

    /// Where the left flipper meets the body [m].
    #[must_use]
    pub fn flipper_root(&self) -> DVec3 {
        let flippers = &self.form.flippers;
        let [half_width, half_height] = self.halves(flippers.insertion);
        let height = flippers.insertion_height * self.form.breadth_scale;
        let up = ((height - self.height(flippers.insertion)) / half_height).clamp(-1.0, 1.0);
        self.place(flippers.insertion, DVec3::new(0.0, half_width * libm::sqrt(1.0 - up * up), height))
    }

    /// Unit vector along the left flipper at rest.
    #[must_use]
    pub fn flipper_axis(&self) -> DVec3 {
        let (sweep, droop) = (self.form.flippers.sweep, self.form.flippers.droop);
        DVec3::new(-libm::sin(sweep) * libm::cos(droop), libm::cos(sweep) * libm::cos(droop), -libm::sin(droop))
    }
}

/// Width of the slit between rostrum and lip, where baleen shows [rad].
pub const SLIT: f64 = 0.30;

/// How much of a section is left where the snout and the tail's end round off.
fn cap(at: f64) -> f64 {
    let round = |depth: f64| {
        let off = (1.0 - depth / CAP).clamp(0.0, 1.0);
        libm::sqrt(1.0 - off * off)
    };
    round(at).min(round(1.0 - at))
}
