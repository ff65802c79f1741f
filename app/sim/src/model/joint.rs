//! Joints: the points where line ends meet, and what holds them.

use glam::DVec3;

/// A point where line ends meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Id, for reports.
    pub id: String,
    /// What holds it.
    pub kind: JointKind,
    /// First guess of its place, or its place where fixed or driven [m].
    pub position_m: DVec3,
}

/// What holds a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointKind {
    /// Nothing: it moves with the lines (a splice).
    Free,
    /// A fixture.
    Fixed,
    /// A fixture that moves at a steady velocity between two times.
    Driven {
        /// Velocity [m/s].
        velocity_m_s: DVec3,
        /// From this time [s].
        from_s: f64,
        /// Until this time [s].
        until_s: f64,
    },
    /// A steady force: a rope's free end that is hauled or tailed.
    Pulled {
        /// Force [N].
        force_n: DVec3,
        /// From this time on; it is held until then, through statics too. Below zero it is never held [s].
        from_s: f64,
    },
    /// A body: the joint rides at `offset_m` in the body's frame.
    Body {
        /// Index of the body.
        body: usize,
        /// Place in the body's frame [m].
        offset_m: DVec3,
    },
    /// The whale's skin: the joint goes where the skin goes, and pulls on the whale.
    Whale(Hitch),
}

/// A place on the whale's skin to which rope is made fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hitch {
    /// Index of the triangle.
    pub triangle: usize,
    /// Barycentric place on it.
    pub barycentric: [f64; 3],
    /// Distance from the skin at which the rope's centre line begins [m].
    pub stand_off_m: f64,
}
