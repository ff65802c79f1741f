//! The whale's body as data: a triangle skin, the bones that move it, and the angles of a posture.

use endline_sdk::{Region, SPINE_JOINTS};
use glam::DVec3;

/// A closed triangle skin on bones: at most four bones move a vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Rest place of each vertex in the whale's frame [m].
    pub vertices: Vec<DVec3>,
    /// Vertices of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Region of each triangle.
    pub regions: Vec<Region>,
    /// Bones that move each vertex, with weights that sum to 1; unused places have weight 0.
    pub weights: Vec<[(u16, f64); 4]>,
    /// What is seen at each vertex, for the view alone: contact goes by region.
    pub marks: Vec<Mark>,
    /// Bones, parents before children; bone 0 is the control bone (the whale's frame).
    pub bones: Vec<Bone>,
}

/// What the skin looks like at a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// Dark skin.
    #[default]
    Skin,
    /// Raised, roughened patch on the head, pale with whale lice.
    Callosity,
    /// Baleen plates.
    Baleen,
    /// Inside of the mouth: gums, palate, tongue.
    Mouth,
    /// White patch on belly or throat.
    White,
    /// Eye.
    Eye,
}

/// A bone: turns about its origin by the posture's channels that drive it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bone {
    /// Name, such as `spine_3` or `left_flipper_blade`.
    pub name: String,
    /// Index of its parent; `None` for the control bone.
    pub parent: Option<usize>,
    /// Rest place of its origin in the whale's frame [m].
    pub origin: DVec3,
    /// Channels that turn it and about which axis (whale's rest frame), applied in this order.
    pub turns: Vec<(Channel, DVec3)>,
}

/// One angle of a [`Posture`](endline_sdk::Posture); `share` of it goes to the bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// Which angle.
    pub angle: Angle,
    /// Share of the angle this bone takes.
    pub share: f64,
}

/// Names of the angles of a posture; sides are 0 left, 1 right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angle {
    /// Spine pitch at a joint.
    SpinePitch(usize),
    /// Spine yaw at a joint.
    SpineYaw(usize),
    /// Spine roll at a joint.
    SpineRoll(usize),
    /// Fluke pitch.
    FlukePitch,
    /// Fluke flex by side.
    FlukeFlex(usize),
    /// Flipper sweep by side.
    FlipperSweep(usize),
    /// Flipper raise by side.
    FlipperRaise(usize),
    /// Flipper twist by side.
    FlipperTwist(usize),
    /// Flipper flex by side.
    FlipperFlex(usize),
    /// Jaw.
    Jaw,
    /// Lower lip by side.
    Lips(usize),
}

impl Angle {
    /// The spine's angles by joint: pitch, yaw, roll.
    pub const SPINE: [fn(usize) -> Self; 3] = [Self::SpinePitch, Self::SpineYaw, Self::SpineRoll];

    /// Every angle of a posture, once.
    pub fn all() -> impl Iterator<Item = Self> {
        let spine = Self::SPINE.into_iter().flat_map(|axis| (0..SPINE_JOINTS).map(axis));
        let flippers =
            [Self::FlipperSweep, Self::FlipperRaise, Self::FlipperTwist, Self::FlipperFlex]
                .into_iter()
                .flat_map(Self::sides);
        spine
            .chain([Self::FlukePitch])
            .chain(Self::sides(Self::FlukeFlex))
            .chain(flippers)
            .chain([Self::Jaw])
            .chain(Self::sides(Self::Lips))
    }

    /// Its name in files, such as `spine_yaw`, and its joint or side (0 left, 1 right).
    #[must_use]
    pub fn name(self) -> (&'static str, Option<usize>) {
        match self {
            Self::SpinePitch(joint) => ("spine_pitch", Some(joint)),
            Self::SpineYaw(joint) => ("spine_yaw", Some(joint)),
            Self::SpineRoll(joint) => ("spine_roll", Some(joint)),
            Self::FlukePitch => ("fluke_pitch", None),
            Self::FlukeFlex(side) => ("fluke_flex", Some(side)),
            Self::FlipperSweep(side) => ("flipper_sweep", Some(side)),
            Self::FlipperRaise(side) => ("flipper_raise", Some(side)),
            Self::FlipperTwist(side) => ("flipper_twist", Some(side)),
            Self::FlipperFlex(side) => ("flipper_flex", Some(side)),
            Self::Jaw => ("jaw", None),
            Self::Lips(side) => ("lips", Some(side)),
        }
    }

    fn sides(of: fn(usize) -> Self) -> impl Iterator<Item = Self> {
        (0..2).map(of)
    }
}
