//! The ending of a run: where rope is on the whale, as an observer would see it; and the endings on the way there.
//!
//! The ending does not depend on the observation with which it is compared, so that searches among the same encounters share runs.

use endline_gear::{PathPlace, RopeEnd, Site};
use endline_sdk::{BodyPart, Region};
use endline_sim::metrics::{EventKind, LeadsTo, Outcome, Route, Station, WhaleSummary, routes};
use endline_sim::model::BodyRole;
use serde::{Deserialize, Serialize};

use crate::encounters::Encounter;
use crate::run::Run;
use crate::study::{Played, PreparedStudy};

/// Rope that does not touch a part is on it from this many wraps [turns]; estimate.
const LOOSE_WRAPS: f64 = 0.25;

/// Rope under more tension than this where it presses is tight [N]; estimate.
const TIGHT_N: f64 = 50.0;

/// Change of wraps or twist from which an ending on the way is stored [turns].
const CHANGE_TURNS: f64 = 0.25;

/// Change of the logarithm of a length from which an ending on the way is stored.
const CHANGE_LENGTHS: f64 = 0.2;

/// Where rope is on the whale at the end of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ending {
    /// Sites with rope, in the order of [`Site::SINGLE`].
    pub sites: Vec<AtSite>,
    /// Strands on the whale.
    pub strands: Vec<Strand>,
    /// Rope that hangs from the whale, to loose ends or to gear [m].
    pub behind_m: f64,
    /// Most turns of a strand's two legs about each other [turns].
    pub twist: f64,
}

/// Rope at a site.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtSite {
    /// The site.
    pub site: Site,
    /// Wraps about it [turns].
    pub wraps: f64,
    /// Whether rope is tight there.
    pub tight: bool,
    /// Strands that lie across it without a turn.
    #[serde(default)]
    pub across: usize,
}

/// A strand of rope on the whale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Strand {
    /// Places it passes, in its order.
    pub places: Vec<PathPlace>,
    /// What is attached at each end; `None` if unidentifiable.
    pub ends: [Option<RopeEnd>; 2],
}

impl Ending {
    /// The ending of a run; empty for a released whale.
    pub fn of(run: &Run) -> Self {
        let summary = run.summary();
        let Some(whale) = &summary.whale else { return Self::default() };
        if !matches!(whale.outcome, Outcome::Entangled | Outcome::PartedEntangled) {
            return Self::default();
        }
        let routes = routes(run.model(), run.state(), run.contacts());
        let twist = summary.lines.iter().fold(0.0, |most: f64, line| most.max(line.twist.abs()));
        Self {
            sites: Site::SINGLE
                .into_iter()
                .filter_map(|site| at_site(site, whale, &routes))
                .collect(),
            strands: routes.iter().map(|route| strand(run, route)).collect(),
            behind_m: whale.trailing_m + whale.tethered_m,
            twist,
        }
    }

    /// Whether there is no rope on the whale.
    pub(super) fn is_free(&self) -> bool {
        self.sites.is_empty() && self.strands.is_empty()
    }

    /// The mirror image of the ending.
    pub fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        mirrored.sites.iter_mut().for_each(|at| at.site = at.site.mirrored());
        mirrored.sites.sort_by_key(|at| at.site);
        for place in mirrored.strands.iter_mut().flat_map(|strand| strand.places.iter_mut()) {
            *place = place.mirrored();
        }
        mirrored
    }

    /// Rope at a site, the greater of a pair; `None` if there is none.
    pub fn at(&self, site: Site) -> Option<AtSite> {
        let singles = site.singles();
        let here = self.sites.iter().filter(|at| singles.contains(&at.site)).copied();
        here.reduce(|one, other| AtSite {
            site,
            wraps: one.wraps.max(other.wraps),
            tight: one.tight || other.tight,
            across: one.across.max(other.across),
        })
    }
}

/// Rope at a single site; wraps about the mouth are those about the head.
fn at_site(site: Site, whale: &WhaleSummary, routes: &[Route]) -> Option<AtSite> {
    let own = BodyPart::ALL.into_iter().find(|part| Site::of_part(*part) == site);
    let region = whale.regions.get(own.unwrap_or(BodyPart::Head) as usize)?;
    // Along the centre line, or from contact to contact where they are more.
    let wraps = region.wraps.abs().max(region.touching_wraps.abs());
    let is_there = match site {
        Site::Mouth => whale.lodged_in_mouth,
        Site::Head => passes(routes, |station| station.part == BodyPart::Head && !station.in_mouth),
        _ => region.contact_length_m > 0.0,
    };
    (is_there || (wraps >= LOOSE_WRAPS && site != Site::Mouth)).then_some(AtSite {
        site,
        wraps,
        tight: tension_n(site, whale) > TIGHT_N,
        across: if site == Site::Mouth { 0 } else { region.across },
    })
}

