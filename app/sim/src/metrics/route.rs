//! Routes: the parts of the whale that each strand of rope passes, in order, and what its two ends lead to.
//!
//! A route is determined by the contacts at one time. A *station* is a body part, with the inside of the mouth separate from
//! the rest of the head, and for parts in the midplane the side on which rope presses. Consecutive contacts on the same station
//! are one station. Rope beyond the outermost contacts leads to the first cut, or to the end of the strand.

use endline_sdk::{BodyPart, LineEnd, Side};

use super::mouth::inside_of_mouth;
use crate::contact::ContactPoint;
use crate::model::{JointKind, Model};
use crate::state::State;
use crate::strands::{Place, Strands, ends_at, joint_at};
use crate::whale::Skin;

/// Distance from the midplane below which rope on head, body or peduncle is on neither side; estimate [m].
const MIDDLE_M: f64 = 0.05;

/// Route of a strand over the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Stations in the order of the strand; neighbours differ.
    pub stations: Vec<Station>,
    /// What rope leads to before the first station and after the last.
    pub ends: [RouteEnd; 2],
}

/// A station of a route.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Station {
    /// Body part.
    pub part: BodyPart,
    /// Whether rope is inside the mouth.
    pub in_mouth: bool,
    /// Side of a part in the midplane; `None` near the midplane and on fins.
    pub side: Option<Side>,
}

/// End of a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteEnd {
    /// What rope leads to.
    pub leads_to: LeadsTo,
    /// Length of rope to it [m].
    pub rope_m: f64,
}

/// What rope leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeadsTo {
    /// A break.
    Broken,
    /// A bare end.
    Bare,
    /// A body, by index.
    Body(usize),
    /// A fixture, fixed or driven.
    Fixture,
    /// A hitch on the whale.
    Whale,
    /// A joint with other lines.
    Junction,
}

/// Routes of all strands in contact with the whale, in the order of the strands.
pub fn routes(model: &Model, state: &State, contacts: &[ContactPoint]) -> Vec<Route> {
    let Some(whale) = &model.spec.whale else { return Vec::new() };
    let mut strands = Strands::new(model);
    strands.measure(&state.rope.segment_length);
    let inside = inside_of_mouth(&whale.skin);
    let mut touched: Vec<(Place, f64, Station)> = contacts
        .iter()
        .filter(|contact| contact.normal_force_n > 0.0)
        .map(|contact| {
            let place = strands.places[contact.segment];
            (place, place.arc_at(contact.fraction), station(&whale.skin, &inside, contact))
        })
        .collect();
    touched.sort_by(|one, other| one.0.strand.cmp(&other.0.strand).then(one.1.total_cmp(&other.1)));
    touched
        .chunk_by(|one, other| one.0.strand == other.0.strand)
        .map(|touched| route(model, state, &strands, touched))
        .collect()
}

fn route(
    model: &Model,
    state: &State,
    strands: &Strands,
    touched: &[(Place, f64, Station)],
) -> Route {
    let mut stations: Vec<Station> = touched.iter().map(|(_, _, station)| *station).collect();
    stations.dedup();
    let segments = &strands.lists()[touched[0].0.strand];
    let leg = Leg { model, state, strands, segments };
    let (first, last) = (&touched[0], &touched[touched.len() - 1]);
    Route { stations, ends: [leg.back(&first.0, first.1), leg.onward(&last.0, last.1)] }
}

fn station(skin: &Skin, inside: &[bool], contact: &ContactPoint) -> Station {
    let part = contact.region.part();
    let corners = skin.triangles[contact.triangle].map(|vertex| skin.vertices[vertex as usize].y);
    let y: f64 = corners.iter().zip(contact.barycentric).map(|(y, share)| y * share).sum();
    let side = if y > 0.0 { Side::Left } else { Side::Right };
    Station {
        part,
        in_mouth: inside[contact.triangle],
        side: (part.side().is_none() && libm::fabs(y) > MIDDLE_M).then_some(side),
    }
}

/// Rope of a strand beyond the whale.
struct Leg<'a> {
    model: &'a Model,
    state: &'a State,
    strands: &'a Strands,
    segments: &'a [usize],
}

impl Leg<'_> {
    /// Follows the strand back to the first cut or its start.
    fn back(&self, from: &Place, arc_m: f64) -> RouteEnd {
        let before = self.segments[..from.order].iter().rev();
        let cut = before.copied().find(|segment| self.state.rope.cut[*segment]);
        match cut.map(|segment| &self.strands.places[segment]) {
            Some(cut) => broken(arc_m - cut.arc_m - cut.length_m),
            None => RouteEnd { leads_to: self.at(self.segments[0], true), rope_m: arc_m },
        }
    }

    /// Follows the strand forward to the first cut or its end.
    fn onward(&self, from: &Place, arc_m: f64) -> RouteEnd {
        let mut after = self.segments[from.order + 1..].iter().copied();
        let cut = after.find(|segment| self.state.rope.cut[*segment]);
        if let Some(cut) = cut.map(|segment| &self.strands.places[segment]) {
            return broken(cut.arc_m - arc_m);
        }
        let last = self.segments[self.segments.len() - 1];
        let end = &self.strands.places[last];
        RouteEnd { leads_to: self.at(last, false), rope_m: end.arc_m + end.length_m - arc_m }
    }

    /// What is at the outer end of the strand's first or last segment.
    fn at(&self, segment: usize, is_start: bool) -> LeadsTo {
        let line = self.model.segment_line[segment];
        let with_line = self.strands.places[segment].reversed != is_start;
        let end = if with_line { LineEnd::A } else { LineEnd::B };
        let joint = joint_at(self.model, line, end);
        match self.model.spec.joints.get(joint).map(|joint| &joint.kind) {
            Some(JointKind::Body { body, .. }) => LeadsTo::Body(*body),
            Some(JointKind::Fixed | JointKind::Driven { .. } | JointKind::Pulled { .. }) => {
                LeadsTo::Fixture
            }
            Some(JointKind::Whale(_)) => LeadsTo::Whale,
            _ if ends_at(self.model, joint).count() > 1 => LeadsTo::Junction,
            _ => LeadsTo::Bare,
        }
    }
}

fn broken(rope_m: f64) -> RouteEnd {
    RouteEnd { leads_to: LeadsTo::Broken, rope_m: rope_m.max(0.0) }
}
