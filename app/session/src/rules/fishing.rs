//! Where, when and how gear is fished: what who asks must say.

use endline_gear::Date;

/// Where, when and how gear is fished.
#[derive(Clone, Debug)]
pub struct Fishing {
    /// Id of the area.
    pub area: String,
    /// The day.
    pub on: Date,
    /// Depth of the water, where it is given [m].
    pub depth_m: Option<f64>,
    /// Distance from shore, where it is given [m].
    pub distance_m: Option<f64>,
    /// Traps on one set, in place of those counted.
    pub traps: Option<u16>,
}
