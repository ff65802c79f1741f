//! `[exposure]`: whales cross an area with gear on random tracks, and are not aimed at rope.
//!
//! A track starts anywhere in the area and in any direction, each as likely as any other. It consists of straight legs; the change of
//! heading from one to the next is normal with mean zero (correlated random walk: Kareiva and Shigesada 1983,
//! doi:10.1007/BF00379695). At the edges of the area it continues as its mirror image, so that tracks cover the area evenly.

use crate::diagnostic::At;
use crate::entry::Confidence;
use crate::fields::{Fields, Range, confidence};
use crate::limits;
use crate::units::Quantity;

use super::prior::Prior;

/// Tracks of whales through an area with gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposure {
    /// The area about the origin of the scenario, east and north [m].
    pub area_m: [f64; 2],
    /// Distance over the ground after which a track ends that meets no gear [m].
    pub distance_m: f64,
    /// Length of a leg [m].
    pub leg_m: f64,
    /// Standard deviation of the change of heading from one leg to the next [rad].
    pub turn_rad: f64,
    /// Distance of rope from mid-body, across the track and up and down, within which gear is met; `None`: half the breadth of the whale
    /// over its flippers or flukes [m].
    pub reach_m: Option<f64>,
    /// Source of the tracks.
    pub source: String,
    /// Confidence in them.
    pub confidence: Confidence,
}

/// Priors that a track determines.
const OF_TRACKS: [&str; 3] = ["along", "heading", "offset"];

/// Reads `[exposure]`.
pub(super) fn exposure(table: &Fields<'_>) -> Option<Exposure> {
    table.require("area", "write area = [\"2 km\", \"1 km\"]: east, and north");
    let area = table.values("area", Quantity::Length, &[2]);
    let length = Range::Within(&limits::TRACK);
    let distance = table.need_value("distance", Quantity::Length, length);
    let leg = table.need_value("leg", Quantity::Length, length);
    let turn = table.need_value("turn", Quantity::Angle, Range::Between(0.0, std::f64::consts::PI));
    let reach = table.value("reach", Quantity::Length, Range::Positive);
    table.require("source", "write the source of the tracks, or source = \"assumed\"");
    let source = table.text("source");
    let level = confidence(table, &Confidence::OF_PRIORS);
    let area = area.filter(|area| is_area(table, area));
    Some(Exposure {
        area_m: [area.as_ref()?.value[0], area.as_ref()?.value[1]],
        distance_m: distance?.value,
        leg_m: leg?.value,
        turn_rad: turn?.value,
        reach_m: reach.map(|reach| reach.value),
        source: source?.value,
        confidence: level.unwrap_or(Confidence::Assumed),
    })
}

/// Whether both sides of an area are longer than zero; others are reported.
fn is_area(table: &Fields<'_>, area: &At<Vec<f64>>) -> bool {
    let is_one = area.value.iter().all(|side| *side > 0.0);
    if !is_one {
        let message = "a side of the area is not longer than zero";
        table.problems().push(area.place.error(message, "write lengths such as \"2 km\""));
    }
    is_one
}

/// Reports priors that do not go with tracks: those that place the whale at rope, and proposals.
pub(super) fn check_priors(fields: &Fields<'_>, priors: &[Prior]) {
    for prior in priors {
        let name = prior.name.value.as_str();
        if OF_TRACKS.contains(&name) {
            let message = format!("`{name}` is drawn, but the tracks of [exposure] determine it");
            let help = "remove it, or remove [exposure] to aim the whale at rope";
            fields.problems().push(prior.name.place.error(message, help));
        }
        if prior.proposal.is_some() {
            let message = format!("`{name}` has a proposal, and the study has [exposure]");
            let help = "remove the proposal: rates by distance count every track alike";
            fields.problems().push(prior.name.place.error(message, help));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Study;

    const STUDY: &str = "format = 1\nkind = \"study\"\nname = \"s\"\nscenario = \"cross-a-field\"\nencounters = 40\nbaseline = \"a\"\n\
        [[option]]\nid = \"a\"\n[exposure]\narea = [\"2 km\", \"1 km\"]\ndistance = \"10 km\"\nleg = \"200 m\"\nturn = \"30 deg\"\n\
        source = \"assumed\"\n[encounter.speed]\nuniform = [\"0.5 m/s\", \"1 m/s\"]\nsource = \"assumed\"\n";

    #[test]
    fn tracks_are_read_and_define_the_runs() {
        let study = Study::read("s.toml", STUDY).unwrap();
        let exposure = study.exposure.unwrap();
        assert!((exposure.area_m[1] - 1000.0).abs() < 1e-9 && exposure.reach_m.is_none());
        assert!((exposure.turn_rad.to_degrees() - 30.0).abs() < 1e-9);
        let other = Study::read("s.toml", &STUDY.replace("200 m", "300 m")).unwrap();
        assert_ne!(other.canonical, study.canonical);
    }

    #[test]
    fn mistakes_are_reported() {
        for (from, to, expected) in [
            ("leg = \"200 m\"\n", "", "leg"),
            ("\"2 km\", \"1 km\"", "\"2 km\", \"0 m\"", "longer than zero"),
            ("[encounter.speed]", "[encounter.offset]", "the tracks of [exposure] determine it"),
            (
                "uniform = [\"0.5 m/s\", \"1 m/s\"]",
                "uniform = [\"0.5 m/s\", \"1 m/s\"]\nproposal = { bins = [\"0.5 m/s\", \"0.7 m/s\", \"1 m/s\"], weights = [0.7, 0.3] }",
                "has a proposal",
            ),
        ] {
            let mut text = STUDY.replace(from, to);
            if expected.starts_with("the tracks") {
                text = text.replace("m/s", "m");
            }
            let problems = Study::read("s.toml", &text).unwrap_err();
            let is_it = |problem: &crate::Diagnostic| problem.message.contains(expected);
            assert!(problems.iter().any(is_it), "{to}: {problems:?}");
        }
    }
}
