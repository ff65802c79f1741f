//! The sea of a scenario: site, seabed, current with its tide, and waves.

use std::f64::consts::FRAC_PI_2;

use endline_sim::DVec3;
use endline_sim::water::current::Tide;
use endline_sim::water::waves::{Spectrum, WaveKind, Waves};

use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Range};
use crate::limits;
use crate::units::Quantity;

/// Site, seabed, current and waves.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// Site of the library, if any.
    pub item: Option<At<String>>,
    /// Depth, overrides the site's [m].
    pub depth_m: Option<f64>,
    /// Density, overrides the site's [kg/m³].
    pub density_kg_m3: Option<f64>,
    /// Gravity, overrides the site's [m/s²].
    pub gravity_m_s2: Option<f64>,
    /// Whether rope above the surface is dry.
    pub rope_dries: bool,
    /// The seabed; `None` for a scenario without one.
    pub seabed: Option<Bed>,
    /// The current.
    pub current: CurrentOf,
    /// The waves, if any, with the place of their height.
    pub waves: Option<At<Waves>>,
    /// Place of `[site]`.
    pub place: Place,
}

/// Properties of the seabed that override the site.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bed {
    /// Slope [rad].
    pub slope_rad: Option<f64>,
    /// Compass bearing of its slope [rad].
    pub toward_rad: Option<f64>,
    /// Friction on rope.
    pub rope_friction: Option<f64>,
    /// Stiffness under rope [N/m²].
    pub rope_stiffness_n_m2: Option<f64>,
    /// Stiffness under one corner of a trap [N/m].
    pub foot_stiffness_n_m: Option<f64>,
}

/// `[site]`, `[current]` and `[waves]`.
pub(super) fn read(fields: &Fields<'_>) -> Sea {
    let site = fields.table("site");
    let waves = fields.inside("waves", read_waves).flatten();
    let mut sea = Sea {
        item: None,
        depth_m: None,
        density_kg_m3: None,
        gravity_m_s2: None,
        rope_dries: true,
        seabed: Some(Bed::default()),
        current: fields
            .inside("current", read_current)
            .unwrap_or_else(|| CurrentOf::of_site(fields.place)),
        waves,
        place: site.as_ref().map_or_else(|| fields.place.clone(), |site| site.place.clone()),
    };
    match site {
        Some(site) => read_site(&site, &mut sea),
        None => fields.missing(
            "site",
            "write [site] with item = \"cape-cod-bay\", or with depth and density",
        ),
    }
    sea
}

fn read_site(site: &Fields<'_>, sea: &mut Sea) {
    let value = |key, quantity, range| site.value(key, quantity, range).map(|value| value.value);
    sea.item = site.text("item");
    sea.depth_m = value("depth", Quantity::Length, Range::Between(0.5, 6000.0));
    sea.density_kg_m3 = value("density", Quantity::Density, Range::Between(0.0, 2000.0));
    sea.gravity_m_s2 = value("gravity", Quantity::Acceleration, Range::Between(0.0, 20.0));
    let bed = Bed {
        slope_rad: value("slope", Quantity::Angle, Range::Between(0.0, 1.0)),
        toward_rad: value("slope_toward", Quantity::Angle, Range::Any),
        rope_friction: value("rope_friction", Quantity::Ratio, Range::Between(0.0, 10.0)),
        rope_stiffness_n_m2: value("rope_stiffness", Quantity::Pressure, Range::Positive),
        foot_stiffness_n_m: value("foot_stiffness", Quantity::ForceByLength, Range::Positive),
    };
    sea.seabed = site.flag("seabed").unwrap_or(true).then_some(bed);
    sea.rope_dries = site.flag("rope_dries").unwrap_or(true);
    if sea.item.is_none() && sea.depth_m.is_none() {
        site.missing(
            "depth",
            "name a site of the library as `item`, or write a depth such as 25 m",
        );
    }
    if sea.item.is_none() && sea.density_kg_m3.is_none() {
        site.missing("density", "name a site of the library as `item`, or write a density such as 1025 kg/m3; 0 kg/m3 is a vacuum");
    }
    site.finish();
}

