//! Summaries for people: aligned columns, forces in newtons and pounds-force.
//!
//! Which figures are shown, and under which labels, is declared in [`endline_session::figures`].

use std::fmt::Write;

use endline_session::Report;
use endline_session::figures::{
    AUDIT, BALANCE, BEAT, BODY, COST, EVENT, Figure, KINETIC, LINE, LINK, PART, PATCH, PHASE,
    PROBE, Quantity, RUN, Value, View, WHALE, lines, parts, shown,
};
use endline_session::settled::{PartStrength, SettledShape};
use endline_session::units::{Units, newtons_and_lbf};
use endline_sim::metrics::WhaleSummary;

/// The scenario and the headline of its run.
pub(super) fn headline(report: &Report) -> String {
    let mut text = format!("{}\n\n", report.scenario);
    for sentence in &report.headline {
        text += &format!("{}\n", sentence.text);
    }
    text
}

/// The summary of a run: the headline, then all figures.
pub(super) fn summary(report: &Report) -> String {
    let measured = &report.summary;
    let mut text = headline(report) + "\n";
    text += &head(report);
    text += &grid(LINE, &lines(measured, &report.settled_tension_n));
    text += &grid(LINK, &measured.links);
    text += &grid(BODY, &measured.bodies);
    text += &grid(PROBE, &measured.probes);
    text += &measured.whale.as_ref().map(whale).unwrap_or_default();
    text + &grid(EVENT, &report.events)
}

/// The gear at rest.
pub(super) fn settled(shape: &SettledShape) -> String {
    let mut text = format!("{}\n\n", shape.scenario);
    text += &columns(&[
        vec!["outcome".into(), shape.outcome.clone()],
        vec!["out of balance".into(), out_of_balance(shape)],
        vec!["passes".into(), format!("{} in {:.1} ms", shape.trace_N.len(), 1e3 * shape.wall_s)],
        vec!["rope nodes".into(), shape.nodes.to_string()],
    ]);
    let mut rows = vec![row(&["line", "length", "tension at end A", "tension at end B"])];
    for line in &shape.lines {
        rows.push(vec![
            line.id.clone(),
            format!("{:.2} m", line.length_m),
            force(line.end_a_tension_N),
            force(line.end_b_tension_N),
        ]);
    }
    text += &columns(&rows);
    text += &strengths(&shape.strengths);
    let mut rows = vec![row(&["body", "east", "north", "up"])];
    rows.extend(shape.bodies.iter().map(|body| place(&body.id, body.position_m)));
    text + &columns(&rows) + &grid(PROBE, &shape.probes)
}

/// Delivered strength of each part: stated, factors, delivered.
fn strengths(parts: &[PartStrength]) -> String {
    let heads =
        ["strength of", "item", "stated", "factors", "delivered", "nine of ten", "confidence"];
    let mut rows = vec![row(&heads)];
    for part in parts {
        let [least, most] = part.nine_of_ten_N;
        rows.push(vec![
            part.part.clone(),
            part.item.clone(),
            force(part.stated.value),
            part.product(),
            force(part.delivered_N),
            format!("{least:.0} to {most:.0} N"),
            part.confidence.to_owned(),
        ]);
    }
    columns(&rows)
}

fn out_of_balance(shape: &SettledShape) -> String {
    let at = shape.worst_part.as_ref().map_or_else(String::new, |part| format!(" at {part}"));
    format!("{:.2e} N{at}", shape.residual_N)
}

fn head(report: &Report) -> String {
    let mut rows = vec![vec!["run".to_owned(), verdict(report)]];
    rows.extend(pairs(RUN, report));
    rows.extend(pairs(AUDIT, report));
    rows.extend(report.balance.iter().flat_map(|balance| pairs(BALANCE, balance)));
    let phases = [("approach", &report.timing.approach), ("contact", &report.timing.contact)];
    let mut table = vec![titles("phase", PHASE)];
    table.extend(phases.map(|(name, phase)| {
        [name.to_owned()].into_iter().chain(cells(PHASE, phase)).collect::<Vec<_>>()
    }));
    columns(&rows) + &columns(&table) + &grid(COST, &[report.timing.cost])
}

/// How the run ended, and whether its numbers can be trusted.
fn verdict(report: &Report) -> String {
    match &report.stopped {
        Some(stopped) => stopped.clone(),
        None if report.is_valid() => "ran to its end".into(),
        None => format!(
            "INVALID, ran to its end, but its numbers cannot be trusted: {}",
            report.invalid_because.join("; ")
        ),
    }
}

fn whale(whale: &WhaleSummary) -> String {
    let mut rows = vec![vec!["whale".to_owned()]];
    rows.extend(pairs(WHALE, whale));
    rows.extend(whale.beat.iter().flat_map(|beat| pairs(BEAT, beat)));
    rows.extend(whale.kinetic.iter().flat_map(|kinetic| pairs(KINETIC, kinetic)));
    let parts: Vec<_> =
        parts(whale, &[]).into_iter().filter(|part| part.summary.peak_normal_n > 0.0).collect();
    let patches: Vec<_> =
        whale.patches.iter().filter(|patch| patch.peak_normal_n > 0.0).cloned().collect();
    columns(&rows) + &grid(PART, &parts) + &grid(PATCH, &patches)
}

