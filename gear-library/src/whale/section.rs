//! The body's sections: the table as smooth curves, and places on its surface.

use glam::{DVec2, DVec3};

use super::curve::MonotoneCubic;
use super::form::WhaleForm;

/// The body's sections in the whale's frame.
pub struct Sections {
    length_m: f64,
    breadth: f64,
    width: MonotoneCubic,
    dorsal: MonotoneCubic,
    ventral: MonotoneCubic,
    girth: MonotoneCubic,
}

impl Sections {
    /// Smooth sections of a form.
    #[must_use]
    pub fn of(form: &WhaleForm) -> Self {
        let curve = |value: fn(&super::Station) -> f64| {
            MonotoneCubic::through(form.stations.iter().map(|station| [station.at, value(station)]))
        };
        Self {
            length_m: form.length_m,
            breadth: form.breadth_scale,
            width: curve(|s| s.width),
            dorsal: curve(|s| s.dorsal),
            ventral: curve(|s| s.ventral),
            girth: MonotoneCubic::through(form.girth.iter().copied()),
        }
    }

    /// A place given as share of length from the snout and as offset to port and up in shares of length.
    #[must_use]
    pub fn place(&self, at: f64, offset: DVec2) -> DVec3 {
        DVec3::new(0.5 - at, offset.x, offset.y) * self.length_m
    }

    /// Half width and half height of a section [share of length].
    #[must_use]
    pub fn halves(&self, at: f64) -> DVec2 {
        let scale = self.breadth * self.girth.at(at) / 2.0;
        DVec2::new(self.width.at(at), self.dorsal.at(at) - self.ventral.at(at)) * scale
    }

    /// Height of a section's middle [share of length].
    #[must_use]
    pub fn height(&self, at: f64) -> f64 {
        (self.dorsal.at(at) + self.ventral.at(at)) / 2.0 * self.breadth
    }

    /// Middle of a section in the whale's frame [m].
    #[must_use]
    pub fn axis(&self, at: f64) -> DVec3 {
        self.place(at, DVec2::Y * self.height(at))
    }

    /// A point of a section's outline, to port and up; `angle` runs from the back (0) over port to the belly (π) [share of length].
    #[must_use]
    pub fn outline(&self, at: f64, angle: f64) -> DVec2 {
        DVec2::Y * self.height(at)
            + self.halves(at) * DVec2::new(libm::sin(angle), libm::cos(angle))
    }

    /// A place on the surface [m]; on the midplane `y` is exactly 0.
    #[must_use]
    pub fn surface(&self, at: f64, angle: f64) -> DVec3 {
        let mut outline = self.outline(at, angle);
        if angle <= 0.0 || angle >= std::f64::consts::PI {
            outline.x = 0.0;
        }
        self.place(at, outline)
    }

    /// How far out a place lies: below 1 inside the body, above 1 outside, squared.
    #[must_use]
    pub fn level(&self, place: DVec3) -> f64 {
        let at = 0.5 - place.x / self.length_m;
        let halves = self.halves(at).max(DVec2::splat(1e-9));
        let offset = DVec2::new(place.y, place.z) / self.length_m - DVec2::Y * self.height(at);
        (offset / halves).length_squared()
    }

    /// Angle from the back of a height in a section, on the port side [rad].
    #[must_use]
    pub fn angle_of_height(&self, at: f64, height: f64) -> f64 {
        let up = (height * self.breadth - self.height(at)) / self.halves(at).y.max(1e-9);
        libm::acos(up.clamp(-1.0, 1.0))
    }

    /// Where the left flipper's axis meets the body [m].
    #[must_use]
    pub fn flipper_root(&self, form: &WhaleForm) -> DVec3 {
        let flippers = &form.flippers;
        self.place(
            flippers.insertion,
            self.outline(
                flippers.insertion,
                self.angle_of_height(flippers.insertion, flippers.insertion_height),
            ),
        )
    }

    /// Factor on widths and heights before girth [1].
    #[must_use]
    pub fn breadth(&self) -> f64 {
        self.breadth
    }
}
