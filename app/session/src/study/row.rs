//! The row of a run: what was drawn, how it ended, where rope was, what it bore.

use endline_sdk::BodyPart;

use crate::report::{LineReport, LinkReport, RegionReport, Report, WhaleReport};

use super::encounter::Encounter;
use super::open::Opened;
use super::table::{Cell, Row};

/// The row of an option in an encounter; `Err` tells why there was no run.
pub(super) fn row(
    opened: &Opened,
    option: usize,
    encounter: &Encounter,
    came_to: Result<&Report, &str>,
) -> Row {
    let plan = &opened.options[option];
    let mut row: Row = vec![
        ("encounter".into(), Cell::Whole(i64::from(encounter.index))),
        ("option".into(), Cell::Text(plan.id.clone())),
        (
            "replay_key".into(),
            Cell::Text(format!("{}/{}/{}", &opened.hash[..16], encounter.index, plan.id)),
        ),
    ];
    verdict(&mut row, came_to);
    let report = came_to.ok();
    whale(&mut row, report.and_then(|report| report.whale.as_ref()));
    gear(&mut row, report);
    for drawn in &encounter.drawn {
        let cell = drawn
            .number
            .map_or_else(|| Cell::Text(drawn.text.clone()), |number| Cell::Real(Some(number)));
        row.push((format!("drawn_{}", drawn.name), cell));
    }
    row
}

fn verdict(row: &mut Row, came_to: Result<&Report, &str>) {
    let report = came_to.ok();
    let fault = match came_to {
        Err(why) => why.to_owned(),
        Ok(report) if report.valid => String::new(),
        Ok(report) => report.stopped.clone().unwrap_or_else(|| fault(report)),
    };
    let audit = |of: fn(&Report) -> u64| {
        Cell::Whole(report.map_or(0, |report| i64::try_from(of(report)).unwrap_or(i64::MAX)))
    };
    row.extend([
        ("valid".into(), Cell::Flag(report.is_some_and(|report| report.valid))),
        ("fault".into(), Cell::Text(fault)),
        ("tunnelled".into(), audit(|report| report.audit.tunnelled)),
        ("unconverged".into(), audit(|report| report.audit.unconverged)),
        ("simulated_s".into(), Cell::Real(report.map(|report| report.simulated_s))),
        (
            "state_hash".into(),
            Cell::Text(report.map(|report| report.state_hash.clone()).unwrap_or_default()),
        ),
    ]);
}

fn fault(report: &Report) -> String {
    format!(
        "{} crossings of rope and skin, {} numbers not finite",
        report.audit.tunnelled, report.audit.non_finite
    )
}

fn whale(row: &mut Row, whale: Option<&WhaleReport>) {
    let real = |of: fn(&WhaleReport) -> Option<f64>| Cell::Real(whale.and_then(of));
    row.extend([
        ("outcome".into(), Cell::Text(whale.map_or("none", |whale| whale.outcome).to_owned())),
        ("decided".into(), Cell::Flag(whale.is_some_and(|whale| whale.decided))),
        ("first_contact_s".into(), real(|whale| whale.first_contact_s)),
        ("last_contact_s".into(), real(|whale| whale.last_contact_s)),
        ("contact_time_s".into(), real(|whale| Some(whale.contact_time_s))),
        ("drag_added_N".into(), real(|whale| Some(whale.drag_added_N))),
        ("trailing_m".into(), real(|whale| Some(whale.trailing_m))),
        ("tethered_m".into(), real(|whale| Some(whale.tethered_m))),
        (
            "was_lodged_in_mouth".into(),
            Cell::Flag(whale.is_some_and(|whale| whale.was_lodged_in_mouth)),
        ),
    ]);
    for part in BodyPart::ALL {
        let name = part.name();
        let region =
            whale.and_then(|whale| whale.regions.iter().find(|region| region.region == name));
        let real = |of: fn(&RegionReport) -> f64| Cell::Real(region.map(of));
        row.extend([
            (format!("{name}_wraps"), real(|region| region.wraps)),
            (format!("{name}_peak_wraps"), real(|region| region.peak_wraps)),
            (format!("{name}_contact_m"), real(|region| region.contact_length_m)),
            (format!("{name}_peak_contact_m"), real(|region| region.peak_contact_length_m)),
            (format!("{name}_peak_normal_N"), real(|region| region.peak_normal_N)),
        ]);
    }
}

fn gear(row: &mut Row, report: Option<&Report>) {
    let lines: &[LineReport] = report.map_or(&[], |report| &report.lines);
    let links: &[LinkReport] = report.map_or(&[], |report| &report.links);
    let tautest = lines.iter().fold(None, |most: Option<&LineReport>, line| match most {
        Some(most) if most.peak_tension_N >= line.peak_tension_N => Some(most),
        _ => Some(line),
    });
    let first = |times: &mut dyn Iterator<Item = (f64, &str)>| {
        times.fold(None, |least: Option<(f64, String)>, (time, id)| match least {
            Some(least) if least.0 <= time => Some(least),
            _ => Some((time, id.to_owned())),
        })
    };
    let parted_lines = lines.iter().filter_map(|line| Some((line.parted_at_s?, line.id.as_str())));
    let parted_links = links.iter().filter_map(|link| Some((link.parted_at_s?, link.id.as_str())));
    let parted = first(&mut parted_links.chain(parted_lines));
    let at_links = links.iter().map(|link| link.peak_tension_N).reduce(f64::max);
    row.extend([
        ("peak_tension_N".into(), Cell::Real(tautest.map(|line| line.peak_tension_N))),
        ("peak_line".into(), Cell::Text(tautest.map(|line| line.id.clone()).unwrap_or_default())),
        ("peak_at_s".into(), Cell::Real(tautest.map(|line| line.peak_at_s))),
        ("link_peak_N".into(), Cell::Real(at_links)),
        (
            "parted".into(),
            Cell::Text(parted.as_ref().map(|(_, id)| id.clone()).unwrap_or_default()),
        ),
        ("parted_at_s".into(), Cell::Real(parted.map(|(time, _)| time))),
    ]);
}
