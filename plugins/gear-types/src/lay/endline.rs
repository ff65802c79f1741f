//! The endline: two ropes, a surface system, a buoy and an optional high-flyer.
//!
//! The rope at the seabed end floats and stays off the bottom. The rope at the buoy end sinks, away from propellers at the
//! surface.
//!
//! ```text
//!  ~~~~~~ buoy ~ high-flyer-line ~ high-flyer ~~~
//!           |  buoy-link          weak link, at the buoy
//!           |  surface-system     only with its own rope
//!           |  endline-top        L - lower - surface system
//!         splice
//!           |  endline-bottom     lower = share x L,  L = scope x depth
//!  ________foot________
//! ```
//!
//! The make follows lobster practice in Maine, and the Massachusetts rule for recreational pots that an endline be
//! sinking rope except for its bottom third. Scope is 1.2 to 1.5 inshore, up to 2 in strong tide.
//!
//! Initial guess: the buoy lies downstream of the foot, at nine tenths of the horizontal reach of the rope; splices are on the
//! straight line.

use endline_sdk::{Attribute, BodyKind, HookError, LineEnd, RigEnd, Site};

use super::{Foot, Lay, Values, depth_of, downstream};

/// Share of the horizontal reach of the rope in the initial guess [1].
const GUESSED_REACH: f64 = 0.9;

/// The parts of an endline.
#[derive(Clone, Debug)]
pub struct Endline<'a> {
    buoy: &'a str,
    upper_rope: &'a str,
    lower_rope: &'a str,
    lower_share: f64,
    scope: f64,
    surface_rope: &'a str,
    surface_length_m: f64,
    weak_link: &'a str,
    flyer: &'a str,
    flyer_length_m: f64,
}

/// Unstretched lengths of the parts [m].
struct Lengths {
    lower: f64,
    upper: f64,
    /// Zero for a surface system without its own rope.
    surface: f64,
}

impl<'a> Endline<'a> {
    /// The attributes of an endline, with the default buoy.
    #[must_use]
    pub fn attributes(buoy: &'static str) -> Vec<Attribute> {
        let mut attributes = rope_attributes(buoy);
        attributes.extend(surface_attributes());
        attributes
    }

    /// The endline of the attribute values.
    ///
    /// # Errors
    /// Naming the attribute to fix.
    pub fn read(values: &Values<'a>) -> Result<Self, HookError> {
        Ok(Self {
            buoy: values.needed("buoy")?,
            upper_rope: values.needed("upper_rope")?,
            lower_rope: values.needed("lower_rope")?,
            lower_share: values.number("lower_share")?,
            scope: values.number("scope")?,
            surface_rope: values.item("surface_rope")?,
            surface_length_m: values.number("surface_length")?,
            weak_link: values.item("weak_link")?,
            flyer: values.item("high_flyer")?,
            flyer_length_m: values.number("high_flyer_length")?,
        })
    }

    /// Number of lines.
    #[must_use]
    pub fn line_count(&self) -> usize {
        2 + usize::from(!self.surface_rope.is_empty()) + usize::from(!self.flyer.is_empty())
    }

    /// Index of the line that ends at the buoy.
    #[must_use]
    pub fn topmost(&self) -> usize {
        1 + usize::from(!self.surface_rope.is_empty())
    }

    /// Adds the endline at its foot; `prefix` is put before its ids.
    ///
    /// # Errors
    /// If its lengths do not fit; the message names the attribute.
    pub fn lay(
        &self,
        into: &mut Lay,
        foot: &Foot,
        site: &Site,
        prefix: &str,
    ) -> Result<(), HookError> {
        let depth_m = depth_of(site)?;
        let lengths = self.lengths(depth_m)?;
        let named = |id: &str| format!("{prefix}{id}");
        let whole = lengths.lower + lengths.upper + lengths.surface;
        let reach = GUESSED_REACH * (whole * whole - depth_m * depth_m).max(0.0).sqrt();
        let [east, north] = downstream(site.current_m_s);
        let at_buoy = [foot.at_m[0] + reach * east, foot.at_m[1] + reach * north, 0.0];
        let between = |share: f64| {
            std::array::from_fn(|i| foot.at_m[i] + share * (at_buoy[i] - foot.at_m[i]))
        };
        let buoy = into.body(&named("buoy"), BodyKind::Buoy, self.buoy, at_buoy);
        let splice = into.joint(&named("splice"), between(lengths.lower / whole));
        into.line(
            &named("endline-bottom"),
            self.lower_rope,
            [foot.end.clone(), splice.clone()],
            lengths.lower,
        );
        let upper_from = between((lengths.lower + lengths.upper) / whole);
        let topmost = self.lay_upper(into, [splice, buoy.clone()], upper_from, &lengths, prefix);
        into.link(&named("buoy-link"), self.weak_link, &topmost, LineEnd::B);
        self.lay_flyer(into, buoy, at_buoy, [east, north], prefix);
        Ok(())
    }

