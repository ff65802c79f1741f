//! Rope lodged in the mouth.
//!
//! Rope is *held in the mouth* if it presses on baleen, or on the inside of the mouth on one side and on inside or lips on the
//! other. It is *lodged* after it has been held for [`LODGED_S`], until it has not been held for [`LOST_S`]. The inside of the
//! mouth consists of the triangles of the baleen, and of those with all corners marked as mouth.

use std::sync::Arc;

use endline_sdk::Region;

use super::events::{EventKind, LOST_S, Log};
use crate::contact::ContactPoint;
use crate::whale::{Mark, Skin};

/// Duration of hold after which rope is lodged; estimate [s].
pub const LODGED_S: f64 = 1.0;

/// Distance from the midplane below which a point is on neither side; estimate [m].
const MIDDLE_M: f64 = 0.02;

/// Rope in the mouth.
#[derive(Clone, Debug)]
pub(super) struct Mouth {
    /// Whether each triangle is inside the mouth.
    inside: Arc<[bool]>,
    since_s: Option<f64>,
    last_s: f64,
    /// Whether rope is lodged now.
    pub(super) lodged: bool,
    /// Whether rope was lodged at any time.
    pub(super) was_lodged: bool,
}

/// Normal forces in the mouth: on baleen, inside, and on each side including the lips [N].
#[derive(Clone, Copy, Debug, Default)]
struct Grip {
    baleen: f64,
    inside: f64,
    sides: [f64; 2],
}

impl Mouth {
    /// Meter of a whale with these triangles inside its mouth.
    pub(super) fn new(inside: Arc<[bool]>) -> Self {
        Self { inside, since_s: None, last_s: 0.0, lodged: false, was_lodged: false }
    }

    pub(super) fn fold(
        &mut self,
        skin: &Skin,
        contacts: &[ContactPoint],
        time_s: f64,
        log: &mut Log,
    ) {
        let grip = self.grip(skin, contacts);
        if grip.holds() {
            let since = *self.since_s.get_or_insert(time_s);
            self.last_s = time_s;
            if !self.lodged && time_s - since >= LODGED_S {
                (self.lodged, self.was_lodged) = (true, true);
                log.record(time_s, EventKind::Lodged, "head", grip.inside);
            }
        } else if self.since_s.is_some() && time_s - self.last_s >= LOST_S {
            self.since_s = None;
            if std::mem::take(&mut self.lodged) {
                log.record(time_s, EventKind::Dislodged, "head", self.last_s);
            }
        }
    }

    fn grip(&self, skin: &Skin, contacts: &[ContactPoint]) -> Grip {
        let mut grip = Grip::default();
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let inside = self.inside[contact.triangle];
            if !inside && contact.region != Region::Lips {
                continue;
            }
            let corners =
                skin.triangles[contact.triangle].map(|vertex| skin.vertices[vertex as usize].y);
            let y: f64 = corners.iter().zip(contact.barycentric).map(|(y, share)| y * share).sum();
            grip.inside += if inside { contact.normal_force_n } else { 0.0 };
            grip.baleen +=
                if contact.region == Region::Baleen { contact.normal_force_n } else { 0.0 };
            if libm::fabs(y) > MIDDLE_M {
                grip.sides[usize::from(y < 0.0)] += contact.normal_force_n;
            }
        }
        grip
    }
}

/// Whether each triangle is inside the mouth.
pub(super) fn inside_of_mouth(skin: &Skin) -> Arc<[bool]> {
    let marked =
        |vertex: &u32| matches!(skin.marks.get(*vertex as usize), Some(Mark::Mouth | Mark::Baleen));
    let inside = |(corners, region): (&[u32; 3], &Region)| {
        *region == Region::Baleen || corners.iter().all(marked)
    };
    skin.triangles.iter().zip(&skin.regions).map(inside).collect()
}

impl Grip {
    fn holds(&self) -> bool {
        self.baleen > 0.0 || (self.inside > 0.0 && self.sides.iter().all(|side| *side > 0.0))
    }
}
