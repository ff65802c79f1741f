//! What a whale meets on its track through the gear of an option, in a study with `[exposure]`.
//!
//! The gear of an option is at rest in the sea of the encounter. All meetings along the track are counted; one of them, each as likely as
//! any other, is the encounter that is simulated, with the gear that is met alone. A rate by distance is thus the sum over tracks of the
//! number of meetings, of those tracks whose simulated encounter has the event, divided by the distance of all tracks.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use endline_gear::{Document, Scenario, Setting};
use endline_sim::DVec3;

use crate::encounters::Encounter;
use crate::encounters::draw::at_share;
use crate::encounters::equilibria::Equilibrium;
use crate::encounters::tracks::{Piece, Track, choice};
use crate::error::Error;

use super::prepared::PreparedStudy;

/// Least speed over the ground, for a whale against a current as fast as it swims [m/s].
const LEAST_SPEED_M_S: f64 = 0.05;

/// Keys of a field that place its gear.
const OF_PATTERNS: [&str; 11] = [
    "apart", "area", "bearing", "columns", "count", "jitter", "position", "rows", "seed",
    "spacing", "turn",
];

/// A gear of an option's fields.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GearPlace {
    /// Its id.
    pub id: String,
    /// Index of its field.
    pub field: usize,
    /// East and north [m].
    pub at_m: [f64; 2],
    /// Heading [rad].
    pub heading: f64,
}

/// A track through the gear of an option.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Distance over the ground [m].
    pub way_m: f64,
    /// Time [s].
    pub time_s: f64,
    /// Number of meetings with gear.
    pub meetings: u64,
    /// The meeting that is simulated; `None` without meetings.
    pub met: Option<Met>,
}

/// A meeting with gear.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Met {
    /// Place of the gear among those of the option.
    pub gear: usize,
    /// Place of mid-body when rope passes it, from the place of the gear: east and north [m].
    pub place_m: [f64; 2],
    /// Direction over the ground: unit vector, east and north.
    pub ahead: [f64; 2],
    /// Bearing of the body [rad].
    pub bearing: f64,
    /// Depth of mid-body [m].
    pub depth_m: f64,
}

/// The places of gear of a scenario with fields.
/// Errors: a scenario that cannot be read, has gear outside of fields, or has no field.
pub(super) fn places(name: &str, scenario: &Document) -> Result<Vec<GearPlace>, Error> {
    let read = Scenario::read(name, &scenario.text()).map_err(Error::Diagnostics)?;
    let fields: Vec<String> = (0..scenario.count("field"))
        .map(|field| scenario.get(&format!("field.{field}.id")).unwrap_or_default())
        .collect();
    let place = |gear: &endline_gear::PlacedGear| {
        let id = gear.id.as_ref().map(|id| id.value.clone()).unwrap_or_default();
        let field = id
            .rsplit_once('-')
            .and_then(|(field, _)| fields.iter().position(|known| known == field));
        Some(GearPlace { field: field?, id, at_m: gear.position_m, heading: gear.heading_rad })
    };
    let places: Option<Vec<GearPlace>> = read.gear.iter().map(place).collect();
    places.filter(|places| !places.is_empty()).ok_or_else(|| {
        Error::Message(format!(
            "{name}: a study with [exposure] needs a scenario whose gear is in fields; write its gear as [[field]], and remove [[gear]]"
        ))
    })
}

/// Leaves one gear of a scenario, at the origin.
/// Errors: a field that cannot be edited.
pub(super) fn leave_only(scenario: &mut Document, place: &GearPlace) -> Result<(), Error> {
    for other in (0..scenario.count("field")).rev().filter(|other| *other != place.field) {
        scenario.remove_table("field", other)?;
    }
    for key in OF_PATTERNS.map(|key| format!("field.0.{key}")) {
        if scenario.has(&key) {
            scenario.remove(&key)?;
        }
    }
    scenario.put("field.0.pattern", &Setting::text("listed"))?;
    let only = format!("[[\"0 m\", \"0 m\", \"{} rad\"]]", place.heading);
    Ok(scenario.put("field.0.places", &Setting::plain(&only))?)
}

impl PreparedStudy {
    /// The track of an encounter through the gear of an option; `None` if the study has no `[exposure]`.
    /// Errors: gear that cannot be brought to rest.
    pub(super) fn crossing(
        &self,
        option: usize,
        encounter: &Encounter,
    ) -> Result<Option<Crossing>, Error> {
        let Some(exposure) = &self.study.exposure else { return Ok(None) };
        let places = &self.options[option].places;
        let mut rests = Rests::of(self, option, encounter);
        let first = Arc::clone(&rests.at(&places[0])?.gear);
        let speed_m_s = self.speed_m_s(encounter, &first);
        let reach_m = exposure.reach_m.unwrap_or_else(|| self.reach_m(encounter, &first));
        let (mut way_m, mut time_s, mut met) = (0.0, 0.0, Vec::new());
        for piece in Track::of(exposure, self.study.seed, encounter.index) {
            let depth_m = self.depth_m(encounter, &first, piece.depth_share);
            let middle = DVec3::new(piece.from_m[0], piece.from_m[1], -depth_m);
            let course = Course::of(&piece, speed_m_s, first.model.sea.current(middle, 0.0));
            way_m += piece.length_m;
            time_s += piece.length_m / course.speed_m_s;
            for (gear, place) in places.iter().enumerate() {
                if piece.distance_m(place.at_m) > rests.longest_m(place)? + reach_m {
                    continue;
                }
                let rope = &rests.at(place)?.rope;
                let Some(along_m) = piece.meets(place.at_m, rope, (depth_m, reach_m)) else {
                    continue;
                };
                let at = |axis: usize| {
                    piece.from_m[axis] + along_m * piece.ahead[axis] - place.at_m[axis]
                };
                let place_m = [at(0), at(1)];
                let (ahead, bearing) = (piece.ahead, course.bearing);
                met.push(Met { gear, place_m, ahead, bearing, depth_m });
            }
        }
        let meetings = met.len() as u64;
        let chosen = (choice(self.study.seed, encounter.index) * met.len() as f64) as usize;
        let met = met.into_iter().nth(chosen);
        Ok(Some(Crossing { way_m, time_s, meetings, met }))
    }

