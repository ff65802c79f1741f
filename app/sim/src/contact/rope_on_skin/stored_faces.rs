//! What contact points of rope on skin store from one solver step to the next: the normal force on each face, and the floats of the
//! friction law.
//!
//! A face is identified by the direction of its normal force, not by its index among the faces of the point: where a second wall comes
//! near, the indices shift, and each face would inherit the grip of another.
//!
//! A *site* is the number under which a face is stored. From the highest bit down it holds the segment, the sub-segment, the contact
//! point of the sub-segment, and the face.

use crate::contact::rope_on_skin::touch::{SAME_FACE, Touch};
use crate::state::FrictionState;
use glam::DVec3;
use std::ops::Range;

/// Share of the greatest push on its piece from which a further contact point is opened again in the next solver step.
const BEARING_SHARE: f64 = 0.5;

/// A face that was touched at the end of the last solver step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeptFace {
    /// Site.
    site: u64,
    /// Push, as if it had no other face beside it [N].
    pub push_n: f64,
    /// Direction of the push.
    normal: DVec3,
}

/// Reads the faces that were touched at the end of the last solver step from the state, in rising order of site.
pub(crate) fn take(state: &FrictionState, kept: &mut Vec<KeptFace>) {
    kept.clear();
    let faces = state.sites.iter().zip(&state.push_n).zip(&state.normals);
    kept.extend(faces.map(|((site, push_n), normal)| KeptFace {
        site: *site,
        push_n: *push_n,
        normal: *normal,
    }));
    debug_assert!(kept.is_sorted_by_key(|face| face.site), "stored faces in rising order of site");
    debug_assert_eq!(kept.len(), state.sites.len(), "one normal force and normal for each site");
}

/// The faces of the contact point whose first face has this site.
#[inline(always)]
pub(crate) fn of_point(kept: &[KeptFace], site: u64) -> Range<usize> {
    let from = kept.partition_point(|face| face.site < site);
    let faces = kept[from..].iter().take_while(|face| face.site >> FACE_BITS == site >> FACE_BITS);
    from..from + faces.count()
}

/// Assigns to each touched face the stored face of its contact point with the nearest normal; each stored face is assigned once.
/// A face without a stored value inherits the value of the face with the nearest normal, because it takes over part of its normal force.
pub(crate) fn assign(touches: &mut [Touch], kept: &[KeptFace], of_point: Range<usize>) {
    if let [touch] = touches {
        let mut best = f64::NEG_INFINITY;
        touch.kept = None;
        for face in of_point {
            let alike = touch.normal.dot(kept[face].normal);
            if alike > best {
                (best, touch.kept) = (alike, Some(face));
            }
        }
        return;
    }
    touches.iter_mut().for_each(|touch| touch.kept = None);
    for _ in 0..touches.len().min(of_point.len()) {
        let free =
            of_point.clone().filter(|face| touches.iter().all(|touch| touch.kept != Some(*face)));
        let mut best = (f64::NEG_INFINITY, 0, 0);
        for face in free {
            for (place, touch) in
                touches.iter().enumerate().filter(|(_, touch)| touch.kept.is_none())
            {
                let alike = touch.normal.dot(kept[face].normal);
                if alike > best.0 {
                    best = (alike, place, face);
                }
            }
        }
        let (_, place, face) = best;
        touches[place].kept = Some(face);
    }
    for touch in touches.iter_mut().filter(|touch| touch.kept.is_none()) {
        let alike = |face: &usize| touch.normal.dot(kept[*face].normal);
        touch.kept = of_point
            .clone()
            .filter(|face| alike(face) > SAME_FACE)
            .max_by(|one, other| alike(one).total_cmp(&alike(other)));
    }
}

/// The faces of a piece, by the site of its first contact point, among the stored faces from `from` on; all before belong to earlier pieces.
#[inline(always)]
pub(crate) fn next_of_piece(kept: &[KeptFace], from: usize, site: u64) -> Range<usize> {
    let piece = site >> PIECE_BITS;
    let (mut start, is_before) = (from, |face: &KeptFace| face.site >> PIECE_BITS < piece);
    while kept.get(start).is_some_and(is_before) {
        start += 1;
    }
    let (mut end, is_of_piece) = (start, |face: &KeptFace| face.site >> PIECE_BITS == piece);
    while kept.get(end).is_some_and(is_of_piece) {
        end += 1;
    }
    start..end
}

