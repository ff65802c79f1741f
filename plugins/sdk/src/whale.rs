//! The whale as a plugin sees it: posture (joint angles) and surface regions.

/// Spine joints from the skull (0) to the peduncle's end (`SPINE_JOINTS - 1`).
pub const SPINE_JOINTS: usize = 8;

/// Where each spine joint of a right whale sits, as a share of body length aft of the snout [1];
/// other bodies may differ a little.
pub const SPINE_STATIONS: [f64; SPINE_JOINTS] = [0.27, 0.36, 0.45, 0.55, 0.64, 0.73, 0.81, 0.885];

/// Where the flukes hinge on the peduncle, as a share of body length aft of the snout [1].
pub const FLUKE_STATION: f64 = 0.93;

/// Joint angles of a whale [rad]; all zero is the rest posture.
///
/// The stretch of body at mid-length keeps to the whale's frame: joints ahead of it move the head,
/// joints aft of it the tail. Signs are as each field's words say.
///
/// Index 0 of a pair is the left (port) side, 1 the right.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Posture {
    /// Each spine joint about the whale's y axis; positive bends the part aft of it down.
    pub spine_pitch: [f64; SPINE_JOINTS],
    /// Each spine joint about the whale's z axis; positive swings the part aft of it to starboard.
    pub spine_yaw: [f64; SPINE_JOINTS],
    /// Each spine joint about the whale's x axis (torsion); positive turns the part aft of it starboard side down.
    pub spine_roll: [f64; SPINE_JOINTS],
    /// Flukes against the peduncle about y; positive turns the trailing edge down.
    pub fluke_pitch: f64,
    /// Bend of each fluke blade; positive lifts the tip.
    pub fluke_flex: [f64; 2],
    /// Flipper swept aft about the dorsal axis; 0 at rest, positive aft, negative forward.
    pub flipper_sweep: [f64; 2],
    /// Flipper raised (abducted) away from the body; positive lifts the tip.
    pub flipper_raise: [f64; 2],
    /// Flipper twisted about its long axis; positive pronates (leading edge down).
    pub flipper_twist: [f64; 2],
    /// Flipper blade bent; positive lifts the tip.
    pub flipper_flex: [f64; 2],
    /// Jaw drop; 0 closed, positive open.
    pub jaw: f64,
    /// Lower lips turned out; 0 closed against the rostrum, positive open.
    pub lips: [f64; 2],
}

impl Posture {
    /// Its angles by name, with one for each joint or side where there are several; every angle is in one of them.
    #[must_use]
    pub fn groups(&self) -> [(&'static str, &[f64]); 11] {
        let Self { spine_pitch, spine_yaw, spine_roll, fluke_pitch, fluke_flex, .. } = self;
        let Self { flipper_sweep, flipper_raise, flipper_twist, flipper_flex, jaw, lips, .. } =
            self;
        [
            ("spine_pitch", spine_pitch),
            ("spine_yaw", spine_yaw),
            ("spine_roll", spine_roll),
            ("fluke_pitch", std::slice::from_ref(fluke_pitch)),
            ("fluke_flex", fluke_flex),
            ("flipper_sweep", flipper_sweep),
            ("flipper_raise", flipper_raise),
            ("flipper_twist", flipper_twist),
            ("flipper_flex", flipper_flex),
            ("jaw", std::slice::from_ref(jaw)),
            ("lips", lips),
        ]
    }

    /// The places of its angles, in the order of [`groups`](Self::groups).
    pub fn angles_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { spine_pitch, spine_yaw, spine_roll, fluke_pitch, fluke_flex, .. } = self;
        let Self { flipper_sweep, flipper_raise, flipper_twist, flipper_flex, jaw, lips, .. } =
            self;
        let spine = spine_pitch.iter_mut().chain(spine_yaw).chain(spine_roll);
        let flippers =
            flipper_sweep.iter_mut().chain(flipper_raise).chain(flipper_twist).chain(flipper_flex);
        spine.chain([fluke_pitch]).chain(fluke_flex).chain(flippers).chain([jaw]).chain(lips)
    }