    /// The gear at a place in equilibrium in the sea of an encounter, alone at the origin.
    pub(super) fn equilibrium_of_gear(
        &self,
        option: usize,
        encounter: &Encounter,
        place: &GearPlace,
    ) -> Result<Arc<Equilibrium>, Error> {
        let (mut scenario, library) = self.gear_of(option, encounter)?;
        leave_only(&mut scenario, place)?;
        let name = &self.options[option].scenario_name;
        self.equilibria.of(crate::source::Source::new(name, scenario.text(), library), &self.host)
    }

    fn speed_m_s(&self, encounter: &Encounter, rest: &Equilibrium) -> f64 {
        let own = rest.model.spec.whale.as_ref().map_or(0.0, |whale| whale.speed_m_s);
        encounter.number("speed").unwrap_or(own).max(LEAST_SPEED_M_S)
    }

    /// Half the breadth of the whale at rest, over flippers or flukes, by the length that is drawn [m].
    fn reach_m(&self, encounter: &Encounter, rest: &Equilibrium) -> f64 {
        let Some(whale) = &rest.model.spec.whale else { return 0.0 };
        let half_m = whale.skin.vertices.iter().map(|place| place.y.abs()).fold(0.0, f64::max);
        half_m * encounter.number("length").unwrap_or(whale.length_m) / whale.length_m
    }

    /// Depth of a leg: by the law of depths of the study, else that of the scenario [m].
    fn depth_m(&self, encounter: &Encounter, rest: &Equilibrium, share: f64) -> f64 {
        let mut priors = self.study.priors.iter();
        let drawn = priors.find(|prior| prior.name.value == "depth");
        let own = rest.model.spec.whale.as_ref().map_or(0.0, |whale| -whale.position_m.z);
        let by_law = drawn.and_then(|prior| at_share(prior, share).number);
        by_law.or_else(|| encounter.number("depth")).unwrap_or(own)
    }
}

/// How a whale swims along a piece of a track in a current.
struct Course {
    /// Speed over the ground [m/s].
    speed_m_s: f64,
    /// Bearing of the body [rad].
    bearing: f64,
}

impl Course {
    /// The body is turned into the current so far that the way over the ground follows the track.
    fn of(piece: &Piece, speed_m_s: f64, current: DVec3) -> Self {
        let ahead = DVec3::new(piece.ahead[0], piece.ahead[1], 0.0);
        let level = DVec3::new(current.x, current.y, 0.0);
        let along = level.dot(ahead);
        let across = level - along * ahead;
        let own = (speed_m_s * speed_m_s - across.length_squared()).max(0.0).sqrt();
        let body = own * ahead - across;
        Self { speed_m_s: (own + along).max(LEAST_SPEED_M_S), bearing: libm::atan2(body.x, body.y) }
    }
}

/// Gear at rest in the sea of an encounter, by field and heading.
struct Rests<'a> {
    study: &'a PreparedStudy,
    option: usize,
    encounter: &'a Encounter,
    found: BTreeMap<(usize, u64), Rest>,
}

/// Gear at rest, alone at the origin.
struct Rest {
    gear: Arc<Equilibrium>,
    /// Its rope, segment by segment.
    rope: Vec<[DVec3; 2]>,
}

impl<'a> Rests<'a> {
    fn of(study: &'a PreparedStudy, option: usize, encounter: &'a Encounter) -> Self {
        Self { study, option, encounter, found: BTreeMap::new() }
    }

    fn at(&mut self, place: &GearPlace) -> Result<&Rest, Error> {
        let rest = match self.found.entry((place.field, place.heading.to_bits())) {
            Entry::Occupied(found) => return Ok(found.into_mut()),
            Entry::Vacant(missing) => {
                let gear = self.study.equilibrium_of_gear(self.option, self.encounter, place)?;
                let rope = segments(&gear);
                missing.insert(Rest { gear, rope })
            }
        };
        Ok(rest)
    }

    /// Length of all rope of the gear of a field, with a tenth for its stretch: no rope is farther from the place of its gear [m].
    fn longest_m(&mut self, place: &GearPlace) -> Result<f64, Error> {
        let any = self.found.range((place.field, 0)..=(place.field, u64::MAX)).next();
        let rope_m =
            |rest: &Rest| 1.1 * rest.gear.settled.state.rope.segment_length.iter().sum::<f64>();
        match any {
            Some((_, rest)) => Ok(rope_m(rest)),
            None => Ok(rope_m(self.at(place)?)),
        }
    }
}

/// Rope of gear at rest, segment by segment.
fn segments(gear: &Equilibrium) -> Vec<[DVec3; 2]> {
    let position = &gear.settled.state.rope.position;
    let lines = gear.model.line_nodes.iter().map(|nodes| &position[nodes.clone()]);
    lines.flat_map(|nodes| nodes.windows(2).map(|pair| [pair[0], pair[1]])).collect()
}