/// Allowed speeds of a current [m/s].
const SPEED: Range = Range::Between(0.0, 10.0);

/// A current as written; missing properties are those of the site.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentOf {
    /// Speed at the surface or at `speed_height_m`, overrides the site's [m/s].
    pub speed_m_s: Option<f64>,
    /// Height above the seabed at which the speed applies; `None` for the surface [m].
    pub speed_height_m: Option<At<f64>>,
    /// Compass bearing of its direction [rad].
    pub toward_rad: f64,
    /// Exponent of its power law, overrides the site's.
    pub exponent: Option<f64>,
    /// Roughness length of the bed of a logarithmic law, overrides the site's [m].
    pub roughness_m: Option<f64>,
    /// Rows instead of a law.
    pub rows: Vec<CurrentRow>,
    /// Its change with time.
    pub tide: Tide,
    /// Place of `[current]`.
    pub place: Place,
}

/// The current at one height.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentRow {
    /// Its height.
    pub at: At<RowHeight>,
    /// Velocity [m/s].
    pub velocity_m_s: DVec3,
}

/// The height of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowHeight {
    /// Above the seabed [m].
    AboveBed(f64),
    /// Below the mean surface [m].
    BelowSurface(f64),
}

impl RowHeight {
    /// Height above the seabed as a share of the depth.
    pub fn share(self, depth_m: f64) -> f64 {
        match self {
            Self::AboveBed(height) => height / depth_m,
            Self::BelowSurface(depth) => 1.0 - depth / depth_m,
        }
    }
}

impl CurrentOf {
    /// The running tide of the site, to the east.
    pub(super) fn of_site(place: &Place) -> Self {
        Self {
            speed_m_s: None,
            speed_height_m: None,
            toward_rad: FRAC_PI_2,
            exponent: None,
            roughness_m: None,
            rows: Vec::new(),
            tide: Tide::Steady,
            place: place.clone(),
        }
    }
}

/// `[current]` with its `[[current.profile]]`, `[current.tide]` and `[[current.at]]`.
pub(super) fn read_current(fields: &Fields<'_>) -> CurrentOf {
    let speed = fields.value("speed", Quantity::Speed, SPEED);
    let toward_rad = bearing(fields, "toward");
    let speed_height = fields.value("speed_height", Quantity::Length, Range::Between(0.01, 6000.0));
    let exponent = fields.value("exponent", Quantity::Ratio, Range::Between(0.0, 1.0));
    let roughness = fields.value("roughness", Quantity::Length, Range::Between(1e-6, 1.0));
    let rows = fields.each("profile", |table| row(table, toward_rad));
    let table = times(fields, toward_rad);
    let tide = fields.inside("tide", constituent).flatten();
    check_law(fields, [&speed, &speed_height, &exponent, &roughness], !rows.is_empty());
    if let (false, Some(lone)) = (table.is_empty(), &speed) {
        let help = "the rows of [[current.at]] contain the speed: remove this, or the rows";
        fields.problems().push(lone.place.error("a `speed` beside a tide in rows", help));
    }
    if let (false, Some((_, place))) = (table.is_empty(), &tide) {
        let help = "keep [current.tide] for a tidal constituent, or [[current.at]] for a table";
        fields.problems().push(place.error("both `tide` and `at` are present", help));
    }
    CurrentOf {
        speed_m_s: speed.map(|speed| speed.value),
        speed_height_m: speed_height,
        toward_rad,
        exponent: exponent.map(|exponent| exponent.value),
        roughness_m: roughness.map(|roughness| roughness.value),
        rows,
        tide: if table.is_empty() {
            tide.map_or(Tide::Steady, |(tide, _)| tide)
        } else {
            Tide::Table(table)
        },
        place: fields.place.clone(),
    }
}