/// Contact points beside its middle one that bore much of the push on a piece of rope, of these faces, in the last solver step.
pub(crate) fn points_beside(of_piece: &[KeptFace]) -> usize {
    let greatest_n = of_piece.iter().map(|face| face.push_n).fold(0.0, f64::max);
    let bearing = of_piece.iter().filter(|face| face.push_n >= BEARING_SHARE * greatest_n);
    let numbers = bearing.map(|face| (face.site >> FACE_BITS) as usize & (MOST_POINTS - 1));
    numbers.max().unwrap_or(0)
}

/// Bits below the segment.
pub(crate) const SEGMENT_BITS: u32 = 20;
/// Bits that name the face.
pub(crate) const FACE_BITS: u32 = 2;
/// Bits that name the contact point within its piece, and the face.
pub(crate) const PIECE_BITS: u32 = 3 + FACE_BITS;
/// Most contact points of a piece.
pub(crate) const MOST_POINTS: usize = 1 << (PIECE_BITS - FACE_BITS);

/// The segment a site lies on.
pub(crate) fn segment_of(site: u64) -> usize {
    (site >> SEGMENT_BITS) as usize
}

/// A site whose segment, where it is among these, has moved by one place up or down.
pub(crate) fn shift_site(site: u64, segments: Range<usize>, by: i64) -> u64 {
    if segments.contains(&segment_of(site)) {
        site.wrapping_add_signed(by << SEGMENT_BITS)
    } else {
        site
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(normal: DVec3) -> Touch {
        Touch::new((0, [1.0, 0.0, 0.0]), DVec3::ZERO, (normal, 0.003))
    }

    fn state(faces: &[(u64, DVec3)]) -> FrictionState {
        FrictionState {
            sites: faces.iter().map(|(site, _)| *site).collect(),
            push_n: faces.iter().map(|(site, _)| *site as f64).collect(),
            normals: faces.iter().map(|(_, normal)| *normal).collect(),
            floats: Vec::new(),
        }
    }

    /// The stored faces that are assigned to the touched faces of a contact point.
    fn assigned(state: &FrictionState, site: u64, normals: &[DVec3]) -> Vec<Option<usize>> {
        let mut kept = Vec::new();
        take(state, &mut kept);
        let mut touches: Vec<Touch> = normals.iter().copied().map(touch).collect();
        assign(&mut touches, &kept, of_point(&kept, site));
        touches.iter().map(|touch| touch.kept).collect()
    }

    #[test]
    fn a_face_keeps_its_grip_as_another_comes_before_it_in_the_row() {
        let point = 5 << PIECE_BITS;
        let alone = state(&[(point, DVec3::Z)]);
        let wall = DVec3::new(0.98, 0.0, 0.2).normalize();
        assert_eq!(assigned(&alone, point, &[wall, DVec3::Z]), [None, Some(0)]);
        assert_eq!(assigned(&alone, point, &[DVec3::Z, wall]), [Some(0), None]);
        let leaning = DVec3::new(0.2, 0.0, 0.98).normalize();
        assert_eq!(assigned(&alone, point, &[DVec3::Z, leaning]), [Some(0), Some(0)]);
        let two = state(&[(point, leaning), (point + 1, DVec3::Z)]);
        assert_eq!(assigned(&two, point, &[DVec3::Z]), [Some(1)]);
        assert_eq!(assigned(&two, point, &[DVec3::Z, leaning]), [Some(1), Some(0)]);
    }

    #[test]
    fn faces_of_other_contact_points_are_not_given() {
        let point = 5 << PIECE_BITS;
        let others =
            state(&[(point - (1 << FACE_BITS), DVec3::Z), (point + (1 << FACE_BITS), DVec3::Z)]);
        assert_eq!(assigned(&others, point, &[DVec3::Z]), [None]);
    }
}
