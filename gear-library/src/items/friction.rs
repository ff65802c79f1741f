//! How a rope material rubs on a whale.

use endline_sdk::Region;

use crate::entry::Entry;

/// Coefficients of friction of one rope material on the whale's surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct RopeFriction {
    /// Its file; the id is the material.
    pub entry: Entry,
    /// Coefficient by region number.
    pub coefficients: [f64; Region::ALL.len()],
}

impl RopeFriction {
    /// From a file's figures; `None` where one is missing, which is a problem already told.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        let mut coefficients = [0.0; Region::ALL.len()];
        for (place, region) in coefficients.iter_mut().zip(Region::ALL) {
            *place = entry.value(surface(region))?;
        }
        Some(Self { entry, coefficients })
    }
}

/// The surface a region's friction is filed under.
fn surface(region: Region) -> &'static str {
    match region {
        Region::Rostrum => "rostrum",
        Region::Baleen => "baleen",
        Region::Lips => "lips",
        Region::Head => "head",
        _ => "skin",
    }
}
