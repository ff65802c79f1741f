//! Charts of results: a forest plot of differences from the baseline, bands of each rate, and a tornado chart of input effects.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Stroke, Ui, pos2, vec2};
use endline_session::scales::{SERIES, ticks};
use endline_session::study::StudyResults;
use endline_session::study::stats::{Bands, Findings, Interval, Paired};

use super::rates::{points, rate};
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;

/// Height of a row [points].
const ROW: f32 = 26.0;
/// Height of the axis above the rows [points].
const HEAD: f32 = 20.0;
/// Least width for names at the left [points], and greatest as a share of the whole width.
const NAMES: (f32, f32) = (120.0, 0.42);

/// Font size of names and numbers [points].
const NAME_FONT: FontId = FontId::proportional(12.5);

/// A chart being drawn: rows between two axes of values, so that one is visible wherever the chart is scrolled.
struct Figure {
    painter: Painter,
    rect: Rect,
    /// Width for names at the left.
    names: f32,
    values: [f64; 2],
    palette: Palette,
}

impl Figure {
    /// Allocates the rows of these names, with an axis above and below.
    fn new(ui: &mut Ui, names: &[String], each: usize, values: [f64; 2]) -> Self {
        let rows = each * names.len();
        let size = vec2(ui.available_width().max(420.0), HEAD + ROW * rows as f32 + 34.0);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let (painter, palette) = (ui.painter_at(rect), Theme::palette_of(ui));
        let (least, share) = NAMES;
        let width = |name: &String| {
            painter.layout_no_wrap(name.clone(), NAME_FONT, palette.text).size().x + 16.0
        };
        let names = names.iter().map(width).fold(least, f32::max).min(share * rect.width());
        Self { painter, rect, names, values, palette }
    }

    fn x(&self, value: f64) -> f32 {
        let [least, most] = self.values;
        let share = ((value - least) / (most - least)).clamp(0.0, 1.0) as f32;
        self.rect.left() + self.names + share * (self.rect.width() - self.names - 24.0)
    }

    fn y(&self, row: usize) -> f32 {
        self.rect.top() + HEAD + ROW * (row as f32 + 0.5)
    }

    fn text(&self, at: Pos2, align: Align2, text: &str, colour: Color32) -> Rect {
        self.painter.text(at, align, text, NAME_FONT, colour)
    }

    fn name(&self, row: usize, name: &str, colour: Color32) {
        let galley = self.painter.layout(name.to_owned(), NAME_FONT, colour, self.names - 12.0);
        let first = galley.rows.first().map_or(0.0, |row| row.height());
        let clipped = self.painter.with_clip_rect(Rect::from_min_size(
            pos2(self.rect.left(), self.y(row) - first / 2.0),
            vec2(self.names, first),
        ));
        clipped.galley(pos2(self.rect.left() + 2.0, self.y(row) - first / 2.0), galley, colour);
    }

    fn axis(&self, words: impl Fn(f64) -> String) {
        let (top, bottom) = (self.rect.top() + HEAD, self.rect.bottom() - 30.0);
        let [least, most] = self.values;
        for tick in ticks(least, most, 5) {
            let x = self.x(tick);
            self.painter
                .line_segment([pos2(x, top), pos2(x, bottom)], Stroke::new(1.0, self.palette.line));
            let (words, colour) = (words(tick), self.palette.faint);
            self.text(pos2(x, bottom + 6.0), Align2::CENTER_TOP, &words, colour);
            self.text(pos2(x, top - 4.0), Align2::CENTER_BOTTOM, &words, colour);
        }
    }

    /// Draws the line of no difference.
    fn zero(&self) {
        let (x, bottom) = (self.x(0.0), self.rect.bottom() - 30.0);
        let line = [pos2(x, self.rect.top() + HEAD), pos2(x, bottom)];
        self.painter.line_segment(line, Stroke::new(1.0, self.palette.faint));
    }