/// Labels and values of one source, a row for each figure.
fn pairs<S>(figures: &[Figure<S>], source: &S) -> Vec<Vec<String>> {
    let pair = |figure: &Figure<S>| {
        vec![figure.label.to_owned(), text(figure.quantity, &(figure.read)(source))]
    };
    shown(figures, View::Table).map(pair).collect()
}

/// A table with a row for each source and a column for each figure; empty without sources.
fn grid<S>(figures: &[Figure<S>], sources: &[S]) -> String {
    let head = shown(figures, View::Table).map(|figure| figure.label.to_owned()).collect();
    let rows = sources.iter().map(|source| cells(figures, source));
    columns(&[head].into_iter().chain(rows).collect::<Vec<_>>())
}

fn titles<S>(first: &str, figures: &[Figure<S>]) -> Vec<String> {
    let labels = shown(figures, View::Table).map(|figure| figure.label.to_owned());
    [first.to_owned()].into_iter().chain(labels).collect()
}

fn cells<S>(figures: &[Figure<S>], source: &S) -> Vec<String> {
    let cell = |figure: &Figure<S>| text(figure.quantity, &(figure.read)(source));
    shown(figures, View::Table).map(cell).collect()
}

/// A value in SI units; a force in pounds-force too.
fn text(quantity: Quantity, value: &Value) -> String {
    match (quantity, value) {
        (_, Value::Absent) => "none".to_owned(),
        (Quantity::Force, Value::Number(newtons)) => force(*newtons),
        (_, Value::Measured { value, unit }) => format!("{value:.4} {unit}"),
        _ => quantity.text(value, Units::Si),
    }
}

fn force(newtons: f64) -> String {
    newtons_and_lbf(newtons, 1)
}

fn place(id: &str, position_m: [f64; 3]) -> Vec<String> {
    let mut row = vec![id.to_owned()];
    row.extend(position_m.iter().map(|metres| format!("{metres:.2} m")));
    row
}

fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(ToString::to_string).collect()
}

/// Rows in aligned columns and an empty line; empty where there is only a heading of several columns.
pub(super) fn columns(rows: &[Vec<String>]) -> String {
    if rows.len() == 1 && rows[0].len() > 2 {
        return String::new();
    }
    let count = rows.iter().map(Vec::len).max().unwrap_or_default();
    let width = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column))
            .map(|cell| cell.chars().count())
            .max()
            .unwrap_or_default()
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            // Writing into a String cannot fail.
            let _ = write!(line, "{cell:<width$}  ");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text + "\n"
}

#[cfg(test)]
#[path = "../../../session/src/figures/tests/made_up.rs"]
mod made_up;

#[cfg(test)]
mod tests {
    use super::*;

    /// Each figure that the tables show stands in the text with its label and its value.
    fn stands<S>(text: &str, figures: &[Figure<S>], source: &S) -> usize {
        let check = |figure: &Figure<S>| {
            assert!(text.contains(figure.label), "no `{}` in\n{text}", figure.label);
            let value = super::text(figure.quantity, &(figure.read)(source));
            assert!(text.contains(&value), "no `{value}` of `{}` in\n{text}", figure.key);
        };
        shown(figures, View::Table).map(check).count()
    }

    #[test]
    fn every_figure_that_is_declared_for_the_tables_stands_there() {
        let report = made_up::report();
        let (text, measured) = (summary(&report), &report.summary);
        let whale = measured.whale.as_ref().unwrap();
        let mut count = stands(&text, RUN, &report) + stands(&text, AUDIT, &report);
        for phase in [&report.timing.approach, &report.timing.contact] {
            count += stands(&text, PHASE, phase);
        }
        count += stands(&text, BALANCE, report.balance.as_ref().unwrap());
        count += stands(&text, COST, &report.timing.cost);
        for line in lines(measured, &report.settled_tension_n) {
            count += stands(&text, LINE, &line);
        }
        measured.links.iter().for_each(|link| count += stands(&text, LINK, link));
        measured.bodies.iter().for_each(|body| count += stands(&text, BODY, body));
        measured.probes.iter().for_each(|probe| count += stands(&text, PROBE, probe));
        count += stands(&text, WHALE, whale);
        count += stands(&text, BEAT, whale.beat.as_ref().unwrap());
        count += stands(&text, KINETIC, whale.kinetic.as_ref().unwrap());
        for part in parts(whale, &[]) {
            count += stands(&text, PART, &part);
        }
        whale.patches.iter().for_each(|patch| count += stands(&text, PATCH, patch));
        report.events.iter().for_each(|event| count += stands(&text, EVENT, event));
        assert!(count > 200, "{count} figures");
    }

    #[test]
    fn columns_line_up_and_headings_alone_are_left_out() {
        let rows = [row(&["line", "peak", "at"]), row(&["endline-top", "2 N", "1 s"])];
        assert_eq!(columns(&rows), "line         peak  at\nendline-top  2 N   1 s\n\n");
        assert_eq!(columns(&rows[..1]), "");
    }
}
