//! Plots of a case as SVG: readings over time beside the expected ones, or simulated over measured.

use endline_session::cases::{Curve, Outcome, Point};
use endline_session::export::picture;
use endline_session::scales::SERIES_ON_WHITE;
use plotters::coord::Shift;
use plotters::prelude::*;

/// Size of one panel [px].
const PANEL: (u32, u32) = (720, 300);
/// Colours of series, again and again.
fn colours() -> impl Iterator<Item = RGBColor> {
    SERIES_ON_WHITE.into_iter().cycle().map(|[red, green, blue]| RGBColor(red, green, blue))
}

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The plot of a case; `None` where it has no curve and no pairs.
pub(super) fn picture(outcome: &Outcome) -> Result<Option<String>, String> {
    let units = units(&outcome.curves);
    let panels = units.len() + usize::from(!outcome.points.is_empty());
    if panels == 0 {
        return Ok(None);
    }
    picture::register()?;
    let mut text = String::new();
    {
        let height = PANEL.1 * u32::try_from(panels).unwrap_or(1);
        let whole = SVGBackend::with_string(&mut text, (PANEL.0, height)).into_drawing_area();
        whole.fill(&WHITE).map_err(|error| error.to_string())?;
        let areas = whole.split_evenly((panels, 1));
        for (unit, area) in units.iter().zip(&areas) {
            let own: Vec<&Curve> =
                outcome.curves.iter().filter(|curve| curve.unit == *unit).collect();
            over_time(area, unit, &own).map_err(|error| error.to_string())?;
        }
        if let (false, Some(area)) = (outcome.points.is_empty(), areas.last()) {
            measured(area, &outcome.points).map_err(|error| error.to_string())?;
        }
        whole.present().map_err(|error| error.to_string())?;
    }
    Ok(Some(text))
}

/// Units of the curves, each once: a panel for each.
fn units(curves: &[Curve]) -> Vec<&'static str> {
    let mut units = Vec::new();
    for curve in curves {
        if !units.contains(&curve.unit) {
            units.push(curve.unit);
        }
    }
    units
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Simulated as lines, expected as circles.
fn over_time(area: &Panel<'_>, unit: &str, curves: &[&Curve]) -> Drawn {
    let times = range(curves.iter().flat_map(|curve| curve.times_s.iter().copied()), 0.0);
    let expected = |curve: &&Curve| curve.expected.iter().map(|point| point[1]).collect::<Vec<_>>();
    let readings = range(
        curves.iter().flat_map(|curve| curve.got.iter().copied().chain(expected(curve))),
        0.05,
    );
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(45)
        .y_label_area_size(60)
        .build_cartesian_2d(times, readings)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("time [s]")
        .y_desc(format!("[{unit}]"))
        .draw()?;
    for (curve, colour) in curves.iter().zip(colours()) {
        let line = curve.times_s.iter().copied().zip(curve.got.iter().copied());
        let drawn = chart.draw_series(LineSeries::new(line, colour))?;
        drawn
            .label(&curve.probe)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour));
        chart.draw_series(
            curve.expected.iter().map(|point| Circle::new((point[0], point[1]), 3, colour)),
        )?;
    }
    chart
        .configure_series_labels()
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}

/// Simulated over measured, with the line on which they agree.
fn measured(area: &Panel<'_>, points: &[Point]) -> Drawn {
    let span = range(points.iter().flat_map(|point| [point.measured, point.got, 0.0]), 0.02);
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(45)
        .y_label_area_size(60)
        .build_cartesian_2d(span.clone(), span.clone())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("measured [N]")
        .y_desc("simulated [N]")
        .draw()?;
    chart.draw_series(LineSeries::new(
        [(span.start, span.start), (span.end, span.end)],
        BLACK.mix(0.4),
    ))?;
    let mut groups: Vec<&str> = Vec::new();
    for point in points {
        if !groups.contains(&point.group.as_str()) {
            groups.push(&point.group);
        }
    }
    for (group, colour) in groups.iter().zip(colours()) {
        let own = points.iter().filter(|point| point.group == *group);
        let drawn = chart.draw_series(
            own.map(|point| Circle::new((point.measured, point.got), 3, colour.filled())),
        )?;
        drawn.label(*group).legend(move |(x, y)| Circle::new((x + 8, y), 3, colour.filled()));
    }
    chart
        .configure_series_labels()
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .position(SeriesLabelPosition::LowerRight)
        .draw()?;
    Ok(())
}

/// From least to greatest, with a margin as a share of it; never empty.
fn range(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let (least, most) = values
        .filter(|value| value.is_finite())
        .fold((f64::MAX, f64::MIN), |(least, most), value| (least.min(value), most.max(value)));
    if least > most {
        return 0.0..1.0;
    }
    let room = (margin * (most - least)).max(1e-9 * most.abs()).max(1e-9);
    least - room..most + room
}
