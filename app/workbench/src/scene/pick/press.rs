//! Places where rope or a body presses on skin: their marks and arrows under the pointer, and the same places at other moments.

use endline_session::scene::Show;
use endline_session::scene::forces::{Presser, SkinForce, greatest_n, on_skin};
use endline_sim::contact::ContactPoint;
use endline_sim::contact::bodies::BodyContact;
use endline_sim::{Frame, Model};

use super::line::along_m;
use super::{Picked, Sight, Thin};

/// How far beside an arrow or a mark the pointer may be [points].
const REACH: f64 = 5.0;
/// How far along a line the place of a contact may wander and still be the same [m].
const SAME_M: f64 = 0.5;

/// The mark or arrow nearest to the pointer on screen, of those that are shown and within reach.
pub(super) fn press(model: &Model, frame: &Frame, sight: &Sight<'_>, show: &Show) -> Option<Thin> {
    let greatest_n = greatest_n(frame);
    let hits = on_skin(frame).filter_map(|force: SkinForce| {
        let shaft = force.shaft(greatest_n).filter(|_| show.forces);
        if shaft.is_none() && !show.contacts {
            return None;
        }
        let ends = [force.place, force.place - shaft.unwrap_or_default()];
        let (beside, share) = sight.beside(ends).filter(|(beside, _)| *beside <= REACH)?;
        let away_m = sight.away_m(ends[0].lerp(ends[1], share));
        Some(Thin { beside, away_m, picked: picked(model, frame, force.of)? })
    });
    hits.min_by(|one, other| one.beside.total_cmp(&other.beside))
}

fn picked(model: &Model, frame: &Frame, of: Presser) -> Option<Picked> {
    match of {
        Presser::Rope(index) => {
            let contact = frame.contacts.get(index)?;
            let at_m = contact_m(model, frame, contact)?;
            Some(Picked::RopeOnSkin { line: contact.line, at_m })
        }
        Presser::Body(index) => {
            let contact = frame.body_contacts.get(index)?;
            Some(Picked::BodyOnSkin { body: contact.body, triangle: contact.triangle })
        }
    }
}

/// Unstretched rope from its line's first end to a contact [m].
#[must_use]
pub fn contact_m(model: &Model, frame: &Frame, contact: &ContactPoint) -> Option<f64> {
    along_m(model, frame, contact.line, contact.segment, contact.fraction)
}

/// The place nearest to a length of a line at which it presses on skin; `None` where it does not press there.
#[must_use]
pub fn rope_on_skin<'a>(
    model: &Model,
    frame: &'a Frame,
    line: usize,
    at_m: f64,
) -> Option<&'a ContactPoint> {
    let mine = frame.contacts.iter().filter(|it| it.line == line && it.normal_force_n > 0.0);
    let away = mine.filter_map(|it| Some(((contact_m(model, frame, it)? - at_m).abs(), it)));
    let nearest = away.min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.filter(|(away_m, _)| *away_m <= SAME_M).map(|(_, contact)| contact)
}

/// The place at which a body presses on a triangle of skin; on another, the place at which it presses hardest.
#[must_use]
pub fn body_on_skin(frame: &Frame, body: usize, triangle: usize) -> Option<&BodyContact> {
    let mine = frame.body_contacts.iter().filter(|it| it.body == body && it.normal_force_n > 0.0);
    mine.max_by(|one, other| {
        let rank = |it: &BodyContact| (it.triangle == triangle, it.normal_force_n);
        let (one, other) = (rank(one), rank(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    })
}
