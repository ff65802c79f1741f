//! The single: one trap on the seabed, one buoy, and an endline of two ropes spliced together,
//! floating rope at the trap end (it stays off the bottom) and sinking rope at the buoy end (it
//! does not lie on the surface, where propellers are).
//!
//! ```text
//!  ~~~~~~~~~ buoy ~~~~       L = scope x depth      whole endline
//!            |  buoy-link    lower = share x L      endline-bottom, trap to splice
//!            |               surface system         only where its rope is named
//!            |  endline-top  upper = L - lower - surface system
//!          splice
//!            |  endline-bottom
//!  _______ trap ______
//! ```
//!
//! First guess: the trap at the origin's foot, the buoy downstream, as far as nine tenths of what
//! the rope spans, the splice on the straight line between. Statics finds the real shape.
//!
//! Make-up of endlines: lobster practice in Maine (sinking rope at the buoy end, floating at the
//! trap end) and the Massachusetts rule that an endline be sinking rope but for its bottom third;
//! scope 1.2 to 1.5 inshore, up to 2 in strong tide.

use endline_sdk::{
    Attribute, AttributeValue, BodyKind, Descriptor, GearType, HookError, LineEnd, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink, Site,
};

/// How much of the horizontal reach of its rope the first guess uses [1].
const GUESSED_REACH: f64 = 0.9;

/// The single-trap gear type.
#[derive(Clone, Debug)]
pub struct Single {
    descriptor: Descriptor,
}

impl Single {
    /// The gear type with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Single {
    fn default() -> Self {
        Self::new()
    }
}

impl GearType for Single {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let settings = Settings::read(attributes)?;
        let lengths = Lengths::of(&settings, site)?;
        let places = Places::guess(&lengths, site);
        let mut rig = endline(&settings, &lengths, &places);
        add_surface_system(&mut rig, &settings, &lengths, &places);
        add_weak_link(&mut rig, &settings);
        Ok(rig)
    }
}

fn descriptor() -> Descriptor {
    Descriptor {
        id: "org.endline.gear.single".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Single".into(),
        help: "One trap, one buoy, and an endline of floating rope below and sinking rope above.".into(),
        attributes: vec![
            Attribute::item("trap", "traps", "wire-lobster-3ft", "The trap."),
            Attribute::item("buoy", "buoys", "bullet-6x14", "The buoy."),
            Attribute::item("upper_rope", "ropes", "sink-3-8", "Rope of the endline at the buoy end."),
            Attribute::item("lower_rope", "ropes", "pp-3-8", "Rope of the endline at the trap end."),
            Attribute::number("lower_share", "1", [0.01, 0.99], 1.0 / 3.0, "Share of the endline's length that is lower rope."),
            Attribute::number("scope", "1", [1.0, 5.0], 1.3, "Length of the endline as a multiple of water depth."),
            Attribute::item("surface_rope", "ropes", "", "Rope of the surface system at the buoy; empty for none of its own."),
            Attribute::number("surface_length", "m", [0.1, 50.0], 2.0, "Length of the surface system, where it has a rope of its own."),
            Attribute::item("weak_link", "weak-links", "wl-600", "Weak link at the buoy; empty for none."),
        ],
        state_len: 0,
    }
}

/// Attribute values of a call, in the declared order.
struct Settings {
    trap: String,
    buoy: String,
    upper_rope: String,
    lower_rope: String,
    lower_share: f64,
    scope: f64,
    surface_rope: String,
    surface_length_m: f64,
    weak_link: String,
}

impl Settings {
    fn read(values: &[AttributeValue]) -> Result<Self, HookError> {
        Ok(Self {
            trap: needed(values, 0, "trap")?,
            buoy: needed(values, 1, "buoy")?,
            upper_rope: needed(values, 2, "upper_rope")?,
            lower_rope: needed(values, 3, "lower_rope")?,
            lower_share: number(values, 4, "lower_share")?,
            scope: number(values, 5, "scope")?,
            surface_rope: item(values, 6, "surface_rope")?,
            surface_length_m: number(values, 7, "surface_length")?,
            weak_link: item(values, 8, "weak_link")?,
        })
    }
}

fn number(values: &[AttributeValue], index: usize, key: &str) -> Result<f64, HookError> {
    let value = values.get(index).and_then(AttributeValue::number);
    value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected a number")))
}

fn item(values: &[AttributeValue], index: usize, key: &str) -> Result<String, HookError> {
    let value = values.get(index).and_then(AttributeValue::item).map(str::to_owned);
    value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected the id of a library item")))
}

