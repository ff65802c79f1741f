//! The trawl: traps on gangions along a groundline, an endline at one end or at both, optional anchors.

use endline_sdk::{Attribute, Descriptor, HookError, Rig, Site};

use crate::lay::{Endline, FAR, Ground, Lay, Values};
use crate::{Laid, Layout};

/// Greatest number of traps with one endline (NOAA Decision Support Tool, `EndlinesPerTrawlModel`: two from 6 traps up).
const MOST_ON_ONE_ENDLINE: u32 = 5;

/// The gear type of traps along a groundline.
pub type Trawl = Laid<TrapsInRow>;

/// Layout of [`Trawl`].
#[derive(Clone, Debug)]
pub struct TrapsInRow;

impl Layout for TrapsInRow {
    fn descriptor() -> Descriptor {
        let help = "Traps on gangions along a groundline, an endline at one end or at both, anchors \
         where wanted.";
        Descriptor::new("org.endline.gear.trawl", "Trawl", help).with_attributes(Set::attributes(
            5,
            1.83,
            "polyball-a1",
        ))
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        Set::read(values)?.build(site)
    }
}

/// A set of traps with its endlines: a trawl, also with cutters.
pub(crate) struct Set<'a> {
    /// Gear on the seabed.
    pub ground: Ground<'a>,
    /// Each of the endlines.
    pub endline: Endline<'a>,
    /// Number of endlines: one or two.
    pub endlines: usize,
}

impl<'a> Set<'a> {
    /// The attributes of a set, with defaults of the number of traps and the length of gangions [m].
    pub fn attributes(traps: u32, gangion_m: f64, buoy: &'static str) -> Vec<Attribute> {
        let mut attributes = Ground::attributes(traps, gangion_m);
        attributes.push(endlines_attribute());
        attributes.extend(Endline::attributes(buoy));
        attributes
    }

    /// The set of the attribute values.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    pub fn read(values: &Values<'a>) -> Result<Self, HookError> {
        let ground = Ground::read(values)?;
        Ok(Self { endlines: endlines(values, &ground)?, ground, endline: Endline::read(values)? })
    }

    /// The rig of the set.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    pub fn build(&self, site: &Site) -> Result<Rig, HookError> {
        let mut rig = Lay::default();
        let feet = self.ground.lay(&mut rig, site)?;
        for (foot, prefix) in feet.iter().zip(["", FAR]).take(self.endlines) {
            self.endline.lay(&mut rig, foot, site, prefix)?;
        }
        Ok(rig.rig)
    }

    /// Index of the first line of an endline, after the lines on the seabed.
    pub fn first_line(&self, endline: usize) -> usize {
        self.ground.line_count() + endline * self.endline.line_count()
    }
}

/// The attribute of the number of endlines.
pub(crate) fn endlines_attribute() -> Attribute {
    let help = "Number of endlines; 0 for the usual number: one up to 5 traps and two from 6.";
    Attribute::count("endlines", [0, 2], 0, help)
}

/// The number of endlines of the attribute values.
pub(crate) fn endlines(values: &Values<'_>, ground: &Ground<'_>) -> Result<usize, HookError> {
    Ok(match values.count("endlines")? {
        0 => 1 + usize::from(ground.traps() > MOST_ON_ONE_ENDLINE),
        asked => asked as usize,
    })
}
