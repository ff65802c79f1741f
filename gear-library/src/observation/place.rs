//! Sites of an observation: finer than body parts at the mouth, coarser if a side was not reported.

use endline_sdk::{BodyPart, Region, Side};
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

/// A site of rope.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    IntoStaticStr,
    VariantArray,
)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Site {
    /// In the mouth: rope that is lodged there.
    Mouth,
    /// On the head, outside the mouth.
    Head,
    /// On the body.
    Body,
    /// On the left flipper.
    LeftFlipper,
    /// On the right flipper.
    RightFlipper,
    /// On either flipper.
    Flipper,
    /// On the tail stock.
    Peduncle,
    /// On the left fluke.
    LeftFluke,
    /// On the right fluke.
    RightFluke,
    /// On either fluke.
    Fluke,
}

impl Site {
    /// Every site, from the snout to the tail.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Sites that are a single place.
    pub const SINGLE: [Self; 8] = [
        Self::Mouth,
        Self::Head,
        Self::Body,
        Self::LeftFlipper,
        Self::RightFlipper,
        Self::Peduncle,
        Self::LeftFluke,
        Self::RightFluke,
    ];

    /// Its name in files, such as `left_flipper`.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// A site by its name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|site| site.name() == name)
    }

    /// Its single sites: itself, or both of a pair.
    pub fn singles(self) -> &'static [Self] {
        match self {
            Self::Mouth => &[Self::Mouth],
            Self::Head => &[Self::Head],
            Self::Body => &[Self::Body],
            Self::LeftFlipper => &[Self::LeftFlipper],
            Self::RightFlipper => &[Self::RightFlipper],
            Self::Flipper => &[Self::LeftFlipper, Self::RightFlipper],
            Self::Peduncle => &[Self::Peduncle],
            Self::LeftFluke => &[Self::LeftFluke],
            Self::RightFluke => &[Self::RightFluke],
            Self::Fluke => &[Self::LeftFluke, Self::RightFluke],
        }
    }

    /// The mirrored site.
    pub fn mirrored(self) -> Self {
        match self {
            Self::LeftFlipper => Self::RightFlipper,
            Self::RightFlipper => Self::LeftFlipper,
            Self::LeftFluke => Self::RightFluke,
            Self::RightFluke => Self::LeftFluke,
            same => same,
        }
    }

    /// The site of a body part, away from the mouth.
    pub fn of_part(part: BodyPart) -> Self {
        match part {
            BodyPart::Head => Self::Head,
            BodyPart::Body => Self::Body,
            BodyPart::LeftFlipper => Self::LeftFlipper,
            BodyPart::RightFlipper => Self::RightFlipper,
            BodyPart::Peduncle => Self::Peduncle,
            BodyPart::LeftFluke => Self::LeftFluke,
            BodyPart::RightFluke => Self::RightFluke,
        }
    }

    /// The site that a region of skin belongs to.
    pub fn of_region(region: Region) -> Self {
        match region {
            Region::Baleen | Region::Lips => Self::Mouth,
            other => Self::of_part(other.part()),
        }
    }
}

/// A place along the rope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PathPlace {
    /// The site.
    pub site: Site,
    /// Side of a site in the midplane, if reported.
    pub side: Option<Side>,
}

impl PathPlace {
    /// Reads a place such as `mouth:left` or `peduncle`.
    pub fn named(text: &str) -> Option<Self> {
        let (site, side) = match text.split_once(':') {
            None => (text, None),
            Some((site, "left")) => (site, Some(Side::Left)),
            Some((site, "right")) => (site, Some(Side::Right)),
            Some(_) => return None,
        };
        let site = Site::named(site)?;
        (side.is_none() || site.is_in_midplane()).then_some(Self { site, side })
    }

    /// The mirrored place.
    pub fn mirrored(self) -> Self {
        let side = self.side.map(|side| match side {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        });
        Self { site: self.site.mirrored(), side }
    }
}

impl From<PathPlace> for String {
    fn from(place: PathPlace) -> Self {
        place.to_string()
    }
}

impl TryFrom<String> for PathPlace {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        Self::named(&text).ok_or_else(|| format!("`{text}` is not a place on a whale"))
    }
}

impl std::fmt::Display for PathPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.site.name())?;
        match self.side {
            None => Ok(()),
            Some(Side::Left) => formatter.write_str(":left"),
            Some(Side::Right) => formatter.write_str(":right"),
        }
    }
}

impl Site {
    /// Whether it is in the midplane and therefore has two sides.
    pub fn is_in_midplane(self) -> bool {
        matches!(self, Self::Mouth | Self::Head | Self::Body | Self::Peduncle)
    }
}
