//! A field of gear: an assembly placed many times by a pattern.
//!
//! | pattern | places |
//! |---|---|
//! | `grid` | `columns` along the bearing, `rows` to the right of it, `spacing` apart, with the middle at `position` |
//! | `random` | `count` in an `area` about `position`, at least `apart` from each other |
//! | `listed` | each of `places`, east and north of `position` |
//!
//! A place of a grid is moved by at most `jitter` along and across; a heading is turned by at most `turn`. Draws follow from the seed of
//! the scenario, or of the field, and the field's id. Random places are drawn one after the other, uniformly, and one that is too near an
//! earlier one is drawn again (simple sequential inhibition: Diggle 2013, Statistical Analysis of Spatial Point Patterns).

use std::f64::consts::FRAC_PI_2;

use crate::assemble::uniform;
use crate::diagnostic::At;
use crate::fields::{Fields, Range};
use crate::limits;
use crate::tree::Content;
use crate::units::Quantity;

use super::gear::{PlacedGear, placed_gear};

/// Draws for a random place after which it is reported that no place is left.
const TRIES: u64 = 10_000;

/// Reads a `[[field]]` as the gear that it places. The ids of the gear are that of the field with the numbers from 1 on.
pub(super) fn read(fields: &Fields<'_>, scenario_seed: u64) -> Option<Vec<PlacedGear>> {
    let id = fields
        .need_id("id", "write an id such as id = \"inshore\"; its gear is inshore-1, inshore-2 …");
    let gear = placed_gear(fields);
    let pattern = fields.need_choice(
        "pattern",
        "write pattern = \"grid\", \"random\" or \"listed\"",
        &[("grid", Pattern::Grid), ("random", Pattern::Random), ("listed", Pattern::Listed)],
    );
    let seed = fields.count("seed", &limits::SEED).map_or(scenario_seed, |seed| seed.value);
    let turn_rad = fields.value("turn", Quantity::Angle, Range::Between(0.0, std::f64::consts::PI));
    let bearing_rad = fields.value("bearing", Quantity::Angle, Range::Any);
    let bearing_rad = bearing_rad.map_or(FRAC_PI_2, |bearing| bearing.value);
    let (id, gear) = (id?, gear?);
    let draw = Draw { seed, id: &id.value };
    let places = match pattern? {
        Pattern::Grid => grid(fields, &draw),
        Pattern::Random => random(fields, &draw),
        Pattern::Listed => listed(fields),
    }?;
    let turn_rad = turn_rad.map_or(0.0, |turn| turn.value);
    let placed = |(index, place): (usize, Spot)| {
        let [_, turn] = draw.symmetric("heading", index as u64);
        let [east_m, north_m] = match place.frame {
            Frame::Compass => place.at_m,
            Frame::Bearing => turned(place.at_m, bearing_rad),
        };
        PlacedGear {
            id: Some(At { value: format!("{}-{}", id.value, index + 1), place: id.place.clone() }),
            position_m: [gear.position_m[0] + east_m, gear.position_m[1] + north_m],
            heading_rad: place.heading_rad.unwrap_or(gear.heading_rad) + turn_rad * turn,
            ..gear.clone()
        }
    };
    Some(places.into_iter().enumerate().map(placed).collect())
}

/// How gear is distributed.
#[derive(Clone, Copy)]
enum Pattern {
    Grid,
    Random,
    Listed,
}

/// Axes of a place.
#[derive(Clone, Copy)]
enum Frame {
    /// East and north.
    Compass,
    /// Along the bearing, and to the right of it.
    Bearing,
}

/// A place in a field, relative to its middle.
#[derive(Clone, Copy)]
struct Spot {
    at_m: [f64; 2],
    frame: Frame,
    /// Heading of the gear there; `None`: that of the field.
    heading_rad: Option<f64>,
}

/// Random numbers of a field.
struct Draw<'a> {
    seed: u64,
    id: &'a str,
}

impl Draw<'_> {
    /// Two numbers from -1 to 1.
    fn symmetric(&self, what: &str, index: u64) -> [f64; 2] {
        let id = format!("{}/{what}", self.id);
        uniform("endline field 1", self.seed, index, &id).map(|number| 2.0 * number - 1.0)
    }
}

