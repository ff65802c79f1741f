//! Texts that the study commands print.

use endline_gear::{Prior, StudyEvent};
use endline_session::campaign::Count;
use endline_session::encounters::{Drawn, Encounter, in_words};
use endline_session::study::PreparedStudy;
use endline_session::study::folder::{BLOCK, Folder};
use endline_session::study::forecast::Forecast;
use endline_session::study::report::NOT_FOLLOWED;
use endline_session::study::stats::{
    Change, Findings, Interval, Rate, answer, figure, observed, resolution, rounded, track_words,
};
use endline_session::units::newtons_and_lbf;

use super::super::table::columns;

/// Encounters shown by a plan.
const SHOWN: u32 = 5;

pub(super) fn plan(opened: &PreparedStudy) -> String {
    let study = &opened.study;
    let options: Vec<&str> = opened.options.iter().map(|option| option.id.as_str()).collect();
    let mut text = format!("{}\n\n", study.name);
    text += &columns(&[
        vec!["hash".into(), opened.hash.clone()],
        vec!["options".into(), options.join(", ")],
        vec!["baseline".into(), opened.options[opened.baseline].id.clone()],
        vec![
            "encounters".into(),
            format!("{} for every option, the same for all", study.encounters),
        ],
        vec![
            "blocks".into(),
            format!("{} of {BLOCK} encounters", study.encounters.div_ceil(u64::from(BLOCK))),
        ],
    ]);
    text += &several_differences(opened.several_differences());
    let mut rows = vec![vec!["prior".to_owned(), "confidence".into(), "source".into()]];
    rows.extend(
        study
            .priors
            .iter()
            .map(|prior| vec![prior.words(), prior.confidence.word().into(), prior.source.clone()]),
    );
    text += &columns(&rows);
    let mut rows = vec![
        ["encounter".to_owned()]
            .into_iter()
            .chain(study.priors.iter().map(Prior::words))
            .collect::<Vec<_>>(),
    ];
    for index in 0..SHOWN.min(u32::try_from(study.encounters).unwrap_or(SHOWN)) {
        let drawn = Encounter::of(&opened.study, index).drawn;
        rows.push(
            [index.to_string()]
                .into_iter()
                .chain(drawn.iter().map(|drawn| drawn_words(opened, drawn)))
                .collect(),
        );
    }
    text + &columns(&rows)
}

/// A drawn value in words.
fn drawn_words(opened: &PreparedStudy, drawn: &Drawn) -> String {
    let mut priors = opened.study.priors.iter();
    match priors.find(|prior| prior.name.value == drawn.name) {
        Some(prior) if drawn.number.is_none() => opened.value_words(prior, &drawn.text),
        _ => in_words(&drawn.text),
    }
}

/// Options that differ from the baseline in more than one thing, with what these are.
fn several_differences<'a>(options: impl Iterator<Item = (&'a str, Vec<String>)>) -> String {
    let several = options.filter(|(_, things)| things.len() > 1);
    let mut rows = vec![
        ["more than one difference from the baseline", "differs in"].map(str::to_owned).to_vec(),
    ];
    rows.extend(several.map(|(id, things)| vec![id.to_owned(), things.join(", ")]));
    if rows.len() > 1 { columns(&rows) } else { String::new() }
}

/// Time and precision of a study, or how to obtain them.
pub(super) fn forecast(
    opened: &PreparedStudy,
    forecast: Option<&Forecast>,
    threads: usize,
) -> String {
    let Some(forecast) = forecast.filter(|forecast| forecast.done > 0) else {
        return "no encounter has been run; --first 60 runs the first sixty and forecasts time and precision from them\n".into();
    };
    let Forecast { encounters, done, cost, rate, needed_to_tell, needed_for_band, .. } = forecast;
    let baseline = &opened.options[opened.baseline].name;
    let event = opened.study.event.words();
    let mut rows = vec![vec![
        "forecast".to_owned(),
        format!("from the first {done} of {encounters} encounters"),
    ]];
    let unknown = "not known: no encounter was timed; --first with a greater number times some";
    let time = cost.map_or_else(|| unknown.to_owned(), |cost| cost.words(threads));
    rows.push(vec!["time".into(), time]);
    rows.push(vec![
        "rate".into(),
        format!("\"{event}\" with {baseline}: {}", in_percent(rate.rate, rate.interval)),
    ]);
    let share = 100.0 * forecast.prevented;
    let (tell, band) = match (needed_to_tell, needed_for_band) {
        (Some(tell), Some(band)) => {
            let can = if *tell <= *encounters as f64 { "can" } else { "cannot" };
            (
                format!(
                    "an option that prevents {share:.0} of 100 needs about {} encounters; with {encounters} the study {can} tell it",
                    rounded(*tell)
                ),
                format!(
                    "such a share is known to ±5 points from about {} encounters",
                    rounded(*band)
                ),
            )
        }
        _ => (
            "not known: the event has not occurred; run more encounters".into(),
            "not known".into(),
        ),
    };
    rows.push(vec!["difference".into(), tell]);
    rows.push(vec!["band".into(), band]);
    columns(&rows)
}

