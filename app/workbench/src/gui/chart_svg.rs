//! Charts as SVG, one below the other, for papers and reports.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::charts::{Chart, Style};

/// Size of one chart [px].
const SIZE: (u32, u32) = (800, 280);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The charts as one SVG.
///
/// # Errors
/// Where there is nothing to draw, or the drawing fails.
pub fn svg(charts: &[Chart]) -> Result<String, String> {
    if charts.is_empty() {
        return Err("no plot is shown".into());
    }
    let mut text = String::new();
    {
        let height = SIZE.1 * u32::try_from(charts.len()).unwrap_or(1);
        let whole = SVGBackend::with_string(&mut text, (SIZE.0, height)).into_drawing_area();
        whole.fill(&WHITE).map_err(|error| error.to_string())?;
        for (chart, area) in charts.iter().zip(whole.split_evenly((charts.len(), 1))) {
            one(&area, chart).map_err(|error| error.to_string())?;
        }
        whole.present().map_err(|error| error.to_string())?;
    }
    Ok(text)
}

fn one(area: &Area<'_>, chart: &Chart) -> Result<(), Box<dyn std::error::Error>> {
    let values = chart
        .curves
        .iter()
        .flat_map(|curve| &curve.points)
        .map(|point| point.y)
        .filter(|value| value.is_finite());
    let (low, high) =
        values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let room = 0.05 * (high - low).max(1e-9);
    let (low, high) = (if low < 0.0 { low - room } else { 0.0 }, high + room);
    let mut builder = ChartBuilder::on(area);
    builder
        .caption(chart.kind.title(), ("sans-serif", 15))
        .margin(8)
        .x_label_area_size(38)
        .y_label_area_size(60);
    let mut drawn = builder.build_cartesian_2d(0.0..chart.end_x.max(1e-9), low..high)?;
    drawn
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .draw()?;
    for curve in &chart.curves {
        let [red, green, blue] = curve.rgb();
        let colour = RGBColor(red, green, blue);
        let points = curve.points.iter().map(|point| (point.x, point.y));
        let series = match curve.style {
            Style::Solid => drawn.draw_series(LineSeries::new(points, colour.stroke_width(2)))?,
            Style::Dashed => {
                drawn.draw_series(DashedLineSeries::new(points, 6, 4, colour.stroke_width(2)))?
            }
            Style::Edge => {
                drawn.draw_series(LineSeries::new(points, colour.mix(0.5)))?;
                continue;
            }
        };
        series
            .label(&curve.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    for level in chart.levels.iter().filter(|level| level.band[0] < high) {
        for y in level.band {
            drawn.draw_series(LineSeries::new([(0.0, y), (chart.end_x, y)], RED.mix(0.6)))?;
        }
    }
    drawn
        .configure_series_labels()
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}
