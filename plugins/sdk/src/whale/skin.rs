//! The skin of a whale by name: regions, and the body parts that they make up.
//!
//! A body part is declared here, with its name, limb and side, and with its regions. Lists, groups and
//! names elsewhere follow from these declarations.

/// A labelled patch of skin: where a contact is, at the resolution of friction.
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

impl Region {
    /// Whether it is an edge or tip of a flipper or fluke.
    #[must_use]
    pub const fn is_edge(self) -> bool {
        match self {
            Self::LeftFlipperLeading
            | Self::LeftFlipperTrailing
            | Self::LeftFlipperTip
            | Self::RightFlipperLeading
            | Self::RightFlipperTrailing
            | Self::RightFlipperTip
            | Self::LeftFlukeLeading
            | Self::LeftFlukeTrailing
            | Self::RightFlukeLeading
            | Self::RightFlukeTrailing => true,
            Self::Rostrum
            | Self::Baleen
            | Self::Lips
            | Self::Head
            | Self::Body
            | Self::Peduncle
            | Self::LeftFlipper
            | Self::RightFlipper
            | Self::LeftFluke
            | Self::RightFluke => false,
        }
    }

    /// The region of the other side; itself for a central one.
    #[must_use]
    pub const fn mirrored(self) -> Self {
        match self {
            Self::LeftFlipper => Self::RightFlipper,
            Self::LeftFlipperLeading => Self::RightFlipperLeading,
            Self::LeftFlipperTrailing => Self::RightFlipperTrailing,
            Self::LeftFlipperTip => Self::RightFlipperTip,
            Self::RightFlipper => Self::LeftFlipper,
            Self::RightFlipperLeading => Self::LeftFlipperLeading,
            Self::RightFlipperTrailing => Self::LeftFlipperTrailing,
            Self::RightFlipperTip => Self::LeftFlipperTip,
            Self::LeftFluke => Self::RightFluke,
            Self::LeftFlukeLeading => Self::RightFlukeLeading,
            Self::LeftFlukeTrailing => Self::RightFlukeTrailing,
            Self::RightFluke => Self::LeftFluke,
            Self::RightFlukeLeading => Self::LeftFlukeLeading,
            Self::RightFlukeTrailing => Self::LeftFlukeTrailing,
            Self::Rostrum
            | Self::Baleen
            | Self::Lips
            | Self::Head
            | Self::Body
            | Self::Peduncle => self,
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

    /// Declaration of each part: name, limb and side. Lists, groups and names elsewhere follow
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
            assert_eq!(region.mirrored().mirrored(), region);
            assert_eq!(region.mirrored().is_edge(), region.is_edge());
            let sides = [region, region.mirrored()].map(|region| region.part().side());
            let crosses =
                [[Some(Side::Left), Some(Side::Right)], [Some(Side::Right), Some(Side::Left)]];
            assert!(sides == [None, None] || crosses.contains(&sides), "{}", region.name());
        }
    }
}