    fn hover(&self, ui: &Ui, row: usize, text: &str) {
        let strip = Rect::from_min_max(
            pos2(self.rect.left(), self.y(row) - ROW / 2.0),
            pos2(self.rect.right(), self.y(row) + ROW / 2.0),
        );
        ui.interact(strip, ui.id().with(("row", self.rect.top().to_bits(), row)), Sense::hover())
            .on_hover_text(text);
    }
}

/// Name of an option, its difference from the baseline, and the interval.
type Difference = (String, f64, Interval);

/// Rows under a heading: of all encounters, or of one level.
type Group = (String, Vec<Difference>);

/// Draws differences from the baseline: of all encounters, then by level.
pub(super) fn forest(ui: &mut Ui, shown: &StudyResults, event: &str) {
    let findings = &shown.findings;
    let groups = groups(findings, event);
    let baseline = &findings.options[findings.baseline];
    let words = baseline.rate(event).map_or_else(String::new, rate);
    ui.label(format!(
        "Difference of rates from {} ({words}), in percentage points: negative is rarer",
        baseline.name
    ));
    let ends = groups.iter().flat_map(|(_, rows)| rows);
    let ends = ends.map(|(_, _, interval)| interval.low.abs().max(interval.high.abs()));
    let widest = ends.fold(0.02, f64::max);
    let names: Vec<String> = groups
        .iter()
        .flat_map(|(name, rows)| {
            let options = rows.iter().map(|(option, ..)| format!("   {option}"));
            std::iter::once(name.clone()).chain(options)
        })
        .collect();
    let figure = Figure::new(ui, &names, 1, [-widest, widest]);
    figure.axis(|tick| match 100.0 * tick {
        points if points.abs() < 1e-6 => "0".to_owned(),
        points => format!("{points:+.*}", usize::from(widest < 0.1)),
    });
    figure.zero();
    let mut row = 0;
    for (kind, (name, rows)) in groups.iter().enumerate() {
        figure.name(row, &names[row], figure.palette.faint);
        row += 1;
        for (option, difference, interval) in rows {
            figure.name(row, &names[row], figure.palette.text);
            whisker(&figure, row, [interval.low, *difference, interval.high], kind);
            let points = points(*difference, *interval);
            figure.hover(ui, row, &format!("{option}, {name}: {points} points"));
            row += 1;
        }
    }
}

/// Options other than the baseline: in all encounters, then by level for the event of the study.
fn groups(findings: &Findings, event: &str) -> Vec<Group> {
    let others = || (0..findings.options.len()).filter(|index| *index != findings.baseline);
    let row = |index: usize, paired: &Paired| {
        let name = findings.options[index].name.clone();
        (name, paired.difference, paired.difference_interval)
    };
    let all = others()
        .filter_map(|index| Some(row(index, findings.options[index].against(event)?)))
        .collect();
    let levels = findings.levels.iter().filter(|_| event == findings.event);
    let levels = levels.map(|level| {
        let rows = others().filter_map(|index| Some(row(index, level.against.get(index)?)));
        (level.level.clone(), rows.collect())
    });
    std::iter::once(("all encounters".to_owned(), all)).chain(levels).collect()
}

/// Draws an interval with its value; each group has its own mark.
fn whisker(figure: &Figure, row: usize, [low, at, high]: [f64; 3], kind: usize) {
    let [red, green, blue] = SERIES[kind % SERIES.len()];
    let colour = Color32::from_rgb(red, green, blue);
    let (y, stroke) = (figure.y(row), Stroke::new(1.6, colour));
    let [low, at, high] = [low, at, high].map(|value| figure.x(value));
    figure.painter.line_segment([pos2(low, y), pos2(high, y)], stroke);
    for end in [low, high] {
        figure.painter.line_segment([pos2(end, y - 3.5), pos2(end, y + 3.5)], stroke);
    }
    if kind.is_multiple_of(2) {
        figure.painter.circle_filled(pos2(at, y), 4.5, colour);
    } else {
        figure.painter.rect_filled(
            Rect::from_center_size(pos2(at, y), vec2(8.0, 8.0)),
            0.0,
            colour,
        );
    }
}

