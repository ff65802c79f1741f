//! The gear-type hook: attributes in, parts and connections out; then cuts and releases.

use crate::hook::{AttributeValue, Descriptor, HookError};

/// Kind of a body of a rig, with the library folder of its item.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BodyKind {
    /// Trap, from `traps/`.
    Trap = 0,
    /// Buoy, from `buoys/`.
    Buoy = 1,
    /// Anchor, from `anchors/`.
    Anchor = 2,
}

/// A trap, buoy or anchor of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigBody {
    /// Id within the rig, such as `trap` or `trap-3`.
    pub id: String,
    /// Kind.
    pub kind: BodyKind,
    /// Id of the library item.
    pub item: String,
    /// Initial place [m]; statics computes the final one.
    pub position_m: [f64; 3],
}

/// A point where lines meet without a body (a splice).
#[derive(Clone, Debug, PartialEq)]
pub struct RigJoint {
    /// Id within the rig.
    pub id: String,
    /// Initial place [m].
    pub position_m: [f64; 3],
}

/// An end of a line: the id of a body or joint of the same rig.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RigEnd {
    /// At a body, with a colon and the name of a point other than the default: `trap-1:bridle-port`.
    /// `docs/gear-format.md` names the points of each kind.
    Body(String),
    /// At a joint.
    Joint(String),
}

/// An end of a line.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LineEnd {
    /// The `from` end.
    A = 0,
    /// The `to` end.
    B = 1,
}

/// A length of one rope between two ends: endline part, groundline, gangion, bridle leg.
#[derive(Clone, Debug, PartialEq)]
pub struct RigLine {
    /// Id within the rig, such as `endline-top`.
    pub id: String,
    /// Id of the rope in the library.
    pub rope: String,
    /// End A.
    pub from: RigEnd,
    /// End B.
    pub to: RigEnd,
    /// Unstretched length [m].
    pub length_m: f64,
    /// Initial path from end A to end B, such as the flakes of a stowed rope [m]; empty for straight.
    pub laid_m: Vec<[f64; 3]>,
}

/// A weak link at one end of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct RigLink {
    /// Id within the rig.
    pub id: String,
    /// Id of the weak link in the library.
    pub item: String,
    /// Id of its line.
    pub line: String,
    /// At which end.
    pub end: LineEnd,
}

/// Parts and connections that a gear type or an assembly file defines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    /// Traps, buoys, anchors.
    pub bodies: Vec<RigBody>,
    /// Splices.
    pub joints: Vec<RigJoint>,
    /// Lines.
    pub lines: Vec<RigLine>,
    /// Weak links.
    pub links: Vec<RigLink>,
}

/// The site of a rig.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Water depth [m].
    pub depth_m: f64,
    /// Surface current, east and north [m/s].
    pub current_m_s: [f64; 2],
}

/// Input of a gear type, once per step.
#[derive(Clone, Copy, Debug)]
pub struct GearStep<'a> {
    /// Simulated time [s].
    pub time_s: f64,
    /// Length of the step [s].
    pub dt_s: f64,
    /// Tension of each line of its rig, in the order built, at end A then end B [N].
    pub end_tension_n: &'a [[f64; 2]],
}

/// Actions of a gear type, once per step; indices are in the order built.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GearAction {
    /// Cuts a line at one end.
    CutLine {
        /// Index of the line.
        line: u32,
        /// At which end.
        end: LineEnd,
    },
    /// Opens a weak link or release.
    ReleaseLink {
        /// Index of the link.
        link: u32,
    },
}

/// A kind of gear: builds a rig from attributes, then may act once per step.
pub trait GearType: Send + Sync {
    /// Identity and attributes.
    fn descriptor(&self) -> &Descriptor;

    /// Parts and connections from attributes in the declared order.
    ///
    /// # Errors
    /// With a message for the user, naming the attribute to fix.
    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError>;

    /// Once a step: actions appended to `actions`; floats may advance.
    ///
    /// # Errors
    /// With a message for the user; the run ends with it.
    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let _ = (attributes, input, state, actions);
        Ok(())
    }
}
