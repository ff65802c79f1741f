//! Charts of a run, as plain data: drawn in the window, written as CSV, SVG or PNG.

use endline_sdk::BodyPart;
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use crate::live::{Channel, LiveView, Series, Span};
use crate::scales::SERIES;
use crate::units::Units;

/// Most time spans of a curve: each gives its least and its greatest value, so that no peak is lost.
pub const SPANS: usize = 900;

/// A kind of plot.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
#[strum(serialize_all = "snake_case")]
pub enum Kind {
    /// Greatest tension of each line over time, with strengths and ratings.
    Tension,
    /// Tension along the lines at the moment shown.
    Along,
    /// Normal force on each part of the whale over time.
    Force,
    /// Wraps on each part of the whale over time.
    Wraps,
    /// Depth of the whale over time.
    Depth,
    /// Its speed through the water over time.
    Speed,
}

impl Kind {
    /// Every kind, in the order shown.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Tension => "Tension of each line",
            Self::Along => "Tension along the lines",
            Self::Force => "Contact force by part",
            Self::Wraps => "Wraps by part",
            Self::Depth => "Depth",
            Self::Speed => "Speed",
        }
    }

    /// Its short name, for files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether it runs over time.
    pub fn over_time(self) -> bool {
        self != Self::Along
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Of the run shown.
    #[default]
    Solid,
    /// Of the run it is compared with.
    Dashed,
    /// Least or greatest so far of another curve: thin.
    Edge,
}

/// A curve.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Its name: the line, or the part of the whale.
    pub name: String,
    /// Its points, in the chart's units.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
    /// Its colour, counted through [`SERIES`].
    pub colour: usize,
}

impl Curve {
    /// Its colour.
    pub fn rgb(&self) -> [u8; 3] {
        SERIES[self.colour % SERIES.len()]
    }
}

/// A level across the chart: a strength or rating.
#[derive(Clone, Debug)]
pub struct Level {
    /// Its name.
    pub name: String,
    /// Least and greatest value; equal for a single value.
    pub band: [f64; 2],
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Its kind.
    pub kind: Kind,
    /// Label of the x axis, with the unit.
    pub x: String,
    /// Label of the y axis, with the unit.
    pub y: String,
    /// Its curves.
    pub curves: Vec<Curve>,
    /// Levels near enough to be drawn.
    pub levels: Vec<Level>,
    /// End of the x axis.
    pub end_x: f64,
}

impl Chart {
    /// A kind of plot of a run.
    pub fn of(kind: Kind, view: &LiveView, units: Units) -> Self {
        let duration_s = view.model.spec.settings.duration_s.max(view.newest_s);
        let time = "Time [s]".to_owned();
        let chart = |y: String, curves| Self {
            kind,
            x: time,
            y,
            curves,
            levels: Vec::new(),
            end_x: duration_s,
        };
        let force = units.force();
        let mut made = match kind {
            Kind::Tension => {
                let lines = view.model.spec.lines.iter().enumerate();
                let curves = lines
                    .map(|(index, line)| {
                        curve(&line.id, &view.tension, index, |value| force.of_newtons(value))
                    })
                    .collect();
                Self { levels: levels(view, units), ..chart(force.symbol().to_owned(), curves) }
            }
            Kind::Along => along(view, units),
            Kind::Force => chart(
                force.symbol().to_owned(),
                by_part(view, Channel::Force, |value| force.of_newtons(value)),
            ),
            Kind::Wraps => chart("turns".to_owned(), by_part(view, Channel::Wraps, |value| value)),
            // Depth grows downwards.
            Kind::Depth => chart(
                format!("depth, down, {}", units.length_symbol()),
                whale(view, Channel::Depth, |value| -units.of_metres(value)),
            ),
            Kind::Speed => chart(
                units.speed_symbol().to_owned(),
                whale(view, Channel::Speed, |value| units.of_m_s(value)),
            ),
        };
        if kind != Kind::Along {
            // Each curve has a colour of its own.
            made.curves.iter_mut().enumerate().for_each(|(index, curve)| curve.colour = index);
        }
        made
    }

    /// With the curves of another run beside its own: dashed, in the colour of the curve of the same name.
    pub fn beside(mut self, other: Self) -> Self {
        let mut fresh = self.curves.iter().map(|curve| curve.colour + 1).max().unwrap_or(0);
        let mut theirs = Vec::new();
        for curve in other.curves.into_iter().filter(|curve| curve.style == Style::Solid) {
            let colour = self
                .curves
                .iter()
                .find(|own| own.name == curve.name)
                .map_or(fresh, |own| own.colour);
            fresh = fresh.max(colour + 1);
            theirs.push(Curve {
                name: format!("{} (B)", curve.name),
                style: Style::Dashed,
                colour,
                ..curve
            });
        }
        self.curves.extend(theirs);
        self.end_x = self.end_x.max(other.end_x);
        self
    }

