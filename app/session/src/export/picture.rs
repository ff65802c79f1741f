//! Charts drawn one below the other, as SVG or as PNG.

use std::sync::LazyLock;

use plotters::backend::DrawingBackend;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use super::chart::{Chart, Curve, Style};

/// Width and height of one chart [px].
const SIZE: (u32, u32) = (800, 280);

/// Height of the line below that says where the charts are from [px].
const FOOT: u32 = 22;

/// Pixels of a PNG for each pixel of an SVG, so that text stays sharp in print.
const SCALE: u32 = 2;

/// Errors of drawing.
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// The charts as one SVG, with its origin below.
pub fn svg(charts: &[Chart], origin: &str) -> Result<String, String> {
    let size = size(charts, 1)?;
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
    draw(area, charts, origin, 1).map_err(|error| error.to_string())?;
    Ok(text)
}

/// The charts as one PNG of 8-bit RGB, with its origin below and in its description.
pub fn png(charts: &[Chart], origin: &str) -> Result<Vec<u8>, String> {
    let (width, height) = size(charts, SCALE)?;
    let mut pixels = vec![0; 3 * width as usize * height as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
    draw(area, charts, origin, SCALE).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder
        .add_itxt_chunk("Description".to_owned(), origin.to_owned())
        .map_err(|error| error.to_string())?;
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(&pixels).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// Size of the whole picture [px].
fn size(charts: &[Chart], scale: u32) -> Result<(u32, u32), String> {
    if charts.is_empty() {
        return Err("no plot is shown".into());
    }
    register()?;
    let count = u32::try_from(charts.len()).unwrap_or(1);
    Ok((scale * SIZE.0, scale * (SIZE.1 * count + FOOT)))
}

/// Draws the charts; taking the area by value ends the borrow of what it draws into.
fn draw<B>(whole: DrawingArea<B, Shift>, charts: &[Chart], origin: &str, scale: u32) -> Drawn
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    whole.fill(&WHITE)?;
    let (_, height) = whole.dim_in_pixel();
    let (above, foot) = whole.split_vertically(height.saturating_sub(scale * FOOT));
    let style = ("sans-serif", 11 * scale).into_font().color(&BLACK.mix(0.6));
    let at = (8 * scale.cast_signed(), 2 * scale.cast_signed());
    foot.draw_text(origin, &style, at)?;
    for (chart, area) in charts.iter().zip(above.split_evenly((charts.len(), 1))) {
        one(&area, chart, scale)?;
    }
    whole.present()?;
    Ok(())
}

/// Least and greatest value of the y axis: zero is on it, with some room beyond the curves.
fn range(chart: &Chart) -> [f64; 2] {
    let values = chart.curves.iter().flat_map(|curve| &curve.points).map(|[_, y]| *y);
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let room = 0.05 * (high - low).max(1e-9);
    [if low < 0.0 { low - room } else { 0.0 }, high + room]
}

fn one<B>(area: &DrawingArea<B, Shift>, chart: &Chart, scale: u32) -> Drawn
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    let [low, high] = range(chart);
    let label = ("sans-serif", 12 * scale);
    let mut builder = ChartBuilder::on(area);
    builder
        .caption(chart.kind.title(), ("sans-serif", 15 * scale))
        .margin(8 * scale)
        .x_label_area_size(38 * scale)
        .y_label_area_size(60 * scale);
    let mut drawn = builder.build_cartesian_2d(0.0..chart.end_x.max(1e-9), low..high)?;
    drawn
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .label_style(label)
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .draw()?;
    for curve in &chart.curves {
        draw_curve(&mut drawn, curve, scale)?;
    }
    for level in chart.levels.iter().filter(|level| level.band[0] < high) {
        for y in level.band {
            let line = RED.mix(0.6).stroke_width(scale);
            drawn.draw_series(LineSeries::new([(0.0, y), (chart.end_x, y)], line))?;
        }
    }
    drawn
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .label_font(label)
        .legend_area_size(24 * scale)
        .draw()?;
    Ok(())
}

/// The axes of a chart that is being drawn.
type Axes<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