fn grid(fields: &Fields<'_>, draw: &Draw<'_>) -> Option<Vec<Spot>> {
    let count = |key, help| {
        fields.require(key, help);
        fields.count(key, &limits::FIELD).map(|count| count.value)
    };
    let columns = count("columns", "write the number of gears along the bearing, such as 10");
    let rows = count("rows", "write the number of rows, such as 5; 1 for a single row");
    fields.require(
        "spacing",
        "write spacing = [\"60 m\", \"80 m\"]: along the bearing, and between rows",
    );
    let spacing = fields.values("spacing", Quantity::Length, &[2]);
    let jitter = fields.value("jitter", Quantity::Length, Range::Within(&limits::FIELD_LENGTH));
    let (columns, rows, spacing) = (columns?, rows?, spacing?);
    if !is_within(fields, columns.saturating_mul(rows), "columns") {
        return None;
    }
    let jitter_m = jitter.map_or(0.0, |jitter| jitter.value);
    let middle = |count: u64| (count as f64 - 1.0) / 2.0;
    let spot = |index: u64| {
        let (row, column) = (index / columns, index % columns);
        let moved = draw.symmetric("place", index);
        let along = [(column, columns), (row, rows)];
        let at = |axis: usize| {
            let (place, count) = along[axis];
            (place as f64 - middle(count)) * spacing.value[axis] + jitter_m * moved[axis]
        };
        Spot { at_m: [at(0), at(1)], frame: Frame::Bearing, heading_rad: None }
    };
    Some((0..columns * rows).map(spot).collect())
}

fn random(fields: &Fields<'_>, draw: &Draw<'_>) -> Option<Vec<Spot>> {
    fields.require("count", "write the number of gears, such as 40; a density times the area");
    let count = fields.count("count", &limits::FIELD);
    fields.require("area", "write area = [\"1 km\", \"500 m\"]: along the bearing, and across");
    let area = fields.values("area", Quantity::Length, &[2]);
    let apart = fields.value("apart", Quantity::Length, Range::Within(&limits::FIELD_LENGTH));
    let (count, area) = (count?, area?);
    let apart_m = apart.as_ref().map_or(0.0, |apart| apart.value);
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut index = 0;
    while (found.len() as u64) < count.value {
        let is_free = |at: &[f64; 2]| {
            found.iter().all(|other| libm::hypot(at[0] - other[0], at[1] - other[1]) >= apart_m)
        };
        let tries = (index..index + TRIES).map(|index| {
            let [along, across] = draw.symmetric("place", index);
            (index, [along * area.value[0] / 2.0, across * area.value[1] / 2.0])
        });
        let Some((last, at)) = tries.into_iter().find(|(_, at)| is_free(at)) else {
            let message = format!(
                "only {} of {} gears fit into the area at least {apart_m} m apart",
                found.len(),
                count.value
            );
            let help = "write a smaller `count` or `apart`, or a greater `area`";
            fields.problems().push(count.place.error(message, help));
            return None;
        };
        found.push(at);
        index = last + 1;
    }
    let spot = |at_m| Spot { at_m, frame: Frame::Bearing, heading_rad: None };
    Some(found.into_iter().map(spot).collect())
}

/// `places`: a list of east and north, with the heading as a third value where it differs from that of the field.
fn listed(fields: &Fields<'_>) -> Option<Vec<Spot>> {
    const HELP: &str = "write places = [[\"0 m\", \"0 m\"], [\"80 m\", \"20 m\", \"45 deg\"]]: east, north, and heading if it differs";
    fields.require("places", HELP);
    let node = fields.get("places")?;
    let Content::List(items) = &node.content else {
        let message = format!("`places` is {}, not a list", node.content.noun());
        return fields.problems().refuse(node.place.error(message, HELP));
    };
    if !is_within(fields, items.len() as u64, "places") {
        return None;
    }
    let spot = |item: &crate::tree::Node| {
        let Content::List(parts) = &item.content else {
            let message = format!("a place is {}, not a list", item.content.noun());
            return fields.problems().refuse(item.place.error(message, HELP));
        };
        let value = |index: usize, quantity| {
            let part = parts.get(index)?;
            crate::fields::read_value(part, quantity, Range::Any, fields.problems())
        };
        let (east, north) = (value(0, Quantity::Length), value(1, Quantity::Length));
        let heading = value(2, Quantity::Angle);
        if !(2..=3).contains(&parts.len()) {
            let message = format!("a place has {} values", parts.len());
            return fields.problems().refuse(item.place.error(message, HELP));
        }
        Some(Spot {
            at_m: [east?.value, north?.value],
            frame: Frame::Compass,
            heading_rad: heading.map(|heading| heading.value),
        })
    };
    items.iter().map(spot).collect()
}

/// Whether a field has no more gear than the limit; more is reported at a key.
fn is_within<'a>(fields: &Fields<'a>, count: u64, key: &'a str) -> bool {
    if (count as f64) <= limits::FIELD.most {
        return true;
    }
    if let Some(node) = fields.get(key) {
        let message = format!("the field has {count} gears, more than {}", limits::FIELD.most);
        fields.problems().push(node.place.error(message, limits::FIELD.correction));
    }
    false
}

/// East and north of a place along a bearing and to the right of it [m].
fn turned([along_m, across_m]: [f64; 2], bearing_rad: f64) -> [f64; 2] {
    let (sin, cos) = (libm::sin(bearing_rad), libm::cos(bearing_rad));
    [along_m * sin + across_m * cos, along_m * cos - across_m * sin]
}

#[cfg(test)]
mod tests {
    use crate::scenario::Scenario;