/// Checks that there is at most one law, none with rows, and no height without its speed.
fn check_law(
    fields: &Fields<'_>,
    [speed, speed_height, exponent, roughness]: [&Option<At<f64>>; 4],
    has_rows: bool,
) {
    let report = |lone: &At<f64>, message: &str, help: &str| {
        fields.problems().push(lone.place.error(message, help))
    };
    let law = exponent.as_ref().or(roughness.as_ref());
    if let (true, Some(lone)) = (has_rows, speed.as_ref().or(speed_height.as_ref()).or(law)) {
        let help = "the rows of [[current.profile]] contain the speed: remove this, or the rows";
        report(lone, "a speed or exponent beside a profile in rows", help);
    }
    if let (Some(_), Some(roughness)) = (exponent, roughness) {
        report(
            roughness,
            "both `exponent` and `roughness` are present",
            "keep the exponent of a power law or the roughness of a logarithmic one",
        );
    }
    if let (None, Some(height)) = (speed, speed_height) {
        report(
            height,
            "a `speed_height` without a `speed`",
            "write the speed at this height, or remove this",
        );
    }
}

/// Reads a `[[current.profile]]`: velocity by height above the seabed or by depth.
fn row(fields: &Fields<'_>, toward_rad: f64) -> Option<CurrentRow> {
    let height = fields.value("height", Quantity::Length, Range::Between(0.0, 6000.0));
    let depth = fields.value("depth", Quantity::Length, Range::Between(0.0, 6000.0));
    let velocity_m_s = velocity(fields, toward_rad);
    let written = fields.get("height").or(fields.get("depth")).is_some();
    let at = match (height, depth) {
        (Some(height), None) => {
            Some(At { value: RowHeight::AboveBed(height.value), place: height.place })
        }
        (None, Some(depth)) => {
            Some(At { value: RowHeight::BelowSurface(depth.value), place: depth.place })
        }
        (Some(_), Some(depth)) => fields.refuse(depth.place.error(
            "a row with both `height` and `depth`",
            "keep the height above the seabed or the depth",
        )),
        (None, None) if written => None,
        (None, None) => {
            fields.missing("height", "write the height above the seabed, such as height = \"2 m\", or the depth below the surface");
            None
        }
    };
    Some(CurrentRow { at: at?, velocity_m_s: velocity_m_s? })
}

/// Reads the `[[current.at]]`: velocity by time.
fn times(fields: &Fields<'_>, toward_rad: f64) -> Vec<(f64, DVec3)> {
    let mut rows: Vec<(f64, DVec3)> = Vec::new();
    for node in fields.tables("at") {
        let row = Fields::of(node, fields.problems());
        let time = row.need_value("time", Quantity::Time, Range::Any);
        let velocity = velocity(&row, toward_rad);
        row.finish();
        let (Some(time), Some(velocity)) = (time, velocity) else { continue };
        if rows.last().is_some_and(|(earlier, _)| *earlier >= time.value) {
            fields.problems().push(
                time.place.error(
                    "rows are not in rising order of `time`",
                    "put them in the order of time",
                ),
            );
        }
        rows.push((time.value, velocity));
    }
    rows
}

fn velocity(fields: &Fields<'_>, usual_rad: f64) -> Option<DVec3> {
    let speed = fields.need_value("speed", Quantity::Speed, SPEED);
    let toward = fields
        .value("toward", Quantity::Angle, Range::Any)
        .map_or(usual_rad, |toward| toward.value);
    Some(direction(toward) * speed?.value)
}

/// `[current.tide]`: one tidal constituent about a residual.
fn constituent(fields: &Fields<'_>) -> Option<(Tide, Place)> {
    let period = fields.need_value("period", Quantity::Time, Range::Between(1.0, 1e8));
    let peak = fields.value("peak", Quantity::Time, Range::Any);
    let slack = fields.value("slack", Quantity::Time, Range::Any);
    let minor = fields.value("minor", Quantity::Ratio, Range::Between(-1.0, 1.0));
    let residual = fields.value("residual", Quantity::Speed, SPEED);
    let residual_toward = bearing(fields, "residual_toward");
    if let (Some(_), Some(slack)) = (&peak, &slack) {
        let help = "keep the time of the greatest speed, or that of the slack water before";
        fields.problems().push(slack.place.error("both `peak` and `slack` are present", help));
    }
    let period_s = period?.value;
    let peak_s = peak.map_or_else(
        || slack.map_or(0.0, |slack| slack.value + 0.25 * period_s),
        |peak| peak.value,
    );
    let tide = Tide::Constituent {
        period_s,
        peak_s,
        minor: minor.map_or(0.0, |minor| minor.value),
        residual_m_s: direction(residual_toward) * residual.map_or(0.0, |residual| residual.value),
    };
    Some((tide, fields.place.clone()))
}