fn passes(routes: &[Route], is_it: impl Fn(&Station) -> bool) -> bool {
    routes.iter().flat_map(|route| &route.stations).any(is_it)
}

/// Greatest tension of rope that presses at a single site [N].
fn tension_n(site: Site, whale: &WhaleSummary) -> f64 {
    let is_own = |region: Region| match site {
        Site::Mouth => matches!(region, Region::Baleen | Region::Lips),
        Site::Head => matches!(region, Region::Rostrum | Region::Head),
        site => Site::of_part(region.part()) == site,
    };
    let own = whale.patches.iter().filter(|patch| is_own(patch.region));
    own.fold(0.0, |most, patch| most.max(patch.tension_n))
}

fn strand(run: &Run, route: &Route) -> Strand {
    let place = |station: &Station| PathPlace {
        site: if station.in_mouth { Site::Mouth } else { Site::of_part(station.part) },
        side: station.side,
    };
    let bodies = &run.model().spec.bodies;
    let end = |leads_to: LeadsTo| match leads_to {
        LeadsTo::Broken => Some(RopeEnd::Broken),
        LeadsTo::Bare => Some(RopeEnd::Bare),
        LeadsTo::Fixture => Some(RopeEnd::Anchor),
        LeadsTo::Body(body) => Some(match bodies[body].role {
            BodyRole::Buoy => RopeEnd::Buoy,
            BodyRole::Trap => RopeEnd::Trap,
            BodyRole::Anchor | BodyRole::Weight => RopeEnd::Anchor,
        }),
        LeadsTo::Whale | LeadsTo::Junction => None,
    };
    Strand {
        places: route.stations.iter().map(place).collect(),
        ends: route.ends.map(|route_end| end(route_end.leads_to)),
    }
}

/// The end of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunEnding {
    /// Its ending.
    pub ending: Ending,
    /// Endings on the way, one for each change that an observer would report.
    pub on_the_way: Vec<Ending>,
    /// The part that rope touched first; empty where it touched none.
    pub first_part: String,
    /// Why it does not count; empty for a valid run.
    pub fault: String,
    /// Time simulated [s].
    pub simulated_s: f64,
    /// Hash of the last state.
    pub state_hash: String,
}

impl RunEnding {
    /// Runs an encounter to its end.
    pub(super) fn of(opened: &PreparedStudy, encounter: &Encounter) -> Self {
        let mut on_the_way: Vec<Ending> = Vec::new();
        let observe = |run: &Run| {
            let now = Ending::of(run);
            if !now.is_free() && on_the_way.last().is_none_or(|last| differ(last, &now)) {
                on_the_way.push(now);
            }
        };
        match opened.play_watched(0, encounter, 0.0, observe) {
            Ok(played) => Self { on_the_way, ..Self::played(&played) },
            Err(error) => Self { fault: error.to_string(), ..Self::default() },
        }
    }

    /// Runs an encounter on a finer resolution.
    pub(super) fn finer(opened: &PreparedStudy, encounter: &Encounter) -> Self {
        match opened.play_finer(0, encounter) {
            Ok(played) => Self::played(&played),
            Err(error) => Self { fault: error.to_string(), ..Self::default() },
        }
    }

    fn played(played: &Played) -> Self {
        let report = &played.report;
        let events = played.run.metrics().events();
        let first = events.iter().find(|event| event.kind == EventKind::Contact);
        Self {
            ending: Ending::of(&played.run),
            on_the_way: Vec::new(),
            first_part: first.map(|event| event.subject.clone()).unwrap_or_default(),
            fault: report.fault(),
            simulated_s: report.simulated_s,
            state_hash: report.state_hash.clone(),
        }
    }
}

/// Whether an observer would report two endings as different.
fn differ(one: &Ending, other: &Ending) -> bool {
    let apart = |one: f64, other: f64, by: f64| (one - other).abs() > by;
    let length = |ending: &Ending| libm::log(ending.behind_m.max(1.0));
    strands(one).ne(strands(other))
        || sites(one).ne(sites(other))
        || one.sites.iter().zip(&other.sites).any(|(a, b)| apart(a.wraps, b.wraps, CHANGE_TURNS))
        || apart(one.twist, other.twist, CHANGE_TURNS)
        || apart(length(one), length(other), CHANGE_LENGTHS)
}

fn strands(ending: &Ending) -> impl Iterator<Item = (&[PathPlace], [Option<RopeEnd>; 2])> {
    ending.strands.iter().map(|strand| (strand.places.as_slice(), strand.ends))
}

fn sites(ending: &Ending) -> impl Iterator<Item = (Site, bool, usize)> {
    ending.sites.iter().map(|at| (at.site, at.tight, at.across))
}
