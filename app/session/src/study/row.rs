//! The row of a run: the figures that declare a column, and the values drawn for the encounter.

use endline_sdk::BodyPart;
use endline_sim::metrics::Outcome;

use crate::figures::{ATTEMPT, AUDIT, Attempt, Figure, PART, Quantity, RUN, Value, WHALE, parts};
use crate::report::Report;

use super::exposure::Crossing;
use super::plan::OptionPlan;
use super::prepared::PreparedStudy;
use crate::encounters::Encounter;
use crate::table::{Cell, Row};

/// Place of the columns of the whale's parts among the others.
const PARTS: u16 = 200;

/// A column: its place, name and value. Columns of parts are in the order of the parts.
type Placed = ([u16; 3], String, Cell);

/// The row of an option in an encounter; `Err` says why there was no run.
pub(super) fn row(
    opened: &PreparedStudy,
    option: usize,
    encounter: &Encounter,
    came_to: Result<&Report, &str>,
) -> Row {
    let id = &opened.options[option].id;
    let attempt = Attempt {
        encounter: encounter.index,
        option: id.clone(),
        weight: encounter.weight,
        replay_key: format!("{}/{}/{id}", &opened.hash[..16], encounter.index),
        until_parted: opened.options[option].until_parted,
        fault: came_to.map_or_else(str::to_owned, Report::fault),
    };
    let mut row = cells(&attempt, came_to.ok());
    if attempt.until_parted && came_to.is_ok_and(|report| report.first_parted().is_some()) {
        end_at_parting(&mut row);
    }
    for drawn in &encounter.drawn {
        let cell = drawn
            .number
            .map_or_else(|| Cell::Text(drawn.text.clone()), |number| Cell::Real(Some(number)));
        row.push((format!("drawn_{}", drawn.name), cell));
    }
    row
}

/// Columns of a row in a study with `[exposure]`.
pub(super) const SWUM_M: &str = "swum_m";
pub(super) const SWUM_S: &str = "swum_s";
pub(super) const MEETINGS: &str = "meetings";

/// Adds what the whale met on its track; a row without a meeting counts as a run without contact.
pub(super) fn add_track(row: &mut Row, track: Option<&Crossing>, option: &OptionPlan) {
    if track.is_some_and(|track| track.met.is_none()) {
        for (name, cell) in row.iter_mut() {
            match name.as_str() {
                "outcome" => *cell = Cell::Text(Outcome::NoContact.name().to_owned()),
                "valid" | "decided" => *cell = Cell::Flag(true),
                _ => {}
            }
        }
    }
    let met = track.and_then(|track| option.places.get(track.met.as_ref()?.gear));
    let meetings = track.map_or(0, |track| i64::try_from(track.meetings).unwrap_or(i64::MAX));
    row.extend([
        (SWUM_M.to_owned(), Cell::Real(track.map(|track| track.way_m))),
        (SWUM_S.to_owned(), Cell::Real(track.map(|track| track.time_s))),
        (MEETINGS.to_owned(), Cell::Whole(meetings)),
        ("met_gear".to_owned(), Cell::Text(met.map_or_else(String::new, |met| met.id.clone()))),
    ]);
}

/// Replaces the outcome of a run that ended where something parted.
fn end_at_parting(row: &mut Row) {
    for (name, cell) in row {
        match name.as_str() {
            "outcome" => *cell = Cell::Text("parted".to_owned()),
            "decided" => *cell = Cell::Flag(false),
            _ => {}
        }
    }
}

/// Every figure with a column, in the order of the columns' places.
fn cells(attempt: &Attempt, report: Option<&Report>) -> Row {
    let whale = report.and_then(|report| report.summary.whale.as_ref());
    let parts = whale.map(|whale| parts(whale, &[])).unwrap_or_default();
    let mut columns: Vec<Placed> = placed(ATTEMPT, Some(attempt))
        .chain(placed(RUN, report))
        .chain(placed(AUDIT, report))
        .chain(placed(WHALE, whale))
        .collect();
    for part in BodyPart::ALL {
        let own = parts.iter().find(|own| own.summary.part == part);
        columns.extend(placed(PART, own).map(|([place, ..], name, cell)| {
            ([PARTS, part as u16, place], format!("{}_{name}", part.name()), cell)
        }));
    }
    columns.sort_by_key(|(place, ..)| *place);
    columns.into_iter().map(|(_, name, cell)| (name, cell)).collect()
}

