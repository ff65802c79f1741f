//! The tables of what was found: rates, comparisons, tensions, places on the whale.

use endline_gear::StudyEvent;

use crate::study::stats::{
    AssumedBand, Bands, Change, ExposureFinding, Findings, LevelFinding, OptionFinding, Paired,
    ResolutionChecks, SegmentBand, TrackRate, figure, track_words,
};

use super::words::{
    NOT_FOLLOWED, event_words, force, lowest, percent_interval, points, rate, ratio, short_rate,
};
use crate::page::{Cell, Line, Table};

/// Columns of events that a page shows beside each other.
const BESIDE: usize = 8;

/// Rates by distance and by time of gear in the water; `None` for a study without tracks.
pub(super) fn on_tracks(findings: &Findings) -> Option<Table> {
    let row = |option: &ExposureFinding, rate: &TrackRate| {
        let [low, high] = [rate.interval.low, rate.interval.high].map(figure);
        let ratio = rate.ratio.map(|value| ratio(Some(value), rate.ratio_interval));
        vec![
            Cell::from(&option.name),
            track_words(&rate.event).into(),
            format!("{:.0} in {:.0} km", rate.events, option.distance_km).into(),
            format!("{} [{low}, {high}]", figure(rate.per_100_km)).into(),
            figure(rate.per_1000_gear_days).into(),
            ratio.unwrap_or_default().into(),
        ]
    };
    let of = |option: &ExposureFinding| {
        option.rates.iter().map(|rate| row(option, rate)).collect::<Vec<_>>()
    };
    let rows: Vec<Vec<Cell>> = findings.exposure.iter().flat_map(of).collect();
    let headings =
        ["option", "event", "events", "in 100 km", "in 1,000 gear-days", "ratio to the baseline"];
    (!rows.is_empty()).then(|| Table::new("Rates by distance swum", &headings, rows))
}

/// Rates of every event that concerns the whole whale, some beside each other.
pub(super) fn rates(findings: &Findings) -> Vec<Table> {
    StudyEvent::of_the_whole().chunks(BESIDE).map(|events| rates_of(findings, events)).collect()
}

fn rates_of(findings: &Findings, events: &[StudyEvent]) -> Table {
    let words: Vec<String> = events.iter().map(StudyEvent::words).collect();
    let headings: Vec<&str> = ["option", "invalid runs", "resolution missed"]
        .into_iter()
        .chain(words.iter().map(String::as_str))
        .collect();
    let row = |option: &OptionFinding| {
        let mut row = vec![
            Cell::from(&option.name),
            option.invalid.to_string().into(),
            missed(&option.resolution).into(),
        ];
        row.extend(
            events
                .iter()
                .map(|event| option.rate(&event.name()).map_or_else(not_followed, rate).into()),
        );
        row
    };
    let rows = findings.options.iter().map(row).collect();
    Table::new("Rates given an encounter", &headings, rows)
}

/// Uncertainty of the rates of registered events: chance, assumed inputs and segments, each apart.
pub(super) fn bands(findings: &Findings) -> Table {
    let row = |bands: &Bands| {
        let assumed = bands.assumed.as_ref().map_or_else(|| "none varies".into(), assumed);
        let segments = bands.segments.as_ref().map_or_else(|| "not known".into(), segments);
        vec![
            Cell::from(event_words(&bands.event)),
            Cell::from(&bands.name),
            rate(&bands.rate).into(),
            assumed,
            segments,
        ]
    };
    let headings = [
        "event",
        "option",
        "rate, band of chance",
        "band of assumed inputs",
        "band of segments and steps",
    ];
    Table::new(
        "Uncertainty of the rates of registered events, by three separate causes",
        &headings,
        findings.bands.iter().map(row).collect(),
    )
}

