//! The current of a scenario: speed and bearing by height, and the tide that turns it.

use std::f64::consts::FRAC_PI_2;

use endline_sim::DVec3;
use endline_sim::water::current::Tide;

use crate::compass::direction;
use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Problems, Range};
use crate::tree::Node;
use crate::units::Quantity;

use super::bearing::bearing;

/// Speeds a current may have [m/s].
const SPEED: Range = Range::Between(0.0, 10.0);

/// A current as written; what it leaves open is the site's.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentOf {
    /// Speed at the surface or at `speed_height_m`, over the site's running tide [m/s].
    pub speed_m_s: Option<f64>,
    /// Height above the seabed at which it runs so, if not at the surface [m].
    pub speed_height_m: Option<At<f64>>,
    /// Compass bearing towards which it runs [rad].
    pub toward_rad: f64,
    /// Exponent of its power law, over the site's.
    pub exponent: Option<f64>,
    /// Roughness length of the bed under a logarithmic law, over the site's [m].
    pub roughness_m: Option<f64>,
    /// Rows in place of a power law.
    pub rows: Vec<CurrentRow>,
    /// How it changes with time.
    pub tide: Tide,
    /// Where `[current]` stands.
    pub place: Place,
}

/// The current at one height.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentRow {
    /// Where it is.
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
    #[must_use]
    pub fn share(self, depth_m: f64) -> f64 {
        match self {
            Self::AboveBed(height) => height / depth_m,
            Self::BelowSurface(depth) => 1.0 - depth / depth_m,
        }
    }
}

impl CurrentOf {
    /// The site's own running tide, to the east.
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
pub(super) fn read(fields: &Fields<'_>) -> CurrentOf {
    let speed = fields.value("speed", Quantity::Speed, SPEED);
    let toward_rad = bearing(fields, "toward");
    let speed_height = fields.value("speed_height", Quantity::Length, Range::Between(0.01, 6000.0));
    let exponent = fields.value("exponent", Quantity::Ratio, Range::Between(0.0, 1.0));
    let roughness = fields.value("roughness", Quantity::Length, Range::Between(1e-6, 1.0));
    let rows: Vec<_> = fields
        .tables("profile")
        .iter()
        .filter_map(|node| row(node, toward_rad, fields.problems()))
        .collect();
    let table = times(fields, toward_rad);
    let tide = fields.table("tide").as_ref().and_then(constituent);
    check_law(fields, [&speed, &speed_height, &exponent, &roughness], !rows.is_empty());
    if let (false, Some(lone)) = (table.is_empty(), &speed) {
        let help = "the rows of [[current.at]] give the speed at every time: take this out, or take them out";
        fields.problems().push(lone.place.error("a `speed` beside a tide in rows", help));
    }
    if let (false, Some((_, place))) = (table.is_empty(), &tide) {
        let help = "keep [current.tide] for a tidal constituent, or [[current.at]] for a table";
        fields.problems().push(place.error("both `tide` and `at` are given", help));
    }
    fields.finish();
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

/// One law at most, none beside rows, and no height without the speed that it is the height of.
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
        let help = "the rows of [[current.profile]] give the speed at every height: take this out, or take them out";
        report(lone, "a speed or exponent beside a profile in rows", help);
    }
    if let (Some(_), Some(roughness)) = (exponent, roughness) {
        report(
            roughness,
            "both `exponent` and `roughness` are given",
            "keep the exponent of a power law or the roughness of a logarithmic one",
        );
    }
    if let (None, Some(height)) = (speed, speed_height) {
        report(
            height,
            "a `speed_height` without a `speed`",
            "write the speed that the current has at this height, or take this out",
        );
    }
}

/// One `[[current.profile]]`: height above the seabed, or depth, with the speed there.
fn row(node: &Node, toward_rad: f64, problems: &Problems) -> Option<CurrentRow> {
    let fields = Fields::of(node, problems);
    let height = fields.value("height", Quantity::Length, Range::Between(0.0, 6000.0));
    let depth = fields.value("depth", Quantity::Length, Range::Between(0.0, 6000.0));
    let velocity_m_s = velocity(&fields, toward_rad);
    let written = fields.get("height").or(fields.get("depth")).is_some();
    let at = match (height, depth) {
        (Some(height), None) => {
            Some(At { value: RowHeight::AboveBed(height.value), place: height.place })
        }
        (None, Some(depth)) => {
            Some(At { value: RowHeight::BelowSurface(depth.value), place: depth.place })
        }
        (Some(_), Some(depth)) => {
            problems.push(depth.place.error(
                "a row with both `height` and `depth`",
                "keep the height above the seabed or the depth",
            ));
            None
        }
        (None, None) if written => None,
        (None, None) => {
            fields.missing("height", "write the height above the seabed, such as height = \"2 m\", or the depth below the surface");
            None
        }
    };
    fields.finish();
    Some(CurrentRow { at: at?, velocity_m_s: velocity_m_s? })
}

/// Every `[[current.at]]`: velocity at a time.
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
        let help =
            "keep the time at which it runs as [current] says, or that of the slack water before";
        fields.problems().push(slack.place.error("both `peak` and `slack` are given", help));
    }
    fields.finish();
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