    /// Its angles, in the order of [`groups`](Self::groups) [rad].
    pub fn angles(&self) -> impl Iterator<Item = f64> {
        self.groups().into_iter().flat_map(|(_, angles)| angles.iter().copied())
    }
}

/// A labelled patch of skin: where a contact is, as fine as friction needs.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Region {
    /// Upper jaw's narrow top.
    Rostrum = 0,
    /// Baleen racks inside the mouth.
    Baleen = 1,
    /// Arched lower lips.
    Lips = 2,
    /// Rest of the head, chin included.
    Head = 3,
    /// Body between head and peduncle.
    Body = 4,
    /// Tail stock.
    Peduncle = 5,
    /// Blade of the left flipper away from its edges.
    LeftFlipper = 6,
    /// Leading edge of the left flipper.
    LeftFlipperLeading = 7,
    /// Trailing edge of the left flipper.
    LeftFlipperTrailing = 8,
    /// Tip of the left flipper.
    LeftFlipperTip = 9,
    /// Blade of the right flipper away from its edges.
    RightFlipper = 10,
    /// Leading edge of the right flipper.
    RightFlipperLeading = 11,
    /// Trailing edge of the right flipper.
    RightFlipperTrailing = 12,
    /// Tip of the right flipper.
    RightFlipperTip = 13,
    /// Left fluke away from its edges.
    LeftFluke = 14,
    /// Leading edge of the left fluke.
    LeftFlukeLeading = 15,
    /// Trailing edge of the left fluke.
    LeftFlukeTrailing = 16,
    /// Right fluke away from its edges.
    RightFluke = 17,
    /// Leading edge of the right fluke.
    RightFlukeLeading = 18,
    /// Trailing edge of the right fluke.
    RightFlukeTrailing = 19,
}

impl Region {
    /// Every region, in the order of its number.
    pub const ALL: [Self; 20] = [
        Self::Rostrum,
        Self::Baleen,
        Self::Lips,
        Self::Head,
        Self::Body,
        Self::Peduncle,
        Self::LeftFlipper,
        Self::LeftFlipperLeading,
        Self::LeftFlipperTrailing,
        Self::LeftFlipperTip,
        Self::RightFlipper,
        Self::RightFlipperLeading,
        Self::RightFlipperTrailing,
        Self::RightFlipperTip,
        Self::LeftFluke,
        Self::LeftFlukeLeading,
        Self::LeftFlukeTrailing,
        Self::RightFluke,
        Self::RightFlukeLeading,
        Self::RightFlukeTrailing,
    ];

    /// Its name in files, such as `left_fluke_trailing`: a material of a whale's mesh has it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rostrum => "rostrum",
            Self::Baleen => "baleen",
            Self::Lips => "lips",
            Self::Head => "head",
            Self::Body => "body",
            Self::Peduncle => "peduncle",
            Self::LeftFlipper => "left_flipper",
            Self::LeftFlipperLeading => "left_flipper_leading",
            Self::LeftFlipperTrailing => "left_flipper_trailing",
            Self::LeftFlipperTip => "left_flipper_tip",
            Self::RightFlipper => "right_flipper",
            Self::RightFlipperLeading => "right_flipper_leading",
            Self::RightFlipperTrailing => "right_flipper_trailing",
            Self::RightFlipperTip => "right_flipper_tip",
            Self::LeftFluke => "left_fluke",
            Self::LeftFlukeLeading => "left_fluke_leading",
            Self::LeftFlukeTrailing => "left_fluke_trailing",
            Self::RightFluke => "right_fluke",
            Self::RightFlukeLeading => "right_fluke_leading",
            Self::RightFlukeTrailing => "right_fluke_trailing",
        }
    }

    /// The body part it belongs to.
    #[must_use]
    pub fn part(self) -> BodyPart {
        match self {
            Self::Rostrum | Self::Baleen | Self::Lips | Self::Head => BodyPart::Head,
            Self::Body => BodyPart::Body,
            Self::Peduncle => BodyPart::Peduncle,
            Self::LeftFlipper
            | Self::LeftFlipperLeading
            | Self::LeftFlipperTrailing
            | Self::LeftFlipperTip => BodyPart::LeftFlipper,
            Self::RightFlipper
            | Self::RightFlipperLeading
            | Self::RightFlipperTrailing
            | Self::RightFlipperTip => BodyPart::RightFlipper,
            Self::LeftFluke | Self::LeftFlukeLeading | Self::LeftFlukeTrailing => {
                BodyPart::LeftFluke
            }
            Self::RightFluke | Self::RightFlukeLeading | Self::RightFlukeTrailing => {
                BodyPart::RightFluke
            }
        }
    }
}

