//! Sections of the two jaws: the arched rostrum with its racks of baleen, and the lower jaw with lips and tongue.
//!
//! Ahead of the corner of the mouth a section of the head is two closed curves, here the port half of
//! each. Both share the outline of the whole head. Inside the mouth the lower jaw follows the upper at a
//! small distance, so that the closed mouth holds a thin sheet of water. The lip stands off from the
//! baleen in a groove (the orolabial sulcus).

use glam::DVec2;

use super::curve::{MonotoneCubic, smooth_step};
use super::form::WhaleForm;
use super::layout::{CORNER, CORNER_ANGLE, HALF_AROUND, corner_at, mouth_angle};
use super::section::Sections;

/// Vertices inside the mouth from the rim to the midplane, both counted.
pub const INSIDE: usize = 13;
/// Depth of the rounded tip of each jaw [share of length].
const CAP: f64 = 0.016;
/// How far the lower jaw's tip lies behind the snout's [share of length].
const CHIN_BACK: f64 = 0.007;
/// Room between the closed jaws inside the mouth [share of length].
const ROOM: f64 = 0.0038;
/// Room between rostrum and lip at the closed gape [share of length].
const GAPE: f64 = 0.0016;

/// Further room at the lip's foot near the corner of the mouth, where the opening jaw swings it aft [share of length].
const SWING: f64 = 0.02;
/// Least thickness of the lip [share of length].
const LIP: f64 = 0.012;

/// Half a section of a jaw: outside from the midplane to the rim of the mouth, inside from the rim to the midplane [share of length].
pub struct Halfjaw {
    /// Angles from the back of the outside's vertices, in the order of the columns [rad].
    pub angles: Vec<f64>,
    /// Outside, in the order of the columns.
    pub outside: Vec<DVec2>,
    /// Inside, from the rim (its first vertex is the outside's) to the midplane.
    pub inside: Vec<DVec2>,
}

/// The jaws of a form.
pub struct Jaws<'a> {
    sections: &'a Sections,
    corner: f64,
    gape: MonotoneCubic,
    roof: MonotoneCubic,
    baleen: f64,
    lip: f64,
}

impl<'a> Jaws<'a> {
    /// The jaws of a form.
    #[must_use]
    pub fn of(form: &WhaleForm, sections: &'a Sections) -> Self {
        let head = &form.head;
        let narrow = libm::asin(head.rostrum_width.clamp(0.05, 0.95));
        let (low, mean) = (narrow.max(0.2), |share: f64| narrow + (CORNER_ANGLE - narrow) * share);
        let gape = [
            [0.0, CORNER_ANGLE],
            [0.08, mean(0.93)],
            [0.2, mean(0.58)],
            [0.33, mean(0.22)],
            [0.5, mean(0.0)],
            [0.65, low],
            [0.82, mean(0.16)],
            [0.93, mean(0.42)],
            [1.0, mean(0.6)],
        ];
        let roof =
            [[0.0, 0.0], [0.2, 0.010], [0.45, 0.020], [0.7, 0.017], [0.9, 0.008], [1.0, 0.004]];
        Self {
            sections,
            corner: corner_at(form),
            gape: MonotoneCubic::through(gape),
            roof: MonotoneCubic::through(roof),
            baleen: head.baleen,
            lip: head.lip_arch,
        }
    }

    /// Share of the way from the corner of the mouth (0) to the snout's tip (1).
    fn ahead(&self, at: f64) -> f64 {
        1.0 - at / self.corner
    }

    /// Angle from the back at which the mouth opens [rad].
    #[must_use]
    pub fn gape(&self, at: f64) -> f64 {
        self.gape.at(self.ahead(at))
    }

    /// Length of baleen at a place [share of length].
    #[must_use]
    pub fn hang(&self, at: f64) -> f64 {
        let ahead = self.ahead(at);
        let grown = smooth_step(0.10, 0.42, ahead) * (1.0 - smooth_step(0.62, 0.86, ahead));
        let most = 0.64 * self.below(at) - self.roof(at) - LIP * self.sections.breadth();
        self.baleen.min(most).max(0.0) * grown
    }

    /// Depth of the palate below the rim of the mouth, between the racks [share of length].
    fn roof(&self, at: f64) -> f64 {
        (self.roof.at(self.ahead(at)) * self.sections.breadth()).min(0.22 * self.below(at))
    }