/// The figures of a list that have a column.
fn placed<S>(figures: &'static [Figure<S>], source: Option<&S>) -> impl Iterator<Item = Placed> {
    let column = move |figure: &Figure<S>| {
        let column = figure.column?;
        let value = source.map_or(Value::Absent, |source| (figure.read)(source));
        Some(([column.place, 0, 0], column.name.to_owned(), cell(figure.quantity, value)))
    };
    figures.iter().filter_map(column)
}

/// A value as a cell. A column has cells of one kind, so that what is absent has a cell too.
fn cell(quantity: Quantity, value: Value) -> Cell {
    match (value, quantity) {
        (Value::Number(number), _) => Cell::Real(Some(number)),
        (Value::Whole(count), _) => Cell::Whole(i64::try_from(count).unwrap_or(i64::MAX)),
        (Value::Flag(flag), _) => Cell::Flag(flag),
        (Value::Text(text), _) => Cell::Text(text),
        (_, Quantity::Count) => Cell::Whole(0),
        (_, Quantity::Flag) => Cell::Flag(false),
        (_, Quantity::Name) => Cell::Text("none".to_owned()),
        (_, Quantity::Id) => Cell::Text(String::new()),
        _ => Cell::Real(None),
    }
}

#[cfg(test)]
mod tests {
    use std::mem::discriminant;

    use super::*;
    use crate::figures::tests::made_up;
    use crate::study::runs::Runs;
    use crate::table::{Table, parquet};

    /// The columns of `table.parquet` before those of what was drawn; scripts depend on them.
    const COLUMNS: &str = "encounter option replay_key weight until_parted valid fault tunnelled unconverged simulated_s \
        state_hash outcome decided first_contact_s last_contact_s contact_time_s drag_added_N \
        trailing_m tethered_m was_lodged_in_mouth was_body_caught peak_body_push_N lodged_in_mouth speed_made_good_m_s unchanged_s carried_traps carried_buoys \
        rope_on_head rope_on_flipper rope_on_tail wraps_present constricting trailing anchored PARTS peak_tension_N peak_line peak_at_s \
        link_peak_N parted parted_at_s resolution_looks resolution_missed needed_rope_N needed_link_N needed_place_N";

    /// The columns of each part of the whale.
    const OF_PART: [&str; 6] =
        ["wraps", "peak_wraps", "contact_m", "peak_contact_m", "peak_normal_N", "peak_pressure_Pa"];

    fn attempt() -> Attempt {
        Attempt {
            encounter: 7,
            option: "link-0600".into(),
            weight: 1.0,
            replay_key: "0123/7/link-0600".into(),
            until_parted: true,
            fault: "a fault".into(),
        }
    }

    fn names() -> Vec<String> {
        let part = |part: BodyPart| OF_PART.map(|name| format!("{}_{name}", part.name()));
        let column = |name: &str| match name {
            "PARTS" => BodyPart::ALL.into_iter().flat_map(part).collect(),
            name => vec![name.to_owned()],
        };
        COLUMNS.split_whitespace().flat_map(column).collect()
    }

    /// Checks that every figure of a list with a column is in a row under the column's name.
    fn check_list<S>(row: &Row, figures: &[Figure<S>], source: &S, before: &str) -> usize {
        let with_column = figures.iter().filter_map(|figure| Some((figure, figure.column?)));
        let check = |(figure, column): (&Figure<S>, crate::figures::Column)| {
            let name = format!("{before}{}", column.name);
            let found = row.iter().find(|(known, _)| *known == name).map(|(_, cell)| cell);
            assert_eq!(found, Some(&cell(figure.quantity, (figure.read)(source))), "{name}");
        };
        with_column.map(check).count()
    }