    fn scenario(field: &str) -> String {
        format!(
            "format = 1\nkind = \"scenario\"\nname = \"Field\"\nduration = \"1 s\"\nseed = 3\n\n[site]\nitem = \"cape-cod-bay\"\n\n[[field]]\nid = \"f\"\nassembly = \"single\"\n{field}\n"
        )
    }

    fn places(field: &str) -> Vec<[f64; 2]> {
        let read = Scenario::read("field.toml", &scenario(field)).unwrap();
        read.gear.iter().map(|gear| gear.position_m).collect()
    }

    fn problem(field: &str) -> String {
        let problems = Scenario::read("field.toml", &scenario(field)).unwrap_err();
        problems.iter().map(|problem| format!("{}: {}\n", problem.message, problem.help)).collect()
    }

    #[test]
    fn a_grid_lies_along_its_bearing_about_its_middle() {
        let grid = "pattern = \"grid\"\ncolumns = 3\nrows = 2\nspacing = [\"10 m\", \"4 m\"]\nbearing = \"0 deg\"\nposition = [\"100 m\", \"0 m\"]";
        let found = places(grid);
        // Towards the north along the bearing; the second row is to the east of the first.
        let expected =
            [[98.0, -10.0], [98.0, 0.0], [98.0, 10.0], [102.0, -10.0], [102.0, 0.0], [102.0, 10.0]];
        for (at, wanted) in found.iter().zip(expected) {
            assert!(
                (at[0] - wanted[0]).abs() < 1e-9 && (at[1] - wanted[1]).abs() < 1e-9,
                "{found:?}"
            );
        }
        let moved = places(&format!("{grid}\njitter = \"1 m\""));
        let shift = |index: usize, axis: usize| (moved[index][axis] - found[index][axis]).abs();
        assert!((0..6).all(|index| shift(index, 0) <= 1.0 && shift(index, 1) <= 1.0));
        assert!((0..6).any(|index| shift(index, 0) > 0.1));
    }

    #[test]
    fn random_places_keep_their_distance_and_follow_from_the_seed() {
        let random =
            "pattern = \"random\"\ncount = 60\narea = [\"400 m\", \"300 m\"]\napart = \"20 m\"";
        let found = places(random);
        assert_eq!(found.len(), 60);
        for (index, one) in found.iter().enumerate() {
            assert!(one[0].abs() <= 200.0 && one[1].abs() <= 150.0, "along is east by default");
            for other in &found[..index] {
                assert!(libm::hypot(one[0] - other[0], one[1] - other[1]) >= 20.0);
            }
        }
        assert_eq!(found, places(random));
        assert_ne!(found, places(&format!("{random}\nseed = 4")));
        // A quarter of the area has a quarter of 1,000 places within four standard deviations.
        let many = places("pattern = \"random\"\ncount = 1000\narea = [\"400 m\", \"300 m\"]");
        let quarter = many.iter().filter(|at| at[0] > 0.0 && at[1] > 0.0).count();
        assert!((195..=305).contains(&quarter), "{quarter}");
    }

    #[test]
    fn listed_places_have_ids_and_their_own_headings() {
        let read = Scenario::read(
            "field.toml",
            &scenario(
                "pattern = \"listed\"\nheading = \"10 deg\"\nplaces = [[\"0 m\", \"5 m\"], [\"7 m\", \"0 m\", \"45 deg\"]]",
            ),
        );
        let gear = read.unwrap().gear;
        let ids: Vec<&str> =
            gear.iter().map(|gear| gear.id.as_ref().unwrap().value.as_str()).collect();
        assert_eq!(ids, ["f-1", "f-2"]);
        let headings: Vec<f64> = gear.iter().map(|gear| gear.heading_rad.to_degrees()).collect();
        assert!((headings[0] - 10.0).abs() < 1e-9 && (headings[1] - 45.0).abs() < 1e-9);
        let [east_m, north_m] = gear[1].position_m;
        assert!((east_m - 7.0).abs() < 1e-12 && north_m.abs() < 1e-12);
    }

    #[test]
    fn mistakes_are_reported_with_their_correction() {
        for (field, says) in [
            (
                "pattern = \"random\"\ncount = 900\narea = [\"50 m\", \"50 m\"]\napart = \"20 m\"",
                "fit into the area",
            ),
            (
                "pattern = \"grid\"\ncolumns = 900\nrows = 900\nspacing = [\"1 m\", \"1 m\"]",
                "810000 gears",
            ),
            ("pattern = \"grid\"\ncolumns = 2\nrows = 2", "spacing = "),
            ("pattern = \"listed\"\nplaces = [[\"1 m\"]]", "a place has 1 values"),
            ("pattern = \"rows\"", "grid"),
            (
                "pattern = \"grid\"\ncolumns = 2\nrows = 2\nspacing = [\"1 m\", \"1 m\"]\napart = \"3 m\"",
                "apart",
            ),
        ] {
            let said = problem(field);
            assert!(said.contains(says), "{field}: {said}");
        }
    }
}