    /// Height of the rim of the mouth above the belly [share of length].
    fn below(&self, at: f64) -> f64 {
        self.sections.halves(at).y * (1.0 + libm::cos(self.gape(at)))
    }

    /// Half a section of the upper jaw.
    #[must_use]
    pub fn upper(&self, at: f64) -> Halfjaw {
        let gape = self.gape(at) - self.slit(at);
        let angles: Vec<f64> =
            (0..=CORNER).map(|column| mouth_angle(gape, column as f64)).collect();
        let outside: Vec<DVec2> =
            angles.iter().map(|&angle| self.sections.outline(at, angle)).collect();
        let inside = self.merged(at, outside[CORNER], &self.palate(at));
        capped(at / CAP, 0.6, angles, outside, inside)
    }

    /// Half a section of the lower jaw.
    #[must_use]
    pub fn lower(&self, at: f64) -> Halfjaw {
        let gape = self.gape(at) + self.slit(at);
        let angles: Vec<f64> =
            (CORNER..=HALF_AROUND).map(|column| mouth_angle(gape, column as f64)).collect();
        let outside: Vec<DVec2> =
            angles.iter().map(|&angle| self.sections.outline(at, angle)).collect();
        let inside = self.merged(at, outside[0], &self.floor(at));
        capped((at - CHIN_BACK) / (CAP * 0.9), 0.8, angles, outside, inside)
    }

    /// Where the lower jaw's section stands that goes with one of the upper [share of length].
    #[must_use]
    pub fn lower_place(&self, at: f64) -> f64 {
        let left = (1.0 - at / (CAP + 2.0 * CHIN_BACK)).max(0.0);
        at + CHIN_BACK * left * left
    }

    /// Half the angle of the closed gape [rad].
    fn slit(&self, at: f64) -> f64 {
        let (ahead, halves) = (self.ahead(at), self.sections.halves(at).max(DVec2::splat(1e-4)));
        0.5 * GAPE * (smooth_step(0.0, 0.1, ahead) + 3.0 * smooth_step(0.84, 0.95, ahead))
            / halves.min_element()
    }

    /// Inside of the upper jaw: outer face of the rack, its lower edge, its inner face, the palate.
    fn palate(&self, at: f64) -> [DVec2; INSIDE] {
        let rim = self.sections.outline(at, self.gape(at) - self.slit(at));
        let roof = self.roof(at);
        let deep = roof + self.hang(at);
        let thick = (0.46 * rim.x).min(0.011 * self.sections.breadth());
        let outer = |share: f64| {
            let height = rim.y - deep * share;
            let lip = self.lip_room(at) * libm::fmin(share / 0.38, 1.0);
            let within = (self.outer_edge(at, height) - lip).max(0.5 * rim.x);
            DVec2::new((rim.x * (1.0 - 0.05 * share)).min(within), height)
        };
        let inner = |share: f64| {
            let height = rim.y - roof - (deep - roof) * share;
            DVec2::new(
                outer((rim.y - height) / deep.max(1e-9)).x - thick * (1.0 - 0.5 * share),
                height,
            )
        };
        let bottom = |share: f64| outer(1.0).lerp(inner(1.0), share);
        let across = |share: f64| {
            DVec2::new(inner(0.0).x * (1.0 - share), rim.y - roof * (1.0 - 0.12 * share))
        };
        [
            rim,
            outer(0.12),
            outer(0.38),
            outer(0.7),
            outer(0.96),
            bottom(0.25),
            bottom(0.75),
            inner(0.92),
            inner(0.55),
            inner(0.12),
            across(0.3),
            across(0.65),
            across(1.0),
        ]
    }

