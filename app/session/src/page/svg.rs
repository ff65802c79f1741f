//! Pictures as SVG text: lines, marks of several shapes, dashes and words, so that none needs colour to be read.

use std::fmt::Write;

use crate::scales::{self, SERIES_ON_WHITE};

/// Dashes of lines, in the order of the colours.
const DASHES: [&str; 6] = ["none", "7 3", "2 3", "10 3 2 3", "4 2", "1 2"];

/// A picture being drawn.
pub(crate) struct Svg {
    body: String,
    width: f64,
    height: f64,
    title: String,
}

/// Where text stands beside its place.
#[derive(Clone, Copy)]
pub(crate) enum Side {
    Start,
    Middle,
    End,
}

impl Svg {
    pub(crate) fn new(width: f64, height: f64, title: &str) -> Self {
        Self { body: String::new(), width, height, title: escape(title) }
    }

    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], class: &str) {
        let _ = write!(
            self.body,
            r#"<line class="{class}" x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}"/>"#,
            from[0], from[1], to[0], to[1]
        );
    }

    pub(crate) fn text(&mut self, at: [f64; 2], side: Side, text: &str) {
        let anchor = match side {
            Side::Start => "start",
            Side::Middle => "middle",
            Side::End => "end",
        };
        self.text_with(at, &format!(r#"text-anchor="{anchor}""#), text);
    }

    /// Text that heads what follows.
    pub(crate) fn heading(&mut self, at: [f64; 2], text: &str) {
        self.text_with(at, r#"font-weight="600""#, text);
    }

    fn text_with(&mut self, [x, y]: [f64; 2], attribute: &str, text: &str) {
        let text = escape(text);
        let _ = write!(self.body, r#"<text x="{x:.1}" y="{y:.1}" {attribute}>{text}</text>"#);
    }

    /// A filled box.
    pub(crate) fn bar(&mut self, from: [f64; 2], size: [f64; 2], colour: usize) {
        let fill = colour_of(colour);
        let _ = write!(
            self.body,
            r#"<rect x="{:.1}" y="{:.1}" width="{:.1}" height="{:.1}" fill="{fill}" fill-opacity="0.35" stroke="{fill}"/>"#,
            from[0], from[1], size[0], size[1]
        );
    }

    /// A mark whose shape and colour go by a number: disc, square, triangle, diamond.
    pub(crate) fn mark(&mut self, [x, y]: [f64; 2], kind: usize) {
        let fill = colour_of(kind);
        let _ = match kind % 4 {
            0 => write!(self.body, r#"<circle cx="{x:.1}" cy="{y:.1}" r="4.5" fill="{fill}"/>"#),
            1 => write!(
                self.body,
                r#"<rect x="{:.1}" y="{:.1}" width="8" height="8" fill="{fill}"/>"#,
                x - 4.0,
                y - 4.0
            ),
            2 => write!(self.body, r#"<path d="M{x:.1} {:.1}l5 9h-10z" fill="{fill}"/>"#, y - 6.0),
            _ => write!(
                self.body,
                r#"<path d="M{x:.1} {:.1}l5.5 5.5l-5.5 5.5l-5.5-5.5z" fill="{fill}"/>"#,
                y - 5.5
            ),
        };
    }

    /// An interval with its value.
    pub(crate) fn whisker(&mut self, y: f64, [low, at, high]: [f64; 3], kind: usize) {
        let stroke = colour_of(kind);
        let _ = write!(
            self.body,
            r#"<path d="M{low:.1} {y:.1}H{high:.1}M{low:.1} {:.1}v6M{high:.1} {:.1}v6" stroke="{stroke}" stroke-width="1.6" fill="none"/>"#,
            y - 3.0,
            y - 3.0
        );
        self.mark([at, y], kind);
    }

    /// An interval that stands upright, with its value.
    pub(crate) fn post(&mut self, x: f64, [low, at, high]: [f64; 3], kind: usize) {
        let stroke = colour_of(kind);
        let _ = write!(
            self.body,
            r#"<path d="M{x:.1} {low:.1}V{high:.1}M{:.1} {low:.1}h6M{:.1} {high:.1}h6" stroke="{stroke}" stroke-width="1.6" fill="none"/>"#,
            x - 3.0,
            x - 3.0
        );
        self.mark([x, at], kind);
    }

    /// A line through points, its dashes by a number.
    pub(crate) fn path(&mut self, points: &[[f64; 2]], kind: usize) {
        let mut data = String::new();
        for (index, [x, y]) in points.iter().enumerate() {
            let _ = write!(data, "{}{x:.1} {y:.1}", if index == 0 { "M" } else { "L" });
        }
        let (stroke, dashes) = (colour_of(kind), DASHES[kind % DASHES.len()]);
        let _ = write!(
            self.body,
            r#"<path d="{data}" stroke="{stroke}" stroke-dasharray="{dashes}" stroke-width="1.8" fill="none"/>"#
        );
    }

    /// A pale area inside points, in the colour of a number.
    pub(crate) fn area(&mut self, points: &[[f64; 2]], kind: usize) {
        let mut data = String::new();
        for [x, y] in points {
            let _ = write!(data, "{x:.1},{y:.1} ");
        }
        let fill = colour_of(kind);
        let _ = write!(
            self.body,
            r#"<polygon points="{}" fill="{fill}" fill-opacity="0.14"/>"#,
            data.trim_end()
        );
    }

    /// The picture's text.
    pub(crate) fn done(self) -> String {
        let Self { body, width, height, title } = self;
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" aria-label="{title}"><title>{title}</title>{body}</svg>"#
        )
    }
}

/// A finished picture as a file of its own: with its style, on white.
pub(crate) fn standalone(picture: String) -> String {
    let style = "<style>svg{font:12px system-ui,sans-serif;background:#fff}.grid{stroke:#ddd}.zero{stroke:#333;stroke-width:1.5}</style>";
    picture.replacen("<title>", &format!("{style}<title>"), 1) + "\n"
}

/// The colour of a series by its number.
fn colour_of(series: usize) -> String {
    scales::hex(SERIES_ON_WHITE[series % SERIES_ON_WHITE.len()])
}

/// Text as HTML and SVG want it.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// An axis: values to places.
#[derive(Clone, Copy)]
pub(crate) struct Axis {
    pub values: [f64; 2],
    pub places: [f64; 2],
}

impl Axis {
    /// The place of a value, kept within the axis.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let [least, most] = self.values;
        let share = ((value - least) / (most - least)).clamp(0.0, 1.0);
        self.places[0] + share * (self.places[1] - self.places[0])
    }

    /// Round values along it, about five.
    pub(crate) fn ticks(&self) -> Vec<f64> {
        let [least, most] = self.values;
        scales::ticks(least, most, 5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_break_the_page() {
        let mut svg = Svg::new(10.0, 10.0, "a<b");
        svg.text([0.0, 0.0], Side::Start, "<script>\"&");
        let text = svg.done();
        assert!(
            !text.contains("<script>")
                && text.contains("&lt;script&gt;&quot;&amp;")
                && text.contains("a&lt;b"),
            "{text}"
        );
    }
}