fn needed(values: &[AttributeValue], index: usize, key: &str) -> Result<String, HookError> {
    let id = item(values, index, key)?;
    if id.is_empty() { Err(HookError::new(format!("attribute `{key}`: name an item of the library"))) } else { Ok(id) }
}

/// Unstretched lengths of the parts [m].
struct Lengths {
    lower: f64,
    upper: f64,
    /// Zero where the surface system has no rope of its own.
    surface: f64,
}

impl Lengths {
    fn of(settings: &Settings, site: &Site) -> Result<Self, HookError> {
        if !(site.depth_m > 0.0 && site.depth_m.is_finite()) {
            return Err(HookError::new(format!("the site's depth is {} m; a single needs water under it", site.depth_m)));
        }
        let whole = settings.scope * site.depth_m;
        let lower = settings.lower_share * whole;
        let surface = if settings.surface_rope.is_empty() { 0.0 } else { settings.surface_length_m };
        let upper = whole - lower - surface;
        if upper <= 0.0 {
            return Err(HookError::new(format!(
                "attribute `surface_length`: {surface} m leaves no upper rope in an endline of {whole:.2} m of which {lower:.2} m is \
                 lower rope; shorten it, or raise `scope`, or lower `lower_share`"
            )));
        }
        Ok(Self { lower, upper, surface })
    }

    fn whole(&self) -> f64 {
        self.lower + self.upper + self.surface
    }
}

/// First guesses of place [m].
struct Places {
    trap: [f64; 3],
    splice: [f64; 3],
    surface_splice: [f64; 3],
    buoy: [f64; 3],
}

impl Places {
    fn guess(lengths: &Lengths, site: &Site) -> Self {
        let trap = [0.0, 0.0, -site.depth_m];
        let whole = lengths.whole();
        let reach = GUESSED_REACH * (whole * whole - site.depth_m * site.depth_m).max(0.0).sqrt();
        let [east, north] = downstream(site.current_m_s);
        let buoy = [reach * east, reach * north, 0.0];
        let between = |share: f64| std::array::from_fn(|i| trap[i] + share * (buoy[i] - trap[i]));
        Self { trap, splice: between(lengths.lower / whole), surface_splice: between((lengths.lower + lengths.upper) / whole), buoy }
    }
}

/// Unit direction of the current, east where there is none.
fn downstream([east, north]: [f64; 2]) -> [f64; 2] {
    let speed = (east * east + north * north).sqrt();
    if speed > 0.0 { [east / speed, north / speed] } else { [1.0, 0.0] }
}

fn endline(settings: &Settings, lengths: &Lengths, places: &Places) -> Rig {
    let body = |id: &str, kind, item: &str, position_m| RigBody { id: id.into(), kind, item: item.into(), position_m };
    let splice = || RigEnd::Joint("splice".into());
    Rig {
        bodies: vec![body("trap", BodyKind::Trap, &settings.trap, places.trap), body("buoy", BodyKind::Buoy, &settings.buoy, places.buoy)],
        joints: vec![RigJoint { id: "splice".into(), position_m: places.splice }],
        lines: vec![
            line("endline-bottom", &settings.lower_rope, [RigEnd::Body("trap".into()), splice()], lengths.lower),
            line("endline-top", &settings.upper_rope, [splice(), RigEnd::Body("buoy".into())], lengths.upper),
        ],
        links: Vec::new(),
    }
}

fn line(id: &str, rope: &str, [from, to]: [RigEnd; 2], length_m: f64) -> RigLine {
    RigLine { id: id.into(), rope: rope.into(), from, to, length_m }
}

/// Puts the surface system's rope between the endline and the buoy, where it has one.
fn add_surface_system(rig: &mut Rig, settings: &Settings, lengths: &Lengths, places: &Places) {
    if lengths.surface <= 0.0 {
        return;
    }
    let splice = || RigEnd::Joint("surface-splice".into());
    rig.joints.push(RigJoint { id: "surface-splice".into(), position_m: places.surface_splice });
    if let Some(top) = rig.lines.last_mut() {
        top.to = splice();
    }
    rig.lines.push(line("surface-system", &settings.surface_rope, [splice(), RigEnd::Body("buoy".into())], lengths.surface));
}

/// Puts the weak link at the buoy's end of the topmost line, where one is named.
fn add_weak_link(rig: &mut Rig, settings: &Settings) {
    let Some(top) = rig.lines.last().filter(|_| !settings.weak_link.is_empty()) else { return };
    rig.links.push(RigLink { id: "buoy-link".into(), item: settings.weak_link.clone(), line: top.id.clone(), end: LineEnd::B });
}