/// `8.1 % [2.3, 25.0]`.
fn in_percent(rate: f64, interval: Interval) -> String {
    format!("{:.1} % [{:.1}, {:.1}]", 100.0 * rate, 100.0 * interval.low, 100.0 * interval.high)
}

pub(super) fn ran(opened: &PreparedStudy, folder: &Folder, blocks: Count) -> String {
    let at = folder.path.display();
    let whole = (0..folder.blocks()).all(|block| folder.is_stored(block));
    let next = if whole {
        format!("next: endline study merge {} --out {at}\n", opened.study.place.source.path)
    } else {
        "the other parts are still to be run; endline study merge lists them\n".to_owned()
    };
    format!(
        "{} of {} blocks in {at}, {} of them new\n{next}",
        blocks.done,
        blocks.total,
        blocks.done - blocks.found
    )
}

/// The answer in sentences, and the tables if `all` are asked for.
pub(super) fn findings(opened: &PreparedStudy, findings: &Findings, all: bool) -> String {
    let given = if findings.exposure.is_empty() {
        "every rate is relative, given an encounter, under the study's distribution"
    } else {
        "an encounter is a track through the gear; shares are of tracks"
    };
    let mut text =
        format!("{}\n{}; {given}; 95 % intervals\n\n", opened.study.name, findings.extent());
    for sentence in answer(findings, &findings.event) {
        text += &format!("{sentence}\n");
    }
    for sentence in resolution(findings).into_iter().chain(observed(findings)) {
        text += &format!("{sentence}\n");
    }
    text += "\n";
    text += &freed(findings);
    if all {
        text + &tables(findings)
    } else {
        text + "All tables: the same command with --all, or the report.\n"
    }
}

/// The tables of all findings.
fn tables(findings: &Findings) -> String {
    let mut text = on_tracks(findings);
    text += &rates(findings);
    text += &registered(findings).iter().map(|event| compared(findings, event)).collect::<String>();
    text += &several_differences(
        findings.options.iter().map(|option| (option.id.as_str(), option.differs_in.clone())),
    );
    text += &changed(findings);
    text += &tensions(findings);
    text += &held(findings);
    text += &strengths(findings);
    text += &levels(findings);
    text += &bands(findings);
    text += &inputs(findings);
    text + &claims(findings)
}