/// Draws the uncertainty of the rate of a registered event: bands of chance, assumed inputs, and discretization for each option.
pub(super) fn bands(ui: &mut Ui, shown: &StudyResults, event: &str) {
    let own = |bands: &&Bands| bands.event == event;
    let found: Vec<&Bands> = shown.findings.bands.iter().filter(own).collect();
    if found.is_empty() {
        let none = "Bands exist only for registered events. Select one, or add this event to `registered` in the study before its first run.";
        return widgets::nothing(ui, none);
    }
    let rows: Vec<Vec<(&str, [f64; 3], String)>> =
        found.iter().map(|bands| band_rows(bands)).collect();
    ui.label(causes(rows.iter().flatten().map(|(cause, ..)| *cause)));
    let ends = rows.iter().flatten().map(|(_, [.., high], _)| *high);
    let most = ends.fold(0.02, f64::max);
    let names: Vec<String> = found
        .iter()
        .zip(&rows)
        .flat_map(|(bands, own)| {
            let kinds = own.iter().map(|(kind, ..)| format!("   {kind}"));
            std::iter::once(bands.name.clone()).chain(kinds)
        })
        .collect();
    let figure = Figure::new(ui, &names, 1, [0.0, most]);
    figure.axis(|tick| format!("{:.*} %", usize::from(most < 0.1), 100.0 * tick));
    let mut row = 0;
    for (bands, own) in found.iter().zip(rows) {
        figure.name(row, &names[row], figure.palette.text);
        row += 1;
        for (kind, (name, ends, text)) in own.into_iter().enumerate() {
            figure.name(row, &names[row], figure.palette.faint);
            whisker(&figure, row, ends, kind);
            figure.hover(ui, row, &format!("{}, {name}: {text}", bands.name));
            row += 1;
        }
    }
}