    /// Adds the rope between splice and buoy: the upper rope, and the surface system beyond `surface_splice_m` if it has its own
    /// rope. Returns the id of the line at the buoy.
    fn lay_upper(
        &self,
        into: &mut Lay,
        [splice, buoy]: [RigEnd; 2],
        surface_splice_m: [f64; 3],
        lengths: &Lengths,
        prefix: &str,
    ) -> String {
        let top = format!("{prefix}endline-top");
        if lengths.surface <= 0.0 {
            into.line(&top, self.upper_rope, [splice, buoy], lengths.upper);
            return top;
        }
        let upper = into.joint(&format!("{prefix}surface-splice"), surface_splice_m);
        into.line(&top, self.upper_rope, [splice, upper.clone()], lengths.upper);
        let surface = format!("{prefix}surface-system");
        into.line(&surface, self.surface_rope, [upper, buoy], lengths.surface);
        surface
    }

    /// Adds the high-flyer downstream of the buoy, if any.
    fn lay_flyer(
        &self,
        into: &mut Lay,
        buoy: RigEnd,
        at_buoy: [f64; 3],
        [east, north]: [f64; 2],
        prefix: &str,
    ) {
        if self.flyer.is_empty() {
            return;
        }
        let off = GUESSED_REACH * self.flyer_length_m;
        let at = [at_buoy[0] + off * east, at_buoy[1] + off * north, 0.0];
        let flyer = into.body(&format!("{prefix}high-flyer"), BodyKind::Buoy, self.flyer, at);
        let rope = if self.surface_rope.is_empty() { self.upper_rope } else { self.surface_rope };
        into.line(&format!("{prefix}high-flyer-line"), rope, [buoy, flyer], self.flyer_length_m);
    }

    fn lengths(&self, depth_m: f64) -> Result<Lengths, HookError> {
        let whole = self.scope * depth_m;
        let lower = self.lower_share * whole;
        let surface = if self.surface_rope.is_empty() { 0.0 } else { self.surface_length_m };
        let upper = whole - lower - surface;
        if upper > 0.0 {
            return Ok(Lengths { lower, upper, surface });
        }
        Err(HookError::new(format!(
            "attribute `surface_length`: {surface} m leaves no upper rope in an endline of {whole:.2} m of which {lower:.2} m is \
             lower rope; shorten it, or raise `scope`, or lower `lower_share`"
        )))
    }
}

/// Buoy, ropes and scope.
fn rope_attributes(buoy: &'static str) -> Vec<Attribute> {
    vec![
        Attribute::item("buoy", "buoys", buoy, "The buoy."),
        Attribute::item("upper_rope", "ropes", "sink-3-8", "Rope of the endline at the buoy end."),
        Attribute::item("lower_rope", "ropes", "pp-3-8", "Rope of the endline at the trap end."),
        Attribute::number(
            "lower_share",
            "1",
            [0.01, 0.99],
            1.0 / 3.0,
            "Share of the endline's length that is lower rope.",
        ),
        Attribute::number(
            "scope",
            "1",
            [1.0, 5.0],
            1.3,
            "Length of the endline as a multiple of water depth.",
        ),
    ]
}

/// Surface system, weak link and high-flyer.
fn surface_attributes() -> Vec<Attribute> {
    vec![
        Attribute::item(
            "surface_rope",
            "ropes",
            "",
            "Rope of the surface system at the buoy; empty for none.",
        ),
        Attribute::number(
            "surface_length",
            "m",
            [0.1, 50.0],
            2.0,
            "Length of the surface system, if it has a separate rope.",
        ),
        Attribute::item(
            "weak_link",
            "weak-links",
            "wl-600",
            "Weak link at the buoy; empty for none.",
        ),
        Attribute::item(
            "high_flyer",
            "buoys",
            "",
            "Staff buoy with a radar reflector, on a line from the buoy; empty for none.",
        ),
        Attribute::number(
            "high_flyer_length",
            "m",
            [0.5, 50.0],
            3.66,
            "Length of the high-flyer's line, of the surface system's rope.",
        ),
    ]
}