/// A part of the whale in reports: wraps and loads are counted for each.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BodyPart {
    /// Head with the mouth.
    Head = 0,
    /// Body between head and peduncle.
    Body = 1,
    /// Left flipper.
    LeftFlipper = 2,
    /// Right flipper.
    RightFlipper = 3,
    /// Tail stock.
    Peduncle = 4,
    /// Left fluke.
    LeftFluke = 5,
    /// Right fluke.
    RightFluke = 6,
}

impl BodyPart {
    /// Every part, in the order of its number.
    pub const ALL: [Self; 7] = [
        Self::Head,
        Self::Body,
        Self::LeftFlipper,
        Self::RightFlipper,
        Self::Peduncle,
        Self::LeftFluke,
        Self::RightFluke,
    ];

    /// What is declared of each part: name, limb and side. Lists, groups and names elsewhere follow
    /// from it.
    const fn declared(self) -> (&'static str, Limb, Option<Side>) {
        match self {
            Self::Head => ("head", Limb::Trunk, None),
            Self::Body => ("body", Limb::Trunk, None),
            Self::LeftFlipper => ("left_flipper", Limb::Flipper, Some(Side::Left)),
            Self::RightFlipper => ("right_flipper", Limb::Flipper, Some(Side::Right)),
            Self::Peduncle => ("peduncle", Limb::Trunk, None),
            Self::LeftFluke => ("left_fluke", Limb::Fluke, Some(Side::Left)),
            Self::RightFluke => ("right_fluke", Limb::Fluke, Some(Side::Right)),
        }
    }

    /// Its name in files and results, such as `left_flipper`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.declared().0
    }

    /// The limb it is, or the trunk.
    #[must_use]
    pub const fn limb(self) -> Limb {
        self.declared().1
    }

    /// The side it is on; `None` for a part of the trunk.
    #[must_use]
    pub const fn side(self) -> Option<Side> {
        self.declared().2
    }

    /// Whether rope winds round it about the axis of the trunk.
    #[must_use]
    pub const fn on_trunk(self) -> bool {
        matches!(self.limb(), Limb::Trunk)
    }
}

/// Trunk, or a kind of limb; limbs come in pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limb {
    /// Head, body and peduncle: parts along the spine.
    Trunk,
    /// A flipper.
    Flipper,
    /// A fluke.
    Fluke,
}

impl Limb {
    /// Its name in files and results: both flippers are `flipper`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trunk => "trunk",
            Self::Flipper => "flipper",
            Self::Fluke => "fluke",
        }
    }

    /// Its parts, in the order of their numbers.
    pub fn parts(self) -> impl Iterator<Item = BodyPart> {
        BodyPart::ALL.into_iter().filter(move |part| part.limb() == self)
    }
}

/// A side of the whale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left (port): y above zero in the whale's frame.
    Left,
    /// Right (starboard): y below zero in the whale's frame.
    Right,
}

impl Side {
    /// Sign of y on this side in the whale's frame: 1 to port, -1 to starboard.
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lists_hold_every_part_and_region_at_its_number_under_its_own_name() {
        for (number, part) in BodyPart::ALL.into_iter().enumerate() {
            assert_eq!(part as usize, number);
            assert_eq!(BodyPart::ALL.iter().filter(|other| other.name() == part.name()).count(), 1);
            assert!(Region::ALL.iter().any(|region| region.part() == part), "{}", part.name());
        }
        for (number, region) in Region::ALL.into_iter().enumerate() {
            assert_eq!(region as usize, number);
        }
    }
}