    /// Inside of the lower jaw: inner face of the lip, the groove below the rack, the tongue's side and back.
    fn floor(&self, at: f64) -> [DVec2; INSIDE] {
        let upper = self.palate(at);
        let rim = self.sections.outline(at, self.gape(at) + self.slit(at));
        let (ahead, breadth) = (self.ahead(at), self.sections.breadth());
        let (room, front) = (
            ROOM * breadth,
            (0.012 * breadth).min(0.2 * self.below(at)) * smooth_step(0.80, 0.95, ahead),
        );
        let beside = self.beside(at);
        let groove = |share: f64| (self.lip * self.hang(at) + self.swing(at)) * share;
        let lip = |vertex: usize, share: f64| {
            let height = upper[vertex].y - room * (1.0 - beside + beside * share) - 0.6 * front;
            let edge = self.outer_edge(at, height);
            let most = edge - (LIP * breadth * beside * share).max(0.15 * edge * (1.0 - beside));
            DVec2::new((upper[vertex].x + room * beside + groove(share)).min(most), height)
        };
        let under =
            |vertex: usize, side: f64| upper[vertex] + DVec2::new(side * beside, -room - front);
        let tongue = |vertex: usize| {
            DVec2::new((upper[vertex].x - room * beside).max(0.0), upper[vertex].y - room - front)
        };
        let back = |vertex: usize| {
            let share = upper[vertex].x / upper[9].x.max(1e-9);
            DVec2::new(
                (upper[vertex].x - room * beside * share).max(0.0),
                upper[vertex].y - room - front,
            )
        };
        [
            rim,
            lip(1, 0.12 / 0.38),
            lip(2, 1.0),
            lip(3, 1.0),
            lip(4, 1.0),
            under(5, 0.8 * room + groove(0.6)),
            under(6, -0.5 * room),
            tongue(7),
            tongue(8),
            tongue(9),
            back(10),
            back(11),
            back(12),
        ]
    }

    /// Whether the lip stands beside a rack (1) or, at the tip, below the palate (0).
    fn beside(&self, at: f64) -> f64 {
        smooth_step(0.0, 0.02, self.hang(at)).max(1.0 - smooth_step(0.5, 0.6, self.ahead(at)))
    }

    /// Further room for the lip's foot near the corner of the mouth [share of length].
    fn swing(&self, at: f64) -> f64 {
        let ahead = self.ahead(at);
        SWING
            * self.sections.breadth()
            * smooth_step(0.02, 0.2, ahead)
            * (1.0 - smooth_step(0.38, 0.6, ahead))
    }

    /// Room that the upper jaw leaves for the lip within the head's outline [share of length].
    fn lip_room(&self, at: f64) -> f64 {
        ((LIP + ROOM) * self.sections.breadth() + self.swing(at)) * self.beside(at)
    }

    /// Half width of the head's outline at a height [share of length].
    fn outer_edge(&self, at: f64, height: f64) -> f64 {
        let halves = self.sections.halves(at);
        let up = ((height - self.sections.height(at)) / halves.y.max(1e-9)).clamp(-1.0, 1.0);
        halves.x * libm::sqrt(1.0 - up * up)
    }

    /// A jaw's inside, drawn flat across the mouth towards its corner, where palate and floor are one line.
    fn merged(&self, at: f64, rim: DVec2, full: &[DVec2; INSIDE]) -> Vec<DVec2> {
        let grown = smooth_step(-0.04, 0.26, self.ahead(at));
        let grown = (grown - smooth_step(-0.04, 0.26, 0.0)) / (1.0 - smooth_step(-0.04, 0.26, 0.0));
        let flat =
            |vertex: usize| DVec2::new(rim.x * (1.0 - vertex as f64 / (INSIDE - 1) as f64), rim.y);
        full.iter().enumerate().map(|(vertex, &place)| flat(vertex).lerp(place, grown)).collect()
    }
}

/// A section drawn together about its middle, at a share `lift` of its height, near a jaw's tip;
/// `depth` is 0 at the tip and 1 where the rounding ends.
fn capped(
    depth: f64,
    lift: f64,
    angles: Vec<f64>,
    outside: Vec<DVec2>,
    inside: Vec<DVec2>,
) -> Halfjaw {
    let off = (1.0 - depth).clamp(0.0, 1.0);
    let left = libm::sqrt(1.0 - off * off);
    let (low, high) = outside
        .iter()
        .chain(&inside)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place.y), high.max(place.y))
        });
    let middle = DVec2::Y * (low + (high - low) * lift);
    let draw = |places: Vec<DVec2>| {
        places.into_iter().map(|place| middle + (place - middle) * left).collect()
    };
    Halfjaw { angles, outside: draw(outside), inside: draw(inside) }
}