/// Rates by distance and by time of gear in the water, of a study with tracks.
fn on_tracks(findings: &Findings) -> String {
    let heads = ["option", "event", "events", "in 100 km", "in 1,000 gear-days", "ratio"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for option in &findings.exposure {
        for rate in &option.rates {
            let ratio = rate
                .ratio
                .zip(rate.ratio_interval)
                .map_or_else(String::new, |(ratio, interval)| with(ratio, interval, 1.0));
            rows.push(vec![
                option.id.clone(),
                track_words(&rate.event),
                format!("{:.0}", rate.events),
                with(rate.per_100_km, rate.interval, 1.0),
                figure(rate.per_1000_gear_days),
                ratio,
            ]);
        }
    }
    if rows.len() > 1 { columns(&rows) } else { String::new() }
}

/// Share that each option frees of the whales held with the baseline.
fn freed(findings: &Findings) -> String {
    let Some(held) = findings.held_whales.as_ref().filter(|held| held.rate.hits > 0) else {
        return String::new();
    };
    let mut rows = vec![
        ["of the whales held with the baseline", "freed", "others held"]
            .map(str::to_owned)
            .to_vec(),
    ];
    if held.observed_from.is_some() {
        rows[0].push("freed, weighted as observed".into());
    }
    for option in &held.options {
        let mut row = vec![option.id.clone(), rate(&option.freed), option.newly_held.to_string()];
        if held.observed_from.is_some() {
            row.push(option.weighted.map_or_else(
                || "no route met".into(),
                |weighted| in_percent(weighted.share, weighted.interval),
            ));
        }
        rows.push(row);
    }
    columns(&rows)
}

/// Columns of events that a line of a terminal has room for.
const BESIDE: usize = 5;

fn rates(findings: &Findings) -> String {
    let events: Vec<String> = StudyEvent::of_the_whole().iter().map(StudyEvent::name).collect();
    events.chunks(BESIDE).map(|events| rates_of(findings, events)).collect()
}

fn rates_of(findings: &Findings, events: &[String]) -> String {
    let mut rows = vec![
        ["option", "runs", "invalid", "undecided"]
            .into_iter()
            .map(str::to_owned)
            .chain(events.iter().map(|event| event.replace('_', " ")))
            .collect::<Vec<_>>(),
    ];
    for option in &findings.options {
        let runs = option.rate("contact").map_or(0, |rate| rate.runs);
        let mut row = vec![
            option.id.clone(),
            runs.to_string(),
            option.invalid.to_string(),
            option.undecided.to_string(),
        ];
        row.extend(
            events
                .iter()
                .map(|event| option.rate(event).map_or_else(|| NOT_FOLLOWED.to_owned(), rate)),
        );
        rows.push(row);
    }
    columns(&rows)
}

/// The event that the study asks about, and the others that were registered.
fn registered(findings: &Findings) -> Vec<String> {
    let mut events = vec![findings.event.clone()];
    for (event, _) in findings.options.iter().flat_map(|option| &option.adjusted) {
        if !events.contains(event) {
            events.push(event.clone());
        }
    }
    events
}

/// An event in every option beside the baseline, on the same encounters.
fn compared(findings: &Findings, event: &str) -> String {
    if findings.options.len() == 1 {
        return String::new();
    }
    let among = format!("among {} (Holm)", findings.comparisons);
    let heads =
        ["against the baseline", event, "difference", "ratio", "P(fewer)", "McNemar", &among];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for option in &findings.options {
        let (Some(own), Some(paired)) = (option.rate(event), option.against(event)) else {
            continue;
        };
        let ratio = paired
            .ratio
            .zip(paired.ratio_interval)
            .map_or_else(|| "none".into(), |(ratio, interval)| with(ratio, interval, 1.0));
        rows.push(vec![
            option.id.clone(),
            rate(own),
            with(100.0 * paired.difference, paired.difference_interval, 100.0) + " points",
            ratio,
            format!("{:.3}", paired.fewer),
            format!("{:.3}", paired.mcnemar),
            option.adjusted(event).map_or_else(String::new, |p| format!("{p:.3}")),
        ]);
    }
    columns(&rows)
}

/// How sure the rates of the event are: chance, assumed inputs, segments.
fn bands(findings: &Findings) -> String {
    let heads = [
        "bands",
        findings.event.as_str(),
        "assumed inputs",
        "levels at random",
        "finer segments and steps",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for bands in findings.bands.iter().filter(|bands| bands.event == findings.event) {
        let (assumed, random) = bands.assumed.as_ref().map_or_else(
            || ("none varies".to_owned(), String::new()),
            |band| (band.rates().percents(), band.by_chance.percents()),
        );
        let segments = bands
            .segments
            .as_ref()
            .map_or_else(|| "not known".to_owned(), |band| band.rate.percents());
        rows.push(vec![bands.option.clone(), rate(&bands.rate), assumed, random, segments]);
    }
    columns(&rows)
}

/// How much of the variance of the event each drawn input explains alone.
fn inputs(findings: &Findings) -> String {
    let mut rows = vec![vec![
        "input".to_owned(),
        format!("explains of the variance of {} alone (Sobol index)", findings.event),
    ]];
    rows.extend(
        findings
            .inputs
            .iter()
            .map(|input| vec![input.words.clone(), input.sobol.words().join(", ")]),
    );
    if rows.len() > 1 { columns(&rows) } else { String::new() }
}

/// How many encounters end otherwise than with the baseline, how much the mean greatest tension is off, and which ends they were.
fn changed(findings: &Findings) -> String {
    let heads = [
        "against the baseline",
        "outcome differs",
        "mean greatest tension",
        "of those that touch, it differs",
        "mean greatest tension",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let mut ends = String::new();
    for option in findings.others().filter(|option| option.changes.all.outcome.runs > 0) {
        let changes = &option.changes;
        let cells = [&changes.all, &changes.touching]
            .into_iter()
            .flat_map(|change| [rate(&change.outcome), mean_tension(change)]);
        rows.push([option.id.clone()].into_iter().chain(cells).collect());
        let kinds = changes.counts.iter().filter(|(one, other, _)| one != other);
        let kinds: Vec<String> =
            kinds.map(|(one, other, count)| format!("{one} to {other} {count}")).collect();
        ends += &format!(
            "{}: {}\n",
            option.id,
            if kinds.is_empty() {
                "every outcome is the baseline's".to_owned()
            } else {
                kinds.join(", ")
            }
        );
    }
    if rows.len() > 1 { columns(&rows) + &ends + "\n" } else { String::new() }
}

/// `104.2 N, +1.3 % [-0.2, 2.8]`.
fn mean_tension(change: &Change) -> String {
    let (Some([_, own_n]), Some(more)) = (change.mean_tension_n, change.tension) else {
        return "none".into();
    };
    let interval = change.tension_interval.map_or_else(String::new, |interval| {
        format!(" [{:.2}, {:.2}]", 100.0 * interval.low, 100.0 * interval.high)
    });
    format!("{own_n:.1} N, {:+.2} %{interval}", 100.0 * more)
}

fn tensions(findings: &Findings) -> String {
    let mut rows =
        vec![["greatest tension", "median", "95 % below", "greatest"].map(str::to_owned).to_vec()];
    for option in &findings.options {
        let at = |share| option.tensions.quantile_n(share).map_or_else(|| "none".into(), force);
        rows.push(vec![option.id.clone(), at(0.5), at(0.95), at(1.0)]);
    }
    columns(&rows)
}

/// Times since first contact at which the share still held is printed [s].
const HELD_S: [f64; 5] = [10.0, 30.0, 60.0, 300.0, 600.0];

/// How long rope holds whales that it touched.
fn held(findings: &Findings) -> String {
    let mut rows = vec![vec!["still held after first contact".to_owned(), "released".to_owned()]];
    rows[0].extend(HELD_S.map(|time| format!("{time} s")));
    for option in &findings.options {
        let own = &option.survival;
        let mut row = vec![option.id.clone(), format!("{} of {}", own.released, own.touched)];
        let share = |time_s| {
            let held = own.at(time_s)?;
            Some(with(100.0 * held.share, held.interval, 100.0) + " %")
        };
        row.extend(HELD_S.map(|time| share(time).unwrap_or_else(|| "not followed".to_owned())));
        rows.push(row);
    }
    columns(&rows)
}

/// The delivered strength of the lines and weak links of each option.
fn strengths(findings: &Findings) -> String {
    let heads = ["delivered strength", "part", "stated", "delivered", "nine of ten", "confidence"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for option in &findings.options {
        rows.extend(option.strengths.iter().map(|strength| {
            let [least, most] = strength.nine_of_ten_N;
            vec![
                option.id.clone(),
                strength.part.clone(),
                force(strength.stated.value),
                force(strength.delivered_N),
                format!("{least:.0} to {most:.0} N"),
                strength.confidence.to_owned(),
            ]
        }));
    }
    columns(&rows)
}

fn levels(findings: &Findings) -> String {
    let mut text = String::new();
    for level in &findings.levels {
        let mut rows = vec![vec![level.level.clone(), findings.event.clone(), "parted".into()]];
        for ((option, own), parted) in findings.options.iter().zip(&level.rates).zip(&level.parted)
        {
            rows.push(vec![option.id.clone(), rate(own), rate(parted)]);
        }
        text += &columns(&rows);
    }
    text
}

fn claims(findings: &Findings) -> String {
    let mut text = String::new();
    for claim in &findings.claims {
        text += &format!("{}\n", claim.says);
        text += &columns(&[
            vec!["more".into(), claim.more.clone(), rate(&claim.more_rate)],
            vec!["less".into(), claim.less.clone(), rate(&claim.less_rate)],
            vec![
                "difference".into(),
                with(100.0 * claim.difference, claim.interval, 100.0) + " points",
                claim.verdict.words().into(),
            ],
        ]);
    }
    text
}

/// `12.0 % [8.1, 17.4] of 200`.
fn rate(rate: &Rate) -> String {
    if rate.runs == 0 {
        return "no run counts".to_owned();
    }
    format!(
        "{:.1} % [{:.1}, {:.1}] {}/{}",
        100.0 * rate.rate,
        100.0 * rate.interval.low,
        100.0 * rate.interval.high,
        rate.hits,
        rate.runs
    )
}

fn with(value: f64, interval: Interval, factor: f64) -> String {
    format!("{value:.2} [{:.2}, {:.2}]", factor * interval.low, factor * interval.high)
}

fn force(newtons: f64) -> String {
    newtons_and_lbf(newtons, 0)
}