/// `0.2 to 3.1 %` with the levels of both ends, and the band of random levels.
fn assumed(band: &AssumedBand) -> Cell {
    let by_chance = percent_interval(band.by_chance);
    if band.is_chance() {
        return Cell::lines([
            format!("{}, no wider than by chance", band.rates().percents()),
            format!("levels at random: {by_chance}"),
        ]);
    }
    Cell::lines([
        band.rates().percents(),
        format!("least with {}", band.least_at),
        format!("greatest with {}", band.greatest_at),
        format!("levels at random: {by_chance}"),
    ])
}

/// `0.9 to 1.8 %`, and the ratio that it comes from.
fn segments(band: &SegmentBand) -> Cell {
    let lines = [
        band.rate.percents(),
        format!("finer ones: {} times", ratio(Some(band.ratio), Some(band.ratio_interval))),
    ];
    let mut cell = Cell::lines(lines);
    cell.lines.push(Line::Small(band.source.clone()));
    cell
}

/// Share of the checks of segment lengths near the whale that left one longer than requested.
fn missed(checks: &ResolutionChecks) -> String {
    checks.share().map_or_else(
        || "none requested".to_owned(),
        |share| format!("{:.1} % of checks", 100.0 * share),
    )
}

/// Options that differ from the baseline in more than one thing, with what these are; `None` if there are none.
pub(super) fn several_differences(findings: &Findings) -> Option<Table> {
    let several = findings.options.iter().filter(|option| option.differs_in.len() > 1);
    let things = |option: &OptionFinding| Cell {
        lines: option.differs_in.iter().cloned().map(Line::Code).collect(),
    };
    let rows: Vec<Vec<Cell>> =
        several.map(|option| vec![Cell::from(&option.name), things(option)]).collect();
    let headings = ["option", "differs from the baseline in"];
    (!rows.is_empty())
        .then(|| Table::new("More than one difference from the baseline", &headings, rows))
}

/// The study's event against the baseline: over all encounters, then level by level.
pub(super) fn compared(findings: &Findings) -> Vec<Table> {
    let event = event_words(&findings.event);
    let levels = findings.levels.iter().map(|level| of_level(findings, level, &event));
    std::iter::once(against(findings, &event)).chain(levels).collect()
}

fn against(findings: &Findings, event: &str) -> Table {
    let among = format!("p among {} registered comparisons (Holm)", findings.comparisons);
    let headings = [
        "option",
        "difference",
        "ratio of rates",
        "probability of fewer",
        "only with the option, only with the baseline",
        "McNemar test, p",
        among.as_str(),
        "resamples in which its rate is lowest, alone or tied",
    ];
    let row = |option: &OptionFinding| -> Option<Vec<Cell>> {
        let paired = option.against(&findings.event)?;
        Some(vec![
            Cell::from(&option.name),
            points(paired.difference, paired.difference_interval).into(),
            ratio(paired.ratio, paired.ratio_interval).into(),
            format!("{:.3}", paired.fewer).into(),
            format!("{} and {} of {}", paired.only_this, paired.only_other, paired.encounters)
                .into(),
            format!("{:.3}", paired.mcnemar).into(),
            option
                .adjusted(&findings.event)
                .map_or_else(|| "not registered".into(), |p| format!("{p:.3}"))
                .into(),
            lowest(option.lowest).into(),
        ])
    };
    let rows = findings.others().filter_map(row).collect();
    Table::new(format!("\"{event}\" against the baseline, on the same encounters"), &headings, rows)
}

/// `-3.5 points [-6.1, -0.9]`, of runs that were followed.
fn difference(paired: &Paired) -> String {
    if paired.encounters == 0 {
        return "no run counts".to_owned();
    }
    points(paired.difference, paired.difference_interval)
}

fn not_followed() -> String {
    NOT_FOLLOWED.to_owned()
}

fn of_level(findings: &Findings, level: &LevelFinding, event: &str) -> Table {
    let row = |(index, option): (usize, &OptionFinding)| {
        let paired = &level.against[index];
        vec![
            Cell::from(&option.name),
            rate(&level.rates[index]).into(),
            difference(paired).into(),
            rate(&level.parted[index]).into(),
        ]
    };
    let rows = findings.options.iter().enumerate().map(row).collect();
    let headings = ["option", event, "difference", "something parted"];
    Table::new(format!("Encounters with {}", level.level), &headings, rows)
}

