//! Friction state that is stored from step to step: on skin, on solids, between bodies, and between ropes.

use glam::DVec3;

use crate::bits::clone_in_place;

/// State of the friction laws at the active sites, sorted by site; all lists have one entry per site.
#[derive(Debug, Default, PartialEq)]
pub struct FrictionState {
    /// Active sites.
    pub sites: Vec<u64>,
    /// Normal force of the skin on each site at the end of the last solver step [N].
    pub push_n: Vec<f64>,
    /// Direction of the normal force.
    pub normals: Vec<DVec3>,
    /// Floats of all sites, one site after the other: number of the law, energy dissipated and returned [J], then the plugin's
    /// own.
    pub floats: Vec<f64>,
}

clone_in_place!(FrictionState { sites, push_n, normals, floats });

impl FrictionState {
    /// Removes all grips.
    pub(crate) fn clear(&mut self) {
        self.sites.clear();
        self.push_n.clear();
        self.normals.clear();
        self.floats.clear();
    }
}

/// Part of a rope that touches a solid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bears {
    /// A point within a segment.
    #[default]
    Within,
    /// A node.
    Node,
    /// A knot.
    Knot,
}

/// Elastic grip of rope on a solid, stored from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidGrip {
    /// Index of the solid: obstacles first, then the parts of bodies, body after body.
    pub solid: usize,
    /// Index of the line.
    pub line: usize,
    /// Unstretched length along the line [m].
    pub along_m: f64,
    /// Part of the rope in contact.
    pub bears: Bears,
    /// Tangential displacement, in the solid's frame [m].
    pub stretch: DVec3,
    /// Normal force at the end of the last step [N].
    pub push_n: f64,
    /// Largest stiffness of a contact on its body in the last step; infinite on an obstacle [N/m].
    pub most_n_m: f64,
}

/// A length of rope that has been inside a body since the start of the run; contact with the body begins after it has left it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeWithin {
    /// Index of the solid: obstacles first, then the parts of bodies, body after body.
    pub solid: usize,
    /// Index of the line.
    pub line: usize,
    /// Unstretched length along the line to its start [m].
    pub from_m: f64,
    /// Unstretched length along the line to its end [m].
    pub to_m: f64,
}

/// Contact of a body with a triangle of skin, stored from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyGrip {
    /// Part of a body; parts are numbered body after body.
    pub part: usize,
    /// Contact point in the body's frame [m].
    pub place: DVec3,
    /// Direction of the normal force.
    pub normal: DVec3,
}

/// Contacts of bodies with skin and the floats of their friction laws, in the layout of [`FrictionState`].
#[derive(Debug, Default, PartialEq)]
pub struct BodyGrips {
    /// Contacts.
    pub contacts: Vec<BodyGrip>,
    /// Floats of all contacts, one contact after the other.
    pub floats: Vec<f64>,
}

clone_in_place!(BodyGrips { contacts, floats });

impl BodyGrips {
    /// Removes all grips.
    pub(crate) fn clear(&mut self) {
        self.contacts.clear();
        self.floats.clear();
    }
}

/// Contact of two bodies, or of a body and an obstacle, stored from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairGrip {
    /// Parts of the two bodies in rising order, numbered body after body; obstacles are numbered after all parts.
    pub parts: [usize; 2],
    /// Contact point in the first body's frame [m].
    pub place: DVec3,
    /// Direction of the normal force on the first body, in its frame.
    pub normal: DVec3,
    /// Tangential displacement of the grip, in its frame [m].
    pub stretch: DVec3,
    /// Overlap at the first contact, which is not corrected [m].
    pub forgiven_m: f64,
}

/// Contact of two ropes, stored from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeGrip {
    /// The two lines.
    pub lines: [usize; 2],
    /// Indices of the knots in contact; `None` where the rope itself touches.
    pub knots: [Option<usize>; 2],
    /// Unstretched length along each line to the contact [m].
    pub along_m: [f64; 2],
    /// Tangential displacement of the grip [m].
    pub stretch: DVec3,
    /// Allowed overlap of ropes that overlapped at the start of the run; it decreases slowly [m].
    pub forgiven_m: f64,
}