/// Default peak enhancement: the mean of JONSWAP.
const USUAL_GAMMA: f64 = 3.3;
/// Default number of components.
const USUAL_COMPONENTS: usize = 64;
/// Default ramp, in periods.
const USUAL_RAMP: f64 = 2.0;

/// `[waves]`, with the place of their height; `None` if a required field is missing, which is reported.
pub(super) fn read_waves(fields: &Fields<'_>) -> Option<At<Waves>> {
    let spectrum = fields.word("spectrum", &["jonswap"]);
    let height = fields.need_value("height", Quantity::Length, Range::Between(0.0, 40.0));
    let period = fields.need_value("period", Quantity::Time, Range::Between(0.2, 1e5));
    let toward = bearing(fields, "toward");
    let ramp = fields.value("ramp", Quantity::Time, Range::NotNegative);
    let phase = fields.value("phase", Quantity::Angle, Range::Any);
    let gamma = fields.value("gamma", Quantity::Ratio, Range::Between(1.0, 20.0));
    let components = fields.count("components", &limits::WAVE_COMPONENTS);
    check_shape(
        fields,
        spectrum.is_some(),
        phase.as_ref(),
        gamma_or_components(&gamma, &components),
    );
    let (height, period_s) = (height?, period?.value);
    let kind = match spectrum {
        None => WaveKind::Regular {
            height_m: height.value,
            period_s,
            phase_rad: phase.map_or(0.0, |phase| phase.value),
        },
        Some(_) => WaveKind::Jonswap {
            spectrum: Spectrum {
                significant_height_m: height.value,
                peak_period_s: period_s,
                gamma: gamma.map_or(USUAL_GAMMA, |gamma| gamma.value),
            },
            components: components.map_or(USUAL_COMPONENTS, |components| components.value as usize),
        },
    };
    let ramp_s = ramp.map_or(USUAL_RAMP * period_s, |ramp| ramp.value);
    Some(At { value: Waves { toward: direction(toward), ramp_s, kind }, place: height.place })
}

/// Place of the first figure that only a spectrum has.
fn gamma_or_components<'a>(
    gamma: &'a Option<At<f64>>,
    components: &'a Option<At<u64>>,
) -> Option<&'a Place> {
    let components = || components.as_ref().map(|components| &components.place);
    gamma.as_ref().map(|gamma| &gamma.place).or_else(components)
}

/// Reports a phase with a spectrum, and a figure of a spectrum without one.
fn check_shape(
    fields: &Fields<'_>,
    irregular: bool,
    phase: Option<&At<f64>>,
    of_spectrum: Option<&Place>,
) {
    if let (true, Some(phase)) = (irregular, phase) {
        fields.problems().push(phase.place.error(
            "a `phase` with a spectrum",
            "phases of irregular waves are drawn from the seed",
        ));
    }
    if let (false, Some(place)) = (irregular, of_spectrum) {
        fields.problems().push(place.error(
            "a figure of a spectrum with regular waves",
            "write spectrum = \"jonswap\" for irregular waves, or remove it",
        ));
    }
}

/// Unit vector of a compass bearing [rad], x east and y north: 0 is north, a quarter turn is east.
pub(crate) fn direction(bearing_rad: f64) -> DVec3 {
    let clean = |share: f64| if share.abs() < 1e-15 { 0.0 } else { share };
    DVec3::new(clean(libm::sin(bearing_rad)), clean(libm::cos(bearing_rad)), 0.0)
}

/// The compass bearing of a key; east by default [rad].
pub(super) fn bearing<'a>(fields: &Fields<'a>, key: &'a str) -> f64 {
    fields.value(key, Quantity::Angle, Range::Any).map_or(FRAC_PI_2, |angle| angle.value)
}