/// The causes of uncertainty that are drawn, in a sentence.
fn causes(drawn: impl Iterator<Item = &'static str>) -> String {
    let mut names: Vec<&str> = Vec::new();
    for name in drawn {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let Some((last, others)) = names.split_last() else { return String::new() };
    let (count, named) = match others {
        [] => ("one cause", (*last).to_owned()),
        others => {
            let count = if others.len() == 1 { "two causes" } else { "three causes" };
            (count, format!("{} and {last}", others.join(", ")))
        }
    };
    format!(
        "Rate of the event with its uncertainty by {count}: {named}. More encounters narrow only that by chance."
    )
}

/// Why no effect of an input is known.
fn no_effects(priors: usize, encounters: u64) -> String {
    match (priors, encounters) {
        (0, _) => "This study draws no values: all of its encounters are alike.".to_owned(),
        (_, 0) => "No encounter has been run yet.".to_owned(),
        (_, 1) => {
            "One encounter cannot show the effect of an input. Run more encounters.".to_owned()
        }
        (_, count) => format!(
            "No input has two different values in these {count} encounters. Run more encounters."
        ),
    }
}

/// Bands of an option: name; least, rate and greatest; text on hover.
fn band_rows(bands: &Bands) -> Vec<(&'static str, [f64; 3], String)> {
    let (at, Interval { low, high }) = (bands.rate.rate, bands.rate.interval);
    let mut rows = vec![("chance", [low, at, high], rate(&bands.rate))];
    if let Some(band) = &bands.assumed {
        let text = format!(
            "{}, least with {}, greatest with {}; levels at random spread it over {}",
            band.rates().percents(),
            band.least_at,
            band.greatest_at,
            band.by_chance.percents()
        );
        rows.push(("assumed inputs", [band.least, at, band.greatest], text));
    }
    if let Some(band) = &bands.segments {
        let text = format!("{}; {}", band.rate.percents(), band.source);
        rows.push(("segments and steps", [band.rate.low, at, band.rate.high], text));
    }
    rows
}

/// Draws least and greatest rate over the parts of each input, largest effect first.
pub(super) fn tornado(ui: &mut Ui, shown: &StudyResults) {
    let findings = &shown.findings;
    if findings.inputs.is_empty() {
        let priors = shown.opened.study.priors.len();
        return widgets::nothing(ui, &no_effects(priors, findings.encounters));
    }
    let most = findings
        .inputs
        .iter()
        .flat_map(|input| &input.parts)
        .map(|part| part.rate.rate)
        .fold(0.02, f64::max);
    let words = endline_gear::StudyEvent::find(&findings.event)
        .map_or_else(|| findings.event.clone(), |event| event.words());
    ui.label(format!(
        "Rate of \"{words}\" with the baseline, for parts of the range of each input"
    ));
    let names: Vec<String> =
        findings.inputs.iter().map(|input| input.name.replace('_', " ")).collect();
    let figure = Figure::new(ui, &names, 2, [0.0, 1.15 * most]);
    figure.axis(|tick| format!("{:.*} %", usize::from(most < 0.1), 100.0 * tick));
    for (index, input) in findings.inputs.iter().enumerate() {
        let mut parts: Vec<_> = input.parts.iter().filter(|part| part.rate.runs > 0).collect();
        parts.sort_by(|one, other| one.rate.rate.total_cmp(&other.rate.rate));
        let (Some(least), Some(most)) = (parts.first(), parts.last()) else { continue };
        let (row, [red, green, blue]) = (2 * index, SERIES[0]);
        let (from, to, y) = (figure.x(least.rate.rate), figure.x(most.rate.rate), figure.y(row));
        let bar = Rect::from_min_max(pos2(from, y - 7.0), pos2(to.max(from + 1.0), y + 7.0));
        figure.painter.rect(
            bar,
            2.0,
            Color32::from_rgb(red, green, blue).gamma_multiply(0.45),
            Stroke::new(1.0, Color32::from_rgb(red, green, blue)),
            egui::StrokeKind::Inside,
        );
        let mark = if input.same_best { "" } else { "  (another option is best)" };
        figure.name(row, &names[index], figure.palette.text);
        let below = figure.y(row + 1) - 6.0;
        let left =
            figure.text(pos2(from, below), Align2::RIGHT_CENTER, &least.name, figure.palette.faint);
        let right = (to).max(left.right() + 8.0);
        figure.text(
            pos2(right, below),
            Align2::LEFT_CENTER,
            &format!("{}{mark}", most.name),
            figure.palette.faint,
        );
        let text: Vec<String> =
            parts.iter().map(|part| format!("{}: {}", part.name, rate(&part.rate))).collect();
        let best = if input.same_best {
            "The same option has the lowest rate in every part."
        } else {
            "Which option has the lowest rate depends on this input."
        };
        figure.hover(ui, row, &format!("{}\n{best}", text.join("\n")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_causes_named_are_those_drawn() {
        let of = |names: &[&'static str]| causes(names.iter().copied());
        assert!(of(&["chance", "chance"]).contains("by one cause: chance. More"));
        let two = of(&["chance", "assumed inputs", "chance"]);
        assert!(two.contains("by two causes: chance and assumed inputs."), "{two}");
        let three = of(&["chance", "assumed inputs", "segments and steps"]);
        assert!(three.contains("three causes: chance, assumed inputs and segments"), "{three}");
    }

    #[test]
    fn missing_effects_of_inputs_have_the_true_reason() {
        assert!(no_effects(0, 9).contains("draws no values"));
        assert!(no_effects(10, 1).contains("Run more encounters"));
        assert!(no_effects(10, 0).contains("No encounter"));
    }
}
