//! The whale of a model: body, motion, friction on its skin, and the pilot program that controls it.

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::{BodyPart, Controls, FrictionModel, Posture, WhaleMotion};
use glam::{DQuat, DVec3};

use crate::whale::jaws::JawStrength;
use crate::whale::kinetic::Kinetic;
use crate::whale::pose::JointRanges;
use crate::whale::skin::{Measures, Skin};

/// A whale in a model.
#[derive(Clone)]
pub struct Whale {
    /// Its surface and bones.
    pub skin: Arc<Skin>,
    /// Ranges of its joints; a motion's posture is clamped to them.
    pub joints: JointRanges,
    /// Body length, snout to fluke notch [m].
    pub length_m: f64,
    /// Mass, volume, wetted area, centre of mass and inertia at rest.
    pub measures: Measures,
    /// Greatest swimming speed [m/s].
    pub burst_speed_m_s: f64,
    /// Initial position of the whale frame's origin [m].
    pub position_m: DVec3,
    /// Initial orientation, whale to world.
    pub orientation: DQuat,
    /// Initial speed through the water [m/s].
    pub speed_m_s: f64,
    /// Its motion plugin.
    pub motion: Arc<dyn WhaleMotion>,
    /// Attributes of the motion, SI, in the declared order.
    pub motion_attributes: Vec<f64>,
    /// Controls where no person steers.
    pub pilot: PilotProgram,
    /// Stiffness of skin and blubber under rope, per metre of rope [N/m²].
    pub contact_stiffness_n_m2: f64,
    /// Closing strength of its mouth; `None` if it closes against any resistance.
    pub jaws: Option<JawStrength>,
    /// Dynamics of a kinetic whale; `None` if it follows its motion plugin regardless of rope.
    pub kinetic: Option<Kinetic>,
}

impl Whale {
    /// Initial joint angles.
    pub fn start_posture(&self) -> Posture {
        let dead = self.kinetic.as_ref().and_then(|kinetic| kinetic.dead.as_ref());
        dead.map_or_else(Posture::default, |dead| dead.posture)
    }
}

/// A friction model with its attribute values.
#[derive(Clone)]
pub struct FrictionLaw {
    /// The model.
    pub model: Arc<dyn FrictionModel>,
    /// Its attributes, SI, in the declared order.
    pub attributes: Vec<f64>,
}

/// Friction of ropes and bodies on the whale: the laws, where each applies, and the table of coefficients.
#[derive(Clone)]
pub struct Friction {
    /// The laws; at least one.
    pub laws: Vec<FrictionLaw>,
    /// Index among the laws by rope index and region number.
    pub law_of: Vec<[usize; endline_sdk::Region::ALL.len()]>,
    /// Coefficient by rope index and region number.
    pub coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
    /// Index among the laws by region number, of traps, buoys and anchors.
    pub law_of_bodies: [usize; endline_sdk::Region::ALL.len()],
    /// Coefficient by region number, of traps, buoys and anchors.
    pub coefficients_of_bodies: [f64; endline_sdk::Region::ALL.len()],
}

/// Default friction coefficient of bodies on a whale: smooth plastic on wet skin 0.1 to 0.3; estimate.
pub const BODY_ON_SKIN_FRICTION: f64 = 0.2;

impl Friction {
    /// One law for every rope and region.
    pub fn of_one(
        model: Arc<dyn FrictionModel>,
        attributes: Vec<f64>,
        coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
    ) -> Self {
        let law_of = vec![[0; endline_sdk::Region::ALL.len()]; coefficients.len()];
        Self {
            laws: vec![FrictionLaw { model, attributes }],
            law_of,
            coefficients,
            law_of_bodies: [0; endline_sdk::Region::ALL.len()],
            coefficients_of_bodies: [BODY_ON_SKIN_FRICTION; endline_sdk::Region::ALL.len()],
        }
    }

    /// Number of floats stored for each contact: the greatest of all laws.
    pub fn state_len(&self) -> usize {
        self.laws.iter().map(|law| law.model.descriptor().state_len).max().unwrap_or(0)
    }
}

/// Controls where no person steers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PilotProgram {
    /// Its entries.
    pub entries: Vec<PilotEntry>,
}

/// Controls that apply for a time after a trigger.
#[derive(Clone, Debug, PartialEq)]
pub struct PilotEntry {
    /// Trigger; an entry begins only once.
    pub trigger: Trigger,
    /// Delay after the trigger [s].
    pub delay_s: f64,
    /// Duration; may be infinite [s].
    pub hold_s: f64,
    /// Time over which controls reach their values, and return after the duration [s].
    pub ramp_s: f64,
    /// The controls it names, in the order of [`Controls::NAMES`].
    pub controls: [Option<f64>; Controls::COUNT],
    /// Those of an entry that begins with rope seen on the starboard side; `controls` are then those for the port side.
    pub controls_starboard: Option<[Option<f64>; Controls::COUNT]>,
}

/// Trigger of an entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// A simulated time [s].
    Time(f64),
    /// First contact of rope with a body part, or with any.
    Touch(Option<BodyPart>),
    /// First time at which the line from snout to fluke notch is within this distance of a target [m].
    Within(f64, Target),
    /// First time at which an eye sees a target, unless rope has touched the whale before.
    Sees(Sight),
    /// Mid-body crosses this depth, in either direction [m].
    Depth(f64),
    /// The compass bearing of the whale's x axis crosses this one, in either direction [rad].
    Heading(f64),
    /// The entry of this smaller index begins.
    After(usize),
}

/// What a whale sees of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight {
    /// Greatest distance from the eye at which it sees the target [m].
    pub distance_m: f64,
    /// Port eye on the straight whale, in the whale's frame; the starboard eye is its mirror image [m].
    pub eye_m: DVec3,
    /// The target.
    pub target: Target,
}

/// Target of a distance trigger.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// Any line.
    AnyLine,
    /// These lines, which form one line of the gear.
    Lines(Range<usize>),
    /// A body's origin.
    Body(usize),
    /// A joint.
    Joint(usize),
}

impl PilotProgram {
    /// Whether all numbers are finite (a duration may be infinite), and each entry refers to earlier entries only.
    pub(crate) fn is_sound(&self) -> bool {
        self.entries.iter().enumerate().all(|(index, entry)| {
            let amounts = entry.controls.iter().flatten().chain([&entry.delay_s, &entry.ramp_s]);
            let follows =
                if let Trigger::After(other) = entry.trigger { other < index } else { true };
            follows && entry.hold_s > 0.0 && amounts.copied().all(f64::is_finite)
        })
    }
}