    /// The name by which a curve is hidden: its own, or that of the line whose least or greatest
    /// value it is.
    pub fn line_of<'a>(&'a self, curve: &'a Curve) -> &'a str {
        let line = self
            .curves
            .iter()
            .find(|line| line.style == Style::Solid && line.colour == curve.colour);
        line.filter(|_| curve.style == Style::Edge).map_or(&curve.name, |line| &line.name)
    }

    /// Greatest value of any curve.
    pub fn top(&self) -> f64 {
        self.curves
            .iter()
            .flat_map(|curve| &curve.points)
            .map(|[_, y]| *y)
            .fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Charts as one table of CSV, a row for each point: figure, curve, x and its label, y and its label, and the origin.
pub fn csv(charts: &[Chart], origin: &str) -> String {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let head = ["figure", "curve", "x", "x_is", "y", "y_is", "origin"].map(str::to_owned);
    let rows = charts.iter().flat_map(|chart| {
        let points = |curve: &Curve| {
            let row = |[x, y]: &[f64; 2]| {
                let figure = chart.kind.title().to_owned();
                let [x, y] = [x.to_string(), y.to_string()];
                let (x_is, y_is) = (chart.x.clone(), chart.y.clone());
                [figure, curve.name.clone(), x, x_is, y, y_is, origin.to_owned()]
            };
            curve.points.iter().map(row).collect::<Vec<_>>()
        };
        chart.curves.iter().flat_map(points)
    });
    // Writing to memory cannot fail.
    let written = std::iter::once(head).chain(rows).try_for_each(|row| writer.write_record(row));
    let bytes = written.ok().and_then(|()| writer.into_inner().ok()).unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// A channel of a series as a curve: least and greatest of each span.
fn curve(name: &str, series: &Series, index: usize, unit: impl Fn(f64) -> f64) -> Curve {
    let ends = |span: &Span| {
        let [min, max] = [unit(span.min), unit(span.max)];
        let point = |y| [span.time_s, y];
        // One sample is one point.
        if span.min.to_bits() == span.max.to_bits() {
            vec![point(min)]
        } else {
            vec![point(min), point(max)]
        }
    };
    Curve {
        name: name.to_owned(),
        points: series.spans(index, SPANS).iter().flat_map(ends).collect(),
        ..Curve::default()
    }
}

fn whale(view: &LiveView, channel: Channel, unit: impl Fn(f64) -> f64) -> Vec<Curve> {
    if view.model.spec.whale.is_none() {
        return Vec::new();
    }
    vec![curve("whale", &view.history, channel.index(), unit)]
}

/// A curve for each part that was ever touched.
fn by_part(
    view: &LiveView,
    channel: fn(BodyPart) -> Channel,
    unit: impl Fn(f64) -> f64,
) -> Vec<Curve> {
    let touched = |part: &BodyPart| {
        let whale = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
        whale.is_some_and(|whale| {
            whale
                .regions
                .iter()
                .any(|region| region.part == *part && region.peak_contact_length_m > 0.0)
        })
    };
    let parts = BodyPart::ALL.into_iter().filter(touched);
    parts
        .map(|part| {
            curve(&part.name().replace('_', " "), &view.history, channel(part).index(), &unit)
        })
        .collect()
}

/// Strengths of the ropes as a band from the weakest segment to the rope as new, and ratings of weak links.
fn levels(view: &LiveView, units: Units) -> Vec<Level> {
    let spec = &view.model.spec;
    let force = units.force();
    let links = spec
        .links
        .iter()
        .filter(|link| link.enabled)
        .map(|link| (format!("{} parts", link.id), [link.rating_n; 2]));
    let rope = |(index, rope): (usize, &endline_sim::model::Rope)| {
        let own = (0..spec.lines.len()).filter(|line| spec.lines[*line].rope == index);
        let segments = own.flat_map(|line| view.model.weakest(line, &view.frame.segment_length_m));
        let weakest = segments.map(|weakest| weakest.strength_n).fold(f64::INFINITY, f64::min);
        weakest
            .is_finite()
            .then(|| (format!("{} breaks", rope.id), [weakest, rope.strength_n.max(weakest)]))
    };
    let all = links.chain(spec.ropes.iter().enumerate().filter_map(rope));
    all.map(|(name, band)| Level { name, band: band.map(|value| force.of_newtons(value)) })
        .collect()
}

/// Tension over the rope's length at the moment shown, and least and greatest so far; lines that continue one another are
/// drawn in a row.
fn along(view: &LiveView, units: Units) -> Chart {
    let (spec, frame, force) = (&view.model.spec, &view.frame, units.force());
    let mut ends_m: Vec<f64> = Vec::new();
    let mut curves = Vec::new();
    for (index, line) in spec.lines.iter().enumerate() {
        let before = spec.lines[..index].iter().position(|earlier| earlier.to == line.from);
        let mut at_m = before.map_or(0.0, |before| ends_m[before]);
        let mut points = Vec::new();
        for segment in view.model.line_segments[index].clone() {
            let (Some(length_m), Some(tension_n)) =
                (frame.segment_length_m.get(segment), frame.tension_n.get(segment))
            else {
                continue;
            };
            let y = force.of_newtons(*tension_n);
            points.extend([[units.of_metres(at_m), y], [units.of_metres(at_m + length_m), y]]);
            at_m += length_m;
        }
        ends_m.push(at_m);
        curves.push(Curve { name: line.id.clone(), points, style: Style::Solid, colour: index });
        let start_m = before.map_or(0.0, |before| ends_m[before]);
        curves.extend(envelope(view, index, start_m, units));
    }
    let end_x = units.of_metres(ends_m.iter().copied().fold(0.0, f64::max));
    let x = format!("Along the rope [{}]", units.length_symbol());
    Chart {
        kind: Kind::Along,
        x,
        y: force.symbol().to_owned(),
        curves,
        levels: levels(view, units),
        end_x,
    }
}

/// Least and greatest tension so far along a line that starts at a length of rope.
fn envelope(view: &LiveView, index: usize, start_m: f64, units: Units) -> Vec<Curve> {
    let Some(line) = view.envelope.lines.get(index) else { return Vec::new() };
    let stretch_m = line.length_m / line.least_n.len().max(1) as f64;
    let curve = |what: &str, values_n: &[f64]| {
        let at = |(stretch, value_n): (usize, &f64)| {
            let x = units.of_metres(start_m + stretch_m * (stretch as f64 + 0.5));
            value_n.is_finite().then(|| [x, units.force().of_newtons(*value_n)])
        };
        let points = values_n.iter().enumerate().filter_map(at).collect();
        Curve {
            name: format!("{}, {what} so far", view.model.spec.lines[index].id),
            points,
            style: Style::Edge,
            colour: index,
        }
    };
    vec![curve("least", &line.least_n), curve("greatest", &line.greatest_n)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_of_one_sample_in_ten_thousand_is_drawn_at_its_height() {
        let mut series = Series::default();
        for step in 0..10_000_u32 {
            series.push(f64::from(step) * 0.01, vec![if step == 7321 { 1000.0 } else { 100.0 }]);
        }
        let points = curve("line", &series, 0, |value| value).points;
        assert!(points.len() <= 2 * SPANS);
        let top = points.iter().map(|[_, y]| *y).fold(0.0, f64::max);
        assert!((top - 1000.0).abs() < 1e-6, "{top}");
    }

    #[test]
    fn a_chart_is_written_point_by_point() {
        let points = vec![[0.0, 1.0], [0.5, 2.0]];
        let curves = vec![Curve { name: "endline, top".into(), points, ..Curve::default() }];
        let chart = Chart {
            kind: Kind::Tension,
            x: "Time [s]".into(),
            y: "lbf".into(),
            curves,
            levels: Vec::new(),
            end_x: 1.0,
        };
        let text = csv(&[chart.clone(), chart.clone()], "hello");
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let rows: Vec<::csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 4, "one head, whatever the number of figures: {text}");
        let second =
            ["Tension of each line", "endline, top", "0.5", "Time [s]", "2", "lbf", "hello"];
        assert_eq!(rows[1].iter().collect::<Vec<_>>(), second);
        assert!((chart.top() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn another_run_is_drawn_dashed_in_the_colours_of_the_first() {
        let curve = |name: &str, colour| Curve {
            name: name.into(),
            points: vec![[0.0, 1.0]],
            style: Style::Solid,
            colour,
        };
        let chart = |curves, end_x| Chart {
            kind: Kind::Tension,
            x: String::new(),
            y: String::new(),
            curves,
            levels: Vec::new(),
            end_x,
        };
        let both = chart(vec![curve("top", 0), curve("bottom", 1)], 5.0)
            .beside(chart(vec![curve("bottom", 0), curve("other", 1)], 9.0));
        let found: Vec<_> = both
            .curves
            .iter()
            .map(|curve| (curve.name.as_str(), curve.style, curve.colour))
            .collect();
        let wanted = [
            ("top", Style::Solid, 0),
            ("bottom", Style::Solid, 1),
            ("bottom (B)", Style::Dashed, 1),
            ("other (B)", Style::Dashed, 2),
        ];
        assert_eq!(found, wanted);
        assert!((both.end_x - 9.0).abs() < 1e-12);
    }
}