/// Quantiles of the greatest tension of a run.
pub(super) fn tensions(findings: &Findings) -> Table {
    let row = |option: &OptionFinding| {
        let own = &option.tensions;
        let at = |share| Cell::from(own.quantile_n(share).map_or_else(|| "none".into(), force));
        let difference = match (own.median_difference_n, own.median_difference_interval_n) {
            (Some(difference), Some(interval)) => {
                format!("{difference:+.1} N [{:.1},\u{a0}{:.1}]", interval.low, interval.high)
            }
            _ => "none".into(),
        };
        vec![Cell::from(&option.name), at(0.05), at(0.5), at(0.95), at(1.0), difference.into()]
    };
    let headings = [
        "option",
        "5th percentile",
        "median",
        "95th percentile",
        "greatest",
        "median of differences from the baseline",
    ];
    Table::new("Greatest tension of a run", &headings, findings.options.iter().map(row).collect())
}

/// Parts that rope touched, and parts with half a turn of rope.
pub(super) fn regions(findings: &Findings) -> Table {
    let places = StudyEvent::places();
    let row = |option: &OptionFinding| {
        let one = |event: String| option.rate(&event).map_or_else(not_followed, short_rate);
        let cell = |place: &&str| {
            Cell::lines([one(format!("contact_{place}")), one(format!("wrap_{place}"))])
        };
        [Cell::from(&option.name)].into_iter().chain(places.iter().map(cell)).collect()
    };
    let headings: Vec<&str> = ["option"].into_iter().chain(places.iter().copied()).collect();
    Table::new(
        "Upper line: rope touched the part. Lower line: at least half a turn lay about it at some time",
        &headings,
        findings.options.iter().map(row).collect(),
    )
}

/// How an option's runs end beside the baseline's in the same encounters; `None` if there is only the baseline.
pub(super) fn changes(findings: &Findings) -> Option<Table> {
    let headings = [
        "option",
        "another outcome",
        "mean greatest tension",
        "another outcome, of those that touch",
        "mean greatest tension, of those that touch",
        "outcome with the baseline, and with the option",
    ];
    let is_followed = |option: &&OptionFinding| option.changes.all.outcome.runs > 0;
    let rows: Vec<Vec<Cell>> = findings.others().filter(is_followed).map(changes_of).collect();
    let caption = "Outcome and tension beside the baseline's, encounter by encounter";
    (!rows.is_empty()).then(|| Table::new(caption, &headings, rows))
}

fn changes_of(option: &OptionFinding) -> Vec<Cell> {
    let changes = &option.changes;
    let cells = [&changes.all, &changes.touching]
        .into_iter()
        .flat_map(|change| [rate(&change.outcome).into(), tension(change).into()]);
    [Cell::from(&option.name)].into_iter().chain(cells).chain([kinds(option)]).collect()
}

/// `entangled to shed: 4`, a line for each kind of change.
fn kinds(option: &OptionFinding) -> Cell {
    let changed = option.changes.counts.iter().filter(|(one, other, _)| one != other);
    let lines: Vec<String> = changed
        .map(|(one, other, count)| format!("{one} to {other}: {count}").replace('_', " "))
        .collect();
    if lines.is_empty() { "equal in all encounters".into() } else { Cell::lines(lines) }
}

/// `104 N, +1.3 % [-0.2, 2.8]`.
fn tension(change: &Change) -> String {
    let (Some([_, own_n]), Some(more)) = (change.mean_tension_n, change.tension) else {
        return "none".into();
    };
    let interval = change.tension_interval.map_or_else(String::new, percent_interval);
    format!("{own_n:.0} N, {:+.1} % {interval}", 100.0 * more)
}