    #[test]
    fn a_row_has_every_column_in_order_with_the_value_of_its_figure() {
        let report = made_up::report();
        let whale = report.summary.whale.as_ref().unwrap();
        let row = cells(&attempt(), Some(&report));
        assert_eq!(row.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>(), names());
        let mut count = check_list(&row, ATTEMPT, &attempt(), "");
        count += check_list(&row, RUN, &report, "");
        count += check_list(&row, AUDIT, &report, "");
        count += check_list(&row, WHALE, whale, "");
        for part in parts(whale, &[]) {
            count += check_list(&row, PART, &part, &format!("{}_", part.summary.part.name()));
        }
        assert_eq!(count, row.len(), "no column comes from elsewhere");
    }

    #[test]
    fn a_run_read_from_a_stored_row_has_the_values_of_its_report() {
        let report = made_up::report();
        let whale = report.summary.whale.as_ref().unwrap();
        let table = Table::of(vec![cells(&attempt(), Some(&report))]).unwrap();
        let bytes = parquet::write(&table, &[]).unwrap();
        let runs = Runs::read(parquet::read(bytes).unwrap().0).unwrap();
        let run = runs.find("link-0600", 7).unwrap();
        assert_eq!((run.weight.to_bits(), run.fault.as_str()), (1.0_f64.to_bits(), "a fault"));
        assert_eq!((run.valid, run.state_hash.as_str()), (false, "0123456789abcdef"));
        assert_eq!(run.simulated_s, Some(report.simulated_s));
        let checks = (run.resolution_looks, run.resolution_missed);
        assert_eq!(checks, (report.audit.resolution_looks, report.audit.resolution_missed));
        assert_eq!((run.outcome.as_str(), run.decided), (whale.outcome.name(), whale.decided));
        assert_eq!(run.first_contact_s, whale.first_contact_s);
        assert_eq!(run.last_contact_s, whale.last_contact_s);
        assert_eq!(run.trailing_m, Some(whale.trailing_m));
        assert_eq!(
            [run.carried_traps, run.carried_buoys],
            [whale.carried_traps, whale.carried_buoys]
        );
        assert!(
            run.rope_on_head && run.rope_on_flipper && run.rope_on_tail,
            "rope is on all parts"
        );
        assert_eq!([run.anchored, run.trailing], [whale.is_anchored(), whale.is_trailing()]);
        assert_eq!(run.lodged_in_mouth, whale.lodged_in_mouth);
        let peaks = report.summary.lines.iter().map(|line| line.peak_tension_n);
        assert_eq!(run.peak_tension_n, peaks.reduce(f64::max));
        for region in &whale.regions {
            let part = &run.parts[region.part as usize];
            assert_eq!(part.wraps, Some(region.wraps), "{:?}", region.part);
            assert_eq!(part.peak_wraps, Some(region.peak_wraps), "{:?}", region.part);
            assert_eq!(part.peak_normal_n, Some(region.peak_normal_n), "{:?}", region.part);
            assert_eq!(part.peak_pressure_pa, Some(region.peak_pressure_pa), "{:?}", region.part);
        }
    }

    #[test]
    fn a_row_without_a_run_has_the_same_columns_of_the_same_kinds() {
        let whole = cells(&attempt(), Some(&made_up::report()));
        let empty = cells(&attempt(), None);
        assert_eq!(whole.len(), empty.len());
        for ((name, whole), (other, empty)) in whole.iter().zip(&empty) {
            assert_eq!((name, discriminant(whole)), (other, discriminant(empty)), "{name}");
        }
        let cell = |wanted: &str| &empty.iter().find(|(name, _)| name == wanted).unwrap().1;
        assert_eq!(*cell("outcome"), Cell::Text("none".into()));
        assert_eq!(*cell("valid"), Cell::Flag(false));
        assert_eq!(*cell("peak_line"), Cell::Text(String::new()));
        assert_eq!(*cell("head_wraps"), Cell::Real(None));
    }
}
