//! What friction keeps from step to step: on skin, on solids, and between ropes.

use glam::DVec3;

use crate::in_place::clone_in_place;

/// Floats of the friction laws for the sites in touch, in rising order of site.
#[derive(Debug, Default, PartialEq)]
pub struct FrictionState {
    /// Sites in touch.
    pub sites: Vec<u64>,
    /// Push of the skin on each at the end of the last solver step [N].
    pub push_n: Vec<f64>,
    /// Direction of that push.
    pub normals: Vec<DVec3>,
    /// Floats of each, one after the other: number of the law, energy taken and given [J], then the plugin's own.
    pub floats: Vec<f64>,
}

clone_in_place!(FrictionState { sites, push_n, normals, floats });

impl FrictionState {
    /// Forgets all grips.
    pub(crate) fn clear(&mut self) {
        self.sites.clear();
        self.push_n.clear();
        self.normals.clear();
        self.floats.clear();
    }
}

/// What of a rope bears on a solid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bears {
    /// A place within a segment.
    #[default]
    Within,
    /// A node.
    Node,
    /// A knot.
    Knot,
}

/// A grip of rope on a solid that lasts from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidGrip {
    /// Solid: obstacles first, then the parts of bodies, body after body.
    pub solid: usize,
    /// Line.
    pub line: usize,
    /// Unstretched length along the line [m].
    pub along_m: f64,
    /// What of the rope bears there.
    pub bears: Bears,
    /// Tangential stretch, in the solid's frame [m].
    pub stretch: DVec3,
    /// Normal force at the end of the last step [N].
    pub push_n: f64,
}

/// A length of rope that has lain within a body since the run began, and does not touch it until it has come out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeWithin {
    /// Solid: obstacles first, then the parts of bodies, body after body.
    pub solid: usize,
    /// Line.
    pub line: usize,
    /// Unstretched length along the line to where it begins [m].
    pub from_m: f64,
    /// The same to where it ends [m].
    pub to_m: f64,
}

/// A body's touch on a triangle of skin, as it lasts from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyGrip {
    /// Part of a body, parts being numbered body after body.
    pub part: usize,
    /// Place in the body's frame [m].
    pub place: DVec3,
    /// Direction of the push.
    pub normal: DVec3,
}

/// Bodies' touches on skin with the floats of their laws of friction, one after the other, as in [`FrictionState`].
#[derive(Debug, Default, PartialEq)]
pub struct BodyGrips {
    /// Touches.
    pub contacts: Vec<BodyGrip>,
    /// Floats of each.
    pub floats: Vec<f64>,
}

clone_in_place!(BodyGrips { contacts, floats });

impl BodyGrips {
    /// Forgets all grips.
    pub(crate) fn clear(&mut self) {
        self.contacts.clear();
        self.floats.clear();
    }
}

/// A place at which two bodies, or a body and an obstacle, touch, as it lasts from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairGrip {
    /// Parts of the two bodies, numbered body after body, in rising order; an obstacle comes second, by its number after all parts.
    pub parts: [usize; 2],
    /// Place in the first body's frame [m].
    pub place: DVec3,
    /// Direction of the push on the first body, in its frame.
    pub normal: DVec3,
    /// Tangential stretch of the grip, in its frame [m].
    pub stretch: DVec3,
    /// Depth that is forgiven: bodies that lay in each other at their first touch are not driven apart [m].
    pub forgiven_m: f64,
}

/// A point at which two ropes touch, as it lasts from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeGrip {
    /// The two lines.
    pub lines: [usize; 2],
    /// The knots on them that touch, by their number in the model, where it is not the rope itself.
    pub knots: [Option<usize>; 2],
    /// Unstretched length along each [m].
    pub along_m: [f64; 2],
    /// Tangential stretch of the grip [m].
    pub stretch: DVec3,
    /// Depth that is forgiven: ropes that lay in each other when the run began are pushed apart slowly [m].
    pub forgiven_m: f64,
}
