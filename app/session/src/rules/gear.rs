//! Gear as rules see it: endlines, groundlines, surface lines.

/// Gear as rules see it.
#[derive(Clone, Debug, Default)]
pub(super) struct Gear {
    /// Traps.
    pub traps: usize,
    /// Buoys with a piece named radar reflector.
    pub reflectors: usize,
    /// Ids of floats: buoys with neither endline nor surface line.
    pub floats: Vec<String>,
    /// Whether a release holds a buoy down.
    pub stowed: bool,
    /// Endlines.
    pub endlines: Vec<Endline>,
    /// Groundlines.
    pub groundlines: Vec<Piece>,
    /// Lengths of lines between buoys [m].
    pub surface_m: Vec<f64>,
}

/// A line from a buoy to what lies on the seabed.
#[derive(Clone, Debug, Default)]
pub(super) struct Endline {
    /// Id of its line at the buoy.
    pub id: String,
    /// Id of its buoy.
    pub buoy: String,
    /// Its pieces from the buoy down; sleeves and links have no length.
    pub pieces: Vec<Piece>,
    /// Id of the weak link at the buoy, and its rating [N].
    pub buoy_link: Option<(String, f64)>,
}

impl Endline {
    /// The lines that it consists of, for messages.
    pub fn name(&self) -> String {
        match self.pieces.last() {
            Some(last) if last.line != self.id => format!("{} to {}", self.id, last.line),
            _ => self.id.clone(),
        }
    }
}

/// A piece of a line, or a sleeve or link in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    /// Its id.
    pub id: String,
    /// Id of the line that it is a piece of.
    pub line: String,
    /// Whether its line's end `to` is the one nearer to the buoy.
    pub from_to: bool,
    /// Id of its rope, or of its link.
    pub item: String,
    /// Unstretched length; zero for a sleeve or link [m].
    pub length_m: f64,
    /// Diameter of its rope [m].
    pub diameter_m: f64,
    /// Density of its rope [kg/m³].
    pub density_kg_m3: f64,
    /// Strength of new material as its source states it [N].
    pub rated_n: f64,
    /// Mean strength of new pieces [N].
    pub new_n: f64,
    /// Mean strength delivered [N].
    pub delivered_n: f64,
}