fn draw_curve<B>(axes: &mut Axes<'_, B>, curve: &Curve, scale: u32) -> Drawn
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    let colour = colour(curve);
    let points = curve.points.iter().map(|[x, y]| (*x, *y));
    let line = colour.stroke_width(2 * scale);
    let series = match curve.style {
        Style::Solid => axes.draw_series(LineSeries::new(points, line))?,
        Style::Dashed => {
            axes.draw_series(DashedLineSeries::new(points, 6 * scale, 4 * scale, line))?
        }
        Style::Edge => {
            let thin = colour.mix(0.5).stroke_width(scale);
            axes.draw_series(LineSeries::new(points, thin))?;
            return Ok(());
        }
    };
    let length = 16 * scale.cast_signed();
    series
        .label(&curve.name)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + length, y)], line));
    Ok(())
}

fn colour(curve: &Curve) -> RGBColor {
    let [red, green, blue] = curve.rgb();
    RGBColor(red, green, blue)
}

/// Ubuntu Light, from `assets/fonts`.
static FONT: &[u8] = include_bytes!("../../../../assets/fonts/Ubuntu-Light.ttf");

/// Makes the font known as `sans-serif` to the drawing library.
pub fn register() -> Result<(), String> {
    static REGISTERED: LazyLock<bool> = LazyLock::new(|| {
        [FontStyle::Normal, FontStyle::Bold, FontStyle::Italic, FontStyle::Oblique]
            .into_iter()
            .all(|style| register_font("sans-serif", style, FONT).is_ok())
    });
    if *REGISTERED { Ok(()) } else { Err("the font of pictures cannot be read".into()) }
}

#[cfg(test)]
mod tests {
    use super::super::chart::Kind;
    use super::*;

    fn chart() -> Chart {
        let curve = |name: &str, style, colour, y: f64| Curve {
            name: name.into(),
            points: vec![[0.0, 0.0], [1.0, y]],
            style,
            colour,
        };
        Chart {
            kind: Kind::Tension,
            x: "Time [s]".into(),
            y: "lbf".into(),
            curves: vec![
                curve("endline", Style::Solid, 0, 100.0),
                curve("groundline", Style::Dashed, 1, 60.0),
            ],
            levels: Vec::new(),
            end_x: 1.0,
        }
    }

    #[test]
    fn an_svg_names_axes_and_curves() {
        let text = svg(&[chart(), chart()], "hello, Endline 1.0").unwrap();
        for part in
            ["Time [s]", "lbf", "endline", "groundline", "height=\"582\"", "hello, Endline 1.0"]
        {
            assert!(text.contains(part), "{part} is missing");
        }
        assert!(svg(&[], "").is_err());
    }

    /// Width, height and pixels of charts drawn as PNG.
    fn drawn(charts: &[Chart]) -> (u32, u32, Vec<u8>) {
        let bytes = png(charts, "hello").unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let described = &reader.info().utf8_text;
        assert!(described.iter().any(|text| text.get_text().unwrap() == "hello"));
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        (info.width, info.height, pixels)
    }

    #[test]
    fn a_png_has_the_curves_in_their_colours() {
        let (width, height, pixels) = drawn(&[chart()]);
        assert_eq!((width, height), (1600, 604));
        for curve in &chart().curves {
            let rgb = curve.rgb();
            let count = pixels.chunks_exact(3).filter(|pixel| *pixel == rgb.as_slice()).count();
            assert!(count > 500, "{}: {count} pixels", curve.name);
        }
    }

    #[test]
    fn a_png_has_text_without_a_font_of_the_system() {
        let dark = |chart: &Chart| {
            let (_, _, pixels) = drawn(std::slice::from_ref(chart));
            pixels.chunks_exact(3).filter(|pixel| pixel.iter().all(|part| *part < 128)).count()
        };
        let mut bare = chart();
        (bare.x, bare.y) = (String::new(), String::new());
        bare.curves.iter_mut().for_each(|curve| curve.name.clear());
        let (with, without) = (dark(&chart()), dark(&bare));
        assert!(with > without + 100, "labels add no dark pixels: {without} and {with}");
    }
}
